// Bright elements joined into emitters:
// alike, whatever their number, no light is lost or counted twice, and holes send none.
#include "radiosity/light/secondary_emitters.h"
#include "form_factors/point_form_factor.h"
#include "radiosity/light/point_irradiance.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// A large dark floor, over it a wall of 2 m in 20 x 20 elements that gets brighter upwards,
/// tenfold, as one is beside a skylight.
struct BrightWall {
  std::unique_ptr<LitScene> l;
  std::vector<Rgb> reflected;

  BrightWall() {
    Scene scene;
    add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 8}, {8, 0, 8}, {8, 0, 0}}, diffuse(0.5));
    add_polygon(scene, "wall", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, diffuse(0.5));
    l = lit(std::move(scene), {.element_size = 0.1});
    reflected.assign(element_count(l->mesh), Rgb(0.1));
    for (const std::size_t e : elements_of(*l, "wall"))
      reflected[e] = brightness(centre_of(l->mesh, static_cast<ElementId>(e)));
  }
  static Rgb brightness(const Point3& x) { return Rgb(10.0 * std::pow(10.0, 0.5 * x.y)); }
};

TEST(SecondaryEmitters, AreAsEvenHoweverFewThereMayBe) {
  const BrightWall wall;
  for (const std::size_t most : {1024U, 6U, 2U}) {
    const SecondaryEmitters clusters =
        find_secondary_emitters(*wall.l->light, wall.reflected, {.most = most});
    ASSERT_FALSE(clusters.emitters.empty());
    EXPECT_LE(clusters.emitters.size(), most);
    double owned = 0.0, sent = 0.0;
    for (std::size_t e = 0; e < wall.reflected.size(); ++e)
      if (clusters.owned[e] != 0)
        owned += wall.l->mesh.area[e] * wall.reflected[e].g;
    for (const Emitter& emitter : clusters.emitters) {
      sent += emitter.area * emitter.radiosity.g;
      // The brightest and the darkest point of it are half an element off centres.
      double low = 1e9, high = 0.0;
      for (const Point3& corner : emitter.corners) {
        low = std::min(low, BrightWall::brightness(corner).g);
        high = std::max(high, BrightWall::brightness(corner).g);
      }
      EXPECT_LT(high / low, ClusterSettings{}.evenness * std::pow(10.0, 0.5 * 0.1) * 1.001);
    }
    EXPECT_NEAR(sent, owned, 1e-9 * owned) << "their power is that of their elements";
  }
}

TEST(SecondaryEmitters, LightAPointBesideThemAsTheirElementsDo) {
  // All elements by closed forms, against what is gathered: clusters where there may be some,
  // rays for the rest. Close to the wall its brightness beside the point decides, not its mean.
  // Rays leave 2 % (4 sigma of 4,096).
  const BrightWall wall;
  const auto floor = static_cast<ElementId>(elements_of(*wall.l, "floor").front());
  const MeshSide& side = wall.l->mesh.sides[index(wall.l->mesh.side_of_element[index(floor)])];
  const Receiver point{{1.0, 0.0, 0.12}, side.normal, side.plane_class, side.tangent};
  double exact = 0.0;
  for (const std::size_t e : elements_of(*wall.l, "wall")) {
    std::vector<Point3> corners;
    for (const auto corner : wall.l->mesh.corners[e])
      corners.push_back(wall.l->mesh.vertices[index(corner)]);
    exact += wall.reflected[e].g * point_form_factor(point.position, point.normal, corners);
  }
  for (const double spared : {0.0, 100.0}) {
    const PointGathering gathering(*wall.l->light, wall.reflected, {}, {},
                                   {.rays = 4096, .clusters_spared = spared});
    PointWorkspace work;
    EXPECT_NEAR(indirect_light_at(gathering, point, 5, work).indirect().total.g, exact,
                0.02 * exact);
  }
}

