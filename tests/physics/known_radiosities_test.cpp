#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

/// One element per face; the direct light as a mean over many points, without need for shadow rays.
PassOneSettings one_patch_settings() {
  PassOneSettings settings;
  settings.mesh.element_size = 1e6;
  settings.form_factors.rays = 1 << 16;
  settings.direct.points = 1024;
  settings.direct.max_points = 1024;
  settings.direct.shadow_rays = settings.direct.penumbra_rays = settings.direct.rays_in_element = 1;
  settings.solver.tolerance = 1e-9;
  settings.interpolation.method = Interpolation::average;
  return settings;
}

/// The unit cube: the floor emits E = 1.
Scene lit_cube(double reflectance, double mirror_reflectance) {
  Scene scene;
  const Material wall = diffuse(reflectance);
  add_room(scene, Point3(0.0), Point3(1.0),
           {wall, mirror_reflectance < 0.0 ? wall : mirror(mirror_reflectance),
            diffuse(reflectance, 1.0), wall, wall, wall});
  return scene;
}

struct CubeCase {
  double reflectance, mirror_reflectance;
  std::vector<std::pair<const char*, double>> radiosity;
};

// Every row is a net of 65536 points, for which a form factor near 0.2 has a random
// error below 1.6e-3; a net of that many low-discrepancy points does ten times better,
// and light that goes round many times is wrong by its share only: 1e-3 of the value.
void expect_radiosities(const CubeCase& c) {
  const PassOneSettings settings = one_patch_settings();
  const auto l = lit(lit_cube(c.reflectance, c.mirror_reflectance), settings.mesh);
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  EXPECT_TRUE(solution.solver.converged);
  for (const auto& [node, exact] : c.radiosity)
    EXPECT_NEAR(mean_over(*l, solution.radiosity, node).r, exact, 1e-3 * exact)
        << node << ' ' << c.reflectance << ' ' << c.mirror_reflectance;
}

// Six one-patch faces, F between opposite faces 0.199824895698387383 (C-11),
// between neighbours 0.200043776075403154 (C-14);
// the 3 x 3 system of floor, walls and ceiling solved in higher precision.
TEST(KnownRadiosities, CubeOfSixPatches) {
  expect_radiosities({0.2,
                      -1.0,
                      {{"y0", 1.00961538597826049},
                       {"x0", 0.0480850173565731852},
                       {"y1", 0.0480445445954467649}}});
  expect_radiosities(
      {0.5,
       -1.0,
       {{"y0", 1.09090909810769547}, {"z1", 0.181836268946129011}, {"y1", 0.181745826107788481}}});
  expect_radiosities(
      {0.8,
       -1.0,
       {{"y0", 1.55172415364491464}, {"x1", 0.689681193904361933}, {"y1", 0.689551070737637626}}});
  expect_radiosities(
      {0.9,
       -1.0,
       {{"y0", 2.37288137482575707}, {"z0", 1.52545201851242576}, {"y1", 1.52531055112453987}}});
  expect_radiosities(
      {0.99,
       -1.0,
       {{"y0", 17.3622704725972643}, {"x0", 16.5275760999202657}, {"y1", 16.527425127721673}}});
}

// The wall x = 1 a mirror: form factors of the doubled box 2 x 1 x 1.
// A black mirror is an opening in effect.
TEST(KnownRadiosities, CubeWithAMirror) {
  expect_radiosities({0.5,
                      1.0,
                      {{"y0", 1.1114235513206098},
                       {"y1", 0.236485217737471186},
                       {"z0", 0.218455825648003655},
                       {"x0", 0.215179579645911701}}});
  expect_radiosities({0.8,
                      1.0,
                      {{"y0", 1.66733031622334667},
                       {"y1", 0.85346220405127841},
                       {"z1", 0.827988996893845104},
                       {"x0", 0.823229485937684709}}});
  expect_radiosities({0.5,
                      1e-9,
                      {{"y0", 1.06060003866213495},
                       {"y1", 0.151436766662227955},
                       {"z0", 0.151527209500568485},
                       {"x0", 0.151542284806389353}}});
  expect_radiosities({0.8,
                      1e-9,
                      {{"y0", 1.24518761613723548},
                       {"y1", 0.383014533229958462},
                       {"z1", 0.383144656396682769},
                       {"x0", 0.383202491096729316}}});
}

