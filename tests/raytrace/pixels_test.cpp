// How samples make a pixel: filters, adaptive sampling, and layers that show the scene.
#include "raytrace/views/features.h"
#include "raytrace/pixels/sample_choice.h"
#include "raytrace/two_pass.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meninas::test {
namespace {

constexpr double rounding = 1e-5; // of a few operations in single precision

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.target_elements = 300;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  return settings;
}

RenderSettings pixels(int width, int height, int samples) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples = samples;
  return settings;
}

TEST(PixelFilter, WeightsSumToOneAndPlacesFollowThem) {
  for (const PixelFilter filter : pixel_filters) {
    constexpr int steps = 600; // of 1/200 pixel over 3 pixels
    double sum = 0.0, mean = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double x = (k + 0.5) / 200.0 - 1.5, weight = filter_weight(filter, x) / 200.0;
      EXPECT_GE(weight, 0.0);
      sum += weight;
      mean += x * weight;
    }
    EXPECT_NEAR(sum, 1.0, 1e-4) << name_of(filter);
    EXPECT_NEAR(mean, 0.0, 1e-9) << name_of(filter);
    // Between two places there is as much weight as was asked for.
    const FilterPlaces places = filter_places(filter);
    for (std::size_t k = 0; k < filter_steps; k += 17) {
      const double low = double{places[k]} - 0.5, high = double{places[k + 1]} - 0.5;
      ASSERT_LT(low, high);
      const double between = (high - low) * filter_weight(filter, 0.5 * (low + high));
      const bool tail = k == 0 || k + 1 == filter_steps; // where weights go to zero
      EXPECT_NEAR(between * double(filter_steps), 1.0, tail ? 0.6 : 0.02) << name_of(filter) << k;
    }
    EXPECT_NEAR(place_of(places, 0.5F), 0.5F, 1e-5F);
  }
  const FilterPlaces box = filter_places(PixelFilter::box);
  for (const float u : {0.0F, 0.3F, 0.999F})
    EXPECT_EQ(place_of(box, u), u) << "the box leaves samples where they are, to the bit";
}

TEST(PixelFilter, AnEdgeComesOutAsTheFiltersIntegral) {
  // A lamp covers the left half of the picture:
  // pixels at distance x from its edge show the integral of the filter beyond.
  Scene scene;
  add_polygon(scene, "lamp", {{-9, -9, 0}, {0, -9, 0}, {0, 9, 0}, {-9, 9, 0}},
              diffuse(0.0, std::numbers::pi));
  Camera camera = look_at({0, 0, 2}, {0, 0, 0}, 0.1);
  camera.projection = Projection::orthographic;
  camera.half_height = 2.0;
  const Taken lit = lit_up(scene, coarse());
  for (const PixelFilter filter : pixel_filters) {
    RenderSettings settings = pixels(4, 4, 4096);
    settings.filter = filter;
    const Image image = picture(lit, camera, settings);
    std::vector<double> weights;
    for (int k = 0; k < 600; ++k)
      weights.push_back(filter_weight(filter, (k + 0.5) / 200.0 - 1.5) / 200.0);
    for (int x = 0; x < 4; ++x) {
      // The filter left of the edge, which is 2 - (x + 1/2) to the right.
      const auto left = weights.begin() + std::clamp(600 - 200 * x, 0, 600);
      const double expected = std::accumulate(weights.begin(), left, 0.0);
      // 4096 stratified samples meet an edge to 1/64 of the filter's width at worst.
      EXPECT_NEAR(image.at(x, 1).g, expected, 0.02) << name_of(filter) << ' ' << x;
    }
  }
}

/// A room with a mirror, a lamp and a box.
Scene room() {
  Scene scene = half_room_with_small_mirror();
  scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 1.3, 1.0}, 1.7)};
  return scene;
}

TEST(PixelFilter, LayersAddUpUnderAnyFilterAndAdaptively) {
  const Scene scene = room();
  const Taken lit = lit_up(scene, coarse());
  for (const PixelFilter filter : pixel_filters) {
    RenderSettings settings = pixels(24, 20, 16);
    settings.filter = filter;
    settings.pixel_error = 0.02;
    const Rendering layered = render_layers(lit.solution.field, scene.cameras[0], settings);
    const Image whole = picture(lit, scene.cameras[0], settings);
    for (std::size_t p = 0; p < whole.pixels.size(); ++p) {
      glm::vec3 sum(0.0F);
      for (const Layer& layer : layered.layers)
        sum += layer.image.pixels[p];
      ASSERT_EQ(sum, layered.image.pixels[p]) << "exactly, in their order";
      for (int band = 0; band < 3; ++band)
        ASSERT_NEAR(sum[band], whole.pixels[p][band], rounding * whole.pixels[p][band])
            << "the same samples in all layers";
    }
  }
}

