// Secondary emitters far away together: within the stated error of their closed forms,
// through mirrors as in the doubled room, and nowhere that any of them is cut.
#include "radiosity/light/cluster_cut.h"
#include "form_factors/point_form_factor.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace meninas::test {
namespace {

/// A scene whose only emitters are clusters.
struct Clustered {
  std::unique_ptr<LitScene> l;
  std::optional<LightScene> light;
  ClusterTree tree;

  Clustered(Scene scene, std::vector<Emitter> clusters, double scale = 1.0)
      : l(lit(std::move(scene), {.element_size = 0.5 * scale})), light(*l->light) {
    for (Emitter& cluster : clusters)
      for (std::size_t k = 0; k < l->surfaces.planes.size(); ++k)
        if (std::abs(signed_distance(l->surfaces.planes[k], cluster.corners[0])) <
                1e-9 * scale &&
            std::abs(glm::dot(l->surfaces.planes[k].normal, cluster.plane.normal)) > 0.999)
          cluster.plane_class = PlaneId{static_cast<std::uint32_t>(k)};
    light->emitters = std::move(clusters);
    light->emitter_tree = make_emitter_tree(light->emitters);
    tree = make_cluster_tree(light->emitters);
  }

  ArrivingLight at(const Receiver& x, const ClusterCut& cut, DirectWorkspace& direct,
                   const DirectSettings& settings = every_image) const {
    ClusterWorkspace work;
    return cluster_irradiance({*light, tree, settings, cut}, x, 3, work, direct);
  }
  ArrivingLight at(const Receiver& x, const ClusterCut& cut) const {
    DirectWorkspace direct;
    return at(x, cut, direct);
  }
  std::vector<LightcutNode> stand_ins(const Receiver& x, double theta,
                                        std::vector<VirtualLight>& lights) const {
    ClusterWorkspace work;
    cut_clusters(*light, tree, x, theta, work, lights);
    return work.stand_ins;
  }

  static inline const DirectSettings every_image{
      .shadow_rays = 8, .penumbra_rays = 32, .images = std::numeric_limits<int>::max()};
};

Emitter cluster_of(const std::vector<Point3>& corners, const Rgb& radiosity) {
  Emitter emitter;
  emitter.corners = corners;
  const Vec3 area = area_vector(emitter.corners);
  emitter.area = glm::length(area);
  emitter.plane.normal = emitter.area > 0.0 ? area / emitter.area : Vec3(0.0, 1.0, 0.0);
  emitter.plane.offset = glm::dot(emitter.plane.normal, corners[0]);
  emitter.radiosity = radiosity;
  return emitter;
}

/// n x n quads and triangles of any colours on the floor y = 0, as far as `half` from `centre`;
/// every fifth one lacks a channel.
std::vector<Emitter> floor_clusters(int n, Point3 centre, double half, Random& random) {
  std::vector<Emitter> clusters;
  const double step = 2.0 * half / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Point3 low = centre + Vec3(-half + i * step, 0.0, -half + j * step);
      const double size = step * random.between(0.3, 1.0);
      std::vector<Point3> corners{low, low + Vec3(0, 0, size), low + Vec3(size, 0, size),
                                  low + Vec3(size, 0, 0)};
      if ((i + j) % 3 == 0)
        corners.pop_back();
      Rgb radiosity = random.in_box(Vec3(0.1), Vec3(10.0));
      if ((i + 2 * j) % 5 == 0)
        radiosity[(i + j) % 3] = 0.0;
      clusters.push_back(cluster_of(corners, radiosity));
    }
  return clusters;
}

Scene open_floor() {
  Scene scene;
  add_polygon(scene, "floor", {{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}}, diffuse(0.5));
  return scene;
}

