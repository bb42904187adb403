// The analytic method against closed forms, and against the laws that hold whatever the scene is.
#include "form_factors/area_form_factor.h"
#include "form_factors/error_sum.h"
#include "tests/form_factors/asked_factors.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace meninas::test {
namespace {

// 1e-9 of F, or 1e-14 where polygons of 1e-6 sides make F small:
// the rounding of the contour terms, which are of size one.
TEST(ExtendedFormFactor, PairsOfPolygonsInClosedForm) {
  for (const auto& c : known_pair_form_factors()) {
    const ExtendedFactor factor = ask(pair_of(c), "a", "b").factor;
    const double error = std::abs(factor.total.value - c.form_factor);
    EXPECT_LT(error, 1e-9 * c.form_factor + 1e-14) << c.name << " (" << c.formula << ")";
    EXPECT_LE(error, factor.total.error + 1e-15) << c.name;
  }
}

// Triangles that share a corner, which alone is in front of the other's plane: nothing is seen, and that is certain.
TEST(ExtendedFormFactor, APointInFrontOfAPlaneSeesNothing) {
  const auto triangle = [](const std::array<Point3, 3>& corners) { return ConvexPolygon(corners); };
  const ConvexPolygon a = triangle({{{-0.38844824874428557, -1.1045509407608212, -1.1377378125958806},
                        {-0.36393877344675624, -1.1178237679634404, -1.1413526573963397},
                        {-0.39196969515686769, -1.116457530536314, -1.1428857267790853}}}),
      b = triangle({{{-0.38103493028002194, -1.1399883885787723, -1.1438825662391594},
        {-0.36393877344675624, -1.1178237679634404, -1.1413526573963397},
        {-0.36950868256522745, -1.1453075820679022, -1.1394643901903143}}});
  for (const Estimate& factor : {area_form_factor(a, b), area_form_factor(b, a)}) {
    EXPECT_EQ(factor.value, 0.0);
    EXPECT_EQ(factor.error, 0.0); // it was no number
  }
}

// Clipping leaves edges of the length of rounding, over which the logarithmic potential has no
// digits: integrating one that lies on an edge of the other polygon to more took for ever.
// Without it the polygon is the same to its length.
TEST(ExtendedFormFactor, EdgesAsShortAsRounding) {
  const Point3 far{0.31622770107943937, -0.89442672882015972, 0.31622913819267412},
      corner{-0.15811521718146096, 0.44721336441008236, -0.15811378006822624},
      beside{-0.15811521717582064, 0.44721336439412462, -0.15811378006258595};
  const std::vector<Point3> a{far, corner, far + Vec3(1.0, 0.0, 0.0)};
  const std::vector<Point3> plain{corner, corner + Vec3(-0.6, -0.3, -0.7),
                                  corner + Vec3(0.2, -0.5, -0.8)};
  std::vector<Point3> with_short_edge = plain;
  with_short_edge.insert(with_short_edge.begin() + 1, beside);
  const Estimate expected = area_form_factor(ConvexPolygon(a), ConvexPolygon(plain)),
                 found = area_form_factor(ConvexPolygon(a), ConvexPolygon(with_short_edge));
  EXPECT_GT(expected.value, 0.0);
  EXPECT_NEAR(found.value, expected.value, glm::distance(corner, beside));
}

// Four standard deviations of 1,000 independent errors hold their sum;
// errors that all lean one way add up; few never exceed their sum.
TEST(ExtendedFormFactor, ErrorsOfManyParts) {
  ErrorSum independent, leaning, few;
  double sum = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double sign = (k * 2654435761U >> 16U) % 2 == 0 ? 1.0 : -1.0;
    sum += sign;
    independent.add(1.0, sign);
    leaning.add(1.0, 1.0);
  }
  few.add(1.0, 1.0);
  few.add(2.0, -2.0);
  EXPECT_GE(independent.estimate(), std::abs(sum));
  EXPECT_LT(independent.estimate(), 400.0);
  EXPECT_DOUBLE_EQ(leaning.estimate(), 1000.0);
  EXPECT_DOUBLE_EQ(few.estimate(), 3.0);
  few.remove(2.0, -2.0);
  EXPECT_DOUBLE_EQ(few.estimate(), 1.0);
}

