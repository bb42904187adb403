// Textures of transmission and thickness: glass and what is not, in one surface.
#include "image/image_file.h"
#include "scenes/materials/refraction.h"
#include "tests/raytrace/glass_pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

void add_bulb(Scene& scene, Point3 at) {
  PunctualLight light;
  light.position = at;
  scene.lights = {light};
}

/// A pane over the floor, opaque where x < 0 and glass where x > 0:
/// roughness keeps the opaque half without a coat, and pass one takes glass for clear.
void add_half_pane(Scene& scene, Rgb tint) {
  scene.textures = {half_black()};
  Material material = glass(tint);
  material.roughness = 0.5;
  material.transmission_texture = TextureUse{.texture = TextureId{0}};
  add_polygon(scene, "pane", {{-4, 1, 4}, {4, 1, 4}, {4, 1, -4}, {-4, 1, -4}}, material);
  lay_texture(scene);
}

void add_floor(Scene& scene, double reflectance) {
  add_polygon(scene, "floor", {{-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}},
              diffuse(reflectance));
}

TEST(GlassTextures, ABulbShinesThroughTheGlassAlone) {
  // So dark a floor that what the pane sends back to it does not matter.
  constexpr double rho = 1e-5;
  Scene scene;
  add_floor(scene, rho);
  add_half_pane(scene, Rgb(1.0));
  add_bulb(scene, {0, 3, 0});
  for (const double x : {1.0, 0.2, -0.2, -1.0}) {
    const Point3 at(x, 0, 0);
    const Vec3 way = Point3(0, 3, 0) - at;
    const double cosine = glm::normalize(way).y;
    const double through = rho / pi * cosine / glm::dot(way, way) * pane_transmittance(1.5, cosine);
    EXPECT_NEAR(seen(scene, at + Vec3(0, 0.5, 0.4), at).g, x > 0.0 ? through : 0.0, 1e-3 * through)
        << x;
  }
}

TEST(GlassTextures, TheEyeSeesThroughTheGlassAlone) {
  // A floor that glows below the pane, nothing above:
  // a black pane's opaque half is black, a clear one's shows what passes.
  Scene scene;
  add_polygon(scene, "floor", {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}, diffuse(0.0, pi));
  add_half_pane(scene, Rgb(1.0));
  scene.materials.back().roughness = 0.0;
  for (const double x : {2.0, 0.5, -0.5, -2.0}) {
    const Vec3 way(0.0, 1.0, 1.0);
    const Point3 at(x, 1.0, 0.0);
    const double exact = x > 0.0 ? pane_transmittance(1.5, std::sqrt(0.5)) : 0.0;
    EXPECT_NEAR(seen(scene, at + way, at).g, exact, 1e-5) << x;
  }
}

TEST(GlassTextures, ThePaneThrowsABulbFromItsGlassAlone) {
  // Black glass reflects at its first face.
  // The wall sees the bulb by way of the half of the pane on its own side.
  constexpr double rho = 1e-5;
  for (const double side : {1.0, -1.0}) {
    Scene scene;
    add_half_pane(scene, Rgb(0.0));
    add_polygon(scene, "wall", {{4, 1.5, -2}, {4, 1.5, 2}, {4, 4.5, 2}, {4, 4.5, -2}},
                diffuse(rho));
    if (side < 0.0)
      for (std::size_t v = scene.vertices.size() - 4; v < scene.vertices.size(); ++v)
        scene.vertices[v].position.x *= -1.0;
    if (side < 0.0)
      for (std::size_t t = scene.triangles.size() - 2; t < scene.triangles.size(); ++t)
        std::swap(scene.triangles[t].vertices[1], scene.triangles[t].vertices[2]);
    add_bulb(scene, {0, 2, 0});
    // The wall hangs where the bulb does not see it straight: a screen is between.
    add_polygon(scene, "screen",
                {{side * 2, 1.8, -9}, {side * 2, 1.8, 9}, {side * 2, 9, 9}, {side * 2, 9, -9}},
                double_sided(diffuse(0.0)));
    const Point3 at(side * 4, 3, 0);
    const Vec3 way = Point3(0, 0, 0) - at;
    const double r2 = glm::dot(way, way), at_wall = 4.0 / std::sqrt(r2),
                 at_pane = 3.0 / std::sqrt(r2);
    const double exact =
        side > 0.0 ? rho / pi * at_wall / r2 * face_reflectance(1.5, at_pane) : 0.0;
    EXPECT_NEAR(seen(scene, at - Vec3(side, 0, 0), at).g, exact, 1e-3 * exact) << side;
  }
}

