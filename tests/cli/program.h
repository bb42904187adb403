// Running the real program, in a folder of its own, and looking at what it leaves there.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace meninas::test {

/// An empty folder that is gone when it is out of scope.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

struct Outcome {
  int code = -1; ///< exit code; 128 and more: ended by a signal
  std::string out;
  std::string err;
};

/// "meninas.gltf" as the name of a test: without dots and dashes.
std::string test_name(std::string scene);

/// Runs `meninas ARGUMENTS` with `folder` as its current folder.
Outcome run_program(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// The program, started and left to itself; killed when out of scope.
class RunningProgram {
public:
  RunningProgram(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~RunningProgram();
  RunningProgram(RunningProgram&& other) noexcept;

  void send(int signal) const;
  /// What it has printed so far.
  std::string out() const;
  /// Waits for its end.
  Outcome outcome();

private:
  std::unique_ptr<TemporaryFolder> streams_;
  int process_ = -1;
};

Outcome run_other_program(const std::filesystem::path& program, const std::filesystem::path& folder,
                          const std::vector<std::string>& arguments);

/// What was said apart from progress lines, which appear only where a machine is slow.
std::string without_progress(const std::string& err);

std::string read_file(const std::filesystem::path& file);

/// The names of everything in a folder, sorted.
std::vector<std::string> files_in(const std::filesystem::path& folder);

} // namespace meninas::test
