// Bright elements joined into emitters: alike, whatever their number, and no light is lost or counted twice.
#include "radiosity/bright_clusters.h"
#include "radiosity/point_form_factor.h"
#include "radiosity/point_gathering.h"
#include "radiosity/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// A large dark floor, over it a wall of 2 m in 20 x 20 elements that gets brighter upwards, tenfold, as one is beside a skylight.
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

TEST(BrightClusters, AreAsEvenHoweverFewThereMayBe) {
  const BrightWall wall;
  for (const std::size_t most : {1024U, 6U, 2U}) {
    const BrightClusters clusters =
        find_bright_clusters(*wall.l->light, wall.reflected, {.most = most});
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
      for (const Point3& corner : emitter.polygon.span()) {
        low = std::min(low, BrightWall::brightness(corner).g);
        high = std::max(high, BrightWall::brightness(corner).g);
      }
      EXPECT_LT(high / low, ClusterSettings{}.evenness * std::pow(10.0, 0.5 * 0.1) * 1.001);
    }
    EXPECT_NEAR(sent, owned, 1e-9 * owned) << "their power is that of their elements";
  }
}

TEST(BrightClusters, LightAPointBesideThemAsTheirElementsDo) {
  // All elements by closed forms, against what is gathered: clusters where there may be some, rays for the rest. Close to the wall its brightness
  // beside the point decides, not its mean. Rays leave 2 % (4 sigma of 4,096).
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
  const PointGathering gathering(*wall.l->light, wall.reflected, {}, {}, {.rays = 4096});
  PointWorkspace work;
  EXPECT_NEAR(indirect_light_at(gathering, point, 5, work).indirect().total.g, exact, 0.02 * exact);
}

} // namespace
} // namespace meninas::test
