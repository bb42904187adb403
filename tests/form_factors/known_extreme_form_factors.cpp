// Form factors at the extremes of size and distance,
// of strips without end, of polygons for discs, and of closed solids.
#include "tests/form_factors/known_form_factors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {

// clang-format off
std::vector<PairCase> known_extreme_pair_form_factors() {
  return {
    {"par_sq.gap_100", "Howell C-11, X=Y=1/gap",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 1.0, 100.0}, {1.0, 1.0, 100.0}, {1.0, 0.0, 100.0}, {0.0, 0.0, 100.0}}, 3.18288667328291964e-5},
    {"par_sq.gap_1e3", "Howell C-11, X=Y=1/gap",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 1.0, 1000.0}, {1.0, 1.0, 1000.0}, {1.0, 0.0, 1000.0}, {0.0, 0.0, 1000.0}}, 3.18309673977380258e-7},
    {"par_sq.gap_1e4", "Howell C-11, X=Y=1/gap",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 1.0, 10000.0}, {1.0, 1.0, 10000.0}, {1.0, 0.0, 10000.0}, {0.0, 0.0, 10000.0}}, 3.18309884061724782e-9},
    {"par_sq.gap_1e6", "Howell C-11, X=Y=1/gap",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 1.0, 1000000.0}, {1.0, 1.0, 1000000.0}, {1.0, 0.0, 1000000.0}, {0.0, 0.0, 1000000.0}}, 3.18309886183578465e-13},
    {"par_rect.1x1e-3_gap_1", "Howell C-11, X=a/gap Y=b/gap",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.001, 0.0}, {0.0, 0.001, 0.0}},
     {{0.0, 0.001, 1.0}, {1.0, 0.001, 1.0}, {1.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}, 2.49999924237129936e-4},
    {"par_rect.1x1e-6_gap_1", "Howell C-11, X=a/gap Y=b/gap",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1e-06, 0.0}, {0.0, 1e-06, 0.0}},
     {{0.0, 1e-06, 1.0}, {1.0, 1e-06, 1.0}, {1.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}, 2.49999999999924237e-7},
    {"par_rect.1e-3x1e-3_gap_1", "Howell C-11, X=a/gap Y=b/gap",
     {{0.0, 0.0, 0.0}, {0.001, 0.0, 0.0}, {0.001, 0.001, 0.0}, {0.0, 0.001, 0.0}},
     {{0.0, 0.001, 1.0}, {0.001, 0.001, 1.0}, {0.001, 0.0, 1.0}, {0.0, 0.0, 1.0}}, 3.18309673977380258e-7},
    {"par_rect.1000x1_gap_1e-3", "Howell C-11, X=a/gap Y=b/gap",
     {{0.0, 0.0, 0.0}, {1000.0, 0.0, 0.0}, {1000.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 1.0, 0.001}, {1000.0, 1.0, 0.001}, {1000.0, 0.0, 0.001}, {0.0, 0.0, 0.001}}, 0.998999505034108578},
    {"perp.w1e-6_h1e-6_l1", "Howell C-14, H=h/l W=w/l (A1 is w x l, A2 is h x l)",
     {{0.0, 0.0, 0.0}, {1e-06, 0.0, 0.0}, {1e-06, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 1e-06}, {0.0, 0.0, 1e-06}}, 0.292893108495652399},
    {"perp.w1_h1e-3_l1", "Howell C-14, H=h/l W=w/l (A1 is w x l, A2 is h x l)",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.001}, {0.0, 0.0, 0.001}}, 4.9859202310506825e-4},
    {"perp.w1_h1e-6_l1", "Howell C-14, H=h/l W=w/l (A1 is w x l, A2 is h x l)",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 1e-06}, {0.0, 0.0, 1e-06}}, 4.99997492619688762e-7},
    {"perp.w1e6_h1e6_l1", "Howell C-14, H=h/l W=w/l (A1 is w x l, A2 is h x l)",
     {{0.0, 0.0, 0.0}, {1000000.0, 0.0, 0.0}, {1000000.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 1000000.0}, {0.0, 0.0, 1000000.0}}, 2.38238031123798322e-6},
    {"perp_sep.Y1_eo100_Z1_ro100", "Howell C-15 (16-term sum)",
     {{100.0, 0.0, 0.0}, {101.0, 0.0, 0.0}, {101.0, 1.0, 0.0}, {100.0, 1.0, 0.0}},
     {{0.0, 0.0, 100.0}, {0.0, 1.0, 100.0}, {0.0, 1.0, 101.0}, {0.0, 0.0, 101.0}}, 7.87863255281855115e-6},
    {"par_off.edge_adjacent_gap1e-3", "Howell C-13 (16-term sum)",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{1.0, 1.0, 0.001}, {2.0, 1.0, 0.001}, {2.0, 0.0, 0.001}, {1.0, 0.0, 0.001}}, 4.97398161859907005e-4},
    {"par_off.shift10_gap1", "Howell C-13 (16-term sum)",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{10.0, 1.0, 1.0}, {11.0, 1.0, 1.0}, {11.0, 0.0, 1.0}, {10.0, 0.0, 1.0}}, 3.16136373041681294e-5},
    {"par_off.shift100_gap1", "Howell C-13 (16-term sum)",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{100.0, 1.0, 1.0}, {101.0, 1.0, 1.0}, {101.0, 0.0, 1.0}, {100.0, 0.0, 1.0}}, 3.18288660326177925e-9},
    {"wedge_sq.179deg", "C-16",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {-0.9998476951563913, 1.0, 0.01745240643728351}, {-0.9998476951563913, 0.0, 0.01745240643728351}}, 2.36087831149833616e-5},
    {"poly.pentagon_square", "double contour integral",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.5, 2.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}}, 0.154124318248562558},
    {"poly.square_pentagon", "double contour integral",
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}},
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.5, 2.0, 0.0}, {0.0, 1.0, 0.0}}, 0.231186477372843838},
    {"poly.tri_par_small_to_big", "parallel right triangles legs 1 and 2, gap 1",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 1.0}, {0.0, 2.0, 1.0}, {2.0, 0.0, 1.0}}, 0.284312520989460086},
    {"poly.tri_par_big_to_small", "reverse",
     {{0.0, 0.0, 1.0}, {0.0, 2.0, 1.0}, {2.0, 0.0, 1.0}},
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, 0.0710781302473650214},
    {"poly.pyvf_square_triangle", "unit square z=0, triangle (1,0,1),(1,1,1),(0,1,1): half of C-11 by symmetry",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}},
     {{1.0, 0.0, 1.0}, {0.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, 0.0999124478491936915},
    {"poly.tri_perp_shared_leg", "right isosceles triangles, legs 1, in z=0 and x=0, sharing the leg on y",
     {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
     {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, 0.211324865405187118},
  };
}

namespace {

enum class Strips { parallel, perpendicular, wedge };

/// Hottel's crossed strings. Parallel strips of width 1 at a distance,
/// perpendicular ones of width 1 and another, or two of width 1 that enclose an angle in degrees.
struct StripCase {
  const char* name;
  Strips strips;
  double parameter;
  double form_factor;
};
const std::vector<StripCase> strip_cases{
    {"par_H1e-6", Strips::parallel, 1e-06, 0.9999990000005},
    {"perp_H1e-6", Strips::perpendicular, 1e-06, 4.9999975e-7},
    {"par_H1e-3", Strips::parallel, 0.001, 0.999000499999875},
    {"perp_H1e-3", Strips::perpendicular, 0.001, 4.99750000062499969e-4},
    {"par_H0.1", Strips::parallel, 0.1, 0.904987562112089027},
    {"perp_H0.1", Strips::perpendicular, 0.1, 0.0475062189439554865},
    {"par_H0.5", Strips::parallel, 0.5, 0.618033988749894848},
    {"perp_H0.5", Strips::perpendicular, 0.5, 0.190983005625052576},
    {"par_H1", Strips::parallel, 1.0, 0.414213562373095049},
    {"perp_H1", Strips::perpendicular, 1.0, 0.292893218813452476},
    {"par_H2", Strips::parallel, 2.0, 0.236067977499789696},
    {"perp_H2", Strips::perpendicular, 2.0, 0.381966011250105152},
    {"par_H10", Strips::parallel, 10.0, 0.0498756211208902702},
    {"perp_H10", Strips::perpendicular, 10.0, 0.475062189439554865},
    {"par_H1e3", Strips::parallel, 1000.0, 4.999998750000625e-4},
    {"perp_H1e3", Strips::perpendicular, 1000.0, 0.499750000062499969},
    {"par_H1e6", Strips::parallel, 1000000.0, 4.99999999999875e-7},
    {"perp_H1e6", Strips::perpendicular, 1000000.0, 0.49999975},
    {"wedge_1deg", Strips::wedge, 1.0, 0.991273464501626065},
    {"wedge_10deg", Strips::wedge, 10.0, 0.912844257252341826},
    {"wedge_30deg", Strips::wedge, 30.0, 0.741180954897479238},
    {"wedge_45deg", Strips::wedge, 45.0, 0.617316567634910228},
    {"wedge_60deg", Strips::wedge, 60.0, 0.5},
    {"wedge_90deg", Strips::wedge, 90.0, 0.292893218813452476},
    {"wedge_120deg", Strips::wedge, 120.0, 0.133974596215561353},
    {"wedge_150deg", Strips::wedge, 150.0, 0.0340741737109317133},
    {"wedge_179deg", Strips::wedge, 179.0, 3.80769358287112626e-5},
};

/// Between facing mirrors, images with up to n reflections.
struct DepthCase {
  double mirror_reflectance;
  int depth;
  double form_factor;
};
const std::vector<DepthCase> depth_cases{
    {1, 0, 0.199824895698387383},
    {1, 1, 0.371925874003042054},
    {1, 2, 0.402476774179075703},
    {1, 3, 0.409618298830268488},
    {1, 5, 0.412975676574105657},
    {1, 10, 0.414031743087268528},
    {1, 20, 0.414188983226499097},
    {0.9, 0, 0.199824895698387383},
    {0.9, 1, 0.354715776172576587},
    {0.9, 2, 0.379462005315163842},
    {0.9, 3, 0.384668176785883383},
    {0.9, 5, 0.386806071408058651},
    {0.9, 10, 0.387312482739034576},
    {0.9, 20, 0.387351797224296089},
    {0.5, 0, 0.199824895698387383},
    {0.5, 1, 0.285875384850714718},
    {0.5, 2, 0.293513109894723131},
    {0.5, 3, 0.294405800476122229},
    {0.5, 5, 0.294584733847554754},
    {0.5, 10, 0.294595149753849226},
    {0.5, 20, 0.294595182668737913},
};
// clang-format on

std::vector<Point3> regular_polygon(int n, double z, bool facing_up) {
  std::vector<Point3> corners;
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * (facing_up ? k : n - k) / n;
    corners.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  return corners;
}

/// Two strips and, at their ends, the mirrors that continue them for ever.
std::vector<ScenePolygon> strip_polygons(const StripCase& c) {
  const bool wedge = c.strips == Strips::wedge;
  const double angle = wedge ? c.parameter * std::numbers::pi / 180.0 : 0.5 * std::numbers::pi;
  const double width = wedge ? 1.0 : c.parameter;
  // The strips' cross-sections p q and r s in the plane y = 0, and that of the space between them;
  // mirrors at y = 0 and y = length.
  const double length = std::max(1.0, wedge ? 1.0 : c.parameter);
  using Section = Vec2;
  const Section p{0, 0}, q{1, 0};
  const bool parallel = c.strips == Strips::parallel;
  const Section r = parallel ? Section{0, c.parameter} : Section{0, 0};
  const Section s = parallel ? Section{1, c.parameter}
                             : Section{width * std::cos(angle), width * std::sin(angle)};
  const auto strip = [length](const Section& a, const Section& b) {
    return std::vector<Point3>{
        {a.x, 0, a.y}, {b.x, 0, b.y}, {b.x, length, b.y}, {a.x, length, a.y}};
  };
  const std::vector<Section> between = parallel ? std::vector{p, r, s, q} : std::vector{p, s, q};
  std::vector<Point3> near, far;
  for (const Section& corner : between) {
    near.emplace_back(corner.x, 0, corner.y);
    far.insert(far.begin(), Point3(corner.x, length, corner.y));
  }
  return {{"A", Role::diffuse, strip(p, q)},
          {"B", Role::diffuse, strip(s, r)},
          {"mirror_near", Role::mirror, near},
          {"mirror_far", Role::mirror, far}};
}

} // namespace

std::vector<PairCase> known_disc_polygon_form_factors() {
  const auto pair = [](const char* name, int n, double form_factor) {
    return PairCase{name, "double contour integral", regular_polygon(n, 0.0, true),
                    regular_polygon(n, 1.0, false), form_factor};
  };
  return {pair("ngon.8_r1_h1", 8, 0.363710714422825111),
          pair("ngon.16_r1_h1", 16, 0.37753205058906666),
          pair("ngon.32_r1_h1", 32, 0.380865679852947086),
          pair("ngon.64_r1_h1", 64, 0.381691438558506986)};
}

std::vector<ScenePolygon> known_strips(const std::string& name) {
  for (const StripCase& c : strip_cases)
    if (c.name == name)
      return strip_polygons(c);
  return {};
}

std::vector<SceneCase> known_strip_form_factors() {
  std::vector<SceneCase> cases;
  for (const StripCase& c : strip_cases)
    cases.push_back({c.name, "Hottel's crossed strings", c.name, "A", "B", 1.0, c.form_factor});
  return cases;
}

std::vector<SceneCase> known_depth_form_factors() {
  std::vector<SceneCase> cases;
  for (const DepthCase& c : depth_cases)
    cases.push_back({"spec.two_facing to a depth", "sum_{|k|<=n} rho^|k| F(A->B_k), C-13",
                     "two_facing", "A", "B", c.mirror_reflectance, c.form_factor, c.depth});
  return cases;
}

std::vector<ScenePolygon> known_solid(const std::string& name) {
  if (name == "cube")
    return {{"x0", Role::diffuse, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}},
            {"x1", Role::diffuse, {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}},
            {"y0", Role::diffuse, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}},
            {"y1", Role::diffuse, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}},
            {"z0", Role::diffuse, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
            {"z1", Role::diffuse, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}};
  const Point3 a{1, 1, 1}, b{1, -1, -1}, c{-1, 1, -1}, d{-1, -1, 1};
  return {{"a", Role::diffuse, {b, c, d}},
          {"b", Role::diffuse, {a, d, c}},
          {"c", Role::diffuse, {a, b, d}},
          {"d", Role::diffuse, {a, c, b}}};
}

std::vector<SceneCase> known_solid_form_factors() {
  constexpr double opposite = 0.199824895698387383, adjacent = 0.200043776075403154;
  std::vector<SceneCase> cases;
  for (const char* other : {"b", "c", "d"})
    cases.push_back({"solid.tetra", "by symmetry", "tetra", "a", other, 1.0, 1.0 / 3.0});
  cases.push_back({"solid.cube_opp", "C-11", "cube", "x0", "x1", 1.0, opposite});
  for (const char* other : {"y0", "y1", "z0", "z1"})
    cases.push_back({"solid.cube_adj", "closure", "cube", "x0", other, 1.0, adjacent});
  return cases;
}

} // namespace meninas::test
