// `plan`: what it foretells of a run.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class PlannedCost : public testing::Test {
protected:
  PlannedCost() { write_room(folder_ / "room.glb", tiny_room()); }

  json expected(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"plan", "room.glb", "--json"});
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out).at("expected");
  }

  TemporaryFolder folder_;
};

TEST_F(PlannedCost, IsTheSumOfItsStages) {
  const json cost = expected({"--quality", "draft", "--size", "32x32"});
  double sum = 0.0;
  for (const auto& [stage, seconds] : cost.at("seconds").items()) {
    EXPECT_GE(seconds.get<double>(), 0.0) << stage;
    sum += stage == "total" ? 0.0 : seconds.get<double>();
  }
  EXPECT_NEAR(cost.at("seconds").at("total").get<double>(), sum, 1e-9);
  EXPECT_GT(cost.at("memory_bytes"), 10'000'000);
}

TEST_F(PlannedCost, GrowsWithWhatIsAskedFor) {
  // Counts go into it as factors: a hundred times as many are more. What else the machine does
  // meanwhile only adds to a forecast, which the least of three is spared.
  const auto stage = [&](const char* name, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--quality", "draft"});
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
      least = std::min(least, expected(arguments).at("seconds").at(name).get<double>());
    return least;
  };
  EXPECT_GT(stage("render", {"--size", "1600x1600"}), 3.0 * stage("render", {"--size", "32x32"}));
  EXPECT_GT(stage("form_factors", {"--size", "8x8", "--element-size", "0.01"}),
            3.0 * stage("form_factors", {"--size", "8x8", "--element-size", "0.2"}));
  EXPECT_GT(stage("interpolate", {"--size", "8x8", "--rays", "4096"}),
            3.0 * stage("interpolate", {"--size", "8x8", "--rays", "64"}));
  EXPECT_EQ(stage("interpolate", {"--size", "8x8", "--interpolation", "average"}), 0.0);
}

TEST_F(PlannedCost, IsSaidInWords) {
  const Outcome outcome = run_program(folder_.path(), {"plan", "room.glb", "--size", "32x32"});
  EXPECT_THAT(outcome.out, HasSubstr("a picture takes about"));
  EXPECT_EQ(run_program(folder_.path(), {"plan", "room.glb", "--camera", "nowhere"}).code, 2);
}

} // namespace
} // namespace meninas::test
