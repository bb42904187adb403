// Light on the open part of elements on which something stands.
#include "radiosity/hierarchical/node_solution.h"
#include "radiosity/hierarchical/open_parts.h"
#include "scenes/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A box of 0.18 m^2 in the middle of a square metre, at an angle to the elements of the floor.
void add_box(Scene& scene, const Material& material, double height) {
  const double a = 0.3;
  const auto corner = [&](int k, double y) {
    const double angle = a + k * std::numbers::pi / 2.0;
    return Point3(0.5 + 0.3 * std::cos(angle), y, 0.5 - 0.3 * std::sin(angle));
  };
  for (int k = 0; k < 4; ++k)
    add_polygon(scene, "side" + std::to_string(k),
                {corner(k, 0.0), corner(k + 1, 0.0), corner(k + 1, height), corner(k, height)},
                material);
  add_polygon(scene, "top",
              {corner(0, height), corner(1, height), corner(2, height), corner(3, height)},
              material);
}

/// A furnace of E = 1 and rho = 1/2 in which a box stands.
Scene furnace_with_box() {
  Scene scene = furnace(0.5, {});
  add_box(scene, diffuse(0.5, 1.0), 0.4);
  return scene;
}

NodeSolution solved_by_nodes(const LightScene& light, const PassOneSettings& settings) {
  return solve_by_nodes(
      light, settings.form_factors, settings.direct, settings.hierarchical,
      lit_vertices(light, {settings.form_factors, settings.direct, settings.interpolation}),
      settings.solver);
}

SourceOfElements known_light(const NodeSolution& solution) {
  return {solution.first.from_source, solution.receivers.share_light};
}

/// Of elements that are covered in part, by ElementId.
std::vector<std::uint8_t> in_part(const std::vector<CoveredCells>& covered) {
  std::vector<std::uint8_t> parts;
  for (const CoveredCells cells : covered)
    parts.push_back(cells != 0 && cells != wholly_covered ? 1 : 0);
  return parts;
}

/// m^2 of those elements on which nothing stands.
double exposed_area(const ElementMesh& mesh, const std::vector<float>& exposed,
                    const std::vector<std::size_t>& elements) {
  double area = 0.0;
  for (const std::size_t e : elements)
    area += mesh.area[e] * double{exposed[e]};
  return area;
}

std::size_t covered_in_part(const std::vector<float>& exposed) {
  return static_cast<std::size_t>(
      std::ranges::count_if(exposed, [](float share) { return share > 0.0F && share < 1.0F; }));
}

// All surfaces have B = E / (1 - rho) = 2, and so much arrives, however near the foot:
// every ray from the open lands on one of them, and none on the black inside of the box.
// What is exposed of the floor is what the box leaves, 1 - 0.18. By 256 rays, a few of them to a
// cell, the shares of 19 elements through which the foot goes are off by 1 / 16 of half of their
// cells at the foot, some 20 of 64: 0.01 sqrt(19) of 0.01 m^2 each, four times that is 0.002.
TEST(OpenParts, OfAFurnaceReceiveWhatAllOfItDoes) {
  const auto l = lit(furnace_with_box(), {.element_size = 0.1});
  PassOneSettings settings;
  settings.form_factors.rays = 256;
  const std::vector<std::size_t> floor = elements_of(*l, "y0");
  for (const FormFactorMethod method : {FormFactorMethod::rays, FormFactorMethod::hemicube}) {
    settings.form_factors.method = method;
    const FormFactors rows = assemble_transport(*l->light, settings.form_factors);
    EXPECT_GT(covered_in_part(rows.exposed), 10);
    EXPECT_NEAR(exposed_area(l->mesh, rows.exposed, floor), 0.82, 0.002);
    // A foot that goes through cells none of which is covered, as the tip of a corner, is not seen.
    for (std::size_t e = 0; e < rows.exposed.size(); ++e)
      if (rows.exposed[e] > 0.0F) {
        EXPECT_LT(rows.closure[e].black, 1.0 / 64.0) << e;
      }
  }
  settings.form_factors.method = FormFactorMethod::rays;

  const NodeSolution solution = solved_by_nodes(*l->light, settings);
  const std::size_t size = element_count(l->mesh);
  const PointGathering gathering(*l->light, std::vector<Rgb>(size, Rgb(1.0)), {}, {},
                                 {.rays = 256});
  const std::vector<Rgb> irradiance(size, Rgb(2.0));
  PointWorkspaces workspaces;
  const auto parts = open_parts({irradiance, gathering, workspaces}, known_light(solution),
                                in_part(solution.receivers.covered), solution.receivers.covered);
  EXPECT_GT(parts.size(), 10);
  for (const OpenPart& part : parts) {
    const float exposed = solution.exposed[index(part.element)];
    EXPECT_TRUE(exposed > 0.0F && exposed < 1.0F) << exposed;
    EXPECT_NEAR(part.indirect.g, 2.0, 1e-6);
  }
  EXPECT_NEAR(exposed_area(l->mesh, solution.exposed, floor), 0.82, 0.002);
}

