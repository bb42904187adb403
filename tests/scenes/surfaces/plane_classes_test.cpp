// Plane classes where they are known, of more pieces than are looked up together.
#include "scenes/surfaces/surfaces.h"
#include "tests/scenes/soup.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <map>

namespace meninas::test {
namespace {

TEST(PlaneClasses, TilesScatteredOverManyPlanesAreOfThese) {
  constexpr std::size_t planes = 400, tiles = 8;
  Random random(3);
  Scene scene = empty_soup();
  std::vector<std::size_t> plane_of_tile;
  std::vector<std::array<Vec3, 4>> frames; // of planes: a point, two directions, and the normal
  for (std::size_t k = 0; k < planes; ++k) {
    const Direction normal = random.direction();
    const Vec3 u = glm::normalize(glm::cross(normal, random.direction()));
    frames.push_back({random.in_box(Vec3(-5.0), Vec3(5.0)), u, glm::cross(normal, u), normal});
  }
  // Tiles of all planes by turns, so that those of one plane are looked up with those of others.
  for (std::size_t k = 0; k < planes * tiles; ++k) {
    const auto& [origin, u, v, normal] = frames[k % planes];
    const double width = random.between(0.02, 0.1);
    const Point3 p = origin + (0.3 * static_cast<double>(k / planes)) * u +
                     random.between(-2.0, 2.0) * v;
    add_quad(scene, {p, p + width * u, p + width * (u + v), p + width * v});
    plane_of_tile.push_back(k % planes);
  }
  const SurfaceModel model = find_surfaces(scene);
  expect_consistent(scene, model);
  ASSERT_EQ(model.planes.size(), planes);
  std::map<std::size_t, PlaneId> class_of_plane;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto [known, is_new] =
        class_of_plane.try_emplace(plane_of_tile[t / 2], model.plane_of_triangle[t]);
    EXPECT_EQ(model.plane_of_triangle[t], known->second) << "tile " << t / 2;
  }
}

} // namespace
} // namespace meninas::test
