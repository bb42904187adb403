#include "tests/cli/batch_folder.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

namespace meninas::test {

namespace fs = std::filesystem;

static TinyRoom room_with_two_cameras() {
  TinyRoom room = tiny_room();
  room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size());
  room.root["nodes"].push_back({{"name", "side"}, {"camera", 0}, {"translation", {0.7, 0.4, 2.0}}});
  return room;
}

Json orbit(int frames) {
  return {{"orbit", {{"centre", {0.5, 0.5, 0.5}}, {"radius", 2.0}, {"from", -40}, {"to", 40}}},
          {"frames", frames}};
}

BatchTest::BatchTest() { write_room(folder_ / "room.glb", room_with_two_cameras()); }

void BatchTest::write_jobs(const std::vector<Json>& jobs, const std::string& file) {
  const Json settings{{"element-size", 0.25}, {"rays", 16}, {"size", "24x16"}, {"samples", 1}};
  std::ofstream(folder_ / file) << Json{
      {"defaults", {{"settings", settings}}},
      {"jobs", jobs}}.dump(1);
}

static std::vector<std::string> whole_command(std::vector<std::string> arguments) {
  const auto names = [&](const std::string& option) {
    return std::ranges::find(arguments, option) != arguments.end();
  };
  if (!names("-o")) {
    arguments.insert(arguments.begin(), {"-o", "out"});
  }
  arguments.insert(arguments.begin(), {"batch", "jobs.json"});
  return arguments;
}

Outcome BatchTest::batch(std::vector<std::string> arguments) {
  return run_program(folder_.path(), whole_command(std::move(arguments)));
}

RunningProgram BatchTest::begin_batch(std::vector<std::string> arguments) {
  return RunningProgram(folder_.path(), whole_command(std::move(arguments)));
}

void BatchTest::wait_for_a_picture() {
  const fs::path locks = folder_ / "out" / ".meninas" / "locks";
  while (!fs::exists(locks) || files_in(locks).empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

Json BatchTest::summary(const std::string& output) {
  return Json::parse(read_file(folder_ / output / "summary.json"));
}

std::map<std::string, std::string> BatchTest::pictures(const std::string& output) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / output)) {
    const auto extension = entry.path().extension();
    if (extension == ".exr" || extension == ".png") {
      found[fs::relative(entry.path(), folder_ / output).string()] = read_file(entry.path());
    }
  }
  return found;
}

void BatchTest::brighten_lamp() {
  TinyRoom room = room_with_two_cameras();
  room.root["materials"][1]["emissiveFactor"] = {0.5, 0.5, 0.5};
  write_room(folder_ / "room.glb", room);
}

} // namespace meninas::test