// A tile a tenth of a millimetre high shades nothing: where its foot goes through an element,
// the open part has the light of the floor without it, by other points of the element:
// over one of these light varies by 4 %, and means of eight points and more are off by less.
// Of the cells that are not covered, a fifth is under the tile all the same.
TEST(OpenParts, HaveAllOfTheLightFromTheSource) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}, diffuse(0.5));
  add_polygon(scene, "lamp", {{0, 3, 0}, {1, 3, 0}, {1, 3, 1}, {0, 3, 1}}, diffuse(0.0, 10.0));
  const auto bare = lit(scene, {.element_size = 0.1});
  add_box(scene, diffuse(0.5), 1e-4);
  const auto tiled = lit(scene, {.element_size = 0.1});
  const FormFactors rows = assemble_transport(*tiled->light, {});
  const DirectIrradiance without = direct_irradiance(*bare->light, {}, {}),
                         with = direct_irradiance(*tiled->light, rows.covered, {});
  std::size_t compared = 0;
  for (const std::size_t e : elements_of(*tiled, "floor"))
    if (rows.exposed[e] > 0.1F && rows.exposed[e] < 1.0F) {
      EXPECT_NEAR(with.irradiance[e].g / without.irradiance[e].g, 1.0, 0.02) << e;
      ++compared;
    }
  EXPECT_GT(compared, 10);
}

// Where boxes stand, elements have what is gathered there from what rows have found, at other
// points: means of four are off by some per cent, on both sides.
// By what the others of their receivers left they were off by 19 %.
// What rows themselves find there, by 512 rays each, is the same in sum.
TEST(OpenParts, AtTheFeetOfBoxesAreLitByWhatRowsFind) {
  const auto l =
      lit(load_gltf(source_dir() + "/scenes/gallery/cornell-mirror.gltf"),
          {.target_elements = 16000});
  PassOneSettings settings;
  const RadiositySolution rows = solve_pass_one(*l->light, settings);
  const NodeSolution solution = solved_by_nodes(*l->light, settings);
  settings.solver.method = SolverMethod::hierarchical;
  const RadiositySolution nodes = solve_pass_one(*l->light, settings);

  std::vector<Rgb> reflected = rows.radiosity;
  for (std::size_t e = 0; e < reflected.size(); ++e)
    reflected[e] -= l->mesh.emission[e];
  const PointGathering gathering(*l->light, reflected, {.seed = 7}, {}, {.rays = 512});
  PointWorkspaces workspaces;
  const auto parts = open_parts({rows.irradiance, gathering, workspaces}, known_light(solution),
                                in_part(solution.receivers.covered), solution.receivers.covered);
  EXPECT_GT(parts.size(), 50);
  double squares = 0.0, all = 0.0, from_rows = 0.0, from_nodes = 0.0;
  for (const OpenPart& part : parts) {
    const std::size_t e = index(part.element);
    const double expected = solution.first.from_source[e].g + part.indirect.g;
    const double area = l->mesh.area[e] * double{nodes.exposed[e]};
    squares += area * std::pow(nodes.irradiance[e].g - expected, 2.0);
    all += area * std::pow(expected, 2.0);
    from_nodes += area * nodes.irradiance[e].g;
    from_rows += l->mesh.area[e] * double{rows.exposed[e]} * rows.irradiance[e].g;
  }
  EXPECT_LT(std::sqrt(squares / all), 0.05);
  EXPECT_NEAR(from_nodes / from_rows, 1.0, 0.026);
}

} // namespace
} // namespace meninas::test
