// `formfactors` as people and scripts use it.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace meninas::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class FormFactorsCommand : public testing::Test {
protected:
  FormFactorsCommand() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"formfactors", "room.glb"});
    return run_program(folder_.path(), arguments);
  }

  void expect_refused(const std::string& line, const std::vector<std::string>& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.out, IsEmpty());
  }

  TemporaryFolder folder_;
};

TEST_F(FormFactorsCommand, JsonHasTheTotalAndEveryWorld) {
  const Outcome outcome = run({"--from", "floor", "--to", "right", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["from"], "floor");
  EXPECT_EQ(json["to"], "right");
  EXPECT_EQ(json["method"], "analytic");
  ASSERT_EQ(json["worlds"].size(), 2U);
  EXPECT_THAT(json["worlds"][0]["mirrors"], IsEmpty());
  EXPECT_EQ(json["worlds"][1]["mirrors"], nlohmann::json::array({"mirror"}));
  double sum = 0.0;
  for (const auto& world : json["worlds"])
    sum += world["throughput"][0].get<double>() * world["form_factor"].get<double>();
  EXPECT_NEAR(json["form_factor"].get<double>(), sum, 1e-12);
  EXPECT_LE(json["error_estimate"].get<double>(), 1e-4 * sum);
}

TEST_F(FormFactorsCommand, MirrorDepthZeroLeavesTheRealWorld) {
  const auto json = nlohmann::json::parse(
      run({"--from", "floor", "--to", "right", "--json", "--mirror-depth", "0"}).out);
  EXPECT_EQ(json["worlds"].size(), 1U);
}

TEST_F(FormFactorsCommand, CutOutsCountAsOpaqueAndAreNamed) {
  TinyRoom room = tiny_room();
  room.root["materials"][0]["name"] = "fretwork";
  room.root["materials"][0]["alphaMode"] = "MASK";
  write_room(folder_ / "room.glb", room);
  const Outcome outcome = run({"--from", "floor", "--to", "right"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning: cut-outs count as opaque, material 'fretwork'\n"));
}

TEST_F(FormFactorsCommand, TextSaysTheSame) {
  const Outcome outcome = run({"--from", "floor", "--to", "right"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("form factor"));
  EXPECT_THAT(outcome.out, HasSubstr("by mirror, times 0.9"));
}

TEST_F(FormFactorsCommand, RaysAgree) {
  const auto exact = nlohmann::json::parse(run({"--from", "floor", "--to", "right", "--json"}).out);
  const auto rays = nlohmann::json::parse(
      run({"--from", "floor", "--to", "right", "--json", "--method", "rays", "--rays", "65536"})
          .out);
  const double sigma = rays["error_estimate"];
  EXPECT_GT(sigma, 0.0);
  EXPECT_NEAR(rays["form_factor"].get<double>(), exact["form_factor"].get<double>(),
              4.0 * sigma + exact["error_estimate"].get<double>());
}

TEST_F(FormFactorsCommand, HemicubesAgree) {
  const auto exact = nlohmann::json::parse(run({"--from", "floor", "--to", "right", "--json"}).out);
  const auto cubes =
      nlohmann::json::parse(run({"--from", "floor", "--to", "right", "--json", "--method",
                                 "hemicube", "--resolution", "64", "--points", "16"})
                                .out);
  EXPECT_EQ(cubes["method"], "hemicube");
  EXPECT_EQ(cubes["worlds"].size(), exact["worlds"].size());
  const double estimate = cubes["error_estimate"];
  EXPECT_GT(estimate, 0.0);
  EXPECT_NEAR(cubes["form_factor"].get<double>(), exact["form_factor"].get<double>(), estimate);
}

TEST_F(FormFactorsCommand, TheMatrixHasARowForEveryNodeAndItsSum) {
  const Outcome outcome = run({"--all", "--accuracy", "1e-2", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "from,floor,ceiling,back,left,right,lamp,sum");
  int rows = 0;
  while (std::getline(lines, line)) {
    const double sum = std::stod(line.substr(line.rfind(',') + 1));
    EXPECT_GT(sum, 0.0) << line;
    EXPECT_LE(sum, 1.0 + 1e-2) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

TEST_F(FormFactorsCommand, AGroupStandsForWhatIsBelowIt) {
  TinyRoom room = tiny_room();
  auto& nodes = room.root["nodes"];
  nodes.push_back({{"name", "slabs"}, {"children", {0, 1}}});
  auto& listed = room.root["scenes"][0]["nodes"];
  listed.erase(0);
  listed[0] = nodes.size() - 1;
  write_room(folder_ / "room.glb", room);
  const auto factor = [&](const std::string& from) {
    return nlohmann::json::parse(run({"--from", from, "--to", "right", "--json"}).out)
        .value("form_factor", 0.0);
  };
  EXPECT_NEAR(factor("slabs"), 0.5 * (factor("floor") + factor("ceiling")), 1e-4);
  expect_refused("room.glb: no node 'slab', did you mean 'slabs'?",
                 {"--from", "slab", "--to", "right"});
}

TEST_F(FormFactorsCommand, SidesOfDoubleSidedNodesAreThoseThatFaceEachOtherOrAsAsked) {
  TinyRoom room = tiny_room();
  const auto factor = [&](const std::string& sides) {
    const auto json = nlohmann::json::parse(
        run({"--from", "floor", "--to", "right", "--json", "--sides", sides}).out);
    EXPECT_EQ(json["sides"], sides);
    return json["form_factor"].get<double>();
  };
  const double single = factor("facing");
  EXPECT_EQ(factor("front"), single);
  room.root["materials"][0]["doubleSided"] = true;
  write_room(folder_ / "room.glb", room);
  EXPECT_NEAR(factor("facing"), single, 1e-4);
  EXPECT_NEAR(factor("front"), single, 1e-4);
  EXPECT_NEAR(factor("both"), 0.5 * single, 1e-4);
  EXPECT_EQ(factor("back"), 0.0);
  EXPECT_EQ(run({"--from", "floor", "--to", "right", "--sides", "inner"}).code, 2);
}

TEST_F(FormFactorsCommand, WhatCannotBeAskedIsRefusedInOneLine) {
  expect_refused("room.glb: no node 'flor', did you mean 'floor'?",
                 {"--from", "flor", "--to", "right"});
  expect_refused("room.glb: node 'mirror' is a mirror, which has no form factors of its own",
                 {"--from", "mirror", "--to", "right"});
  expect_refused("formfactors: --from is required, or --all", {"--to", "right"});
  expect_refused("--json: has no effect with --all, which prints CSV", {"--all", "--json"});
  expect_refused("--rays: has no effect without --method rays",
                 {"--from", "floor", "--to", "right", "--rays", "64"});
  expect_refused("--accuracy: has no effect without --method analytic",
                 {"--from", "floor", "--to", "right", "--method", "rays", "--accuracy", "1e-2"});
  expect_refused("--resolution: has no effect without --method hemicube",
                 {"--from", "floor", "--to", "right", "--resolution", "64"});
  expect_refused("--points: has no effect without --method hemicube",
                 {"--from", "floor", "--to", "right", "--method", "rays", "--points", "4"});
  expect_refused("--resolution: '3' is not an even number from 2 to 1024",
                 {"--from", "floor", "--to", "right", "--method", "hemicube", "--resolution", "3"});
  expect_refused("--points: '0' is not a whole number from 1 to 1048576",
                 {"--from", "floor", "--to", "right", "--method", "hemicube", "--points", "0"});
}

} // namespace
} // namespace meninas::test