TEST(SampleChoice, NeighboursThatDifferAreBothUncertain) {
  Image picture(5, 4);
  for (glm::vec3& pixel : picture.pixels)
    pixel = glm::vec3(1.0F);
  EXPECT_EQ(uncertain_pixels(picture, 0.0025), PixelMask(20, 0));
  picture.at(2, 1) = glm::vec3(1.0F, 1.2F, 1.0F); // off by a quarter of the difference: 0.05
  const PixelMask uncertain = uncertain_pixels(picture, 0.04);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(uncertain[static_cast<std::size_t>(5 * y + x)],
                std::abs(x - 2) <= 1 && std::abs(y - 1) <= 1 ? 1 : 0);
  EXPECT_EQ(uncertain_pixels(picture, 0.06), PixelMask(20, 0));
  EXPECT_EQ(uncertain_pixels(Image(3, 3), 0.1), PixelMask(9, 0)) << "black";
}

TEST(SampleChoice, BrightPixelsAreHeldAgainstTheMean) {
  // A step of a tenth, where all is a hundred times the mean,
  // is of more weight than the same step where all is the mean.
  Image picture(20, 20);
  for (glm::vec3& pixel : picture.pixels)
    pixel = glm::vec3(1.0F);
  picture.at(3, 3) = picture.at(3, 4) = glm::vec3(100.0F);
  picture.at(12, 12) = glm::vec3(1.1F);
  const PixelMask uncertain = uncertain_pixels(picture, 0.04);
  EXPECT_EQ(uncertain[12 * 20 + 12], 0);
  Image change(20, 20);
  change.at(3, 3) = glm::vec3(1.0F);
  EXPECT_EQ(uncertain_pixels(picture, change, 0.04)[3 * 20 + 3], 1) << "0.45 of a mean of 1.5";
  change.at(3, 3) = glm::vec3(0.1F);
  EXPECT_EQ(uncertain_pixels(picture, change, 0.04)[3 * 20 + 3], 0);
}

TEST(SampleChoice, WhereNothingDiffersTheFirstAreEnough) {
  Scene scene;
  add_polygon(scene, "lamp", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, diffuse(0.0, 3.0));
  const Camera camera = look_at({0.1, 0.2, 2.0}, {0.1, 0.2, 0.0}, 0.3);
  const Taken lit = lit_up(scene, coarse());
  for (const auto& [samples, traced] :
       {std::pair{1024, 16}, {256, 4}, {16, 4}, {8, 4}, {4, 4}, {2, 2}}) {
    RenderSettings settings = pixels(8, 8, samples);
    settings.pixel_error = 0.05;
    const Rendering rendering = render(lit.solution.field, camera, settings);
    EXPECT_EQ(rendering.camera_rays, std::uint64_t(64 * traced)) << samples;
    EXPECT_NEAR(rendering.image.at(3, 3).g, 3.0 / std::numbers::pi, rounding);
  }
}

TEST(SampleChoice, EachPixelTakesTheFirstOnesAndThoseAtEdgesAll) {
  Scene scene;
  add_polygon(scene, "lamp", {{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}}, diffuse(0.0, 3.0));
  const Camera camera = look_at({0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}, 0.3);
  const Taken lit = lit_up(scene, coarse());
  RenderSettings settings = pixels(9, 8, 64);
  settings.pixel_error = 0.05;
  settings.min_samples = 16;
  const Rendering rendering = render(lit.solution.field, camera, settings);
  // The edge goes through the middle column; the two beside it differ from it.
  for (int x = 0; x < 9; ++x)
    EXPECT_EQ(rendering.samples[std::size_t(4 * 9 + x)], x >= 3 && x <= 5 ? 64U : 16U) << x;
}

