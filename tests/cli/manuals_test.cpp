// Manual pages and completions of shells: that they have every option, and that what reads them is content.
// Which options there are is what --help-all says, which another test compares with the options themselves.
#include "tests/cli/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// The commands, as `meninas -h` lists them, and the options of each.
std::map<std::string, std::vector<std::string>> options_of_commands() {
  const TemporaryFolder folder;
  std::map<std::string, std::vector<std::string>> options;
  const std::string page = run_program(folder.path(), {"help", "--markdown"}).out;
  const std::regex heading("## meninas ([a-z]+)\n"), line("\n  (-[^ ].*)"),
      name("(^|, )(--?[a-z][a-z-]*)");
  for (std::sregex_iterator at(page.begin(), page.end(), heading), end; at != end; ++at) {
    const std::string command = (*at)[1];
    const std::string help = run_program(folder.path(), {command, "--help-all"}).out;
    for (std::sregex_iterator one(help.begin(), help.end(), line); one != end; ++one) {
      const std::string entry = (*one)[1];
      for (std::sregex_iterator word(entry.begin(), entry.end(), name); word != end; ++word)
        options[command].push_back((*word)[2]);
    }
  }
  return options;
}

bool is_there(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

Outcome run_script(const TemporaryFolder& folder, const std::string& shell,
                   const std::string& script) {
  std::ofstream(folder / "script") << script;
  return run_other_program("/usr/bin/env", folder.path(), {shell, (folder / "script").string()});
}

std::string without_backslashes(std::string text) {
  std::erase(text, '\\');
  return text;
}

class Manuals : public testing::Test {
protected:
  std::string page(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "help");
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }

  void write(const std::string& file, const std::string& text) {
    std::ofstream(folder_ / file) << text;
  }

  TemporaryFolder folder_;
  const std::map<std::string, std::vector<std::string>> options_ = options_of_commands();
};

TEST_F(Manuals, HaveEveryOptionOfEveryCommand) {
  ASSERT_EQ(options_.size(), 13U);
  const std::string program = page({"--man"});
  for (const auto& [command, options] : options_) {
    EXPECT_THAT(program, HasSubstr(".BR meninas\\-" + command + " (1)\n"))
        << "of the program's page";
    ASSERT_GT(options.size(), 3U) << command;
    const std::string manual = without_backslashes(page({"--man", command}));
    EXPECT_THAT(manual, HasSubstr(".SH NAME\nmeninas-" + command + " - "));
    for (const std::string& option : options)
      EXPECT_THAT(manual, HasSubstr("fB" + option + "fR")) << command;
  }
}

// groff is what man(1) calls; -Tascii has the fewest signs.
TEST_F(Manuals, GroffHasNothingToWarnAbout) {
  if (!is_there("groff"))
    GTEST_SKIP() << "no groff here: manual pages are not set";
  std::vector<std::vector<std::string>> pages{{"--man"}};
  for (const auto& [command, options] : options_)
    pages.push_back({"--man", command});
  for (const std::vector<std::string>& one : pages) {
    write("page.1", page(one));
    for (const char* device : {"-Tascii", "-Tutf8"}) {
      const Outcome set = run_other_program("/usr/bin/env", folder_.path(),
                                            {"groff", "-man", "-ww", device, "page.1"});
      EXPECT_THAT(set.err, IsEmpty()) << one.back();
      EXPECT_THAT(set.out, HasSubstr("Failed write or exhausted resource."));
    }
  }
}

TEST_F(Manuals, MarkupOfMarkdownIsNotLeftInThem) {
  for (const auto& [command, options] : options_) {
    const std::string manual = page({"--man", command});
    EXPECT_THAT(manual.substr(manual.find('\n')), Not(HasSubstr("`"))) << command;
    EXPECT_THAT(manual, Not(HasSubstr("]("))) << command;
  }
}

TEST_F(Manuals, ACommandOrShellThatIsNotThereIsRefused) {
  const Outcome command = run_program(folder_.path(), {"help", "--man", "rendre"});
  EXPECT_EQ(command.code, 2);
  EXPECT_EQ(command.err, "meninas: no command 'rendre', did you mean 'render'?\n");
  const Outcome shell = run_program(folder_.path(), {"help", "--completion", "tcsh"});
  EXPECT_EQ(shell.code, 2);
  EXPECT_THAT(shell.err, HasSubstr("bash"));
}

class Completions : public Manuals {
protected:
  Completions() {
    for (const char* file : {"room one.gltf", "jobs.json", "notes.txt"})
      write(file, "");
  }

