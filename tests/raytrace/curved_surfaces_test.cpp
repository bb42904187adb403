// Surfaces with vertex normals look as the curves that they stand for.
#include "image/image_file.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/globes.h"
#include "tests/support/metals.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.5;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  settings.solver.tolerance = 1e-5;
  return settings;
}

RenderSettings size(int width, int height, int samples = 16) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples = samples;
  return settings;
}

/// A room whose six walls glow in colours of their own, around the origin.
Scene coloured_room() {
  Scene scene;
  std::array<Material, 6> walls;
  for (std::size_t k = 0; k < 6; ++k) {
    walls[k] = diffuse(0.0);
    walls[k].emission = Rgb(double(k & 1U), double((k >> 1U) & 1U), double(k >> 2U)) + 0.5;
  }
  add_room(scene, Point3(-5.0), Point3(5.0), walls);
  return scene;
}

/// The emission of the wall that a ray from inside the room meets.
glm::vec3 wall_towards(const Scene& room, const Point3& from, const Direction& d) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t wall = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double t = ((d[axis] > 0.0 ? 5.0 : -5.0) - from[axis]) / d[axis];
    if (t < nearest) {
      nearest = t;
      wall = 2 * static_cast<std::size_t>(axis) + (d[axis] > 0.0 ? 1 : 0);
    }
  }
  return glm::vec3(room.materials[wall].emission);
}

/// Calls visit(x, y, point, direction) for pixels of a picture of 64 x 64 whose middle rays meet
/// the unit sphere well inside its outline, which is outside that of its facets.
template <typename Visit>
void for_each_on_sphere(const Camera& camera, const Visit& visit) {
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const CameraRay ray = camera_ray(camera, 1.0, (x + 0.5) / 64.0, (y + 0.5) / 64.0);
      const Direction d = glm::normalize(ray.direction);
      const double b = glm::dot(ray.origin, d), c = glm::dot(ray.origin, ray.origin) - 1.0,
                   root = b * b - c;
      if (root >= 0.2)
        visit(x, y, ray.origin + (-b - std::sqrt(root)) * d, d);
    }
}

/// Of the pixels well inside the globe's outline, the share that shows another wall than the
/// sphere's mirror image does.
double wrong_share(GivenNormals normals) {
  const Scene room = coloured_room();
  Scene scene = room;
  add_globe(scene, "ball", {}, mirror(1.0), normals);
  const Camera camera = look_at({0.3, 0.4, 4.0}, Point3(0.0), 0.5);
  const Image image = picture(lit_up(scene, coarse()), camera, size(64, 64, 1));
  int wrong = 0, all = 0;
  for_each_on_sphere(camera, [&](int x, int y, const Point3& hit, const Direction& d) {
    const glm::vec3 truth = wall_towards(room, hit, d - 2.0 * glm::dot(d, hit) * hit);
    ++all;
    wrong += glm::distance(image.at(x, y), truth) > 1e-3F ? 1 : 0;
  });
  return double(wrong) / double(all);
}

// The normals of 15 degrees' interpolation are off by less than h^2/8 = 0.009 radians
// (shading_normal_test), the place by 0.009 radii: together they move the image by a few
// hundredths. About 2 % of its pixels are that near to an edge of the room.
TEST(CurvedSurfaces, AMirrorGlobeReflectsAsTheSphere) {
  EXPECT_LT(wrong_share(GivenNormals::smooth), 0.05);
  EXPECT_GT(wrong_share(GivenNormals::flat), 0.10);
}

// Under a directional light the globe has L = rho E cos / pi with the sphere's cosine: the
// interpolated normal is off by 0.009 radians at most.
// Double-sided facets that turn away from the sun are lit where the curve over them is.
void expect_shaded_as_a_sphere(const Material& material, DiffuseTerm term,
                               double element_size = 0.5) {
  Scene scene;
  add_globe(scene, "ball", {}, material, GivenNormals::smooth);
  const Direction towards = glm::normalize(Vec3(1.0, 0.3, 0.2));
  scene.lights.push_back({.name = "sun",
                          .kind = PunctualKind::directional,
                          .intensity = Rgb(3.0),
                          .direction = -towards});
  const Camera camera = look_at({0.0, 0.0, 4.0}, Point3(0.0), 0.5);
  RenderSettings settings = size(64, 64, 1);
  settings.diffuse.term = term;
  PassOneSettings pass_one = coarse();
  pass_one.mesh.element_size = element_size;
  const Image image = picture(lit_up(scene, pass_one), camera, settings);
  int seen = 0;
  for_each_on_sphere(camera, [&](int x, int y, const Point3& hit, const Direction&) {
    // The facet is met up to 0.017 radii behind the sphere, at another place of it
    // where the ray is slanted.
    const double cosine = std::max(0.0, glm::dot(hit, towards));
    EXPECT_NEAR(image.at(x, y).g, 0.8 * 3.0 / std::numbers::pi * cosine,
                0.8 * 3.0 / std::numbers::pi * 0.03)
        << x << " " << y;
    ++seen;
  });
  EXPECT_GT(seen, 1000);
}

