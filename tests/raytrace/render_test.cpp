#include "raytrace/two_pass.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

TwoPassSettings quick(int width, int height, int samples) {
  TwoPassSettings settings;
  settings.pass_one.mesh.target_elements = 600;
  settings.pass_one.form_factors.rays = 128;
  settings.pass_one.interpolation.rays = 128;
  settings.render.width = width;
  settings.render.height = height;
  settings.render.samples = samples;
  return settings;
}

Image picture_of(const Scene& scene, const TwoPassSettings& settings) {
  const auto prepared = prepare_scene(scene, settings.pass_one);
  return two_pass(*prepared, scene.cameras.at(0), settings).rendering.image;
}

Camera orthographic(Camera camera, double half_height) {
  camera.projection = Projection::orthographic;
  camera.half_height = half_height;
  return camera;
}

/// A square of side two about the z axis at height z, its front towards +z or -z.
std::vector<Point3> square(double z, double front) {
  if (front > 0.0) return {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  return {{-1, 1, z}, {1, 1, z}, {1, -1, z}, {-1, -1, z}};
}

/// Single precision carries a radiance through a few operations to this relative error.
constexpr double rounding = 1e-5;

TEST(Render, AnEmitterHasItsOwnRadianceInEveryPixel) {
  Scene scene;
  add_polygon(scene, "lamp", square(0.0, 1.0), diffuse(0.0, 3.0 * std::numbers::pi));
  scene.cameras.push_back(look_at({0.1, 0.2, 2.0}, {0.1, 0.2, 0.0}, 0.3));
  const Image image = picture_of(scene, quick(33, 17, 4));
  for (const auto& pixel : image.pixels) EXPECT_NEAR(pixel.g, 3.0, 3.0 * rounding);
}

// A field owns the scene and the mesh on which it is, whether that is the solved one or was divided for the field; so it is
// drawn to the same bits when whoever prepared the scene has gone. With a dangling mesh this reads freed memory.
TEST(Render, AFieldOutlivesWhoPreparedItsScene) {
  const Scene scene = half_room_with_small_mirror();
  const Camera camera = look_at({1.7, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0);
  const TwoPassSettings settings = quick(24, 16, 4);
  for (const double bound : {0.0, 0.02}) {
    PassOneSettings pass_one = settings.pass_one;
    pass_one.interpolation.bend = bound;
    auto prepared = prepare_scene(scene, pass_one);
    const std::weak_ptr<const PreparedScene> watched = prepared;
    IrradianceField field = solve_pass_one(prepared->light(), pass_one).field;
    const Image before = render(field, camera, settings.render).image;
    prepared.reset();
    ASSERT_FALSE(watched.expired()) << "the field keeps it";
    EXPECT_EQ(render(field, camera, settings.render).image.pixels, before.pixels);
    field = {};
    EXPECT_TRUE(watched.expired()) << "and nothing else does";
  }
}

TEST(Render, OrthographicRaysAreParallel) {
  // The lamp covers -1 .. 1 of a picture that shows -2 .. 2: a quarter of it, at whatever distance.
  for (const double distance : {1.0, 50.0}) {
    Scene scene;
    add_polygon(scene, "lamp", square(0.0, 1.0), diffuse(0.0, std::numbers::pi));
    scene.cameras.push_back(orthographic(look_at({0, 0, distance}, {0, 0, 0}, 0.5), 2.0));
    const Image image = picture_of(scene, quick(16, 16, 16));
    double sum = 0.0;
    for (const auto& pixel : image.pixels) sum += pixel.r;
    EXPECT_NEAR(sum / 256.0, 0.25, rounding);
    EXPECT_EQ(image.at(0, 0), glm::vec3(0.0F));
    EXPECT_NEAR(image.at(8, 8).r, 1.0, rounding);
  }
}

TEST(Render, CameraRaysPassThroughBacks) {
  Scene scene;
  add_polygon(scene, "lamp", square(0.0, 1.0), diffuse(0.0, std::numbers::pi));
  add_polygon(scene, "back", square(1.0, -1.0), diffuse(0.5));
  scene.cameras.push_back(look_at({0, 0, 3}, {0, 0, 0}, 0.2));
  EXPECT_NEAR(picture_of(scene, quick(8, 8, 4)).at(4, 4).r, 1.0, rounding);
  scene.materials[1].double_sided = true;
  EXPECT_LT(picture_of(scene, quick(8, 8, 4)).at(4, 4).r, 0.5);
}

/// A camera that looks straight into a mirror at z = 0, a lamp behind it.
Scene mirror_and_lamp(Rgb reflectance) {
  Scene scene;
  Material glass = mirror(1.0);
  glass.base_color = reflectance;
  add_polygon(scene, "mirror", square(0.0, 1.0), glass);
  add_polygon(scene, "lamp", square(4.0, -1.0), diffuse(0.0, std::numbers::pi));
  scene.cameras.push_back(look_at({0, 0, 2}, {0, 0, 0}, 0.1));
  return scene;
}

TEST(Render, TheMirrorImageOfALampIsAsBrightAsItsReflectance) {
  const Image image = picture_of(mirror_and_lamp({0.9, 0.5, 0.25}), quick(8, 8, 4));
  EXPECT_NEAR(image.at(3, 4).r, 0.9, rounding);
  EXPECT_NEAR(image.at(3, 4).g, 0.5, rounding);
  EXPECT_NEAR(image.at(3, 4).b, 0.25, rounding);
}

TEST(Render, MirrorsAreBlackInRadiosityMode) {
  auto settings = quick(8, 8, 4);
  settings.render.mode = RenderMode::radiosity;
  for (const auto& pixel : picture_of(mirror_and_lamp(Rgb(0.9)), settings).pixels) EXPECT_EQ(pixel, glm::vec3(0.0F));
}

TEST(Render, TheKthImageBetweenFacingMirrorsIsRhoToTheKth) {
  // Between mirrors at z = 0 and z = 1 a path at slope s climbs s per leg,
  // so that pixel rows see the lamp, which spans 0.25 of height on the far wall x = 2,
  // after a number of reflections that follows from the straight line of the unfolded path.
  constexpr double rho = 0.8;
  Scene scene;
  add_polygon(scene, "low", {{-4, -50, 0}, {4, -50, 0}, {4, 50, 0}, {-4, 50, 0}}, mirror(rho));
  add_polygon(scene, "high", {{-4, 50, 1}, {4, 50, 1}, {4, -50, 1}, {-4, -50, 1}}, mirror(rho));
  add_polygon(scene, "wall", {{-4, 20, 0}, {4, 20, 0}, {4, 20, 1}, {-4, 20, 1}}, diffuse(0.0, std::numbers::pi));
  const Point3 eye{0, 0, 0.5};
  for (int k = 0; k <= 6; ++k) {
    // The k-th image of the wall is centred k heights up.
    scene.cameras = {look_at(eye, {0.0, 20.0, 0.5 + k}, 0.001)};
    scene.cameras[0].up = glm::normalize(glm::cross(scene.cameras[0].forward, Vec3(-1, 0, 0)));
    scene.cameras[0].right = glm::cross(scene.cameras[0].forward, scene.cameras[0].up);
    const Image image = picture_of(scene, quick(3, 3, 4));
    EXPECT_NEAR(image.at(1, 1).r, std::pow(rho, k), 1e-4 * std::pow(rho, k)) << k;
  }
}

TEST(Render, OnePixelAndOddSizes) {
  for (const auto& [width, height] : {std::pair{1, 1}, {33, 17}, {2, 65}}) {
    const Image image = picture_of(mirror_and_lamp(Rgb(0.5)), quick(width, height, 1));
    EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(width * height));
    for (const auto& pixel : image.pixels) EXPECT_TRUE(std::isfinite(pixel.r));
  }
}

/// A room with a mirror on one side, a lamp, a box, and a camera inside.
Scene mirror_room() {
  Scene scene;
  add_room(scene, {0, 0, 0}, {3, 2.5, 4},
           {mirror(0.9), diffuse({0.6, 0.2, 0.2}, Rgb(0.0)), diffuse(0.5), diffuse(0.7), diffuse({0.2, 0.5, 0.3}, Rgb(0.0)), diffuse(0.6)});
  add_box(scene, "box", {1.2, 0.0, 1.0}, {2.0, 0.9, 1.7}, diffuse(0.4));
  add_polygon(scene, "lamp", {{1, 2.4, 1.5}, {2, 2.4, 1.5}, {2, 2.4, 2.5}, {1, 2.4, 2.5}}, diffuse(0.0, 20.0));
  scene.cameras.push_back(look_at({2.3, 1.3, 3.6}, {1.0, 1.0, 0.5}, 1.1));
  return scene;
}

TEST(Render, TheSameBitsForOneThreadAndTwoAndAgain) {
  const auto settings = quick(48, 40, 16);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return picture_of(mirror_room(), settings);
  };
  const Image one = with_threads(1), two = with_threads(2), again = with_threads(2);
  EXPECT_TRUE(one.pixels == two.pixels);
  EXPECT_TRUE(two.pixels == again.pixels);
}

