// What a picture says about its own error, against its error.
#include "image/metrics/relative_error.h"
#include "raytrace/error/error_map.h"
#include "raytrace/error/picture_error.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meninas::test {
namespace {

Scene lit_room() {
  Scene scene = half_room_with_small_mirror();
  scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 0.6, 1.0}, 1.4)};
  return scene;
}

TwoPassSettings quick() {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 0.3;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 128;
  settings.render.width = settings.render.height = 40;
  settings.render.samples = 16;
  return settings;
}

/// Pass one once, pictures as wanted.
struct Lit {
  std::shared_ptr<const PreparedScene> prepared;
  RadiositySolution solution;

  Lit(const Scene& scene, const TwoPassSettings& settings)
      : prepared(prepare_scene(scene, settings.pass_one)),
        solution(solve_pass_one(prepared->light(), settings.pass_one)) {}
  const LightScene& light() const { return *solution.field.scene; }
  const Camera& camera() const { return prepared->scene.cameras.front(); }
  Image picture(const RenderSettings& settings) const {
    return render(solution.field, camera(), settings).image;
  }
  PictureError error(const TwoPassSettings& settings, const Image& picture) const {
    return estimate_error(solution.field, camera(), settings, solution.solver,
                          {picture, {}}, {.gathered_pixels = 256, .pixels = 1024});
  }
  /// Relative, outside emitters.
  double off(const TwoPassSettings& settings, const Image& picture, const Image& truth) const {
    return relative_error(
        picture, truth,
        emitter_pixels(solution.field, camera(), settings.render, truth, 16));
  }
};

/// The same light gathered at every hit.
RenderSettings gathered(RenderSettings settings) {
  settings.diffuse.term = DiffuseTerm::gather;
  settings.diffuse.points.rays = 256;
  return settings;
}

TEST(Probes, AreThePixelsOfThePicture) {
  // With a pixel filter all rays are traced, by a picture as by probes, but in other packets:
  // mirrors reflect those together that meet them together. That is the last bit.
  TwoPassSettings settings = quick();
  settings.render.width = 24;
  settings.render.height = 20;
  settings.render.samples = 16;
  settings.render.filter = PixelFilter::gaussian;
  const Lit lit(lit_room(), settings);
  const std::vector<glm::ivec2> pixels{{0, 0}, {23, 19}, {7, 3}, {7, 4}, {12, 11}};
  const Image picture = lit.picture(settings.render);
  const ProbedPixels probed =
      render_pixels(lit.solution.field, lit.camera(), settings.render, pixels);
  ASSERT_EQ(probed.radiance.size(), pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k)
    for (int c = 0; c < 3; ++c)
      EXPECT_FLOAT_EQ(probed.radiance[k][c], picture.at(pixels[k].x, pixels[k].y)[c]) << k;
}

TEST(Probes, AreAlmostThoseOfAPictureThatIsSureOfItsPaths) {
  TwoPassSettings settings = quick();
  settings.render.width = 24;
  settings.render.height = 20;
  const Lit lit(lit_room(), settings);
  const std::vector<glm::ivec2> pixels{{0, 0}, {23, 19}, {7, 3}, {7, 4}, {12, 11}};
  for (const DiffuseTerm term :
       {DiffuseTerm::interpolated, DiffuseTerm::direct, DiffuseTerm::gather}) {
    settings.render.samples = term == DiffuseTerm::interpolated ? 16 : 1;
    settings.render.diffuse.term = term;
    const Image picture = lit.picture(settings.render);
    const ProbedPixels probed =
        render_pixels(lit.solution.field, lit.camera(), settings.render, pixels);
    ASSERT_EQ(probed.radiance.size(), pixels.size());
    for (std::size_t k = 0; k < pixels.size(); ++k)
      if (term == DiffuseTerm::interpolated) {
        // The rays of a probe are traced, those of a picture's tile may be sure without:
        // the same but for the rounding of (u, v), times some tens of such steps across an element.
        const glm::vec3 seen = picture.at(pixels[k].x, pixels[k].y);
        EXPECT_LT(glm::length(probed.radiance[k] - seen), 1e-5F * glm::length(seen)) << k;
      } else // samples at hits are drawn by the pixel's number in its tile: the same light, other noise
        EXPECT_NEAR(probed.radiance[k].g, picture.at(pixels[k].x, pixels[k].y).g,
                    0.25F * picture.at(pixels[k].x, pixels[k].y).g)
            << k;
  }
}