TEST(CurvedSurfaces, ADiffuseGlobeIsShadedAsTheSphereUpToItsTerminator) {
  expect_shaded_as_a_sphere(diffuse(0.8), DiffuseTerm::direct);
  expect_shaded_as_a_sphere(double_sided(diffuse(0.8)), DiffuseTerm::direct);
}

// Vertices of facets that are divided gather by the curve's normal: the field is that of the sphere.
TEST(CurvedSurfaces, TheFieldOfADividedGlobeIsThatOfTheSphere) {
  expect_shaded_as_a_sphere(diffuse(0.8), DiffuseTerm::interpolated, 0.05);
}

/// A closed room of E = 1 and rho = 1/2 with a globe of the same rho: L = 2 / pi everywhere.
Scene furnace_with(const Material& material, bool hollow) {
  Scene scene = furnace(0.5, {});
  Material inside = material;
  if (hollow)
    inside.double_sided = true;
  add_globe(scene, "ball", {.centre = {0.5, 0.45, 0.4}, .radius = 0.2, .hollow = hollow}, inside,
            GivenNormals::smooth);
  return scene;
}

// Whatever the normal is, light from everywhere is the same: four sigma of 256 rays would be less
// than what a facet that lost its light below the horizon would lack, 2 % at 15 degrees.
TEST(CurvedSurfaces, FurnacesStayWhite) {
  for (const bool hollow : {false, true})
    for (const DiffuseTerm term :
         {DiffuseTerm::interpolated, DiffuseTerm::direct, DiffuseTerm::gather}) {
      Material ball = diffuse(0.5, 1.0);
      const Taken scene = lit_up(furnace_with(ball, hollow), coarse());
      RenderSettings settings = size(32, 32, 4);
      settings.diffuse.term = term;
      const Image image =
          picture(scene, look_at({0.5, 0.5, 0.95}, {0.5, 0.45, 0.4}, 0.6), settings);
      for (const auto& pixel : image.pixels)
        EXPECT_NEAR(pixel.g, 2.0 / std::numbers::pi, 0.005 * 2.0 / std::numbers::pi)
            << hollow << " " << int(term);
    }
}

// A mirror and a rough white metal keep all light: the furnace is seen in them unchanged.
TEST(CurvedSurfaces, MetalsInAFurnaceAreWhite) {
  for (const double roughness : {0.0, 0.4}) {
    Material metal = mirror(1.0);
    metal.roughness = roughness;
    const Taken scene = lit_up(furnace_with(metal, false), coarse());
    const Image image =
        picture(scene, look_at({0.5, 0.5, 0.95}, {0.5, 0.45, 0.4}, 0.6), size(32, 32, 4));
    for (const auto& pixel : image.pixels)
      EXPECT_NEAR(pixel.g, 2.0 / std::numbers::pi, 0.01 * 2.0 / std::numbers::pi) << roughness;
  }
}

// Normals that are those of the faces change no bit.
TEST(CurvedSurfaces, FlatNormalsChangeNothing) {
  const auto taken = [](GivenNormals normals) {
    Scene scene = half_room();
    // Of 45 degrees from facet to facet: no curve without normals either.
    add_globe(scene, "gem",
              {.centre = {1.2, 1.1, 1.3}, .radius = 0.3, .meridians = 4, .parallels = 3},
              diffuse(0.6), normals);
    return picture(lit_up(scene, coarse()), look_at({1.8, 1.4, 2.6}, {1.0, 1.0, 1.0}, 0.9),
                   size(24, 24, 4));
  };
  EXPECT_EQ(taken(GivenNormals::none).pixels, taken(GivenNormals::flat).pixels);
}

