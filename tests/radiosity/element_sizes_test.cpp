#include "radiosity/element_sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;

TEST(ElementSizes, AreTheSameWhereNoSurfaceHasThreeQuarters) {
  const ElementSizes sizes = share_elements({3.0, 0.5, 0.5}, 400.0);
  EXPECT_NEAR(sizes.element_size, 0.1, 1e-12);
  EXPECT_THAT(sizes.of_surface, Each(DoubleNear(0.1, 1e-12)));
}

TEST(ElementSizes, ALargeGroundTakesThreeQuartersOfTheElements) {
  const ElementSizes sizes = share_elements({40.0, 360'000.0, 60.0}, 4000.0);
  EXPECT_NEAR(100.0 / std::pow(sizes.element_size, 2.0), 1000.0, 1e-9);
  EXPECT_NEAR(360'000.0 / std::pow(sizes.of_surface[1], 2.0), 3000.0, 1e-9);
  EXPECT_EQ(sizes.of_surface[0], sizes.element_size);
  EXPECT_EQ(sizes.of_surface[2], sizes.element_size);
}

TEST(ElementSizes, WhatIsVerySmallBesideAGroundGetsAFewElements) {
  const ElementSizes sizes = share_elements({1.0, 1e-12}, 100.0);
  EXPECT_NEAR(sizes.of_surface[1], 0.1 / 256.0, 1e-12);
  EXPECT_NEAR(1.0 / std::pow(sizes.of_surface[0], 2.0), 75.0, 1e-9);
}

TEST(ElementSizes, OneSurfaceHasThemAll) {
  EXPECT_NEAR(share_elements({4.0, 0.0}, 400.0).of_surface[0], 0.1, 1e-12);
  EXPECT_EQ(share_elements({0.0}, 400.0).element_size, 0.0);
  EXPECT_EQ(share_elements({}, 400.0).element_size, 0.0);
}

} // namespace
} // namespace meninas::test
