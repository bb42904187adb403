#include "scenes/materials/normal_map.h"

#include "scenes/materials/lobes.h"
#include "scenes/shading_normal.h"
#include "tests/support/globes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// One texel that stands for a direction: x to the right of the image, y up.
DecodedTextures map_of(const Vec3& direction) {
  TexturePixels pixels{1, 1, {glm::vec4(0.5 * direction + 0.5, 1.0)}};
  return {{}, {pixels}};
}

Material mapped(double scale = 1.0) {
  Material material;
  material.normal_texture = TextureUse{.texture = TextureId{0}};
  material.normal_scale = scale;
  return material;
}

/// The unit square z = 0, front towards +z, with the image upright on it.
Scene square(const Material& material = mapped()) {
  Scene scene;
  add_polygon(scene, "square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, material);
  for (Vertex& v : scene.vertices)
    own_attributes(scene, v).texcoord[0] = {v.position.x,
                                            1.0 - v.position.y}; // v runs down the image
  scene.textures = {{.name = "map", .encoded = {}}};
  return scene;
}

Direction normal_of(const Scene& scene, const Vec3& direction) {
  return mapped_normal(scene, map_of(direction), TriangleId{0}, Vec2(0.3, 0.3));
}

constexpr double floats = 1e-6; // the texel is of floats

// Upright on a square the image's right, up and out are x, y and z.
TEST(NormalMap, TurnsTheNormalInTheFrameOfTheImage) {
  for (const Vec3& d : {Vec3(0, 0, 1), Vec3(0.6, 0.0, 0.8), Vec3(0.0, 0.6, 0.8),
                        Vec3(-0.48, 0.36, 0.8)})
    EXPECT_LT(glm::distance(normal_of(square(), d), d), floats);
}

TEST(NormalMap, ScaleIsThatOfTheSlopes) {
  const Direction n = normal_of(square(mapped(0.5)), Vec3(0.6, 0.0, 0.8));
  EXPECT_LT(glm::distance(n, glm::normalize(Vec3(0.3, 0.0, 0.8))), floats);
  EXPECT_LT(glm::distance(normal_of(square(mapped(-1.0)), Vec3(0.6, 0.0, 0.8)),
                          Vec3(-0.6, 0.0, 0.8)),
            floats);
}

// Turned by 90 degrees the image's right is the square's up; mirrored, its left.
TEST(NormalMap, FollowsTheTextureCoordinates) {
  Scene turned = square(), mirrored = square();
  for (Vertex& v : turned.vertices)
    own_attributes(turned, v).texcoord[0] = {v.position.y,
                                             v.position.x}; // right is up, down is right
  for (Vertex& v : mirrored.vertices)
    own_attributes(mirrored, v).texcoord[0].x = 1.0F - attributes_of(mirrored, v).texcoord[0].x;
  EXPECT_LT(glm::distance(normal_of(turned, Vec3(0.6, 0.0, 0.8)), Vec3(0.0, 0.6, 0.8)), floats);
  EXPECT_LT(glm::distance(normal_of(turned, Vec3(0.0, 0.6, 0.8)), Vec3(-0.6, 0.0, 0.8)), floats);
  EXPECT_LT(glm::distance(normal_of(mirrored, Vec3(0.6, 0.0, 0.8)), Vec3(-0.6, 0.0, 0.8)), floats);
  EXPECT_LT(glm::distance(normal_of(mirrored, Vec3(0.0, 0.6, 0.8)), Vec3(0.0, 0.6, 0.8)), floats);
}

// Stretched tenfold or sheared, the image's slopes are those across the surface: T and B are of
// unit length, T where u grows.
TEST(NormalMap, KeepsItsSlopesOnAStretchedImage) {
  Scene stretched = square(), sheared = square();
  for (Vertex& v : stretched.vertices)
    own_attributes(stretched, v).texcoord[0].y *= 10.0F;
  for (Vertex& v : sheared.vertices)
    own_attributes(sheared, v).texcoord[0].y += attributes_of(sheared, v).texcoord[0].x;
  for (const Scene& scene : {stretched, sheared}) {
    const Direction right = normal_of(scene, Vec3(0.6, 0.0, 0.8)),
                    up = normal_of(scene, Vec3(0.0, 0.6, 0.8));
    EXPECT_NEAR(right.z, 0.8, floats);
    EXPECT_NEAR(up.z, 0.8, floats);
    EXPECT_NEAR(glm::dot(Vec3(right.x, right.y, 0.0), Vec3(up.x, up.y, 0.0)), 0.0, floats);
  }
  EXPECT_LT(glm::distance(normal_of(stretched, Vec3(0.6, 0.0, 0.8)), Vec3(0.6, 0.0, 0.8)), floats);
  EXPECT_LT(glm::distance(normal_of(stretched, Vec3(0.0, 0.6, 0.8)), Vec3(0.0, 0.6, 0.8)), floats);
}

// A rotation of the coordinates turns the frame with the image, and repeating it changes nothing.
TEST(NormalMap, FollowsTheTextureTransform) {
  Material turned = mapped();
  turned.normal_texture->rotation = 0.5 * std::numbers::pi;
  turned.normal_texture->scale = Vec2(7.0);
  const Scene scene = square(turned);
  const Vec2 right =
      transformed_texcoord(*turned.normal_texture, Vec2(1.0, 0.0)) -
      transformed_texcoord(*turned.normal_texture, Vec2(0.0, 0.0)); // where the square's right goes
  const Vec3 on_square = glm::normalize(Vec3(right.x, -right.y, 0.0));
  const Direction n = normal_of(scene, Vec3(0.6 * on_square.x, 0.6 * on_square.y, 0.8));
  EXPECT_LT(glm::distance(n, Vec3(0.6, 0.0, 0.8)), floats);
}

TEST(NormalMap, IsTheSameInLargeAndSmallScenesAndWherever) {
  const glm::dmat3 rotation(Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0));
  const Vec3 d(0.6, 0.0, 0.8);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Scene moved = transformed(square(), rotation, scale, Vec3(3.0));
    EXPECT_LT(glm::distance(normal_of(moved, d), rotation * d), floats) << scale;
  }
}

