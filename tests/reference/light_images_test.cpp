// Punctual lights are all asked for, whichever is the strongest,
// and thinned out without bias where they are too many.
#include "image/image_file.h"
#include "reference/light_images.h"
#include "scenes/ies/intensity_distribution.h"
#include "tests/reference/tracing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using std::numbers::pi;

/// So dark that what a floor sends to walls and mirrors does not come back.
constexpr double rho = 1e-6;

PunctualLight bulb(const Point3& position, const Rgb& intensity) {
  return {
      .name = "bulb", .kind = PunctualKind::point, .intensity = intensity, .position = position};
}

/// The irradiance of a point of the ground, by way of nothing.
Rgb irradiance(const PunctualLight& bulb, const Point3& x) {
  const Vec3 leg = bulb.position - x;
  return bulb.intensity * (leg.y / std::pow(glm::dot(leg, leg), 1.5));
}

TEST(LightImages, AWeakLampIsSeenBesideASunThatDoesNotComeIn) {
  Scene scene;
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, diffuse(rho));
  add_polygon(scene, "roof", {{-9, 3, -9}, {9, 3, -9}, {9, 3, 9}, {-9, 3, 9}}, diffuse(0.0));
  PunctualLight sun{.name = "sun", .kind = PunctualKind::directional, .intensity = Rgb(1000.0)};
  sun.direction = {0, -1, 0};
  scene.lights = {sun, bulb({1, 2, 0}, {0.03, 0.02, 0.01})};
  // If one of the two were chosen by its power, the lamp would be met one time in ten thousand.
  const MeanRadiance seen = radiance_seen(scene, {2, 1, 1}, Point3(0.0), 32);
  expect_radiance(seen, irradiance(scene.lights[1], Point3(0.0)) * (rho / pi), 1e-5);
}

TEST(LightImages, OfMoreThanCanBeAskedForTheMeanIsThatOfAll) {
  Scene scene;
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, diffuse(rho));
  add_polygon(scene, "mirror", {{-9, 3, -9}, {9, 3, -9}, {9, 3, 9}, {-9, 3, 9}}, mirror(0.8));
  Rgb sum(0.0);
  // Lights at 1500 places, their colours and heights in no order, and their images.
  for (int k = 0; k < 1500; ++k) {
    const double a = std::fmod(k * 0.618, 1.0), b = std::fmod(k * 0.755, 1.0),
                 c = std::fmod(k * 0.57, 1.0);
    const PunctualLight light =
        bulb({4.0 * a - 2.0, 0.5 + 2.0 * b, 4.0 * c - 2.0}, Rgb(1.0 + b, 1.0, 2.0 * a));
    PunctualLight image = light;
    image.position.y = 6.0 - image.position.y;
    sum += irradiance(light, Point3(0.0)) + 0.8 * irradiance(image, Point3(0.0));
    scene.lights.push_back(light);
  }
  ASSERT_GT(2 * scene.lights.size(), reference::max_images);
  expect_radiance(radiance_seen(scene, {2, 1, 1}, Point3(0.0), 64), sum * (rho / pi));
}

// A wall that its texture makes a mirror on the left and matt on the right:
// what the mirror throws on the floor is that of the image behind it.
TEST(LightImages, AreSeenInWhatTexelsMakeAMirror) {
  Scene scene;
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, 0}, {-9, 0, 0}}, diffuse(rho));
  Material wall = mirror(0.8);
  wall.roughness = 1.0;
  wall.metallic_roughness_texture = TextureUse{.texture = TextureId{0}};
  add_polygon(scene, "wall", {{-2, 0, 0}, {2, 0, 0}, {2, 3, 0}, {-2, 3, 0}}, wall);
  for (Vertex& vertex : scene.vertices)
    own_attributes(scene, vertex).texcoord[0] = glm::vec2((vertex.position.x + 2.0) / 4.0, 0.5);
  Image image(2, 1);
  image.at(0, 0) = glm::vec3(0, 0, 1); // roughness 0, metal
  image.at(1, 0) = glm::vec3(0, 1, 1);
  scene.textures = {{.name = "halves",
                     .encoded = encode_png(image, 0.0),
                     .wrap_u = Wrap::clamp,
                     .wrap_v = Wrap::clamp,
                     .magnified = TexelFilter::nearest}};
  PunctualLight spot = bulb({-1, 2, 2}, Rgb(4.0));
  spot.kind = PunctualKind::spot;
  spot.direction = glm::normalize(Vec3(0, -1, -2));
  spot.inner_cone = 0.2;
  spot.outer_cone = 0.25;
  scene.lights = {spot};
  const PunctualLight seen = bulb({-1, 2, -2}, Rgb(4.0));
  const Point3 x(-1, 0, 2);
  expect_radiance(radiance_seen(scene, {0, 1, 3}, x, 64), 0.8 * irradiance(seen, x) * (rho / pi));
}

