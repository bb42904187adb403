// Rays between the walls of closed rooms:
// none escapes, none meets a back, none meets the wall it leaves, none is blocked.
#include "scenes/rays/ray_scene.h"
#include "scenes/sampling.h"
#include "tests/support/scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace meninas {
namespace {

struct Placement {
  std::string name;
  double scale = 1.0;
  Vec3 offset{0.0};
  double turn = 0.0; ///< radians, about a skew axis
};

const std::vector<Placement> placements{
    {"plain", 1.0, Vec3(0.0), 0.0},  {"small", 1e-6, Vec3(0.0), 0.0},
    {"large", 1e6, Vec3(0.0), 0.0},  {"far", 1.0, {4e6, -3e6, 1e6}, 0.0},
    {"turned", 1.0, Vec3(0.0), 1.0}, {"small, far and turned", 1e-3, {4e3, -3e3, 1e3}, 2.0},
};

const Point3 room_size(2.0, 3.0, 4.0);

class Generator {
public:
  explicit Generator(std::uint32_t seed) : engine_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>()(engine_); }
  std::uint32_t below(std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(engine_);
  }

private:
  std::mt19937 engine_;
};

struct WallPoint {
  Point3 position;
  Direction normal;
  TriangleId triangle = none<TriangleId>;
  PlaneId plane = none<PlaneId>;
};

// Anywhere on the walls, exactly on edges and corners, and a billionth beside them
WallPoint wall_point(const Scene& scene, const SurfaceModel& surfaces, Generator& generator) {
  const auto triangle =
      TriangleId{generator.below(static_cast<std::uint32_t>(scene.triangles.size()))};
  auto a = generator.uniform();
  auto b = generator.uniform();
  if (a + b > 1.0) {
    a = 1.0 - a;
    b = 1.0 - b;
  }
  switch (generator.below(6)) {
  case 1:
    a = 0.0;
    break;
  case 2:
    a = b = 0.0;
    break;
  case 3:
    a *= 1e-9;
    break;
  case 4:
    a *= 1e-9, b *= 1e-9;
    break;
  case 5:
    b = 1.0 - a;
    break;
  default:
    break;
  }
  const auto c = corners(scene, triangle);
  return {c[0] + a * (c[1] - c[0]) + b * (c[2] - c[0]), glm::normalize(area_vector(c)), triangle,
          surfaces.plane_of_triangle[index(triangle)]};
}

Direction outgoing(const WallPoint& from, Generator& generator) {
  const auto frame = tangent_frame(from.normal);
  const auto d = Vec3(cosine_hemisphere(static_cast<float>(generator.uniform()),
                                        static_cast<float>(generator.uniform())));
  return glm::normalize(d.x * frame.tangent + d.y * frame.bitangent + d.z * from.normal);
}

class ClosedRoom : public testing::TestWithParam<std::tuple<Placement, bool>> {
protected:
  ClosedRoom() {
    const auto& [placement, double_sided] = GetParam();
    turn_ = glm::dmat3(
        glm::rotate(glm::dmat4(1.0), placement.turn, glm::normalize(Vec3(1.0, 2.0, 3.0))));
    std::array<Material, 6> walls;
    walls.fill(double_sided ? test::double_sided(test::diffuse(0.5)) : test::diffuse(0.5));
    Scene room;
    test::add_room(room, Point3(0.0), room_size, walls);
    scene_ = test::transformed(room, turn_, placement.scale, placement.offset);
    surfaces_ = find_surfaces(scene_);
  }

  // The distance to the nearest wall but the one that is left, in metres before the room was moved
  double analytic_distance(const WallPoint& from, const Direction& direction) const {
    const auto& placement = std::get<0>(GetParam());
    const auto x = glm::transpose(turn_) * ((from.position - placement.offset) / placement.scale);
    const auto d = glm::transpose(turn_) * direction;
    auto nearest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const auto wall = 2U * static_cast<std::uint32_t>(axis) + (d[axis] > 0.0 ? 1U : 0U);
      if (d[axis] == 0.0 || wall == index(from.triangle) / 2)
        continue;
      nearest = std::min(
          nearest, std::max(0.0, ((d[axis] > 0.0 ? room_size[axis] : 0.0) - x[axis]) / d[axis]));
    }
    return nearest;
  }

  glm::dmat3 turn_{1.0};
  Scene scene_;
  SurfaceModel surfaces_;
};

