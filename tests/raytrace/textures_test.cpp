// Textures in both passes:
// means over the elements, the image itself at every hit, and light by what glows in patterns.
#include "image/image_file.h"
#include "radiosity/scene/surface_colour.h"
#include "raytrace/scene_textures.h"
#include "raytrace/two_pass.h"
#include "tests/raytrace/glass_pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace meninas::test {
namespace {

/// A picture of black and white squares, n to a side, `cell` texels wide each; the first is white.
Texture chessboard(int n, int cell) {
  Image image(n * cell, n * cell);
  for (int y = 0; y < n * cell; ++y)
    for (int x = 0; x < n * cell; ++x)
      image.at(x, y) = glm::vec3((x / cell + y / cell) % 2 == 0 ? 1.0F : 0.0F);
  return {.name = "chessboard", .encoded = encode_png(image, 0.0)};
}

/// The unit square about the origin in the plane y = `height`,
/// facing up or down, with texture coordinates (x, z) + 1/2.
void add_square(Scene& scene, const std::string& name, double height, bool up, Material material,
                double half = 0.5) {
  std::vector<Point3> corners{
      {-half, height, half}, {half, height, half}, {half, height, -half}, {-half, height, -half}};
  if (!up)
    std::reverse(corners.begin(), corners.end());
  const std::size_t first = scene.vertices.size();
  add_polygon(scene, name, corners, material);
  for (std::size_t v = first; v < scene.vertices.size(); ++v) {
    const Point3& x = scene.vertices[v].position;
    own_attributes(scene, scene.vertices[v]).texcoord[0] =
        glm::vec2(x.x, x.z) / float(2.0 * half) + 0.5F;
  }
}

Material painted(double reflectance) {
  Material material = diffuse(reflectance);
  material.base_color_texture = TextureUse{.texture = TextureId{0}};
  return material;
}

TwoPassSettings quick(double element_size) {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = element_size;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 64;
  settings.render.width = settings.render.height = 1;
  settings.render.samples = 16;
  return settings;
}

// A solution carries the hash of the scene as it was prepared; who reads it settles the textures
// of the scene before it asks. So to settle is what preparation does, and once is enough.
TEST(Textures, ThatAreConstantMakeOneSceneHoweverOftenTheyAreSettled) {
  Image grey(8, 8);
  for (glm::vec3& pixel : grey.pixels)
    pixel = glm::vec3(0.5F);
  Scene scene;
  scene.textures = {{.name = "grey", .encoded = encode_png(grey, 0.0)}, chessboard(4, 16)};
  add_square(scene, "floor", 0.0, true, painted(0.8));
  Material tiles = diffuse(0.5);
  tiles.base_color_texture = TextureUse{.texture = TextureId{1}};
  add_square(scene, "ceiling", 1.0, false, tiles);
  scene.background = Rgb(1.0);
  const auto prepared = prepare_scene(scene, quick(0.5).pass_one);
  const std::uint64_t as_loaded = content_hash(scene);
  std::vector<std::string> warnings;
  settle_textures(scene, warnings);
  EXPECT_NE(content_hash(scene), as_loaded);
  EXPECT_EQ(content_hash(scene), content_hash(prepared->scene));
  EXPECT_FALSE(is_textured(scene.materials[0]));
  EXPECT_TRUE(is_textured(scene.materials[1]));
  settle_textures(scene, warnings);
  EXPECT_EQ(content_hash(scene), content_hash(prepared->scene));
}

TEST(Textures, ElementsKnowTheMeanOverThemselves) {
  // Two by two elements on four by four squares: half of each is white.
  // On the squares themselves they are black or white, but for the texels at the borders,
  // which are interpolated: 1/16 of a square, to either side alike.
  Scene scene;
  scene.textures = {chessboard(4, 16)};
  add_square(scene, "floor", 0.0, true, painted(0.8));
  scene.background = Rgb(1.0);
  for (const double size : {0.5, 0.25}) {
    const auto prepared = prepare_scene(scene, quick(size).pass_one);
    const ElementMesh& mesh = prepared->mesh;
    ASSERT_EQ(element_count(mesh), size == 0.5 ? 4U : 16U);
    double mean = 0.0;
    for (std::size_t e = 0; e < element_count(mesh); ++e) {
      mean += mesh.area[e] * mesh.reflectance[e].g;
      if (size == 0.5)
        // Four standard deviations of 64 stratified points: 0.8 / 2 / 64^(3/4) each.
        EXPECT_NEAR(mesh.reflectance[e].g, 0.4, 0.07);
      else
        EXPECT_LE(std::min(mesh.reflectance[e].g, 0.8 - mesh.reflectance[e].g), 0.8 * 0.07);
    }
    EXPECT_NEAR(mean, 0.4, 0.01) << size;
  }
}

TEST(Textures, APictureShowsTheImageUnderEvenLight) {
  // Under a sky of radiance 1 the floor shows its own reflectance.
  // Cameras look at the middles of squares and at a border.
  Scene scene;
  scene.textures = {chessboard(4, 16)};
  add_square(scene, "floor", 0.0, true, painted(0.8));
  scene.background = Rgb(1.0);
  const auto shown = [&](const Point3& at) {
    scene.cameras = {look_at(at + Vec3(0.1, 0.5, 0.2), at, 1e-5)};
    TwoPassSettings settings = quick(0.5);
    const auto prepared = prepare_scene(scene, settings.pass_one);
    return double{two_pass(*prepared, scene.cameras[0], settings).rendering.image.at(0, 0).g};
  };
  EXPECT_NEAR(shown({-0.375, 0.0, -0.375}), 0.8, 1e-5);
  EXPECT_NEAR(shown({-0.125, 0.0, -0.375}), 0.0, 1e-5);
  EXPECT_NEAR(shown({0.125, 0.0, -0.125}), 0.0, 1e-5);
  EXPECT_NEAR(shown({0.0, 0.0, -0.375}), 0.4, 1e-3);
}

TEST(Textures, VertexColoursAreLinearInThePictureAndMeansInPassOne) {
  // Red rises from 0 at x = -1/2 to 1 at x = 1/2, under a sky of radiance 1.
  Scene scene;
  add_square(scene, "floor", 0.0, true, diffuse(0.8));
  for (Vertex& vertex : scene.vertices)
    own_attributes(scene, vertex).color.r = static_cast<float>(vertex.position.x) + 0.5F;
  scene.background = Rgb(1.0);
  const auto settings = quick(0.5);
  const auto prepared = prepare_scene(scene, settings.pass_one);
  EXPECT_EQ(prepared->plan.bands, 3);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);
  for (std::size_t e = 0; e < element_count(prepared->mesh); ++e) {
    double middle = 0.0;
    for (const ElementVertexId corner : prepared->mesh.corners[e])
      middle += 0.25 * (prepared->mesh.vertices[index(corner)].x + 0.5);
    // Four standard deviations of 64 stratified points: 0.4 / sqrt(12) / 64^(3/4) each.
    EXPECT_NEAR(prepared->mesh.reflectance[e].r, 0.8 * middle, 0.025);
    EXPECT_NEAR(prepared->mesh.reflectance[e].g, 0.8, 1e-6);
  }
  for (const double x : {-0.4, -0.1, 0.2, 0.45}) {
    const Point3 at{x, 0.0, 0.3};
    const Image seen = render(solution.field,
                              look_at(at + Vec3(0.1, 0.5, 0.2), at, 1e-5), settings.render)
                           .image;
    EXPECT_NEAR(seen.at(0, 0).r, 0.8 * (x + 0.5), 1e-5);
    EXPECT_NEAR(seen.at(0, 0).g, 0.8, 1e-5);
  }
}

