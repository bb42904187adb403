// `view` by plain requests: who may ask, that the last state is the solution of `solve` and its pictures those of `render`,
// how shots go on, that the room follows its file, and that nothing is left behind.
#include "tests/cli/tiny_room.h"
#include "tests/cli/view_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class View : public testing::Test {
protected:
  void SetUp() override { write_room(folder_ / "room.glb", tiny_room()); }
  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  TemporaryFolder folder_;
};

const std::string place = "viewer=a&number=1&exposure=1.5&size=48x36&eye=0.1,0.2,2.5&target=0,0,-0.5&angle=50";

TEST_F(View, OnlyWhoKnowsTheAddressIsAnswered) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  const std::string port = std::to_string(view.port());
  EXPECT_EQ(view.get("").status, 200);
  EXPECT_EQ(view.get("", {{"Host", "localhost:" + port}}).status, 200);
  EXPECT_EQ(view.get("", {{"Origin", "http://127.0.0.1:" + port}}).status, 200);
  EXPECT_EQ(view.get("nothing").status, 404);
  std::string wrong = view.base();
  wrong[5] = wrong[5] == 'a' ? 'b' : 'a';
  for (const std::string& path : {std::string("/"), wrong, wrong + "room", std::string("/events"), std::string("//room"),
                                  std::string("/../../etc/passwd"), view.base().substr(0, 20) + "/room"})
    EXPECT_EQ(view.ask("GET", path).status, 403) << path;
  for (const auto& [name, value] : {std::pair{"Host", "evil.example:" + port}, {"Host", std::string("127.0.0.1:1")}, {"Host", std::string("127.0.0.1")},
                                    {"Origin", std::string("http://evil.example")}, {"Origin", "https://127.0.0.1:" + port},
                                    {"Origin", std::string("null")}})
    for (const char* path : {"", "room", "events", "solution"})
      EXPECT_EQ(view.get(path, {{name, value}}).status, 403) << name << value << path;
  // What changes something says where it comes from.
  EXPECT_EQ(view.post("pause").status, 204);
  EXPECT_EQ(view.post("pause", {{"Accept", "*/*"}}).status, 403);
  EXPECT_EQ(view.post("pause", {{"Origin", "http://evil.example"}}).status, 403);
  EXPECT_EQ(view.get("pause").status, 404);
  EXPECT_EQ(view.ask("DELETE", view.base()).status, 403);
}

TEST_F(View, TheLastStateIsTheSolutionOfSolveToTheBit) {
  const std::vector<std::vector<std::string>> choices{{"--quality", "draft"},
                                                      {"--quality", "draft", "--solver", "progressive"},
                                                      {"--quality", "draft", "--mesh", "uniform", "--elements", "300", "--seed", "3"}};
  for (const auto& options : choices) {
    std::vector<std::string> solve{"solve", "room.glb", "-o", "s.glb"}, shown{"room.glb"};
    for (auto* words : {&solve, &shown})
      words->insert(words->end(), options.begin(), options.end());
    ASSERT_EQ(run(solve).code, 0);
    const ViewProgram view(folder_.path(), shown);
    ASSERT_TRUE(view.status_when_solved().is_object());
    EXPECT_TRUE(view.get("solution").body == read_file(folder_ / "s.glb")) << options.back();
  }
}

// With the line that the page shows beside them.
TEST_F(View, SavedPicturesAreThoseOfRenderToTheBit) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  ASSERT_TRUE(view.status_when_solved().is_object());
  for (const std::string& seen : {place, std::string("viewer=a&number=2&exposure=-0.75&size=40x30&camera=camera")}) {
    std::string line = view.get("command?" + seen + "&name=again").body;
    ASSERT_THAT(line, HasSubstr("meninas render room.glb"));
    std::vector<std::string> words;
    std::istringstream in(line.substr(line.find(' ') + 1));
    for (std::string word; in >> word;)
      words.push_back(word);
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << line << outcome.err;
    for (const std::string kind : {"exr", "png"}) {
      const Answer saved = view.get("save." + kind + "?" + seen);
      EXPECT_EQ(saved.status, 200);
      EXPECT_TRUE(saved.body == read_file(folder_ / ("again." + kind))) << line;
    }
  }
}

