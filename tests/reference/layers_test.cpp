// The reference's own split of its picture:
// closed forms, and the two passes as the other route to the same shares.
#include "raytrace/two_pass.h"
#include "tests/reference/tracing.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace meninas::test {
namespace {

using reference::LayerLuminances;
using reference::ReferencePicture;
using reference::share_of;

constexpr double pi = std::numbers::pi;

reference::ReferenceSettings layered(int width, int height, int samples) {
  auto settings = tracing(width, height, samples);
  settings.layers = WithLayers::yes;
  return settings;
}

bool any(std::string_view) { return true; }
bool is_diffuse(std::string_view name) { return name.starts_with("diffuse."); }
bool is_mirrored(std::string_view name) { return name.starts_with("diffuse.mirrored"); }
bool is_emission(std::string_view name) { return name.starts_with("emission"); }
bool is_seen_in_mirrors(std::string_view name) {
  return name.ends_with(".mirror") || name.ends_with(".mirrors");
}

/// The mean luminance of one layer over the batches, and its standard error.
struct Mean {
  double value = 0.0, error = 0.0;
};
Mean mean_of_layer(const ReferencePicture& picture, std::string_view name) {
  std::size_t layer = 0;
  while (reference::layer_name(layer) != name)
    ++layer;
  const double m = double(picture.batches.size());
  double sum = 0.0, squares = 0.0;
  for (const LayerLuminances& batch : picture.batches)
    sum += batch[layer];
  for (const LayerLuminances& batch : picture.batches)
    squares += (batch[layer] - sum / m) * (batch[layer] - sum / m);
  return {sum / m, std::sqrt(squares / (m * (m - 1.0)))};
}

TEST(ReferenceLayers, AddUpToTheMean) {
  Scene scene = half_room_with_small_mirror();
  const Camera camera = look_at({1.8, 1.1, 2.8}, {0.4, 1.3, 1.0}, 1.7);
  const auto whole = traced_picture(scene, camera, tracing(20, 15, 64));
  const auto split = traced_picture(scene, camera, layered(20, 15, 64));
  ASSERT_EQ(split.layers.size(), 9U);
  EXPECT_TRUE(whole.layers.empty());
  EXPECT_EQ(whole.variance.pixels, split.variance.pixels) << "they are the same paths";
  for (std::size_t p = 0; p < split.mean.pixels.size(); ++p) {
    glm::vec3 sum(0.0F);
    for (const Layer& layer : split.layers)
      sum += layer.image.pixels[p];
    ASSERT_EQ(sum, split.mean.pixels[p]) << "exactly, in their order";
    for (int band = 0; band < 3; ++band)
      // Nine roundings to floats and nine of their sums.
      ASSERT_NEAR(sum[band], whole.mean.pixels[p][band], 18 * 0x1p-24 * sum[band]);
  }
  for (const char* name :
       {"emission", "diffuse.direct", "diffuse.mirrored", "diffuse.direct.mirror"})
    EXPECT_GT(mean_of_layer(split, name).value, 0.0) << name;
  EXPECT_EQ(mean_of_layer(split, "emission.mirrors").value, 0.0) << "there is one mirror";
}

TEST(ReferenceLayers, WithoutMirrorsAllLightIsDirect) {
  const Camera camera = look_at({1.6, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0);
  const auto picture = traced_picture(doubled(half_room()), camera, layered(12, 8, 64));
  for (const Layer& layer : picture.layers) {
    const bool expected = layer.name == "emission" || layer.name == "diffuse.direct";
    EXPECT_EQ(mean_of_layer(picture, layer.name).value > 0.0, expected) << layer.name;
  }
}

TEST(ReferenceLayers, ALampInFacingMirrorsIsSeenInOneAndInSeveral) {
  // Straight up the unfolded tower: the k-th image of the glowing wall is centred k heights up.
  constexpr double rho = 0.8;
  Scene scene;
  add_polygon(scene, "low", {{-4, -50, 0}, {4, -50, 0}, {4, 50, 0}, {-4, 50, 0}}, mirror(rho));
  add_polygon(scene, "high", {{-4, 50, 1}, {4, 50, 1}, {4, -50, 1}, {-4, -50, 1}}, mirror(rho));
  add_polygon(scene, "wall", {{-4, 20, 0}, {4, 20, 0}, {4, 20, 1}, {-4, 20, 1}}, diffuse(0.0, pi));
  constexpr std::array names{"emission", "emission.mirror", "emission.mirrors", "emission.mirrors"};
  for (int k = 0; k <= 3; ++k) {
    Camera camera = look_at({0, 0, 0.5}, {0.0, 20.0, 0.5 + k}, 0.001);
    camera.up = glm::normalize(glm::cross(camera.forward, Vec3(-1, 0, 0)));
    camera.right = glm::cross(camera.forward, camera.up);
    // Roulette after three mirrors lets 0.8^3 of the paths go on, each for as much more.
    const auto picture = traced_picture(scene, camera, layered(4, 4, 1024));
    const Mean seen = mean_of_layer(picture, names[std::size_t(k)]);
    EXPECT_NEAR(seen.value, std::pow(rho, k), 4.0 * seen.error + 1e-5) << k;
    EXPECT_NEAR(share_of(
                    picture.batches, [&](auto name) { return name == names[std::size_t(k)]; }, any)
                    .value,
                1.0, 1e-12)
        << k;
  }
}

/// The factor from a point of the floor to a rectangle over it,
/// one corner straight above (Siegel and Howell, B-4).
double corner_factor(double a, double b) {
  constexpr double h = 2.0;
  const double x = a / h, y = b / h, rx = std::sqrt(1.0 + x * x), ry = std::sqrt(1.0 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * pi);
}

TEST(ReferenceLayers, WhatTheMirrorThrowsOnTheFloorIsTheImageOfTheLamp) {
  // The lamp over the floor reaches from 0.5 m left of the point to 0.5 m right of it;
  // its image behind x = 0 from 2.5 to 3.5 m left.
  constexpr double reflectance = 0.6, rho = 0.9, emitted = 10.0;
  Scene scene;
  add_polygon(scene, "floor", {{0.5, 0, -1}, {0.5, 0, 1}, {2.5, 0, 1}, {2.5, 0, -1}},
              diffuse(reflectance));
  add_polygon(scene, "lamp", {{1, 2, -0.5}, {2, 2, -0.5}, {2, 2, 0.5}, {1, 2, 0.5}},
              diffuse(0.0, emitted));
  add_polygon(scene, "mirror", {{0, 0, 3}, {0, 0, -3}, {0, 4, -3}, {0, 4, 3}}, mirror(rho));
  const double straight = 4.0 * corner_factor(0.5, 0.5);
  const double image = 2.0 * rho * (corner_factor(3.5, 0.5) - corner_factor(2.5, 0.5));
  const Camera camera = look_at({1.5, 1.5, 1.4}, {1.5, 0.0, 0.0}, 1e-5);
  for (const auto search : {reference::LightSearch::both, reference::LightSearch::choosing,
                            reference::LightSearch::meeting}) {
    auto settings = layered(8, 8, search == reference::LightSearch::meeting ? 8192 : 256);
    settings.search = search;
    const auto picture = traced_picture(scene, camera, settings);
    for (const auto& [name, factor] :
         {std::pair("diffuse.direct", straight), {"diffuse.mirrored", image}}) {
      const double exact = emitted * reflectance / pi * factor;
      const Mean measured = mean_of_layer(picture, name);
      EXPECT_LT(measured.error, 0.02 * exact) << name;
      EXPECT_NEAR(measured.value, exact, 4.0 * measured.error + 1e-5 * exact) << name;
    }
    EXPECT_EQ(share_of(picture.batches, is_diffuse, any).value, 1.0);
  }
}

TEST(ReferenceLayers, ARatioKnowsItsError) {
  // Parts 1, 2, 3 of wholes 2, 4, 6 are one half for certain;
  // parts 1, 3 of wholes 4, 4 are 1/2 +- 1/4.
  const auto batch = [](double emission, double direct) {
    LayerLuminances luminances{};
    luminances[0] = emission;
    luminances[3] = direct;
    return luminances;
  };
  const auto sure = share_of({batch(1, 1), batch(2, 2), batch(3, 3)}, is_emission, any);
  EXPECT_DOUBLE_EQ(sure.value, 0.5);
  EXPECT_DOUBLE_EQ(sure.standard_error, 0.0);
  const auto unsure = share_of({batch(1, 3), batch(3, 1)}, is_emission, any);
  EXPECT_DOUBLE_EQ(unsure.value, 0.5);
  EXPECT_DOUBLE_EQ(unsure.standard_error, 0.25);
  EXPECT_EQ(share_of({batch(0, 0), batch(0, 0)}, is_emission, any).value, 0.0);
}

TEST(ReferenceLayers, TheTwoPassesFindTheSameShares) {
  Scene scene = half_room_with_small_mirror();
  const Camera camera = look_at({1.6, 1.2, 1.6}, {0.0, 1.3, 1.1}, 1.7);
  const auto picture = traced_picture(scene, camera, layered(32, 24, 512));

  TwoPassSettings settings;
  settings.pass_one.mesh.target_elements = 1500;
  settings.pass_one.form_factors.rays = 256;
  settings.pass_one.interpolation.rays = 256;
  settings.render.width = 32;
  settings.render.height = 24;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const auto solution = solve_pass_one(prepared->light(), settings.pass_one);
  const auto rendering = render_layers(solution.field, camera, settings.render);
  ASSERT_EQ(rendering.layers.size(), picture.layers.size());
  LayerLuminances hybrid{};
  for (std::size_t layer = 0; layer < hybrid.size(); ++layer) {
    EXPECT_EQ(rendering.layers[layer].name, picture.layers[layer].name);
    for (const glm::vec3& pixel : rendering.layers[layer].image.pixels)
      hybrid[layer] += glm::dot(Rgb(0.2126, 0.7152, 0.0722), Rgb(pixel));
  }

  struct Figure {
    const char* name;
    reference::LayerChoice part, whole;
  };
  for (const Figure& figure :
       {Figure{"mirrored of diffuse", is_mirrored, is_diffuse},
        Figure{"seen in mirrors", is_seen_in_mirrors, any}, Figure{"emission", is_emission, any}}) {
    const auto truth = share_of(picture.batches, figure.part, figure.whole);
    const double found = share_of({hybrid, hybrid}, figure.part, figure.whole).value;
    EXPECT_GT(truth.value, 0.02) << figure.name;
    EXPECT_LT(truth.standard_error, 0.005 * truth.value) << figure.name;
    // Light between vertices 10 cm apart is linear,
    // and 256 rays a vertex leave a percent of noise that varies over the few in view.
    EXPECT_NEAR(found, truth.value, 4.0 * truth.standard_error + 0.01 * truth.value) << figure.name;
  }
}

} // namespace
} // namespace meninas::test
