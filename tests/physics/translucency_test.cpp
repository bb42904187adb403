// Sheets, which pass light to their other side: furnaces, layers, a sheet under a lamp, energy,
// and the method of images.
#include "form_factors/point_form_factor.h"
#include "tests/radiosity/solved.h"
#include "tests/support/rooms.h"
#include "tests/support/translucent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// The ways to solve pass one.
struct Way {
  const char* name;
  MeshCut cut = MeshCut::uniform;
  SolverMethod solver = SolverMethod::bicgstab;
  bool by_shots = false;
  FormFactorMethod factors = FormFactorMethod::rays;
  Interpolation interpolation = Interpolation::average;
};
class TranslucencyTest : public testing::TestWithParam<Way> {
protected:
  static PassOneSettings settings(double element_size = 0.25, double tolerance = 1e-5) {
    PassOneSettings settings;
    settings.cut = GetParam().cut;
    settings.mesh.element_size = element_size;
    settings.form_factors.method = GetParam().factors;
    settings.form_factors.rays = settings.interpolation.rays = 256;
    settings.form_factors.hemicube_resolution = 16;
    settings.solver.method = GetParam().solver;
    settings.solver.tolerance = tolerance;
    settings.interpolation.method = GetParam().interpolation;
    return settings;
  }
  static Solved solve(const Scene& scene, const PassOneSettings& settings) {
    return solved(scene, settings, GetParam().by_shots);
  }
};

INSTANTIATE_TEST_SUITE_P(
    Ways, TranslucencyTest,
    testing::Values(Way{"Rows"}, Way{"Jacobi", MeshCut::uniform, SolverMethod::jacobi},
                    Way{"Progressive", MeshCut::uniform, SolverMethod::progressive},
                    Way{"Shots", MeshCut::uniform, SolverMethod::progressive, true},
                    Way{"Hemicubes", MeshCut::uniform, SolverMethod::bicgstab, false,
                        FormFactorMethod::hemicube},
                    Way{"Nodes", MeshCut::hierarchical},
                    Way{"NodesAtVertices", MeshCut::hierarchical, SolverMethod::bicgstab, false,
                        FormFactorMethod::rays, Interpolation::gather}),
    [](const auto& way) { return way.param.name; });

/// A sheet across the middle of the unit cube, without an edge at its walls.
void add_sheet(Scene& scene, const Material& material) {
  add_polygon(scene, "sheet", {{0.2, 0.5, 0.2}, {0.8, 0.5, 0.2}, {0.8, 0.6, 0.8}, {0.2, 0.6, 0.8}},
              material);
}

// Walls glow with E = 1 and reflect 0.9: H = B = 10 everywhere, and a sheet that scatters all of it
// shows 10 as well, whatever of it it passes. Shots are samples: 1 % of noise.
TEST_P(TranslucencyTest, AWhiteSheetIsWhiteInAFurnace) {
  Scene scene = furnace(0.9, {});
  add_sheet(scene, translucent(Rgb(1.0), 0.3, Rgb(1.0)));
  const Solved found = solve(scene, settings());
  EXPECT_TRUE(found.solution.solver.converged);
  const double tolerance = GetParam().by_shots ? 0.01 : 1e-3;
  for (const NodeLight& node : found.nodes)
    for (int band = 0; band < 3; ++band) {
      EXPECT_NEAR(node.radiosity[band], 10.0, 10.0 * tolerance) << node.name;
      EXPECT_NEAR(node.irradiance[band], 10.0, 10.0 * tolerance) << node.name;
    }
  EXPECT_LT(std::abs(found.solution.energy.imbalance), tolerance);
}

TEST_P(TranslucencyTest, AGlowingColouredSheetIsAsItsRoom) {
  // In every channel it scatters 0.9: of red nearly all to the other side, of blue nothing.
  Scene scene = furnace(0.9, {});
  Material cloth = translucent({0.2, 0.8, 1.8}, 0.5, {1.6, 1.0, 0.0});
  cloth.emission = Rgb(1.0 / 3.14159265358979323846);
  add_sheet(scene, cloth);
  const Solved found = solve(scene, settings());
  for (const NodeLight& node : found.nodes)
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(node.radiosity[band], 10.0, GetParam().by_shots ? 0.1 : 0.01)
          << node.name << ' ' << band;
}