// The sum of A B^2 of what no cluster owns grows by no more than it may, and would with the next:
// the darkest of those that are left. (A cluster's elements differ by half at most,
// and their mean square from the square of their mean by (1.5 + 1)^2 / (4 * 1.5) = 4.2 %.)
TEST(SecondaryEmitters, AreLeftToRaysWhereTheyAddLittleToTheirNoise) {
  const BrightWall wall;
  const auto clusters_with = [&](double spared) {
    return find_secondary_emitters(*wall.l->light, wall.reflected, {.spared = spared});
  };
  const auto noise_of_rays = [&](const SecondaryEmitters& clusters) {
    double sum = 0.0;
    for (std::size_t e = 0; e < wall.reflected.size(); ++e)
      if (clusters.owned[e] == 0)
        sum += wall.l->mesh.area[e] * wall.reflected[e].g * wall.reflected[e].g;
    return sum;
  };
  const SecondaryEmitters all = clusters_with(0.0);
  for (const double spared : {10.0, 100.0}) {
    const SecondaryEmitters clusters = clusters_with(spared);
    EXPECT_LT(clusters.emitters.size(), all.emitters.size());
    ASSERT_FALSE(clusters.emitters.empty());
    double next = 1e300;
    for (const Emitter& emitter : clusters.emitters)
      next = std::min(next, emitter.area * emitter.radiosity.g * emitter.radiosity.g);
    const double added = noise_of_rays(clusters) / noise_of_rays(all) - 1.0;
    EXPECT_LE(added, 1.042 * spared);
    EXPECT_GT(added + 1.042 * next / noise_of_rays(all), spared);
  }
}

TEST(SecondaryEmitters, HolesOfACutOutSendNoLight) {
  // A sheet of 3 x 3 elements of 0.4 m with a square hole of 0.6 m, which leaves of them 0,
  // 3/4 and 15/16. At points 2 m away its light is that of the rest as polygons,
  // by the closed form. Spread evenly over an element it moves by 0.05 m, 0.45 m off the axis:
  // (1 + r^2 / d^2)^-2 changes by 4 * 0.45 * 0.05 / 2^2 = 2.3 %.
  // From the whole of these elements a fifth more would come.
  Scene scene;
  add_polygon(scene, "wall", {{-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}}, diffuse(0.5));
  add_polygon(scene, "sheet", {{-0.6, 0.6, 0}, {0.6, 0.6, 0}, {0.6, -0.6, 0}, {-0.6, -0.6, 0}},
              diffuse(0.5));
  const auto l = lit(std::move(scene), {.element_size = 0.4});
  std::vector<Rgb> reflected(element_count(l->mesh), Rgb(0.1));
  double solid = 0.0;
  for (const std::size_t e : elements_of(*l, "sheet")) {
    const Point3 x = centre_of(l->mesh, static_cast<ElementId>(e));
    const bool beside_x = std::abs(x.x) > 0.2, beside_y = std::abs(x.y) > 0.2;
    l->mesh.solid[e] = beside_x && beside_y ? 0.9375F : beside_x || beside_y ? 0.75F : 0.0F;
    reflected[e] = Rgb(l->mesh.solid[e] > 0.0F ? 10.0 : 0.0);
    solid += l->mesh.area[e] * double{l->mesh.solid[e]};
  }
  ASSERT_NEAR(solid, 1.44 - 0.36, 1e-6);
  double sent = 0.0;
  for (const Emitter& emitter : find_secondary_emitters(*l->light, reflected).emitters)
    sent += emitter.area * emitter.radiosity.g;
  EXPECT_NEAR(sent, 10.0 * solid, 1e-6 * sent);

  const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[elements_of(*l, "wall")[0]])];
  const PointGathering gathering(*l->light, reflected, {}, {},
                                 {.rays = 1024, .cluster_shadow_rays = 64});
  PointWorkspace work;
  for (const double x : {0.0, 0.5, 2.0}) {
    const Receiver point{{x, 0.1, -2.0}, side.normal, side.plane_class, side.tangent};
    const auto square = [&](double half) {
      return point_form_factor(point.position, point.normal,
                               std::array{Point3(-half, half, 0.0), Point3(half, half, 0.0),
                                          Point3(half, -half, 0.0), Point3(-half, -half, 0.0)});
    };
    const double exact = 10.0 * (square(0.6) - square(0.3));
    EXPECT_NEAR(indirect_light_at(gathering, point, 5, work).indirect().total.g, exact,
                0.023 * exact)
        << x;
  }
}

} // namespace
} // namespace meninas::test
