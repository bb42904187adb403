// What readers of a board get: the newest of everything, and light as differences that add up to it.
#include "runs/live/live_board.h"
#include "runs/live/scene_watch.h"
#include "runs/live/shot_steps.h"
#include "tests/runs/live/live_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

namespace meninas {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;

LiveLight light_of(float brightness, std::size_t vertices = 1000) {
  LiveLight light;
  for (std::size_t v = 0; v < vertices; ++v)
    light.irradiance.emplace_back(brightness * (1.0F + 0.001F * float(v)), brightness, 0.0F);
  return light;
}

TEST(LiveBoard, DifferencesAddUpToTheWhole) {
  LiveBoard board;
  EXPECT_EQ(board.light(0), nullptr);
  board.show_room("{}", Point3(0.0), light_of(1.0F));
  const Message first = read(*board.light(0));
  EXPECT_EQ(first.head.at("base"), 0);
  LiveLight brighter = light_of(1.0F);
  brighter.irradiance[17] = glm::vec3(1.75F, 2.0F, 0.25F);
  brighter.ambient = Rgb(0.5);
  board.show_light(brighter);
  const std::string change = *board.light(first.head.at("state")), whole = *board.light(0);
  const Message changed = read(change, &first), all = read(whole);
  EXPECT_EQ(changed.head.at("base"), first.head.at("state"));
  EXPECT_EQ(changed.bits, all.bits);
  EXPECT_NE(changed.bits, first.bits);
  EXPECT_LT(change.size(), whole.size());
  EXPECT_EQ(all.head.at("ambient"), (json{0.5, 0.5, 0.5}));
}

// Halves of one scale hold a factor of a hundred; beyond that, and after states that are kept no more, all is sent.
TEST(LiveBoard, WhoIsTooLateGetsAllOfIt) {
  LiveBoard board;
  board.show_room("{}", Point3(0.0), light_of(1.0F));
  const std::uint64_t first = read(*board.light(0)).head.at("state");
  board.show_light(light_of(1e6F));
  const Message bright = read(*board.light(first));
  EXPECT_EQ(bright.head.at("base"), 0);
  EXPECT_NEAR(bright.head.at("top").get<double>(), 1e6, 1e6);
  for (int k = 0; k < 20; ++k)
    board.show_light(light_of(1e6F + float(k)));
  EXPECT_EQ(read(*board.light(bright.head.at("state"))).head.at("base"), 0);
}

TEST(LiveBoard, ReadersAreToldTheNewestOnce) {
  LiveBoard board;
  std::uint64_t seen = 0;
  EXPECT_FALSE(board.next(seen, milliseconds(1)));
  for (int k = 1; k <= 5; ++k)
    board.change_status([&](LiveStatus& status) { status.shots = k; });
  const auto told = board.next(seen, milliseconds(1));
  ASSERT_TRUE(told);
  EXPECT_EQ(json::parse(*told).at("shots"), 5);
  EXPECT_FALSE(board.next(seen, milliseconds(1)));
}

TEST(ShotSteps, WaitForEachStepUntilTheyGoOn) {
  ShotSteps steps(true);
  std::atomic<int> made{0};
  std::atomic<bool> over{false};
  std::thread solver([&] {
    while (made < 4) {
      steps.wait([&] { return over.load(); });
      ++made;
    }
  });
  steps.step();
  steps.step();
  while (made < 2)
    std::this_thread::yield();
  EXPECT_EQ(made, 2);
  EXPECT_TRUE(steps.paused());
  steps.pause(false);
  solver.join();
  EXPECT_EQ(made, 4);
}

// Also where that was asked for just before it waits.
TEST(ShotSteps, EndWhenTheOtherSolverIsAskedFor) {
  ShotSteps steps(true);
  steps.gather(true);
  steps.wait([] { return false; }, false);
  EXPECT_TRUE(steps.paused());
  steps.step();
  steps.wait([] { return false; }, true);
}

TEST(ShotSteps, EndWhenTheStageIsOver) {
  ShotSteps steps(true);
  steps.wait([] { return true; });
  EXPECT_TRUE(steps.paused());
}

TEST(SceneWatch, KnowsTheFilesAScenesJsonNames) {
  const auto folder = std::filesystem::temp_directory_path() / "meninas-files-of-scene";
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "a.gltf") << R"({"buffers": [{"uri": "a%20b.bin"}, {"uri": "data:,x"}], "images": [{"uri": "c.png"}, {"bufferView": 0}, 7], "x": 1})";
  RunSettings settings;
  settings.environment.file = "sky.exr";
  EXPECT_THAT(files_of_scene(folder / "a.gltf", settings),
              testing::UnorderedElementsAre("sky.exr", folder / "a.gltf", folder / "a b.bin", folder / "c.png"));
  std::ofstream(folder / "a.gltf") << "nonsense";
  EXPECT_THAT(files_of_scene(folder / "a.gltf", {}), testing::ElementsAre(folder / "a.gltf"));
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace meninas