TEST(Probes, AnotherDrawKeepsTheCameraRays) {
  // What is interpolated depends on camera rays alone;
  // what is gathered on the samples at their hits too.
  TwoPassSettings settings = quick();
  settings.render.samples = 1;
  const Lit lit(lit_room(), settings);
  const auto differ = [&](DiffuseTerm term) {
    settings.render.diffuse.term = term;
    settings.render.diffuse.draw = 0;
    const Image first = lit.picture(settings.render);
    settings.render.diffuse.draw = 1;
    return first.pixels != lit.picture(settings.render).pixels;
  };
  EXPECT_FALSE(differ(DiffuseTerm::interpolated));
  EXPECT_TRUE(differ(DiffuseTerm::gather));
}

TEST(EmitterPixels, AreThoseOfTheLampAndTheirNeighbours) {
  Scene scene;
  add_polygon(scene, "wall", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, diffuse(0.5));
  add_polygon(scene, "lamp",
              {{-0.5, -0.5, 0.1}, {0.0, -0.5, 0.1}, {0.0, 0.0, 0.1}, {-0.5, 0.0, 0.1}},
              double_sided(diffuse(0.0, 10.0)));
  scene.cameras = {look_at({0, 0, 3.1}, {0, 0, 0}, 2.0 * std::atan(1.0 / 3.0))};
  TwoPassSettings settings = quick();
  const Lit lit(scene, settings);
  const Image picture = lit.picture(settings.render);
  const auto emits =
      emitter_pixels(lit.solution.field, lit.camera(), settings.render, picture, 4);
  // 40 pixels are 2 m at the lamp: it covers ten by ten of them, and its rim is one more.
  EXPECT_EQ(std::accumulate(emits.begin(), emits.end(), 0), 12 * 12);
}

TEST(PictureError, IsThatOfTheField) {
  // The truth is the light gathered from the same field at every hit with many samples;
  // camera rays are the same, so that only the field is off.
  // 1,024 of 1,600 pixels leave sampling errors of some per cent.
  TwoPassSettings settings = quick();
  const Lit lit(lit_room(), settings);
  const Image picture = lit.picture(settings.render);
  const double error = lit.off(settings, picture, lit.picture(gathered(settings.render)));
  const PictureError estimate = lit.error(settings, picture);
  const double field = std::hypot(estimate.mesh, estimate.form_factors, estimate.mirror_tail);
  EXPECT_GT(error, 0.03) << "or else nothing is tested";
  EXPECT_NEAR(field, error, 0.25 * error);
  EXPECT_NEAR(estimate.total, std::hypot(field, estimate.pixels, estimate.solver), 1e-9);
}

TEST(PictureError, OfGatheredLightIsThatOfWhatItIsGatheredFrom) {
  // Elements of 1.2 m, which cannot be right; the truth is gathered from some of 0.15 m.
  // One more bounce does not tell what those after it would change:
  // walls reflect about a half, and after a bounce light has the most of its unevenness behind it.
  TwoPassSettings settings = quick();
  settings.render = gathered(settings.render);
  settings.pass_one.mesh.element_size = 0.15;
  const Lit fine(lit_room(), settings);
  const Image truth = fine.picture(settings.render);
  EXPECT_LT(fine.error(settings, truth).mesh, 0.01);
  settings.pass_one.mesh.element_size = 1.2;
  const Lit coarse(lit_room(), settings);
  const Image picture = coarse.picture(settings.render);
  const double error = coarse.off(settings, picture, truth);
  EXPECT_GT(error, 0.03) << "or else nothing is tested";
  EXPECT_NEAR(coarse.error(settings, picture).mesh, error, 0.4 * error);
}

// Sun through a hole of 1 x 1 m onto a floor: light is one of two values, and all that cells as small as a
// fifth of a pixel are off by is on both sides of the edges, within the pixels these cross.
// One ray a pixel shows it; the mean of its sixteen hardly does.
TEST(PictureError, OfCellsWithinPixelsIsThatOfTheMeanOfAPixel) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, diffuse(0.5));
  add_polygon(scene, "left", {{-9, 1, 9}, {-9, 1, -9}, {-0.5, 1, -9}, {-0.5, 1, 9}}, diffuse(0.0));
  add_polygon(scene, "right", {{0.5, 1, 9}, {0.5, 1, -9}, {9, 1, -9}, {9, 1, 9}}, diffuse(0.0));
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.intensity = Rgb(10.0);
  sun.direction = glm::normalize(Vec3(0.13, -1.0, 0.0));
  scene.lights = {sun};
  scene.cameras = {look_at({0.1, 0.9, 0.9}, {0.1, 0.0, 0.0}, 1.2)};
  TwoPassSettings settings = quick();
  settings.render.diffuse.term = DiffuseTerm::direct;
  settings.render.diffuse.refinement.finest = 0.2;
  const Lit lit(scene, settings);
  const Rendering picture = render(lit.solution.field, lit.camera(), settings.render);
  ASSERT_NE(picture.finer, nullptr);
  RenderSettings exact = settings.render;
  exact.diffuse.term = DiffuseTerm::gather;
  const double error = lit.off(settings, picture.image, lit.picture(exact));
  const PictureError estimate =
      estimate_error(lit.solution.field, lit.camera(), settings, lit.solution.solver,
                     {picture.image, {}, picture.finer.get()},
                     {.gathered_pixels = 256, .pixels = 1024});
  RenderSettings one = exact, shown = settings.render;
  one.samples = shown.samples = 1;
  const double of_a_ray = lit.off(settings, lit.picture(shown), lit.picture(one));
  EXPECT_GT(of_a_ray, 2.0 * error) << "or else nothing is tested";
  EXPECT_LT(estimate.mesh, 0.5 * of_a_ray);
  EXPECT_LT(std::hypot(estimate.mesh, estimate.form_factors), 2.0 * error + 0.005);
}

