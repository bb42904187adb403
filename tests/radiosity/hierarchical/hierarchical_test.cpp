// Hierarchical radiosity:
// against closed forms, against solutions by rows, and by what trees and cuts keep.
#include "radiosity/hierarchical/node_solution.h"
#include "radiosity/field/vertex_places.h"
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/hierarchical/plain_room.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

namespace meninas::test {
namespace {

PassOneSettings hierarchical(double element_size, double link_error, int rays = 512) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = rays;
  settings.interpolation.method = Interpolation::average;
  settings.cut = MeshCut::hierarchical;
  settings.hierarchical.link_error = link_error;
  return settings;
}

PassOneSettings by_rows(PassOneSettings settings, int rays) {
  settings.cut = MeshCut::uniform;
  settings.form_factors.rays = rays;
  return settings;
}

/// Direct light as exact as it gets, so that receivers are what differs.
PassOneSettings with_fine_direct_light(PassOneSettings settings) {
  settings.direct.points = settings.direct.max_points = 32;
  settings.direct.shadow_rays = settings.direct.penumbra_rays = settings.direct.rays_in_element =
      64;
  return settings;
}

Scene gallery(const std::string& name) {
  return load_gltf(source_dir() + "/scenes/gallery/" + name + ".gltf");
}

/// Root mean square and mean of what two solutions differ by, relative to the mean irradiance;
/// `local`: the former relative to that and what is there.
struct Agreement {
  double rms = 0.0, mean = 0.0, local = 0.0;
};
Agreement agreement(const LitScene& l, const RadiositySolution& a, const RadiositySolution& b) {
  double light = 0.0, area = 0.0;
  for (std::size_t e = 0; e < b.irradiance.size(); ++e) {
    light += l.mesh.area[e] * double{b.exposed[e]} * b.irradiance[e].g;
    area += l.mesh.area[e] * double{b.exposed[e]};
  }
  const double mean = light / area;
  Agreement result;
  for (std::size_t e = 0; e < a.irradiance.size(); ++e) {
    const double share = l.mesh.area[e] * double{b.exposed[e]} / area;
    const double apart = a.irradiance[e].g - b.irradiance[e].g;
    result.rms += share * std::pow(apart / mean, 2.0);
    result.mean += share * apart / mean;
    result.local += share * std::pow(apart / (b.irradiance[e].g + mean), 2.0);
  }
  return {std::sqrt(result.rms), std::abs(result.mean), std::sqrt(result.local)};
}

// All walls glow with E = 1: B = 1 / (1 - rho) everywhere.
// Rows of receivers close as those of elements do, so that nothing is left but the tolerance.
TEST(Hierarchical, Furnaces) {
  for (const bool with_mirrors : {false, true})
    for (const double rho : {0.0, 0.5, 0.9}) {
      const auto l = lit(furnace(rho, {with_mirrors}), {.element_size = 0.125});
      const RadiositySolution solution = solve_pass_one(l->light, hierarchical(0.125, 0.05));
      EXPECT_TRUE(solution.solver.converged);
      EXPECT_EQ(solution.solver.bands, 1);
      for (const Rgb& b : solution.radiosity)
        EXPECT_NEAR(b.g, 1.0 / (1.0 - rho), 2e-4 / (1.0 - rho)) << rho;
      EXPECT_LT(std::abs(solution.energy.imbalance), 1e-3);
      // The light is the same everywhere: no side has more than its first receivers.
      EXPECT_EQ(solution.links->receivers, 16 * l->mesh.sides.size());
    }
}

// Two parallel unit squares at distance 1, F = 0.199824895698387383 (C-11); one emits E = 1:
// B1 = E / (1 - rho^2 F^2), B2 = rho F B1. A net of N rays is about N^(-3/4) off: 2e-3 F.
TEST(Hierarchical, ParallelPlates) {
  constexpr double rho = 0.8, factor = 0.199824895698387383;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(rho, 1.0));
  add_polygon(scene, "ceiling", {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, diffuse(rho));
  const auto l = lit(scene, {.element_size = 0.0625});
  const RadiositySolution solution =
      solve_pass_one(l->light, with_fine_direct_light(hierarchical(0.0625, 0.02, 4096)));
  const double b1 = 1.0 / (1.0 - rho * rho * factor * factor);
  EXPECT_NEAR(mean_over(*l, solution.radiosity, "floor").g, b1, 1e-3);
  EXPECT_NEAR(mean_over(*l, solution.radiosity, "ceiling").g, rho * factor * b1, 1e-3);
  EXPECT_LT(std::abs(solution.energy.imbalance), 1e-3);
}

// Two routes to the same light: rows of receivers, and of all elements.
// Within a receiver light differs by about X / 2 of B + B_mean,
// the samples of rows by as much as those of another seed; and so does the mean over the room.
TEST(Hierarchical, AgreesWithRowsInGalleryScenes) {
  constexpr double link_error = 0.02;
  for (const char* name : {"cornell", "mirror-spot", "sunbeam", "facing-mirrors"}) {
    PassOneSettings settings = hierarchical(0.0, link_error, 512);
    settings.mesh.target_elements = 1000;
    const auto l = lit(gallery(name), settings.mesh);
    const RadiositySolution nodes = solve_pass_one(l->light, settings);
    EXPECT_TRUE(nodes.solver.converged);
    EXPECT_LT(nodes.links->receivers, element_count(l->mesh)) << name;
    PassOneSettings with_rows = by_rows(settings, 512);
    const RadiositySolution rows = solve_pass_one(l->light, with_rows);
    with_rows.form_factors.seed = with_rows.direct.seed = 1;
    const RadiositySolution other = solve_pass_one(l->light, with_rows);
    const Agreement a = agreement(*l, nodes, rows), samples = agreement(*l, other, rows);
    EXPECT_LT(a.local, std::hypot(0.5 * link_error, samples.local)) << name;
    EXPECT_LT(a.mean, 4.0 * samples.mean + 0.002) << name;
  }
}

// What X bounds falls with X:
// half of a difference from parent to child is what is left within the child.
TEST(Hierarchical, ASmallerLinkErrorIsASmallerError) {
  PassOneSettings settings = hierarchical(1.0 / 24.0, 0.2, 2048);
  const auto l = lit(plain_room(), settings.mesh);
  const RadiositySolution rows = solve_pass_one(l->light, by_rows(settings, 2048));
  std::vector<double> errors;
  std::vector<std::size_t> receivers;
  for (const double link_error : {0.2, 0.002}) {
    settings.hierarchical.link_error = link_error;
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    errors.push_back(agreement(*l, solution, rows).rms);
    receivers.push_back(solution.links->receivers);
  }
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_GT(receivers[1], 2 * receivers[0]);
}

// The method of images: the elements of the half room receive what they receive in the doubled one.
// The samples differ: by 0.5 % a row of 1024 rays, besides what receivers leave out.
TEST(Hierarchical, MirrorRoomIsDoubledRoom) {
  for (const auto& [small, interpolation] : {std::pair(false, Interpolation::average),
                                             std::pair(true, Interpolation::average),
                                             std::pair(false, Interpolation::gather),
                                             std::pair(true, Interpolation::gather)}) {
    const Scene half = small ? half_room_with_small_mirror() : half_room();
    PassOneSettings settings = with_fine_direct_light(hierarchical(0.15, 0.01, 1024));
    settings.interpolation = {.method = interpolation, .rays = 1024};
    const auto a = lit(half, settings.mesh), b = lit(doubled(half), settings.mesh);
    const RadiositySolution mirrored = solve_pass_one(a->light, settings),
                            whole = solve_pass_one(b->light, settings);
    double squares = 0.0, sum = 0.0, light = 0.0, area = 0.0;
    for (std::size_t e = 0; e < mirrored.irradiance.size(); ++e) {
      // Polygons of the half come first in the doubled room, with the same elements.
      ASSERT_LT(glm::distance(centre_of(a->mesh, static_cast<ElementId>(e)),
                              centre_of(b->mesh, static_cast<ElementId>(e))),
                1e-9);
      const double apart = mirrored.irradiance[e].g - whole.irradiance[e].g;
      squares += a->mesh.area[e] * apart * apart;
      sum += a->mesh.area[e] * apart;
      light += a->mesh.area[e] * whole.irradiance[e].g;
      area += a->mesh.area[e];
    }
    EXPECT_LT(std::sqrt(squares / area) / (light / area), 0.01) << small;
    EXPECT_LT(std::abs(sum) / light, 0.002) << small;
  }
}

// Receivers are as many as the light asks for: four times the elements need hardly more of them.
TEST(Hierarchical, FinerElementsNeedNoMoreRays) {
  std::vector<std::uint64_t> rays;
  std::vector<std::size_t> elements;
  for (const double size : {1.0 / 16.0, 1.0 / 32.0}) {
    const auto l = lit(plain_room(), {.element_size = size});
    PassOneSettings settings = hierarchical(size, 0.05, 256);
    settings.direct.points = settings.direct.max_points = settings.direct.shadow_rays =
        settings.direct.penumbra_rays = 1;
    rays.push_back(solve_pass_one(l->light, settings).form_factor_rays);
    elements.push_back(element_count(l->mesh));
  }
  EXPECT_GT(double(elements[1]), 3.5 * double(elements[0]));
  EXPECT_LT(double(rays[1]), 1.3 * double(rays[0]));
}

// Every node's elements are those of its children,
// every element has one receiver, and the areas of cells are those of the sides.
TEST(Hierarchical, TreesAndCutsAreWhole) {
  for (const Scene& scene : {half_room(), gallery("meninas")}) {
    const auto l = lit(scene, {.element_size = 0.3});
    const NodeTree tree = make_node_tree(*l->light);
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      const TreeNode& node = tree.nodes[n];
      double below = 0.0;
      for (const ElementId element : elements_below(tree, static_cast<TreeNodeId>(n)))
        below += l->mesh.area[index(element)];
      const ReceiverArea area = area_of(*l->light, tree, static_cast<TreeNodeId>(n));
      // Half the product of the diagonals, or of two edges of a triangle;
      // as far as the floats of a file make them planar.
      const Vec3 opposite = area.edge_u + area.edge_v + area.edge_uv;
      const double own = area.region != nullptr ? area.region->area_up_to.back() :
          0.5 * glm::length(area.triangle ? glm::cross(area.edge_u, area.edge_v)
                                          : glm::cross(opposite, area.edge_v - area.edge_u));
      EXPECT_NEAR(own, below, 1e-6 * below) << n;
      std::uint32_t count = is_leaf(node) ? 1 : 0;
      for (std::uint32_t c = 0; c < node.child_count; ++c)
        count += tree.nodes[index(node.first_child) + c].leaf_count;
      EXPECT_EQ(count, node.leaf_count);
    }
    const NodeCut cut = first_cut(*l->light, tree, {.rays = 64}, {});
    std::size_t held = 0;
    for (std::uint32_t r = 0; r < cut.receivers.size(); ++r)
      for (const ElementId element : elements_below(tree, cut.receivers[r])) {
        EXPECT_EQ(cut.receiver_of_element[index(element)], r);
        ++held;
      }
    EXPECT_EQ(held, element_count(l->mesh));

    // What goes from a receiver to the others is what goes to their elements.
    const Transport links = between_receivers(cut);
    for (std::size_t r = 0; r < links.size; ++r) {
      const auto sum = [&](const Transport& rows) {
        return std::accumulate(
            rows.weights.begin() + std::ptrdiff_t(rows.row_begin[r]) * rows.bands,
            rows.weights.begin() + std::ptrdiff_t(rows.row_begin[r + 1]) * rows.bands, 0.0);
      };
      EXPECT_NEAR(sum(links), sum(cut.rows), 1e-5);
    }
  }
}