/// 2.22 / pi W s^2 / (d - r)^4 by channel;
/// s by quadrature over the triangles, where three middles of edges are exact for squares.
Rgb error_bound(const Clustered& scene, const Receiver& x, const LightcutNode& part) {
  const ClusterNode& node = scene.tree.nodes[part.node];
  const MirrorWorld& world = scene.light->worlds.worlds[index(part.world)];
  Rgb moments(0.0);
  for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
    const Emitter& cluster = scene.light->emitters[scene.tree.order[k]];
    const auto v = cluster.corners;
    for (std::size_t c = 2; c < v.size(); ++c) {
      const double area = 0.5 * glm::length(glm::cross(v[c - 1] - v[0], v[c] - v[0]));
      for (const Point3& y :
           {0.5 * (v[0] + v[c - 1]), 0.5 * (v[c - 1] + v[c]), 0.5 * (v[c] + v[0])})
        for (int band = 0; band < 3; ++band) {
          const Vec3 off = y - node.centre[static_cast<std::size_t>(band)];
          moments[band] += cluster.radiosity[band] * area / 3.0 * glm::dot(off, off);
        }
    }
  }
  const double nearest = glm::distance(apply(world.image, node.middle), x.position) - node.radius;
  return world.throughput * moments * (2.22 / std::numbers::pi / std::pow(nearest, 4.0));
}

/// The clusters of a node in closed form, without blockers.
Rgb closed_form(const Clustered& scene, const Receiver& x, const LightcutNode& part) {
  const ClusterNode& node = scene.tree.nodes[part.node];
  const MirrorWorld& world = scene.light->worlds.worlds[index(part.world)];
  Rgb sum(0.0);
  for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
    const Emitter& cluster = scene.light->emitters[scene.tree.order[k]];
    std::vector<Point3> corners;
    for (const auto& vertex : cluster.corners)
      corners.push_back(apply(world.image, vertex));
    sum += world.throughput * cluster.radiosity * point_form_factor(x.position, x.normal, corners);
  }
  return sum;
}

Receiver any_receiver(Random& random) {
  return {random.in_box(Vec3(-3, 0.05, -3), Vec3(3, 3, 3)), random.direction(), none<PlaneId>, {}};
}

TEST(ClusterCut, StaysWithinTheStatedErrorOfTheClosedForms) {
  Random random(1);
  const Clustered scene(open_floor(), floor_clusters(12, Point3(0.0), 0.6, random));
  for (const double theta : {0.02, 0.15, 0.5}) {
    std::size_t together = 0;
    double worst = 0.0;
    for (int trial = 0; trial < 300; ++trial) {
      const Receiver x = any_receiver(random);
      std::vector<VirtualLight> lights;
      Rgb allowed(1e-15), sum(0.0);
      for (const LightcutNode& part : scene.stand_ins(x, theta, lights)) {
        const ClusterNode& node = scene.tree.nodes[part.node];
        together += node.count > 1;
        EXPECT_LE(node.radius, theta * glm::distance(node.middle, x.position));
        const Rgb bound = error_bound(scene, x, part), exact = closed_form(scene, x, part);
        for (int band = 0; band < 3; ++band) {
          EXPECT_LE(std::abs(part.light[band] - exact[band]), bound[band] + 1e-12 * exact[band]);
          if (bound[band] > 0.0)
            worst = std::max(worst, std::abs(part.light[band] - exact[band]) / bound[band]);
        }
        allowed += bound;
        sum += part.light;
      }
      // Nothing is in the way: with the clusters nearby it is all there is.
      const ArrivingLight cut = scene.at(x, {.theta = theta}), all = scene.at(x, {.theta = 0.0});
      for (int band = 0; band < 3; ++band)
        EXPECT_NEAR(cut.total[band], all.total[band], allowed[band] + 1e-12 * all.total[band]);
      EXPECT_EQ(cut.mirrored, Rgb(0.0));
    }
    EXPECT_TRUE(theta < 0.1 || together > 500U) << together;
    EXPECT_GT(worst, 0.3) << "the bound is not far from what happens";
  }
}

