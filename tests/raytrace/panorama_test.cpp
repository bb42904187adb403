// Panoramas: everything that is seen from one place, in one picture.
#include "image/image_file.h"
#include "raytrace/pixels/camera_rays.h"
#include "raytrace/pixels/section_plane.h"
#include "raytrace/views/sight.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr std::array panoramas{Projection::equirectangular, Projection::cube};

Camera around(Projection projection, Point3 eye, Point3 target) {
  Camera camera = look_at(eye, target, 1.0);
  camera.projection = projection;
  return camera;
}

RenderSettings size_of(Projection projection, int rows, int samples = 16) {
  RenderSettings settings;
  settings.height = rows;
  settings.width = (projection == Projection::cube ? 6 : 2) * rows;
  settings.samples = samples;
  return settings;
}

PassOneSettings coarse(double element_size = 0.5, int rays = 64) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  return settings;
}

// Everything in there is as bright: L = E / (pi (1 - rho)).
TEST(Panorama, OfAFurnaceIsEven) {
  const Taken lit = lit_up(furnace(0.5, {true, false, false, false, false, true}), coarse());
  for (const Projection projection : panoramas) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::gaussian}) {
      RenderSettings settings = size_of(projection, 24);
      settings.filter = filter;
      settings.min_throughput = 1e-6; // mirrors of reflectance one end rays by nothing else
      const Image image = picture(lit, around(projection, {0.3, 0.6, 0.4}, {1, 0, 0}), settings);
      for (const auto& pixel : image.pixels)
        ASSERT_NEAR(pixel.g, 2.0 / std::numbers::pi, 2e-3) << "to the error of the solver and floats";
    }
  }
}

/// Where a direction is seen, by the definition of the projection; in widths and heights.
Vec2 place_of_direction(const Camera& camera, const Direction& w) {
  const double r = glm::dot(w, camera.right), u = glm::dot(w, camera.up),
               f = glm::dot(w, camera.forward);
  return {0.5 + std::atan2(r, f) / (2.0 * std::numbers::pi), 0.5 - std::asin(u) / std::numbers::pi};
}

// A lamp that is small as a pixel is seen in the pixel of its direction, and nowhere else.
TEST(Panorama, AKnownDirectionLandsOnAKnownPixel) {
  const Point3 eye{0.2, 0.1, -0.3};
  for (const Direction w : {Direction(0.6, 0.48, 0.64), Direction(-0.36, -0.48, 0.8),
                            Direction(0.0, -0.8, -0.6), Direction(-0.8, 0.6, 0.0)}) {
    Scene scene;
    const TangentFrame frame = tangent_frame(-w);
    const Vec3 a = 0.004 * frame.tangent, b = 0.004 * frame.bitangent;
    const Point3 at = eye + w;
    add_polygon(scene, "lamp", {at - a - b, at + a - b, at + a + b, at - a + b},
                diffuse(0.0, std::numbers::pi));
    const Camera camera = around(Projection::equirectangular, eye, eye + Vec3(0.2, 0.1, -1.0));
    const RenderSettings settings = size_of(Projection::equirectangular, 64, 256);
    const Image image = picture(lit_up(scene, coarse()), camera, settings);
    const Vec2 place = place_of_direction(camera, w) * Vec2(image.width, image.height);
    Vec2 seen(0.0);
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        seen += double{image.at(x, y).g} * Vec2(x + 0.5, y + 0.5);
        sum += image.at(x, y).g;
        const bool dark = image.at(x, y).g == 0.0F;
        EXPECT_TRUE(dark || glm::distance(place, Vec2(x + 0.5, y + 0.5)) < 1.6) << x << ' ' << y;
      }
    ASSERT_GT(sum, 0.0);
    // The pixels' own middles stand for what is anywhere in them.
    EXPECT_LT(glm::distance(seen / sum, place), 0.75);
  }
}

// The rays of pass two are those of camera_ray(), to the precision of floats.
TEST(Panorama, RaysOfPacketsAreThoseOfTheCamera) {
  const RayFrame frame{.centre = {1.0, 2.0, 3.0}, .scale = 0.25};
  for (const Projection projection : panoramas) {
    const Camera camera = around(projection, {1.5, 1.0, 2.0}, {-1.0, 2.0, 0.5});
    const CameraFrame rays = make_camera_frame(camera, 2.0, frame);
    EXPECT_FALSE(is_affine(rays));
    std::array<float, packet_size> x{}, y{};
    for (std::size_t k = 0; k < packet_size; ++k) {
      x[k] = (static_cast<float>(k) + 0.25F) / packet_size;
      y[k] = (static_cast<float>(7 * k % packet_size) + 0.5F) / packet_size;
    }
    RayPacket packet;
    set_panorama_rays(packet, rays, x, y, x);
    for (std::size_t k = 0; k < packet_size; ++k) {
      const CameraRay exact = camera_ray(camera, 2.0, x[k], y[k]);
      const Vec3 d(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
      EXPECT_LT(glm::distance(glm::normalize(d), exact.direction), 2e-6);
      const Vec3 o(packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]);
      EXPECT_LT(glm::distance(o, (exact.origin - frame.centre) * frame.scale), 1e-6);
    }
  }
}

