#include "mirror/region_images.h"
#include "tests/mirror/glowing_room.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

constexpr double hit_error = 1e-9;

/// A cell of a wall of the room, and points in it.
struct Cell {
  std::array<Point3, 4> corners;
  Direction normal;

  Point3 at(double s, double t) const {
    return glm::mix(glm::mix(corners[0], corners[1], s), glm::mix(corners[3], corners[2], s), t);
  }
};

/// Cell (i, j) of n x n of a wall: 0 and 1 are x = low and x = high, and so on.
Cell cell_of(const Vec3& size, int wall, int i, int j, int n) {
  const int axis = wall / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  Cell cell;
  for (std::size_t c = 0; c < 4; ++c) {
    Point3& corner = cell.corners[c];
    corner[axis] = wall % 2 == 0 ? 0.0 : size[axis];
    corner[u] = size[u] * (i + (c == 1 || c == 2 ? 1.0 : 0.0)) / n;
    corner[v] = size[v] * (j + (c >= 2 ? 1.0 : 0.0)) / n;
  }
  cell.normal = Direction(0.0);
  cell.normal[axis] = wall % 2 == 0 ? 1.0 : -1.0;
  return cell;
}

/// How many images are seen whole, in part and not at all, over all cells.
struct Counts {
  std::size_t whole = 0, part = 0, none = 0;
};

void expect_same_lights(const GlowingRoom& room, const Cell& cell, const RegionImages& images,
                        Random& random) {
  SeenWorlds seen;
  std::vector<VirtualLight> expected, found;
  for (int k = 0; k < 12; ++k) {
    // Corners and edges too.
    const auto place = [&] { return std::clamp(random.between(-0.3, 1.3), 0.0, 1.0); };
    const double s = place(), t = place();
    const Observer observer{cell.at(s, t), cell.normal, hit_error};
    virtual_lights(room.worlds, room.emitters, observer.position, observer.normal,
                   observer.tolerance, expected);
    lights_in_region(room.worlds, room.emitters, images, observer, seen, found);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t l = 0; l < found.size(); ++l) {
      EXPECT_EQ(found[l].emitter, expected[l].emitter);
      EXPECT_EQ(found[l].world, expected[l].world);
      EXPECT_EQ(found[l].normal, expected[l].normal);
      EXPECT_EQ(found[l].weight, expected[l].weight);
      EXPECT_TRUE(std::ranges::equal(found[l].polygon.span(), expected[l].polygon.span()));
    }
  }
}

Counts expect_same_lights_everywhere(const GlowingRoom& room, const Vec3& size, int cells) {
  Random random(11);
  Counts counts;
  RegionImages images;
  for (int wall = 0; wall < 6; ++wall)
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const Cell cell = cell_of(size, wall, i, j, cells);
        images_of_region(room.worlds, room.emitters, {cell.corners, cell.normal, hit_error},
                         images);
        const auto whole =
            static_cast<std::size_t>(std::ranges::count(images.images, true, &RegionImage::whole));
        counts.whole += whole;
        counts.part += images.images.size() - whole;
        counts.none += room.worlds.worlds.size() * room.emitters.size() - images.images.size();
        expect_same_lights(room, cell, images, random);
      }
  return counts;
}

const Vec3 room_size(1.0, 1.5, 2.0);
constexpr int cells = 5;

// What cells say is what their points see, to the bit: the same lights in the same order.
TEST(RegionImages, AreThoseOfTheirPointsWithoutMirrors) {
  const Counts counts =
      expect_same_lights_everywhere(glowing(room_with_mirrors({}), {}), room_size, cells);
  EXPECT_GT(counts.whole, 0U);
}
TEST(RegionImages, AreThoseOfTheirPointsInACornerOfThreeMirrors) {
  const GlowingRoom room = glowing(room_with_mirrors({true, false, true, false, true, false}), {});
  const Counts counts = expect_same_lights_everywhere(room, room_size, cells);
  EXPECT_GT(counts.part, 0U);
  EXPECT_GT(counts.none, 0U);
}
TEST(RegionImages, AreThoseOfTheirPointsBetweenFacingMirrors) {
  const WorldSettings deep{.min_throughput = 0.0, .max_depth = 8, .max_worlds = 100};
  const GlowingRoom room = glowing(room_with_mirrors({true, true}), deep);
  const Counts counts = expect_same_lights_everywhere(room, room_size, cells);
  EXPECT_GT(counts.part, 0U);
  EXPECT_GT(counts.none, 0U);
}
// Walls run on behind the plane of the wedge.
TEST(RegionImages, AreThoseOfTheirPointsBesideAWedge) {
  const Counts counts =
      expect_same_lights_everywhere(glowing(room_with_wedge(), {}), room_size, cells);
  EXPECT_GT(counts.part, 0U);
}