// A box that covers 2 x 2 of 16 x 16 elements of a floor:
// receivers are divided until what is covered is known as for elements.
TEST(Hierarchical, WhatStandsOnAFloorIsFound) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, diffuse(0.5, 1.0), wall, wall});
  add_box(scene, "box", {0.25, 0.0, 0.5}, {0.375, 0.3, 0.625}, wall);
  const auto l = lit(std::move(scene), {.element_size = 1.0 / 16.0});
  const RadiositySolution nodes = solve_pass_one(l->light, hierarchical(1.0 / 16.0, 0.5, 256));
  const RadiositySolution rows =
      solve_pass_one(l->light, by_rows(hierarchical(1.0 / 16.0, 0.5), 256));
  EXPECT_EQ(std::count(rows.exposed.begin(), rows.exposed.end(), 0.0F), 4);
  EXPECT_EQ(nodes.exposed, rows.exposed);
  EXPECT_EQ(std::count(nodes.exposed.begin(), nodes.exposed.end(), 0.0F), 4);
  EXPECT_LT(nodes.links->receivers, element_count(l->mesh) / 2);
}

TEST(Hierarchical, SameBitsForAnyNumberOfThreads) {
  std::vector<RadiositySolution> runs;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const auto l = lit(half_room_with_small_mirror(), {.element_size = 0.2});
    runs.push_back(solve_pass_one(l->light, hierarchical(0.2, 0.05, 64)));
  }
  for (const RadiositySolution& run : runs) {
    EXPECT_EQ(run.radiosity, runs[0].radiosity);
    EXPECT_EQ(run.irradiance, runs[0].irradiance);
    EXPECT_EQ(run.links->links, runs[0].links->links);
    EXPECT_EQ(run.shadow_rays, runs[0].shadow_rays);
  }
}

