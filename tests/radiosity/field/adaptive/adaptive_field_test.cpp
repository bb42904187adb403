#include "radiosity/field/adaptive/adaptive_field.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/adaptive/mirror_outlines.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

PassOneSettings adaptive(double error, int rays) {
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  settings.interpolation.adaptive = AdaptiveSettings{.error = error};
  return settings;
}

struct Solved {
  std::unique_ptr<LitScene> lit;
  RadiositySolution solution;

  /// The field at a point of the front of a node.
  glm::dvec3 at(const std::string& node, const Point3& x) const {
    const LightScene& light = *solution.field.scene;
    for (std::uint32_t s = 0; s < light.mesh.sides.size(); ++s)
      if (lit->scene.nodes[index(light.mesh.sides[s].node)].name == node)
        return irradiance_at(light.mesh, solution.field, SideId{s},
                             uv_at(lit->surfaces.patches[index(light.mesh.sides[s].patch)], x));
    return glm::dvec3(std::nan(""));
  }
};

Solved solved(Scene scene, const MeshSettings& mesh, const PassOneSettings& settings) {
  Solved result{lit(std::move(scene), mesh), {}};
  result.solution = solve_pass_one(result.lit->light, settings);
  return result;
}

TEST(AdaptiveField, AFurnaceNeedsNoElements) {
  const Solved s =
      solved(furnace(0.5, {true, false, true}), {.element_size = 0.5}, adaptive(0.01, 64));
  ASSERT_NE(s.solution.field.scene, s.lit->light);
  EXPECT_EQ(element_count(s.solution.field.mesh()), element_count(s.lit->mesh));
  for (const auto& h : s.solution.field.irradiance)
    EXPECT_NEAR(h.g, 2.0F, 1e-3F); // B = E / (1 - rho), to the solver's tolerance
  EXPECT_LT(s.solution.interpolation_error.value(), 1e-3);
}

/// Small and quick, with all kinds of elements that there are.
Solved divided_room() { return solved(half_room(), {.element_size = 0.4}, adaptive(0.05, 64)); }

// On both sides of an edge the same: its middle, where a vertex hangs, has the mean of its
// ends in every part of the field. Neighbours' edges are halves of one another at most.
TEST(AdaptiveField, HasNoCracks) {
  const Solved s = divided_room();
  const ElementMesh& mesh = s.solution.field.mesh();
  ASSERT_GT(mesh.hanging.size(), 40U);
  for (const auto part : {&VertexIrradiance::irradiance, &VertexIrradiance::mirrored,
                          &VertexIrradiance::indirect, &VertexIrradiance::indirect_mirrored}) {
    const std::vector<glm::vec3>& values = s.solution.field.*part;
    ASSERT_EQ(values.size(), mesh.vertices.size());
    for (const HangingVertex& h : mesh.hanging) {
      const glm::vec3 mean = 0.5F * (values[index(h.end_a)] + values[index(h.end_b)]);
      ASSERT_LT(glm::distance(values[index(h.vertex)], mean), 1e-6F * (1.0F + glm::length(mean)));
    }
  }
  // Where neighbours differed by two levels, a vertex would lie on a quarter of an edge.
  std::vector<Point3> ends;
  for (const HangingVertex& h : mesh.hanging) {
    const Point3 &a = mesh.vertices[index(h.end_a)], &b = mesh.vertices[index(h.end_b)];
    ends.push_back(glm::mix(a, b, 0.25));
    ends.push_back(glm::mix(a, b, 0.75));
  }
  for (const HangingVertex& h : mesh.hanging)
    for (const Point3& quarter : ends)
      ASSERT_GT(glm::distance(mesh.vertices[index(h.vertex)], quarter), 1e-6);
}

TEST(AdaptiveField, IsLightThatAddsUp) {
  const Solved s = divided_room();
  const IrradianceField& field = s.solution.field;
  for (std::size_t v = 0; v < field.irradiance.size(); ++v)
    for (int band = 0; band < 3; ++band) {
      const float all = field.irradiance[v][band], indirect = field.indirect[v][band];
      ASSERT_TRUE(std::isfinite(all));
      ASSERT_GE(indirect, 0.0F);
      ASSERT_GE(all, indirect);
      ASSERT_GE(all, field.mirrored[v][band] * (1.0F - 1e-5F));
    }
}

TEST(AdaptiveField, TheSameBitsForAnyThreads) {
  const Solved all = divided_room();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Solved alone = divided_room();
  EXPECT_EQ(division_of(all.solution.field.mesh()), division_of(alone.solution.field.mesh()));
  EXPECT_EQ(all.solution.field.irradiance, alone.solution.field.irradiance);
  EXPECT_EQ(all.solution.field.indirect_mirrored, alone.solution.field.indirect_mirrored);
  EXPECT_EQ(all.solution.interpolation_error, alone.solution.interpolation_error);
}