TEST_P(ClosedRoom, NoRayEscapesOrMeetsABackOrItsOwnWall) {
  const auto& placement = std::get<0>(GetParam());
  const auto rays = make_ray_scene(scene_, surfaces_);
  Generator generator(1);
  int wrong_distances = 0;
  for (int n = 0; n < 200'000; ++n) {
    const auto from = wall_point(scene_, surfaces_, generator);
    const auto direction = outgoing(from, generator);
    const auto hit = closest_hit(rays, {from.position, direction, from.plane});
    ASSERT_TRUE(hit) << "ray " << n;
    ASSERT_TRUE(hit->front) << "ray " << n;
    ASSERT_NE(surfaces_.plane_of_triangle[index(hit->triangle)], from.plane) << "ray " << n;
    // Rays that graze a wall beside their origin may be taken to start on it,
    // 1e-6 away at the most.
    if (std::abs(hit->distance / placement.scale - analytic_distance(from, direction)) > 1e-5)
      ++wrong_distances;
  }
  EXPECT_LE(wrong_distances, 4);
}

TEST_P(ClosedRoom, NoLegBetweenItsWallsIsBlocked) {
  const auto rays = make_ray_scene(scene_, surfaces_);
  Generator generator(2);
  for (int n = 0; n < 200'000; ++n) {
    const auto from = wall_point(scene_, surfaces_, generator);
    const auto to = wall_point(scene_, surfaces_, generator);
    if (from.plane == to.plane)
      continue;
    ASSERT_FALSE(occluded(rays, Leg{from.position, to.position, from.plane, to.plane}))
        << "leg " << n;
  }
}

TEST_P(ClosedRoom, ASquareInTheMiddleBlocksExactlyWhatCrossesIt) {
  const auto& placement = std::get<0>(GetParam());
  const auto moved = [&](Point3 x) { return placement.scale * (turn_ * x) + placement.offset; };
  const std::vector<Point3> square{{0.5, 1.5, 1}, {1.5, 1.5, 1}, {1.5, 1.5, 3}, {0.5, 1.5, 3}};
  auto scene = scene_;
  test::add_polygon(scene, "square",
                    {moved(square[0]), moved(square[1]), moved(square[2]), moved(square[3])},
                    test::diffuse(0.5));
  const auto surfaces = find_surfaces(scene);
  const auto rays = make_ray_scene(scene, surfaces);
  Generator generator(3);
  int blocked = 0;
  for (int n = 0; n < 100'000; ++n) {
    const Point3 from(2.0 * generator.uniform(), 0.0, 4.0 * generator.uniform());
    const Point3 to(2.0 * generator.uniform(), 3.0, 4.0 * generator.uniform());
    const auto crossing = 0.5 * (from + to);
    const auto margin =
        std::min({crossing.x - 0.5, 1.5 - crossing.x, crossing.z - 1.0, 3.0 - crossing.z});
    if (std::abs(margin) < 1e-5)
      continue; // floats in a frame of 4 m cannot tell
    const Leg leg{moved(from), moved(to), surfaces.plane_of_triangle[4],
                  surfaces.plane_of_triangle[6]};
    ASSERT_EQ(occluded(rays, leg), margin > 0.0) << "leg " << n;
    if (margin > 0.0)
      ++blocked;
  }
  EXPECT_GT(blocked, 10'000);
}

std::string room_name(const testing::TestParamInfo<std::tuple<Placement, bool>>& room) {
  const auto& [placement, double_sided] = room.param;
  auto name = placement.name + (double_sided ? " two sides" : " one side");
  std::erase(name, ',');
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Placements, ClosedRoom,
                         testing::Combine(testing::ValuesIn(placements), testing::Bool()),
                         room_name);

// A relief of 500,000 triangles under a lid
Scene relief() {
  Scene scene;
  scene.materials.push_back(test::diffuse(0.5));
  scene.nodes.push_back({"relief"});
  constexpr std::uint32_t cells = 500;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const auto x = static_cast<double>(i) / cells;
      const auto z = static_cast<double>(j) / cells;
      scene.vertices.push_back({{x, 0.05 * std::sin(31.0 * x) * std::cos(27.0 * z), z}, {}});
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const auto a = j * (cells + 1) + i;
      const auto b = a + cells + 1;
      scene.triangles.push_back(
          {{VertexId{a}, VertexId{b}, VertexId{b + 1}}, MaterialId{0}, NodeId{0}});
      scene.triangles.push_back(
          {{VertexId{a}, VertexId{b + 1}, VertexId{a + 1}}, MaterialId{0}, NodeId{0}});
    }
  return scene;
}

SurfaceModel one_plane_per_triangle(const Scene& scene) {
  SurfaceModel model;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto c = corners(scene, TriangleId{t});
    const auto normal = glm::normalize(area_vector(c));
    model.planes.push_back({normal, glm::dot(normal, c[0])});
    model.plane_of_triangle.push_back(PlaneId{t});
  }
  return model;
}

