// `batch`: frames of the file's own animation.
#include "tests/cli/batch_folder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

namespace meninas::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A room in which nodes of those names rise by an eighth of a metre in a second.
void write_moving_room(const std::filesystem::path& file, const std::vector<std::string>& names) {
  TinyRoom room = tiny_room();
  auto& root = room.root;
  const auto times = add_floats(room, {0, 1}, "SCALAR", 1);
  root["animations"] = nlohmann::json::array({{{"channels", nlohmann::json::array()},
                                               {"samplers", nlohmann::json::array()}}});
  auto& animation = root["animations"][0];
  for (std::size_t node = 0; node < root["nodes"].size(); ++node) {
    if (std::ranges::find(names, root["nodes"][node]["name"].get<std::string>()) == names.end())
      continue;
    const auto at = root["nodes"][node].value("translation", std::vector<float>{0, 0, 0});
    const auto places =
        add_floats(room, {at[0], at[1], at[2], at[0], at[1] + 0.125F, at[2]}, "VEC3", 3);
    animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                     {"target", {{"node", node}, {"path", "translation"}}}});
    animation["samplers"].push_back({{"input", times}, {"output", places}});
  }
  write_room(file, room);
}

class BatchFrames : public BatchTest {
protected:
  std::string rendered_at(const std::string& seconds) {
    const Outcome outcome = run_program(
        folder_.path(), {"render", "room.glb", "-o", "a.exr", "--element-size", "0.25", "--rays",
                         "16", "--size", "24x16", "--samples", "1", "--quiet", "--at", seconds});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_file(folder_ / "a.exr");
  }

  /// What is solved by the last run, and how often.
  std::size_t solves() { return summary()["solves"].size(); }
};

Json frames(double to) {
  return {{"scenes", "room.glb"},
          {"at", {{"to", to}, {"fps", 2}}},
          {"outputs", "{camera}/{frame}.exr"}};
}

TEST_F(BatchFrames, OfACameraThatMovesShareOneSolve) {
  write_moving_room(folder_ / "room.glb", {"camera"});
  write_jobs({frames(1.0)});
  const Outcome outcome = batch();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(solves(), 1U);
  const auto made = pictures();
  ASSERT_EQ(made.size(), 3U);
  EXPECT_EQ(made.at("camera/0000.exr"), rendered_at("0"));
  EXPECT_EQ(made.at("camera/0001.exr"), rendered_at("0.5"));
  EXPECT_EQ(made.at("camera/0002.exr"), rendered_at("1"));
  EXPECT_NE(made.at("camera/0000.exr"), made.at("camera/0001.exr"));
  const Json last = summary()["pictures"][2];
  EXPECT_EQ(last["frame"], 2);
  EXPECT_EQ(last["at"], 1.0);
}

TEST_F(BatchFrames, OfALampThatMovesAreSolvedOneByOne) {
  write_moving_room(folder_ / "room.glb", {"camera", "lamp"});
  Json job = frames(0.0);
  job["at"] = {0.5, 0.25, 0.5};
  write_jobs({job});
  ASSERT_EQ(batch().code, 0);
  EXPECT_EQ(solves(), 2U) << "of which two have the same time";
  const auto made = pictures();
  EXPECT_EQ(made.at("camera/0000.exr"), rendered_at("0.5"));
  EXPECT_EQ(made.at("camera/0001.exr"), rendered_at("0.25"));
  EXPECT_EQ(made.at("camera/0002.exr"), made.at("camera/0000.exr"));
}

TEST_F(BatchFrames, AreResumed) {
  write_moving_room(folder_ / "room.glb", {"camera"});
  write_jobs({frames(0.5)});
  ASSERT_EQ(batch().code, 0);
  write_jobs({frames(1.5)});
  ASSERT_EQ(batch({"--resume"}).code, 0);
  EXPECT_EQ(summary()["counts"]["found"], 2);
  EXPECT_EQ(summary()["counts"]["made"], 2);
  EXPECT_EQ(solves(), 1U);
  EXPECT_EQ(summary()["solves"][0]["solved"], false) << "what is lit is as it was";
}

TEST_F(BatchFrames, GoSideBySideWithAPath) {
  write_moving_room(folder_ / "room.glb", {"lamp"});
  Json job = frames(1.0);
  job["cameras"] = {orbit(3), "camera"};
  write_jobs({job});
  const Outcome outcome = batch();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(pictures().size(), 6U);
  EXPECT_EQ(solves(), 3U);
  job["cameras"] = orbit(4);
  write_jobs({job});
  EXPECT_THAT(batch().err, AllOf(HasSubstr("/jobs/0/cameras: has 4 frames, but 'at' has 3")));
}

TEST_F(BatchFrames, MistakesAreNamedByTheirPlace) {
  Json job = frames(-1.0);
  write_jobs({job});
  EXPECT_THAT(batch().err, HasSubstr("/jobs/0/at: ends at -1, before it begins at 0"));
  job = frames(1e9);
  write_jobs({job});
  EXPECT_THAT(batch().err, HasSubstr("/jobs/0/at: asks for 2e+09 frames"));
  job = frames(1.0);
  job["settings"]["at"] = 0.5;
  write_jobs({job});
  EXPECT_THAT(batch().err, HasSubstr("/jobs/0/settings/at: the job has an 'at' of its own"));
  job = frames(1.0);
  job["at"]["fps"] = 0;
  write_jobs({job});
  EXPECT_EQ(batch().code, 3);
}

} // namespace
} // namespace meninas::test