/// More patches than are solved for all views: small triangles above the floor, no two of them in one plane.
TinyRoom room_of_many_patches() {
  constexpr int side = 92;
  TinyRoom room = tiny_room();
  std::vector<float> points;
  for (int k = 0; k < side * side; ++k) {
    const float x = 0.1F + 0.8F * float(k % side) / side, z = -0.1F - 0.8F * float(k / side) / side, y = 0.02F + 1e-5F * float(k % 977);
    for (const float coordinate : {x, y, z, x, y + 1e-6F * float(k % 1009), z - 0.004F, x + 0.004F, y, z})
      points.push_back(coordinate);
  }
  const std::size_t accessor = add_floats(room, points, "VEC3", 3);
  room.root["accessors"][accessor]["min"] = {0.0, 0.0, -1.0};
  room.root["accessors"][accessor]["max"] = {1.0, 1.0, 0.0};
  room.root["meshes"].push_back({{"primitives", json::array({{{"attributes", {{"POSITION", accessor}}}}})}});
  room.root["nodes"].push_back({{"name", "many"}, {"mesh", room.root["meshes"].size() - 1}});
  room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size() - 1);
  return room;
}

// Their line solves first, into a file that is not the scene.
TEST_F(View, TheLineOfALargeRoomLeavesTheSceneAlone) {
  write_room(folder_ / "room.glb", room_of_many_patches());
  const std::string scene = read_file(folder_ / "room.glb");
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  ASSERT_TRUE(view.status_when_solved().is_object());
  const std::string line = view.get("command?" + place + "&name=room").body;
  ASSERT_THAT(line, HasSubstr(" && meninas render room.glb"));
  std::vector<std::string> words;
  std::istringstream in(line + " && ");
  for (std::string word; in >> word;) {
    if (word != "&&") {
      words.push_back(word);
      continue;
    }
    const Outcome outcome = run({words.begin() + 1, words.end()});
    ASSERT_EQ(outcome.code, 0) << line << outcome.err;
    words.clear();
  }
  EXPECT_TRUE(read_file(folder_ / "room.glb") == scene);
  EXPECT_TRUE(view.get("save.exr?" + place).body == read_file(folder_ / "room.exr"));
}

TEST_F(View, PicturesNobodyWantsAnyMoreAreLeftOut) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  EXPECT_TRUE(view.status_when_solved().is_object());
  EXPECT_EQ(view.get("picture?" + place + "&step=coarse").status, 200);
  EXPECT_EQ(view.post("moved?viewer=a&number=5").status, 204);
  EXPECT_EQ(view.get("picture?" + place + "&step=coarse").status, 204);
  EXPECT_EQ(view.get("picture?viewer=b" + place.substr(8) + "&step=whole").status, 200) << "another's camera has not moved";
  for (const std::string wrong : {"", "viewer=a&number=9&exposure=1&size=9999999x2&camera=camera", "viewer=a&number=9&exposure=nan&size=8x8&camera=camera",
                                  "viewer=a&number=9&exposure=1&size=8x8&camera=none", "viewer=a&number=9&exposure=1&size=8x8&eye=1,1,1&target=1,1,1&angle=40",
                                  "viewer=a&number=9&exposure=1&size=8x8&eye=1e30,1,1&target=1,1,2&angle=40",
                                  "viewer=a&number=9&exposure=1&size=8x8&eye=1,1,1&target=1,1,1.000000000001&angle=40",
                                  "viewer=a&number=9&exposure=1&size=8x8&eye=1,1,1&target=1,1,2&angle=0.001",
                                  "viewer=a&number=9&exposure=1&size=8x8&eye=1,1&target=1,1,2&angle=40"})
    EXPECT_EQ(view.get("picture?" + wrong + "&step=whole").status, 400) << wrong;
}

