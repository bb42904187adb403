// Which triangles touch a point.
#include "scenes/rays/ray_contacts.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

// The plane's distance is a bound only: the answer is that of the distance to the triangle,
// also for slivers, on the plane beside the triangle, and within rounding of the reach.
TEST(Contacts, WithinReachIsByTheDistance) {
  Random random(11);
  int within = 0, beyond = 0;
  const auto point = [&] {
    return Point3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
  };
  for (int k = 0; k < 20'000; ++k) {
    const double thin = std::pow(10.0, -random.between(0.0, 12.0));
    const Point3 a = point(), b = point();
    const std::array<Point3, 3> corners{a, b, a + 0.5 * (b - a) + thin * (point() - a)};
    const double reach = std::pow(10.0, -random.between(2.0, 8.0));
    const double u = random.between(-0.5, 1.0), v = random.between(-0.5, 1.0);
    const Point3 on_plane = a + u * (corners[1] - a) + v * (corners[2] - a);
    const Point3 x = on_plane + random.between(0.0, 4.0) * reach * point();
    const bool expected = distance_to(corners, x) <= reach;
    ASSERT_EQ(is_within(corners, x, reach), expected) << k;
    (expected ? within : beyond) += 1;
  }
  EXPECT_GT(within, 1000);
  EXPECT_GT(beyond, 1000);
}

} // namespace
} // namespace meninas::test
