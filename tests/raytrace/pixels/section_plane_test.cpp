#include "raytrace/pixels/section_plane.h"
#include "raytrace/views/sight.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

/// A tunnel 2 m x 2 m from z = 0 to 3, walls that glow each in its own way and reflect nothing.
/// Its front at z = 3 is open without a material.
Scene tunnel(std::optional<Material> front) {
  const auto glowing = [](double e) { return diffuse(0.0, e); };
  Scene scene;
  add_room(scene, {-1, -1, 0}, {1, 1, 3},
           {glowing(1.0), glowing(2.0), glowing(3.0), glowing(4.0), glowing(5.0),
            front.value_or(glowing(0.0))});
  if (!front)
    std::erase_if(scene.triangles, [&](const Triangle& triangle) {
      return scene.nodes[index(triangle.node)].name == "z1";
    });
  return scene;
}

/// From three metres before the front.
Camera eye(double half_height_at_one) {
  return look_at({0, 0, 6}, Point3(0.0), 2.0 * std::atan(half_height_at_one));
}

double section_of(const Scene& scene, Camera camera, double znear, double aspect = 1.0) {
  camera.znear = znear;
  return with_section(scene, camera, aspect).section;
}

constexpr double hair = 2e-5 * 1.5; // of half of the tunnel's length

TEST(SectionPlane, IsThereWhereItCutsSomething) {
  const Scene closed = tunnel(double_sided(diffuse(0.0, 6.0)));
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = eye(0.1);
    camera.projection = projection;
    camera.half_height = 0.5;
    EXPECT_EQ(section_of(closed, camera, 0.0), 0.0) << "no znear";
    EXPECT_EQ(section_of(closed, camera, 2.999), 0.0);
    EXPECT_EQ(section_of(closed, camera, 3.0), 0.0) << "in the plane is not nearer";
    EXPECT_NEAR(section_of(closed, camera, 3.001), 3.001 + hair, 1e-12);
    EXPECT_EQ(section_of(tunnel(diffuse(0.0, 6.0)), camera, 3.5), 0.0) << "backs are looked through";
    EXPECT_EQ(section_of(tunnel(std::nullopt), camera, 3.5), 0.0);
    camera.forward = -camera.forward;
    camera.right = -camera.right;
    EXPECT_EQ(section_of(closed, camera, 30.0), 0.0) << "all is behind";
  }
}

TEST(SectionPlane, OfWhatThePictureShows) {
  // The side walls begin at x = 1, three metres away: in pictures over 3.3 times as wide as high.
  const Scene open = tunnel(std::nullopt);
  EXPECT_EQ(section_of(open, eye(0.1), 3.001, 3.3), 0.0);
  EXPECT_GT(section_of(open, eye(0.1), 3.001, 3.4), 0.0);
  EXPECT_GT(section_of(open, eye(0.1), 3.5, 3.0), 0.0) << "at 3.5 m they are in a narrower one";
}

RenderSettings square_picture() {
  RenderSettings settings;
  settings.width = settings.height = 48;
  return settings;
}

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.5;
  settings.form_factors.rays = settings.interpolation.rays = 16;
  return settings;
}

TEST(SectionPlane, ShowsTheRoomBehindTheWallThatIsCutAway) {
  const Scene open = tunnel(std::nullopt), closed = tunnel(double_sided(diffuse(0.0, 6.0)));
  Camera camera = eye(0.25); // at 3.5 m the side walls are not in the picture yet
  const Taken lit_open = lit_up(open, coarse()), lit_closed = lit_up(closed, coarse());
  const auto shown = [&](const Taken& lit, const Camera& from) {
    return picture(lit, from, square_picture());
  };
  const Image truth = shown(lit_open, camera), whole = shown(lit_closed, camera);
  EXPECT_GT(change_inside(truth, whole, {}).beyond_a_hundredth, 2000U) << "a wall hides it";
  camera.znear = 3.5;
  const Camera cutting = with_section(closed, camera, 1.0);
  const PictureChange change =
      change_inside(truth, shown(lit_closed, cutting), edges(open, camera, square_picture()));
  EXPECT_GT(change.pixels, 1500U);
  EXPECT_LT(change.worst, 1e-6) << "rounding of floats: all is emission of a wall";
}

TEST(SectionPlane, MirrorsShowWhatIsCutAway) {
  Scene scene = tunnel(double_sided(diffuse(0.0, 6.0)));
  add_polygon(scene, "mirror", {{-1, -1, 0.1}, {1, -1, 0.1}, {1, 1, 0.1}, {-1, 1, 0.1}},
              mirror(0.5));
  Camera camera = eye(1e-3);
  camera.znear = 3.5;
  camera = with_section(scene, camera, 1.0);
  ASSERT_GT(camera.section, 0.0);
  const Taken lit = lit_up(scene, coarse());
  const Image image = picture(lit, camera, square_picture());
  // L = rho E / pi of the front, from the inside; floats.
  EXPECT_NEAR(image.at(24, 24).g, 0.5 * 6.0 / 3.14159265358979, 1e-5);
  const Sight sight = look(*lit.prepared->light(), camera, 1.0, {0.5, 0.5}, 0);
  EXPECT_NEAR(sight.position.z, 0.1, 1e-6);
}

} // namespace
} // namespace meninas::test