TEST(RaySceneBuild, HitsAreTheSameHoweverManyThreadsBuiltIt) {
  const auto scene = relief();
  const auto surfaces = one_plane_per_triangle(scene);
  const auto build = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_ray_scene(scene, surfaces);
  };
  const auto one = build(1);
  const auto two = build(2);
  Generator generator(4);
  for (int n = 0; n < 62'500; ++n) {
    RayPacket packet{};
    packet.count = packet_size;
    for (std::size_t k = 0; k < packet_size; ++k) {
      // Every fourth packet aims at vertices, where triangles tie.
      const auto snap = [&](double x) { return n % 4 == 0 ? std::round(250.0 * x) / 250.0 : x; };
      packet.origin_x[k] = static_cast<float>(snap(2.0 * generator.uniform() - 1.0));
      packet.origin_y[k] = 0.5F;
      packet.origin_z[k] = static_cast<float>(snap(2.0 * generator.uniform() - 1.0));
      packet.direction_y[k] = -1.0F;
      if (n % 2 == 1)
        packet.direction_x[k] = static_cast<float>(generator.uniform() - 0.5);
      packet.max_distance[k] = std::numeric_limits<float>::infinity();
      packet.leaving[k] = packet.arriving[k] = index(none<PlaneId>);
    }
    HitPacket a{};
    HitPacket b{};
    closest_hits(one, packet, a, Backs::absorb, Coherence::incoherent);
    closest_hits(two, packet, b, Backs::absorb, Coherence::incoherent);
    ASSERT_EQ(std::memcmp(&a, &b, sizeof(HitPacket)), 0) << "packet " << n;
  }
}

// Two sheets cross at 40 um a metre: the lift off one passes the other within 4 cm of the line where they
// cross. Behind that is another room, whose walls show their fronts and tell nothing.
TEST(CrossingSheets, NothingPassesFromRoomToRoom) {
  using namespace test;
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(scene, {-2, -2, -2}, {2, 2, 2}, walls);
  const NodeId sheet =
      add_polygon(scene, "sheet", {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}},
                  double_sided(diffuse(0.5)));
  const double slope = 4e-5;
  const NodeId tilted = add_polygon(
      scene, "tilted",
      {{-1, -1.9, -slope}, {1, -1.9, slope}, {1, 1.9, slope}, {-1, 1.9, -slope}},
      double_sided(diffuse(0.5)));
  const SurfaceModel surfaces = find_surfaces(scene);
  const RayScene rays = make_ray_scene(scene, surfaces);
  PlaneId plane = none<PlaneId>;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (scene.triangles[t].node == tilted)
      plane = surfaces.plane_of_triangle[t];
  for (const double height : {1.4e-6, 1.6e-6, 1.8e-6})
    for (const double side : {1.0, -1.0})
      for (const double y : {-1.85, -1.7, 1.72, 1.86}) {
        const Point3 x(side * height / slope, y, side * height); // on the tilted sheet, before the other
        const auto hit =
            closest_hit(rays, {x, glm::normalize(Vec3(0.2, 0.1, -side)), plane}, Backs::absorb);
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(scene.triangles[index(hit->triangle)].node, sheet) << height << " " << y;
        EXPECT_EQ(hit->front, side > 0.0) << "from its own room";
        // From the other room the sheet is before it.
        EXPECT_TRUE(occluded(rays, {{0.3, 0.2, -1.5 * side}, x, none<PlaneId>, plane}));
        EXPECT_TRUE(occluded(rays, {x, {0.3, 0.2, -1.5 * side}, plane, none<PlaneId>}));
        EXPECT_FALSE(occluded(rays, {{0.3, 0.2, 1.5 * side}, x, none<PlaneId>, plane}));
      }
  // Nearer to each other than the noise of the frame, 0.8 um, but not than the rounding of a point: no light is lost on the
  // side that a leg ends on, and a ray goes on from the sheet that it met.
  for (const double height : {0.4e-6, 0.6e-6})
    for (const double side : {1.0, -1.0})
      for (const double y : {-1.85, 1.72}) {
        const Point3 x(side * height / slope, y, side * height);
        EXPECT_FALSE(occluded(rays, {x, {0.3, 0.2, 1.5 * side}, plane, none<PlaneId>})) << height;
        EXPECT_FALSE(occluded(rays, {{0.3, 0.2, 1.5 * side}, x, none<PlaneId>, plane})) << height;
        const auto hit = closest_hit(rays, {x, glm::normalize(Vec3(0.2, 0.1, side)), plane}, Backs::absorb);
        ASSERT_TRUE(hit.has_value());
        EXPECT_NE(scene.triangles[index(hit->triangle)].node, sheet) << height;
      }
}

} // namespace
} // namespace meninas
