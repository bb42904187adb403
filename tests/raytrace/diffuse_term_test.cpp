#include "form_factors/point_form_factor.h"
#include "raytrace/two_pass.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr std::array all_terms{DiffuseTerm::interpolated, DiffuseTerm::direct, DiffuseTerm::gather};

TwoPassSettings quick(int width, int height, DiffuseTerm term) {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 0.25;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 256;
  settings.render.width = width;
  settings.render.height = height;
  settings.render.samples = 4;
  settings.render.diffuse.term = term;
  settings.render.diffuse.points.rays = 256;
  return settings;
}

Rendering rendering_of(const Scene& scene, const TwoPassSettings& settings) {
  const auto prepared = prepare_scene(scene, settings.pass_one);
  return two_pass(*prepared, scene.cameras.at(0), settings).rendering;
}

double mean_of(const Image& image) {
  double sum = 0.0;
  for (const auto& pixel : image.pixels)
    sum += pixel.r + pixel.g + pixel.b;
  return sum / (3.0 * double(image.pixels.size()));
}

/// Only the floor scatters:
/// its light is that of the lamp and of the lamp's image behind the mirror x = 0.
struct LampAndImage {
  static constexpr double reflectance = 0.6, rho = 0.9, emitted = 10.0;
  std::vector<Point3> lamp{{1, 1, -0.5}, {1.5, 1, -0.5}, {1.5, 1, 0.5}, {1, 1, 0.5}};
  Scene scene;

  explicit LampAndImage(const Point3& seen) {
    add_polygon(scene, "floor", {{0.1, 0, -1}, {0.1, 0, 1}, {2.5, 0, 1}, {2.5, 0, -1}},
                diffuse(reflectance));
    add_polygon(scene, "lamp", lamp, diffuse(0.0, emitted));
    add_polygon(scene, "mirror", {{0, 0, 3}, {0, 0, -3}, {0, 4, -3}, {0, 4, 3}}, mirror(rho));
    scene.cameras = {look_at(seen + Vec3(0.0, 0.5, 0.4), seen, 1e-5)};
  }

  double exact(const Point3& seen) const {
    std::vector<Point3> image;
    for (auto corner = lamp.rbegin(); corner != lamp.rend(); ++corner)
      image.emplace_back(-corner->x, corner->y, corner->z);
    const Direction up(0, 1, 0);
    return emitted * reflectance / std::numbers::pi *
           (point_form_factor(seen, up, lamp) + rho * point_form_factor(seen, up, image));
  }
};

TEST(DiffuseTerm, DirectIsTheClosedFormAnywhereOnAnElement) {
  // Elements are a metre wide and the light changes by a factor over each: what is interpolated
  // is far off, what is computed at the hit is right to the rounding of the hit's place.
  for (const Point3 seen : {Point3(1.23, 0.0, 0.31), Point3(0.55, 0.0, -0.45)}) {
    const LampAndImage room(seen);
    const double exact = room.exact(seen);
    for (const DiffuseTerm term : all_terms) {
      TwoPassSettings settings = quick(1, 1, term);
      settings.pass_one.mesh.element_size = 1.2;
      const double radiance = rendering_of(room.scene, settings).image.at(0, 0).g;
      if (term == DiffuseTerm::interpolated)
        EXPECT_GT(std::abs(radiance - exact), 0.02 * exact) << "or else nothing is tested";
      else
        EXPECT_NEAR(radiance, exact, 1e-4 * exact) << static_cast<int>(term);
    }
  }
}

/// A wall in the sun, of radiance 1, and the slanting edge of a screen's shadow on it:
/// from row to row, of sixteen, a sixteenth of the pixel more is lit.
Scene edge_of_a_shadow() {
  Scene scene;
  add_polygon(scene, "wall", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, diffuse(0.5));
  add_polygon(scene, "screen", {{-2, -1.2, 2}, {-0.075, -1.2, 2}, {0.075, 1.2, 2}, {-2, 1.2, 2}},
              diffuse(0.0));
  PunctualLight sun{
      .name = "sun", .kind = PunctualKind::directional, .intensity = Rgb(2.0 * std::numbers::pi)};
  sun.direction = {0, 0, -1};
  scene.lights = {sun};
  scene.cameras = {look_at({0, 0, 1}, {0, 0, 0}, 2.0 * std::atan(0.4))};
  return scene;
}

