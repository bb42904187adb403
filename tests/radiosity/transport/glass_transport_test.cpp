// Panes in every transport of pass one:
// rows close, energy is accounted for, and all of them find the same light.
#include "radiosity/transport/analytic_rows.h"
#include "radiosity/queries/gltf_node_factors.h"
#include "scenes/errors.h"
#include "tests/radiosity/solved.h"
#include "tests/support/glass_rooms.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.25;
  settings.form_factors.rays = 256;
  settings.form_factors.hemicube_resolution = 32;
  settings.interpolation.method = Interpolation::average;
  settings.solver.tolerance = 1e-4;
  return settings;
}

void expect_balance(const RadiositySolution& solution) {
  EXPECT_LT(solution.closure.max_error, 1e-5);
  EXPECT_LT(std::abs(solution.energy.imbalance), 0.02);
  EXPECT_EQ(solution.energy.escaped, Rgb(0.0));
  // The pane takes most of red and least of green.
  EXPECT_GT(solution.energy.mirror_absorbed.b, 2.0 * solution.energy.mirror_absorbed.g);
  EXPECT_GT(solution.energy.mirror_absorbed.r, solution.energy.mirror_absorbed.b);
  EXPECT_GT(solution.energy.mirror_absorbed.g, 0.0);
}

TEST(GlassTransport, HemicubesFindWhatRaysFind) {
  PassOneSettings settings = coarse();
  const Solved by_rays = solved(glazed_room(), settings);
  expect_balance(by_rays.solution);
  settings.form_factors.method = FormFactorMethod::hemicube;
  const Solved by_cubes = solved(glazed_room(), settings);
  expect_balance(by_cubes.solution);
  // The walls' means over 64 elements and more; a hemicube stands at the middle of its element.
  expect_alike(by_rays, by_cubes, 0.03);
}

TEST(GlassTransport, ShotsAndNodesFindWhatRowsFind) {
  PassOneSettings settings = coarse();
  const Solved by_rows = solved(glazed_room(), settings);
  settings.solver.method = SolverMethod::progressive;
  expect_alike(by_rows, solved(glazed_room(), settings, true), 0.03);
  settings.cut = MeshCut::hierarchical;
  const Solved by_nodes = solved(glazed_room(), settings);
  expect_alike(by_rows, by_nodes, 0.03);
  EXPECT_LT(by_nodes.solution.closure.max_error, 1e-5);
}

TEST(GlassTransport, PanesInARowKeepTheirRaysFew) {
  // Ten panes between a lamp and the wall:
  // each ray still ends in one place, and is traced once for each pane it meets.
  Scene scene = glazed_room();
  for (int k = 1; k < 10; ++k) {
    const double z = 0.8 - 0.05 * k;
    add_polygon(scene, "more", {{0.2, 0.0, z}, {1.8, 0.0, z}, {1.8, 1.7, z}, {0.2, 1.7, z}},
                glass({0.9, 1.0, 0.95}));
  }
  const Solved many = solved(scene, coarse());
  expect_balance(many.solution);
  const double elements = double(many.solution.radiosity.size());
  EXPECT_LT(double(many.solution.form_factor_rays), 10.0 * 256.0 * elements);
}

TEST(GlassTransport, AnalyticFactorsAreRefusedByName) {
  const auto l = lit(glazed_room(), coarse().mesh);
  FormFactorSettings settings;
  settings.method = FormFactorMethod::analytic;
  EXPECT_THROW(analytic_transport(*l->light, settings), UsageError);
}

} // namespace
} // namespace meninas::test
