// NORMAL: which directions come out of which bytes, and how nodes, skins and targets move them.
#include "scenes/shading_normal.h"
#include "tests/scenes/gltf/gltf_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace meninas::test {
namespace {

/// The square with those normals at its four corners.
template <typename T>
GltfFile with_normals(GltfFile file, const std::vector<T>& values) {
  square_primitive(file)["attributes"]["NORMAL"] = file.add_accessor<T>(values, "VEC3");
  return file;
}

/// The same normal, of any length, at all corners.
GltfFile with_normal(const GltfFile& file, float x, float y, float z) {
  return with_normals<float>(file, {x, y, z, x, y, z, x, y, z, x, y, z});
}

Vec3 first_normal(const Scene& scene) { return Vec3(scene.vertices.at(0).normal); }

constexpr double rounding = 2e-7; // of floats near 1

TEST(GltfNormals, AreReadAndMadeUnit) {
  const auto scene = load(with_normal(square(), 0.0F, 3.0F, 4.0F));
  EXPECT_LT(glm::distance(first_normal(scene), Vec3(0.0, 0.6, 0.8)), rounding);
  EXPECT_TRUE(scene.triangles[0].curved);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfNormals, AbsentOnesAndThoseOfTheFaceAreFlat) {
  EXPECT_EQ(first_normal(load(square())), Vec3(0.0));
  EXPECT_FALSE(load(square()).triangles[0].curved);
  EXPECT_FALSE(load(with_normal(square(), 0.0F, 0.0F, 1.0F)).triangles[0].curved);
}

// Eight bits know a direction to half of 1/127 along each axis across it; the square has one
// within that, and one that no rounding explains.
TEST(GltfNormals, RoundedToBytesAreFlatWithinTheirStep) {
  const auto bytes = [](std::int8_t x, std::int8_t z) {
    auto file =
        with_normals<std::int8_t>(square(), {x, 0, z, x, 0, z, x, 0, z, x, 0, z});
    file.json["accessors"].back()["normalized"] = true;
    return load(file);
  };
  EXPECT_FALSE(bytes(1, 127).triangles[0].curved);
  EXPECT_TRUE(bytes(6, 127).triangles[0].curved);
}

// n' = A^-T n: stretched along x by 2, the plane 2 x + z = const becomes x + z = const.
TEST(GltfNormals, AreMovedByTheInverseTransposeOfTheirNode) {
  auto file = with_normal(square(), 2.0F, 0.0F, 1.0F);
  file.json["nodes"][0]["scale"] = {2.0, 1.0, 1.0};
  EXPECT_LT(glm::distance(first_normal(load(file)), glm::normalize(Vec3(1, 0, 1))), rounding);
  // A mirrored node turns its triangles round, and the front with them.
  file.json["nodes"][0]["scale"] = {-2.0, 1.0, 1.0};
  const auto mirrored = load(file);
  EXPECT_LT(glm::distance(first_normal(mirrored), glm::normalize(Vec3(-1, 0, 1))), rounding);
  EXPECT_GT(shading_normal(mirrored, TriangleId{0}, Vec2(0.2)).z, 0.0);
  // Tiny and huge nodes alike.
  for (const double scale : {1e-12, 1e12}) {
    file.json["nodes"][0]["scale"] = {scale, scale, scale};
    EXPECT_LT(glm::distance(first_normal(load(file)), glm::normalize(Vec3(2, 0, 1))), rounding);
  }
}

TEST(GltfNormals, FollowJointsAndTargets) {
  auto skinned = with_normal(skinned_square(), 0.0F, 1.0F, 1.0F);
  skinned.json["nodes"][2]["rotation"] = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)}; // about z
  EXPECT_LT(glm::distance(first_normal(load(skinned)), glm::normalize(Vec3(-1, 0, 1))), rounding);

  // The first target adds 4 along z to normals alone, the second moves positions alone.
  const auto morphed = with_normal(morphed_square(), 0.0F, 1.0F, 0.0F);
  EXPECT_LT(glm::distance(first_normal(load(morphed)), glm::normalize(Vec3(0, 1, 4))), rounding);
}

TEST(GltfNormals, ThatAreNoDirectionsAreNamedAndLeftOut) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& scene : {load(with_normal(square(), 0.0F, 0.0F, 0.0F)),
                            load(with_normal(square(), nan, 0.0F, 1.0F))}) {
    EXPECT_EQ(first_normal(scene), Vec3(0.0));
    EXPECT_FALSE(scene.triangles[0].curved);
    EXPECT_TRUE(warns(scene, {"normals", "no directions", "'Quad'"}));
  }
}

TEST(GltfNormals, TooFewEndTheReading) {
  EXPECT_THAT(error_of(with_normals<float>(square(), {0, 0, 1})),
              testing::HasSubstr("NORMAL has 1 elements, POSITION has 4"));
}

} // namespace
} // namespace meninas::test
