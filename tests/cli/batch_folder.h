// A folder with a tiny room and jobs that render it in no time,
// for tests of `batch` with real processes.
#pragma once

#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace meninas::test {

using Json = nlohmann::ordered_json; // keeps the order in which settings are given

/// An orbit in front of the room: as many pictures of one solution.
Json orbit(int frames);

class BatchTest : public testing::Test {
protected:
  /// `room.glb` is there, with a second camera named `side`.
  BatchTest();

  /// Jobs with small settings as their defaults.
  void write_jobs(const std::vector<Json>& jobs, const std::string& file = "jobs.json");
  /// `batch jobs.json -o out ARGUMENTS`
  Outcome batch(std::vector<std::string> arguments = {});
  RunningProgram begin_batch(std::vector<std::string> arguments = {});
  /// Until one is being made in `out`.
  void wait_for_a_picture();
  Json summary(const std::string& output = "out");
  /// The pictures in a folder, by name.
  std::map<std::string, std::string> pictures(const std::string& output = "out");
  void brighten_lamp();

  TemporaryFolder folder_;
};

} // namespace meninas::test
