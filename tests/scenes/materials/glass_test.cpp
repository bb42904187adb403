// Glass by closed forms:
// Fresnel's law, the sum of what goes to and fro in a pane, and what crosses a leg.
#include "scenes/materials/glass.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/refraction.h"
#include "scenes/rays/glass_crossings.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

TEST(Glass, FresnelIsThatOfTheAngles) {
  for (const double ior : {1.1, 1.5, 2.4})
    for (const double cosine : {1.0, 0.8, 0.5, 0.1})
      EXPECT_NEAR(fresnel(ior, cosine), face_reflectance(ior, cosine), 1e-12)
          << ior << ' ' << cosine;
  EXPECT_EQ(fresnel(1.5, 0.0), 1.0);
}

TEST(Glass, FromInsideAsFromOutside) {
  // Reversibility: the same face, met at the angle of refraction.
  for (const double cosine : {1.0, 0.7, 0.2}) {
    const double behind = std::sqrt(1.0 - (1.0 - cosine * cosine) / 2.25);
    EXPECT_NEAR(fresnel(1.0 / 1.5, behind), fresnel(1.5, cosine), 1e-12);
  }
  // Beyond asin(1 / 1.5) = 41.8 degrees all of it is reflected.
  EXPECT_LT(fresnel(1.0 / 1.5, std::cos(0.70)), 0.3);
  EXPECT_EQ(fresnel(1.0 / 1.5, std::cos(0.75)), 1.0);
}

TEST(Glass, APaneIsTheSumOfWhatGoesToAndFro) {
  for (const double tint : {1.0, 0.8, 0.1})
    for (const double cosine : {1.0, 0.6, 0.15}) {
      Glass pane;
      pane.tint = Rgb(tint);
      const GlassShares shares = glass_shares(pane, cosine);
      const double f = face_reflectance(1.5, cosine);
      double inside = (1.0 - f) * tint, passed = 0.0, reflected = f;
      for (int way = 0; way < 200; ++way) {
        (way % 2 == 0 ? passed : reflected) += inside * (1.0 - f);
        inside *= f * tint;
      }
      EXPECT_NEAR(shares.passed.g, passed, 1e-12);
      EXPECT_NEAR(shares.reflected.g, reflected, 1e-12);
      if (tint == 1.0) {
        EXPECT_NEAR(shares.passed.g + shares.reflected.g, 1.0, 1e-15);
      }
    }
}

TEST(Glass, WithoutContrastThereIsNoPane) {
  Glass air{.ior = 1.0, .f0 = Rgb(0.0)};
  for (const double cosine : {1.0, 0.3, 1e-3, 0.0}) {
    EXPECT_EQ(glass_shares(air, cosine).passed, Rgb(1.0));
    EXPECT_EQ(glass_shares(air, cosine).reflected, Rgb(0.0));
  }
}

TEST(Glass, ThatReflectsAllPassesNothing) {
  const Glass foil{.ior = 0.0, .f0 = Rgb(1.0)};
  EXPECT_EQ(glass_shares(foil, 0.7).passed, Rgb(0.0));
  EXPECT_EQ(glass_shares(foil, 0.7).reflected, Rgb(1.0));
  EXPECT_EQ(glass_shares(Glass{}, 0.0).passed, Rgb(0.0));
  EXPECT_EQ(glass_shares(Glass{}, 0.0).reflected, Rgb(1.0));
}

TEST(Glass, TheMeanOverAllAngles) {
  // Of one face of ior 1.5: 0.0918 (Duntley 1942).
  Glass face;
  face.faces = GlassFaces::one;
  EXPECT_NEAR(mean_glass_shares(face).reflected.g, 0.0918, 1e-4);
}

/// A solid's face: light that leaves it towards `out`,
/// a unit vector above the normal, has come along this direction (which points back).
std::optional<Direction> refracted(const Direction& out, const Direction& normal, double ior) {
  Glass face{.ior = ior};
  face.faces = GlassFaces::one;
  const auto behind = direction_behind(face, to_local(normal, out));
  return behind ? std::optional(to_world(normal, *behind)) : std::nullopt;
}