TEST(ClusterCut, AreClosedFormsToTheBitWhereThetaIsZero) {
  Random random(2);
  Scene room = half_room_with_small_mirror();
  const Clustered scene(std::move(room), floor_clusters(8, {1.0, 0.0, 1.5}, 0.4, random));
  for (int trial = 0; trial < 50; ++trial) {
    const Receiver x{
        random.in_box({0.1, 0.1, 0.1}, {1.9, 2.3, 2.9}), random.direction(), none<PlaneId>, {}};
    DirectWorkspace direct, cut;
    const ArrivingLight exact =
        direct_irradiance(*scene.light, x, Clustered::every_image, 3, direct);
    const ArrivingLight found = scene.at(x, {.theta = 0.0}, cut);
    EXPECT_EQ(found.total, exact.total);
    EXPECT_EQ(found.mirrored, exact.mirrored);
    EXPECT_EQ(cut.shadow_rays, direct.shadow_rays);

    // So small a theta opens all nodes.
    const ArrivingLight opened = scene.at(x, {.theta = 1e-9});
    EXPECT_NEAR(opened.total.g, exact.total.g, 1e-12 * exact.total.g);
    EXPECT_NEAR(opened.mirrored.g, exact.mirrored.g, 1e-12 * exact.total.g);
  }
}

// Images that bring as much are summed in their own order, not in that of the tree.
TEST(ClusterCut, KeepsTheOrderOfTheClustersWhereThetaIsZero) {
  Random random(8);
  std::vector<Emitter> clusters;
  for (int k = 0; k < 32; ++k) {
    const Point3 low(random.between(-0.5, 0.5), 0.0, random.between(-0.5, 0.5));
    std::vector<Point3> corners{low, low + Vec3(0, 0, 0.1), low + Vec3(0.1, 0, 0)};
    for (int turn = 0; turn < 2; ++turn) {
      clusters.push_back(
          cluster_of(corners, {1.0, random.between(0.0, 1.0), random.between(0.0, 1.0)}));
      for (Point3& corner : corners)
        corner = Point3(-corner.x, 0.0, -corner.z);
    }
  }
  const Clustered scene(open_floor(), clusters);
  const Receiver x{{0, 1, 0}, {0, -1, 0}, none<PlaneId>, {}};
  DirectWorkspace direct;
  EXPECT_EQ(scene.at(x, {.theta = 0.0}).total,
            direct_irradiance(*scene.light, x, Clustered::every_image, 3, direct).total);
}

/// The floor before a mirror that fills the plane x = -1 as far as anything is seen in it.
Scene floor_before_mirror() {
  Scene scene = open_floor();
  add_polygon(scene, "mirror", {{-1, 0, 8}, {-1, 0, -8}, {-1, 8, -8}, {-1, 8, 8}}, mirror(1.0));
  return scene;
}

TEST(ClusterCut, ComesByWayOfAMirrorAsItWouldInTheDoubledRoom) {
  Random random(3);
  const auto clusters = floor_clusters(10, Point3(0.0), 0.4, random);
  std::vector<Emitter> images;
  for (const Emitter& cluster : clusters) {
    std::vector<Point3> corners;
    for (const auto& v : cluster.corners)
      corners.insert(corners.begin(), Point3(-2.0 - v.x, v.y, v.z));
    images.push_back(cluster_of(corners, cluster.radiosity));
  }
  const Clustered half(floor_before_mirror(), clusters), beyond(open_floor(), images);
  ASSERT_EQ(half.light->worlds.worlds.size(), 2U);
  std::size_t together = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Receiver x{
        random.in_box({0.5, 0.1, -1}, {3, 3, 1}), random.direction(), none<PlaneId>, {}};
    std::vector<VirtualLight> lights;
    Rgb allowed(1e-15);
    for (const LightcutNode& part : half.stand_ins(x, 0.3, lights)) {
      together += part.world != real_world && half.tree.nodes[part.node].count > 1;
      if (part.world != real_world)
        allowed += error_bound(half, x, part);
    }
    const Rgb found = half.at(x, {.theta = 0.3}).mirrored;
    const Rgb exact = beyond.at(x, {.theta = 0.0}).total;
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(found[band], exact[band], allowed[band] + 1e-12 * exact[band]);
  }
  EXPECT_GT(together, 500U);
}

