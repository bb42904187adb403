// Rays that are traced once and looked at twice tell what all rays traced at once do.
#include "radiosity/light/row_cache.h"
#include "radiosity/field/vertex_light.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

constexpr int first_rays = 128, many_rays = 512;

/// A room with a mirror, whose elements reflect more the further on they are.
struct Room {
  std::unique_ptr<LitScene> l = [] {
    Scene scene;
    const Material wall = diffuse(0.5);
    add_room(scene, Point3(0.0), Point3(1.0), {wall, mirror(0.9), wall, wall, wall, wall});
    return lit(std::move(scene), {.element_size = 0.25});
  }();
  std::vector<Rgb> reflected = [this] {
    std::vector<Rgb> values;
    for (std::size_t e = 0; e < element_count(l->mesh); ++e)
      values.emplace_back(0.1 + double(e % 7));
    return values;
  }();
  PointGathering few{*l->light, reflected, {}, {}, {.rays = first_rays}},
      many{*l->light, reflected, {}, {}, {.rays = many_rays, .rays_before = first_rays}};
  Receiver point = [this] {
    const MeshSide& side =
        l->mesh.sides[index(l->mesh.side_of_element[elements_of(*l, "y0").front()])];
    return Receiver{Point3(0.3, 0.0, 0.4), side.normal, side.plane_class, side.tangent};
  }();
};

// Landings carry floats, of which 512 are added in another order.
constexpr double of_floats = 1e-5;

TEST(RowCache, AreTheBeginningOfMore) {
  const HemisphereSamples all = make_direction_net(many_rays), first = make_direction_net(first_rays),
                     others = make_direction_net(many_rays, first_rays);
  EXPECT_EQ(others.first, static_cast<std::uint32_t>(first_rays));
  auto together = first.points, expected = all.points;
  together.insert(together.end(), others.points.begin(), others.points.end());
  std::ranges::sort(together);
  std::ranges::sort(expected);
  EXPECT_EQ(together, expected);
}

TEST(RowCache, TellWhatAllTell) {
  const Room room;
  PointWorkspace work;
  const PointLight at_once = indirect_light_at(room.many, room.point, 3, work);
  const std::uint64_t traced_at_once = work.rays;
  indirect_light_at(room.few, room.point, 3, work);
  const GatheredRays kept = work.gather.result;
  work.rays = 0;
  const PointLight in_two = indirect_light_at(room.many, room.point, 3, work, &kept);
  EXPECT_LT(work.rays, traced_at_once - first_rays + 1);
  EXPECT_NEAR(in_two.indirect().total.g, at_once.indirect().total.g,
              of_floats * at_once.indirect().total.g);
  EXPECT_NEAR(in_two.indirect().mirrored.g, at_once.indirect().mirrored.g,
              of_floats * at_once.indirect().total.g);
  EXPECT_GT(in_two.indirect().mirrored.g, 0.0);
  EXPECT_DOUBLE_EQ(work.gather.result.rays, double(many_rays));
}

// From other radiosities, with no ray traced.
TEST(RowCache, AreLookedAtAnew) {
  const Room room;
  PointWorkspace work;
  VertexRays kept;
  const std::vector<Rgb> lit(room.reflected.size(), Rgb(1.0));
  indirect_value_at(room.few, lit, {room.point, 0.25, 3}, work, &kept);
  std::vector<Rgb> doubled = room.reflected;
  for (Rgb& value : doubled)
    value *= 2.0;
  const PointGathering other(*room.l->light, doubled, {}, {}, {.rays = first_rays});
  const double expected =
      indirect_value_at(other, lit, {room.point, 0.25, 3}, work).indirect.total.g;
  work.rays = 0;
  const VertexValue again = indirect_value_at(other, lit, {room.point, 0.25, 3}, work, &kept);
  EXPECT_EQ(work.rays, 0U);
  EXPECT_NEAR(again.indirect.total.g, expected, of_floats * expected);
  EXPECT_EQ(again.clearance, Clearance::open);
}

TEST(RowCache, AreOfTheFirstThatAsk) {
  RowCache kept;
  const std::uint32_t as_many = max_cached_rays / first_rays;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < as_many + 10; ++v)
    vertices.push_back(3 * v);
  kept.make_room(std::span(vertices).first(100), first_rays);
  kept.make_room(vertices, first_rays);
  EXPECT_NE(kept.of(0), nullptr);
  EXPECT_EQ(kept.of(1), nullptr);
  EXPECT_NE(kept.of(vertices[as_many - 1]), nullptr);
  EXPECT_EQ(kept.of(vertices[as_many]), nullptr);
  EXPECT_NE(kept.of(vertices[0]), kept.of(vertices[1]));
}

} // namespace
} // namespace meninas::test
