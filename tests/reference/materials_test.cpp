// What the scene model holds beyond diffuse walls and ideal mirrors.
#include "image/image_file.h"
#include "reference/scene_setup.h"
#include "tests/reference/tracing.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

/// An encoded picture of a white texel on the left and a black one on the right,
/// which does not repeat.
Texture white_and_black() {
  Image image(2, 1);
  image.at(0, 0) = glm::vec3(1.0F);
  const auto file = std::filesystem::temp_directory_path() /
                    ("meninas-texture-" + std::to_string(getpid()) + ".png");
  write_png(file, image, 0.0);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::filesystem::remove(file);
  Texture texture{.name = "halves", .encoded = {}, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
  for (const char c : bytes)
    texture.encoded.push_back(static_cast<std::byte>(c));
  return texture;
}

/// Gives the corners of the last quad the coordinates of an image, in their order.
void lay_texture(Scene& scene) {
  const glm::vec2 corners[] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  for (std::size_t k = 0; k < 4; ++k)
    own_attributes(scene, scene.vertices[scene.vertices.size() - 4 + k]).texcoord[0] = corners[k];
}

PunctualLight bulb(Point3 position) {
  return {.name = "bulb", .kind = PunctualKind::point, .intensity = Rgb(4.0), .position = position};
}

void add_floor(Scene& scene, const Material& material) {
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, material);
}

void add_lamp(Scene& scene, double half, double height, const Material& material) {
  add_polygon(
      scene, "lamp",
      {{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}},
      material);
}

TEST(ReferenceMaterials, ATexturedEmitter) {
  Scene plain;
  add_floor(plain, diffuse(0.5));
  add_lamp(plain, 1.0, 1.0, diffuse(Rgb(0.0), Rgb(2.0 * pi)));
  Scene scene = plain;
  scene.textures.push_back(white_and_black());
  scene.materials[1].emissive_texture = TextureUse{.texture = TextureId{0}};
  lay_texture(scene);
  // Its left quarter, x < -1/2, is white, its right one black, and even in between.
  expect_radiance(radiance_seen(scene, {-0.8, 0.5, 0.1}, {-0.8, 1, 0}, 32), Rgb(2.0));
  expect_radiance(radiance_seen(scene, {0, 0.5, 0.1}, {0, 1, 0}, 32), Rgb(1.0));
  EXPECT_EQ(radiance_seen(scene, {0.8, 0.5, 0.1}, {0.8, 1, 0}, 32).mean, Rgb(0.0));
  // Places left and right of the middle add up to white:
  // under it there is half the light of the plain lamp.
  const MeanRadiance full = radiance_seen(plain, {4, 0.15, 1}, Point3(0.0), 1024);
  expect_radiance(radiance_seen(scene, {4, 0.15, 1}, Point3(0.0), 1024), 0.5 * full.mean);
}

TEST(ReferenceMaterials, VertexColours) {
  Scene scene;
  add_floor(scene, diffuse(0.8));
  scene.background = Rgb(1.0);
  for (Vertex& vertex : scene.vertices)
    own_attributes(scene, vertex).color.g = static_cast<float>(vertex.position.x + 9.0) / 18.0F;
  expect_radiance(radiance_seen(scene, {4.5, 1, 0.1}, {4.5, 0, 0}, 32), Rgb(0.8, 0.6, 0.8));
}

TEST(ReferenceMaterials, ATexturedFloor) {
  Scene scene;
  add_floor(scene, diffuse(0.8));
  scene.textures.push_back(white_and_black());
  scene.materials[0].base_color_texture = TextureUse{.texture = TextureId{0}};
  lay_texture(scene);
  const auto irradiance = [&](Point3 x) {
    scene.lights = {bulb(x + Vec3(0, 2, 0))};
    return 4.0 / 4.0;
  };
  const double white = irradiance({-6, 0, 0});
  expect_radiance(radiance_seen(scene, {-6, 1, 2}, {-6, 0, 0}, 32), Rgb(0.8 * white / pi));
  // A quarter of the ramp between the centres of the texels: x = -4.5 + 9/4.
  const double grey = irradiance({-2.25, 0, 0});
  expect_radiance(radiance_seen(scene, {-2, 1, 2}, {-2.25, 0, 0}, 32), Rgb(0.75 * 0.8 * grey / pi));
  const double black = irradiance({6, 0, 0});
  EXPECT_EQ(radiance_seen(scene, {6, 1, 2}, {6, 0, 0}, 32).mean, Rgb(0.0 * black));
}

/// So dark that what it sends back to a screen does not matter.
constexpr double floor_reflectance = 1e-6;

/// A floor, a light two metres over it, and a screen between.
Scene screened(const Material& material) {
  Scene scene;
  add_floor(scene, diffuse(floor_reflectance));
  add_polygon(scene, "screen", {{-2, 1, -2}, {2, 1, -2}, {2, 1, 2}, {-2, 1, 2}}, material);
  scene.lights = {bulb({0, 2, 0})};
  return scene;
}

TEST(ReferenceMaterials, CutOutsLetLightAndSightThrough) {
  Material leaf = diffuse(0.0);
  leaf.alpha_mode = AlphaMode::mask;
  leaf.alpha = 0.4;
  expect_radiance(radiance_seen(screened(leaf), {0.5, 1.5, 0.5}, Point3(0.0), 32),
                  Rgb(floor_reflectance / pi));
  leaf.alpha = 0.6;
  EXPECT_EQ(radiance_seen(screened(leaf), {0.5, 0.5, 0.5}, {0.2, 0, 0.1}, 32).mean, Rgb(0.0));
}

