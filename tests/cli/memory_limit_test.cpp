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
