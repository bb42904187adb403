#include "radiosity/mesh/subdivision.h"
#include "radiosity/solvers/solve.h"
#include "radiosity/transport/translucency.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/translucent.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

Scene one_sheet() {
  Scene scene;
  add_polygon(scene, "sheet", {{0, 0, 0}, {2, 0, 0}, {2, 1.5, 0}, {0, 1, 0}},
              translucent({0.6, 0.4, 0.2}, 0.5, {0.9, 0.5, 0.3}));
  add_polygon(scene, "leaf", {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}},
              translucent(Rgb(0.5), 0.5, Rgb(0.5)));
  add_polygon(scene, "floor", {{0, -1, 1}, {2, -1, 1}, {2, -1, 0}, {0, -1, 0}}, diffuse(0.5));
  return scene;
}

/// Elements of the fronts of one sheet in three are divided.
ElementMesh divided_on_one_side(const LitScene& l, std::uint32_t stride) {
  std::vector<std::uint8_t> marked(element_count(l.mesh), 0);
  for (std::uint32_t e = 0; e < marked.size(); ++e)
    marked[e] =
        l.mesh.sides[index(l.mesh.side_of_element[e])].facing == Facing::front && e % stride == 0;
  return divide_elements(l.mesh, l.surfaces, marked);
}

double share_of(const TranslucentLinks& links, const ElementMesh& mesh, std::size_t row,
                std::size_t k) {
  return links.transmittance[k].r / mesh.transmittance[row].r;
}

void expect_back_to_back(const ElementMesh& mesh) {
  const TranslucentLinks links = translucent_links(mesh, {});
  ASSERT_EQ(links.row_begin.size(), element_count(mesh) + 1);
  const TranslucentLinks columns = transposed(links);
  std::size_t linked = 0;
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    const bool is_translucent = side_behind(mesh, mesh.side_of_element[e]) != none<SideId>;
    double sum = 0.0, sent = 0.0;
    for (auto k = links.row_begin[e]; k < links.row_begin[e + 1]; ++k, ++linked) {
      sum += share_of(links, mesh, e, k);
      const SideId own = mesh.side_of_element[e];
      EXPECT_EQ(side_behind(mesh, own), mesh.side_of_element[links.columns[k]]);
    }
    // What an element receives comes out behind it, no more and no less.
    for (auto k = columns.row_begin[e]; k < columns.row_begin[e + 1]; ++k)
      sent += columns.transmittance[k].r * mesh.area[columns.columns[k]] /
              (mesh.transmittance[e].r * mesh.area[e]);
    EXPECT_NEAR(sum, is_translucent ? 1.0 : 0.0, 1e-12);
    EXPECT_NEAR(sent, is_translucent ? 1.0 : 0.0, 1e-9) << e;
  }
  EXPECT_GT(linked, 0U);
}

TEST(Translucency, ElementsLieBackToBack) {
  const auto l = lit(one_sheet(), {.element_size = 0.3});
  expect_back_to_back(l->mesh);
}

TEST(Translucency, ElementsOfOneSideMayBeSmaller) {
  const auto l = lit(one_sheet(), {.element_size = 0.3});
  const ElementMesh mesh = divided_on_one_side(*l, 3);
  ASSERT_GT(element_count(mesh), element_count(l->mesh));
  expect_back_to_back(mesh);
}

TEST(Translucency, ThereAreNoLinksWithoutThem) {
  Scene scene;
  add_polygon(scene, "floor", {{0, -1, 1}, {2, -1, 1}, {2, -1, 0}, {0, -1, 0}},
              double_sided(diffuse(0.5)));
  const auto l = lit(scene, {.element_size = 0.5});
  EXPECT_TRUE(l->mesh.transmittance.empty());
  EXPECT_TRUE(translucent_links(l->mesh, {}).empty());
}

TEST(Translucency, WhereSomethingStandsBehindNothingComesThrough) {
  const auto l = lit(one_sheet(), {.element_size = 0.5});
  std::vector<float> exposed(element_count(l->mesh), 1.0F);
  const TranslucentLinks open = translucent_links(l->mesh, exposed);
  const std::uint32_t row = 0, behind = open.columns[open.row_begin[row]];
  exposed[behind] = 0.25F;
  const TranslucentLinks covered = translucent_links(l->mesh, exposed);
  EXPECT_NEAR(covered.transmittance[0].g, 0.25 * open.transmittance[0].g, 1e-12);
}

/// Rows of six unknowns, of which 0, 1 and 2, 3 lie back to back and 1 is larger than what is behind.
Transport random_rows(int bands) {
  Random random(7);
  Transport rows;
  rows.size = 6;
  rows.bands = bands;
  rows.row_begin = {0};
  for (std::uint32_t i = 0; i < 6; ++i) {
    for (std::uint32_t j = 0; j < 6; ++j)
      if ((i + 2 * j) % 3 != 0) {
        rows.columns.push_back(j);
        for (int band = 0; band < bands; ++band)
          rows.weights.push_back(static_cast<float>(random.between(0.0, 0.25)));
      }
    rows.row_begin.push_back(rows.columns.size());
  }
  return rows;
}

TranslucentLinks some_links() {
  return {{0, 1, 3, 4, 5, 5, 5},
          {1, 0, 2, 3, 2},
          {Rgb(0.3, 0.2, 0.1), Rgb(0.1, 0.2, 0.3), Rgb(0.2), Rgb(0.5), Rgb(0.4, 0.4, 0.0)}};
}

// X = S + rho H + tau H behind, H = T X: put in, whatever the solver.
TEST(Translucency, EverySolverSolvesTheEquationWithThem) {
  const std::vector<Rgb> reflectance{Rgb(0.4, 0.3, 0.2), Rgb(0.5), Rgb(0.3),
                                     Rgb(0.2, 0.5, 0.6), Rgb(0.7), Rgb(0.0)};
  const std::vector<Rgb> source{Rgb(1, 2, 3), Rgb(0.0), Rgb(0.5), Rgb(0.0), Rgb(0.1), Rgb(1.0)};
  for (const int bands : {1, 3})
    for (const SolverMethod method :
         {SolverMethod::direct, SolverMethod::jacobi, SolverMethod::gauss_seidel,
          SolverMethod::bicgstab, SolverMethod::progressive}) {
      const Transport rows = random_rows(bands);
      const TranslucentLinks links = some_links();
      const SolverResult result =
          solve(rows, source, {reflectance, links}, {.method = method, .tolerance = 1e-9});
      EXPECT_TRUE(result.converged) << name_of(method);
      const std::vector<Rgb> received = apply_transport(rows, result.radiosity);
      const std::vector<Rgb> again = scattered(reflectance, links, received);
      for (std::size_t i = 0; i < source.size(); ++i)
        for (int band = 0; band < 3; ++band)
          // Mixed rows are floats.
          EXPECT_NEAR(result.radiosity[i][band], source[i][band] + again[i][band], 1e-6)
              << name_of(method) << ' ' << i << ' ' << band;
    }
}

TEST(Translucency, RowsOfGreyOnesKeepOneBand) {
  const std::vector<Rgb> grey(6, Rgb(0.5));
  TranslucentLinks links = some_links();
  links.transmittance.assign(5, Rgb(0.25));
  EXPECT_EQ(mixed_rows(random_rows(1), grey, links).transport.bands, 1);
  links.transmittance[0] = Rgb(0.25, 0.25, 0.2);
  EXPECT_EQ(mixed_rows(random_rows(1), grey, links).transport.bands, 3);
}

} // namespace
} // namespace meninas::test
