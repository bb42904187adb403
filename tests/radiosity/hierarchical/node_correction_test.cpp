// What receivers have lost is found from the field and sent on as often as light is reflected.
#include "radiosity/hierarchical/node_correction.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// Two receivers that see nothing but one another, of two elements each.
ReceiverSystem facing_pair(double reflectance) {
  ReceiverSystem system;
  system.links.size = 2;
  system.links.bands = 1;
  system.links.row_begin = {0, 1, 2};
  system.links.columns = {1, 0};
  system.links.weights = {1.0F, 1.0F};
  system.reflectance.assign(2, Rgb(reflectance));
  system.receiver_of_element = {0, 0, 1, 1};
  system.areas = {1.0, 3.0, 2.0, 2.0};
  system.solver.tolerance = 1e-9;
  return system;
}

// Infinite plates: d is reflected on as rho d + rho^2 d + ... = rho d / (1 - rho).
// The system is solved to a hundredth (node_correction.cpp).
TEST(NodeCorrection, FollowsTheGeometricSeries) {
  for (const double rho : {0.2, 0.5, 0.9}) {
    const ReceiverSystem plates = facing_pair(rho);
    for (const Rgb& more : further_reflected(plates, std::vector<Rgb>(4, Rgb(1.0))))
      EXPECT_NEAR(more.g, rho / (1.0 - rho), 0.01 * rho / (1.0 - rho)) << rho;
  }
}

// Only the mean over a receiver's area counts: +3 on a quarter and -1 on the rest of it are nothing.
TEST(NodeCorrection, NoiseWithinAReceiverIsNotSentOn) {
  const std::vector<Rgb> missed{Rgb(3.0), Rgb(-1.0), Rgb(2.0), Rgb(-2.0)};
  for (const Rgb& more : further_reflected(facing_pair(0.9), missed))
    EXPECT_NEAR(more.g, 0.0, 1e-12);
}

// At most half of what is there is taken or given.
TEST(NodeCorrection, LeavesHalfOfTheLightAtLeast) {
  std::vector<Rgb> received{Rgb(2.0), Rgb(2.0), Rgb(2.0), Rgb(0.0)};
  add_reflected({Rgb(0.5), Rgb(-3.0), Rgb(3.0), Rgb(1.0)}, received);
  EXPECT_EQ(received, (std::vector<Rgb>{Rgb(2.5), Rgb(1.0), Rgb(3.0), Rgb(0.0)}));
}

} // namespace
} // namespace meninas::test