// a A / abs(d)^3 (camera_rays.h) against the solid angle of a pixel, which is what is between its
// corners' directions. It is what textures are averaged over.
TEST(Panorama, TheLengthOfADirectionTellsTheSolidAngleOfItsPixel) {
  for (const Projection projection : panoramas) {
    const Camera camera = around(projection, Point3(0.0), {0.3, -0.2, 1.0});
    const CameraFrame rays = make_camera_frame(camera, 1.0, {.centre = Point3(0.0), .scale = 1.0});
    const double width = projection == Projection::cube ? 768.0 : 256.0, height = 128.0;
    for (const auto& [px, py] : {std::pair(3, 64), std::pair(100, 5), std::pair(200, 110), std::pair(130, 90)}) {
      const double x = (px + 0.5) / width, y = (py + 0.5) / height;
      std::array<float, packet_size> xs{}, ys{};
      xs.fill(static_cast<float>(x));
      ys.fill(static_cast<float>(y));
      RayPacket packet;
      set_panorama_rays(packet, rays, xs, ys, xs);
      const double length =
          glm::length(Vec3(packet.direction_x[0], packet.direction_y[0], packet.direction_z[0]));
      const double stated = glm::length(rays.direction_x) * glm::length(rays.direction_y) /
                            (width * height * length * length * length);
      // By differences of directions across a small part of the pixel.
      const double hx = 0.01 / width, hy = 0.01 / height;
      const auto along = [&](double u, double v) { return camera_ray(camera, 1.0, u, v).direction; };
      const Vec3 by_x = (along(x + hx, y) - along(x - hx, y)) / (2.0 * hx * width),
                 by_y = (along(x, y + hy) - along(x, y - hy)) / (2.0 * hy * height);
      const double exact = glm::length(glm::cross(by_x, by_y));
      EXPECT_NEAR(stated, exact, 1e-4 * exact) << px << ' ' << py;
    }
  }
}

// By way of a mirror one sees the doubled room, from wherever one looks.
TEST(Panorama, WithAMirrorIsThatOfTheDoubledRoom) {
  const Scene half = half_room_with_small_mirror();
  PassOneSettings settings = coarse(0.25, 4096); // as of other pictures of images: pictures_test.cpp
  settings.direct.shadow_rays = 64;
  settings.direct.penumbra_rays = 1024;
  settings.interpolation.cluster_shadow_rays = 16;
  const Taken with_mirror = lit_up(half, settings), without = lit_up(doubled(half), settings);
  for (const Projection projection : panoramas) {
    const Camera camera = around(projection, {1.4, 1.3, 2.2}, {0.0, 1.2, 1.0});
    const RenderSettings size = size_of(projection, 96);
    const PictureChange change = change_inside(picture(without, camera, size),
                                               picture(with_mirror, camera, size),
                                               edges(half, camera, size));
    EXPECT_GT(change.pixels, size.width * size.height * 7U / 10U);
    EXPECT_LE(change.beyond_a_hundredth, change.pixels / 1000U) << "at the foot of the box";
    EXPECT_LT(change.rms, 0.002);
  }
}

// Where textures are finer than pixels they are their means, of the right size in all directions.
TEST(Panorama, TexturesAreAveragedOverPixels) {
  Image chequer(256, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      chequer.at(x, y) = glm::vec3((x / 2 + y / 2) % 2 == 0 ? 1.0F : 0.0F);
  Scene scene;
  scene.textures = {{.name = "chequer", .encoded = encode_png(chequer, 0.0)}};
  scene.background = Rgb(1.0);
  Material paint = diffuse(0.8);
  paint.base_color_texture = TextureUse{.texture = TextureId{0}};
  add_polygon(scene, "floor", {{-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}}, paint);
  for (Vertex& vertex : scene.vertices)
    own_attributes(scene, vertex).texcoord[0] =
        glm::vec2(vertex.position.x, vertex.position.z) / 16.0F + 0.5F;
  const Taken lit = lit_up(scene, coarse(4.0));
  for (const Projection projection : panoramas) {
    // A square is 12 cm; a pixel below the eye 60 cm and more.
    const Camera camera = around(projection, {0.03, 5.0, 0.02}, {0.03, 5.0, -1.0});
    const RenderSettings settings = size_of(projection, 16, 1);
    const Image image = picture(lit, camera, settings);
    int seen = 0;
    // The row around the pole is drawn out, one sample does not stand for a pixel of it.
    const int rows = projection == Projection::equirectangular ? image.height - 1 : image.height;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Sight at = look(*lit.prepared->light(), camera, 2.0,
                              {(x + 0.5) / image.width, (y + 0.5) / image.height}, 0);
        const bool whole = at.triangle != none<TriangleId> && std::abs(at.position.x) < 5.0 &&
                           std::abs(at.position.z) < 5.0;
        if (!whole)
          continue;
        ++seen;
        EXPECT_NEAR(image.at(x, y).g, 0.4, 0.06) << x << ' ' << y << " of a chequer of 0 and 0.8";
      }
    EXPECT_GT(seen, 30);
  }
}

TEST(Panorama, IsNotCutByZnearAndAdaptsItsSamples) {
  const Scene scene = half_room();
  for (const Projection projection : panoramas) {
    Camera camera = around(projection, {1.0, 1.3, 2.2}, {0.0, 1.2, 1.0});
    camera.znear = 5.0;
    EXPECT_EQ(with_section(scene, camera, 2.0).section, 0.0);
    RenderSettings settings = size_of(projection, 32, 64);
    settings.pixel_error = 0.02;
    const Taken lit = lit_up(scene, coarse());
    const Rendering adaptive = render(lit.solution.field, camera, settings);
    EXPECT_LT(adaptive.camera_rays, std::uint64_t(settings.width * settings.height * 32));
    settings.pixel_error = 0.0;
    const Image all = picture(lit, camera, settings);
    EXPECT_LT(change_inside(all, adaptive.image, edges(scene, camera, settings)).rms, 0.02)
        << "what is asked for";
  }
}

} // namespace
} // namespace meninas::test
