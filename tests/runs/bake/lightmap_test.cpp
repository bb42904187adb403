// Lightmaps: filtering between their texels is the field, up to every edge; nothing is shared between
// charts, and nothing beyond one is ever looked up.
#include "runs/bake/lightmap.h"

#include "image/image_file.h"
#include "raytrace/two_pass.h"
#include "scenes/errors.h"
#include "tests/support/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace meninas {
namespace {

using FieldValue = std::function<float(const Point3&)>;

float linear(const Point3& x) { return static_cast<float>(10.0 + x.x + 2.0 * x.y - 3.0 * x.z); }
float bent(const Point3& x) { return static_cast<float>(3.0 + std::sin(7.0 * x.x) + std::cos(5.0 * x.z + x.y)); }

struct BakedRoom {
  std::shared_ptr<const PreparedScene> prepared;
  IrradianceField field;
  std::vector<gltf::PlacedPrimitive> primitives;
  FileCharts charts;
  LightmapLayout layout;
  Lightmap map;
};

/// As a file would have it: a primitive to each node.
std::vector<gltf::PlacedPrimitive> primitives_of(const Scene& scene) {
  std::vector<gltf::PlacedPrimitive> all(scene.nodes.size());
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    all[n].node = NodeId{n};
    for (const Vertex& vertex : scene.vertices)
      all[n].positions.push_back(vertex.position);
  }
  for (const Triangle& triangle : scene.triangles)
    all[index(triangle.node)].triangles.push_back(
        {index(triangle.vertices[0]), index(triangle.vertices[1]), index(triangle.vertices[2])});
  return all;
}

BakedRoom baked(Scene scene, const FieldValue& value, int size = 2048) {
  PassOneSettings settings;
  settings.mesh.element_size = 0.4;
  BakedRoom room;
  room.primitives = primitives_of(scene);
  room.prepared = prepare_scene(std::move(scene), settings);
  for (const Point3& x : room.prepared->mesh.vertices)
    room.field.irradiance.emplace_back(value(x));
  room.field.scene = room.prepared->light();
  room.charts = find_charts(room.field, room.primitives);
  room.layout = lay_out(room.charts.charts, room.prepared->mesh.element_size, size);
  room.map = fill_lightmap(room.field, room.field, room.charts.charts, room.layout, WithShown::yes);
  return room;
}

/// What a graphics card shows at (u, v), without coarser levels.
float filtered(const Image& image, glm::vec2 uv) {
  const glm::vec2 at = uv * glm::vec2(image.width, image.height) - 0.5F;
  const glm::vec2 low = glm::floor(at), share = at - low;
  float sum = 0.0F;
  for (int dy = 0; dy <= 1; ++dy)
    for (int dx = 0; dx <= 1; ++dx) {
      const float weight = (dx == 1 ? share.x : 1.0F - share.x) * (dy == 1 ? share.y : 1.0F - share.y);
      const int x = std::clamp(int(low.x) + dx, 0, image.width - 1), y = std::clamp(int(low.y) + dy, 0, image.height - 1);
      if (weight > 0.0F)
        sum += weight * image.at(x, y).r;
    }
  return sum;
}

/// Calls visit(texture coordinates, point, chart) all over the triangles, their edges and corners among it.
template <typename Visit>
void each_point(const BakedRoom& room, Visit visit) {
  constexpr int steps = 7;
  for (std::size_t p = 0; p < room.primitives.size(); ++p)
    for (std::size_t t = 0; t < room.primitives[p].triangles.size(); ++t) {
      const auto& points = room.charts.corners[p][t];
      if (points[0].chart == no_chart)
        continue;
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
          const std::array<float, 3> weights{1.0F - float(i + j) / steps, float(i) / steps, float(j) / steps};
          glm::vec2 uv(0.0F);
          Point3 x(0.0);
          for (std::size_t k = 0; k < 3; ++k) {
            uv += weights[k] * texcoord_of(room.layout, points[k]);
            x += double(weights[k]) * room.primitives[p].positions[room.primitives[p].triangles[t][k]];
          }
          visit(uv, x, points[0].chart);
        }
    }
}

/// A room with a floor of two boards side by side and a triangle on the wall.
Scene floor_of_two_boards() {
  Scene scene;
  test::add_room(scene, Point3(0.0), {2.0, 2.0, 2.0},
                 {test::diffuse(0.5), test::diffuse(0.5), test::diffuse(0.5), test::diffuse(0.5, 1.0),
                  test::diffuse(0.5), test::diffuse(0.5)});
  std::erase_if(scene.triangles, [](const Triangle& t) { return t.node == NodeId{2}; });
  const Material wood = test::diffuse(0.4);
  const NodeId left = test::add_polygon(scene, "left", {{0, 0, 2}, {0.7, 0, 2}, {0.7, 0, 0}, {0, 0, 0}}, wood);
  const NodeId right = test::add_polygon(scene, "right", {{0.7, 0, 2}, {2, 0, 2}, {2, 0, 0}, {0.7, 0, 0}}, wood);
  MaterialId material = none<MaterialId>;
  for (Triangle& triangle : scene.triangles) {
    if (triangle.node == left)
      material = triangle.material;
    if (triangle.node == right)
      triangle.material = material;
  }
  test::add_polygon(scene, "flag", {{0.2, 0.5, 0.3}, {1.7, 0.6, 0.3}, {0.9, 1.6, 0.3}}, wood);
  return scene;
}

