// `view` for teaching, by plain requests: form factors of an element, sweeps of gathering, the dark; and that a room whose
// light alone has changed is relit.
#include "tests/cli/tiny_room.h"
#include "tests/cli/view_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ViewTeaching : public testing::Test {
protected:
  void SetUp() override { write_room(folder_ / "room.glb", tiny_room()); }
  TemporaryFolder folder_;
};

/// What the message says of its numbers.
json head_of(const std::string& message) {
  if (message.size() < 4)
    return nullptr;
  std::size_t length = 0;
  for (unsigned k = 0; k < 4; ++k)
    length |= std::size_t{static_cast<unsigned char>(message[k])} << (8 * k);
  return json::parse(message.substr(4, length), nullptr, false);
}

// What mirrors reflect they absorb the rest of, and the open front lets out: all of a row is accounted for. Single precision.
TEST_F(ViewTeaching, FormFactorsOfAnElementAreAnswered) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  const json solved = view.status_when_solved();
  ASSERT_TRUE(solved.is_object());
  const std::string room = "factors?room=" + solved.at("room").dump();
  int rows = 0, with_mirror = 0;
  for (int element = 0; element < 200; element += 10) {
    const Answer answer = view.get(room + "&element=" + std::to_string(element));
    if (answer.status == 400 && answer.body.find("what mirrors") != std::string::npos)
      continue; // the mirror, a black back
    ASSERT_EQ(answer.status, 200) << answer.body;
    const json head = head_of(answer.body);
    ASSERT_TRUE(head.is_object());
    EXPECT_EQ(head.at("room"), solved.at("room"));
    double sum = 0.0;
    for (const char* part : {"direct", "mirrored", "escaped", "absorbed", "black"})
      sum += head.at(part).get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-4) << head;
    ++rows;
    with_mirror += head.at("mirrored") > 0.0 ? 1 : 0;
  }
  EXPECT_GT(rows, 10);
  EXPECT_GT(with_mirror, 3);
}

TEST_F(ViewTeaching, WhatIsNoElementIsRefusedInOneLine) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  const json dark = view.status_when([](const json& status) { return status.at("stage") == "dark"; });
  ASSERT_TRUE(dark.is_object());
  ASSERT_GT(dark.at("room"), 0) << "a stage is not told before its room is there";
  const std::string room = "factors?room=" + dark.at("room").dump();
  EXPECT_EQ(view.get(room + "&element=3").status, 200) << "in the dark as well";
  const auto expect_refused = [&](const std::string& path, int status) {
    const Answer answer = view.get(path);
    EXPECT_EQ(answer.status, status) << path << answer.body;
    EXPECT_EQ(std::count(answer.body.begin(), answer.body.end(), '\n'), 1) << path << answer.body;
  };
  for (const char* wrong : {"", "&element=", "&element=-1", "&element=1e3", "&element=99999999999999999999", "&element=3x", "&element=1000000000", "&element=18446744073709551615"})
    expect_refused(room + wrong, 400);
  expect_refused("factors", 400);
  expect_refused("factors?element=3", 400);
  expect_refused("factors?room=x&element=3", 400);
  expect_refused("factors?room=77&element=3", 503);
}

TEST_F(ViewTeaching, OnlyThePageItselfMayAskForThem) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  const json dark = view.status_when([](const json& status) { return status.at("stage") == "dark"; });
  ASSERT_TRUE(dark.is_object());
  const std::string path = "factors?room=" + dark.at("room").dump() + "&element=3", port = std::to_string(view.port());
  std::string wrong = view.base();
  wrong[5] = wrong[5] == 'a' ? 'b' : 'a';
  EXPECT_EQ(view.ask("GET", wrong + path).status, 403);
  EXPECT_EQ(view.ask("GET", "/" + path).status, 403);
  for (const auto& [name, value] : {std::pair{"Host", "evil.example:" + port}, {"Host", std::string("127.0.0.1:1")}, {"Origin", std::string("http://evil.example")}, {"Origin", std::string("null")}}) {
    EXPECT_EQ(view.get(path, {{name, value}}).status, 403) << name << value;
    for (const char* change : {"gather", "shoot"})
      EXPECT_EQ(view.post(change, {{name, value}}).status, 403) << name << value;
  }
  EXPECT_EQ(view.post(path).status, 404) << "nothing is changed by it";
  for (const char* change : {"gather", "shoot"}) {
    EXPECT_EQ(view.get(change).status, 404);
    EXPECT_EQ(view.post(change, {{"Accept", "*/*"}}).status, 403) << "it does not say where it comes from";
    EXPECT_EQ(view.ask("POST", wrong + change, {{"Origin", "http://127.0.0.1:" + port}}).status, 403);
  }
  EXPECT_EQ(view.status_when([](const json&) { return true; }).at("gathers"), false);
}