/// The room with a lamp before the wall z = 0 in the place of all that glows.
GlowingRoom with_lamp(GlowingRoom room, double size) {
  const Point3 corner(0.4, 0.8, 0.05);
  const Vec3 x(size, 0.0, 0.0), y(0.0, size, 0.0);
  Emitter& lamp = room.emitters.front();
  lamp.corners = {corner, corner + x, corner + x + y, corner + y};
  lamp.plane = {.normal = {0.0, 0.0, 1.0}, .offset = corner.z};
  room.emitters.resize(1);
  return room;
}

// Of a lamp most images are decided for whole cells: that is what they are for.
TEST(RegionImages, DecideMostImagesOfALamp) {
  const WorldSettings deep{.min_throughput = 0.0, .max_depth = 8, .max_worlds = 100};
  const GlowingRoom room = with_lamp(glowing(room_with_mirrors({true, true}), deep), 0.2);
  const Counts counts = expect_same_lights_everywhere(room, room_size, cells);
  EXPECT_GT(counts.whole, 2 * counts.part);
  EXPECT_GT(counts.none, 0U);
}

TEST(RegionImages, AreThoseOfTheirPointsBesideAMirrorInAWall) {
  const Counts counts =
      expect_same_lights_everywhere(glowing(room_with_mirror_in_wall(), {}), room_size, cells);
  EXPECT_GT(counts.whole, 0U);
  EXPECT_GT(counts.part, 0U);
  EXPECT_GT(counts.none, 0U);
}

/// Two mirrors in the shape of an L, whose windows have several parts, on opposite walls.
Scene room_with_angled_mirrors() {
  Scene scene = room_with_mirrors({});
  const auto add = [&](double x, bool forward) {
    const auto piece = [&](const char* name, double y0, double z0, double y1, double z1) {
      std::vector<Point3> corners{{x, y0, z1}, {x, y0, z0}, {x, y1, z0}, {x, y1, z1}};
      if (!forward)
        std::ranges::reverse(corners);
      add_polygon(scene, name, corners, mirror(0.9));
    };
    piece("foot", 0.2, 0.2, 0.5, 1.8);
    piece("stem", 0.5, 0.2, 1.3, 0.6);
  };
  add(0.02, true);
  add(0.98, false);
  return scene;
}

TEST(RegionImages, AreThoseOfTheirPointsBetweenWindowsOfSeveralParts) {
  const WorldSettings deep{.min_throughput = 0.0, .max_depth = 4, .max_worlds = 100};
  const GlowingRoom room = glowing(room_with_angled_mirrors(), deep);
  ASSERT_TRUE(std::ranges::any_of(room.worlds.worlds,
                                  [](const MirrorWorld& w) { return w.window.size() > 1; }));
  const Counts counts = expect_same_lights_everywhere(room, room_size, cells);
  EXPECT_GT(counts.whole, 0U);
  EXPECT_GT(counts.part, 0U);
  EXPECT_GT(counts.none, 0U);
}

// An image in part, by way of one that is seen whole: what opens the way is cut all the same.
TEST(RegionImages, AreThoseOfTheirPointsOfALampBetweenWindowsOfSeveralParts) {
  const WorldSettings deep{.min_throughput = 0.0, .max_depth = 4, .max_worlds = 100};
  const GlowingRoom room = with_lamp(glowing(room_with_angled_mirrors(), deep), 0.02);
  const Counts counts = expect_same_lights_everywhere(room, room_size, 12);
  EXPECT_GT(counts.whole, 0U);
  EXPECT_GT(counts.part, 0U);
  EXPECT_GT(counts.none, 0U);
}

