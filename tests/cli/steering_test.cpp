// `render --error` and `--time`: the run chooses its own settings, and says so.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Steering : public testing::Test {
protected:
  Steering() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "room.glb", "--size", "32x24"});
    return run_program(folder_.path(), arguments);
  }
  json figures() { return json::parse(read_file(folder_ / "out.json")); }

  TemporaryFolder folder_;
};

TEST_F(Steering, ReachesTheErrorAndSaysHow) {
  const Outcome outcome = render({"-o", "out.exr", "--stats", "out.json", "--error", "0.05"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json said = figures();
  const json& choice = said.at("choice");
  EXPECT_EQ(choice.at("wanted_error"), 0.05);
  EXPECT_TRUE(choice.at("wanted_seconds").is_null());
  EXPECT_TRUE(choice.at("reached"));
  EXPECT_LE(said.at("error_estimate").at("total"), 0.05);
  const json& steps = choice.at("steps");
  ASSERT_GE(steps.size(), 2U) << "the first look is coarser than that";
  EXPECT_EQ(steps.at(choice.at("kept").get<std::size_t>()).at("error"),
            said.at("error_estimate").at("total"));
  EXPECT_THAT(steps.at(1).at("why").get<std::string>(), HasSubstr("%"));
  EXPECT_THAT(outcome.err, HasSubstr("next, because of"));
  EXPECT_THAT(outcome.err, testing::ContainsRegex("out.exr: [0-9]+x[0-9]+ in .* s, about .* off"));
}

TEST_F(Steering, SaysWithWhichOptionsThePictureIsMadeAgain) {
  ASSERT_EQ(render({"-o", "out.exr", "--stats", "out.json", "--error", "0.05", "--quiet"}).code, 0);
  std::vector<std::string> options = figures().at("choice").at("options");
  options.insert(options.begin(), {"-o", "again.exr", "--quiet"});
  ASSERT_EQ(render(options).code, 0);
  EXPECT_EQ(read_file(folder_ / "out.exr"), read_file(folder_ / "again.exr"));
}

TEST_F(Steering, LeavesWhatWasSet) {
  ASSERT_EQ(render({"-o", "out.exr", "--stats", "out.json", "--error", "0.03", "--quiet", "--rays",
                    "128", "--element-size", "0.25"})
                .code,
            0);
  const json steps = figures().at("choice").at("steps");
  ASSERT_FALSE(steps.empty());
  for (const json& step : steps)
    EXPECT_EQ(step.at("rays"), 128);
}

TEST_F(Steering, WarnsOfWhatCannotBeReached) {
  // One camera ray a pixel, a coarse mesh and light that is interpolated between its vertices:
  // nothing is left to turn.
  const Outcome outcome =
      render({"-o", "out.exr", "--stats", "out.json", "--error", "1e-4", "--rays", "64",
              "--samples", "1", "--element-size", "0.25", "--diffuse", "direct", "--quiet"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("was not reached"));
  EXPECT_FALSE(figures().at("choice").at("reached"));
}

TEST_F(Steering, KeepsToATime) {
  ASSERT_EQ(render({"-o", "out.exr", "--stats", "out.json", "--time", "1", "--quiet"}).code, 0);
  const json said = figures();
  EXPECT_EQ(said.at("choice").at("wanted_seconds"), 1.0);
  // How far it comes depends on the machine;
  // there is a picture in any case, the best of those there were.
  const json& choice = said.at("choice");
  ASSERT_GE(choice.at("steps").size(), 1U);
  for (const json& step : choice.at("steps"))
    EXPECT_GE(step.at("error"),
              choice.at("steps").at(choice.at("kept").get<std::size_t>()).at("error"));
}

TEST_F(Steering, RefusesWhatItWouldNotHeed) {
  for (const std::vector<std::string>& other :
       std::vector<std::vector<std::string>>{{"--quality", "fine"},
                                             {"--error-map"},
                                             {"--mode", "reference"},
                                             {"--solution", "room.glb"}}) {
    std::vector<std::string> arguments{"-o", "out.exr", "--error", "0.1"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    EXPECT_EQ(render(arguments).code, 2) << other.front();
  }
  const Outcome lamps = render({"-o", "out.exr", "--error", "0.1", "--layers", "lamps"});
  EXPECT_EQ(lamps.code, 2);
  EXPECT_NE(lamps.err.find("lamps does not go with --error"), std::string::npos) << lamps.err;
  EXPECT_EQ(render({"-o", "out.exr", "--error", "0"}).code, 2);
  EXPECT_EQ(render({"-o", "out.exr", "--time", "-1"}).code, 2);
}

} // namespace
} // namespace meninas::test