TEST(NormalMap, SaysNothingWithoutCoordinatesOrDirection) {
  Scene without = square();
  for (Vertex& v : without.vertices)
    own_attributes(without, v).texcoord[0] = {0.5F, 0.5F};
  EXPECT_LT(glm::distance(normal_of(without, Vec3(0.6, 0.0, 0.8)), Vec3(0, 0, 1)), floats);
  EXPECT_EQ(normal_of(square(), Vec3(0.0)), Vec3(0, 0, 1));
}

TEST(NormalMap, NeverLooksBehindTheFace) {
  for (const Vec3& d : {Vec3(0.8, 0.0, -0.6), Vec3(0, 0, -1), Vec3(1, 0, 0)}) {
    const Direction n = normal_of(square(), d);
    EXPECT_NEAR(glm::length(n), 1.0, floats);
    EXPECT_GT(n.z, 0.01);
  }
}

// On a curve the frame stands on the shading normal.
TEST(NormalMap, StandsOnTheCurve) {
  Scene globe;
  add_globe(globe, "globe", {}, mapped(), GivenNormals::smooth);
  for (Vertex& v : globe.vertices)
    own_attributes(globe, v).texcoord[0] = {std::atan2(v.position.z, v.position.x),
                                            std::acos(v.position.y)};
  globe.textures = {{.name = "map", .encoded = {}}};
  for (std::uint32_t t = 0; t < globe.triangles.size(); t += 7) {
    const Direction flat = mapped_normal(globe, map_of(Vec3(0, 0, 1)), TriangleId{t}, Vec2(0.3));
    EXPECT_LT(glm::distance(flat, shading_normal(globe, TriangleId{t}, Vec2(0.3))), floats);
  }
}

// --- The axis of anisotropic facets

Material brushed() {
  Material material;
  material.anisotropy = 0.5;
  return material;
}

/// In the world, on the square.
Vec3 axis_on(const Scene& scene, Vec2 direction, const Direction& normal = {0, 0, 1}) {
  const Vec2 axis = facet_axis(scene, TriangleId{0}, Vec2(0.3, 0.3), direction, normal);
  return to_world(normal, {axis.x, axis.y, 0.0});
}

TEST(FacetAxis, LiesInTheFrameOfTheImage) {
  const Vec2 d(0.6, 0.8);
  EXPECT_LT(glm::distance(axis_on(square(brushed()), d), Vec3(0.6, 0.8, 0.0)), floats);
  // Turned by 90 degrees the image's right is the square's up, and its up the square's left.
  Scene turned = square(brushed());
  for (Vertex& v : turned.vertices)
    own_attributes(turned, v).texcoord[0] = {v.position.y, v.position.x};
  EXPECT_LT(glm::distance(axis_on(turned, d), Vec3(-0.8, 0.6, 0.0)), floats);
  // From behind it is the same line.
  EXPECT_LT(glm::distance(axis_on(square(brushed()), d, {0, 0, -1}), Vec3(0.6, 0.8, 0.0)), floats);
}

TEST(FacetAxis, FollowsTangentsThatAreGiven) {
  Scene scene = square(brushed());
  scene.tangents.assign(4, glm::vec4(0, 1, 0, -1));
  EXPECT_LT(glm::distance(axis_on(scene, {1.0, 0.0}), Vec3(0, 1, 0)), floats);
  EXPECT_LT(glm::distance(axis_on(scene, {0.0, 1.0}), Vec3(1, 0, 0)), floats);
}

TEST(FacetAxis, IsLaidFlatOnTheNormal) {
  const Direction leaning = glm::normalize(Vec3(0.6, 0.0, 0.8));
  const Vec3 axis = axis_on(square(brushed()), {1.0, 0.0}, leaning);
  EXPECT_LT(glm::distance(axis, Vec3(0.8, 0.0, -0.6)), floats);
}

TEST(FacetAxis, IsLevelWithoutTextureCoordinates) {
  Scene wall = square(brushed());
  for (Vertex& v : wall.vertices)
    own_attributes(wall, v).texcoord[0] = glm::vec2(0.0F);
  EXPECT_LT(glm::distance(axis_on(wall, {1.0, 0.0}), Vec3(1, 0, 0)), floats);
  EXPECT_EQ(level_tangent({0, 1, 0}), Vec3(1, 0, 0));
  EXPECT_EQ(level_tangent({1, 0, 0}), Vec3(0, 0, -1));
}

} // namespace
} // namespace meninas::test