TEST(Textures, AreAsSharpInAMirror) {
  Scene scene;
  scene.textures = {chessboard(4, 16)};
  add_square(scene, "floor", 0.0, true, painted(0.8));
  add_polygon(scene, "mirror", {{-0.5, 0, 0.5}, {-0.5, 0, -0.5}, {-0.5, 1, -0.5}, {-0.5, 1, 0.5}},
              mirror(0.9));
  scene.background = Rgb(1.0);
  TwoPassSettings settings = quick(0.25);
  settings.render.width = settings.render.height = 24;
  // A camera behind the mirror looks past its back,
  // and sees what the mirror shows, left and right exchanged.
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const auto solution = solve_pass_one(prepared->light(), settings.pass_one);
  const auto seen = [&](const Point3& from, const Point3& at) {
    return render(solution.field, look_at(from, at, 0.1), settings.render).image;
  };
  const Image in_mirror = seen({0.4, 0.5, 0.1}, {-0.75, 0.0, 0.0});
  const Image straight = seen({-1.4, 0.5, 0.1}, {-0.25, 0.0, 0.0});
  // Pixels at borders of squares and of the floor have other samples left than right.
  int white = 0, black = 0;
  for (int y = 1; y < 23; ++y)
    for (int x = 1; x < 23; ++x) {
      const float wanted = straight.at(23 - x, y).g;
      float spread = 0.0F;
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
        spread = std::max(spread, std::abs(straight.at(23 - x + dx, y + dy).g - wanted));
      if (spread > 0.01F)
        continue;
      ++(wanted > 0.4F ? white : black);
      EXPECT_NEAR(in_mirror.at(x, y).g, 0.9F * wanted, 0.01F) << x << ' ' << y;
    }
  EXPECT_GT(white, 20);
  EXPECT_GT(black, 20);
}