// Light that no surface emits is in the first light alone:
// black walls receive the same by receivers and by rows but for the share of the sky,
// which either counts by its rays; grey ones to the link error.
TEST(Hierarchical, LightFromOutsideIsCountedOnce) {
  for (const double rho : {0.0, 0.5}) {
    Scene scene;
    const Material wall = diffuse(rho);
    add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, wall);
    add_polygon(scene, "back", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, wall);
    add_polygon(scene, "mirror", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, mirror(0.9));
    scene.background = Rgb(0.2);
    PunctualLight lamp;
    lamp.intensity = Rgb(0.5);
    lamp.position = {0.4, 0.8, 0.6};
    scene.lights = {lamp};
    const PassOneSettings settings = hierarchical(0.0625, 0.01, 1024);
    const auto l = lit(std::move(scene), settings.mesh);
    const RadiositySolution nodes = solve_pass_one(l->light, settings);
    const RadiositySolution rows = solve_pass_one(l->light, by_rows(settings, 1024));
    const Agreement a = agreement(*l, nodes, rows);
    EXPECT_LT(a.rms, 0.02) << rho;
    EXPECT_LT(a.mean, 0.003) << rho;
    EXPECT_LT(std::abs(nodes.energy.imbalance), 0.01);
  }
}

TEST(Hierarchical, RoomsWithoutAbsorptionAreFoundOut) {
  const auto l = lit(furnace(1.0, {true}), {.element_size = 0.25});
  EXPECT_EQ(solve_pass_one(l->light, hierarchical(0.25, 0.05)).solver.end, SolverEnd::unsolvable);
}

