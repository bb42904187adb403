// Looks: what a shader makes of them is what the materials reflect.
#include "runs/walk/walk_looks.h"

#include "scenes/materials/lobes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas {
namespace {

WalkLook look_of(const Material& material, WalkFace face = WalkFace::plain) {
  Scene scene;
  scene.materials.push_back(material);
  return walk_look(scene, no_textures(), MaterialId{0}, face);
}

TEST(WalkLooks, ReflectAsPassOneDoes) {
  for (const double metallic : {0.0, 0.4, 1.0})
    for (const double roughness : {0.15, 0.5, 1.0}) {
      Material material;
      material.base_color = {0.8, 0.5, 0.2};
      material.metallic = metallic;
      material.roughness = roughness;
      const WalkLook look = look_of(material);
      const bool is_metal = metallic > 0.0;
      EXPECT_EQ(look.kind, is_metal ? WalkKind::glossy : WalkKind::plain);
      // Of what has a lobe the page adds that; from one side it is not what it is in the mean.
      const Rgb rho = look.albedo + look.rest + (is_metal ? look.reflectance : Rgb(0.0));
      const Rgb wanted = diffuse_reflectance(material);
      for (int band = 0; band < 3; ++band)
        EXPECT_NEAR(rho[band], wanted[band], is_metal ? 0.02 : 1e-12)
            << metallic << ' ' << roughness;
    }
}

// Light goes back from the first facet (f90 of it) or is spread by the facets among one another (f0): the rougher, the more.
TEST(WalkLooks, AMetalSpreadsWhatItsFacetsDoNotThrowBackAtOnce) {
  double before = 1.0;
  for (const double roughness : {0.2, 0.4, 0.7, 1.0}) {
    Material metal;
    metal.base_color = {0.8, 0.5, 0.2};
    metal.metallic = 1.0;
    metal.roughness = roughness;
    const WalkLook look = look_of(metal);
    ASSERT_EQ(look.kind, WalkKind::glossy);
    EXPECT_LT(look.f90, before);
    before = look.f90;
    const Rgb wanted = diffuse_reflectance(metal);
    for (int band = 0; band < 3; ++band) {
      EXPECT_NEAR(look.reflectance[band], look.f90 * metal.base_color[band], 0.02) << roughness;
      EXPECT_NEAR(look.f0[band] + look.reflectance[band], wanted[band], 0.02) << roughness;
    }
  }
}

TEST(WalkLooks, AMirrorHasItsReflectanceAndNothingElse) {
  Material silver;
  silver.base_color = {0.93, 0.92, 0.9};
  silver.metallic = 1.0;
  silver.roughness = 0.0;
  const WalkLook look = look_of(silver, WalkFace::mirror);
  EXPECT_EQ(look.kind, WalkKind::mirror);
  EXPECT_EQ(look.reflectance, silver.base_color);
  EXPECT_EQ(look.albedo + look.rest, Rgb(0.0));
  EXPECT_EQ(look_of(silver, WalkFace::facet).kind, WalkKind::curved);
}

TEST(WalkLooks, ACoatHasSchlicksTerms) {
  Material floor;
  floor.base_color = {0.4, 0.3, 0.2};
  floor.roughness = 0.05;
  floor.specular_in_pass_one = true;
  const WalkLook look = look_of(floor, WalkFace::mirror);
  EXPECT_EQ(look.kind, WalkKind::coat);
  // ((1.5 - 1) / (1.5 + 1))^2
  EXPECT_NEAR(look.f0.r, 0.04, 1e-12);
  EXPECT_NEAR(look.f90, 1.0, 1e-12);
  EXPECT_EQ(look.albedo + look.rest, floor.base_color) << "what gets below the coat scatters so";
}

TEST(WalkLooks, PanesSolidsAndCoverageAreToldApart) {
  Material pane;
  pane.transmission = 1.0;
  pane.double_sided = true;
  pane.base_color = {0.35, 0.9, 0.5};
  EXPECT_EQ(look_of(pane, WalkFace::mirror).kind, WalkKind::pane);
  EXPECT_EQ(look_of(pane, WalkFace::mirror).tint, pane.base_color);
  pane.thickness = 0.1;
  pane.attenuation_color = {0.25, 0.5, 1.0};
  pane.attenuation_distance = 2.0;
  const WalkLook solid = look_of(pane);
  EXPECT_EQ(solid.kind, WalkKind::solid);
  EXPECT_NEAR(solid.reflectance.r, std::log(0.5), 1e-12) << "a metre is half of the distance";
  Material glow;
  glow.alpha_mode = AlphaMode::blend;
  glow.alpha = 0.25;
  glow.transmission = 0.75;
  glow.emission = Rgb(0.25); // as read: the share is in it
  EXPECT_EQ(look_of(glow).emission, Rgb(1.0)) << "of which the page shows alpha";
  pane.attenuation_distance = 1e-4;
  EXPECT_NEAR(look_of(pane).reflectance.r, std::log(0.25) / 1e-4, 1e-8)
      << "what absorbs within millimetres has a number, too";
  glow.unlit = true;
  glow.base_color = Rgb(0.5);
  EXPECT_EQ(look_of(glow).kind, WalkKind::unlit_covering);
  EXPECT_EQ(look_of(glow).albedo, Rgb(0.5));
  EXPECT_EQ(look_of(glow).alpha, 0.25);
  Material leaf;
  leaf.alpha_mode = AlphaMode::mask;
  leaf.alpha_cutoff = 0.3;
  EXPECT_EQ(look_of(leaf).cutoff, 0.3);
}

} // namespace
} // namespace meninas