// Facing mirrors have two worlds of every depth.
TEST(ExtendedFormFactor, WorldsBetweenFacingMirrors) {
  for (const int depth : {0, 1, 2, 5, 20}) {
    const Asked asked =
        ask(scene_of(known_scene("two_facing"), 1.0), "A", "B", {.max_depth = depth});
    EXPECT_EQ(asked.factor.worlds.size(), static_cast<std::size_t>(2 * depth + 1));
  }
}

/// A closed room with a mirror in part of one wall and a blocker in its middle.
Scene room_with_mirror(double reflectance) {
  Scene scene;
  const Material grey = diffuse(0.5);
  add_room(scene, {0, 0, 0}, {3, 2, 2}, {grey, grey, grey, grey, grey, grey});
  add_polygon(scene, "mirror", {{0.1, 0.5, 1.5}, {0.1, 0.5, 0.5}, {0.1, 1.5, 0.5}, {0.1, 1.5, 1.5}},
              mirror(reflectance));
  add_polygon(scene, "plate", {{1.5, 0.5, 1.0}, {2.0, 0.5, 1.2}, {2.0, 1.2, 1.2}, {1.5, 1.2, 1.0}},
              double_sided(grey));
  return scene;
}

double factor_of(const Asked& asked, const std::vector<std::string>& chain, const Scene& scene) {
  for (const WorldFactor& world : asked.factor.worlds) {
    std::vector<std::string> names;
    for (const MirrorId id : world.chain)
      names.push_back(scene.nodes[index(asked.mirrors.mirrors[index(id)].nodes.front())].name);
    if (names == chain)
      return world.factor.value;
  }
  return 0.0;
}

// A_i F^w_ij = A_j F^rev(w)_ji.
// Both sides are within the accuracy of the total, of which each is a part.
TEST(ExtendedFormFactor, ReciprocityInEveryWorld) {
  const Scene corner = scene_of(known_scene("corner_mirrors"), 0.8);
  const Asked ab = ask(corner, "A", "B"), ba = ask(corner, "B", "A");
  int worlds = 0;
  for (const std::vector<std::string>& chain : {std::vector<std::string>{},
                                                {"mirror_x1"},
                                                {"mirror_y1"},
                                                {"mirror_x1", "mirror_y1"},
                                                {"mirror_y1", "mirror_x1"}}) {
    const std::vector<std::string> reverse(chain.rbegin(), chain.rend());
    const double there = ab.area * factor_of(ab, chain, corner),
                 back = ba.area * factor_of(ba, reverse, corner);
    EXPECT_GT(there, 0.0);
    EXPECT_NEAR(there, back, 2e-4 * ab.factor.total.value);
    ++worlds;
  }
  EXPECT_EQ(ab.factor.worlds.size(), static_cast<std::size_t>(worlds));

  const Scene room = room_with_mirror(1.0);
  const Asked there = ask(room, "x1", "y0"), back = ask(room, "y0", "x1");
  for (const std::vector<std::string>& chain : {std::vector<std::string>{}, {"mirror"}})
    EXPECT_NEAR(there.area * factor_of(there, chain, room),
                back.area * factor_of(back, chain, room), 1e-3);
}

