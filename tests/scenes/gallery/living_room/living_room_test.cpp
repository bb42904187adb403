// The furnished room that the generator writes, and the curved bodies it is made of.
#include "scenes/gallery/generator/glb_file.h"
#include "scenes/gallery/living_room/living_room.h"
#include "scenes/gallery/living_room/smooth_shapes.h"
#include "scenes/gltf/gltf.h"
#include "scenes/report/scene_report.h"
#include "scenes/surfaces/surfaces.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>

namespace meninas {
namespace {

using gallery::Mesh;

/// Six times the volume is the sum of the corners' determinants, for a closed mesh.
double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c]));
  return sum / 6.0;
}

/// How often edges are run through one way more than the other; zero for closed bodies.
std::size_t open_edges(const Mesh& mesh) {
  using Corner = std::array<double, 3>;
  std::map<std::pair<Corner, Corner>, int> balance;
  const auto corner = [&](std::uint32_t vertex) {
    const glm::vec3 p(mesh.positions[vertex]); // as the file has it
    return Corner{p.x + 0.0, p.y + 0.0, p.z + 0.0};
  };
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner a = corner(triangle[k]), b = corner(triangle[(k + 1) % 3]);
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  std::size_t open = 0;
  for (const auto& [edge, sum] : balance)
    open += sum != 0;
  return open;
}

TEST(SmoothShapes, ASuperellipsoidOfPowerTwoIsASphere) {
  const Point3 centre{1.0, 2.0, 3.0};
  const Mesh ball = gallery::superellipsoid({centre, Vec3(0.5), 2.0, 2.0}, 32);
  for (std::size_t k = 0; k < ball.positions.size(); ++k)
    EXPECT_LT(glm::distance(ball.positions[k], centre + 0.5 * ball.normals[k]), 1e-12);
  EXPECT_EQ(open_edges(ball), 0U);
  // Chords of 90 / 32 degrees lie inside: less by some (1 - cos(1.4 deg)) * 3 = 0.1 %.
  const double sphere = 4.0 / 3.0 * std::numbers::pi * 0.125;
  EXPECT_NEAR(volume(gallery::moved(ball, -centre)) / sphere, 1.0, 2e-3);
}

TEST(SmoothShapes, ARoundedBoxIsItsCoreGrownByTheRadius) {
  const double r = 0.1;
  const Mesh box = gallery::rounded_box({-1.0, -0.5, -0.3}, {1.0, 0.5, 0.3}, r, 12);
  EXPECT_EQ(open_edges(box), 0U);
  // Steiner's formula: V + S r + pi r^2 (sum of the three sides) + 4 pi r^3 / 3 of the core.
  const double a = 1.8, b = 0.8, c = 0.4;
  const double grown = a * b * c + 2.0 * (a * b + b * c + c * a) * r +
                       std::numbers::pi * r * r * (a + b + c) +
                       4.0 / 3.0 * std::numbers::pi * r * r * r;
  // Quarter arcs of 24 chords have 0.1 % less than their sectors, which are a tenth of it.
  EXPECT_NEAR(volume(box) / grown, 1.0, 2e-4);
}

TEST(SmoothShapes, ATurnedBodyIsClosedAndItsEdgesAreSharp) {
  const std::vector<Vec2> cylinder{{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.0},
                                   {0.5, 1.0}, {0.5, 1.0}, {0.0, 1.0}};
  const Mesh mesh = gallery::turned_body(Point3(0.0), gallery::rounded_profile(cylinder, 4), 64);
  EXPECT_EQ(open_edges(mesh), 0U);
  // A regular polygon of 64 sides in place of the circle.
  EXPECT_NEAR(volume(mesh), 32.0 * 0.25 * std::sin(2.0 * std::numbers::pi / 64.0), 1e-9);
  for (const Vec3& normal : mesh.normals)
    EXPECT_TRUE(std::abs(normal.y) < 1e-9 || std::abs(normal.y) > 1.0 - 1e-9);
}

