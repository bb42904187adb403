// The room of a page: all of the field's elements and nothing twice, its fronts outwards, its mirrors
// in runs of their own.
#include "runs/walk/walk_room.h"

#include "raytrace/two_pass.h"
#include "runs/walk/walk_page.h"
#include "scenes/errors.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

using test::half_room_with_small_mirror;

/// H at a vertex of the mesh: linear in its place, so that triangles show it exactly.
float linear(const Point3& x) { return static_cast<float>(10.0 + x.x + 2.0 * x.y - 3.0 * x.z); }

struct LitRoom {
  std::shared_ptr<const PreparedScene> prepared;
  IrradianceField field;
};

LitRoom lit_room(Scene scene) {
  PassOneSettings settings;
  settings.mesh.element_size = 0.4;
  LitRoom lit{prepare_scene(std::move(scene), settings), {}};
  for (const Point3& x : lit.prepared->mesh.vertices)
    lit.field.irradiance.emplace_back(linear(x));
  lit.field.scene = lit.prepared->light();
  return lit;
}

struct Sum {
  double area = 0.0, flux = 0.0; ///< m^2; W
};

Sum sum_of(const WalkRoom& room, const WalkBatch& batch) {
  Sum sum;
  for (std::uint32_t t = batch.first; t < batch.first + batch.count; ++t) {
    const auto at = [&](std::uint32_t k) -> const WalkVertex& {
      return room.vertices[room.indices[3 * t + k]];
    };
    const double area = 0.5 * double(glm::length(glm::cross(at(1).position - at(0).position,
                                                            at(2).position - at(0).position)));
    sum.area += area;
    sum.flux += area * double(at(0).irradiance.r + at(1).irradiance.r + at(2).irradiance.r) / 3.0;
  }
  return sum;
}

TEST(WalkRoom, HasTheAreaAndTheLightOfTheField) {
  const LitRoom lit = lit_room(half_room_with_small_mirror());
  const ElementMesh& mesh = lit.prepared->mesh;
  const WalkRoom room = walk_room(lit.field);
  double area = 0.0, flux = 0.0;
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    area += mesh.area[e];
    // The mean of a linear function is that at the centroid: over a parallelogram that of its
    // corners, over a triangle, which repeats its third, that of three.
    const ElementCorners& c = mesh.corners[e];
    if (const RegionElement* region = region_of(mesh, static_cast<ElementId>(e))) {
      flux += mesh.area[e] * double(linear(region->centroid));
      continue;
    }
    const std::size_t corners = c[3] == c[2] ? 3 : 4;
    double mean = 0.0;
    for (std::size_t k = 0; k < corners; ++k)
      mean += double(linear(mesh.vertices[index(c[k])])) / double(corners);
    flux += mesh.area[e] * mean;
  }
  Sum drawn;
  for (const WalkBatch& batch : room.batches)
    if (batch.mirror == none<MirrorId>) {
      const Sum sum = sum_of(room, batch);
      drawn.area += sum.area;
      drawn.flux += sum.flux;
    }
  // Positions and irradiances are floats.
  EXPECT_NEAR(drawn.area, area, 1e-5 * area);
  EXPECT_NEAR(drawn.flux, flux, 1e-5 * flux);
}

TEST(WalkRoom, AMirrorIsARunOfItsOwn) {
  const LitRoom lit = lit_room(half_room_with_small_mirror());
  const WalkRoom room = walk_room(lit.field);
  const Mirror& mirror = lit.prepared->plan.mirrors.mirrors.front();
  double area = 0.0;
  for (const WalkBatch& batch : room.batches)
    if (batch.mirror == MirrorId{0}) {
      area += sum_of(room, batch).area;
      EXPECT_EQ(room.looks[room.vertices[room.indices[3 * batch.first]].look].kind,
                WalkKind::mirror);
    }
  EXPECT_NEAR(area, mirror.area, 1e-5 * mirror.area);
}

TEST(WalkRoom, FrontsTurnCounterClockwise) {
  Scene scene = half_room_with_small_mirror();
  scene.materials.front().double_sided = true;
  const LitRoom lit = lit_room(std::move(scene));
  const WalkRoom room = walk_room(lit.field);
  // In a closed room every triangle that is not of the box within it faces the middle.
  const Bounds bounds = bounds_of(lit.prepared->scene);
  const glm::vec3 half(0.5 * (bounds.high - bounds.low));
  std::size_t inwards = 0, on_walls = 0;
  for (std::size_t k = 0; k < room.indices.size(); k += 3) {
    const glm::vec3 a = room.vertices[room.indices[k]].position,
                    b = room.vertices[room.indices[k + 1]].position,
                    c = room.vertices[room.indices[k + 2]].position,
                    middle = (a + b + c) / 3.0F;
    if (!glm::any(glm::greaterThan(glm::abs(middle), half - 1e-4F)))
      continue;
    ++on_walls;
    inwards += glm::dot(glm::cross(b - a, c - a), middle) < 0.0F ? 1 : 0;
  }
  EXPECT_GT(on_walls, 100U);
  EXPECT_GE(2 * inwards, on_walls) << "backs are there of double-sided walls alone";
}

TEST(WalkRoom, TrianglesOfAnElementFollowOneAnother) {
  const LitRoom lit = lit_room(half_room_with_small_mirror());
  const WalkRoom room = walk_room(lit.field);
  ASSERT_FALSE(room.element_ends.empty());
  EXPECT_TRUE(std::ranges::is_sorted(room.element_ends));
  EXPECT_EQ(room.element_ends.back(), room.indices.size() / 3);
  std::uint32_t triangles = 0;
  for (const WalkBatch& batch : room.batches) {
    EXPECT_EQ(batch.first, triangles);
    triangles += batch.count;
  }
  EXPECT_EQ(triangles, room.indices.size() / 3);
}

TEST(WalkRoom, OneThatIsTooLargeForAPageIsRefused) {
  const LitRoom lit = lit_room(half_room_with_small_mirror());
  WalkRoom room = walk_room(lit.field);
  std::vector<std::string> warnings;
  const WalkPage page{.field = lit.field, .room = room, .title = "room", .cameras = {WalkCamera{}}};
  EXPECT_NE(walk_page_html(page, warnings).find("</html>"), std::string::npos);
  EXPECT_TRUE(warnings.empty());
  room.indices.resize(3 * (max_walk_triangles + 1), 0);
  EXPECT_THROW(walk_page_html(page, warnings), InputError);
}

} // namespace
} // namespace meninas
