#include "tests/cli/program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace meninas::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "meninas-cli-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("no temporary folder");
  }
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

static std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return result + "'";
}

std::string test_name(std::string scene) {
  std::erase_if(scene, [](char c) { return c == '-' || c == '.'; });
  return scene;
}

Outcome run_program(const fs::path& folder, const std::vector<std::string>& arguments) {
  return run_other_program(MENINAS_PROGRAM, folder, arguments);
}

Outcome run_other_program(const fs::path& program, const fs::path& folder,
                          const std::vector<std::string>& arguments) {
  const TemporaryFolder streams;
  std::string command = "cd " + quoted(folder.string()) + " && " + quoted(program.string());
  for (const std::string& argument : arguments) {
    command += ' ' + quoted(argument);
  }
  command += " >" + quoted((streams / "out").string()) + " 2>" + quoted((streams / "err").string());
  const int status = std::system(command.c_str());
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = read_file(streams / "out"),
          .err = read_file(streams / "err")};
}

RunningProgram::RunningProgram(const fs::path& folder, const std::vector<std::string>& arguments)
    : streams_(std::make_unique<TemporaryFolder>()) {
  const std::string out = (*streams_ / "out").string(), err = (*streams_ / "err").string();
  std::vector<char*> words{const_cast<char*>(MENINAS_PROGRAM)};
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  process_ = fork();
  if (process_ == 0) {
    const bool ready = chdir(folder.c_str()) == 0 && std::freopen(out.c_str(), "w", stdout) &&
                       std::freopen(err.c_str(), "w", stderr);
    if (ready) {
      execv(words.front(), words.data());
    }
    _exit(127);
  }
}

RunningProgram::RunningProgram(RunningProgram&& other) noexcept
    : streams_(std::move(other.streams_)), process_(std::exchange(other.process_, -1)) {}

RunningProgram::~RunningProgram() {
  if (process_ > 0) {
    send(SIGKILL);
    outcome();
  }
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

std::string RunningProgram::out() const { return read_file(*streams_ / "out"); }

Outcome RunningProgram::outcome() {
  int status = 0;
  waitpid(std::exchange(process_, -1), &status, 0);
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = read_file(*streams_ / "out"),
          .err = read_file(*streams_ / "err")};
}

std::string without_progress(const std::string& err) {
  static const std::regex progress_line("meninas: ([0-9]+ %[^\n]*: [a-z ]+|.*: ([0-9]+x[0-9]+|[0-9]+ elements) in [0-9.]+ s[^\n]*)\n");
  return std::regex_replace(err, progress_line, "");
}

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

} // namespace meninas::test
