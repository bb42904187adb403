#include "radiosity/scene/plan.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/scene_builder.h"
#include "tests/support/skies.h"
#include "tests/support/translucent.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Scene room_with(const Material& first_wall) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0),
           {first_wall, wall, wall, diffuse(0.5, 1.0), wall, wall});
  for (Material& material : scene.materials) {
    material.name = "wall";
  }
  scene.materials[0].name = "first";
  scene.cameras.push_back(look_at({0.5, 0.5, 0.9}, {0.5, 0.5, 0.0}, 0.8));
  return scene;
}

TransportPlan plan_of(const Scene& scene) { return plan_transport(scene, find_surfaces(scene)); }

TEST(Plan, APlainRoomNeedsNothingSpecial) {
  const TransportPlan plan = plan_of(room_with(diffuse(0.5)));
  EXPECT_THAT(plan.warnings, IsEmpty());
  EXPECT_THAT(plan.mirror_list, IsEmpty());
  EXPECT_EQ(plan.emitters, 1U);
  EXPECT_EQ(plan.bands, 1);
  EXPECT_TRUE(plan.closed);
  EXPECT_THAT(plan.stages, Not(Contains(HasSubstr("mirror worlds"))));
}

TEST(Plan, AMirrorIsListedAndItsWorldEnumerated) {
  const TransportPlan plan = plan_of(room_with(mirror(0.9)));
  ASSERT_EQ(plan.mirror_list.size(), 1U);
  EXPECT_EQ(plan.mirror_list[0].name, "x0");
  EXPECT_DOUBLE_EQ(plan.mirror_list[0].area, 1.0);
  EXPECT_EQ(plan.mirror_list[0].reflectance, Rgb(0.9));
  EXPECT_THAT(plan.stages, Contains(HasSubstr("mirror worlds: 1 world of 1 mirror, 1 deep")));
  EXPECT_THAT(plan.stages, Contains("form factors: by rays, continued through mirrors"));
}

TEST(Plan, ColourAnywhereNeedsThreeBands) {
  Material coloured_mirror = mirror(0.9);
  coloured_mirror.base_color = {0.9, 0.8, 0.7};
  EXPECT_EQ(plan_of(room_with(coloured_mirror)).bands, 3);
  EXPECT_EQ(plan_of(room_with(diffuse({0.5, 0.5, 0.4}))).bands, 3);
  EXPECT_EQ(plan_of(room_with(diffuse(Rgb(0.5), {1.0, 1.0, 0.5}))).bands, 3);
}

TEST(Plan, WhatTheTwoPassesLeaveOutIsNamed) {
  Material wall = diffuse(0.5);
  wall.transmission = 0.5;
  wall.alpha_mode = AlphaMode::mask;
  wall.emissive_texture = TextureUse{.texture = TextureId{0}};
  const TransportPlan plan = plan_of(room_with(wall));
  EXPECT_EQ(plan.transmissive, 1U);
  EXPECT_EQ(plan.textured, 1U);
  EXPECT_THAT(plan.warnings, testing::ElementsAre(
                                 testing::AllOf(HasSubstr("frosted glass"), HasSubstr("'first'"))));
  EXPECT_THAT(plan.stages,
              Contains(testing::AllOf(HasSubstr("glass panes"), HasSubstr("'first'"))));
  EXPECT_THAT(plan.stages, Contains(HasSubstr("textures: of 1 material")));
}

TEST(Plan, MaterialsThatAreOnNothingDoNotCount) {
  Scene scene = room_with(diffuse(0.5));
  scene.materials.push_back(diffuse({0.1, 0.2, 0.3}));
  EXPECT_EQ(plan_of(scene).bands, 1);
}

TEST(Plan, DoubleSidedEmittersEmitTwice) {
  EXPECT_EQ(plan_of(room_with(double_sided(diffuse(0.0, 1.0)))).emitters, 3U);
}

TEST(Plan, TranslucentSurfacesAreNamed) {
  const TransportPlan one = plan_of(room_with(translucent(Rgb(0.5), 0.5, Rgb(0.5))));
  EXPECT_EQ(one.bands, 1);
  EXPECT_THAT(
      one.stages,
      Contains("translucent surfaces: 1 material passes diffuse light to the other side, in "
               "both passes: 'first'"));
  Scene scene = room_with(translucent(Rgb(0.5), 0.5, {0.5, 0.5, 0.4}));
  scene.materials[2] = scene.materials[0];
  const TransportPlan two = plan_of(scene);
  EXPECT_EQ(two.bands, 3) << "what comes through has a colour";
  EXPECT_THAT(two.stages, Contains(HasSubstr("2 materials pass diffuse light")));
}