// Two open unit squares, E1 = 1: B1 = 1 / (1 - rho^2 F^2), B2 = rho F B1.
TEST(KnownRadiosities, TwoOpenSquares) {
  struct Case {
    std::vector<Point3> second;
    double reflectance, b1, b2;
  };
  const std::vector<Point3> facing{{0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}},
      beside{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  for (const Case& c : {Case{beside, 0.5, 1.01010547710028349, 0.10103265693679369},
                        Case{facing, 0.5, 1.01008315227492456, 0.100919880275017571},
                        Case{beside, 0.9, 1.0335000622148356, 0.186070729517657807},
                        Case{facing, 0.9, 1.03342434433895212, 0.185853520637734928}}) {
    Scene scene;
    add_polygon(scene, "1", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                diffuse(c.reflectance, 1.0));
    add_polygon(scene, "2", c.second, diffuse(c.reflectance));
    const PassOneSettings settings = one_patch_settings();
    const auto l = lit(std::move(scene), settings.mesh);
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    EXPECT_NEAR(mean_over(*l, solution.radiosity, "1").r, c.b1, 1e-3 * c.b1);
    EXPECT_NEAR(mean_over(*l, solution.radiosity, "2").r, c.b2, 1e-3 * c.b2);
  }
}

// Area means at the limit of fine meshes, known to 2e-5.
// Elements of 1/16 are within 1e-3 of that limit, as is their noise.
TEST(KnownRadiosities, CubesOfManyElements) {
  const auto expect = [](const CubeCase& c) {
    PassOneSettings settings;
    settings.mesh.element_size = 1.0 / 16.0;
    settings.form_factors.rays = 256;
    settings.interpolation.method = Interpolation::average;
    const auto l = lit(lit_cube(c.reflectance, c.mirror_reflectance), settings.mesh);
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    for (const auto& [node, exact] : c.radiosity)
      EXPECT_NEAR(mean_over(*l, solution.radiosity, node).r, exact, 2e-3 * exact) << node;
  };
  expect({0.5, -1.0, {{"y0", 1.104364}, {"x0", 0.181105}, {"y1", 0.171216}}});
  expect({0.8, -1.0, {{"y0", 1.587514}, {"x0", 0.687877}, {"y1", 0.660977}}});
  expect({0.5, 1.0, {{"y0", 1.120367}, {"y1", 0.230121}, {"z0", 0.218565}, {"x0", 0.212379}}});
}

// CIE 171:2006, case 5.8: in a closed room of uniform reflectance the area mean
// of the indirect irradiance is rho Phi / ((1 - rho) S), however the light is spread.
// With Phi the power of a lamp that stands against no wall: here Phi = E A of a floor of the cube.
TEST(KnownRadiosities, MeanIndirectLightOfAClosedRoom) {
  for (const double rho : {0.2, 0.5, 0.9}) {
    PassOneSettings settings;
    settings.mesh.element_size = 0.2;
    settings.form_factors.rays = 256;
    settings.interpolation.method = Interpolation::average;
    const auto l = lit(lit_cube(rho, -1.0), settings.mesh);
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    Rgb total(0.0);
    for (std::size_t e = 0; e < element_count(l->mesh); ++e)
      total += l->mesh.area[e] * solution.irradiance[e];
    const double exact =
        1.0 / (1.0 - rho); // all of the light, first and reflected: Phi (1 + rho + rho^2 + ...)
    EXPECT_NEAR(total.r, exact, 2e-3 * exact);
  }
}

} // namespace
} // namespace meninas::test