/// A disc of slivers, which the solver has triangulated anew.
Scene room_with_disc() {
  Scene scene = floor_of_two_boards();
  std::vector<Point3> rim;
  for (int k = 0; k < 96; ++k) {
    const double angle = std::numbers::pi / 48.0 * k;
    rim.push_back({1.0 + 0.7 * std::cos(angle), 0.4, 1.0 - 0.7 * std::sin(angle)});
  }
  test::add_polygon(scene, "disc", rim, test::diffuse(0.6));
  return scene;
}

// Texture coordinates are floats: of some thousand texels a side they are off by 1e-4 texels at most.
constexpr float rounding = 2e-4F;

TEST(Lightmap, ALinearFieldIsExactEverywhere) {
  for (const Scene& scene : {test::half_room_with_small_mirror(), floor_of_two_boards(), room_with_disc()}) {
    const BakedRoom room = baked(scene, linear);
    std::size_t points = 0;
    each_point(room, [&](glm::vec2 uv, const Point3& x, std::uint32_t) {
      ++points;
      EXPECT_NEAR(filtered(room.map.irradiance, uv), linear(x), rounding * 16.0F) << x.x << ' ' << x.y << ' ' << x.z;
    });
    EXPECT_GT(points, 500U);
  }
}

// Bilinear between the corners of quads: filtering is the interpolation itself.
TEST(Lightmap, FilteringIsTheInterpolationOfTheField) {
  const BakedRoom room = baked(floor_of_two_boards(), bent);
  each_point(room, [&](glm::vec2 uv, const Point3& x, std::uint32_t c) {
    const Chart& chart = room.charts.charts[c];
    if (chart.triangle)
      return;
    const SurfaceModel& surfaces = room.prepared->surfaces;
    const PatchId patch = surfaces.patch_of_triangle[index(chart.triangles.front())];
    const SideId side = room.prepared->mesh.sides_of_patch[index(patch)][0];
    const float field =
        irradiance_at(room.prepared->mesh, room.field, side, uv_at(surfaces.patches[index(patch)], x)).r;
    EXPECT_NEAR(filtered(room.map.irradiance, uv), field, rounding * 5.0F);
  });
}

TEST(Lightmap, WhatTheSolverTriangulatesAnewIsLitByTheFilesOwnTriangles) {
  const BakedRoom room = baked(room_with_disc(), linear);
  const auto& disc = room.charts.corners.back();
  ASSERT_EQ(disc.size(), 94U);
  std::size_t faces = 0;
  for (const auto& corners : disc) {
    ASSERT_NE(corners[0].chart, no_chart);
    faces += room.charts.charts[corners[0].chart].face ? 1 : 0;
  }
  EXPECT_GT(faces, 47U) << "most of its slivers are no patches";
}

TEST(Lightmap, HasNoSeamBetweenPatchesOfASurface) {
  const BakedRoom room = baked(floor_of_two_boards(), bent);
  // Points of the common edge of the boards, by both charts.
  std::map<int, std::vector<float>> shown;
  each_point(room, [&](glm::vec2 uv, const Point3& x, std::uint32_t) {
    if (std::abs(x.x - 0.7) < 1e-6 && x.y == 0.0)
      shown[int(std::lround(x.z * 1e4))].push_back(filtered(room.map.irradiance, uv));
  });
  std::size_t pairs = 0;
  for (const auto& [place, values] : shown)
    for (const float value : values) {
      ++pairs;
      EXPECT_NEAR(value, values.front(), rounding * 5.0F) << place;
    }
  EXPECT_GE(pairs, 16U);
}

TEST(Lightmap, NothingBeyondAChartIsEverLookedUp) {
  const BakedRoom room = baked(test::half_room_with_small_mirror(), bent);
  // All but what charts have between their first and last texels, and their gutters.
  std::vector<bool> inside(room.map.irradiance.pixels.size(), false);
  const auto width = std::size_t(room.layout.width);
  for (std::size_t c = 0; c < room.charts.charts.size(); ++c) {
    const auto& [first, n] = room.layout.charts[c];
    for (int y = first.y; y <= first.y + n.y; ++y)
      for (int x = first.x; x <= first.x + n.x; ++x)
        inside[std::size_t(y) * width + std::size_t(x)] = true;
  }
  Image spoiled = room.map.irradiance;
  for (std::size_t k = 0; k < spoiled.pixels.size(); ++k)
    if (!inside[k])
      spoiled.pixels[k] = glm::vec3(100.0F);
  // A gutter may be looked up as much as coordinates are rounded.
  each_point(room, [&](glm::vec2 uv, const Point3&, std::uint32_t) {
    EXPECT_NEAR(filtered(spoiled, uv), filtered(room.map.irradiance, uv), rounding * 100.0F);
  });
}

