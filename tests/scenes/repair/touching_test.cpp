// Which of two things in one plane comes first.
#include "scenes/ies/intensity_distribution.h"
#include "scenes/repair/glass_plates.h"
#include "scenes/punctual_light.h"
#include "scenes/rays/ray_scene.h"
#include "scenes/repair/touching.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

namespace meninas::test {
namespace {

Material glass(double thickness = 0.0) {
  Material material;
  material.name = "glass";
  material.base_color = Rgb(1.0);
  material.roughness = 0.0;
  material.transmission = 1.0;
  material.double_sided = true;
  material.thickness = thickness;
  return material;
}

std::vector<Point3> wall_quad(double z, double half = 1.0) {
  return {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
}

/// A wall, so that the scene is of metres, and what hangs before it.
Scene wall_with(const Material& hanging, double z) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, -1.5, 4}, {2, -1.5, 4}, {2, -1.5, 0}, {-2, -1.5, 0}},
              diffuse(0.5));
  add_polygon(scene, "hanging", wall_quad(z), hanging);
  return scene;
}

/// The nodes that a ray from the room meets one after another, as far as the third.
std::vector<std::string> met_along(const Scene& scene, Point3 from, const Direction& direction) {
  const SurfaceModel surfaces = find_surfaces(scene);
  const RayScene rays = make_ray_scene(scene, surfaces);
  std::vector<std::string> names;
  PlaneId leaving = none<PlaneId>;
  while (names.size() < 3) {
    const auto hit = closest_hit(rays, {from, direction, leaving});
    if (!hit)
      break;
    names.push_back(scene.nodes[index(scene.triangles[index(hit->triangle)].node)].name);
    leaving = surfaces.plane_of_triangle[index(hit->triangle)];
    from += hit->distance * direction;
  }
  return names;
}

using Names = std::vector<std::string>;
const Direction obliquely = glm::normalize(Vec3(0.1, 0.05, -1.0));

TEST(Touching, APaneWithTheCornersOfAMirrorIsBeforeIt) {
  for (const Material& below : {mirror(0.9), diffuse(0.5), double_sided(mirror(0.9))}) {
    Scene scene = wall_with(below, 0.0);
    add_polygon(scene, "pane", wall_quad(0.0), glass());
    EXPECT_EQ(separate_touching(scene), std::vector{NodeId{2}});
    for (const double x : {-0.6, 0.0, 0.31})
      EXPECT_EQ(met_along(scene, {x, 0.2, 2.0}, obliquely), (Names{"pane", "hanging"}));
  }
}

TEST(Touching, APaneThatLooksTheOtherWayIsBeforeTheFrontOfAMirrorAllTheSame) {
  Scene scene = wall_with(mirror(0.9), 0.0);
  auto turned = wall_quad(3e-6);
  std::ranges::reverse(turned);
  add_polygon(scene, "pane", turned, glass());
  separate_touching(scene);
  EXPECT_EQ(met_along(scene, {0.1, 0.2, 2.0}, obliquely), (Names{"pane", "hanging"}));
}

TEST(Touching, ASlabOnASilverGoesOffItWithItsWholeBack) {
  Scene scene = wall_with(mirror(0.9), 0.0);
  add_box(scene, "slab", {-0.9, -0.9, 0.0}, {0.9, 0.9, 0.2}, glass(0.2));
  separate_touching(scene);
  EXPECT_EQ(met_along(scene, {0.1, 0.2, 2.0}, obliquely), (Names{"slab.z1", "slab.z0", "hanging"}));
}

TEST(Touching, ALampInTheCeilingsPlaneIsBeforeIt) {
  for (const double off : {0.0, 4e-6, -4e-6})
    for (const bool two_sides : {false, true}) {
      Scene scene = wall_with(two_sides ? double_sided(diffuse(0.5)) : diffuse(0.5), 0.0);
      add_polygon(scene, "lamp", wall_quad(off, 0.3), diffuse(0.0, 10.0));
      separate_touching(scene);
      EXPECT_EQ(met_along(scene, {0.05, 0.02, 2.0}, {0, 0, -1}), (Names{"lamp", "hanging"}))
          << off << two_sides;
    }
}