TEST(PictureError, OfFormFactorsIsNotThatOfShadowRays) {
  // One shadow ray a hit makes direct light noisy, that of elements as it was.
  // Few pixels leave some per cent.
  TwoPassSettings settings = quick();
  const Lit lit(lit_room(), settings);
  const Image picture = lit.picture(settings.render);
  const double many = lit.error(settings, picture).form_factors;
  settings.pass_one.direct.shadow_rays = settings.pass_one.direct.penumbra_rays = 1;
  const double one = lit.error(settings, picture).form_factors;
  EXPECT_GT(many, 0.0);
  EXPECT_NEAR(one, many, 0.1 * many);
}

TEST(PictureError, OfCameraRaysIsWhatFewOfThemMiss) {
  TwoPassSettings settings = quick();
  const Lit lit(lit_room(), settings);
  settings.render.samples = 4;
  RenderSettings many = settings.render;
  many.samples = 1024;
  const Image picture = lit.picture(settings.render);
  const double error = lit.off(settings, picture, lit.picture(many));
  EXPECT_NEAR(lit.error(settings, picture).pixels, error, 0.3 * error);
}

TEST(PictureError, OfAdaptiveCameraRaysIsThatOfThePixelsThatHaveMany) {
  // Few pixels have many samples.
  // Drawn by their share of the picture only a handful of them would be looked at.
  TwoPassSettings settings = quick();
  const Lit lit(lit_room(), settings);
  settings.render.samples = 64;
  settings.render.pixel_error = 0.05;
  const Rendering some = render(lit.solution.field, lit.camera(), settings.render);
  ASSERT_GT(std::ranges::count(some.samples, 4U), 0);
  ASSERT_GT(std::ranges::count(some.samples, 64U), 0);
  RenderSettings many = settings.render;
  many.samples = 1024;
  many.pixel_error = 0.0;
  const double error = lit.off(settings, some.image, lit.picture(many));
  const PictureError estimate =
      estimate_error(lit.solution.field, lit.camera(), settings, lit.solution.solver,
                     {some.image, some.samples}, {.gathered_pixels = 256, .pixels = 1024});
  EXPECT_NEAR(estimate.pixels, error, 0.3 * error);
}

TEST(PictureError, OfCameraRaysIsThatOfAllPixelsFromAFew) {
  // 64 pixels four times, as they have four samples, of 1,600;
  // over the seeds of the choice their mean square is that of all.
  TwoPassSettings settings = quick();
  const Lit lit(lit_room(), settings);
  settings.render.samples = 4;
  const Image picture = lit.picture(settings.render);
  constexpr int seeds = 32;
  double few = 0.0, few2 = 0.0, all = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    settings.render.seed = static_cast<std::uint32_t>(seed);
    const auto square = [&](int pixels) {
      const PictureError error = estimate_error(lit.solution.field, lit.camera(),
                                                settings, lit.solution.solver, {picture, {}},
                                                {.gathered_pixels = 8, .pixels = pixels});
      return error.pixels * error.pixels;
    };
    const double found = square(64);
    few += found / seeds;
    few2 += found * found / seeds;
    all += square(1024) / seeds;
  }
  const double sigma = std::sqrt(few2 - few * few);
  EXPECT_NEAR(few, all, 4.0 * sigma / std::sqrt(double(seeds)));
  EXPECT_LT(sigma, 0.25 * all) << "which are drawn alike leave 0.6";
}

TEST(PictureError, OfASinglePixelIsFinite) {
  TwoPassSettings settings = quick();
  settings.render.width = settings.render.height = 1;
  const Lit lit(lit_room(), settings);
  const PictureError error = lit.error(settings, lit.picture(settings.render));
  EXPECT_TRUE(std::isfinite(error.total));
  EXPECT_GE(error.pixels, 0.0);
}