  /// The words that a line becomes when bash itself, typed at, is given the tabulator.
  std::string by_bash(const std::string& line) {
    write("meninas.bash", page({"--completion", "bash"}));
    const Outcome typed =
        run_script(folder_, "bash",
                   "printf 'PS1=\\nsource ./meninas.bash\\n"
                   "meninas() { printf \"got\" >&2; printf \"<%%s>\" \"$@\" >&2; echo >&2; }\\n"
                   "%s\\t\\n' '" +
                       line + "' | TERM=dumb INPUTRC=/dev/null HISTFILE= setsid --wait bash --norc -i 2>&1");
    std::smatch words;
    return std::regex_search(typed.out, words, std::regex("\ngot(<[^\r\n]*>)")) ? words[1].str()
                                                                                : typed.out;
  }
};

TEST_F(Completions, HaveEveryOptionOfEveryCommand) {
  const std::string bash = page({"--completion", "bash"}), zsh = page({"--completion", "zsh"}),
                    fish = page({"--completion", "fish"});
  for (const auto& [command, options] : options_) {
    const auto section = [&](const std::string& script, const std::string& begin,
                             const std::string& end) {
      const auto from = script.find(begin);
      EXPECT_NE(from, std::string::npos) << command;
      return script.substr(from, script.find(end, from) - from);
    };
    const std::string of_bash = section(bash, "\n    " + command + ")\n", "case $before") + ' ';
    const std::string of_zsh = section(zsh, "\n    " + command + ")\n", ";;");
    const std::string of_fish =
        section(fish, "\ncomplete -c meninas -n '__meninas_is " + command, "\n\n");
    for (const std::string& option : options) {
      EXPECT_THAT(of_bash, testing::ContainsRegex("[ ']" + option + "[ ']"));
      EXPECT_THAT(of_zsh, testing::ContainsRegex("[)*]" + option + "(\\[|=|\\+)"));
      const std::string bare = option.substr(option.find_first_not_of('-'));
      EXPECT_THAT(of_fish, HasSubstr((option.starts_with("--") ? " -l " : " -s ") + bare + ' '));
    }
  }
}

TEST_F(Completions, OfBashCompleteACommandAnOptionAChoiceAndAFile) {
  EXPECT_EQ(by_bash("meninas ren"), "<render>");
  EXPECT_EQ(by_bash("meninas help form"), "<help><formfactors>");
  EXPECT_EQ(by_bash("meninas render --qual"), "<render><--quality>");
  EXPECT_EQ(by_bash("meninas render --quality dr"), "<render><--quality><draft>");
  EXPECT_EQ(by_bash("meninas render --quality=dr"), "<render><--quality=draft>");
  EXPECT_EQ(by_bash("meninas solve r"), "<solve><room one.gltf>");
  EXPECT_EQ(by_bash("meninas solve room\\ o"), "<solve><room one.gltf>");
  EXPECT_EQ(by_bash("meninas r.glb --mod"), "<r.glb><--mode>") << "a scene by itself is rendered";
  EXPECT_EQ(by_bash("meninas batch j"), "<batch><jobs.json>");
  EXPECT_EQ(by_bash("meninas solve r.gltf --stats not"), "<solve><r.gltf><--stats><notes.txt>");
  EXPECT_EQ(by_bash("meninas render --seed no"), "<render><--seed><no>") << "a number is no file";
}

TEST_F(Completions, OfFishCompleteThem) {
  if (!is_there("fish"))
    GTEST_SKIP() << "no fish here: its completions are not tried";
  write("meninas.fish", page({"--completion", "fish"}));
  const auto completed = [&](const std::string& line) {
    const Outcome outcome =
        run_script(folder_, "fish", "source ./meninas.fish; complete -C '" + line + "'");
    EXPECT_THAT(outcome.err, IsEmpty());
    std::vector<std::string> words;
    std::istringstream lines(outcome.out);
    for (std::string one; std::getline(lines, one);)
      words.push_back(one.substr(0, one.find('\t')));
    return words;
  };
  EXPECT_THAT(completed("meninas ren"), ElementsAre("render"));
  EXPECT_THAT(completed("meninas render --qual"), ElementsAre("--quality"));
  EXPECT_THAT(completed("meninas render --quality dr"), ElementsAre("draft"));
  EXPECT_THAT(completed("meninas solve roo"), ElementsAre("room one.gltf"));
  EXPECT_THAT(completed("meninas batch jo"), ElementsAre("jobs.json"));
  EXPECT_THAT(completed("meninas r.glb --mod"), ElementsAre("--mode"));
}

TEST_F(Completions, OfZshAreReadByIt) {
  if (!is_there("zsh"))
    GTEST_SKIP() << "no zsh here: its completions are not read";
  write("_meninas", page({"--completion", "zsh"}));
  const Outcome outcome =
      run_other_program("/usr/bin/env", folder_.path(), {"zsh", "-fn", "_meninas"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
}

} // namespace
} // namespace meninas::test