TEST(SmoothShapes, ProfilesStayBetweenTheirPoints) {
  // A wide foot that runs into a thin post: a spline of even steps would cross the axis.
  const std::vector<Vec2> points{
      {0.13, 0.0}, {0.12, 0.02}, {0.03, 0.03}, {0.012, 0.05}, {0.011, 0.6}};
  const auto profile = gallery::rounded_profile(points, 8);
  ASSERT_EQ(profile.size(), 33U);
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    EXPECT_GE(profile[k].x, profile[k + 1].x);
    EXPECT_LE(profile[k].y, profile[k + 1].y);
  }
}

TEST(SmoothShapes, ATubeIsClosedAndFacesOutwards) {
  const std::vector<Point3> line{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.3, 2.0, 0.0}};
  const Mesh tube = gallery::tube(line, 0.1, 0.05, 16);
  EXPECT_EQ(open_edges(tube), 0U);
  EXPECT_GT(volume(tube), 0.0);

  // Two thirds of a ring: Pappus's volume, but for the chords of both circles, some 3 %.
  std::vector<Point3> arc;
  for (int k = -24; k <= 24; ++k) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * k / 24.0;
    arc.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const double ring = 4.0 / 3.0 * std::numbers::pi * std::numbers::pi * 0.01;
  EXPECT_NEAR(volume(gallery::tube(arc, 0.1, 0.1, 16)) / ring, 1.0, 0.04);
}

/// Read from the file that the generator would write, which is removed at once.
Scene written_and_read(const std::string& bytes) {
  std::string folder = (std::filesystem::temp_directory_path() / "living-room-XXXXXX").string();
  EXPECT_NE(mkdtemp(folder.data()), nullptr);
  const auto file = std::filesystem::path(folder) / "living-room.glb";
  std::ofstream(file, std::ios::binary) << bytes;
  Scene scene = load_gltf(file);
  std::filesystem::remove_all(folder);
  return scene;
}

TEST(LivingRoom, IsTheSameBytesEachTime) {
  EXPECT_TRUE(gallery::glb_bytes(gallery::living_room()) ==
              gallery::glb_bytes(gallery::living_room()));
}

TEST(LivingRoom, EveryBodyButClothAndWhatIsLetIntoAWallIsClosed) {
  const std::set<std::string> open{"back",
                                   "front",
                                   "right",
                                   "ceiling",
                                   "floor",
                                   "left",
                                   "reveal",
                                   "door",
                                   "painting",
                                   "painting-frame",
                                   "wall-mirror",
                                   "wall-mirror-frame",
                                   "curtain-1",
                                   "curtain-2",
                                   "lamp-shade",
                                   "standing-mirror",
                                   "standing-mirror-frame"};
  for (const auto& part : gallery::living_room().parts) {
    EXPECT_EQ(open_edges(part.mesh) != 0, open.contains(part.name)) << part.name;
    for (const Vec3& normal : part.mesh.normals)
      ASSERT_NEAR(glm::length(normal), 1.0, 1e-9) << part.name;
  }
}

TEST(LivingRoom, IsLargeHasTwoMirrorsAndNothingOdd) {
  const Scene scene = written_and_read(gallery::glb_bytes(gallery::living_room()));
  EXPECT_THAT(scene.warnings, testing::IsEmpty());
  EXPECT_THAT(scene.ignored, testing::IsEmpty());
  EXPECT_EQ(scene.degenerate_triangles, 0U);
  EXPECT_GE(scene.triangles.size(), 300'000U);
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_GE(scene.cameras.size(), 4U);

  std::set<std::string> mirrors;
  for (const Triangle& triangle : scene.triangles)
    if (is_mirror(scene.materials[index(triangle.material)]))
      mirrors.insert(scene.nodes[index(triangle.node)].name);
  EXPECT_THAT(mirrors, testing::ElementsAre("standing-mirror", "wall-mirror"));

  const SurfaceModel surfaces = find_surfaces(scene);
  for (const Oddity& odd : report_scene(scene, surfaces, make_ray_scene(scene, surfaces)))
    ADD_FAILURE() << odd.text;
}

} // namespace
} // namespace meninas