/// What stands for clusters stands for whole ones; all others are computed, and none is left out.
void expect_whole_clusters(const Clustered& scene, const Vec3& low, const Vec3& high,
                           Random& random) {
  std::size_t together = 0, mirrored = 0, opened = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Receiver x{random.in_box(low, high), random.direction(), none<PlaneId>, {}};
    std::vector<VirtualLight> lights, all;
    virtual_lights(scene.light->worlds, scene.light->emitters, x.position, x.normal,
                   scene.light->surfaces.tolerance, all);
    std::map<std::pair<std::uint32_t, WorldId>, double> seen; // area by cluster and world
    for (const VirtualLight& image : all)
      seen[{image.emitter, image.world}] += glm::length(area_vector(image.polygon.span()));

    for (const LightcutNode& part : scene.stand_ins(x, 0.5, lights)) {
      const ClusterNode& node = scene.tree.nodes[part.node];
      together += node.count > 1;
      mirrored += part.world != real_world;
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        const std::uint32_t cluster = scene.tree.order[k];
        const double area = scene.light->emitters[cluster].area;
        EXPECT_NEAR((seen[{cluster, part.world}]), area, 1e-9 * area);
        seen.erase({cluster, part.world});
      }
    }
    for (const VirtualLight& image : lights)
      seen.erase({image.emitter, image.world});
    opened += lights.size();
    for (const auto& [image, area] : seen)
      EXPECT_LT(area, 1e-9) << "left out";
  }
  EXPECT_GT(together, 1000U);
  EXPECT_GT(mirrored, 100U);
  EXPECT_GT(opened, 1000U);
}

TEST(ClusterCut, OpensWhatTheHorizonOrTheWindowCuts) {
  Random random(4);
  const Clustered scene(half_room_with_small_mirror(),
                        floor_clusters(12, {1.0, 0.0, 1.5}, 0.4, random));
  expect_whole_clusters(scene, {0.1, 0.5, 0.1}, {1.9, 2.3, 2.9}, random);
}

// The mirror stands in the floor. Clusters behind it have images before it, which it does not show.
TEST(ClusterCut, OpensWhatPiercesTheMirror) {
  Random random(9);
  Scene scene = open_floor();
  add_polygon(scene, "mirror", {{0, -1, 1}, {0, -1, -1}, {0, 1, -1}, {0, 1, 1}}, mirror(0.9));
  const Clustered both_sides(std::move(scene), floor_clusters(12, Point3(0.0), 0.4, random));
  expect_whole_clusters(both_sides, {0.5, 0.1, -1}, {2, 2, 1}, random);
}

TEST(ClusterCut, IsDarkBehindAPlateAndHalfSeenOverItsEdge) {
  Random random(5);
  Scene scene = open_floor();
  add_polygon(scene, "plate", {{0, 1, -3}, {-3, 1, -3}, {-3, 1, 3}, {0, 1, 3}},
              double_sided(diffuse(0.5)));
  // What is below the plate is blue, what is beside it red; some nodes have both.
  std::vector<Emitter> clusters = floor_clusters(10, {0.06, 0, 0}, 0.3, random);
  for (Emitter& cluster : clusters)
    cluster.radiosity *= cluster.corners[0].x < -0.01 ? Rgb(0.1, 1, 10) : Rgb(10, 1, 0.1);
  const Clustered half(std::move(scene), clusters);
  const Receiver behind{{-1, 2, 0}, {0, -1, 0}, none<PlaneId>, {}};
  std::vector<VirtualLight> lights;
  ASSERT_FALSE(half.stand_ins(behind, 0.2, lights).empty());
  ASSERT_TRUE(lights.empty());
  EXPECT_EQ(half.at(behind, {.theta = 0.2}).total, Rgb(0.0));

  // From above the edge some of the clusters are seen, in their own colours.
  // 0.4 % for nodes as points, and some for rays: many, evenly spread.
  const Receiver above{{0, 2, 0}, {0, -1, 0}, none<PlaneId>, {}};
  ASSERT_LT(half.stand_ins(above, 0.1, lights).size(), 50U);
  Rgb exact(0.0);
  for (const Emitter& cluster : half.light->emitters) {
    const ConvexPolygon seen = clip(ConvexPolygon(cluster.corners), Point3(0.0), {1, 0, 0});
    exact += cluster.radiosity * point_form_factor(above.position, above.normal, seen.span());
  }
  DirectWorkspace direct;
  const Rgb found =
      half.at(above, {.theta = 0.1, .rays = 4096}, direct, {.shadow_rays = 4096}).total;
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(found[band], exact[band], 0.01 * largest(exact));
  EXPECT_GT(direct.shadow_rays, 4000U);
  EXPECT_LT(direct.shadow_rays, 4400U);
}

