#include "form_factors/point_form_factor.h"
#include "raytrace/two_pass.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double rounding = 1e-5; // of a few operations in single precision

TwoPassSettings quick(int width, int height) {
  TwoPassSettings settings;
  settings.pass_one.mesh.target_elements = 400;
  settings.pass_one.form_factors.rays = 128;
  settings.pass_one.interpolation.rays = 128;
  settings.render.width = width;
  settings.render.height = height;
  settings.render.samples = 16;
  return settings;
}

struct Layered {
  Rendering whole, layered;
  std::map<std::string, Image> by_name;
};

Layered layers_of(const Scene& scene, const TwoPassSettings& settings) {
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const auto solution = solve_pass_one(prepared->light(), settings.pass_one);
  Layered result{
      render(solution.field, scene.cameras.at(0), settings.render),
      render_layers(solution.field, scene.cameras.at(0), settings.render),
      {}};
  for (const auto& layer : result.layered.layers)
    result.by_name[layer.name] = layer.image;
  return result;
}

double largest_value(const Image& image) {
  float largest = 0.0F;
  for (const auto& pixel : image.pixels)
    largest = std::max({largest, pixel.r, pixel.g, pixel.b});
  return largest;
}

TEST(Layers, AddUpToThePicture) {
  Scene scene = half_room_with_small_mirror();
  scene.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 1.3, 1.0}, 1.7)};
  Layered taken = layers_of(scene, quick(40, 30));
  ASSERT_EQ(taken.by_name.size(), 9U);
  for (std::size_t p = 0; p < taken.whole.image.pixels.size(); ++p) {
    glm::vec3 sum(0.0F);
    for (const auto& layer : taken.layered.layers) {
      ASSERT_GE(
          std::min({layer.image.pixels[p].r, layer.image.pixels[p].g, layer.image.pixels[p].b}),
          0.0F);
      sum += layer.image.pixels[p];
    }
    ASSERT_EQ(sum, taken.layered.image.pixels[p]) << "exactly, in their order";
    for (int band = 0; band < 3; ++band)
      ASSERT_NEAR(sum[band], taken.whole.image.pixels[p][band],
                  rounding * taken.whole.image.pixels[p][band])
          << "the picture without layers is the same light, added up in another order";
  }
  for (const char* name :
       {"emission", "diffuse.direct", "diffuse.mirrored", "diffuse.direct.mirror"})
    EXPECT_GT(largest_value(taken.by_name[name]), 0.0) << name;
  EXPECT_EQ(largest_value(taken.by_name["emission.mirrors"]), 0.0) << "there is one mirror";
}

TEST(Layers, SeenDirectlyArePassOneAlone) {
  Scene room = half_room_with_small_mirror();
  room.cameras = {look_at({1.8, 1.1, 2.8}, {0.4, 1.3, 1.0}, 1.7)};
  // As it is, of gloss, and varnished.
  Scene gloss = room, varnished = room;
  for (Material& material : gloss.materials)
    if (!is_mirror(material) && !is_emitter(material)) {
      material.metallic = 0.7;
      material.roughness = 0.5;
    }
  for (Material& material : varnished.materials)
    if (!is_mirror(material))
      material.roughness = 0.1;
  for (const Scene& scene : {room, gloss, varnished}) {
    TwoPassSettings settings = quick(24, 18);
    Layered taken = layers_of(scene, settings);
    settings.render.mode = RenderMode::radiosity;
    const Image alone = layers_of(scene, settings).whole.image;
    for (std::size_t p = 0; p < alone.pixels.size(); ++p) {
      const glm::vec3 seen = taken.by_name["emission"].pixels[p] +
                             taken.by_name["diffuse.direct"].pixels[p] +
                             taken.by_name["diffuse.mirrored"].pixels[p];
      for (int band = 0; band < 3; ++band)
        ASSERT_NEAR(alone.pixels[p][band], seen[band], rounding * seen[band]) << p;
    }
  }
}