TEST(DiffuseTerm, ShadowsOfPunctualLightsEndWithinPixels) {
  // Where four of a pixel's samples agree the others do not:
  // pixels lit by five sixths would be lit all over.
  TwoPassSettings settings = quick(1, 16, DiffuseTerm::direct);
  settings.render.samples = 64;
  const Image image = rendering_of(edge_of_a_shadow(), settings).image;
  for (int row = 0; row < 16; ++row)
    EXPECT_NEAR(image.at(0, row).g, (row + 0.5) / 16.0, 0.03) << row;
}

TEST(DiffuseTerm, AllAgreeInAFurnace) {
  // E = 1, rho = 1/2: B = 2 and L = 2 / pi.
  // Emitters are all there is, so they are gathered: no path may come twice.
  for (const DiffuseTerm term : all_terms) {
    TwoPassSettings settings = quick(8, 8, term);
    settings.pass_one.solver.tolerance = 1e-6;
    Scene scene = furnace(0.5, {false, true});
    scene.cameras = {look_at({0.4, 0.5, 0.9}, {0.6, 0.4, 0.0}, 1.5)};
    for (const auto& pixel : rendering_of(scene, settings).image.pixels)
      EXPECT_NEAR(pixel.g, 2.0 / std::numbers::pi, 1e-4) << static_cast<int>(term);
  }
}

TEST(DiffuseTerm, AllShowTheSameLight) {
  // In the mean over the picture what sharper shadows give to one pixel they take from another:
  // one per cent is the error of elements of a quarter of a metre;
  // a path counted twice would be tens of per cent.
  Scene scene = half_room_with_small_mirror();
  scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 0.6, 1.0}, 1.4)};
  const double interpolated =
      mean_of(rendering_of(scene, quick(24, 24, DiffuseTerm::interpolated)).image);
  for (const DiffuseTerm term : {DiffuseTerm::direct, DiffuseTerm::gather})
    EXPECT_NEAR(mean_of(rendering_of(scene, quick(24, 24, term)).image), interpolated,
                0.01 * interpolated)
        << static_cast<int>(term);
}

TEST(DiffuseTerm, LayersAddUpWhateverTheTerm) {
  Scene scene = half_room_with_small_mirror();
  scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 0.6, 1.0}, 1.4)};
  for (const DiffuseTerm term : {DiffuseTerm::direct, DiffuseTerm::gather}) {
    TwoPassSettings settings = quick(12, 12, term);
    const Image whole = rendering_of(scene, settings).image;
    settings.render.layers = WithLayers::yes;
    const Rendering layered = rendering_of(scene, settings);
    for (std::size_t p = 0; p < whole.pixels.size(); ++p) {
      glm::vec3 sum(0.0F);
      for (const Layer& layer : layered.layers)
        sum += layer.image.pixels[p];
      ASSERT_EQ(sum, layered.image.pixels[p]) << "exactly, in their order";
      // Four samples may settle in one of the two and go on in the other (shading.cpp:
      // half a per cent).
      for (int band = 0; band < 3; ++band)
        ASSERT_NEAR(sum[band], whole.pixels[p][band], 0.01 * whole.pixels[p][band]);
    }
  }
}

TEST(DiffuseTerm, DirectShadowsHaveTheWidthOfTheirPenumbra) {
  // A lamp of a millimetre two metres up, and a blade half way:
  // the shadow's edge is a millimetre wide, the elements are a metre.
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, diffuse(0.5));
  add_polygon(scene, "lamp",
              {{-5e-4, 2, -5e-4}, {5e-4, 2, -5e-4}, {5e-4, 2, 5e-4}, {-5e-4, 2, 5e-4}},
              diffuse(0.0, 1e6));
  add_polygon(scene, "blade", {{0, 1, 2}, {0, 1, -2}, {2, 1, -2}, {2, 1, 2}},
              double_sided(diffuse(0.0)));
  scene.cameras = {look_at({0.0, 0.5, 0.001}, {0.0, 0.0, 0.0}, 0.1)};
  TwoPassSettings settings = quick(32, 4, DiffuseTerm::direct);
  settings.pass_one.mesh.element_size = 1.0;
  const Image image = rendering_of(scene, settings).image;
  // The picture is 0.4 m wide; its pixels are 12.5 mm: all but the two at the edge are lit or dark.
  for (int x = 0; x < 32; ++x) {
    if (x == 15 || x == 16)
      continue;
    const double exact = 0.5 * 1e6 / std::numbers::pi * 1e-6 / (std::numbers::pi * 4.0);
    EXPECT_NEAR(image.at(x, 2).g, x < 16 ? exact : 0.0, 0.05 * exact) << x;
  }
}