TEST(Plan, LobesAreNamedAndWarnedAboutWhereTheyThrowShapes) {
  Material rough = mirror(0.9);
  rough.roughness = 0.4;
  const TransportPlan glossy = plan_of(room_with(rough));
  EXPECT_EQ(glossy.glossy, 1U);
  EXPECT_THAT(
      glossy.stages,
      Contains("glossy metals: grids of rays over their lobes in the picture, spread evenly "
               "in pass one: 'first'"));
  EXPECT_THAT(glossy.warnings, IsEmpty());
  rough.roughness = 0.2;
  EXPECT_THAT(
      plan_of(room_with(rough)).warnings,
      Contains("light that smooth metals throw on other surfaces is spread evenly: 'first'"));

  rough.specular_in_pass_one = true;
  const TransportPlan smooth = plan_of(room_with(rough));
  EXPECT_EQ(smooth.glossy, 1U);
  EXPECT_EQ(smooth.mirror_list.size(), 1U);
  EXPECT_THAT(smooth.warnings, IsEmpty());
  EXPECT_THAT(smooth.stages,
              Contains(testing::AllOf(HasSubstr("smooth metals"), HasSubstr("'first'"))));

  Material coated = diffuse(0.5);
  coated.roughness = 0.1;
  EXPECT_THAT(plan_of(room_with(coated)).stages,
              Contains("coats: rays over their lobes in the picture, spread evenly in pass one: "
                       "'first'"));
  coated.specular_in_pass_one = true;
  const TransportPlan polished = plan_of(room_with(coated));
  EXPECT_EQ(polished.mirror_list.size(), 1U);
  EXPECT_THAT(polished.stages, Contains("coats of large flat surfaces: rays over their lobes in "
                                        "the picture, mirrors by Schlick in pass one: 'first'"));
  EXPECT_THAT(polished.stages, testing::Not(Contains(HasSubstr("spread evenly"))));
  coated.specular_in_pass_one = false;
  coated.specular = 0.0;
  EXPECT_THAT(plan_of(room_with(coated)).stages, testing::Not(Contains(HasSubstr("coats"))));
}

TEST(Plan, MetalsWithATextureOfRoughnessAreNoMirrorsAndWarnedAbout) {
  Material metal = mirror(0.9);
  metal.metallic_roughness_texture = TextureUse{.texture = TextureId{0}};
  for (const double roughness : {0.0, 0.2, 1.0}) {
    metal.roughness = roughness;
    const TransportPlan plan = plan_of(room_with(metal));
    EXPECT_EQ(plan.glossy, 1U);
    EXPECT_THAT(plan.mirror_list, IsEmpty());
    EXPECT_THAT(plan.stages, Contains(HasSubstr("glossy metals")));
    EXPECT_THAT(
        plan.warnings,
        testing::ElementsAre(
            roughness < 1.0
                ? "light that smooth metals throw on other surfaces is spread evenly: 'first'"
                : "light that metals throw on other surfaces is spread evenly, also where a "
                  "texture makes them smooth: 'first'"));
  }
  metal.metallic = 0.0;
  EXPECT_THAT(plan_of(room_with(metal)).warnings, IsEmpty());
}

TEST(Plan, VertexColoursOfMirrorsAreWarnedAbout) {
  Material glass = diffuse(0.9);
  glass.roughness = 0.0;
  glass.transmission = 1.0;
  const auto warnings_of = [](const Material& material, glm::vec4 color) {
    Scene scene = room_with(material);
    own_attributes(scene, scene.vertices[0]).color = color;
    return plan_of(scene).warnings;
  };
  const glm::vec4 red(1.0F, 0.0F, 0.0F, 1.0F);
  EXPECT_THAT(warnings_of(mirror(0.9), red),
              testing::ElementsAre(
                  "vertex colours of mirrors are not applied to what they reflect: 'first'"));
  EXPECT_THAT(warnings_of(mirror(0.9), glm::vec4(1.0F)), IsEmpty());
  EXPECT_THAT(warnings_of(diffuse(0.9), red), IsEmpty());
  EXPECT_THAT(warnings_of(glass, red), IsEmpty()) << "it tints the glass";
}