TEST(Textures, WhereSmoothMetalIsNoneItIsDiffuse) {
  // Metal where x > 0, and all of it smooth;
  // a bulb, which no ideal mirror shows but in its own direction.
  Scene scene;
  scene.textures = {half_black()};
  Material metal = mirror(0.8);
  metal.specular = 0.0;
  metal.metallic_roughness_texture = TextureUse{.texture = TextureId{0}};
  add_polygon(scene, "plate", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, metal);
  lay_texture(scene);
  scene.lights = {{.name = "bulb", .position = {0.0, 1.0, 0.0}}};
  for (const double x : {-0.9, -0.4, 0.4, 0.9}) {
    const Point3 at(x, 0.0, 0.0);
    const Vec3 way = scene.lights[0].position - at;
    const double r2 = glm::dot(way, way);
    const double exact = x < 0.0 ? 0.8 / std::numbers::pi / (r2 * std::sqrt(r2)) : 0.0;
    EXPECT_NEAR(seen(scene, at + Vec3(0.0, 0.5, 0.4), at).g, exact, 1e-5) << x;
  }
  // What the metal throws is spread evenly.
  const Taken taken = lit_up(scene, coarse());
  ASSERT_GT(element_count(taken.prepared->mesh), 0U);
  for (const Rgb& reflectance : taken.prepared->mesh.reflectance)
    EXPECT_NEAR(reflectance.g, 0.8, 1e-6);
}

TEST(Textures, WhatGlowsInPatternsLightsInPatterns) {
  // A lamp that glows in its half x < 0 alone lights like half the lamp.
  const auto floor_light = [](bool pattern, double at) {
    Scene scene;
    Image halves(64, 1);
    for (int x = 0; x < 32; ++x)
      halves.at(x, 0) = glm::vec3(1.0F);
    scene.textures = {{.name = "halves",
                       .encoded = encode_png(halves, 0.0),
                       .wrap_u = Wrap::clamp,
                       .wrap_v = Wrap::clamp}};
    add_square(scene, "floor", 0.0, true, diffuse(0.5), 1.5);
    Material lamp = diffuse(0.0, 10.0);
    if (pattern) {
      lamp.emissive_texture = TextureUse{.texture = TextureId{0}};
      add_square(scene, "lamp", 1.0, false, lamp);
    } else {
      add_polygon(scene, "lamp", {{-0.5, 1, -0.5}, {0, 1, -0.5}, {0, 1, 0.5}, {-0.5, 1, 0.5}},
                  lamp);
    }
    const auto prepared = prepare_scene(scene, quick(0.25).pass_one);
    EXPECT_EQ(prepared->light()->emitters.size(), pattern ? 12U : 1U)
        << "two columns, and the one that the border reaches";
    DirectWorkspace work;
    return direct_irradiance(*prepared->light(), {{at, 0, 0.1}, {0, 1, 0}, PlaneId{0}, {}}, {}, 0,
                             work)
        .total.g;
  };
  // The border between the halves is one texel wide, 1/64 of the lamp, and even about its middle.
  for (const double at : {-0.4, 0.0, 0.7})
    EXPECT_NEAR(floor_light(true, at), floor_light(false, at), 0.02 * floor_light(false, at)) << at;
}

TEST(Textures, WhatCannotBeDecodedIsLeftOutWithAWarning) {
  Scene scene;
  scene.textures = {{.name = "scene.gltf: images/0", .encoded = {std::byte{1}, std::byte{2}}}};
  add_square(scene, "floor", 0.0, true, painted(0.8));
  const auto prepared = prepare_scene(scene, quick(0.5).pass_one);
  EXPECT_THAT(prepared->plan.warnings,
              testing::Contains(testing::AllOf(testing::StartsWith("scene.gltf: images/0"),
                                               testing::HasSubstr("factor is used alone"))));
  EXPECT_NEAR(prepared->mesh.reflectance[0].g, 0.8, 1e-12);
}

TEST(Textures, EnergyIsThatOfTheImages) {
  Scene scene;
  scene.textures = {chessboard(4, 16)};
  add_square(scene, "floor", 0.0, true, painted(0.8));
  scene.background = Rgb(1.0);
  const auto prepared = prepare_scene(scene, quick(0.25).pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), quick(0.25).pass_one);
  EXPECT_NEAR(solution.energy.absorbed.g, 0.6 * std::numbers::pi, 0.02);
  EXPECT_NEAR(solution.energy.imbalance, 0.0, 1e-6);
}