// A luminaire that shines up alone, 3 W/sr along its axis and linear to none at a right angle to it:
// the floor has the light of its image, which shines down.
TEST(LightImages, TheDistributionOfALuminaireIsReflected) {
  Scene scene;
  add_polygon(scene, "floor", {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, diffuse(rho));
  add_polygon(scene, "mirror", {{-9, 3, -9}, {9, 3, -9}, {9, 3, 9}, {-9, 3, 9}}, mirror(0.8));
  PunctualLight up = bulb({1, 2, 0}, Rgb(1.0));
  up.distribution = std::make_shared<const IntensityDistribution>(IntensityDistribution{
      .vertical = {0.0, 90.0}, .horizontal = {0.0}, .candela = {3.0, 0.0}});
  up.frame = glm::dmat3(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0)); // its -Z is +Y
  scene.lights = {up};
  const double off_axis = std::atan2(1.0, 4.0) / (pi / 2.0);
  const Rgb expected = 0.8 * irradiance(bulb({1, 4, 0}, Rgb(3.0 * (1.0 - off_axis))), Point3(0.0));
  expect_radiance(radiance_seen(scene, {2, 1, 1}, Point3(0.0), 64), expected * (rho / pi));
}

/// A corner of two perfect mirrors, with a bulb and a spot in it.
Scene corner_of_mirrors() {
  Scene scene;
  const auto wall = diffuse(0.3), glass = mirror(1.0);
  add_polygon(scene, "floor", {{0, 0, 2}, {2, 0, 2}, {2, 0, 0}, {0, 0, 0}}, wall);
  add_polygon(scene, "roof", {{0, 2, 0}, {2, 2, 0}, {2, 2, 2}, {0, 2, 2}}, wall);
  add_polygon(scene, "x", {{2, 0, 0}, {2, 0, 2}, {2, 2, 2}, {2, 2, 0}}, wall);
  add_polygon(scene, "z", {{0, 0, 2}, {0, 2, 2}, {2, 2, 2}, {2, 0, 2}}, wall);
  add_polygon(scene, "mirror x", {{0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2}}, glass);
  add_polygon(scene, "mirror z", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, glass);
  add_box(scene, "box", {0.9, 0.0, 0.9}, {1.2, 0.5, 1.2}, wall);
  PunctualLight spot = bulb({1.5, 1.5, 1.5}, Rgb(4.0, 3.0, 2.0));
  spot.kind = PunctualKind::spot;
  spot.direction = glm::normalize(Vec3(-1.0, -0.5, -0.8));
  spot.outer_cone = 0.3;
  scene.lights = {bulb({0.4, 1.2, 0.7}, Rgb(1.0)), spot};
  return scene;
}

/// What the corner and its three images hold, without the mirrors.
Scene opened(Scene scene) {
  const auto is_mirror = [&](const Triangle& t) {
    return scene.materials[index(t.material)].metallic > 0.0;
  };
  std::erase_if(scene.triangles, is_mirror);
  for (const int axis : {0, 2}) {
    const Scene half = scene;
    const auto vertices = static_cast<std::uint32_t>(half.vertices.size());
    for (Vertex vertex : half.vertices) {
      vertex.position[axis] *= -1.0;
      scene.vertices.push_back(vertex);
    }
    for (Triangle triangle : half.triangles) {
      std::swap(triangle.vertices[1], triangle.vertices[2]);
      for (VertexId& vertex : triangle.vertices)
        vertex = VertexId{index(vertex) + vertices};
      scene.triangles.push_back(triangle);
    }
    for (PunctualLight light : half.lights) {
      light.position[axis] *= -1.0;
      light.direction[axis] *= -1.0;
      scene.lights.push_back(light);
    }
  }
  return scene;
}

TEST(LightImages, ACornerOfMirrorsIsTheRoomFourTimesOver) {
  const Scene corner = corner_of_mirrors();
  const Camera camera = look_at({1.8, 1.4, 1.8}, {0.8, 0.2, 0.8}, 0.9);
  const MeanRadiance a = mean_radiance(traced_picture(corner, camera, tracing(12, 12, 256))),
                     b = mean_radiance(
                         traced_picture(opened(corner), camera, tracing(12, 12, 256)));
  for (int band = 0; band < 3; ++band) {
    const double error = std::hypot(a.error[band], b.error[band]);
    EXPECT_LT(error, 0.01 * a.mean[band]) << "too noisy to tell";
    EXPECT_NEAR(a.mean[band], b.mean[band], 4.0 * error) << band;
  }
}

} // namespace
} // namespace meninas::test