// Beside a room like any other stands a white one with a lamp of its own, in which light would grow without end:
// it keeps what comes from its lamp, by either cut, and the other room is as it is alone.
TEST(Hierarchical, TrapsReflectNothingAndLeaveTheRestAsItIs) {
  const auto scene_of = [](bool with_trap) {
    Scene scene;
    const Material wall = diffuse(0.5);
    add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, diffuse(0.5, 1.0), wall, wall});
    const Material white = diffuse(1.0);
    if (with_trap) {
      const std::size_t first = scene.nodes.size();
      add_room(scene, Point3(2.0), Point3(3.0), {white, white, white, diffuse(1.0, 1.0), white, white});
      for (std::size_t n = first; n < scene.nodes.size(); ++n)
        scene.nodes[n].name = "trap." + scene.nodes[n].name;
    }
    return scene;
  };
  const PassOneSettings settings = hierarchical(0.125, 0.05);
  const auto both = lit(scene_of(true), settings.mesh), alone = lit(scene_of(false), settings.mesh);
  const RadiositySolution nodes = solve_pass_one(both->light, settings),
                          rows = solve_pass_one(both->light, by_rows(settings, 512)),
                          room = solve_pass_one(alone->light, settings);
  for (const RadiositySolution* solution : {&nodes, &rows}) {
    EXPECT_TRUE(solution->solver.converged);
    // The elements of the trap, and they alone; by rows its glowing wall has no light to reflect.
    EXPECT_GE(solution->solver.trapped.size(), element_count(both->mesh) / 2 * 5 / 6);
    EXPECT_LE(solution->solver.trapped.size(), element_count(both->mesh) / 2);
    for (const std::uint32_t e : solution->solver.trapped)
      EXPECT_GT(both->mesh.vertices[index(both->mesh.corners[e][0])].x, 1.5);
    // Its lamp alone: the floor of a cube sees F = 0.1998 of the ceiling (C-11), and reflects it once.
    // Direct light is at few points of each element: 2 %.
    EXPECT_NEAR(mean_over(*both, solution->radiosity, "trap.y0").g, 0.1998, 0.02 * 0.1998);
  }
  // Other samples: the error of the links.
  EXPECT_NEAR(mean_over(*both, nodes.radiosity, "y0").g, mean_over(*alone, room.radiosity, "y0").g,
              0.01 * mean_over(*alone, room.radiosity, "y0").g);
}

} // namespace
} // namespace meninas::test