/// Floor, sheet and ceiling between perfect mirrors, each as good as infinite: from floor to
/// sheet and from sheet to ceiling all form factors are 1.
struct Layers {
  Rgb floor_reflectance{0.5, 0.3, 0.8}, floor_emission{1.0, 0.6, 0.8};
  Rgb ceiling_reflectance{0.7, 0.6, 0.2}, ceiling_emission{0.2, 0.1, 0.3};
  Rgb base{0.6, 0.8, 0.3}, passed{0.9, 0.4, 0.7};
  double t = 0.6, sheet_emission = 0.1;

  Scene scene() const {
    Scene scene;
    const Material side = mirror(1.0);
    add_room(scene, Point3(0.0), Point3(1.0),
             {side, side, diffuse(floor_reflectance, floor_emission),
              diffuse(ceiling_reflectance, ceiling_emission), side, side});
    Material cloth = translucent(base, t, passed);
    cloth.emission = Rgb(sheet_emission / 3.14159265358979323846);
    add_polygon(scene, "sheet", {{0, 0.4, 0}, {1, 0.4, 0}, {1, 0.4, 1}, {0, 0.4, 1}}, cloth);
    return scene;
  }

  struct Radiosities {
    double floor, ceiling, sheet; ///< of the sheet the mean of both sides
  };
  /// Of the sides of the sheet, down towards the floor and up:
  ///   B_d = E + rho (E_f + r_f B_d) + tau (E_c + r_c B_u),   B_u likewise.
  Radiosities exact(int band) const {
    const double rf = floor_reflectance[band], ef = floor_emission[band];
    const double rc = ceiling_reflectance[band], ec = ceiling_emission[band];
    const double rho = (1.0 - t) * base[band], tau = t * passed[band];
    const double a = 1.0 - rho * rf, b = -tau * rc, c = -tau * rf, d = 1.0 - rho * rc;
    const double down_source = sheet_emission + rho * ef + tau * ec,
                 up_source = sheet_emission + rho * ec + tau * ef;
    const double determinant = a * d - b * c;
    const double down = (down_source * d - b * up_source) / determinant,
                 up = (a * up_source - c * down_source) / determinant;
    return {ef + rf * down, ec + rc * up, 0.5 * (down + up)};
  }
};

TEST_P(TranslucencyTest, LayersBetweenMirrorsAreThoseOfTheirEquations) {
  const Layers layers;
  const Solved found = solve(layers.scene(), settings());
  EXPECT_TRUE(found.solution.solver.converged);
  const auto node = [&](const std::string& name) {
    return *std::ranges::find(found.nodes, name, &NodeLight::name);
  };
  const double tolerance = GetParam().by_shots ? 0.01 : 1e-3;
  for (int band = 0; band < 3; ++band) {
    const Layers::Radiosities exact = layers.exact(band);
    EXPECT_NEAR(node("y0").radiosity[band], exact.floor, tolerance * exact.floor) << band;
    EXPECT_NEAR(node("y1").radiosity[band], exact.ceiling, tolerance * exact.ceiling) << band;
    EXPECT_NEAR(node("sheet").radiosity[band], exact.sheet, tolerance * exact.sheet) << band;
  }
  EXPECT_LT(std::abs(found.solution.energy.imbalance), tolerance);
}

// A square of a centimetre under a lamp in the open: one side receives E F, F to 1e-4 that of its
// middle, and the other shows tau E F.
TEST_P(TranslucencyTest, ASmallSheetUnderALampGlowsBehind) {
  if (GetParam().factors != FormFactorMethod::rays || GetParam().by_shots)
    GTEST_SKIP() << "light from lamps is found alike";
  const std::vector<Point3> lamp{{-0.3, 1, -0.2}, {0.4, 1, -0.2}, {0.4, 1, 0.5}, {-0.3, 1, 0.5}};
  Scene scene;
  add_polygon(scene, "lamp", lamp, diffuse(Rgb(0.0), Rgb(5.0, 3.0, 1.0)));
  add_polygon(scene, "sheet",
              {{-0.005, 0, -0.005}, {0.005, 0, -0.005}, {0.005, 0, 0.005}, {-0.005, 0, 0.005}},
              translucent(Rgb(0.8), 0.25, {1.0, 0.5, 0.2}));
  // Black, and so large that the lamp is a small part of all there is: its light is found from it.
  add_polygon(scene, "ground", {{-5, -3, 5}, {5, -3, 5}, {5, -3, -5}, {-5, -3, -5}}, diffuse(0.0));
  const double factor = point_form_factor(Point3(0.0), {0, 1, 0}, lamp);
  PassOneSettings precise = settings(0.0);
  precise.mesh.target_elements = 4;
  precise.direct.shadow_rays = 64;
  const auto l = lit(scene, precise.mesh);
  const RadiositySolution solution = solve_pass_one(l->light, precise);
  std::size_t seen = 0;
  for (const std::size_t e : elements_of(*l, "sheet")) {
    const bool lit_side = l->mesh.sides[index(l->mesh.side_of_element[e])].normal.y > 0.0;
    for (int band = 0; band < 3; ++band) {
      const double received = Rgb(5.0, 3.0, 1.0)[band] * factor;
      const double share = lit_side ? 0.75 * 0.8 : 0.25 * Rgb(1.0, 0.5, 0.2)[band];
      EXPECT_NEAR(solution.radiosity[e][band], share * received, 1e-3 * received);
      EXPECT_NEAR(solution.irradiance[e][band], lit_side ? received : 0.0, 1e-3 * received);
    }
    seen += lit_side ? 1 : 2;
  }
  EXPECT_EQ(seen % 3, 0U) << "both sides are there";
  EXPECT_GT(seen, 0U);
}

