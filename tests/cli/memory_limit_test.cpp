// What a run is going to need is known before it takes it:
// refused above the limit, foretold by `plan`.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

class MemoryLimit : public testing::Test {
protected:
  MemoryLimit() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }

  void expect_refused(const std::vector<std::string>& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_THAT(outcome.err,
                MatchesRegex("meninas: room.glb: memory: needs about [0-9.]+ [GM]iB, more than the "
                             "limit of [0-9.]+ [GM]iB: larger elements, [^\n]*\n"));
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(files_in(folder_.path()), ElementsAre("room.glb"));
  }

  TemporaryFolder folder_;
};

TEST_F(MemoryLimit, RunsAboveItAreRefused) {
  const std::vector<std::string> many_pixels{"--size", "8000x8000", "--memory-limit", "1G"};
  const std::vector<std::string> many_elements{"--element-size", "0.002", "--memory-limit", "1G"};
  const auto refused = [&](std::vector<std::string> command,
                           const std::vector<std::string>& options) {
    command.insert(command.end(), options.begin(), options.end());
    expect_refused(command);
  };
  refused({"render", "room.glb", "-o", "out.exr"}, many_pixels);
  refused({"render", "room.glb", "-o", "out.exr"}, many_elements);
  refused({"render", "room.glb", "-o", "out.exr", "--mode", "reference"}, many_pixels);
  refused({"solve", "room.glb", "-o", "out.glb"}, many_elements);
}

TEST_F(MemoryLimit, RunsBelowItAreMade) {
  const Outcome outcome =
      run({"render", "room.glb", "--quality", "draft", "--size", "16x16", "--memory-limit", "1G",
           "-o", "out.exr", "--stats", "stats.json", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto stats = nlohmann::json::parse(read_file(folder_ / "stats.json"));
  EXPECT_LT(stats.at("peak_memory_bytes"), 1 << 30);
}

// Each lamp has light of its own at every vertex and element.
TEST_F(MemoryLimit, LampsApartAreForetold) {
  TinyRoom room = tiny_room();
  room.root["extensionsUsed"] = {"KHR_lights_punctual"};
  room.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 0.01}}};
  for (int k = 0; k < 100; ++k) {
    room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size());
    room.root["nodes"].push_back({{"name", "bulb " + std::to_string(k)},
                                  {"translation", {0.5, 0.5, 0.5}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  write_room(folder_ / "room.glb", room);
  const std::vector<std::string> solve{"solve", "room.glb", "-o", "out.glb", "--quality", "draft",
                                       "--elements", "10000", "--memory-limit", "200M"};
  std::vector<std::string> apart = solve;
  apart.push_back("--by-lamp");
  expect_refused(apart);
  EXPECT_THAT(run(apart).err, HasSubstr("fewer lamps apart"));
  // 15,000 elements at the most and 101 lamps, 270 bytes each: two thirds of 390 MiB.
  EXPECT_THAT(run({"plan", "room.glb", "--elements", "10000"}).out,
              testing::ContainsRegex("--by-lamp tells them apart in 2[4-9][0-9] MiB more"));
  const Outcome together = run(solve);
  EXPECT_EQ(together.code, 0) << together.err;
}

TEST_F(MemoryLimit, TheSceneItselfIsRefusedLikewise) {
  const Outcome outcome = run({"plan", "room.glb", "--memory-limit", "100"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("memory limit"));
}

TEST_F(MemoryLimit, APlanForetellsTheRefusal) {
  const auto warnings = [&](const std::string& size) {
    const Outcome outcome =
        run({"plan", "room.glb", "--json", "--size", size, "--memory-limit", "1G"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("warnings").dump();
  };
  EXPECT_THAT(warnings("8000x8000"), HasSubstr("more than the memory limit of 1 GiB"));
  EXPECT_THAT(warnings("80x80"), testing::Not(HasSubstr("memory limit")));
}

} // namespace
} // namespace meninas::test
