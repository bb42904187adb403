// Flat lights that are no faces: what they send in closed form, that they block nothing, and mirrors.
#include "form_factors/point_form_factor.h"
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/relight.h"
#include "scenes/area_light.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A rectangle a x b about a point, level, that shines downwards (or upwards).
AreaLight level_light(const Point3& at, double a, double b, const Rgb& radiance, bool up = false) {
  AreaLight light;
  light.name = "light";
  light.radiance = radiance;
  light.axis = {0.0, up ? 1.0 : -1.0, 0.0};
  light.corners = {at + Vec3(-a, 0, -b) / 2.0, at + Vec3(a, 0, -b) / 2.0, at + Vec3(a, 0, b) / 2.0,
                   at + Vec3(-a, 0, b) / 2.0};
  if (up)
    std::reverse(light.corners.begin(), light.corners.end());
  return light;
}

Scene room(double reflectance, Point3 size = Point3(2.0, 2.0, 2.0)) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(reflectance));
  add_room(scene, Point3(0.0), size, walls);
  return scene;
}

Scene lit_room(double reflectance) {
  Scene scene = room(reflectance);
  scene.area_lights = {level_light({0.9, 1.4, 1.1}, 0.5, 0.4, Rgb(3.0, 2.0, 1.0))};
  return scene;
}

ArrivingLight arriving(const LitScene& l, const Point3& x, const Direction& n) {
  DirectWorkspace work;
  return direct_irradiance(*l.light, {.position = x, .normal = n}, {}, 7, work);
}

TEST(AreaLights, SendWhatLambertsFormulaSaysAndToOneSideAlone) {
  const auto l = lit(lit_room(0.0), {.element_size = 0.5});
  const AreaLight& light = l->scene.area_lights[0];
  EXPECT_NEAR(area_of(light), 0.2, 1e-12);
  ASSERT_EQ(l->light->emitters.size(), 1U);
  for (const auto& [x, n] : {std::pair{Point3(0.3, 0.01, 0.7), Direction(0, 1, 0)},
                             std::pair{Point3(1.99, 0.5, 1.0), Direction(-1, 0, 0)},
                             std::pair{Point3(1.0, 1.35, 0.01), Direction(0, 0, 1)}}) {
    const ArrivingLight found = arriving(*l, x, n);
    const double f = point_form_factor(x, n, light.corners);
    EXPECT_GT(f, 1e-3);
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(found.total[band], pi * light.radiance[band] * f, 1e-9);
    EXPECT_EQ(found.entering, found.total);
    EXPECT_EQ(found.punctual, Rgb(0.0));
  }
  EXPECT_EQ(arriving(*l, {1.0, 1.99, 1.0}, {0, -1, 0}).total, Rgb(0.0)) << "behind it";
}

TEST(AreaLights, BlockNoLightAndTakeUpNone) {
  Scene scene = room(0.0);
  add_polygon(scene, "lamp", {{0.5, 1.99, 0.5}, {1.5, 1.99, 0.5}, {1.5, 1.99, 1.5}, {0.5, 1.99, 1.5}},
              diffuse(0.0, 4.0));
  const Point3 below(1.0, 0.01, 1.0);
  const Rgb alone = arriving(*lit(scene, {.element_size = 0.5}), below, {0, 1, 0}).total;
  EXPECT_GT(alone.g, 0.1);
  scene.area_lights = {level_light({1.0, 1.0, 1.0}, 1.2, 1.2, Rgb(1e-9))};
  EXPECT_NEAR(arriving(*lit(scene, {.element_size = 0.5}), below, {0, 1, 0}).total.g, alone.g, 1e-7);
  scene.area_lights[0].radiance = Rgb(0.0);
  EXPECT_EQ(arriving(*lit(scene, {.element_size = 0.5}), below, {0, 1, 0}).total, alone);
}

