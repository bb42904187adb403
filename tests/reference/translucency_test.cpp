// Sheets by paths: against closed forms, and the two passes against them.
#include "image/image_file.h"
#include "raytrace/two_pass.h"
#include "tests/reference/tracing.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"
#include "tests/support/translucent.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

TEST(ReferenceTranslucency, AreWhiteInAFurnace) {
  Scene scene = furnace(0.5, {});
  Material cloth = translucent(Rgb(1.0), 0.6, Rgb(1.0));
  cloth.roughness = 0.1;
  add_polygon(scene, "sheet", {{0.2, 0.5, 0.2}, {0.8, 0.5, 0.2}, {0.8, 0.6, 0.8}, {0.2, 0.6, 0.8}},
              cloth);
  for (const double y : {0.1, 0.9})
    expect_radiance(radiance_seen(scene, {0.4, y, 0.45}, {0.5, 0.55, 0.5}, 256),
                    Rgb(2.0 / std::numbers::pi));
}

// Black walls, one of which glows, and a sheet across the whole room: B behind is tau times the
// irradiance of the glowing wall, E F with F = 4/pi atan(1/sqrt(2)) / sqrt(2) = 0.5541 of a square from
// over its middle, half its width away (Lambert's closed form).
TEST(ReferenceTranslucency, ShowWhatTheirOtherSideReceives) {
  Scene scene;
  const Material black = diffuse(0.0);
  add_room(scene, Point3(0.0), Point3(2.0), {black, black, black, diffuse(0.0, 3.0), black, black});
  add_polygon(scene, "sheet", {{0, 1, 0}, {2, 1, 0}, {2, 1, 2}, {0, 1, 2}},
              translucent(Rgb(0.8), 0.25, {1.0, 0.5, 0.2}));
  const double factor = 4.0 / std::numbers::pi * std::atan(1.0 / std::sqrt(2.0)) / std::sqrt(2.0);
  expect_radiance(radiance_seen(scene, {1.3, 0.3, 1.0}, {1.0, 1.0, 1.0}, 256),
                  0.25 * Rgb(1.0, 0.5, 0.2) * (3.0 * factor / std::numbers::pi));
  expect_radiance(radiance_seen(scene, {1.3, 1.6, 1.0}, {1.0, 1.0, 1.0}, 256),
                  Rgb(0.75 * 0.8 * 3.0 * factor / std::numbers::pi));
}

TEST(ReferenceTranslucency, PointLightsShineThroughThem) {
  Scene scene;
  add_polygon(scene, "sheet", {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}},
              translucent(Rgb(0.8), 0.5, Rgb(0.6)));
  PunctualLight light;
  light.position = {0.0, 2.0, 0.0};
  light.intensity = Rgb(8.0);
  scene.lights.push_back(light);
  // E = I / r^2 = 2 W/m^2 in the middle.
  expect_radiance(radiance_seen(scene, {0.1, -1.0, 0.0}, {0.0, 0.0, 0.0}, 64),
                  Rgb(0.3 * 2.0 / std::numbers::pi));
}

struct Sight {
  const char* what;
  Point3 eye, target;
};

Rgb seen_by_two_passes(const RadiositySolution& solution, const Sight& sight, DiffuseTerm term) {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 64;
  settings.glossy_samples = 64;
  settings.diffuse.term = term;
  return render(solution.field, look_at(sight.eye, sight.target, 1e-4), settings).image.pixels[0];
}

/// Within four standard errors of the paths and the error of the field of 10 cm elements, 1 %, and
/// 3 % where it is interpolated alone.
void expect_agreement(const Scene& scene, std::initializer_list<Sight> sights,
                      MeshCut cut = MeshCut::uniform) {
  PassOneSettings settings;
  settings.cut = cut;
  settings.mesh.element_size = 0.1;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  const auto prepared = prepare_scene(scene, settings);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings);
  for (const Sight& sight : sights) {
    const MeanRadiance truth = radiance_seen(scene, sight.eye, sight.target, 1024);
    for (const DiffuseTerm term :
         {DiffuseTerm::direct, DiffuseTerm::interpolated, DiffuseTerm::gather}) {
      SCOPED_TRACE(testing::Message() << sight.what << ", term " << int(term));
      const double field_error = term == DiffuseTerm::interpolated ? 0.03 : 0.01;
      const Rgb found = seen_by_two_passes(solution, sight, term);
      for (int band = 0; band < 3; ++band) {
        EXPECT_LT(truth.error[band], 0.03 * truth.mean[band]);
        EXPECT_NEAR(found[band], truth.mean[band],
                    4.0 * truth.error[band] + field_error * truth.mean[band]);
      }
    }
  }
}

/// Of the room with a pane the pane is a curtain.
Scene room_with_curtain(const Material& curtain) {
  Scene scene = glazed_room();
  scene.materials.back() = curtain;
  return scene;
}
const Material cloth = translucent({0.8, 0.4, 0.2}, 0.6, {0.9, 0.5, 0.3});

TEST(TranslucencyByTwoPasses, ACurtainBeforeALamp) {
  for (const MeshCut cut : mesh_cuts)
    expect_agreement(room_with_curtain(cloth),
                     {{"the curtain against the light", {1.0, 0.9, 0.3}, {1.0, 0.9, 0.8}},
                      {"the curtain from the lamp", {1.0, 0.9, 1.6}, {0.8, 0.7, 0.8}},
                      {"the wall that it lights", {1.5, 1.0, 0.4}, {1.0, 0.6, 0.0}}},
                     cut);
}