TEST(Glass, LightThroughASlabIsShiftedButNotTurned) {
  // d = t sin a (1 - cos a / (n cos b)),  sin a = n sin b
  constexpr double ior = 1.5, thickness = 0.3;
  const Direction up(0, 0, 1);
  for (const double a : {0.1, 0.7, 1.4}) {
    const Direction out(std::sin(a), 0.0, std::cos(a));
    const auto inside = refracted(out, up, ior);
    ASSERT_TRUE(inside);
    const auto beyond = refracted(-*inside, up, 1.0 / ior);
    ASSERT_TRUE(beyond);
    EXPECT_LT(glm::distance(*beyond, -out), 1e-12);
    const double b = std::asin(std::sin(a) / ior);
    const Point3 leaves = *inside * (-thickness / inside->z);
    const Vec3 shift = leaves - glm::dot(leaves, out) * out;
    EXPECT_NEAR(glm::length(shift),
                thickness * std::sin(a) * (1.0 - std::cos(a) / (ior * std::cos(b))), 1e-12);
  }
}

TEST(Glass, ABallGathersParallelLightAtItsFocus) {
  // n R / (2 (n - 1)) from its centre, of rays near the axis.
  for (const double ior : {1.33, 1.5, 1.9}) {
    constexpr double height = 1e-4;
    const Direction in(0, 0, -1);
    const Point3 enters(height, 0.0, std::sqrt(1.0 - height * height));
    const auto inside = refracted(-in, enters, ior);
    ASSERT_TRUE(inside);
    const Point3 leaves = enters - 2.0 * glm::dot(*inside, enters) * *inside;
    const auto beyond = refracted(-*inside, -leaves, 1.0 / ior);
    ASSERT_TRUE(beyond);
    const Point3 axis = leaves - leaves.x / beyond->x * *beyond;
    EXPECT_NEAR(-axis.z, ior / (2.0 * (ior - 1.0)), 1e-6) << ior;
  }
}

TEST(Glass, BeyondTheAngleOfTotalReflectionNothingPasses) {
  Bsdf face;
  face.pane.faces = GlassFaces::one;
  const Glass inside = from_behind(face).pane;
  const double limit = std::asin(1.0 / 1.5);
  for (const double angle : {limit + 1e-6, 0.9, 1.5}) {
    const Direction out(std::sin(angle), 0.0, std::cos(angle));
    EXPECT_FALSE(direction_behind(inside, out));
    EXPECT_EQ(glass_shares(inside, out.z).reflected, Rgb(1.0));
    EXPECT_EQ(glass_shares(inside, out.z).passed, Rgb(0.0));
  }
  EXPECT_TRUE(direction_behind(inside, {std::sin(limit - 1e-6), 0.0, std::cos(limit - 1e-6)}));
}

TEST(Glass, WhatIsLeftAfterSomeMetres) {
  Material material;
  material.attenuation_color = {0.25, 0.5, 1.0};
  material.attenuation_distance = 2.0;
  EXPECT_NEAR(attenuation(material, 1.0).r, 0.5, 1e-15);
  EXPECT_NEAR(attenuation(material, 4.0).g, 0.25, 1e-15);
  EXPECT_EQ(attenuation(material, 4.0).b, 1.0);
  EXPECT_EQ(attenuation(Material{}, 1e6), Rgb(1.0));
}

