#include "radiosity/mesh/make_mesh.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/solution/solution_file.h"
#include "radiosity/solution/solution_format.h"
#include "scenes/errors.h"
#include "scenes/glb_file.h"
#include "scenes/gltf/gltf.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// A double-sided wall and a triangle, with made-up light on them.
class SolutionFile : public testing::Test {
protected:
  SolutionFile() {
    add_polygon(scene_, "wall", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                double_sided(diffuse(0.5)));
    add_polygon(scene_, "flag", {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}}, diffuse(0.25, 1.0));
    settings_.element_size = 0.3;
    surfaces_ = find_surfaces(scene_);
    mesh_ = make_element_mesh(scene_, surfaces_, settings_);
    plan_ = plan_transport(scene_, surfaces_);
    rays_.emplace(make_ray_scene(scene_, surfaces_));
    solution_.field.scene = std::make_shared<const LightScene>(
        make_light_scene(scene_, surfaces_, *rays_, {plan_.mirrors, plan_.worlds}, mesh_));
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      solution_.field.irradiance.emplace_back(1.0F / static_cast<float>(v + 1), 0.1F, 1e-30F);
      solution_.field.mirrored.emplace_back(0.5F / static_cast<float>(v + 1), 0.0F, 1e-31F);
      solution_.field.indirect.emplace_back(0.25F / static_cast<float>(v + 1), 2.0F, 0.0F);
      solution_.field.indirect_mirrored.emplace_back(0.125F / static_cast<float>(v + 1), 1.0F,
                                                     0.0F);
    }
    solution_.solver.iterations = 7;
    solution_.solver.error_bound = std::numeric_limits<double>::infinity();
    solution_.solver.relative_error = 0.03125;
    solution_.solver.residuals = {0.5, 0.25};
    solution_.energy.emitted = {1.0, 2.0, 3.0};
    solution_.closure.cut = 0.125;
    write_solution(file_, content_hash(scene_), mesh_, solution_, settings_);
  }
  ~SolutionFile() override {
    std::error_code error;
    fs::remove(file_, error);
  }

  std::string refusal() {
    try {
      check_belongs(file_, read_solution(file_, scene_), mesh_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  /// Changes the JSON of the file and keeps its data.
  void spoil(const std::function<void(json&)>& change) {
    GlbContent glb = read_glb(file_);
    change(glb.root);
    const auto bytes = glb_bytes(glb.root, std::as_bytes(std::span(glb.binary)), file_);
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  static json& extras(json& root) { return root["asset"]["extras"]["meninas"]; }

  fs::path file_ =
      fs::temp_directory_path() / ("meninas-solution-" + std::to_string(getpid()) + ".glb");
  Scene scene_;
  SurfaceModel surfaces_;
  MeshSettings settings_;
  ElementMesh mesh_;
  TransportPlan plan_;
  std::optional<RayScene> rays_;
  RadiositySolution solution_;
};

TEST_F(SolutionFile, KeepsEveryBitAndFigure) {
  const StoredSolution stored = read_solution(file_, scene_);
  EXPECT_EQ(stored.field.irradiance, solution_.field.irradiance);
  EXPECT_EQ(stored.field.mirrored, solution_.field.mirrored);
  EXPECT_EQ(stored.field.indirect, solution_.field.indirect);
  EXPECT_EQ(stored.field.indirect_mirrored, solution_.field.indirect_mirrored);
  EXPECT_EQ(stored.mesh.element_size, settings_.element_size);
  EXPECT_EQ(stored.elements, element_count(mesh_));
  EXPECT_EQ(stored.solver.iterations, 7);
  EXPECT_EQ(stored.solver.error_bound, solution_.solver.error_bound);
  EXPECT_EQ(stored.solver.relative_error, solution_.solver.relative_error);
  EXPECT_EQ(stored.solver.residuals, solution_.solver.residuals);
  EXPECT_EQ(stored.energy.emitted, solution_.energy.emitted);
  EXPECT_EQ(stored.closure.cut, 0.125);
  EXPECT_EQ(refusal(), "");
}

// A field on a mesh of its own: the file says which, and shows it to viewers without gaps.
TEST_F(SolutionFile, KeepsADividedMesh) {
  std::vector<std::uint8_t> marked(element_count(mesh_), 0);
  marked[0] = marked[5] = marked.back() = 1;
  solution_.field.scene =
      light_scene_on(solution_.field.scene, divide_elements(mesh_, surfaces_, marked));
  const ElementMesh& own = solution_.field.mesh();
  for (const FieldPart& part : field_parts)
    (solution_.field.*part.values).assign(own.vertices.size(), glm::vec3(0.5F));
  write_solution(file_, content_hash(scene_), mesh_, solution_, settings_);

  const StoredSolution stored = read_solution(file_, scene_);
  EXPECT_EQ(stored.division, division_of(own));
  EXPECT_EQ(stored.elements, element_count(own));
  EXPECT_NO_THROW(check_belongs(file_, stored, own));
  EXPECT_THROW(check_belongs(file_, stored, mesh_), InputError);

  // No vertex lies in the middle of an edge on its own side: there would be a gap.
  const Scene shown = load_gltf(file_);
  double area = 0.0;
  for (std::size_t t = 0; t < shown.triangles.size(); ++t) {
    const auto at = corners(shown, static_cast<TriangleId>(t));
    area += glm::length(area_vector(at));
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 middle = 0.5 * (at[k] + at[(k + 1) % 3]);
      for (std::size_t v = 0; v < own.vertices.size(); ++v) {
        const SideId side = own.side_of_element[index(own.element_of_vertex[v])];
        if (glm::dot(own.sides[index(side)].normal, area_vector(at)) > 0.0) {
          EXPECT_GT(glm::distance(own.vertices[v], middle), 1e-5);
        }
      }
    }
  }
  EXPECT_NEAR(area, 2.5, 1e-6);
}

// No elements, so no attributes of vertices: the file has what viewers show of the mirror alone.
TEST_F(SolutionFile, OfAMirrorAloneIsReadBack) {
  Scene scene;
  add_polygon(scene, "mirror", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, mirror(0.9));
  const SurfaceModel surfaces = find_surfaces(scene);
  const ElementMesh mesh = make_element_mesh(scene, surfaces, settings_);
  ASSERT_TRUE(mesh.vertices.empty());
  const TransportPlan plan = plan_transport(scene, surfaces);
  const RayScene rays = make_ray_scene(scene, surfaces);
  RadiositySolution solution;
  solution.field.scene = std::make_shared<const LightScene>(
      make_light_scene(scene, surfaces, rays, {plan.mirrors, plan.worlds}, mesh));
  write_solution(file_, content_hash(scene), mesh, solution, settings_);

  const StoredSolution stored = read_solution(file_, scene);
  EXPECT_TRUE(stored.field.irradiance.empty());
  EXPECT_EQ(stored.elements, 0U);
  EXPECT_NO_THROW(check_belongs(file_, stored, mesh));
  EXPECT_FALSE(load_gltf(file_).triangles.empty());
}

TEST_F(SolutionFile, IsAPictureForViewers) {
  const Scene shown = load_gltf(file_);
  EXPECT_TRUE(shown.degenerate_triangles == 0);
  Vec3 front_of_flag(0.0);
  double area = 0.0;
  for (std::size_t t = 0; t < shown.triangles.size(); ++t) {
    const auto at = corners(shown, static_cast<TriangleId>(t));
    area += glm::length(area_vector(at));
    front_of_flag += at[0].x > 1.5 ? area_vector(at) : Vec3(0.0);
  }
  // Both sides of the wall, one of the triangle; floats leave seven digits.
  EXPECT_NEAR(area, 2.5, 1e-6);
  EXPECT_NEAR(front_of_flag.z, 0.5, 1e-6);
}

TEST_F(SolutionFile, BothSidesOfAWallFaceOppositeWays) {
  const Scene shown = load_gltf(file_);
  double towards = 0.0, away = 0.0;
  for (std::size_t t = 0; t < shown.triangles.size(); ++t) {
    const auto at = corners(shown, static_cast<TriangleId>(t));
    if (at[0].x < 1.5) {
      (area_vector(at).z > 0.0 ? towards : away) += glm::length(area_vector(at));
    }
  }
  EXPECT_NEAR(towards, 1.0, 1e-6);
  EXPECT_NEAR(away, 1.0, 1e-6);
}

TEST_F(SolutionFile, OfAnotherSceneIsRefused) {
  scene_.vertices[0].position.x -= 1e-6;
  EXPECT_THAT(refusal(), HasSubstr("is not a solution of"));
}

TEST_F(SolutionFile, OfAnotherVersionIsRefused) {
  spoil([](json& root) { extras(root)["version"] = "0.0.1"; });
  EXPECT_THAT(refusal(), HasSubstr("was written by version 0.0.1"));
}

TEST_F(SolutionFile, WithoutItsFiguresIsRefused) {
  spoil([](json& root) { root["asset"].erase("extras"); });
  EXPECT_THAT(refusal(), HasSubstr("not a solution written by 'meninas solve'"));
}

TEST_F(SolutionFile, WithWrongCountsIsRefused) {
  spoil([](json& root) { extras(root)["vertices"] = 1'000'000'000; });
  EXPECT_THAT(refusal(), HasSubstr("does not hold the irradiance it announces"));
  spoil([this](json& root) {
    extras(root)["vertices"] = mesh_.vertices.size();
    extras(root)["elements"] = 1;
  });
  EXPECT_THAT(refusal(), HasSubstr("1 elements, its mesh has"));
  spoil([](json& root) { root["bufferViews"][2]["byteOffset"] = std::uint64_t{1} << 60; });
  EXPECT_THAT(refusal(), HasSubstr("does not hold the irradiance it announces"));
}

TEST_F(SolutionFile, WithCountsThatAreNoneIsRefused) {
  for (const json& count : {json(1e308), json(-1), json(double(element_count(mesh_)) + 0.25), json("3")}) {
    spoil([&](json& root) { extras(root)["elements"] = count; });
    EXPECT_THAT(refusal(), HasSubstr("not a solution written by 'meninas solve'")) << count;
  }
}

TEST_F(SolutionFile, WithSenselessSettingsIsRefused) {
  spoil([](json& root) { extras(root)["mesh"]["element_size"] = -1.0; });
  EXPECT_THAT(refusal(), HasSubstr("the settings of its mesh make no sense"));
  // A mesh of so many elements would take all memory before it is found not to be the file's.
  spoil([](json& root) {
    extras(root)["mesh"] = {
        {"element_size", 1e-4}, {"target_elements", 1.0}, {"max_elements", std::uint64_t{1} << 40}};
  });
  EXPECT_THAT(refusal(), HasSubstr("the settings of its mesh make no sense"));
}

TEST_F(SolutionFile, WithAChangedByteIsRefused) {
  std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(-8, std::ios::end);
  stream.put('\x55');
  stream.close();
  EXPECT_THAT(refusal(), HasSubstr("do not have the hash"));
}

TEST_F(SolutionFile, WithoutNumbersIsRefused) {
  solution_.field.irradiance[1].y = std::numeric_limits<float>::quiet_NaN();
  // A picture of it cannot be exposed, but what is in the file must be refused all the same.
  write_solution(file_, content_hash(scene_), mesh_, solution_, settings_);
  EXPECT_THAT(refusal(), HasSubstr("an irradiance is not finite"));
}

} // namespace
} // namespace meninas::test