/// Share of pixels that differ by more than `part` of the larger value.
double moved_pixels(const Image& a, const Image& b, double part = 0.01) {
  std::size_t moved = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    for (int band = 0; band < 3; ++band) {
      const double larger = std::max(a.pixels[k][band], b.pixels[k][band]);
      if (std::abs(a.pixels[k][band] - b.pixels[k][band]) > part * larger) {
        ++moved;
        break;
      }
    }
  return double(moved) / double(a.pixels.size());
}

TEST(Render, ScaleAndPlaceDoNotMatter) {
  // The frame of the rays is scaled and centred with the scene;
  // what is left is rounding, which moves no pixel by a hundredth except
  // where one of its samples lies within rounding of an edge: none here.
  const Scene scene = mirror_room();
  const auto settings = quick(48, 40, 16);
  const Image image = picture_of(scene, settings);
  for (const double scale : {1e-4, 1e4})
    EXPECT_EQ(moved_pixels(image, picture_of(transformed(scene, glm::dmat3(1.0), scale, Vec3(0.0)), settings)), 0.0) << scale;
  EXPECT_EQ(moved_pixels(image, picture_of(transformed(scene, glm::dmat3(1.0), 1.0, Vec3(3e4, -4e4, 2e4)), settings)), 0.0);
}

