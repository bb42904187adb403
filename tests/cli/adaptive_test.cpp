// `--adaptive`: elements divided where the light asks for it, from the command line to the picture.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using json = nlohmann::json;
using testing::HasSubstr;

class Adaptive : public testing::Test {
protected:
  Adaptive() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(const std::vector<std::string>& arguments) {
    return run_program(folder_.path(), arguments);
  }
  /// `meninas COMMAND room.glb ARGUMENTS -o OUT`, quick; the bytes it writes.
  std::string bytes(const std::string& command, const std::string& out,
                    std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {command, "room.glb", "--quiet", "-o", out});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_file(folder_ / out);
  }
  json stats(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--quality", "draft", "--stats", "stats.json"});
    bytes("solve", "any.glb", arguments);
    return json::parse(read_file(folder_ / "stats.json"));
  }
  void expect_usage_error(const std::string& line, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"room.glb", "-o", "no.exr", "--quiet"});
    arguments.insert(arguments.begin(), "render");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
  }

  TemporaryFolder folder_;
};

const std::vector<std::string> small{"--size", "40x30", "--samples", "1"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(Adaptive, ElementsFollowTheBound) {
  const json loose = stats({"--adaptive", "0.1"}), tight = stats({"--adaptive", "0.01"});
  for (const json& figures : {loose, tight}) {
    EXPECT_GE(figures["mesh"]["elements"], figures["mesh"]["solved_elements"]);
    EXPECT_GT(figures["mesh"]["interpolation_error"], 0.0);
  }
  EXPECT_EQ(loose["mesh"]["solved_elements"], tight["mesh"]["solved_elements"]);
  EXPECT_GT(tight["mesh"]["elements"], tight["mesh"]["solved_elements"]);
  EXPECT_LE(tight["mesh"]["interpolation_error"], 0.01);
  const json uniform = stats({});
  EXPECT_EQ(uniform["mesh"]["elements"], uniform["mesh"]["solved_elements"]);
  EXPECT_TRUE(uniform["mesh"]["interpolation_error"].is_null());
}

TEST_F(Adaptive, TheBoundMayBeLeftToThePreset) {
  const auto draft = [&](const std::vector<std::string>& arguments) {
    return bytes("solve", "s.glb", with({"--quality", "draft"}, arguments));
  };
  EXPECT_EQ(draft({"--adaptive"}), draft({"--adaptive", "0.03"}));
  EXPECT_EQ(draft({"--adaptive=0.03"}), draft({"--adaptive", "3e-2"}));
  // What follows and is no number belongs to others.
  const Outcome outcome =
      run({"solve", "--quality", "draft", "--quiet", "--adaptive", "room.glb", "-o", "t.glb"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_file(folder_ / "t.glb"), draft({"--adaptive"}));
}

TEST_F(Adaptive, ASolutionShowsThePictureOfItsRun) {
  const std::vector<std::string> pass_one{"--adaptive", "0.03", "--quality", "draft"};
  const std::string at_once = bytes("render", "a.exr", with(small, pass_one));
  bytes("solve", "s.glb", pass_one);
  EXPECT_TRUE(bytes("render", "b.exr", with(small, {"--solution", "s.glb"})) == at_once);
  EXPECT_TRUE(bytes("render", "c.exr", with(with(small, pass_one), {"--threads", "1"})) == at_once);
}

TEST_F(Adaptive, OffIsAsIfItWereNotThere) {
  const std::vector<std::string> draft = with(small, {"--quality", "draft"});
  const std::string plain = bytes("render", "a.exr", draft);
  EXPECT_TRUE(bytes("render", "b.exr", with(draft, {"--no-adaptive"})) == plain);
  EXPECT_FALSE(bytes("render", "c.exr", with(draft, {"--adaptive"})) == plain);
}

TEST_F(Adaptive, WhatMakesNoSenseIsSaid) {
  expect_usage_error("--adaptive: '0' is not positive", {"--adaptive", "0"});
  expect_usage_error("--adaptive: '-1' is not positive", {"--adaptive", "-1"});
  expect_usage_error(
      "--adaptive: compares what is gathered: it does not go with --interpolation average",
      {"--adaptive", "--interpolation", "average"});
  expect_usage_error("render: --adaptive excludes --no-adaptive", {"--adaptive", "--no-adaptive"});
  expect_usage_error("--adaptive: has no effect with --mode reference: there is no pass one",
                     {"--adaptive", "--mode", "reference"});
  bytes("solve", "s.glb", {"--quality", "draft"});
  expect_usage_error("--adaptive: has no effect with --solution: pass one is not run",
                     {"--adaptive", "--solution", "s.glb"});
}

// The rims of a sunbeam through narrow gaps ask for elements smaller than vertices can be told apart.
TEST_F(Adaptive, WhatCannotBeHadIsSaid) {
  const std::string sunbeam = source_dir() + "/scenes/gallery/sunbeam.gltf";
  const Outcome outcome = run({"render", sunbeam, "-o", "a.exr", "--size", "8x8", "--quality",
                               "draft", "--adaptive", "0.01", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning: adaptive: interpolation is off by about 4"));
  EXPECT_THAT(outcome.err, HasSubstr("not within 1 %"));
}

TEST_F(Adaptive, BendsDivideSomeElements) {
  const json figures = stats({"--bends", "0.001"}), none = stats({"--bends", "1000"});
  EXPECT_GT(figures["mesh"]["elements"], figures["mesh"]["solved_elements"]);
  EXPECT_TRUE(figures["mesh"]["interpolation_error"].is_null());
  EXPECT_EQ(none["mesh"]["elements"], none["mesh"]["solved_elements"]);
  const std::vector<std::string> pass_one{"--bends", "0.001", "--quality", "draft"};
  const std::string at_once = bytes("render", "a.exr", with(small, pass_one));
  bytes("solve", "s.glb", pass_one);
  EXPECT_TRUE(bytes("render", "b.exr", with(small, {"--solution", "s.glb"})) == at_once);
  EXPECT_TRUE(bytes("render", "c.exr", with(with(small, pass_one), {"--threads", "1"})) == at_once);
  expect_usage_error("--bends: '0' is not positive", {"--bends", "0"});
  expect_usage_error("--bends: has no effect with --adaptive, which divides elements by itself",
                     {"--bends", "0.1", "--adaptive"});
  expect_usage_error(
      "--bends: looks at what is gathered: it does not go with --interpolation average",
      {"--bends", "0.1", "--interpolation", "average"});
}

TEST_F(Adaptive, BendsDivideElementsThatNodesLightToo) {
  const std::vector<std::string> by_nodes{"--bends", "0.001", "--solver", "hierarchical"};
  const json figures = stats(by_nodes);
  EXPECT_GT(figures["mesh"]["elements"], figures["mesh"]["solved_elements"]);
  const std::vector<std::string> pass_one = with(by_nodes, {"--quality", "draft"});
  const std::string at_once = bytes("render", "a.exr", with(small, pass_one));
  bytes("solve", "s.glb", pass_one);
  EXPECT_TRUE(bytes("render", "b.exr", with(small, {"--solution", "s.glb"})) == at_once);
  EXPECT_TRUE(bytes("render", "c.exr", with(with(small, pass_one), {"--threads", "1"})) == at_once);
}

TEST_F(Adaptive, FilesOfCasesAskForItToo) {
  const auto update = [&](const json& adaptive) {
    const json one{{"name", "room"},
                   {"scene", "room.glb"},
                   {"settings", {{"quality", "draft"}, {"size", "24x16"}, {"adaptive", adaptive}}},
                   {"reference", "room.exr"},
                   {"limits", {{"relmse", 1e-6}}}};
    std::ofstream(folder_ / "cases.json") << json{{"cases", {one}}};
    return run({"regress", "cases.json", "--update", "--quiet"});
  };
  const auto picture_of = [&](const json& adaptive) {
    EXPECT_EQ(update(adaptive).code, 0);
    return read_file(folder_ / "room.exr");
  };
  EXPECT_TRUE(picture_of(true) == picture_of(0.03));
  EXPECT_FALSE(picture_of(true) == picture_of(false));
  EXPECT_THAT(update("fine").err, HasSubstr("adaptive: 'fine' is not a number"));
}

} // namespace
} // namespace meninas::test
