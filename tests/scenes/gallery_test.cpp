// The gallery: its files are what the generator writes,
// they load without complaint, and they are what they claim.
#include "scenes/gallery/generator/gltf_text.h"
#include "scenes/gallery/generator/stages.h"
#include "scenes/gltf/gltf.h"
#include "scenes/scene.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>

namespace meninas {

static const std::filesystem::path folder =
    std::filesystem::path(test::source_dir()) / "scenes/gallery";

static Scene load(const std::string& name) { return load_gltf(folder / (name + ".gltf")); }

static std::vector<std::filesystem::path> gallery_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST(Gallery, FilesAreWhatTheGeneratorWrites) {
  for (const auto& stage : gallery::all_stages()) {
    std::ifstream stream(folder / (stage.name + ".gltf"), std::ios::binary);
    const std::string committed{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(committed == gallery::gltf_text(stage))
        << stage.name << ".gltf: run meninas_gallery scenes/gallery and look at the difference";
  }
  EXPECT_EQ(gallery_files().size(), gallery::all_stages().size() + 1)
      << "all but blender-room.glb are generated";
}

TEST(Gallery, LoadsWithoutComplaintAndHasCamerasAndLights) {
  for (const auto& file : gallery_files()) {
    SCOPED_TRACE(file.filename());
    const auto scene = load_gltf(file);
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    EXPECT_THAT(scene.ignored, testing::IsEmpty());
    EXPECT_EQ(scene.degenerate_triangles, 0U);
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_TRUE(!scene.lights.empty() || std::ranges::any_of(scene.materials, is_emitter));

    // Cheap enough for a test and a first look.
    EXPECT_LT(scene.triangles.size(), 3000U);
  }
}

TEST(Gallery, MirrorsAreWhereTheNamesSay) {
  for (const auto& file : gallery_files()) {
    SCOPED_TRACE(file.filename());
    const auto scene = load_gltf(file);
    const auto name = file.stem().string();
    const auto is_plain = name == "cornell" || name == "doubled-room" || name == "no-mirror" ||
                          name == "furnace" ||
                          std::ranges::any_of(scene.materials, is_glass); // which is mirror enough
    EXPECT_EQ(std::ranges::any_of(scene.materials, is_mirror), !is_plain);
  }
}

/// Edges between consecutive corners, from the smaller to the larger one,
/// with how often each direction occurs.
using Corner = std::array<double, 3>;
static std::map<std::pair<Corner, Corner>, int> edge_balance(const Scene& scene) {
  const auto key = [](const Point3& p) { return Corner{p.x, p.y, p.z}; };
  std::map<std::pair<Corner, Corner>, int> balance;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto points = corners(scene, TriangleId{t});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = key(points[k]);
      const auto b = key(points[(k + 1) % 3]);
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return balance;
}

TEST(Gallery, FurnaceIsClosedAndEveryWallEmitsOne) {
  const auto scene = load("furnace");
  for (const auto& [edge, balance] : edge_balance(scene))
    EXPECT_EQ(balance, 0);
  for (const auto& material : scene.materials) {
    EXPECT_EQ(diffuse_reflectance(material), Rgb(0.5));
    // 1 / pi is written with the shortest decimals that read back to the same double.
    EXPECT_DOUBLE_EQ(std::numbers::pi * material.emission.x, 1.0);
  }
}

/// Fronts that enclose something cancel in every direction.
static Vec3 sum_of_area_vectors(const Scene& scene) {
  Vec3 sum(0.0);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    sum += area_vector(corners(scene, TriangleId{t}));
  return sum;
}

TEST(Gallery, RoomsThatEncloseEverythingHaveFrontsThatCancel) {
  // Boxes leave out the face they stand on, so only the horizontal components
  // cancel for every closed room; positions are floats of a few metres,
  // 1e-7 of them times some hundred square metres is below 1e-4.
  for (const auto* name : {"doubled-room", "facing-mirrors", "no-mirror", "periscope"}) {
    const auto sum = sum_of_area_vectors(load(name));
    EXPECT_NEAR(sum.x, 0.0, 1e-4) << name;
    EXPECT_NEAR(sum.z, 0.0, 1e-4) << name;
  }
  EXPECT_GT(std::abs(sum_of_area_vectors(load("cornell")).z), 1.0)
      << "the Cornell box is open in front";
}

/// The corners of a triangle from the smallest one on,
/// so that equal triangles with the same front compare equal.
static std::array<Corner, 3> canonical(const std::array<Point3, 3>& points, double sign_of_x) {
  std::array<Corner, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = {sign_of_x * points[k].x + 0.0, points[k].y, points[k].z};
  if (sign_of_x < 0.0)
    std::swap(result[1], result[2]);
  std::ranges::rotate(result, std::ranges::min_element(result));
  return result;
}

using NamedTriangle = std::tuple<std::string, std::string, std::array<Corner, 3>>;

static std::vector<NamedTriangle> named_triangles(const Scene& scene, double sign_of_x,
                                                  const std::string& suffix) {
  std::vector<NamedTriangle> result;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& triangle = scene.triangles[t];
    const auto& material = scene.materials[index(triangle.material)];
    if (is_mirror(material))
      continue;
    result.emplace_back(scene.nodes[index(triangle.node)].name + suffix, material.name,
                        canonical(corners(scene, TriangleId{t}), sign_of_x));
  }
  return result;
}

TEST(Gallery, DoubledRoomIsTheHalfRoomAndItsImage) {
  const auto half = load("half-room");
  const auto doubled = load("doubled-room");
  auto expected = named_triangles(half, 1.0, "");
  EXPECT_EQ(half.triangles.size(), expected.size() + 2) << "the mirror is one rectangle";

  const auto images = named_triangles(half, -1.0, ".image");
  expected.insert(expected.end(), images.begin(), images.end());
  EXPECT_THAT(named_triangles(doubled, 1.0, ""), testing::UnorderedElementsAreArray(expected));

  EXPECT_EQ(find_camera(half, "main").position, find_camera(doubled, "main").position);
  EXPECT_EQ(find_camera(half, "main").forward, find_camera(doubled, "main").forward);
}

TEST(Gallery, HalfRoomsMirrorCoversItsPlaneAndNothingIsBehindIt) {
  const auto half = load("half-room");
  double mirror_area = 0.0;
  for (std::uint32_t t = 0; t < half.triangles.size(); ++t) {
    const auto points = corners(half, TriangleId{t});
    for (const auto& point : points)
      EXPECT_GE(point.x, 0.0);
    const auto& material = half.materials[index(half.triangles[t].material)];
    if (!is_mirror(material))
      continue;
    EXPECT_EQ(mirror_reflectance(material), Rgb(1.0));
    EXPECT_GT(area_vector(points).x, 0.0);
    mirror_area += glm::length(area_vector(points));
  }
  // The room is 2.6 m high and 4 m deep; 2.6 is a float in the file.
  EXPECT_NEAR(mirror_area, 2.6 * 4.0, 1e-6);
}

} // namespace meninas
