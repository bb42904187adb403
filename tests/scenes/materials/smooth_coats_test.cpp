// Which coats pass one takes for mirrors.
#include "scenes/materials/lobes.h"
#include "scenes/materials/smooth_surfaces.h"
#include "tests/support/coats.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace meninas::test {
namespace {

/// A sheet of one square metre before a wall of so many.
Scene sheet_of(const Material& material, double wall = 4.0) {
  Scene scene;
  add_polygon(scene, "sheet", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, material);
  add_polygon(scene, "wall", {{0, 0, -1}, {wall, 0, -1}, {wall, 1, -1}, {0, 1, -1}}, diffuse(0.5));
  return scene;
}

bool is_marked(Scene scene) {
  mark_smooth_surfaces(scene);
  return has_mirror_coat(scene.materials[0]);
}

TEST(SmoothCoats, AreThoseThatShow) {
  EXPECT_TRUE(is_marked(sheet_of(coated(Rgb(0.5), 0.0))));
  EXPECT_TRUE(is_marked(sheet_of(coated(Rgb(0.5), visible_coat_roughness))));
  EXPECT_FALSE(is_marked(sheet_of(coated(Rgb(0.5), visible_coat_roughness + 0.01))));
  Material bare = coated(Rgb(0.5), 0.0);
  bare.specular = 0.0;
  EXPECT_FALSE(is_marked(sheet_of(bare)));
  bare.specular = 0.05;
  EXPECT_FALSE(is_marked(sheet_of(bare))) << "a hundredth of the light and less";
}

TEST(SmoothCoats, AreOfOneReflectance) {
  Material painted = coated(Rgb(0.5), 0.1);
  painted.base_color_texture = TextureUse{};
  EXPECT_TRUE(is_marked(sheet_of(painted))) << "the picture is below the coat";
  Material worn = coated(Rgb(0.5), 0.1);
  worn.metallic_roughness_texture = TextureUse{};
  EXPECT_FALSE(is_marked(sheet_of(worn)));
  Material glowing = coated(Rgb(0.5), 0.1);
  glowing.emission = Rgb(1.0);
  EXPECT_FALSE(is_marked(sheet_of(glowing)));
  Material cut_out = coated(Rgb(0.5), 0.1);
  cut_out.alpha_mode = AlphaMode::mask;
  EXPECT_FALSE(is_marked(sheet_of(cut_out)));
  Material glass = coated(Rgb(0.5), 0.0);
  glass.transmission = 0.5;
  EXPECT_FALSE(is_marked(sheet_of(glass))) << "which reflects as a pane does";
}

TEST(SmoothCoats, CoverAShareOfTheScene) {
  EXPECT_TRUE(is_marked(sheet_of(coated(Rgb(0.5), 0.0), 190.0)));
  EXPECT_FALSE(is_marked(sheet_of(coated(Rgb(0.5), 0.0), 210.0)));
}

TEST(SmoothCoats, LieInFewPlanes) {
  // A turned leg of twenty facets, however large.
  Scene scene;
  const auto corner = [&](int k, double height) {
    const double angle = 2.0 * std::numbers::pi * k / 20;
    return Point3(std::cos(angle), height, std::sin(angle));
  };
  for (int k = 0; k < 20; ++k)
    add_polygon(scene, "facet", {corner(k, 0), corner(k + 1, 0), corner(k + 1, 1), corner(k, 1)},
                coated(Rgb(0.5), 0.0));
  for (Triangle& triangle : scene.triangles)
    triangle.material = MaterialId{0};
  EXPECT_FALSE(is_marked(scene));
}

TEST(SmoothCoats, OfManyTheLargestAreTaken) {
  // Thirty table tops, each of a wood of its own and larger than the one before.
  Scene scene;
  for (int k = 0; k < 30; ++k)
    add_polygon(scene, "top",
                {{0, k, 1.0 + 0.01 * k}, {1, k, 1.0 + 0.01 * k}, {1, k, 0}, {0, k, 0}},
                coated(Rgb(0.5), 0.0));
  mark_smooth_surfaces(scene);
  for (std::size_t k = 0; k < 30; ++k)
    EXPECT_EQ(has_mirror_coat(scene.materials[k]), k >= 30 - max_coat_planes) << k;
}

TEST(SmoothCoats, TakeTheirShareFromWhatIsSpread) {
  const Material even = coated(Rgb(0.6), 0.0), sharp = polished(Rgb(0.6));
  const double below = 0.6 * (1.0 - mean_coat_reflectance);
  EXPECT_NEAR(diffuse_reflectance(sharp).g, below, 1e-12);
  EXPECT_NEAR(diffuse_reflectance(even).g, below + mean_coat_reflectance, 1e-12);
  const Bsdf coat = mirror_coat(sharp);
  EXPECT_NEAR(mean_shares(coat).reflected.g, mean_coat_reflectance, 1e-12);
  for (const double cosine : {0.05, 0.3, 1.0})
    EXPECT_NEAR(coat_transmittance(coat, cosine).g,
                (1.0 - coat_reflectance(cosine)) / (1.0 - mean_coat_reflectance), 1e-12);
  Scene scene = sheet_of(coated(Rgb(0.5), 0.0));
  mark_smooth_surfaces(scene);
  spread_coats(scene);
  EXPECT_FALSE(has_mirror_coat(scene.materials[0]));
}

} // namespace
} // namespace meninas::test