TEST(Plan, PunctualLightsAreModelled) {
  Scene lit = room_with(diffuse(0.5));
  lit.lights.push_back({.name = "Spot"});
  EXPECT_THAT(plan_of(lit).warnings, IsEmpty());
  EXPECT_THAT(plan_of(lit).stages,
              Contains("direct light: 1 emitter and 1 point, spot or directional light"));
}

TEST(Plan, DarkScenesAndMissingCamerasAreWarnedAbout) {
  Scene scene = room_with(diffuse(0.5));
  scene.materials[3].emission = Rgb(0.0);
  scene.cameras.clear();
  EXPECT_THAT(plan_of(scene).warnings,
              testing::ElementsAre("nothing emits light: the picture will be black; "
                                   "--background 1 lights it from all around",
                                   "no camera: a default view of the whole scene is used"));
}

TEST(Plan, FacetedMirrorsAreNamed) {
  Scene scene = room_with(diffuse(0.5));
  PlanSettings settings;
  settings.mirrors.max_mirrors = 5;
  add_box(scene, "cube", Point3(0.4), Point3(0.6), mirror(0.9));
  const TransportPlan plan = plan_transport(scene, find_surfaces(scene), settings);
  EXPECT_EQ(plan.mirrors.facets, 1U);
  EXPECT_THAT(plan.warnings,
              Contains(HasSubstr(
                  "is a curved or faceted mirror of 1 plane: followed by rays, not enumerated")));
}

TEST(Plan, AMirrorOfManyNodesIsNamedByTheFirst) {
  Scene scene = room_with(diffuse(0.5));
  constexpr int count = 40;
  for (int k = 0; k < count; ++k) {
    const double x = 0.1 + 0.02 * k;
    add_polygon(scene, "tile" + std::to_string(k),
                {Point3(x, 0.4, 0.5), {x + 0.01, 0.4, 0.5}, {x + 0.01, 0.6, 0.5}, {x, 0.6, 0.5}},
                mirror(0.9));
  }
  const TransportPlan plan = plan_of(scene);
  ASSERT_EQ(plan.mirror_list.size(), 1U);
  EXPECT_EQ(plan.mirror_list[0].name, "tile0+tile1+tile2+tile3+tile4+tile5 and 34 more");
  EXPECT_EQ(plan.mirrors.mirrors[0].nodes.size(), std::size_t{count});
}

TEST(Plan, ManyFacetedMirrorsAreToldInOneLine) {
  for (const int count : {2, 5, 40}) {
    Scene scene = room_with(diffuse(0.5));
    PlanSettings settings;
    settings.mirrors.max_mirrors = 0;
    for (int k = 0; k < count; ++k) {
      const Point3 low(0.1 + 0.02 * k, 0.4, 0.4);
      add_box(scene, "bolt" + std::to_string(k), low, low + Vec3(0.01), mirror(0.9));
    }
    const auto warnings = plan_transport(scene, find_surfaces(scene), settings).warnings;
    const auto tells = [](const std::string& line) {
      return line.find("not enumerated") != std::string::npos;
    };
    ASSERT_EQ(std::ranges::count_if(warnings, tells), 1) << count;
    const std::string line = *std::ranges::find_if(warnings, tells);
    EXPECT_THAT(line, testing::StartsWith("'bolt0.x0', 'bolt0.x1', 'bolt0.y0'"));
    EXPECT_THAT(line, HasSubstr(" and " + std::to_string(6 * count - 6) + " more are curved"));
    // The boxes stand in a row: they share bottom, top, front and back, each has two of its own.
    EXPECT_THAT(line, HasSubstr(std::to_string(4 + 2 * count) + " planes"));
  }
}

TEST(Plan, SunsOfAPictureAreDirectionalLights) {
  Scene scene = room_with(solid_glass(Rgb(1.0)));
  const auto says = [&] { return plan_of(scene).warnings; };
  scene.background = sky_of([](const Direction&) { return Rgb(1.0); });
  EXPECT_THAT(says(), Not(Contains(HasSubstr("solid glass does not refract"))));
  scene.background =
      sky_of([](const Direction& d) { return Rgb(d.y > std::cos(0.02) ? 1e6 : 1.0); });
  EXPECT_THAT(says(), Contains(HasSubstr("solid glass does not refract")));
}

} // namespace
} // namespace meninas::test