// pi A L is sent out; a closed room keeps all of it. A mean over 16 points and more of each element.
TEST(AreaLights, AllThatTheySendArrives) {
  const auto l = lit(lit_room(0.0), {.element_size = 0.25});
  const RadiositySolution solution = solve_pass_one(l->light, {});
  double arrived = 0.0;
  for (std::size_t e = 0; e < l->mesh.area.size(); ++e)
    arrived += l->mesh.area[e] * solution.irradiance[e].r;
  EXPECT_NEAR(arrived, pi * 0.2 * 3.0, 0.005 * arrived);
  EXPECT_NEAR(solution.energy.emitted.r, arrived, 1e-6 * arrived);
  EXPECT_NEAR(solution.energy.absorbed.r, arrived, 1e-3 * arrived);
}

// A hair before each wall, facing inwards: each point sees light all over its hemisphere, and its own
// wall's light shines away from it. H = pi L / (1 - rho), as in a furnace.
TEST(AreaLights, AFurnaceOfThemIsEvenlyLit) {
  Scene scene = room(0.6);
  const double hair = 1e-3;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      AreaLight light;
      light.name = "light";
      light.radiance = Rgb(1.0);
      Vec3 n(0.0), u(0.0), v(0.0);
      n[axis] = -side;
      u[(axis + 1) % 3] = 1.0;
      v = glm::cross(n, u);
      const Point3 middle = Point3(1.0) - (1.0 - hair) * n;
      light.axis = n;
      light.corners = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
      scene.area_lights.push_back(light);
    }
  for (const MeshCut cut : {MeshCut::uniform, MeshCut::hierarchical}) {
    PassOneSettings settings;
    settings.cut = cut;
    settings.form_factors.rays = settings.interpolation.rays = 512;
    const auto l = lit(scene, {.element_size = 0.5});
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    // The hair at the edges is a crack of its width to half a metre of element.
    for (const char* wall : {"x0", "x1", "y0", "y1", "z0", "z1"})
      EXPECT_NEAR(mean_over(*l, solution.irradiance, wall).g, pi / 0.4, 0.01 * pi / 0.4) << wall;
  }
}

TEST(AreaLights, EveryMethodFindsThem) {
  double first = 0.0;
  for (const FormFactorMethod method :
       {FormFactorMethod::rays, FormFactorMethod::hemicube, FormFactorMethod::analytic})
    for (const SolverMethod solver : {SolverMethod::bicgstab, SolverMethod::progressive})
      for (const MeshCut cut : {MeshCut::uniform, MeshCut::hierarchical}) {
        if (cut == MeshCut::hierarchical &&
            (method != FormFactorMethod::rays || solver == SolverMethod::progressive))
          continue;
        PassOneSettings settings;
        settings.form_factors.method = method;
        settings.form_factors.rays = settings.interpolation.rays = 512;
        settings.solver.method = solver;
        settings.cut = cut;
        const auto l = lit(lit_room(0.5), {.element_size = 0.5});
        const double ceiling = mean_over(*l, solve_pass_one(l->light, settings).irradiance, "y1").r;
        first = first == 0.0 ? ceiling : first;
        // Hemicubes stand in the middle of elements half a metre wide: of a lamp that is a face, at the same
        // place, they find 1.9 % more as well.
        const double error = method == FormFactorMethod::hemicube ? 0.025 : 0.01;
        EXPECT_NEAR(ceiling, first, error * first);
      }
}

