// The search for planes against asking all of them in turn.
#include "scenes/surfaces/plane_search.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

constexpr double reach = 10.0;
const Point3 middle(3.0, -2.0, 50.0);

/// Planes as of a body of many facets, of walls that are nearly one another, or of anything.
KnownPlane some_plane(Random& random, double uncertainty) {
  const double kind = random.between(0.0, 3.0);
  Direction normal = random.direction();
  Point3 centre = middle + random.in_box(Vec3(-0.5 * reach), Vec3(0.5 * reach));
  if (kind < 1.0) {
    centre = middle + Vec3(1.0, 2.0, 0.0) + 2.0 * normal;
    normal = glm::normalize(normal + 0.3 * random.direction());
  } else if (kind < 2.0) {
    normal = glm::normalize(Vec3(0.0, 1.0, 0.0) + 3.0 * uncertainty * random.direction());
    centre.y = middle.y + 1.0 + uncertainty * random.between(-5.0, 5.0);
  }
  return {{normal, glm::dot(normal, centre)}, centre, uncertainty * random.between(0.5, 1.0)};
}

/// A small triangle near a plane, with its own idea of what that is.
PlaneQuery some_query(Random& random, const KnownPlane& near, double uncertainty) {
  PlaneQuery query;
  query.tolerance = 1e-6 * reach;
  query.radius = 4.0 * uncertainty;
  const Vec3 u = glm::normalize(glm::cross(near.plane.normal, random.direction()));
  const Vec3 v = glm::cross(near.plane.normal, u);
  const Point3 at = near.centre + reach * random.between(-0.3, 0.3) * u;
  const double width = std::max(query.tolerance / uncertainty, 1e-3);
  for (Point3& x : query.points)
    x = at + width * (random.between(-1.0, 1.0) * u + random.between(-1.0, 1.0) * v) +
        uncertainty * random.between(-0.1, 0.1) * near.plane.normal;
  const double sign = random.between(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
  const Direction normal =
      glm::normalize(sign * near.plane.normal + uncertainty * random.direction());
  query.plane = {normal, glm::dot(normal, query.points[0])};
  return query;
}

/// What plane_search.h states, of one plane.
bool is_found(const KnownPlane& known, const PlaneQuery& query) {
  for (const Point3& x : query.points)
    if (std::abs(signed_distance(known.plane, x)) >
        query.tolerance + known.uncertainty * glm::distance(x, known.centre))
      return false;
  for (const double sign : {1.0, -1.0}) {
    const Vec3 turn = glm::abs(sign * known.plane.normal - query.plane.normal);
    const double apart = std::abs(sign * signed_distance(known.plane, middle) -
                                  signed_distance(query.plane, middle)) /
                         reach;
    if (std::max({turn.x, turn.y, turn.z, apart}) <= query.radius)
      return true;
  }
  return false;
}

TEST(PlaneSearch, FindsWhatAskingAllFinds) {
  Random random(1);
  int found = 0, later = 0;
  for (const double uncertainty : {1e-5, 1e-3, 3e-2}) {
    PlaneSearch search(middle, reach);
    std::vector<KnownPlane> planes;
    for (int round = 0; round < 1500; ++round) {
      planes.push_back(some_plane(random, uncertainty));
      search.add(planes.back());
      if (random.between(0.0, 1.0) < 0.05)
        search.settle();
      const auto& near = planes[static_cast<std::size_t>(random.between(0.0, round + 1.0))];
      const PlaneQuery query = some_query(random, near, uncertainty);
      const bool is_picky = random.between(0.0, 1.0) < 0.3;
      const auto accepts = [&](std::uint32_t k) { return !is_picky || k % 3 == 0; };
      std::optional<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < planes.size() && !expected; ++k)
        if (is_found(planes[k], query) && accepts(k))
          expected = k;
      ASSERT_EQ(search.first(query, accepts), expected) << uncertainty << ' ' << round;
      found += expected ? 1 : 0;
      later += expected && &planes[*expected] != &near ? 1 : 0;
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(later, 200) << "planes that were added first go before the one that was meant";
}

TEST(PlaneSearch, KnowsPlanesOfEitherOrientation) {
  Random random(2);
  for (int k = 0; k < 1000; ++k) {
    PlaneSearch search(middle, reach);
    // Nearly at a right angle to any fixed direction, sometimes.
    const Direction normal = random.direction();
    search.add({{normal, glm::dot(normal, middle)}, middle, 1e-2});
    const Direction turned = glm::normalize(-normal + 5e-3 * random.direction());
    const PlaneQuery query{
        {turned, glm::dot(turned, middle)}, {middle, middle, middle}, 1e-6, 4e-2};
    EXPECT_EQ(search.first(query, [](std::uint32_t) { return true; }), 0U);
  }
}

TEST(PlaneSearch, OfNoneFindsNone) {
  const PlaneSearch search(middle, reach);
  EXPECT_EQ(search.first({}, [](std::uint32_t) { return true; }), std::nullopt);
}

} // namespace
} // namespace meninas::test