TEST(TranslucencyByTwoPasses, ACurtainThatReflectsNothing) {
  expect_agreement(room_with_curtain(translucent(Rgb(0.5), 1.0, {0.9, 0.5, 0.3})),
                   {{"against the light", {1.0, 0.9, 0.3}, {1.0, 0.9, 0.8}},
                    {"the wall that it lights", {1.5, 1.0, 0.4}, {1.0, 0.6, 0.0}}});
}

// In light from all around: pass one takes what gets below a coat in the mean over all angles.
TEST(TranslucencyByTwoPasses, AClothWithACoat) {
  Scene scene = furnace(0.5, {});
  Material coated = cloth;
  coated.roughness = 0.15;
  add_polygon(scene, "cloth", {{0.2, 0.5, 0.2}, {0.8, 0.5, 0.2}, {0.8, 0.6, 0.8}, {0.2, 0.6, 0.8}},
              coated);
  expect_agreement(scene, {{"from below", {0.4, 0.1, 0.45}, {0.5, 0.55, 0.5}},
                           {"from above, along it", {0.9, 0.7, 0.45}, {0.5, 0.55, 0.5}}});
}

TEST(TranslucencyByTwoPasses, LaceThatIsOpenInPart) {
  Material lace = cloth;
  lace.alpha_mode = AlphaMode::blend;
  lace.alpha = 0.6;
  lace.transmission = 0.4;
  expect_agreement(room_with_curtain(lace),
                   {{"against the light", {1.0, 0.9, 0.3}, {1.0, 0.9, 0.8}},
                    {"the wall behind", {1.5, 1.0, 0.4}, {1.0, 0.6, 0.0}}});
}

TEST(TranslucencyByTwoPasses, ACurtainInAMirror) {
  Scene scene = room_with_curtain(cloth);
  scene.materials[4] = mirror(0.9); // of the wall z = 0
  expect_agreement(scene, {{"its back in the mirror", {1.6, 1.0, 0.5}, {1.2, 0.8, 0.0}},
                           {"and itself", {1.0, 0.9, 1.6}, {0.8, 0.7, 0.8}}});
}

/// Below a half-black texture each half is what it would be alone.
TEST(TranslucencyByTwoPasses, TexturesSayWhatComesThroughAtEveryPoint) {
  for (const bool of_colour : {false, true}) {
    Scene scene = glazed_room();
    scene.materials.pop_back();
    scene.triangles.resize(scene.triangles.size() - 2);
    scene.textures = {half_black()};
    Material pattern = cloth;
    (of_colour ? pattern.diffuse_transmission_color_texture : pattern.base_color_texture) =
        TextureUse{.texture = TextureId{0}};
    add_polygon(scene, "curtain",
                {{0.2, 0.0, 0.8}, {1.8, 0.0, 0.8}, {1.8, 1.7, 0.8}, {0.2, 1.7, 0.8}}, pattern);
    lay_texture(scene);
    expect_agreement(scene, {{"the white half from behind", {1.4, 0.9, 0.3}, {1.03, 0.9, 0.8}},
                             {"the white half", {1.2, 0.9, 1.6}, {1.03, 0.7, 0.8}},
                             {"the black half, lit",
                              of_colour ? Point3(0.7, 0.9, 1.6) : Point3(0.7, 0.9, 0.3),
                              {0.97, 0.8, 0.8}}});
  }
}

// A shade of four sides around a lamp, open above and below.
TEST(TranslucencyByTwoPasses, ALampshadeGlows) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(Rgb(0.6, 0.5, 0.4)));
  add_room(scene, Point3(0.0), Point3(2.0), walls);
  add_box(scene, "bulb", {0.96, 1.16, 0.96}, {1.04, 1.24, 1.04}, diffuse(0.0, 200.0));
  const Material paper = translucent(Rgb(0.8), 0.5, {0.9, 0.7, 0.5});
  const double low = 1.0, high = 1.4, a = 0.8, b = 1.2;
  add_polygon(scene, "shade", {{a, low, b}, {b, low, b}, {b, high, b}, {a, high, b}}, paper);
  add_polygon(scene, "shade", {{b, low, b}, {b, low, a}, {b, high, a}, {b, high, b}}, paper);
  add_polygon(scene, "shade", {{b, low, a}, {a, low, a}, {a, high, a}, {b, high, a}}, paper);
  add_polygon(scene, "shade", {{a, low, a}, {a, low, b}, {a, high, b}, {a, high, a}}, paper);
  for (const MeshCut cut : mesh_cuts)
    expect_agreement(scene,
                     {{"the shade", {1.2, 1.1, 1.9}, {1.0, 1.2, 1.2}},
                      {"its edge", {1.2, 1.1, 1.9}, {0.85, 1.35, 1.2}},
                      {"the wall beside it", {0.5, 1.0, 1.0}, {0.0, 1.2, 1.0}},
                      {"the floor below", {1.0, 0.5, 1.7}, {1.0, 0.0, 1.0}}},
                     cut);
}

} // namespace
} // namespace meninas::test