TEST(SampleChoice, PixelsAreRightToWhatIsAskedFor) {
  const Scene scene = room();
  const Taken lit = lit_up(scene, coarse());
  RenderSettings settings = pixels(64, 48, 256);
  const Rendering all = render(lit.solution.field, scene.cameras[0], settings);
  double mean = 0.0;
  for (const glm::vec3& pixel : all.image.pixels)
    mean += double{pixel.g} / double(all.image.pixels.size());
  std::uint64_t rays = 0;
  for (const double error : {0.1, 0.03, 0.01}) {
    settings.pixel_error = error;
    const Rendering some = render(lit.solution.field, scene.cameras[0], settings);
    EXPECT_LT(some.camera_rays, all.camera_rays / 3);
    EXPECT_GT(some.camera_rays, rays);
    rays = some.camera_rays;
    std::uint64_t counted = 0;
    for (const std::uint32_t samples : some.samples)
      counted += samples;
    EXPECT_EQ(counted, some.camera_rays);
    std::size_t off = 0;
    double square = 0.0;
    for (std::size_t p = 0; p < all.image.pixels.size(); ++p) {
      const glm::dvec3 a(all.image.pixels[p]), b(some.image.pixels[p]);
      for (int band = 0; band < 3; ++band) {
        const double relative = (a[band] - b[band]) / std::min(a[band] + 0.05 * mean, mean);
        off += std::abs(relative) > 2.0 * error ? 1 : 0;
        square += relative * relative / double(3 * all.image.pixels.size());
      }
    }
    // The bound is one of single pixels:
    // most are far better, and what four samples and those around have missed is rare.
    EXPECT_LT(std::sqrt(square), 0.25 * error);
    EXPECT_LE(off, all.image.pixels.size() / 500) << error;
  }
}

TEST(SampleChoice, TheSameBitsForAnyThreads) {
  const Scene scene = room();
  const Taken lit = lit_up(scene, coarse());
  RenderSettings settings = pixels(70, 40, 16);
  settings.pixel_error = 0.03;
  settings.filter = PixelFilter::gaussian;
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return picture(lit, scene.cameras[0], settings);
  };
  EXPECT_TRUE(with_threads(1).pixels == with_threads(2).pixels);
}

TEST(SpecularDepth, TheHundredthImageIsRhoToTheHundredth) {
  // Mirrors at z = 0 and z = 1;
  // the k-th image of a wall of radiance 1 is centred k heights up, 20 away.
  constexpr double rho = 0.99;
  Scene scene;
  add_polygon(scene, "low", {{-4, -50, 0}, {4, -50, 0}, {4, 50, 0}, {-4, 50, 0}}, mirror(rho));
  add_polygon(scene, "high", {{-4, 50, 1}, {4, 50, 1}, {4, -50, 1}, {-4, -50, 1}}, mirror(rho));
  add_polygon(scene, "wall", {{-4, 20, 0}, {4, 20, 0}, {4, 20, 1}, {-4, 20, 1}},
              diffuse(0.0, std::numbers::pi));
  const Taken lit = lit_up(scene, coarse());
  for (const int k : {1, 10, 100, 400}) {
    Camera camera = look_at({0, 0, 0.5}, {0.0, 20.0, 0.5 + k}, 1e-4);
    camera.up = glm::normalize(glm::cross(camera.forward, Vec3(-1, 0, 0)));
    camera.right = glm::cross(camera.forward, camera.up);
    const double expected = std::pow(rho, k);
    // A throughput of k factors, each rounded to single precision.
    EXPECT_NEAR(picture(lit, camera, pixels(1, 1, 4)).at(0, 0).g, expected,
                1e-6 * k * expected + 1e-5 * expected)
        << k;
  }
}

