// Elements divided where the light asks for it, from the command line to the picture, and the names
// that options for it once had.
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

class MeshOptions : public testing::Test {
protected:
  MeshOptions() { write_room(folder_ / "room.glb", tiny_room()); }

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

TEST_F(MeshOptions, OlderNamesMeanTheNewOnes) {
  const auto draft = [&](const std::vector<std::string>& arguments) {
    return bytes("solve", "s.glb", with({"--quality", "draft"}, arguments));
  };
  EXPECT_EQ(draft({"--adaptive"}), draft({"--mesh", "hierarchical"}));
  EXPECT_EQ(draft({"--adaptive=0.03"}), draft({"--link-error", "3e-2"}));
  EXPECT_EQ(draft({"--no-adaptive"}), draft({"--mesh", "uniform"}));
  // What follows and is no number belongs to others.
  const Outcome outcome = run({"solve", "--quality", "draft", "--adaptive", "room.glb", "-o", "t.glb"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_file(folder_ / "t.glb"), draft({"--adaptive"}));
  EXPECT_THAT(outcome.err, HasSubstr("--adaptive is --mesh hierarchical --link-error now"));
}

TEST_F(MeshOptions, ASolutionShowsThePictureOfItsRun) {
  const std::vector<std::string> pass_one{"--link-error", "0.005", "--quality", "draft"};
  const std::string at_once = bytes("render", "a.exr", with(small, pass_one));
  bytes("solve", "s.glb", pass_one);
  EXPECT_TRUE(bytes("render", "b.exr", with(small, {"--solution", "s.glb", "--quality", "draft"})) == at_once);
  EXPECT_TRUE(bytes("render", "c.exr", with(with(small, pass_one), {"--threads", "1"})) == at_once);
}

TEST_F(MeshOptions, WhatMakesNoSenseIsSaid) {
  expect_usage_error("--adaptive: '0' is not positive", {"--adaptive", "0"});
  expect_usage_error("--link-error: '-1' is not positive", {"--link-error", "-1"});
  expect_usage_error("--mesh: no value 'triangles', there is uniform, hierarchical",
                     {"--mesh", "triangles"});
  expect_usage_error("render: --adaptive excludes --no-adaptive", {"--adaptive", "--no-adaptive"});
  expect_usage_error("--mesh: has no effect with --mode reference: there is no pass one",
                     {"--mesh", "uniform", "--mode", "reference"});
  bytes("solve", "s.glb", {"--quality", "draft"});
  expect_usage_error("--mesh: has no effect with --solution: pass one is not run",
                     {"--mesh", "uniform", "--solution", "s.glb"});
}

TEST_F(MeshOptions, BendsDivideSomeElements) {
  const json figures = stats({"--mesh", "uniform", "--bends", "0.001"}),
             none = stats({"--mesh", "uniform", "--bends", "1000"});
  EXPECT_GT(figures["mesh"]["elements"], figures["mesh"]["solved_elements"]);
  EXPECT_EQ(none["mesh"]["elements"], none["mesh"]["solved_elements"]);
  const std::vector<std::string> pass_one{"--mesh", "uniform", "--bends", "0.001", "--quality",
                                          "draft"};
  const std::string at_once = bytes("render", "a.exr", with(small, pass_one));
  bytes("solve", "s.glb", pass_one);
  EXPECT_TRUE(bytes("render", "b.exr", with(small, {"--solution", "s.glb", "--quality", "draft"})) == at_once);
  EXPECT_TRUE(bytes("render", "c.exr", with(with(small, pass_one), {"--threads", "1"})) == at_once);
  expect_usage_error("--bends: '0' is not positive", {"--bends", "0"});
  expect_usage_error(
      "--bends: looks at what is gathered: it does not go with --interpolation average",
      {"--bends", "0.1", "--interpolation", "average"});
}

TEST_F(MeshOptions, BendsDivideElementsThatNodesLightToo) {
  const std::vector<std::string> by_nodes{"--bends", "0.001", "--mesh", "hierarchical"};
  const json figures = stats(by_nodes);
  EXPECT_GT(figures["mesh"]["elements"], figures["mesh"]["solved_elements"]);
  const std::vector<std::string> pass_one = with(by_nodes, {"--quality", "draft"});
  const std::string at_once = bytes("render", "a.exr", with(small, pass_one));
  bytes("solve", "s.glb", pass_one);
  EXPECT_TRUE(bytes("render", "b.exr", with(small, {"--solution", "s.glb", "--quality", "draft"})) == at_once);
  EXPECT_TRUE(bytes("render", "c.exr", with(with(small, pass_one), {"--threads", "1"})) == at_once);
}

TEST_F(MeshOptions, FilesOfCasesHaveThemToo) {
  const auto update = [&](const json& link_error) {
    const json one{{"name", "room"},
                   {"scene", "room.glb"},
                   {"settings", {{"quality", "draft"}, {"size", "24x16"}, {"link-error", link_error}}},
                   {"reference", "room.exr"},
                   {"limits", {{"relmse", 1e-6}}}};
    std::ofstream(folder_ / "cases.json") << json{{"cases", {one}}};
    return run({"regress", "cases.json", "--update", "--quiet"});
  };
  const auto picture_of = [&](const json& link_error) {
    EXPECT_EQ(update(link_error).code, 0);
    return read_file(folder_ / "room.exr");
  };
  EXPECT_TRUE(picture_of(0.02) == picture_of("2e-2"));
  EXPECT_FALSE(picture_of(0.02) == picture_of(0.002));
  EXPECT_THAT(update("fine").err, HasSubstr("link-error: 'fine' is not a number"));
}

} // namespace
} // namespace meninas::test