// The method of images: a mirror is an opening behind which everything is there once more.
TEST(AreaLights, AMirrorRoomIsTheDoubledRoom) {
  Scene half = half_room();
  std::erase_if(half.triangles, [&](const Triangle& triangle) {
    return is_emitter(half.materials[index(triangle.material)]);
  });
  half.area_lights = {level_light({0.6, 2.2, 1.0}, 0.5, 0.6, Rgb(5.0)),
                      level_light({1.4, 0.4, 2.0}, 0.3, 0.2, Rgb(9.0), true)};
  Scene whole = doubled(half);
  for (const AreaLight& light : half.area_lights) {
    AreaLight image = light;
    for (Point3& corner : image.corners)
      corner.x = -corner.x;
    std::reverse(image.corners.begin(), image.corners.end());
    whole.area_lights.push_back(image);
  }
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = 512;
  const auto mirrored = lit(half, {.element_size = 0.3}), both = lit(whole, {.element_size = 0.3});
  const auto in_mirror = solve_pass_one(mirrored->light, settings), in_both = solve_pass_one(both->light, settings);
  // 1.5 %: rows of 512 rays, and penumbrae that each finds by samples of its own.
  for (const char* wall : {"x1", "y0", "y1", "z0", "z1"}) {
    const double a = mean_over(*mirrored, in_mirror.irradiance, wall).g,
                 b = mean_over(*both, in_both.irradiance, wall).g;
    EXPECT_NEAR(a, b, 0.015 * b) << wall;
  }
}

TEST(AreaLights, AreLampsThatAreToldApartAndDimmed) {
  Scene scene = lit_room(0.5);
  scene.area_lights.push_back(level_light({1.4, 0.5, 0.6}, 0.3, 0.3, Rgb(6.0), true));
  scene.area_lights.back().name = "uplight";
  const auto groups = std::make_shared<const LampGroups>(find_lamps(scene, LampGrouping::node));
  EXPECT_EQ(groups->names, (std::vector<std::string>{"light", "uplight"}));
  const std::vector<Rgb> factors{Rgb(0.0), Rgb(2.0)};
  for (const FormFactorMethod method : {FormFactorMethod::rays, FormFactorMethod::analytic}) {
    PassOneSettings settings;
    settings.form_factors.method = method;
    auto l = lit(scene, {.element_size = 0.5});
    LightScene apart = *l->light;
    tell_lamps_apart(apart, groups);
    const auto light = std::make_shared<const LightScene>(apart);
    const RadiositySolution solution = solve_pass_one(light, settings);
    ASSERT_EQ(solution.field.by_lamp.size(), 2U);
    const IrradianceField dimmed = relit(solution.field, factors);
    ASSERT_EQ(dimmed.scene->emitters.size(), 1U) << "what is dark is no emitter";
    const auto truth = lit(relit(scene, *groups, factors), {.element_size = 0.5});
    const RadiositySolution solved = solve_pass_one(truth->light, settings);
    double sum = 0.0, other = 0.0;
    for (const auto& h : dimmed.irradiance)
      sum += double{h.g} / double(dimmed.irradiance.size());
    for (const auto& h : solved.field.irradiance)
      other += double{h.g} / double(solved.field.irradiance.size());
    EXPECT_NEAR(sum, other, 0.01 * other);
  }
}

// No ray meets an area light: as to a lamp without extent, a solid's faces are sheets to its light.
TEST(AreaLights, SolidGlassIsASheetToTheirLight) {
  Scene scene = room(0.0);
  add_box(scene, "block", {0.2, 0.6, 0.2}, {1.8, 0.8, 1.8}, solid_glass(Rgb(1.0)));
  scene.area_lights = {level_light({1.0, 1.5, 1.0}, 0.01, 0.01, Rgb(1000.0))};
  const auto l = lit(scene, {.element_size = 0.5});
  const double passed = 1.0 - face_reflectance(1.5, 1.0);
  const double f = point_form_factor({1.0, 0.01, 1.0}, {0, 1, 0}, scene.area_lights[0].corners);
  const double found = arriving(*l, {1.0, 0.01, 1.0}, {0, 1, 0}).total.g;
  // A light of a centimetre, straight above: both faces are crossed at less than half a degree.
  const double expected = 1000.0 * pi * f * passed * passed;
  EXPECT_NEAR(found, expected, 0.01 * expected);
}

} // namespace
} // namespace meninas::test