// Before the first shot it is dark; then comes the light of the lamps, and then a shot to a step.
TEST_F(View, ShotsGoOneByOneFromTheDark) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  const auto paused_at = [](int state) {
    return [state](const json& status) { return status.at("paused") == true && status.at("state") == state; };
  };
  const json dark = view.status_when(paused_at(1));
  ASSERT_TRUE(dark.is_object());
  EXPECT_EQ(dark.at("stage"), "dark");
  EXPECT_EQ(dark.at("solved"), false);
  ASSERT_EQ(view.post("step").status, 204);
  const json lit = view.status_when(paused_at(2));
  ASSERT_TRUE(lit.is_object());
  EXPECT_EQ(lit.at("shots"), 0);
  EXPECT_EQ(lit.at("unshot"), 1.0);
  ASSERT_EQ(view.post("step").status, 204);
  const json shot = view.status_when(paused_at(3));
  ASSERT_TRUE(shot.is_object());
  EXPECT_EQ(shot.at("shots"), 1);
  EXPECT_LT(shot.at("unshot").get<double>(), 1.0);
  ASSERT_EQ(view.post("go-on").status, 204);
  EXPECT_TRUE(view.status_when_solved().is_object());
}

TEST_F(View, ABrokenFileKeepsTheOldRoomAndAWholeOneIsShown) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  const json first = view.status_when_solved();
  ASSERT_TRUE(first.is_object());
  write("room.glb", "nonsense");
  const json broken = view.status_when([](const json& status) { return status.at("problem") != ""; });
  ASSERT_TRUE(broken.is_object());
  EXPECT_THAT(broken.at("problem").get<std::string>(), HasSubstr("room.glb"));
  EXPECT_EQ(broken.at("room"), first.at("room"));
  EXPECT_EQ(broken.at("solved"), true);
  TinyRoom brighter = tiny_room();
  brighter.root["nodes"][0]["name"] = "another";
  write_room(folder_ / "room.glb", brighter);
  const json again = view.status_when([&](const json& status) { return status.at("solved") == true && status.at("room") > first.at("room"); });
  ASSERT_TRUE(again.is_object());
  EXPECT_EQ(again.at("problem"), "");
  EXPECT_THAT(view.get("room").body, HasSubstr("another"));
}

TEST_F(View, AFolderInPlaceOfTheFileIsSaidAndTheOldRoomStays) {
  TinyRoom room = tiny_room(); // as text: a glb is not looked into for files beside it
  room.root["buffers"][0]["uri"] = "room.bin";
  room.root["buffers"][0]["byteLength"] = room.binary.size();
  write("room.bin", std::string(reinterpret_cast<const char*>(room.binary.data()), room.binary.size()));
  write("room.gltf", room.root.dump());
  const ViewProgram view(folder_.path(), {"room.gltf", "--quality", "draft"});
  ASSERT_TRUE(view.status_when_solved().is_object());
  std::filesystem::remove(folder_ / "room.gltf");
  std::filesystem::create_directory(folder_ / "room.gltf");
  const json broken = view.status_when([](const json& status) { return status.at("problem") != ""; });
  ASSERT_TRUE(broken.is_object());
  EXPECT_THAT(broken.at("problem").get<std::string>(), HasSubstr("not a file but a folder"));
  EXPECT_EQ(broken.at("solved"), true);
  EXPECT_EQ(view.get("picture?" + place + "&step=coarse").status, 200);
}