// A lamp behind a mirror has its image before it, where no line by way of the mirror comes to.
TEST(RegionImages, LeaveOutWhatIsBehindTheMirror) {
  GlowingRoom room = with_lamp(glowing(room_with_mirrors({true}), {}), 0.02);
  Emitter& lamp = room.emitters.front();
  for (std::size_t k = 0; k < lamp.corners.size(); ++k)
    lamp.corners[k].x = -0.2;
  for (std::size_t k = 0; k < lamp.corners.size(); ++k)
    lamp.corners[k].z = 1.0 + (k == 1 || k == 2 ? 0.02 : 0.0);
  lamp.plane = {.normal = {-1.0, 0.0, 0.0}, .offset = 0.2};
  const Cell cell = cell_of(room_size, 1, 2, 2, cells);
  RegionImages images;
  images_of_region(room.worlds, room.emitters, {cell.corners, cell.normal, hit_error}, images);
  EXPECT_TRUE(images.images.empty());
}

/// An orthonormal frame, by two random directions.
glm::dmat3 random_rotation(Random& random) {
  const Direction x = random.direction();
  const Direction z = glm::normalize(glm::cross(x, random.direction()));
  return {x, glm::cross(z, x), z};
}

// Where a mirror touches the plane of another with a corner its window is cut there,
// and an edge is left that is as long as rounding makes it and points anywhere.
// Turned rooms, or the corner is on the plane exactly.
TEST(RegionImages, AreThoseOfTheirPointsWhereAMirrorTouchesTheNext) {
  const WorldSettings deep{.min_throughput = 0.0, .max_depth = 4, .max_worlds = 100};
  Scene scene = room_with_mirrors({true});
  add_polygon(scene, "touching", {{0.0, 0.1, 1.2}, {0.7, 0.2, 1.4}, {0.5, 1.2, 1.7}}, mirror(0.9));
  add_polygon(scene, "touching too", {{0.0, 0.2, 0.5}, {0.5, 1.2, 0.1}, {0.7, 0.3, 0.3}},
              mirror(0.9));
  Random random(3);
  for (int turn = 0; turn < 50; ++turn) {
    const glm::dmat3 rotation = random_rotation(random);
    const GlowingRoom room = glowing(transformed(scene, rotation, 1.0, Vec3(0.0)), deep);
    RegionImages images;
    for (int wall = 1; wall < 6; ++wall)
      for (int k = 0; k < 9; ++k) {
        Cell cell = cell_of(room_size, wall, k % 3, k / 3, 3);
        for (Point3& corner : cell.corners)
          corner = rotation * corner;
        cell.normal = rotation * cell.normal;
        images_of_region(room.worlds, room.emitters, {cell.corners, cell.normal, hit_error},
                         images);
        expect_same_lights(room, cell, images, random);
      }
  }
}

// Nothing is decided by a length of its own:
// in rooms of all sizes the same cells see the same wholly.
TEST(RegionImages, DoNotDependOnTheScale) {
  const auto counts_at = [](double scale) {
    const GlowingRoom room =
        glowing(transformed(room_with_mirror_in_wall(), glm::dmat3(1.0), scale, Vec3(0.0)), {});
    Counts counts;
    RegionImages images;
    for (int wall = 0; wall < 6; ++wall) {
      const Cell cell = cell_of(scale * room_size, wall, 1, 1, cells);
      images_of_region(room.worlds, room.emitters, {cell.corners, cell.normal, scale * hit_error},
                       images);
      counts.whole +=
          static_cast<std::size_t>(std::ranges::count(images.images, true, &RegionImage::whole));
      counts.part += images.images.size();
    }
    return std::pair(counts.whole, counts.part);
  };
  EXPECT_GT(counts_at(1.0).first, 0U);
  EXPECT_EQ(counts_at(0x1p-20), counts_at(1.0));
  EXPECT_EQ(counts_at(0x1p20), counts_at(1.0));
}

} // namespace
} // namespace meninas::test
