// The row of an element told apart: it is the row of pass one, it closes, and what comes by a mirror is
// what the mirror would have received.
#include "radiosity/queries/element_factors.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace meninas::test {
namespace {

constexpr int rays = 4096;

/// The unit cube; its wall x1 is a mirror.
std::unique_ptr<LitScene> cube(double mirror_reflectance) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, mirror(mirror_reflectance), wall, wall, wall, wall});
  return lit(std::move(scene), {.element_size = 0.25});
}

/// Of a unit square to the one opposite, a metre away (Howell, C-11, X = Y = 1).
double opposite_faces() {
  const double root = std::sqrt(2.0);
  return 2.0 / std::numbers::pi *
         (0.5 * std::log(4.0 / 3.0) + 2.0 * root * std::atan(1.0 / root) - 2.0 * std::atan(1.0));
}

TEST(ElementFactors, AddUpToTheRowOfPassOneToRounding) {
  const auto room = cube(0.8);
  const FormFactors all = assemble_transport(*room->light, {.rays = rays});
  for (const std::uint32_t e : {0U, 17U, 60U}) {
    const ElementFactors own = element_factors(*room->light, ElementId{e}, {.rays = rays});
    std::map<std::uint32_t, double> sums;
    for (const ElementFactor& factor : own.row) {
      EXPECT_GE(factor.direct, 0.0);
      EXPECT_GE(factor.mirrored, 0.0);
      sums[index(factor.to)] = factor.direct + factor.mirrored;
    }
    const auto begin = all.transport.row_begin[e], end = all.transport.row_begin[e + 1];
    ASSERT_EQ(sums.size(), end - begin);
    for (auto k = begin; k < end; ++k) // weights are single precision
      EXPECT_NEAR(sums.at(all.transport.columns[k]), double{all.transport.weights[k]}, 1e-6);
  }
}

// Rows are counts of rays, so that they close exactly but for single precision; 4 sigma of a binomial for the share of the mirror.
TEST(ElementFactors, CloseAndGiveTheMirrorWhatItReceives) {
  for (const double reflectance : {1.0, 0.5}) {
    const auto room = cube(reflectance);
    const auto elements = elements_of(*room, "x0");
    double mirrored = 0.0;
    for (const std::size_t e : elements) {
      const ElementFactors own = element_factors(*room->light, static_cast<ElementId>(e), {.rays = rays});
      double sum = 0.0;
      for (const ElementFactor& factor : own.row) {
        sum += factor.direct + factor.mirrored;
        mirrored += factor.mirrored / double(elements.size());
        if (room->mesh.side_of_element[index(factor.to)] == room->mesh.side_of_element[e]) {
          EXPECT_EQ(factor.direct, 0.0) << "a plane sees itself in the mirror alone";
          EXPECT_GT(factor.mirrored, 0.0);
        }
      }
      EXPECT_NEAR(sum + double{own.closure.mirror_absorbed.g}, 1.0, 1e-5);
    }
    const double exact = opposite_faces();
    const double error = 4.0 * std::sqrt(exact * (1.0 - exact) / (rays * double(elements.size())));
    EXPECT_NEAR(mirrored / reflectance, exact, error);
  }
}

TEST(ElementFactors, HaveNoMirroredPartWithoutMirrors) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  const auto room = lit(std::move(scene), {.element_size = 0.5});
  for (const FormFactorMethod method : {FormFactorMethod::rays, FormFactorMethod::hemicube}) {
    double sum = 0.0;
    for (const ElementFactor& factor : element_factors(*room->light, ElementId{3}, {.method = method, .rays = rays}).row) {
      EXPECT_EQ(factor.mirrored, 0.0);
      sum += factor.direct;
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
  }
}

} // namespace
} // namespace meninas::test
