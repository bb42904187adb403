// What one more bounce tells of the elements that light is gathered from.
#include "radiosity/light/point_irradiance.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// The change at a point of the floor of a furnace of E = 1 and rho = 1/2,
/// all of whose elements are said to reflect so much.
double change_where_all_reflect(double said, const std::array<bool, 6>& mirrors = {}) {
  const auto l = lit(furnace(0.5, mirrors), {.element_size = 0.25});
  const PointGathering gathering(*l->light, std::vector<Rgb>(element_count(l->mesh), Rgb(said)), {},
                                 {}, {.rays = 256});
  const auto floor = elements_of(*l, "y0").front();
  const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[floor])];
  PointWorkspace work;
  const ArrivingLight change = one_more_bounce(
      gathering, {Point3(0.3, 0.0, 0.4), side.normal, side.plane_class, side.tangent}, 16, 1, work);
  return change.total.g;
}

// B = E / (1 - rho) = 2, of which 1 is reflected: one more bounce brings the same.
// Said to reflect r, they reflect rho (E + r) by the next, which comes from everywhere.
// Closed forms of emitters are exact but for their shadow rays, which have nothing to meet here.
TEST(OneMoreBounce, ChangesNothingWhereElementsReflectWhatTheyShould) {
  EXPECT_NEAR(change_where_all_reflect(1.0), 0.0, 0.01);
}

TEST(OneMoreBounce, IsWhatElementsReflectTooLittleOrTooMuch) {
  EXPECT_NEAR(change_where_all_reflect(0.0), 0.5, 0.01);
  EXPECT_NEAR(change_where_all_reflect(3.0), -1.0, 0.02);
}

// A perfect mirror for a wall shows the others.
TEST(OneMoreBounce, FollowsMirrors) {
  EXPECT_NEAR(change_where_all_reflect(0.0, {false, true}), 0.5, 0.01);
}

} // namespace
} // namespace meninas::test