TEST(Layers, WithoutMirrorsAllLightIsDirect) {
  Scene scene = doubled(half_room());
  scene.cameras = {look_at({1.6, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0)};
  const Layered taken = layers_of(scene, quick(24, 16));
  for (const auto& [name, image] : taken.by_name)
    EXPECT_EQ(largest_value(image) > 0.0, name == "emission" || name == "diffuse.direct") << name;
}

TEST(Layers, ALampInFacingMirrorsIsSeenInOneAndInSeveral) {
  // Straight up the unfolded tower: the k-th image of the wall is centred k heights up.
  constexpr double rho = 0.8;
  Scene scene;
  add_polygon(scene, "low", {{-4, -50, 0}, {4, -50, 0}, {4, 50, 0}, {-4, 50, 0}}, mirror(rho));
  add_polygon(scene, "high", {{-4, 50, 1}, {4, 50, 1}, {4, -50, 1}, {-4, -50, 1}}, mirror(rho));
  add_polygon(scene, "wall", {{-4, 20, 0}, {4, 20, 0}, {4, 20, 1}, {-4, 20, 1}},
              diffuse(0.0, std::numbers::pi));
  for (int k = 0; k <= 3; ++k) {
    scene.cameras = {look_at({0, 0, 0.5}, {0.0, 20.0, 0.5 + k}, 0.001)};
    scene.cameras[0].up = glm::normalize(glm::cross(scene.cameras[0].forward, Vec3(-1, 0, 0)));
    scene.cameras[0].right = glm::cross(scene.cameras[0].forward, scene.cameras[0].up);
    Layered taken = layers_of(scene, quick(1, 1));
    const double expected = std::pow(rho, k);
    const char* owner = k == 0 ? "emission" : k == 1 ? "emission.mirror" : "emission.mirrors";
    for (const char* name : {"emission", "emission.mirror", "emission.mirrors"})
      EXPECT_NEAR(taken.by_name[name].at(0, 0).g, name == std::string(owner) ? expected : 0.0,
                  rounding)
          << name << k;
  }
}

TEST(Layers, WhatTheMirrorThrowsOnTheFloorIsTheImageOfTheLamp) {
  // Only the floor scatters, so that its light is the lamp's alone:
  // straight, and from the image behind the mirror x = 0.
  // The pixel looks at a vertex of the field, where the field is the closed form.
  constexpr double reflectance = 0.6, rho = 0.9, emitted = 10.0;
  const std::vector<Point3> lamp{{1, 2, -0.5}, {2, 2, -0.5}, {2, 2, 0.5}, {1, 2, 0.5}};
  Scene scene;
  add_polygon(scene, "floor", {{0.5, 0, -1}, {0.5, 0, 1}, {2.5, 0, 1}, {2.5, 0, -1}},
              diffuse(reflectance));
  add_polygon(scene, "lamp", lamp, diffuse(0.0, emitted));
  add_polygon(scene, "mirror", {{0, 0, 3}, {0, 0, -3}, {0, 4, -3}, {0, 4, 3}}, mirror(rho));
  scene.cameras = {look_at({1.5, 1.5, 1.4}, {1.5, 0.0, 0.0}, 1e-5)};
  auto settings = quick(1, 1);
  settings.pass_one.mesh.element_size = 0.25;
  Layered taken = layers_of(scene, settings);

  std::vector<Point3> image;
  for (auto corner = lamp.rbegin(); corner != lamp.rend(); ++corner)
    image.emplace_back(-corner->x, corner->y, corner->z);
  const Point3 seen{1.5, 0.0, 0.0};
  const double scale = emitted * reflectance / std::numbers::pi;
  const double straight = scale * point_form_factor(seen, Direction(0, 1, 0), lamp);
  const double mirrored = scale * rho * point_form_factor(seen, Direction(0, 1, 0), image);
  EXPECT_NEAR(taken.by_name["diffuse.direct"].at(0, 0).g, straight, 1e-3 * straight);
  EXPECT_NEAR(taken.by_name["diffuse.mirrored"].at(0, 0).g, mirrored, 1e-3 * mirrored);
}

// A black room with a mirror that shows an area light: light that is emitted, once, and nothing reflected.
TEST(Layers, ShowAnAreaLightInAMirrorAsEmission) {
  Scene scene;
  add_polygon(scene, "mirror", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, mirror(0.5));
  AreaLight light;
  light.name = "light";
  light.radiance = Rgb(3.0);
  light.axis = {0.0, 0.0, -1.0};
  light.corners = {{0.6, 0.6, 2}, {0.6, 1.4, 2}, {1.4, 1.4, 2}, {1.4, 0.6, 2}};
  scene.area_lights = {light};
  scene.cameras = {look_at({1.0, 1.0, 1.0}, {1.0, 1.0, 0.0}, 0.8)};
  Layered taken = layers_of(scene, quick(24, 24));
  const double shown = 0.5 * 3.0;
  EXPECT_NEAR(largest_value(taken.whole.image), shown, rounding);
  EXPECT_NEAR(largest_value(taken.layered.image), shown, rounding);
  EXPECT_NEAR(largest_value(taken.by_name.at("emission.mirror")), shown, rounding);
  for (const char* name : {"diffuse.direct.mirror", "diffuse.mirrored.mirror", "emission"})
    EXPECT_EQ(largest_value(taken.by_name.at(name)), 0.0) << name;
}

} // namespace
} // namespace meninas::test
