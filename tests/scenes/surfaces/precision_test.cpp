// Whether all of a scene is its detail, against the definition.
#include "scenes/surfaces/precision.h"
#include "tests/scenes/soup.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Nothing is over 2048 times as far from the median corner as the median of the corners is.
bool is_all_by_definition(const Scene& scene) {
  std::array<std::vector<double>, 3> coordinates;
  for (const Vertex& vertex : scene.vertices)
    for (int axis = 0; axis < 3; ++axis)
      coordinates[static_cast<std::size_t>(axis)].push_back(vertex.position[axis]);
  const Point3 centre(median(coordinates[0]), median(coordinates[1]), median(coordinates[2]));
  std::vector<double> distances;
  for (const Vertex& vertex : scene.vertices)
    distances.push_back(glm::distance(vertex.position, centre));
  const double within = 2048.0 * median(distances);
  return !(within > 0.0) || std::ranges::max(distances) <= within;
}

TEST(Precision, AllIsDetailUnlessMostIsTinyBesideTheRest) {
  Random random(4);
  int all = 0, not_all = 0;
  for (const double share : {0.1, 0.45, 0.49, 0.51, 0.55, 0.9})
    for (const double width : {1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 1.0})
      for (int round = 0; round < 4; ++round) {
        const Point3 middle = random.in_box(Vec3(-1.0), Vec3(1.0));
        const Vec3 box(random.between(0.1, 1.0), 1.0, random.between(0.1, 1.0));
        Scene scene = empty_soup();
        for (int k = 0; k < 400; ++k) {
          const bool is_in_cluster = k < share * 400;
          std::array<Point3, 3> corners;
          for (Point3& corner : corners)
            corner = is_in_cluster ? middle + width * random.in_box(-box, box)
                                   : random.in_box(-box, box);
          add_triangle(scene, corners);
        }
        const bool expected = is_all_by_definition(scene);
        EXPECT_EQ(Precision(scene).detail().is_all, expected) << share << ' ' << width;
        ++(expected ? all : not_all);
      }
  EXPECT_GT(all, 20);
  EXPECT_GT(not_all, 20);
}

} // namespace
} // namespace meninas::test
