// Which rough metals pass one takes for mirrors.
#include "scenes/materials/smooth_surfaces.h"
#include "tests/support/metals.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

Scene plate_of(const Material& material) {
  Scene scene;
  add_polygon(scene, "plate", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, material);
  return scene;
}

bool specular_in_pass_one(Scene scene) {
  mark_smooth_surfaces(scene);
  return scene.materials[0].specular_in_pass_one;
}

TEST(SmoothMetals, AreSmootherThanTheBoundAndNoIdealMirrors) {
  EXPECT_TRUE(specular_in_pass_one(plate_of(metal(Rgb(0.9), 0.05))));
  EXPECT_TRUE(specular_in_pass_one(plate_of(metal(Rgb(0.9), smooth_metal_roughness))));
  EXPECT_FALSE(specular_in_pass_one(plate_of(metal(Rgb(0.9), smooth_metal_roughness + 0.01))));
  EXPECT_FALSE(specular_in_pass_one(plate_of(metal(Rgb(0.9), 0.0)))) << "a mirror is one without";
  EXPECT_FALSE(specular_in_pass_one(plate_of(diffuse(0.5))));
}

TEST(SmoothMetals, AreOfOneReflectance) {
  Material textured = metal(Rgb(0.9), 0.1);
  textured.metallic_roughness_texture = TextureUse{};
  EXPECT_FALSE(specular_in_pass_one(plate_of(textured)));
  Material cut_out = metal(Rgb(0.9), 0.1);
  cut_out.alpha_mode = AlphaMode::mask;
  EXPECT_FALSE(specular_in_pass_one(plate_of(cut_out)));
  Scene colored = plate_of(metal(Rgb(0.9), 0.1));
  own_attributes(colored, colored.vertices[0]).color = glm::vec4(0.5F, 1.0F, 1.0F, 1.0F);
  EXPECT_FALSE(specular_in_pass_one(colored));
}

/// A ring of so many upright plates of one material.
Scene ring(int plates, const Material& material) {
  Scene scene;
  const auto corner = [&](int k, double height) {
    const double angle = 2.0 * std::numbers::pi * k / plates;
    return Point3(std::cos(angle), height, std::sin(angle));
  };
  for (int k = 0; k < plates; ++k)
    add_polygon(scene, "plate", {corner(k, 0), corner(k + 1, 0), corner(k + 1, 1), corner(k, 1)},
                material);
  // The builder makes a material for each of them: they are to share the first.
  for (Triangle& triangle : scene.triangles)
    triangle.material = MaterialId{0};
  return scene;
}

TEST(SmoothMetals, LieInFewPlanes) {
  EXPECT_TRUE(specular_in_pass_one(ring(7, metal(Rgb(0.9), 0.2))));
  EXPECT_FALSE(specular_in_pass_one(ring(20, metal(Rgb(0.9), 0.2))))
      << "what it throws no one would find";
}

TEST(SmoothMetals, AreFlatHoweverFinelyTheyAreDivided) {
  // Tilted, in floats: the planes of small triangles differ by more than those of large ones.
  constexpr int n = 300;
  Scene scene = plate_of(metal(Rgb(0.9), 0.1));
  scene.vertices.clear();
  scene.triangles.clear();
  const Vec3 along = glm::normalize(Vec3(0.8, 0.3, 0.1)),
             across = glm::normalize(Vec3(-0.2, 0.9, 0.4));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      Vertex vertex;
      vertex.position =
          Point3(glm::vec3(Vec3(3.0, 1.0, 2.0) + (1.6 * i / n) * along + (1.6 * j / n) * across));
      scene.vertices.push_back(vertex);
    }
  const auto at = [](int i, int j) { return static_cast<VertexId>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      scene.triangles.push_back(
          {{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, MaterialId{0}, NodeId{0}});
      scene.triangles.push_back(
          {{at(i, j), at(i + 1, j + 1), at(i, j + 1)}, MaterialId{0}, NodeId{0}});
    }
  EXPECT_TRUE(specular_in_pass_one(scene));
}

TEST(SmoothMetals, DoNotEmit) {
  Material glowing = metal(Rgb(0.9), 0.1);
  glowing.emission = Rgb(1.0);
  EXPECT_FALSE(specular_in_pass_one(plate_of(glowing)));
}

TEST(SmoothMetals, AreFoundWherever) {
  const Scene far =
      transformed(ring(7, metal(Rgb(0.9), 0.2)), glm::dmat3(1.0), 1e-3, {0.5, 0.5, 0.5});
  EXPECT_TRUE(specular_in_pass_one(far));
}

} // namespace
} // namespace meninas::test
