// `--mesh hierarchical` on the command line, the default: figures, and what has no effect.
#include "tests/cli/batch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class HierarchicalRuns : public testing::Test {
protected:
  HierarchicalRuns() { write_room(folder_ / "room.glb", tiny_room()); }

  json figures() { return json::parse(read_file(folder_ / "stats.json")).at("solve"); }

  TemporaryFolder folder_;
};

TEST_F(HierarchicalRuns, FiguresSpeakOfReceiversAndLinks) {
  std::vector<std::size_t> links;
  for (const char* error : {"0.5", "0.002"}) {
    const Outcome outcome =
        run_program(folder_.path(), {"solve", "room.glb", "-o", "solved.glb", "--quality", "draft",
                                     "--element-size", "0.05", "--link-error", error, "--stats", "stats.json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const json stats = json::parse(read_file(folder_ / "stats.json"));
    EXPECT_EQ(stats["mesh"]["cut"], "hierarchical");
    const json solve = stats["solve"];
    EXPECT_EQ(solve["solver"], "cg");
    EXPECT_EQ(solve["converged"], true);
    EXPECT_LE(solve["error_bound"].get<double>(), 1e-4);
    EXPECT_GT(solve["receivers"].get<std::size_t>(), 0U);
    EXPECT_GE(solve["link_bytes"].get<std::size_t>(), 8 * solve["links"].get<std::size_t>());
    links.push_back(solve["links"]);
  }
  EXPECT_GT(links[1], links[0]);

  // The solution file knows them.
  const Outcome view =
      run_program(folder_.path(), {"render", "room.glb", "--solution", "solved.glb", "-o",
                                   "view.png", "--size", "8x8", "--stats", "view.json"});
  EXPECT_EQ(view.code, 0) << view.err;
  const json stored = json::parse(read_file(folder_ / "view.json"));
  EXPECT_EQ(stored["mesh"]["cut"], "hierarchical");
  EXPECT_EQ(stored["solve"]["links"], links[1]);
}

// Elements are divided at the edges of shadows where vertices show these, and not
// where light from lamps is computed at hits.
// Pass one is the same whatever its pictures are.
TEST_F(HierarchicalRuns, DivideAtShadows) {
  const auto meshed = [&](const std::string& diffuse) {
    const Outcome outcome = run_program(
        folder_.path(), {"render", "room.glb", "-o", "a.exr", "--size", "8x8", "--rays", "64",
                         "--element-size", "0.1", "--link-error", "0.002", "--diffuse", diffuse, "--stats", "stats.json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(read_file(folder_ / "stats.json")).at("mesh");
  };
  const json interpolated = meshed("interpolated"), direct = meshed("direct");
  EXPECT_GT(interpolated["elements"], interpolated["solved_elements"]);
  EXPECT_EQ(direct["elements"], interpolated["elements"]);
  EXPECT_EQ(direct["solved_elements"], interpolated["solved_elements"]);
}

// A hierarchical mesh was one of the solvers once.
TEST_F(HierarchicalRuns, AreTheDefaultUnderBothNames) {
  const auto picture = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "room.glb", "-o", "a.exr", "--size", "8x8", "--quality",
                               "draft"});
    const Outcome outcome = run_program(folder_.path(), more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return std::pair(read_file(folder_ / "a.exr"), outcome.err);
  };
  const auto standard = picture({}), by_mesh = picture({"--mesh", "hierarchical"}),
             by_solver = picture({"--solver", "hierarchical"}),
             uniform = picture({"--mesh", "uniform"});
  EXPECT_EQ(by_mesh.first, standard.first);
  EXPECT_EQ(by_solver.first, standard.first);
  EXPECT_NE(uniform.first, standard.first);
  EXPECT_THAT(by_solver.second, HasSubstr("--solver hierarchical is --mesh hierarchical now"));
  EXPECT_THAT(by_mesh.second, testing::Not(HasSubstr("--solver")));
}

// Every solver finds the same light on the nodes.
TEST_F(HierarchicalRuns, AnySolverSolvesForTheNodes) {
  std::vector<double> absorbed;
  for (const char* solver : {"direct", "jacobi", "gauss-seidel", "cg", "progressive"}) {
    const Outcome outcome = run_program(
        folder_.path(), {"solve", "room.glb", "-o", "a.glb", "--quality", "draft", "--mesh",
                         "hierarchical", "--solver", solver, "--stats", "stats.json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(figures()["solver"], solver);
    EXPECT_GT(figures()["receivers"].get<std::size_t>(), 0U);
    absorbed.push_back(json::parse(read_file(folder_ / "stats.json"))["energy"]["absorbed"][1]);
  }
  // Each stops within the tolerance, 1e-4, of the solution.
  for (const double other : absorbed)
    EXPECT_NEAR(other, absorbed.front(), 2e-4 * absorbed.front());
}

TEST_F(BatchTest, TakesHierarchicalAsTheCommandLineDoes) {
  write_jobs({{{"scenes", "room.glb"},
               {"modes", "radiosity"},
               {"outputs", {"a.exr"}},
               {"settings", {{"solver", "hierarchical"}, {"link-error", 0.05}}}}});
  const Outcome outcome = batch();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  run_program(folder_.path(),
              {"render", "room.glb", "-o", "a.exr", "--mode", "radiosity", "--element-size", "0.25",
               "--rays", "16", "--size", "24x16", "--samples", "1", "--solver", "hierarchical",
               "--link-error", "0.05", "--quiet"});
  EXPECT_EQ(pictures()["a.exr"], read_file(folder_ / "a.exr"));
}

TEST_F(HierarchicalRuns, WhatHasNoEffectIsRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"--mesh", "uniform", "--link-error", "0.01"}, "--link-error"},
      {{"--solver", "progressive", "--link-error", "0.01"}, "--link-error"},
      {{"--link-error", "0"}, "--link-error"},
      {{"--mesh", "hierarchical", "--solver", "progressive", "--steps", "3"}, "--steps"},
      {{"--mesh", "hierarchical", "--solver", "progressive", "--snapshots", "along"}, "--snapshots"},
      {{"--mesh", "hierarchical", "--form-factors", "analytic"}, "--form-factors"},
      {{"--mode", "reference", "--link-error", "0.1"}, "--link-error"}};
  for (auto [arguments, name] : refused) {
    arguments.insert(arguments.begin(), {"render", "room.glb", "-o", "out.png"});
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_THAT(outcome.err, HasSubstr("meninas: " + name + ": "));
  }
  const Outcome kept = run_program(folder_.path(), {"solve", "room.glb", "-o", "a.glb", "--mesh",
                                                    "hierarchical", "--factors", "room.factors"});
  EXPECT_EQ(kept.code, 2);
  EXPECT_THAT(kept.err, HasSubstr("meninas: --mesh hierarchical: "));
  EXPECT_THAT(files_in(folder_.path()), ElementsAre("room.glb"));
}

} // namespace
} // namespace meninas::test