// From the dark again, each step a sweep; and the solution is what it would have been.
TEST_F(ViewTeaching, GatheringGoesSweepBySweep) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--steps", "0"});
  ASSERT_TRUE(view.status_when([](const json& status) { return status.at("stage") == "dark" && status.at("paused") == true; }).is_object());
  ASSERT_EQ(view.post("step").status, 204);
  ASSERT_TRUE(view.status_when([](const json& status) { return status.at("stage") == "shots"; }).is_object());
  ASSERT_EQ(view.post("gather").status, 204);
  ASSERT_TRUE(view.status_when([](const json& status) { return status.at("stage") == "dark" && status.at("gathers") == true; }).is_object());
  double change = 2.0;
  for (int sweep = 0; sweep < 4; ++sweep) {
    ASSERT_EQ(view.post("step").status, 204);
    const json state = view.status_when([&](const json& status) { return status.at("stage") == "sweeps" && status.at("shots") == sweep && status.at("unshot") != nullptr; });
    ASSERT_TRUE(state.is_object());
    EXPECT_LT(state.at("unshot").get<double>(), change) << "walls that reflect half halve it about";
    change = state.at("unshot");
  }
  ASSERT_EQ(view.post("go-on").status, 204);
  ASSERT_TRUE(view.status_when_solved().is_object());
  ASSERT_EQ(run_program(folder_.path(), {"solve", "room.glb", "--quality", "draft", "-o", "s.glb"}).code, 0);
  EXPECT_TRUE(view.get("solution").body == read_file(folder_ / "s.glb"));
}

/// The room after that of `before`, once it is solved. What it went through may be over before a page is told.
json next_solved(const ViewProgram& view, const json& before) {
  return view.status_when([&](const json& status) {
    return status.at("solved") == true && status.at("room") > before.at("room");
  });
}

TEST_F(ViewTeaching, ARoomOfWhichTheLightHasChangedIsRelitAndThenSolved) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--quality", "draft"}, {"--quality", "draft", "--mesh", "uniform", "--elements", "400"}}) {
    write_room(folder_ / "room.glb", tiny_room());
    std::vector<std::string> shown{"room.glb"}, solve{"solve", "room.glb", "-o", "s.glb"};
    for (auto* words : {&shown, &solve})
      words->insert(words->end(), options.begin(), options.end());
    const ViewProgram view(folder_.path(), shown);
    // Rows are assembled while nothing else is to do.
    const json first = view.status_when([](const json& status) { return status.at("keepsRows") == true; });
    ASSERT_TRUE(first.is_object());
    EXPECT_EQ(first.at("solved"), true);
    TinyRoom other = tiny_room();
    other.root["materials"][1]["emissiveFactor"] = {0.2, 0.4, 0.9};
    other.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.7, 0.3, 0.5, 1.0};
    write_room(folder_ / "room.glb", other);
    const json relit = next_solved(view, first);
    ASSERT_TRUE(relit.is_object());
    EXPECT_EQ(relit.at("relit"), true);
    EXPECT_EQ(relit.at("shots"), 0); // none were made on the way
    ASSERT_EQ(run_program(folder_.path(), solve).code, 0);
    EXPECT_TRUE(view.get("solution").body == read_file(folder_ / "s.glb")) << options.back();
    // Another mirror is another transport.
    const json second = view.status_when([](const json& status) { return status.at("keepsRows") == true; });
    other.root["materials"][2]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1.0};
    write_room(folder_ / "room.glb", other);
    const json solved_anew = next_solved(view, second);
    ASSERT_TRUE(solved_anew.is_object());
    EXPECT_EQ(solved_anew.at("relit"), false);
    ASSERT_EQ(run_program(folder_.path(), solve).code, 0);
    EXPECT_TRUE(view.get("solution").body == read_file(folder_ / "s.glb")) << options.back();
  }
}

TEST_F(ViewTeaching, NoStepsAtAllAreOfViewAlone) {
  const Outcome outcome = run_program(folder_.path(), {"solve", "room.glb", "--solver", "progressive", "--steps", "0", "-o", "s.glb"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--steps: '0' is not a whole number from 1"));
}

// The way back from a picture that nobody wants any more takes no longer than a few vertices.
TEST_F(ViewTeaching, APictureUnderWayEndsWhenItsCameraMoves) {
  const ViewProgram view(folder_.path(), {"room.glb"});
  ASSERT_TRUE(view.status_when_solved().is_object());
  const std::string seen = "&exposure=0&size=3000x2400&camera=camera&step=whole";
  std::atomic<int> status{0};
  std::thread asks([&] { status = view.get("picture?viewer=a&number=1" + seen).status; });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(status, 0) << "or else nothing is tested";
  ASSERT_EQ(view.post("moved?viewer=a&number=2").status, 204);
  asks.join();
  EXPECT_EQ(status, 204);
}

} // namespace
} // namespace meninas::test