TEST(PictureError, OfAMirrorDepthIsTheLightBeyondIt) {
  // The mirror seen black, and nothing by way of it: nearly all of what is wrong.
  TwoPassSettings settings = quick();
  const Scene room = lit_room();
  const Lit all(room, settings);
  const Image truth = all.picture(settings.render);
  settings.pass_one.plan.worlds.max_depth = 0;
  settings.pass_one.form_factors.max_bounces = 0;
  settings.render.max_bounces = 0;
  settings.render.diffuse.gather.max_bounces = 0;
  const Lit capped(room, settings);
  const Image picture = capped.picture(settings.render);
  const double error = all.off(settings, picture, truth);
  const PictureError estimate = capped.error(settings, picture);
  EXPECT_GT(error, 0.15) << "or else nothing is tested";
  EXPECT_GT(estimate.mirror_tail, 0.5 * error);
  EXPECT_GT(estimate.total, error / 2.0);
  EXPECT_LT(estimate.total, error * 2.0);
}

TEST(PictureError, IsNextToNothingInAFurnace) {
  Scene scene = furnace(0.5, {false, true});
  scene.cameras = {look_at({0.4, 0.5, 0.9}, {0.6, 0.4, 0.0}, 1.5)};
  TwoPassSettings settings = quick();
  const Lit lit(scene, settings);
  EXPECT_LT(lit.error(settings, lit.picture(settings.render)).total, 2e-4)
      << "the tolerance of the solver";
}

// The squares of 1e22 W/m^2/sr are too large for floats, and those of 1e-20 too small.
TEST(PictureError, DoesNotDependOnTheScaleOfLight) {
  const TwoPassSettings settings = quick();
  const auto error_of = [&](double scale) {
    Scene scene = lit_room();
    for (Material& material : scene.materials)
      material.emission *= scale;
    const Lit lit(scene, settings);
    return lit.error(settings, lit.picture(settings.render)).total;
  };
  const double plain = error_of(1.0);
  for (const double scale : {1e-6, 1e-20, 1e22})
    EXPECT_NEAR(error_of(scale), plain, 1e-3 * plain) << scale;
}

TEST(PictureError, OfABlackPictureIsNone) {
  Scene scene = lit_room();
  for (Material& material : scene.materials)
    material.emission = Rgb(0.0);
  TwoPassSettings settings = quick();
  const Lit lit(scene, settings);
  EXPECT_EQ(lit.error(settings, lit.picture(settings.render)).total, 0.0);
}

TEST(ErrorMap, IsLargeWhereThePictureIsOff) {
  // Its mean square is that of the error within a factor of two,
  // and the half of the pixels it names worst hold most of the squares.
  TwoPassSettings settings = quick();
  const Lit lit(lit_room(), settings);
  const Image picture = lit.picture(settings.render),
              truth = lit.picture(gathered(settings.render));
  const Image map = error_map(lit.solution.field, lit.camera(), settings, picture,
                              lit.error(settings, picture));
  const auto emits =
      emitter_pixels(lit.solution.field, lit.camera(), settings.render, truth, 16);
  std::vector<std::pair<double, double>> squares; // said, true
  for (std::size_t p = 0; p < emits.size(); ++p)
    if (emits[p] == 0)
      squares.emplace_back(std::pow(double{map.pixels[p].g}, 2.0),
                           std::pow(double{picture.pixels[p].g - truth.pixels[p].g}, 2.0));
  std::ranges::sort(squares, std::greater{});
  double said = 0.0, is = 0.0, worst = 0.0;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    said += squares[k].first;
    is += squares[k].second;
    worst += k < squares.size() / 2 ? squares[k].second : 0.0;
  }
  EXPECT_GT(said, is / 4.0);
  EXPECT_LT(said, is * 4.0);
  EXPECT_GT(worst, 0.8 * is);
}

// In units of a power of two all is the same to the rounding of the estimate, whose squares are beyond floats.
TEST(ErrorMap, DoesNotDependOnTheScaleOfLight) {
  const TwoPassSettings settings = quick();
  const auto map_of = [&](double scale) {
    Scene scene = lit_room();
    for (Material& material : scene.materials)
      material.emission *= scale;
    const Lit lit(scene, settings);
    const Image picture = lit.picture(settings.render);
    return error_map(lit.solution.field, lit.camera(), settings, picture,
                     lit.error(settings, picture));
  };
  const Image plain = map_of(1.0);
  for (const double scale : {0x1p-66, 0x1p73}) {
    const Image map = map_of(scale);
    for (std::size_t p = 0; p < plain.pixels.size(); ++p)
      EXPECT_NEAR(map.pixels[p].g / scale, plain.pixels[p].g, 1e-3 * plain.pixels[p].g + 1e-6)
          << scale << ' ' << p;
  }
}

} // namespace
} // namespace meninas::test