TEST(GlassTextures, APaneOfTwoHalvesIsTwoPanes) {
  // Elements of which the border of the halves is one as well:
  // where they straddle it they are a mean of both.
  PassOneSettings settings = coarse();
  settings.mesh.element_size = 0.1;
  // Meshes and samples of the two differ; the field's noise is to be small beside the picture's.
  settings.form_factors.rays = settings.interpolation.rays = 1024;
  const Taken textured = lit_up(half_glazed_room(Halves::by_texture), settings);
  const Taken separate = lit_up(half_glazed_room(Halves::of_their_own), settings);
  // Walls of some hundred elements, each with the noise of its rays.
  const auto nodes = [](const Taken& taken) {
    return light_by_node(taken.prepared->scene, taken.prepared->mesh, taken.solution);
  };
  const auto a = nodes(textured), b = nodes(separate);
  for (std::size_t n = 0; n < 6; ++n)
    EXPECT_NEAR(a[n].irradiance.g, b[n].irradiance.g, 0.003 * b[n].irradiance.g) << a[n].name;
  for (const Taken* taken : {&textured, &separate}) {
    EXPECT_LT(std::abs(taken->solution.energy.imbalance), 0.02);
    EXPECT_LT(taken->solution.closure.max_error, 1e-6);
  }
  RenderSettings small = one_pixel();
  small.width = small.height = 24;
  const Camera camera = look_at({1.7, 1.2, 1.9}, {0.9, 0.7, 0.5}, 0.9);
  const PictureChange change =
      change_inside(picture(separate, camera, small), picture(textured, camera, small),
                    std::vector<bool>(24 * 24, false));
  // Elements and their samples are others:
  // they differ about as a picture and its like by other samples do.
  RenderSettings other = small;
  other.seed = 1;
  const PictureChange by_chance =
      change_inside(picture(separate, camera, small), picture(separate, camera, other),
                    std::vector<bool>(24 * 24, false));
  EXPECT_LT(change.rms, 1.3 * by_chance.rms);
}

TEST(GlassTextures, ElementsKnowHowMuchIsOpaque) {
  const Taken taken = lit_up(half_glazed_room(Halves::by_texture), coarse());
  const ElementMesh& mesh = taken.prepared->mesh;
  const Material& pane = taken.prepared->scene.materials.back();
  Material opaque = pane;
  opaque.transmission = 0.0;
  double area = 0.0;
  Rgb mean(0.0);
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    if (!mesh.sides[index(mesh.side_of_element[e])].textured)
      continue;
    area += mesh.area[e];
    mean += mesh.area[e] * mesh.reflectance[e];
  }
  ASSERT_NEAR(area, 2.0 * 1.6 * 1.7, 1e-6);
  // The border goes through the middle of elements: 64 stratified points each.
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(mean[band] / area, 0.5 * diffuse_reflectance(opaque)[band], 0.005);
}

TEST(GlassTextures, ThicknessSaysWhatASheetOfASolidTakes) {
  // Pass one takes a solid for two sheets, each of which takes half of what its thickness does:
  // a texture of it is a factor there.
  constexpr double rho = 1e-5;
  const auto lit_through = [&](bool textured, double x) {
    Scene scene;
    add_floor(scene, rho);
    Material block = solid_glass(Rgb(1.0));
    block.thickness = 0.4;
    block.attenuation_color = {0.5, 0.5, 0.5};
    block.attenuation_distance = 0.1;
    scene.textures = {half_black()};
    if (textured)
      block.thickness_texture = TextureUse{.texture = TextureId{0}};
    add_polygon(scene, "sheet", {{-4, 1, 4}, {4, 1, 4}, {4, 1, -4}, {-4, 1, -4}}, block);
    lay_texture(scene);
    add_bulb(scene, {x, 2, 0});
    return seen(scene, {x, 0.5, 0.4}, {x, 0, 0}).g;
  };
  const double taken = std::pow(0.5, 0.5 * 0.4 / 0.1);
  for (const double x : {1.0, -1.0}) {
    const double plain = lit_through(false, x);
    EXPECT_NEAR(lit_through(true, x) * (x > 0.0 ? 1.0 : taken), plain, 1e-5 * plain) << x;
  }
}

TEST(GlassTextures, WhereMetalIsNoneItIsGlassAndDiffuse) {
  // By its factors all metal, by its texture where x > 0; half of what is no metal is glass.
  Scene scene;
  scene.textures = {half_black()};
  Material material = glass(Rgb(0.8));
  material.metallic = 1.0;
  material.specular = 0.0;
  material.transmission = 0.5;
  material.metallic_roughness_texture = TextureUse{.texture = TextureId{0}};
  add_polygon(scene, "plate", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, material);
  lay_texture(scene);
  add_bulb(scene, {0, 1, 0});
  for (const double x : {-0.5, 0.5}) {
    const Point3 at(x, 0, 0);
    const Vec3 way = Point3(0, 1, 0) - at;
    const double exact = x < 0.0 ? 0.4 / pi / std::pow(glm::dot(way, way), 1.5) : 0.0;
    EXPECT_NEAR(seen(scene, at + Vec3(0, 0.5, 0.4), at).g, exact, 1e-5) << x;
  }
}

} // namespace
} // namespace meninas::test