TEST(Touching, TwoSidesOfASheetStayTogether) {
  Scene scene = wall_with(diffuse(0.5), 0.0);
  auto turned = wall_quad(0.0);
  std::ranges::reverse(turned);
  add_polygon(scene, "lamp", turned, diffuse(0.0, 10.0));
  EXPECT_TRUE(separate_touching(scene).empty());
}

TEST(Touching, WhatIsBesideOrApartStaysWhereItIs) {
  Scene scene = wall_with(mirror(0.9), 0.0);
  add_polygon(scene, "apart", wall_quad(1e-4), glass());
  add_polygon(scene, "beside", {{1, -1, 0}, {1.5, -1, 0}, {1.5, 1, 0}, {1, 1, 0}}, glass());
  EXPECT_TRUE(separate_touching(scene).empty());
}

PunctualLight light_at(double z, PunctualKind kind) {
  PunctualLight light{.name = "light", .kind = kind};
  light.position = {0.2, 0.1, z};
  light.direction = {0.0, 0.0, 1.0};
  return light;
}

TEST(Touching, LightsInAFaceShineBeforeIt) {
  const Point3 there(0.5, 0.4, 2.0);
  for (const double off : {0.0, -1e-7, 1e-7, -8e-6, 8e-6})
    for (const auto kind : {PunctualKind::spot, PunctualKind::point})
      for (const bool two_sides : {false, true}) {
        if (two_sides && kind == PunctualKind::point && off < -1e-7)
          continue; // a point light behind a face of two sides is meant to be there
        Scene scene = wall_with(two_sides ? double_sided(diffuse(0.5)) : diffuse(0.5), 0.0);
        scene.position_error = 1e-7; // as of floats at some metres
        scene.lights.push_back(light_at(off, kind));
        const PunctualSample free = punctual_sample(scene.lights[0], there, 10.0);
        EXPECT_EQ(settle_lights(scene).size(), 1u);
        const SurfaceModel surfaces = find_surfaces(scene);
        const PunctualSample seen = punctual_sample(scene.lights[0], there, 10.0);
        EXPECT_FALSE(occluded(make_ray_scene(scene, surfaces), {there, seen.position})) << off;
        // Half of a point light falls on the face, which reflects half of that by Lambert's law.
        const double cosine = 2.0 / glm::distance(there, {0.2, 0.1, 0.0});
        const double wanted =
            (kind == PunctualKind::point ? 1.0 + 2.0 * 0.5 * cosine : 1.0) * free.irradiance.r;
        // The distance is another by two touches, 6e-5 m of 2 m.
        EXPECT_NEAR(seen.irradiance.r, wanted, 2e-4 * wanted);
        // At its foot there is none of it.
        EXPECT_EQ(punctual_sample(scene.lights[0], {0.2, 0.1, 0.0}, 10.0).irradiance.r, 0.0);
      }
}

/// The foot's reflectance of a light in the plane of these faces, in this order.
Rgb foot_reflectance(const std::vector<std::pair<Material, bool>>& faces_that_turn, bool black_vertices = false) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, -1.5, 4}, {2, -1.5, 4}, {2, -1.5, 0}, {-2, -1.5, 0}}, diffuse(0.5));
  for (const auto& [material, turns] : faces_that_turn) {
    auto quad = wall_quad(0.0);
    if (turns)
      std::ranges::reverse(quad);
    add_polygon(scene, "face", quad, material);
  }
  if (black_vertices)
    for (Vertex& vertex : scene.vertices)
      own_attributes(scene, vertex).color = {0.0F, 0.0F, 0.0F, 1.0F};
  scene.lights.push_back(light_at(0.0, PunctualKind::point));
  settle_lights(scene);
  return scene.lights[0].foot_reflectance;
}

