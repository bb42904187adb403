// `--elements N`: the mesh of the presets in other numbers, wherever options are read.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::IsEmpty;

class Elements : public testing::Test {
protected:
  Elements() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(const std::vector<std::string>& arguments) {
    return run_program(folder_.path(), arguments);
  }
  /// The picture of a draft with these options.
  std::string picture(const std::vector<std::string>& options) {
    std::vector<std::string> command{"render", "room.glb", "-o",     "a.exr",     "--quality",
                                     "draft",  "--rays",   "16",     "--samples", "1",
                                     "--size", "24x16",    "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    EXPECT_EQ(run(command).code, 0);
    return read_file(folder_ / "a.exr");
  }
  /// Of a mesh with these options.
  int count(std::vector<std::string> options) {
    options.insert(options.begin(), {"plan", "room.glb", "--json"});
    return json::parse(run(options).out).at("elements");
  }

  TemporaryFolder folder_;
};

TEST_F(Elements, AreThoseOfThePresets) {
  EXPECT_EQ(picture({"--elements", "4500"}), picture({}));
  EXPECT_NE(picture({"--elements", "1000"}), picture({}));
  EXPECT_EQ(picture({"--mesh", "uniform", "--elements", "4500"}), picture({"--mesh", "uniform"}));
}

// Five walls of a square metre and a lamp: cells are never larger than asked for,
// which makes them more by at most one in an edge of n, about a tenth in 1,000.
TEST_F(Elements, AreAboutAsManyAsAskedFor) {
  for (const int wanted : {1000, 10'000}) {
    const int made = count({"--elements", std::to_string(wanted)});
    EXPECT_GE(made, wanted);
    EXPECT_LE(made, 1.2 * wanted);
  }
  EXPECT_GE(count({"--elements", "1"}), 1) << "every side has one";
}

TEST_F(Elements, DoNotGoWithTheirSize) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"render", "room.glb", "-o", "a.exr"},
           {"render", "room.glb", "-o", "a.exr", "--error", "0.1"},
           {"solve", "room.glb", "-o", "a.glb"},
           {"compare", "room.glb", "-o", "out"},
           {"plan", "room.glb"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--elements", "600", "--element-size", "0.1"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << command.front();
    EXPECT_EQ(outcome.err, "meninas: --elements: does not go with --element-size, which says how "
                           "many there are\n");
    EXPECT_THAT(outcome.out, IsEmpty());
  }
}

TEST_F(Elements, AreNotAskedForWhereThereIsNoPassOne) {
  EXPECT_EQ(
      run({"render", "room.glb", "-o", "a.exr", "--mode", "reference", "--elements", "600"}).err,
      "meninas: --elements: has no effect with --mode reference: there is no pass one\n");
}

TEST_F(Elements, AreASettingOfJobsAndCases) {
  const json settings{
      {"quality", "draft"}, {"elements", 1000}, {"rays", 16}, {"samples", 1}, {"size", "24x16"}};
  std::ofstream(folder_ / "jobs.json")
      << json{{"jobs", {{{"scenes", "room.glb"}, {"settings", settings}, {"outputs", "b.exr"}}}}};
  ASSERT_EQ(run({"batch", "jobs.json", "-o", "out", "--quiet"}).code, 0);
  EXPECT_EQ(read_file(folder_ / "out/b.exr"), picture({"--elements", "1000"}));
  const json schema = json::parse(run({"batch", "--schema"}).out);
  EXPECT_TRUE(schema["$defs"]["settings"]["properties"].contains("elements"));

  std::ofstream(folder_ / "cases.json") << json{{"cases",
                                                 {{{"name", "room"},
                                                   {"scene", "room.glb"},
                                                   {"settings", settings},
                                                   {"reference", "out/b.exr"},
                                                   {"limits", {{"max_abs", 0.0}}}}}}};
  EXPECT_EQ(run({"regress", "cases.json", "-o", "failures", "--quiet"}).code, 0);
}

} // namespace
} // namespace meninas::test