TEST(Glass, ALegCrossesEveryPaneOnceAndIsNotBlocked) {
  Scene scene;
  for (const double y : {1.0, 1.5})
    add_polygon(scene, "pane", {{-1, y, 1}, {1, y, 1}, {1, y, -1}, {-1, y, -1}}, glass(Rgb(1.0)));
  add_polygon(scene, "floor", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, diffuse(0.5));
  const SurfaceModel surfaces = find_surfaces(scene);
  const RayScene rays = make_ray_scene(scene, surfaces);
  const PlaneId floor = surfaces.plane_of_triangle.back();
  const Leg leg{Point3(0.0), {0.5, 2.0, 0.0}, floor};
  EXPECT_FALSE(occluded(rays, leg));
  std::vector<GlassCrossing> crossings;
  glass_crossings(rays, leg, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  // Both are quads of two triangles, whose diagonal the leg does not meet.
  EXPECT_NEAR(crossings[0].cosine, 2.0 / std::hypot(0.5, 2.0), 1e-6);
  EXPECT_LT(index(crossings[0].triangle), 2U);
  // Panes in whose planes it ends are not crossed, and those beyond it are not met.
  const PlaneId first = surfaces.plane_of_triangle[0];
  glass_crossings(rays, {Point3(0.0), {0.25, 1.0, 0.0}, floor, first}, crossings);
  EXPECT_TRUE(crossings.empty());
  // Along its diagonal a quad is met by one of its triangles.
  glass_crossings(rays, {{0.3, 0.0, -0.3}, {0.3, 1.2, -0.3}, floor}, crossings);
  EXPECT_EQ(crossings.size(), 1U);
}

// Panes tilted at random in random order: each is crossed once, where the leg meets its plane, nearest first.
TEST(Glass, ALegCrossesManyPanesInTheirOrder) {
  constexpr std::size_t count = 60;
  Random random(5);
  std::vector<double> heights(count);
  for (std::size_t k = 0; k < count; ++k)
    heights[k] = 0.1 + 0.1 * static_cast<double>((37 * k) % count);
  Scene scene;
  std::vector<double> at; // by triangle
  const Leg leg{{0.1, 0.0, 0.05}, {-0.2, 7.0, 0.1}};
  const Vec3 way = leg.to - leg.from;
  for (const double y : heights) {
    const double a = random.between(-0.02, 0.02), b = random.between(-0.02, 0.02);
    const std::size_t before = scene.triangles.size();
    add_polygon(scene, "pane",
                {{-1, y - a - b, -1}, {1, y + a - b, -1}, {1, y + a + b, 1}, {-1, y - a + b, 1}},
                glass(Rgb(1.0)));
    // On the plane of the pane y' = y + a x + b z.
    const double t =
        (y + a * leg.from.x + b * leg.from.z - leg.from.y) / (way.y - a * way.x - b * way.z);
    at.resize(at.size() + scene.triangles.size() - before, t);
  }
  const RayScene rays = make_ray_scene(scene, find_surfaces(scene));
  std::vector<GlassCrossing> crossings;
  glass_crossings(rays, leg, crossings);
  ASSERT_EQ(crossings.size(), count);
  for (std::size_t k = 1; k < count; ++k)
    EXPECT_LT(at[index(crossings[k - 1].triangle)], at[index(crossings[k].triangle)]) << k;
}

TEST(Glass, ALegThroughTheEdgeOfTwoPanesCrossesEachOnce) {
  Scene scene;
  add_polygon(scene, "left", {{-1, 0, 1}, {0, 0, 0}, {0, 2, 0}, {-1, 2, 1}}, glass(Rgb(1.0)));
  add_polygon(scene, "right", {{0, 0, 0}, {1, 0, 1}, {1, 2, 1}, {0, 2, 0}}, glass(Rgb(1.0)));
  const RayScene rays = make_ray_scene(scene, find_surfaces(scene));
  std::vector<GlassCrossing> crossings;
  // Exactly through the edge: both of its sides are met at the same distance.
  for (const double height : {0.5, 1.0, 1.25}) {
    glass_crossings(rays, {{0.0, height, 1.0}, {0.0, height, -1.0}}, crossings);
    EXPECT_EQ(crossings.size(), 2U) << height;
  }
  // From the edge itself.
  glass_crossings(rays, {{0.0, 1.0, 0.0}, {0.0, 1.0, -1.0}}, crossings);
  EXPECT_LE(crossings.size(), 2U);
}

} // namespace
} // namespace meninas::test