// A perfect mirror hands all light on, so every wall's factors to all walls,
// the plate and the black back of the mirror add up to one.
TEST(ExtendedFormFactor, ClosedRoomsClose) {
  Scene scene = room_with_mirror(1.0);
  // The mirror moved onto its wall: what it hides is the wall's own plane.
  for (auto& vertex : scene.vertices)
    if (vertex.position.x == 0.1)
      vertex.position.x = 0.0;
  scene.vertices.resize(scene.vertices.size() - 4);
  scene.triangles.resize(scene.triangles.size() - 2);
  scene.nodes.pop_back();
  const std::array wall{Point3(0, 0, 2), Point3(0, 0, 0), Point3(0, 2, 0), Point3(0, 2, 2)};
  for (std::size_t k = 0; k < 4; ++k)
    scene.vertices[scene.vertices.size() - 4 + k].position = wall[k];
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);

  const SurfaceModel surfaces = find_surfaces(scene);
  std::vector<NodeSet> nodes;
  for (const char* name : {"x1", "y0", "y1", "z0", "z1"})
    nodes.push_back(nodes_named(scene, name));
  for (const NodeSet& from : nodes) {
    const NodeFactors factors = node_form_factors(scene, surfaces, from, nodes);
    double sum = 0.0;
    for (const ExtendedFactor& factor : factors.to)
      sum += factor.total.value;
    EXPECT_NEAR(sum, 1.0, 1e-4);
  }
}

// A rigid motion or a scale changes the rounding alone,
// and with it at most where an integration stops.
TEST(ExtendedFormFactor, ScaleRotationAndTranslation) {
  const Scene scene = room_with_mirror(0.9);
  const double before = ask(scene, "x1", "y0").factor.total.value;
  const Direction a = glm::normalize(Vec3(1, 2, 3)),
                  b = glm::normalize(glm::cross(a, Vec3(0, 1, 0)));
  const glm::dmat3 rotation(a, b, glm::cross(a, b));
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Scene moved = transformed(scene, rotation, scale, scale * Vec3(10, -20, 30));
    EXPECT_NEAR(ask(moved, "x1", "y0").factor.total.value, before, 1e-4 * before) << scale;
  }
}

// Halves of B share its factor; halves of A average to it.
// The error of each is within its accuracy.
TEST(ExtendedFormFactor, SplittingAPatchAddsUp) {
  Scene whole = scene_of(known_scene("one_side_mirror"), 0.7), split;
  add_polygon(split, "A", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.0));
  add_polygon(split, "B1", {{0, 1, 1}, {0.4, 1, 1}, {0.4, 0, 1}, {0, 0, 1}}, diffuse(0.0));
  add_polygon(split, "B2", {{0.4, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0.4, 0, 1}}, diffuse(0.0));
  add_polygon(split, "mirror_x1", {{1, 0, 1}, {1, 1, 1}, {1, 1, 0}, {1, 0, 0}}, mirror(0.7));
  const double sum =
      ask(split, "A", "B1").factor.total.value + ask(split, "A", "B2").factor.total.value;
  EXPECT_NEAR(sum, ask(whole, "A", "B").factor.total.value, 2e-4 * sum);
  const double mean = 0.4 * ask(split, "B1", "A").factor.total.value +
                      0.6 * ask(split, "B2", "A").factor.total.value;
  EXPECT_NEAR(mean, sum, 2e-4 * sum);
}

// Four standard errors of sixteen replicas:
// Student's t with fifteen degrees of freedom is beyond that once in 900; seeds are fixed.
TEST(ExtendedFormFactor, RaysAgreeWithTheAnalyticMethod) {
  const Scene scene = room_with_mirror(0.9);
  for (const char* to : {"y0", "x0", "plate"}) {
    const ExtendedFactor exact = ask(scene, "x1", to).factor;
    const ExtendedFactor rays =
        ask(scene, "x1", to, {.method = NodeFactorMethod::rays, .rays = 1 << 16}).factor;
    EXPECT_NEAR(rays.total.value, exact.total.value, 4.0 * rays.total.error + exact.total.error)
        << to;
    EXPECT_GT(rays.total.error, 0.0);
    EXPECT_LT(rays.total.error, 1e-3) << to; // F (1 - F) / N is below 1e-6
  }
}

} // namespace
} // namespace meninas::test