// With few rays every centre is far from what its vertices say,
// and still there is nothing to divide for: the noise is known.
TEST(AdaptiveField, NoiseIsNoReasonToDivide) {
  const Scene room = half_room();
  const Solved few = solved(room, {.element_size = 0.2}, adaptive(0.02, 16)),
               many = solved(room, {.element_size = 0.2}, adaptive(0.02, 256));
  EXPECT_LT(double(element_count(few.solution.field.mesh())),
            1.5 * double(element_count(many.solution.field.mesh())));
}

/// Where the floor of half_room() is lit by the lamp,
/// by its image in the mirror, or in the shadow of the box of either.
std::vector<Point3> floor_points() {
  std::vector<Point3> points;
  for (double x = 0.05; x < 2.0; x += 0.1)
    for (double z = 0.05; z < 3.0; z += 0.1)
      if (!(x > 0.55 && x < 1.25 && z > 0.75 && z < 1.55))
        points.push_back({x, 0.0, z});
  return points;
}

// The bound is one for noise as well: vertices, few as they are, take the rays that it needs.
// What two seeds find of the light from elements differs by noise: each is off by no more
// than the bound, in the mean square over all walls. The 32 rays asked for are off by 3 %.
TEST(AdaptiveField, VerticesTakeTheRaysThatTheBoundNeeds) {
  constexpr double bound = 0.02;
  PassOneSettings settings = adaptive(bound, 32);
  const Solved a = solved(half_room(), {.element_size = 0.4}, settings);
  settings.form_factors.seed += 1;
  const Solved b = solved(half_room(), {.element_size = 0.4}, settings);
  const auto indirect = [](const Solved& s, std::uint32_t side, Vec2 uv) {
    const ElementMesh& mesh = s.solution.field.mesh();
    return glm::dvec3(value_in(mesh, s.solution.field.indirect, locate(mesh, SideId{side}, uv)));
  };
  double apart = 0.0, size = 0.0;
  for (std::uint32_t side = 0; side < a.lit->mesh.sides.size(); ++side)
    for (double u = 0.05; u < 1.0; u += 0.1)
      for (double v = 0.05; v < 1.0; v += 0.1) {
        const glm::dvec3 light = indirect(a, side, {u, v});
        apart += std::pow(glm::distance(light, indirect(b, side, {u, v})), 2.0);
        size += glm::dot(light, light);
      }
  EXPECT_LT(std::sqrt(apart / size), std::sqrt(2.0) * bound);
}

// Two routes to one number: the field on elements that follow the light, and on many of one size.
TEST(AdaptiveField, AgreesWithAFineMeshOfOneSize) {
  PassOneSettings plain = adaptive(0.0, 256);
  plain.interpolation.adaptive.reset();
  const Solved fine = solved(half_room(), {.element_size = 0.0625}, plain),
               coarse = solved(half_room(), {.element_size = 0.4}, plain),
               ours = solved(half_room(), {.element_size = 0.4}, adaptive(0.02, 256));
  EXPECT_LT(3 * element_count(ours.solution.field.mesh()), element_count(fine.lit->mesh));
  double error = 0.0, coarse_error = 0.0, size = 0.0;
  for (const Point3& x : floor_points()) {
    const glm::dvec3 truth = fine.at("y0", x);
    error += std::pow(glm::distance(ours.at("y0", x), truth), 2.0);
    coarse_error += std::pow(glm::distance(coarse.at("y0", x), truth), 2.0);
    size += glm::dot(truth, truth);
  }
  // Both have noise of about a percent,
  // and the bound holds over all walls, of which the floor has the edges.
  EXPECT_LT(std::sqrt(error / size), 0.04);
  EXPECT_LT(error, 0.25 * coarse_error);
}