TEST(DiffuseTerm, DirectPenumbraeAreRightInTheMean) {
  // A lamp of 0.2 m two metres up, and a blade half way, whose edge is x = 0:
  // from x on the floor the lamp is seen where its x' < -x.
  constexpr double emitted = 100.0, half = 0.1;
  const auto lamp = [](double right) {
    return std::vector<Point3>{
        {-half, 2, -half}, {right, 2, -half}, {right, 2, half}, {-half, 2, half}};
  };
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, diffuse(0.5));
  add_polygon(scene, "lamp", lamp(half), diffuse(0.0, emitted));
  add_polygon(scene, "blade", {{0, 1, 2}, {0, 1, -2}, {2, 1, -2}, {2, 1, 2}},
              double_sided(diffuse(0.0)));
  scene.cameras = {look_at({0.0, 0.5, 0.001}, {0.0, 0.0, 0.0}, 0.1)};
  TwoPassSettings settings = quick(32, 4, DiffuseTerm::direct);
  settings.pass_one.mesh.element_size = 1.0;
  settings.render.samples = 16;
  settings.render.diffuse.direct.shadow_rays = 8;
  settings.render.diffuse.direct.penumbra_rays = 16;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);

  constexpr int draws = 64, width = 32, rows = 4;
  std::array<double, width> mean{};
  for (int draw = 0; draw < draws; ++draw) {
    settings.render.seed = static_cast<std::uint32_t>(draw);
    const Image image =
        render(solution.field, scene.cameras[0], settings.render).image;
    for (int x = 0; x < width; ++x)
      for (int y = 0; y < rows; ++y)
        mean[static_cast<std::size_t>(x)] += image.at(x, y).g / (draws * rows);
  }
  // 64 rays or more a pixel are off by 0.05 of the full light; 256 pixels together by 0.003,
  // of which four are 0.012. To believe eight rays of a point where they agree,
  // and to send more where not, would be off by 0.02 at both ends of the penumbra.
  const double full = emitted * point_form_factor({-half, 0, 0}, {0, 1, 0}, lamp(half));
  for (int x = 0; x < width; ++x) {
    const double at = (x + 0.5 - width / 2) * 0.4 / width;
    const double seen = std::clamp(-at, -half, half);
    const double exact =
        seen > -half ? emitted * point_form_factor({at, 0, 0}, {0, 1, 0}, lamp(seen)) : 0.0;
    EXPECT_NEAR(mean[static_cast<std::size_t>(x)], exact * 0.5 / std::numbers::pi,
                0.012 * full * 0.5 / std::numbers::pi)
        << x;
  }
}

TEST(DiffuseTerm, DirectHasNoNoiseInThePenumbraOfAPlate) {
  // A plate under a lamp, and half of its shadow's edge in the picture:
  // no pixel is all lit or all dark.
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}, diffuse(0.5));
  add_polygon(scene, "lamp", {{-0.5, 2, -0.5}, {0.5, 2, -0.5}, {0.5, 2, 0.5}, {-0.5, 2, 0.5}},
              diffuse(0.0, 10.0));
  add_polygon(scene, "plate", {{-2, 1, -1}, {0, 1, -1}, {0, 1, 1}, {-2, 1, 1}}, diffuse(0.0));
  scene.cameras = {look_at({0.1, 0.9, 0.6}, {0.0, 0.0, 0.0}, 0.4)};
  TwoPassSettings settings = quick(24, 24, DiffuseTerm::direct);
  settings.render.samples = 16;
  const Image one = rendering_of(scene, settings).image;
  settings.render.seed = 1;
  const Image other = rendering_of(scene, settings).image;

  // Means settle to half a per cent (direct_of_pixel), nine of ten to a fifth of that. By rays to
  // the lamp alone they would be off by several times as much, as the first pixels of a tile are.
  std::vector<double> apart;
  for (std::size_t p = 0; p < one.pixels.size(); ++p)
    apart.push_back(std::abs(one.pixels[p].g / other.pixels[p].g - 1.0));
  std::ranges::sort(apart);
  EXPECT_LT(apart[apart.size() * 9 / 10], 0.0025);
  EXPECT_GT(apart.back(), 0.0) << "or else they are of one seed";
}

} // namespace
} // namespace meninas::test
