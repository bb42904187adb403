#include "raytrace/views/debug_view.h"
#include "raytrace/views/sight.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <set>

namespace meninas::test {
namespace {

/// Facing mirrors at z = 0 and 1, a wall at the end.
Scene tower() {
  Scene scene;
  add_polygon(scene, "low", {{-4, -50, 0}, {4, -50, 0}, {4, 50, 0}, {-4, 50, 0}}, mirror(0.8));
  add_polygon(scene, "high", {{-4, 50, 1}, {4, 50, 1}, {4, -50, 1}, {-4, -50, 1}}, mirror(0.8));
  add_polygon(scene, "wall", {{-4, 20, 0}, {4, 20, 0}, {4, 20, 1}, {-4, 20, 1}}, diffuse(0.5, 1.0));
  return scene;
}

PaintedView painted(DebugView view, const Taken& lit, const Camera& camera, RenderMode mode) {
  RenderSettings settings;
  settings.width = 16;
  settings.height = 12;
  settings.mode = mode;
  const auto& light = *lit.prepared->light();
  const std::vector<RowClosure> rows = assemble_transport(light, {.rays = 64}).closure;
  return paint_view(view, lit.solution.field, rows, camera, settings);
}

Taken quick(const Scene& scene) {
  PassOneSettings settings;
  settings.mesh.target_elements = 200;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  return lit_up(scene, settings);
}

TEST(DebugView, MirrorDepthCountsMirrors) {
  const Taken lit = quick(tower());
  for (int k = 0; k <= 3; ++k) {
    const Camera camera = look_at({0, 0, 0.5}, {1e-3, 20.0, 0.5 + k}, 1e-4);
    const PaintedView view = painted(DebugView::mirror_depth, lit, camera, RenderMode::hybrid);
    EXPECT_EQ(view.values.at(8, 6), static_cast<float>(k));
    EXPECT_GE(view.top, k);
  }
}

TEST(DebugView, ElementsHaveColoursOfTheirOwnAlsoInMirrors) {
  const Taken lit = quick(tower());
  const auto numbers = [&](RenderMode mode, double up) {
    const PaintedView view =
        painted(DebugView::elements, lit, look_at({0, 0, 0.5}, {1e-3, 20.0, 0.5 + up}, 0.04), mode);
    std::set<float> found;
    std::set<std::array<float, 3>> colours;
    for (std::size_t p = 0; p < view.values.values.size(); ++p) {
      const glm::vec3& c = view.colours.pixels[p];
      found.insert(view.values.values[p]);
      colours.insert({c.r, c.g, c.b});
      EXPECT_EQ(c == glm::vec3(0.0F), view.values.values[p] == 0.0F);
    }
    EXPECT_EQ(found.size(), colours.size());
    return found;
  };
  const auto straight = numbers(RenderMode::hybrid, 0.0);
  EXPECT_GT(straight.size(), 3U);
  EXPECT_GT(numbers(RenderMode::hybrid, 1.0).size(), 3U);
  EXPECT_EQ(numbers(RenderMode::radiosity, 1.0), std::set<float>{0.0F}) << "mirrors are black";
}

TEST(DebugView, RowsCloseAndIrradianceIsTheFields) {
  const Scene scene = furnace(0.5, {});
  const Taken lit = quick(scene);
  const Camera camera = look_at({0.5, 0.5, 0.9}, {0.5, 0.5, 0.0}, 1.0);
  const PaintedView closure = painted(DebugView::closure, lit, camera, RenderMode::hybrid);
  for (const float value : closure.values.values)
    EXPECT_LT(value, 1e-6F);
  // H = B = E / (1 - rho).
  const PaintedView light = painted(DebugView::irradiance, lit, camera, RenderMode::hybrid);
  for (const float value : light.values.values)
    EXPECT_NEAR(value, 2.0F, 1e-3F);
  EXPECT_GE(light.top, 1.99);
}

TEST(DebugView, LooksThroughTheEdgeOfTwoPanes) {
  Scene scene;
  add_polygon(scene, "left", {{-1, 0, 1}, {0, 0, 0}, {0, 2, 0}, {-1, 2, 1}}, glass(Rgb(1.0)));
  add_polygon(scene, "right", {{0, 0, 0}, {1, 0, 1}, {1, 2, 1}, {0, 2, 0}}, glass(Rgb(1.0)));
  add_polygon(scene, "wall", {{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}},
              diffuse(0.5, 1.0));
  const Taken lit = quick(scene);
  // As exactly through it as rounding allows, where both panes are met at one point.
  for (int k = 0; k < 2000; ++k) {
    const double t = 1e-3 * k;
    const Point3 eyes[] = {{t - 1.0, 0.7 * t, 1.0 + t}, {0.0, t, 0.0}, {1e-3 * t, 1.0, 0.5 + t}};
    for (const Point3& eye : eyes) {
      const Camera camera = look_at(eye, {0.0, 0.1 + 0.9 * t, eye.z == 0.0 ? -1.0 : 0.0}, 0.1);
      const Sight sight = look(*lit.prepared->light(), camera, 1.0, {0.5, 0.5}, 3);
      ASSERT_NEAR(sight.position.z, -1.0, 1e-6) << eye.x << ' ' << eye.y << ' ' << eye.z;
    }
  }
}

} // namespace
} // namespace meninas::test