// A spot on the floor lights the ceiling from where it is, however large the element it is in:
// what gathers looks at the divided mesh, and elements keep their means.
// The ceiling above a spot near the corner of one large element, by fine elements and by this one.
TEST(AdaptiveField, LightComesFromWhereItIs) {
  Scene scene;
  const Material black = diffuse(0.0);
  add_room(scene, Point3(0.0), {2.0, 1.0, 2.0},
           {black, black, diffuse(0.8), diffuse(0.5), black, black});
  // A lamp under a shade that leaves open a corner.
  add_polygon(scene, "lamp", {{0.3, 0.9, 0.3}, {0.4, 0.9, 0.3}, {0.4, 0.9, 0.4}, {0.3, 0.9, 0.4}},
              diffuse(0.0, 100.0));
  add_polygon(scene, "shade", {{0.6, 0.0, 0.0}, {0.6, 1.0, 0.0}, {0.6, 1.0, 2.0}, {0.6, 0.0, 2.0}},
              double_sided(black));
  PassOneSettings plain = adaptive(0.0, 1024);
  plain.interpolation.adaptive.reset();
  const Solved fine = solved(scene, {.element_size = 0.05}, plain),
               coarse = solved(scene, {.element_size = 1.0}, plain),
               ours = solved(scene, {.element_size = 1.0}, adaptive(0.01, 1024));
  double error = 0.0, coarse_error = 0.0, size = 0.0;
  for (double x = 0.05; x < 0.6; x += 0.1)
    for (double z = 0.05; z < 2.0; z += 0.1) {
      const Point3 at{x, 1.0, z};
      const double truth = fine.at("y1", at).g;
      error += std::pow(ours.at("y1", at).g - truth, 2.0);
      coarse_error += std::pow(coarse.at("y1", at).g - truth, 2.0);
      size += truth * truth;
    }
  EXPECT_LT(std::sqrt(error / size), 0.03);
  EXPECT_GT(std::sqrt(coarse_error / size), 0.1);
}

class AdaptiveImages : public testing::TestWithParam<bool> {};

// The method of images:
// with a perfect mirror every point receives what it would receive in the doubled room.
TEST_P(AdaptiveImages, EveryPointReceivesTheSame) {
  const Scene half = GetParam() ? half_room_with_small_mirror() : half_room();
  const PassOneSettings settings = adaptive(0.02, 512);
  const Solved mirrored = solved(half, {.element_size = 0.25}, settings),
               whole = solved(doubled(half), {.element_size = 0.25}, settings);
  double error = 0.0, size = 0.0;
  for (const Point3& x : floor_points()) {
    const glm::dvec3 truth = whole.at("y0", x);
    error += std::pow(glm::distance(mirrored.at("y0", x), truth), 2.0);
    size += glm::dot(truth, truth);
  }
  // Each is within 0.02 and they are divided in different places,
  // so that they are within 0.02 sqrt(2) of each other.
  EXPECT_LT(std::sqrt(error / size), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Mirrors, AdaptiveImages, testing::Bool());

// A mirror on the wall throws a spot on the floor; its outline is where the light jumps.
TEST(MirrorOutlines, LieWhereTheLightJumps) {
  Scene scene;
  const Material black = diffuse(0.0), floor = diffuse(0.5);
  add_room(scene, Point3(0.0), {4.0, 2.0, 4.0}, {black, black, floor, black, black, black});
  add_polygon(scene, "mirror",
              {{0.001, 0.8, 2.4}, {0.001, 0.8, 1.6}, {0.001, 1.4, 1.6}, {0.001, 1.4, 2.4}},
              mirror(1.0));
  add_polygon(scene, "lamp",
              {{1.0, 1.8, 2.0}, {1.02, 1.8, 2.0}, {1.02, 1.8, 2.02}, {1.0, 1.8, 2.02}},
              diffuse(0.0, 100.0));
  const auto l = lit(std::move(scene), {.element_size = 0.5});
  const MirrorOutlines outlines = mirror_outlines(*l->light, 0.1);
  DirectWorkspace work;
  const auto brought = [&](const Point3& x) {
    return direct_irradiance(*l->light, {x, {0.0, 1.0, 0.0}, l->mesh.sides[2].plane_class},
                             {.shadow_rays = 1, .penumbra_rays = 1}, 1, work)
        .mirrored.g;
  };
  // The lamp's image is at x = -1:
  // rays through the mirror's lower edge, at 0.8 of 1.8 m, meet the floor 1.8 m out.
  int jumps = 0, on_floor = 0;
  Point3 centre(0.0);
  for (const OutlinePoint& point : outlines) {
    if (l->scene.nodes[index(l->mesh.sides[index(point.side)].node)].name != "y0")
      continue;
    centre +=
        point_at(l->surfaces.patches[index(l->mesh.sides[index(point.side)].patch)], point.uv);
    ++on_floor;
  }
  ASSERT_GT(on_floor, 40);
  centre /= double(on_floor);
  for (const OutlinePoint& point : outlines) {
    if (l->scene.nodes[index(l->mesh.sides[index(point.side)].node)].name != "y0")
      continue;
    const Point3 x =
        point_at(l->surfaces.patches[index(l->mesh.sides[index(point.side)].patch)], point.uv);
    // From a tenth inside to a tenth outside, which is more than the lamp is wide.
    const Point3 inside = glm::mix(x, centre, 0.1), outside = glm::mix(x, centre, -0.1);
    jumps += brought(inside) > 0.0 && brought(outside) == 0.0 ? 1 : 0;
  }
  EXPECT_GT(jumps, 0.9 * on_floor);
}

} // namespace
} // namespace meninas::test