/// A room with a lamp, a box and a curtain between them.
Scene room_with_curtain(bool with_mirror = true) {
  Scene scene = half_room();
  if (!with_mirror)
    scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);
  add_polygon(scene, "curtain",
              {{0.3, 0.9, 0.6}, {1.7, 0.9, 0.6}, {1.7, 2.2, 1.0}, {0.3, 2.2, 1.0}},
              translucent({0.7, 0.5, 0.4}, 0.5, {0.9, 0.6, 0.5}));
  return scene;
}

// As without the curtain: rows by 256 rays are reciprocal to 1 %.
TEST_P(TranslucencyTest, EnergyHolds) {
  const Solved found = solve(room_with_curtain(), settings(0.2));
  EXPECT_LT(std::abs(found.solution.energy.imbalance), 0.01);
  const Solved open = solve(room_with_curtain(false), settings(0.2));
  EXPECT_LT(std::abs(open.solution.energy.imbalance), 0.01);
  EXPECT_GT(open.solution.energy.escaped.g, 0.0);
}

// With a perfect mirror every node receives what it would receive in the doubled room.
TEST_P(TranslucencyTest, MirrorRoomIsDoubledRoom) {
  const Solved half = solve(room_with_curtain(), settings(0.2)),
               whole = solve(doubled(room_with_curtain()), settings(0.2));
  const auto node = [](const Solved& found, const std::string& name) {
    return *std::ranges::find(found.nodes, name, &NodeLight::name);
  };
  // Means over a node by other rays; nodes are coarser where more is to be solved.
  const double tolerance =
      GetParam().cut == MeshCut::hierarchical || GetParam().by_shots ? 0.03 : 0.01;
  for (const char* name : {"curtain", "x1", "y0", "y1", "z0", "z1"})
    for (int band = 0; band < 3; ++band) {
      const double expected = node(whole, name).radiosity[band];
      EXPECT_NEAR(node(half, name).radiosity[band], expected, tolerance * expected)
          << name << ' ' << band;
    }
}

// Nothing is behind the sheet but what comes through it, twice.
TEST_P(TranslucencyTest, AClosedPaperLanternGlows) {
  Scene scene;
  add_room(scene, Point3(0.0), Point3(2.0),
           {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
  add_box(scene, "paper", {0.7, 0.7, 0.7}, {1.3, 1.3, 1.3}, translucent(Rgb(0.8), 0.5, Rgb(0.8)));
  add_box(scene, "bulb", {0.95, 0.95, 0.95}, {1.05, 1.05, 1.05}, diffuse(0.0, 100.0));
  const Solved found = solve(scene, settings(0.2));
  // Of the power P = 6 W the paper passes or absorbs all: with rho = tau = 0.4 and a closed box
  // without losses inside, a share of 0.4 / (1 - 0.4) of what comes first, and the room sends some back.
  double through = 0.0;
  for (const NodeLight& node : found.nodes)
    if (node.name.size() == 2)
      through += node.area * node.irradiance.g * 0.5;
  EXPECT_GT(through, 0.3 * 6.0);
  EXPECT_LT(through, 4.0);
  EXPECT_LT(std::abs(found.solution.energy.imbalance), 0.02);
}

} // namespace
} // namespace meninas::test
