// `--solver progressive` on the command line:
// steps, pictures along the way, and what has no effect.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ProgressiveRuns : public testing::Test {
protected:
  ProgressiveRuns() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(const std::string& command, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {command, "room.glb"});
    arguments.insert(arguments.end(),
                     {"--quality", "draft", "--element-size", "0.08", "--stats", "stats.json"});
    if (command == "render")
      arguments.insert(arguments.end(), {"--size", "24x18"});
    return run_program(folder_.path(), arguments);
  }
  json solver_figures() { return json::parse(read_file(folder_ / "stats.json")).at("solve"); }
  double mean_of(const std::string& picture) {
    const Image image = read_image(folder_ / picture).picture;
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        sum += double{image.at(x, y).g};
    return sum;
  }

  TemporaryFolder folder_;
};

TEST_F(ProgressiveRuns, ConvergesAndSaysSo) {
  const Outcome outcome = run("solve", {"-o", "room-solution.glb", "--solver", "progressive"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("converged")));
  const json solve = solver_figures();
  EXPECT_EQ(solve["solver"], "progressive");
  EXPECT_EQ(solve["converged"], true);
  EXPECT_LE(solve["error_bound"].get<double>(), 1e-4);
  EXPECT_GE(solve["residuals"].front().get<double>(), solve["residuals"].back().get<double>());

  // The solution file knows the solver.
  const Outcome view =
      run_program(folder_.path(), {"render", "room.glb", "--solution", "room-solution.glb", "-o",
                                   "view.png", "--size", "8x8"});
  EXPECT_EQ(view.code, 0) << view.err;
}

TEST_F(ProgressiveRuns, StepsStopShortAndTheUserIsTold) {
  const Outcome outcome =
      run("render", {"-o", "out.exr", "--solver", "progressive", "--steps", "3"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("has not converged: residual"));
  EXPECT_THAT(outcome.err, HasSubstr("after 3 shots"));
  EXPECT_EQ(solver_figures()["converged"], false);
  EXPECT_EQ(solver_figures()["iterations"], 3);
  EXPECT_EQ(solver_figures()["residuals"].size(), 4U);
}

TEST_F(ProgressiveRuns, PicturesAlongTheWay) {
  const Outcome outcome = run("render", {"-o", "out.exr", "--solver", "progressive", "--steps", "7",
                                         "--snapshots", "way/there", "--every", "3", "--float"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files_in(folder_ / "way/there"),
              ElementsAre("shots-000003-ambient.exr", "shots-000003.exr",
                          "shots-000006-ambient.exr", "shots-000006.exr",
                          "shots-000007-ambient.exr", "shots-000007.exr"));

  // Light only arrives; what is expected of the rest shrinks,
  // and was not far from what there is with twice the shots.
  const double at3 = mean_of("way/there/shots-000003.exr"),
               at6 = mean_of("way/there/shots-000006.exr"),
               expected3 = mean_of("way/there/shots-000003-ambient.exr"),
               expected6 = mean_of("way/there/shots-000006-ambient.exr");
  EXPECT_LT(at3, at6);
  EXPECT_LT(at6, expected6);
  EXPECT_LT(expected6 - at6, expected3 - at3);
}

TEST_F(ProgressiveRuns, PngsHaveOneExposure) {
  const Outcome outcome = run("render", {"-o", "out.png", "--solver", "progressive", "--steps", "4",
                                         "--snapshots", "way", "--every", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files_in(folder_ / "way"),
              ElementsAre("shots-000002-ambient.png", "shots-000002.png",
                          "shots-000004-ambient.png", "shots-000004.png"));
  EXPECT_LT(mean_of("way/shots-000002.png"), mean_of("way/shots-000004.png"));
}

TEST_F(ProgressiveRuns, StoredFormFactorsServeItToo) {
  const Outcome kept = run("solve", {"-o", "a.glb", "--factors", "room.factors", "--per-node",
                                     "a.json", "--solver", "cg", "--tolerance", "1e-7"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  const Outcome reused = run("solve", {"-o", "b.glb", "--reuse", "room.factors", "--per-node",
                                       "b.json", "--solver", "progressive", "--tolerance", "1e-7"});
  EXPECT_EQ(reused.code, 0) << reused.err;
  const json a = json::parse(read_file(folder_ / "a.json")),
             b = json::parse(read_file(folder_ / "b.json"));
  for (std::size_t k = 0; k < a["nodes"].size(); ++k) {
    const double light = a["nodes"][k]["irradiance"][1];
    EXPECT_NEAR(b["nodes"][k]["irradiance"][1].get<double>(), light, 1e-6 * light);
  }
}

// Whatever the form factors are:
// all that is shot is in the last of the pictures, and nothing is left for the ambient term.
TEST_F(ProgressiveRuns, TheLastPictureHasAllLight) {
  for (const char* method : {"rays", "hemicube"}) {
    const Outcome outcome =
        run("render", {"-o", "out.exr", "--float", "--interpolation", "average", "--form-factors",
                       method, "--solver", "progressive", "--tolerance", "1e-6", "--snapshots",
                       method, "--every", "1000000000"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto pictures = files_in(folder_ / method);
    ASSERT_EQ(pictures.size(), 2U);
    const double all = mean_of("out.exr");
    for (const std::string& picture : pictures)
      EXPECT_NEAR(mean_of(method + ("/" + picture)), all, 1e-5 * all) << picture;
  }
}

TEST_F(ProgressiveRuns, WhatHasNoEffectIsRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"--steps", "3"}, "--steps"},
      {{"--solver", "cg", "--steps", "3"}, "--steps"},
      {{"--every", "3"}, "--every"},
      {{"--solver", "progressive", "--every", "3"}, "--every"},
      {{"--snapshots", "way"}, "--snapshots"},
      {{"--mode", "reference", "--steps", "3"}, "--steps"},
      {{"--solver", "progressive", "--steps", "0"}, "--steps"},
      {{"--solver", "progressive", "--steps", "3", "--snapshots", "way", "--every", "x"},
       "--every"}};
  for (auto [arguments, name] : refused) {
    arguments.insert(arguments.begin(), {"render", "room.glb", "-o", "out.png"});
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_THAT(outcome.err, HasSubstr("meninas: " + name + ": "));
  }
  EXPECT_THAT(files_in(folder_.path()), ElementsAre("room.glb"));
}

TEST_F(ProgressiveRuns, AFolderThatCannotBeIsAnError) {
  const Outcome outcome = run("render", {"-o", "out.png", "--solver", "progressive", "--steps", "3",
                                         "--snapshots", "room.glb/way"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("room.glb/way"));
}

} // namespace
} // namespace meninas::test