TEST(SpecularDepth, PathsBetweenFacingMirrorsEndByTheirThroughput) {
  constexpr double rho = 0.9;
  Scene scene;
  add_polygon(scene, "low", {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, mirror(rho));
  add_polygon(scene, "high", {{-4, 4, 1}, {4, 4, 1}, {4, -4, 1}, {-4, -4, 1}}, mirror(rho));
  add_polygon(scene, "lamp", {{3, -1, 0.2}, {3, 1, 0.2}, {3, 1, 0.4}, {3, -1, 0.4}},
              diffuse(0.0, 1.0));
  const Taken lit = lit_up(scene, coarse());
  const RenderSettings settings = pixels(1, 1, 1);
  const Rendering straight_down = render(lit.solution.field,
                                         look_at({0, 0, 0.5}, {1e-9, 0, 0}, 1e-9), settings);
  // rho^k < 1/1024 from k = 66 on.
  EXPECT_EQ(straight_down.specular_rays, 65U);
}

TEST(Features, AreTheSceneAtTheMiddleOfThePixel) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}},
              diffuse(Rgb(0.2, 0.5, 0.8)));
  add_polygon(scene, "mirror", {{-2, 0, -2}, {2, 0, -2}, {2, 1, -2}, {-2, 1, -2}}, mirror(0.9));
  scene.background = Rgb(1.0);
  const Camera camera = look_at({0.3, 0.5, 4.0}, {0.3, 0.5, 0.0}, 0.7);
  const Taken lit = lit_up(scene, coarse());
  RenderSettings settings = pixels(24, 24, 1);
  settings.features = {all_features.begin(), all_features.end()};
  const Rendering rendering = render(lit.solution.field, camera, settings);
  ASSERT_EQ(rendering.layers.size(), 6U);
  const auto layer = [&](Feature feature) -> const Image& {
    const auto& found = rendering.layers[static_cast<std::size_t>(feature)];
    EXPECT_EQ(found.name, name_of(feature));
    return found.image;
  };
  const double half = std::tan(0.35);
  int floor = 0, on_mirror = 0, missed = 0;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const double down = (2.0 * (y + 0.5) / 24.0 - 1.0) * half;
      const double right = (2.0 * (x + 0.5) / 24.0 - 1.0) * half;
      const double to_floor = down > 0.0 ? 0.5 / down : 1e9; // depth, along the axis
      const double at_mirror = 0.5 - 6.0 * down;             // height
      if (to_floor < 6.0 && std::abs(0.3 + to_floor * right) < 2.0 && to_floor > 2.0) {
        EXPECT_NEAR(layer(Feature::depth).at(x, y).r, to_floor, 1e-4);
        EXPECT_EQ(layer(Feature::normal).at(x, y), glm::vec3(0, 1, 0));
        EXPECT_EQ(layer(Feature::albedo).at(x, y), glm::vec3(0.2F, 0.5F, 0.8F));
        EXPECT_GE(layer(Feature::element).at(x, y).r, 1.0F);
        EXPECT_GT(layer(Feature::irradiance).at(x, y).g, 1.0F);
        ++floor;
      } else if (to_floor > 6.0 && at_mirror < 1.0 && std::abs(0.3 + 6.0 * right) < 2.0) {
        EXPECT_NEAR(layer(Feature::depth).at(x, y).r, 6.0, 1e-4);
        EXPECT_EQ(layer(Feature::normal).at(x, y), glm::vec3(0, 0, 1));
        for (const Feature feature : {Feature::albedo, Feature::element, Feature::irradiance})
          EXPECT_EQ(layer(feature).at(x, y), glm::vec3(0.0F));
        ++on_mirror;
      } else {
        for (const Feature feature : {Feature::depth, Feature::normal, Feature::albedo,
                                      Feature::element, Feature::irradiance})
          EXPECT_EQ(layer(feature).at(x, y), glm::vec3(0.0F)) << x << ' ' << y;
        ++missed;
      }
    }
  EXPECT_GT(std::min({floor, on_mirror, missed}), 20);
}

// Four columns of points in a pixel tell where an upright edge crosses it to an eighth.
TEST(Features, AlphaIsTheShareOfThePixelInWhichThereIsSomething) {
  Scene scene;
  add_polygon(scene, "sheet", {{0.07, -9, 0}, {9, -9, 0}, {9, 9, 0}, {0.07, 9, 0}}, diffuse(0.5));
  scene.background = Rgb(1.0);
  const Taken lit = lit_up(scene, coarse());
  RenderSettings settings = pixels(8, 4, 1);
  settings.features = {Feature::depth, Feature::alpha};
  const Rendering rendering = render(lit.solution.field, look_at({0, 0, 1}, {0, 0, 0}, 0.5), settings);
  ASSERT_EQ(rendering.layers[1].name, "alpha");
  const double edge = 4.0 + 0.07 / (4.0 * std::tan(0.25)) * 8.0; // in pixels; the picture is twice as wide as high
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_NEAR(rendering.layers[1].image.at(x, y).r, std::clamp(x + 1 - edge, 0.0, 1.0), 0.125);
}

} // namespace
} // namespace meninas::test