/// A PNG of two white pixels: the first is opaque, the second is not there.
constexpr unsigned char half_there[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
    0x00, 0xf4, 0x22, 0x7f, 0x8a, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0xf8, 0x0f, 0x01, 0x0c, 0x00, 0x22, 0xe6, 0x06, 0xfa, 0x08, 0xfa, 0x02,
    0x27, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

/// A black screen at height 1/2 over the half x < 0 of a floor under the sky:
/// as it is, or a whole one with its other half cut out.
Scene under_a_screen(bool cut_out) {
  Scene scene;
  const auto bytes = std::as_bytes(std::span(half_there));
  scene.textures = {{.name = "half there",
                     .encoded = {bytes.begin(), bytes.end()},
                     .wrap_u = Wrap::clamp,
                     .wrap_v = Wrap::clamp}};
  add_square(scene, "floor", 0.0, true, diffuse(0.5));
  Material screen = double_sided(diffuse(0.0));
  if (cut_out) {
    screen.alpha_mode = AlphaMode::mask;
    screen.base_color_texture = TextureUse{.texture = TextureId{0}};
    add_square(scene, "screen", 0.5, true, screen);
  } else {
    add_polygon(scene, "screen",
                {{-0.5, 0.5, 0.5}, {0, 0.5, 0.5}, {0, 0.5, -0.5}, {-0.5, 0.5, -0.5}}, screen);
  }
  scene.background = Rgb(1.0);
  scene.lights = {{.name = "lamp", .intensity = Rgb(4.0), .position = {0.1, 1.5, 0.0}}};
  scene.cameras = {look_at({0.1, 2.0, 0.3}, {0.0, 0.0, 0.0}, 0.6)};
  return scene;
}

TEST(CutOuts, EveryRayPassesTheirHoles) {
  // Camera rays, shadow rays and the rays of form factors:
  // the same picture, but for the line of pixels where the screen ends.
  TwoPassSettings settings = quick(0.25);
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 1024;
  settings.render.width = settings.render.height = 32;
  std::array<Image, 2> pictures;
  for (const bool cut_out : {false, true}) {
    const Scene scene = under_a_screen(cut_out);
    const auto prepared = prepare_scene(scene, settings.pass_one);
    pictures[cut_out ? 1 : 0] = two_pass(*prepared, scene.cameras[0], settings).rendering.image;
  }
  int apart = 0;
  double light = 0.0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double a = pictures[0].at(x, y).g, b = pictures[1].at(x, y).g;
      light += a / 1024.0;
      apart += std::abs(a - b) > 0.02 * std::max(a, b) ? 1 : 0;
    }
  EXPECT_GT(light, 0.2);
  EXPECT_LE(apart, 2 * 32); // two columns of pixels at most
}

TEST(CutOuts, WhatIsCutOutNeitherEmitsNorReflects) {
  Scene scene = under_a_screen(true);
  scene.lights.clear();
  scene.background = Rgb(0.0);
  for (Material& material : scene.materials)
    if (material.alpha_mode == AlphaMode::mask) {
      material.emission = Rgb(1.0);
      material.double_sided = false;
    }
  const auto prepared = prepare_scene(scene, quick(0.25).pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), quick(0.25).pass_one);
  EXPECT_NEAR(solution.energy.emitted.g, 0.5 * std::numbers::pi, 0.02);
}

TEST(Textures, OfMirrorsColourWhatIsSeenInThem) {
  // A sky seen in a mirror painted with 2 x 2 squares, half of them black;
  // the camera looks at the middle of the first, which is white, and at the next.
  Scene scene;
  scene.background = Rgb(1.0);
  scene.textures = {chessboard(2, 8)};
  Material silver = mirror(0.9);
  silver.base_color_texture = TextureUse{.texture = TextureId{0}};
  add_square(scene, "mirror", 0.0, true, silver);
  const TwoPassSettings settings = quick(1.0);
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);
  const auto seen_at = [&](double x) {
    const Camera camera = look_at({x, 1.0, 0.3}, {x, 0.0, -0.25}, 1e-3);
    return render(solution.field, camera, settings.render).image.pixels[0].g;
  };
  EXPECT_NEAR(seen_at(-0.25), 0.9, 1e-5);
  EXPECT_EQ(seen_at(0.25), 0.0F);
}

} // namespace
} // namespace meninas::test
