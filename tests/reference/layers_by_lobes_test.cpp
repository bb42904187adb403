// Layers where gloss, coats and glass are seen:
// what has a direction of its own is a mirror to the eye, in the reference as in the two passes.
#include "raytrace/two_pass.h"
#include "scenes/materials/lobes.h"
#include "tests/reference/tracing.h"
#include "tests/support/glass_rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace meninas::test {
namespace {

using reference::LayerLuminances;

struct Mean {
  double value = 0.0, error = 0.0;
};
/// Mean luminances over the batches, and their standard errors.
std::map<std::string, Mean> mean_layers(const reference::ReferencePicture& picture) {
  const double m = double(picture.batches.size());
  std::map<std::string, Mean> means;
  for (std::size_t layer = 0; layer < reference::layer_count; ++layer) {
    double sum = 0.0, squares = 0.0;
    for (const LayerLuminances& batch : picture.batches)
      sum += batch[layer];
    for (const LayerLuminances& batch : picture.batches)
      squares += (batch[layer] - sum / m) * (batch[layer] - sum / m);
    means[reference::layer_name(layer)] = {sum / m, std::sqrt(squares / (m * (m - 1.0)))};
  }
  return means;
}

std::map<std::string, Mean> traced_layers(const Scene& scene, const Camera& camera, int size,
                                          int samples) {
  auto settings = tracing(size, size, samples);
  settings.layers = WithLayers::yes;
  return mean_layers(traced_picture(scene, camera, settings));
}

std::map<std::string, double> hybrid_layers(const Scene& scene, const Camera& camera, int size) {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 0.1;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 256;
  settings.render.width = settings.render.height = size;
  settings.render.samples = 64;
  settings.render.glossy_samples = 64;
  settings.render.diffuse.term = DiffuseTerm::direct;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const auto solution = solve_pass_one(prepared->light(), settings.pass_one);
  std::map<std::string, double> means;
  for (const Layer& layer : render_layers(solution.field,
                                          camera, settings.render)
                                .layers)
    for (const glm::vec3& pixel : layer.image.pixels)
      means[layer.name] += glm::dot(Rgb(0.2126, 0.7152, 0.0722), Rgb(pixel)) / double(size * size);
  return means;
}

/// Each layer of some kind within four standard errors of the paths and the error of the field,
/// that of 10 cm elements; those named have light.
void expect_same_layers(const Scene& scene, const Camera& camera,
                        std::initializer_list<const char*> lit, std::string_view kind = "") {
  constexpr int size = 16;
  const auto truth = traced_layers(scene, camera, size, 1024);
  const auto found = hybrid_layers(scene, camera, size);
  ASSERT_EQ(found.size(), truth.size());
  double all = 0.0;
  for (const auto& [name, mean] : truth)
    all += mean.value;
  for (const char* name : lit) {
    EXPECT_GT(truth.at(name).value, 0.002 * all) << name;
    EXPECT_LT(truth.at(name).error, 0.02 * truth.at(name).value) << name;
  }
  constexpr double field_error = 0.01;
  for (const auto& [name, mean] : truth) {
    if (!name.starts_with(kind))
      continue;
    EXPECT_NEAR(found.at(name), mean.value, 4.0 * mean.error + field_error * mean.value) << name;
  }
}

/// A closed room of two metres with a lamp, whose wall x = 0 is a mirror.
Scene mirror_room(const Material& floor, const Material& others) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(others);
  walls[0] = mirror(0.8);
  walls[2] = floor;
  add_room(scene, Point3(0.0), Point3(2.0), walls);
  add_polygon(scene, "lamp", {{0.6, 1.9, 1.4}, {1.0, 1.9, 1.4}, {1.0, 1.9, 1.0}, {0.6, 1.9, 1.0}},
              double_sided(diffuse(0.0, 10.0)));
  return scene;
}

const Camera over_the_floor = look_at({1.8, 1.2, 0.3}, {0.5, 0.2, 1.2}, 1.0);

TEST(LayersByLobes, UnderEvenLightGlossShowsWhatItsFacetsDoNotSpread) {
  // Black walls of radiance 1:
  // a white metal shows 1, of which what its facets spread is even and the rest its lobe's.
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.0, std::numbers::pi));
  walls[2] = diffuse(1.0);
  walls[2].metallic = 1.0;
  walls[2].roughness = 0.6;
  add_room(scene, Point3(0.0), Point3(2.0), walls);
  const double cosine = std::sqrt(0.5);
  const Camera camera = look_at({0.5, 0.6, 1.0}, {1.1, 0.0, 1.0}, 1e-4);
  const double even = even_reflectance(make_bsdf(walls[2], untextured(walls[2])), {cosine, 0.0, cosine}).g;
  ASSERT_GT(even, 0.02);
  auto layers = traced_layers(scene, camera, 8, 4096);
  const std::map<std::string, double> exact{{"diffuse.direct", even},
                                            {"emission.mirror", 1.0 - even}};
  for (const auto& [name, mean] : layers) {
    const double expected = exact.contains(name) ? exact.at(name) : 0.0;
    // Rays of even light are all alike, but chosen by chance for either part.
    // The table of albedos is good to 1e-3 (microfacets_test).
    EXPECT_LE(mean.error, 0.002) << name;
    EXPECT_NEAR(mean.value, expected, 4.0 * mean.error + 1e-3 * (expected > 0.0)) << name;
  }
}

TEST(LayersByLobes, AgreeOnAGlossyMetal) {
  // Walls are black, so that what the metal throws on them, which pass one spreads evenly,
  // does not come back. What its facets spread depends on where light comes from, which the field
  // does not know: of these, the diffuse layers, only the mean over all light is the same.
  for (const double roughness : {0.15, 0.4}) {
    SCOPED_TRACE(roughness);
    Material metal = diffuse(Rgb(0.9, 0.7, 0.4));
    metal.metallic = 1.0;
    metal.roughness = roughness;
    Scene scene = mirror_room(metal, diffuse(0.0));
    PunctualLight bulb;
    bulb.position = {1.3, 1.5, 1.5};
    bulb.intensity = Rgb(0.5);
    scene.lights = {bulb};
    expect_same_layers(scene, over_the_floor, {"emission.mirror", "emission.mirrors"}, "emission");
  }
}

TEST(LayersByLobes, AgreeOnACoatedFloor) {
  for (const double roughness : {0.0, 0.15}) {
    SCOPED_TRACE(roughness);
    Material coated = diffuse(Rgb(0.3, 0.2, 0.1));
    coated.roughness = roughness;
    expect_same_layers(
        mirror_room(coated, diffuse(Rgb(0.6, 0.5, 0.4))), over_the_floor,
        {"diffuse.direct", "diffuse.direct.mirror", "diffuse.mirrored", "diffuse.mirrored.mirror"});
  }
}

TEST(LayersByLobes, AgreeOnFrostedGlass) {
  // Walls that glow and are black: pass one takes the pane for clear.
  Scene scene = glowing_room();
  Material frosted = glass({0.4, 0.9, 0.6});
  frosted.roughness = 0.3;
  add_polygon(scene, "pane", {{0.2, 0.0, 0.8}, {1.8, 0.0, 0.8}, {1.8, 1.7, 0.8}, {0.2, 1.7, 0.8}},
              frosted);
  expect_same_layers(scene, look_at({1.7, 1.1, 1.8}, {0.8, 0.8, 0.8}, 1.0),
                     {"emission", "emission.mirror"});
}

} // namespace
} // namespace meninas::test
