// What the program says of itself.
#include "tests/cli/program.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace meninas::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Help, ListsEveryOptionOfItsCommand) {
  const TemporaryFolder folder;
  const std::vector<std::string> pass_one{
      "--elements",    "--element-size", "--form-factors",  "--rays",    "--solver",
      "--tolerance",   "--mirror-depth", "--interpolation", "--quality", "--threads",
      "--seed",        "--quiet",        "--stats",         "--output",  "--adaptive",
      "--no-adaptive", "--bends"};
  std::map<std::string, std::vector<std::string>> options{
      {"render", pass_one},
      {"solve", pass_one},
      {"plan", {"--json", "--quality", "--element-size", "--elements"}}};
  for (const char* option :
       {"--samples", "--size", "--camera", "--exposure", "--mode", "--layers", "--solution"}) {
    options["render"].emplace_back(option);
  }
  options["solve"].emplace_back("--per-node");
  for (const auto& [command, names] : options) {
    const Outcome outcome = run_program(folder.path(), {command, "--help-all"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, IsEmpty());
    for (const std::string& name : names) {
      EXPECT_THAT(outcome.out, HasSubstr(name)) << command;
    }
  }
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"-h"}, std::vector<std::string>{"help"}, {}}) {
    const Outcome outcome = run_program(folder.path(), asked);
    EXPECT_EQ(outcome.code, 0);
    for (const char* command : {"render", "solve", "plan", "--version"}) {
      EXPECT_THAT(outcome.out, HasSubstr(command));
    }
  }
  for (const char* asked : {"--version", "version"}) {
    EXPECT_THAT(run_program(folder.path(), {asked}).out,
                testing::MatchesRegex("meninas [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  }
}

TEST(Help, ShowsWhatMattersFirst) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"render", "-h"}, std::vector<std::string>{"help", "render"}}) {
    const Outcome few = run_program(folder.path(), asked);
    EXPECT_THAT(few.out, HasSubstr("--quality"));
    EXPECT_THAT(few.out, HasSubstr("--output"));
    EXPECT_THAT(few.out, HasSubstr("--help-all"));
    EXPECT_THAT(few.out, Not(HasSubstr("--hemicube-resolution")));
  }
}

const std::vector<std::string> commands{"render", "solve",   "plan",  "compare",    "batch",
                                        "diff",   "regress", "trade", "formfactors", "walk", "bake",
                                        "merge",  "view"};

TEST(Help, ShowsTenOptionsAtMost) {
  const TemporaryFolder folder;
  for (const std::string& command : commands) {
    const std::string page = run_program(folder.path(), {command, "-h"}).out;
    std::istringstream lines(page);
    int options = 0;
    for (std::string line; std::getline(lines, line);)
      options += line.starts_with("  -") && !line.starts_with("  -h,");
    EXPECT_GE(options, 3) << page;
    EXPECT_LE(options, 10) << page;
  }
}

/// A line that goes on begins where the second column does.
TEST(Help, GivesAnOptionOneLineOf80Columns) {
  const TemporaryFolder folder;
  setenv("COLUMNS", "80", 1);
  std::vector<std::vector<std::string>> pages{{"-h"}};
  for (const std::string& command : commands)
    pages.push_back({command, "-h"});
  for (const std::vector<std::string>& asked : pages) {
    std::istringstream lines(run_program(folder.path(), asked).out);
    int entries = 0;
    for (std::string line; std::getline(lines, line);) {
      EXPECT_FALSE(line.starts_with(std::string(26, ' '))) << asked.front() << ": goes on: " << line;
      EXPECT_LE(line.size(), 80u) << asked.front() << ": " << line;
      entries += line.size() > 26 && line[25] == ' ' && line[26] != ' ' ? 1 : 0;
    }
    EXPECT_GE(entries, 3) << asked.front() << ": names and texts stand in two columns no more";
  }
  unsetenv("COLUMNS");
}

TEST(Help, FitsTheTerminal) {
  const TemporaryFolder folder;
  for (const std::string width : {"80", "100"}) {
    setenv("COLUMNS", width.c_str(), 1);
    for (const std::string& command : commands) {
      std::istringstream lines(run_program(folder.path(), {command, "--help-all"}).out);
      for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), std::stoul(width)) << command << ": " << line;
      }
    }
  }
  unsetenv("COLUMNS");
}

/// Entries of each group of --help-all, in the order of the page.
std::vector<std::pair<std::string, int>> groups_of(const std::string& command) {
  const TemporaryFolder folder;
  std::istringstream lines(run_program(folder.path(), {command, "--help-all"}).out);
  std::vector<std::pair<std::string, int>> groups;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(':') && !line.starts_with(' ') && line != "Examples:")
      groups.emplace_back(line, 0);
    else if (!groups.empty() && line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
      ++groups.back().second;
  }
  return groups;
}

TEST(Help, PutsOptionsOfManyCommandsIntoGroupsOfTheirOwn) {
  for (const std::string& command : commands) {
    const auto groups = groups_of(command);
    ASSERT_FALSE(groups.empty()) << command;
    EXPECT_EQ(groups.front().first, "Options:") << command;
    EXPECT_LE(groups.front().second, 13) << command;
    const auto study = std::ranges::find(groups, "For study:", &std::pair<std::string, int>::first);
    EXPECT_TRUE(study == groups.end() || study + 1 == groups.end()) << command << ": what study needs comes last";
  }
  std::vector<std::string> of_solve;
  for (const auto& [name, entries] : groups_of("solve"))
    of_solve.push_back(name);
  EXPECT_THAT(of_solve, testing::ElementsAre("Options:", "Numbers at points:", "Accuracy of pass one:", "Light:", "Sky:",
                                             "File:", "Run:", "For study:"));
}

TEST(Help, BeginsWithExamples) {
  const TemporaryFolder folder;
  for (const std::string& command : commands) {
    const std::string page = run_program(folder.path(), {command, "-h"}).out;
    const auto example = page.find("Examples:\n  meninas " + command);
    ASSERT_NE(example, std::string::npos) << command;
    EXPECT_LT(example, page.find("Options:")) << command;
  }
}

TEST(Help, IsTheCommittedPageOfOptions) {
  const TemporaryFolder folder;
  const std::string page = run_program(folder.path(), {"help", "--markdown"}).out;
  EXPECT_TRUE(page == read_file(source_dir() + "/docs/options.md"))
      << "make it anew: meninas help --markdown > docs/options.md";
}

TEST(FirstRoom, IsTheFileBesideItsPageAndHasNothingOdd) {
  const std::string file = source_dir() + "/docs/first-room.gltf";
  EXPECT_THAT(read_file(source_dir() + "/docs/first-room.md"),
              HasSubstr("```json\n" + read_file(file) + "```"));
  const TemporaryFolder folder;
  const Outcome plan = run_program(folder.path(), {"plan", file});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("emitters          1 face glows"));
  for (const char* trouble : {"ignored", "warnings", "odd"})
    EXPECT_THAT(plan.out, Not(HasSubstr(trouble)));
}

} // namespace
} // namespace meninas::test