// Nothing is answered from the old room; and what is stopped before the shots is said to be so.
TEST_F(View, WhileAnotherRoomIsSolvedThereAreNoPictures) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  ASSERT_TRUE(view.status_when([](const json& status) { return status.at("stage") == "dark"; }).is_object());
  const auto expect_none = [&] {
    for (const std::string& path : {"picture?" + place + "&step=coarse", "save.png?" + place, "save.exr?" + place, "command?" + place, std::string("solution")}) {
      const Answer answer = view.get(path);
      EXPECT_EQ(answer.status, 503) << path;
      EXPECT_EQ(answer.body, "The room is not solved yet.\n") << path;
    }
  };
  expect_none();
  ASSERT_EQ(view.post("go-on").status, 204);
  const json first = view.status_when_solved();
  ASSERT_TRUE(first.is_object());
  EXPECT_EQ(first.at("paused"), false);
  EXPECT_EQ(view.get("solution").status, 200) << "from the moment on when it is said to be solved";
  ASSERT_EQ(view.post("pause").status, 204);
  EXPECT_EQ(view.status_when_solved().at("paused"), false) << "there is nothing to stop";
  TinyRoom other = tiny_room();
  other.root["nodes"][0]["name"] = "another";
  write_room(folder_ / "room.glb", other);
  const json again = view.status_when([&](const json& status) { return status.at("solved") == true && status.at("room") > first.at("room"); });
  ASSERT_TRUE(again.is_object());
  ASSERT_EQ(run({"solve", "room.glb", "--quality", "draft", "-o", "s.glb"}).code, 0);
  EXPECT_TRUE(view.get("solution").body == read_file(folder_ / "s.glb"));
}

TEST_F(View, ARoomThatCannotBeSolvedLeavesTheOldOneWithItsPictures) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--memory-limit", "100M"});
  const json first = view.status_when_solved();
  ASSERT_TRUE(first.is_object());
  write_room(folder_ / "room.glb", room_of_many_patches());
  const json refused = view.status_when([](const json& status) { return status.at("solved") == true && status.at("problem") != ""; });
  ASSERT_TRUE(refused.is_object());
  EXPECT_THAT(refused.at("problem").get<std::string>(), HasSubstr("more than the limit of 100 MiB"));
  EXPECT_EQ(refused.at("elements"), first.at("elements"));
  EXPECT_EQ(view.get("picture?" + place + "&step=coarse").status, 200);
}

TEST_F(View, ItEndsAtOnceAndLeavesNothingBehind) {
  ViewProgram view(folder_.path(), {"room.glb", "--quality", "fine"});
  EXPECT_EQ(view.get("").status, 200);
  const Outcome outcome = view.end();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(files_in(folder_.path()), ElementsAre("room.glb"));
  EXPECT_EQ(view.get("").status, 0) << "nobody listens";
}

TEST_F(View, WhatCannotBeShownIsSaidInOneLine) {
  const Outcome missing = run({"view", "none.glb"});
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("none.glb"));
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
  std::filesystem::create_directory(folder_ / "folder.gltf");
  const Outcome folder = run({"view", "folder.gltf"});
  EXPECT_EQ(folder.code, 3);
  EXPECT_EQ(folder.err, run({"solve", "folder.gltf", "-o", "s.glb"}).err);
  EXPECT_THAT(folder.err, HasSubstr("not a file but a folder"));
  for (const char* number : {"70000", "80", "1023"})
    EXPECT_EQ(run({"view", "room.glb", "--port", number}).code, 2) << number;
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  const std::string taken = std::to_string(view.port());
  const Outcome second = run({"view", "room.glb", "--port", taken});
  EXPECT_EQ(second.code, 4);
  EXPECT_EQ(second.err, "meninas: 127.0.0.1:" + taken + ": cannot listen: Address already in use\n");
}

// Whoever never reads, or leaves in the middle: others are told all the same.
TEST_F(View, WhoNeverReadsHoldsUpNobody) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "normal", "--paused"});
  const json dark = view.status_when([](const json& status) { return status.at("paused") == true; });
  ASSERT_TRUE(dark.is_object());
  const SilentReader events(view, "events"), room(view, "room"), solution(view, "light");
  // One that is told once, and leaves.
  EXPECT_TRUE(view.status_when([](const json&) { return true; }).is_object());
  ASSERT_EQ(view.post("go-on").status, 204);
  EXPECT_TRUE(view.status_when_solved().is_object());
}

} // namespace
} // namespace meninas::test