TEST(Touching, WhatComesFromTheFootOfALightIsWhatItsOwnFaceReflects) {
  Material red = diffuse(0.5);
  red.base_color = {0.8, 0.4, 0.1};
  EXPECT_EQ(foot_reflectance({{red, false}}), diffuse_reflectance(red));
  // A floor without thickness: a ceiling below, another floor above. The light shines before the first.
  EXPECT_EQ(foot_reflectance({{red, false}, {diffuse(0.1), true}}), diffuse_reflectance(red));
  EXPECT_EQ(foot_reflectance({{diffuse(0.1), true}, {red, false}}), diffuse_reflectance(diffuse(0.1)));
  // What a face reflects that is not the same everywhere is not known at the foot.
  EXPECT_EQ(foot_reflectance({{red, false}}, true), Rgb(0.0));
}

TEST(Touching, ASpotShinesToItsSideOfAFaceOfTwo) {
  Scene scene = wall_with(double_sided(diffuse(0.5)), 0.0);
  scene.lights.push_back(light_at(5e-6, PunctualKind::spot));
  scene.lights[0].direction = {0.0, 0.0, -1.0};
  settle_lights(scene);
  EXPECT_LT(scene.lights[0].position.z, -1e-5);
}

TEST(Touching, ALuminaireShinesToTheSideThatItAimsAtAlone) {
  Scene scene = wall_with(double_sided(diffuse(0.5)), 0.0);
  PunctualLight light = light_at(0.0, PunctualKind::point);
  light.direction = {0.0, 0.0, -1.0};
  light.distribution = std::make_shared<const IntensityDistribution>(
      IntensityDistribution{Photometry::type_c, {0.0, 180.0}, {0.0}, {100.0, 100.0}});
  scene.lights.push_back(light);
  settle_lights(scene);
  EXPECT_LT(scene.lights[0].position.z, -1e-5) << "as a spot does";
  EXPECT_GT(punctual_sample(scene.lights[0], {0.5, 0.4, -2.0}, 10.0).irradiance.r, 0.0);
  EXPECT_EQ(punctual_sample(scene.lights[0], {0.2, 0.1, 0.0}, 10.0).irradiance.r, 0.0)
      << "not at its foot, where its candela backwards would be any number of lux";
}

TEST(Touching, LightsOffAllFacesStay) {
  Scene scene = wall_with(diffuse(0.5), 0.0);
  scene.lights.push_back(light_at(5e-3, PunctualKind::point));
  EXPECT_TRUE(settle_lights(scene).empty());
  EXPECT_EQ(scene.lights[0].kind, PunctualKind::point);
}

Scene slab_on(double gap, double thickness, const Material& below) {
  Scene scene = wall_with(below, 0.0);
  add_box(scene, "slab", {-0.9, -0.9, gap}, {0.9, 0.9, gap + thickness}, glass(thickness));
  return scene;
}

TEST(GlassPlates, OnAMirrorOrAPrintArePanes) {
  for (const double gap : {0.0, 1e-4, 3e-3})
    for (const Material& below : {mirror(0.9), double_sided(diffuse(0.5))}) {
      Scene scene = slab_on(gap, 0.006, below);
      EXPECT_EQ(plates_to_panes(scene).size(), 1u) << gap;
      EXPECT_EQ(met_along(scene, {0.1, 0.2, 2.0}, obliquely), (Names{"slab.z1", "hanging"}));
      for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        EXPECT_FALSE(is_solid_glass(material_of(scene, TriangleId{t})));
    }
}

TEST(GlassPlates, KeepTheirColour) {
  Scene scene = slab_on(1e-4, 0.006, mirror(0.9));
  for (Material& material : scene.materials)
    if (is_glass(material)) {
      material.attenuation_color = {0.8, 0.95, 0.85};
      material.attenuation_distance = 0.1;
    }
  plates_to_panes(scene);
  const Material& pane = scene.materials.back();
  EXPECT_NEAR(pane.base_color.r, std::pow(0.8, 1.1 * 0.06), 1e-9);
  EXPECT_NEAR(pane.base_color.g, std::pow(0.95, 1.1 * 0.06), 1e-9);
}

TEST(GlassPlates, ThatStandFreeOrAreThickStaySolids) {
  Scene free = slab_on(0.05, 0.006, mirror(0.9));
  EXPECT_TRUE(plates_to_panes(free).empty());
  Scene thick = slab_on(0.0, 0.1, mirror(0.9));
  EXPECT_TRUE(plates_to_panes(thick).empty());
}

} // namespace
} // namespace meninas::test