// Dark for x < 1: as below something that stands on the floor.
TEST(Lightmap, HasNoDarkEdgeAlongWhatStandsOnAFace) {
  const auto half_covered = [](const Point3& x) { return x.y == 0.0 && x.x < 1.0 ? 0.0F : 5.0F; };
  const BakedRoom room = baked(test::furnace(0.5, {}, Point3(2.0)), half_covered);
  std::size_t points = 0;
  each_point(room, [&](glm::vec2 uv, const Point3& x, std::uint32_t) {
    if (x.y == 0.0 && x.x >= 1.0) {
      ++points;
      EXPECT_NEAR(filtered(room.map.irradiance, uv), 5.0F, 1e-3F) << x.x << ' ' << x.z;
    }
  });
  EXPECT_GT(points, 20U);
}

/// No texel twice: those of charts with gutters, single ones and the dark one.
void expect_apart(const std::vector<Chart>& charts, const LightmapLayout& layout) {
  std::set<std::pair<int, int>> taken{{layout.dark.x, layout.dark.y}};
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const auto& [first, n] = layout.charts[c];
    const int gutter = n.x > 0 ? lightmap_gutter : 0;
    for (int y = first.y - gutter; y <= first.y + n.y + gutter; ++y)
      for (int x = first.x - gutter; x <= first.x + n.x + gutter; ++x) {
        EXPECT_TRUE(taken.emplace(x, y).second) << x << ' ' << y;
        EXPECT_TRUE(x >= 0 && y >= 0 && x < layout.width && y < layout.height);
      }
  }
}

std::vector<Chart> many_charts() {
  std::vector<Chart> charts;
  for (int k = 0; k < 300; ++k)
    charts.push_back({.triangles = {}, .triangle = k % 3 == 0, .roots = {1 + k % 7, 1 + (k % 3 == 0 ? k : k / 2) % 7},
                      .level = k % 4, .length = 0.01 * (1 + k)});
  return charts;
}

TEST(LightmapLayout, ChartsAreApartAtEverySize) {
  const std::vector<Chart> charts = many_charts();
  int before = 1000;
  for (const int size : {1000, 300, 128, 60, 25, 20}) {
    const LightmapLayout layout = lay_out(charts, 0.5, size);
    EXPECT_LE(layout.width, size);
    EXPECT_LE(layout.height, size);
    EXPECT_LE(layout.detail, before);
    before = layout.detail;
    expect_apart(charts, layout);
  }
  EXPECT_LT(before, 0) << "in the smallest some faces have one texel";
}

TEST(LightmapLayout, TakesTheSmallestMapThatHoldsAllDetail) {
  const LightmapLayout layout = lay_out(many_charts(), 0.5, 4096);
  EXPECT_EQ(layout.detail, layout.full_detail);
  EXPECT_LT(layout.width, 4096);
  EXPECT_EQ(layout.single, 0U);
  // Nothing but the charts with their gutters is asked for, and a packing wastes less than three quarters.
  double texels = 0.0;
  for (const ChartTexels& chart : layout.charts)
    texels += double(chart.intervals.x + 3) * (chart.intervals.y + 3);
  EXPECT_LT(double(layout.width) * layout.width, 4.0 * 2.0 * texels);
}

TEST(LightmapLayout, ChartsOfOneSurfaceMeetInTheSameTexels) {
  // Charts with the same roots along an edge, one of them far longer, in a surface of one level.
  std::vector<Chart> charts = many_charts();
  for (const int size : {2000, 200, 100}) {
    charts[0].roots = {5, 2};
    charts[1].roots = {5, 40};
    charts[0].level = charts[1].level = 3;
    charts[0].triangle = charts[1].triangle = false;
    charts[0].length = charts[1].length = 20.0;
    const LightmapLayout layout = lay_out(charts, 0.5, size);
    EXPECT_EQ(layout.charts[0].intervals.x, layout.charts[1].intervals.x);
  }
}

TEST(LightmapLayout, RefusesAMapWithFewerTexelsThanFaces) {
  try {
    lay_out(many_charts(), 0.5, 16);
    FAIL() << "300 faces do not fit into 256 texels";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("16 is too small for 300 faces"));
  }
}

TEST(Lightmap, EightBitsKeepTheMean) {
  Lightmap map;
  map.factor = 255.0;
  map.irradiance = Image(64, 64);
  for (glm::vec3& pixel : map.irradiance.pixels)
    pixel = glm::vec3(3.4F, 0.0F, 300.0F);
  const Bitmap read = decode_image(irradiance_png(map), Encoding::srgb, "lightmap");
  glm::vec4 sum(0.0F);
  for (const glm::vec4& pixel : read.pixels)
    sum += 255.0F / 4096.0F * pixel;
  // Of N texels the share that is rounded up is off by about log N / N.
  EXPECT_NEAR(sum.r, 3.4F, 0.01F);
  EXPECT_EQ(sum.g, 0.0F);
  EXPECT_NEAR(sum.b, 255.0F, 1e-3F);
}

} // namespace
} // namespace meninas