TEST(ClusterCut, IsTheSameWhereverTheSceneLiesHoweverLargeAndBright) {
  Random random(6);
  Scene scene = open_floor();
  add_box(scene, "box", {0.5, 0.2, -0.5}, {0.8, 0.6, 0.4}, diffuse(0.5));
  // Squares in rows: ties in the splits of the tree, where roundings must not decide.
  std::vector<Emitter> grid;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      const Point3 p(-0.45 + 0.1 * i, 0.0, -0.45 + 0.1 * j);
      grid.push_back(
          cluster_of({p, p + Vec3(0, 0, 0.1), p + Vec3(0.1, 0, 0.1), p + Vec3(0.1, 0, 0)},
                     random.in_box(Vec3(1.0), Vec3(2.0))));
    }
  const Clustered before(scene, grid);
  for (const auto& [angle, scale, brightness] :
       {std::tuple{0.0, 1e-3, 1e-12}, {0.7, 1.0, 1.0}, {2.1, 1e3, 1e12}}) {
    const glm::dmat3 turn(
        glm::rotate(glm::dmat4(1.0), angle, glm::normalize(Vec3(0.3, 1.0, -0.5))));
    const Vec3 offset = scale * Vec3(0.3, -2.0, 1.0);
    std::vector<Emitter> moved;
    for (const Emitter& cluster : grid) {
      std::vector<Point3> corners;
      for (const auto& v : cluster.corners)
        corners.push_back(scale * (turn * v) + offset);
      moved.push_back(cluster_of(corners, brightness * cluster.radiosity));
    }
    const Clustered after(transformed(scene, turn, scale, offset), moved, scale);
    EXPECT_EQ(after.tree.order, before.tree.order);
    double sum = 0.0, difference = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
      const Receiver x = any_receiver(random);
      const Receiver y{scale * (turn * x.position) + offset, turn * x.normal, none<PlaneId>, {}};
      const double here = before.at(x, {}).total.g, there = after.at(y, {}).total.g / brightness;
      sum += here;
      difference += std::abs(here - there);
    }
    EXPECT_LT(difference, 1e-4 * sum); // a ray at an edge of the box may fall to the other side
  }
}

TEST(ClusterCut, TakesClustersWithoutAreaAndPointsInTheirMidst) {
  Random random(7);
  auto clusters = floor_clusters(6, Point3(0.0), 0.3, random);
  clusters.push_back(cluster_of({{0.5, 0, 0}, {0.5, 0, 0.1}, {0.5, 0, 0.2}}, Rgb(3.0)));
  clusters.push_back(cluster_of({{0.6, 0, 0}, {0.6, 0, 0}, {0.6, 0, 0}}, Rgb(3.0)));
  const Clustered scene(open_floor(), clusters);
  const Clustered nothing(open_floor(), {clusters[36], clusters[37]}), empty(open_floor(), {});
  for (const Point3& x : {Point3(0.0), Point3(0.0, 1e-7, 0.0), Point3(0.0, 0.01, 0.1),
                          Point3(0.6, 0.0, 0.0), Point3(2.0, 0.0, 0.0), Point3(0.6, 0.5, 0.0)})
    for (const Direction& n : {Direction(0, -1, 0), Direction(0, 1, 0), Direction(0.6, -0.8, 0)}) {
      const Receiver receiver{x, n, none<PlaneId>, {}};
      const Rgb found = scene.at(receiver, {}).total,
                exact = scene.at(receiver, {.theta = 0}).total;
      EXPECT_LE(largest(glm::abs(found - exact)), 0.01 * largest(exact)); // theta squared, and half
      EXPECT_LT(largest(nothing.at(receiver, {}).total),
                1e-15); // what rounding leaves of a closed form
      EXPECT_EQ(empty.at(receiver, {}).total, Rgb(0.0));
    }
}

} // namespace
} // namespace meninas::test