TEST(ReferenceMaterials, APaneTintsAndReflects) {
  Material glass = diffuse(Rgb(0.5, 1.0, 1.0));
  glass.roughness = 0.0;
  glass.transmission = 1.0;
  // Light falls straight through it, but for 4 % at either face,
  // of which some comes back to the other one.
  const Rgb passed(0.96 * 0.96 * 0.5 / (1.0 - 0.02 * 0.02), 0.96 / 1.04, 0.96 / 1.04);
  expect_radiance(radiance_seen(screened(glass), {0.5, 0.5, 0.5}, Point3(0.0), 32),
                  passed * (floor_reflectance / pi));
  // The eye looks through it as well, from above: from the back, for which it is a pane as well.
  const Material both = double_sided(glass);
  expect_radiance(radiance_seen(screened(both), {0, 1.5, 0}, {1e-6, 0, 0}, 2048),
                  passed * passed * (floor_reflectance / pi), 0.02);
}

TEST(ReferenceMaterials, ALampBehindAPaneIsFoundInEveryWay) {
  Material glass = diffuse(Rgb(0.9, 0.7, 0.5));
  glass.roughness = 0.0;
  glass.transmission = 0.8;
  Scene scene;
  add_floor(scene, diffuse(0.5));
  add_lamp(scene, 1.0, 1.0, diffuse(Rgb(0.0), Rgb(2.0 * pi)));
  add_polygon(scene, "pane", {{-2, 0.5, -2}, {2, 0.5, -2}, {2, 0.5, 2}, {-2, 0.5, 2}}, glass);
  const auto seen = [&](reference::LightSearch search) {
    auto settings = tracing(8, 8, 1024);
    settings.search = search;
    return mean_radiance(traced_picture(scene, look_at({4, 0.15, 1}, Point3(0.0), 1e-4), settings));
  };
  const MeanRadiance both = seen(reference::LightSearch::both);
  for (const auto search : {reference::LightSearch::choosing, reference::LightSearch::meeting}) {
    const MeanRadiance one = seen(search);
    for (int band = 0; band < 3; ++band) {
      const double error = std::hypot(one.error[band], both.error[band]);
      EXPECT_LT(error, 0.01 * both.mean[band]);
      EXPECT_NEAR(one.mean[band], both.mean[band], 4.0 * error);
    }
  }
}

TEST(ReferenceMaterials, RoughWhiteMetalInAFurnaceIsInvisible) {
  // A white metal reflects all it receives:
  // in a room of even radiance it is as bright as the walls, however rough.
  for (const double roughness : {0.05, 0.4, 1.0}) {
    Scene scene = furnace(0.5, {});
    Material metal = mirror(1.0);
    metal.roughness = roughness;
    add_box(scene, "metal", {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, metal);
    const MeanRadiance seen = radiance_seen(scene, {0.5, 0.6, 0.95}, {0.45, 0.5, 0.7}, 1024);
    // The lobe's tables are good to 3e-3.
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(seen.mean[band], 2.0 / pi, 4.0 * seen.error[band] + 3e-3 * 2.0 / pi) << roughness;
  }
}

TEST(ReferenceMaterials, BrushedWhiteMetalInAFurnaceIsInvisible) {
  for (const auto& [roughness, strength] : {std::pair(0.1, 0.6), std::pair(0.3, 1.0)}) {
    Scene scene = furnace(0.5, {});
    Material metal = mirror(1.0);
    metal.roughness = roughness;
    metal.anisotropy = strength;
    metal.anisotropy_direction = {0.6, 0.8};
    add_box(scene, "metal", {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, metal);
    const MeanRadiance seen = radiance_seen(scene, {0.5, 0.6, 0.95}, {0.45, 0.5, 0.7}, 1024);
    // The tables of lobes of two widths are good to 3e-3.
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(seen.mean[band], 2.0 / pi, 4.0 * seen.error[band] + 3e-3 * 2.0 / pi) << roughness;
  }
}

TEST(ReferenceMaterials, PolishedWhiteInAFurnaceIsInvisible) {
  Scene scene = furnace(0.5, {});
  Material polished = diffuse(1.0);
  polished.roughness = 0.05;
  add_box(scene, "polished", {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, polished);
  const MeanRadiance seen = radiance_seen(scene, {0.5, 0.6, 0.95}, {0.45, 0.5, 0.7}, 1024);
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(seen.mean[band], 2.0 / pi, 4.0 * seen.error[band] + 3e-3 * 2.0 / pi);
}

TEST(ReferenceMaterials, ATextureThatCannotBeReadIsLeftOutAndSaid) {
  Scene scene = furnace(0.5, {});
  scene.textures.push_back({.name = "wall.ktx2", .encoded = std::vector<std::byte>(64)});
  scene.materials[0].base_color_texture = TextureUse{.texture = TextureId{0}};
  const reference::TracedScene traced = reference::make_traced_scene(scene);
  ASSERT_FALSE(traced.scene.warnings.empty());
  EXPECT_NE(traced.scene.warnings.back().find("wall.ktx2"), std::string::npos);
  EXPECT_NE(traced.scene.warnings.back().find("the factor is used alone"), std::string::npos);
  // A furnace of E = 1 and reflectance 0.5 glows with 2 / pi.
  expect_radiance(radiance_seen(scene, {0.5, 0.5, 0.9}, {0.5, 0.5, 0.0}, 256), Rgb(2.0 / pi));
}

} // namespace
} // namespace meninas::test