/// The image of a number between 0 and 1: PNG stores sRGB.
float linear(double code) {
  return static_cast<float>(code <= 0.04045 ? code / 12.92
                                            : std::pow((code + 0.055) / 1.055, 2.4));
}

/// A floor under the sun whose left half is flat and whose right half leans to the right.
Scene half_leaning_floor(const Vec3& lean, const Direction& sun) {
  Image image(8, 2);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 2; ++y) {
      const Vec3 n = 0.5 * (x < 4 ? Vec3(0, 0, 1) : lean) + 0.5;
      image.at(x, y) = {linear(n.x), linear(n.y), linear(n.z)};
    }
  Material floor = diffuse(0.5);
  floor.normal_texture = TextureUse{.texture = TextureId{0}};
  Scene scene;
  scene.textures = {{.name = "map", .encoded = encode_png(image, 0.0)}};
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, floor);
  for (Vertex& v : scene.vertices)
    own_attributes(scene, v).texcoord[0] = {0.25 * v.position.x + 0.5, 0.25 * v.position.z + 0.5};
  scene.lights.push_back({.name = "sun",
                          .kind = PunctualKind::directional,
                          .intensity = Rgb(2.0),
                          .direction = -sun});
  return scene;
}

// L = rho E (n'.l) / pi at the hit, and in interpolated pictures as well, as the map's share is
// computed there. Texels are known to 1/255, and so is the direction to about 0.006.
TEST(CurvedSurfaces, NormalMapsTurnTheLightOfDiffuseSurfaces) {
  const Vec3 lean(0.6, 0.0, 0.8); // right, up and out of the image: x, -z and y of the floor
  const Direction sun = glm::normalize(Vec3(1.0, 1.5, 0.5));
  const Taken scene = lit_up(half_leaning_floor(lean, sun), coarse());
  for (const DiffuseTerm term : {DiffuseTerm::interpolated, DiffuseTerm::direct})
    for (const double x : {-1.0, 1.0}) {
      RenderSettings settings = size(1, 1, 4);
      settings.diffuse.term = term;
      const Image image = picture(scene, look_at({x, 3.0, 0.1}, {x, 0.0, 0.0}, 0.01), settings);
      const double cosine = x < 0.0 ? sun.y : lean.x * sun.x + lean.z * sun.y;
      EXPECT_NEAR(image.pixels[0].g, 0.5 * 2.0 * cosine / std::numbers::pi, 0.008) << x;
    }
}

// Tangents that are given turn the map on its surface: here its right is -z, and w is -1, so that
// its up, which would be -x, is x.
TEST(CurvedSurfaces, NormalMapsFollowTheTangents) {
  const Direction sun = glm::normalize(Vec3(1.0, 1.5, 0.5));
  for (const Vec3& lean : {Vec3(0.6, 0.0, 0.8), Vec3(0.0, 0.6, 0.8)}) {
    Scene scene = half_leaning_floor(lean, sun);
    scene.tangents.assign(4, glm::vec4(0, 0, -1, -1));
    const Taken taken = lit_up(scene, coarse());
    RenderSettings settings = size(1, 1, 4);
    settings.diffuse.term = DiffuseTerm::direct;
    const Image image = picture(taken, look_at({1.0, 3.0, 0.1}, {1.0, 0.0, 0.0}, 0.01), settings);
    const double cosine = lean.y * sun.x + lean.z * sun.y - lean.x * sun.z;
    EXPECT_NEAR(image.pixels[0].g, 0.5 * 2.0 * cosine / std::numbers::pi, 0.008) << lean.x;
  }
}

// Behind its own wall a lamp is not seen, however much the normal leans towards it.
TEST(CurvedSurfaces, NormalMapsLetNoLightThroughTheirWall) {
  Scene scene = half_leaning_floor(Vec3(0.96, 0.0, 0.28), Direction(0, 1, 0));
  scene.lights.front() = {.name = "bulb", .intensity = Rgb(1.0), .position = {2.5, -0.3, 0.0}};
  const Taken taken = lit_up(scene, coarse());
  for (const DiffuseTerm term : {DiffuseTerm::interpolated, DiffuseTerm::direct}) {
    RenderSettings settings = size(1, 1, 4);
    settings.diffuse.term = term;
    const Image image = picture(taken, look_at({1.0, 3.0, 0.1}, {1.0, 0.0, 0.0}, 0.01), settings);
    EXPECT_EQ(image.pixels[0].g, 0.0F);
  }
}

} // namespace
} // namespace meninas::test