TEST(Render, ARotatedSceneGivesTheSamePicture) {
  // The tangent frames turn with the surfaces' coordinates, not with the scene: other gather rays,
  // so the noise of 2048 of them (half a per cent at a vertex) is what may differ.
  // Three of its standard deviations leave a few pixels in a thousand.
  auto settings = quick(48, 40, 16);
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 2048;
  settings.pass_one.direct.penumbra_rays = 1024;
  const Scene scene = mirror_room();
  const double c = std::cos(0.7), s = std::sin(0.7);
  const glm::dmat3 rotation = glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1) * glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c);
  const Image image = picture_of(scene, settings), turned = picture_of(transformed(scene, rotation, 1.0, Vec3(0.0)), settings);
  EXPECT_LT(moved_pixels(image, turned, 0.015), 0.01);
}

// Inside of the box it is dark: its inner sides have no elements, the floor under it is covered,
// and the outer sides of the room see nothing. So the same elements are lit by the same rays.
// The bottom of the box is left out: only double-sided ones are known to see nothing.
TEST(Render, ADoubleSidedRoomLooksLikeASingleSidedOne) {
  Scene scene = half_room();
  std::erase_if(scene.triangles, [&](const Triangle& triangle) {
    return scene.nodes[index(triangle.node)].name == "box.y0";
  });
  scene.cameras = {look_at({1.6, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0)};
  const Image once = picture_of(scene, quick(64, 48, 4));
  for (Material& material : scene.materials)
    material.double_sided = !is_emitter(material) && !is_mirror(material);
  EXPECT_EQ(moved_pixels(once, picture_of(scene, quick(64, 48, 4)), 1e-4), 0.0);
}

TEST(Render, AMirrorRoomLooksLikeTheDoubledRoom) {
  // The image room is meshed and sampled on its own, so that pictures differ by the noise of both:
  // 3 sigma of 1024 rays at a vertex are about two per cent. Silhouettes and the edge
  // of the mirror differ by the rounding of where they fall within a pixel.
  auto settings = quick(64, 48, 16);
  settings.pass_one.mesh.element_size = 0.2;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 1024;
  settings.pass_one.direct.penumbra_rays = 1024;
  Scene half = half_room();
  half.cameras = {look_at({1.6, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0)};
  Scene whole = doubled(half);
  whole.cameras = half.cameras;
  for (const DiffuseTerm term : {DiffuseTerm::interpolated, DiffuseTerm::direct}) {
    settings.render.diffuse.term = term;
    const Image mirrored = picture_of(half, settings), unfolded = picture_of(whole, settings);
    EXPECT_LT(moved_pixels(mirrored, unfolded, 0.02), 0.02) << static_cast<int>(term);
  }
}

} // namespace
} // namespace meninas::test
