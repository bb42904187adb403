// --variant, --at, --light-scale and the section plane of a camera, in the commands that read a scene.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int back_wall = 2, lamp = 5; // nodes, and their meshes

/// By night the back wall glows; the lamp rises by 0.05 m in a second; a bulb of 20 W/sr.
TinyRoom changing_room() {
  TinyRoom room = tiny_room();
  json& root = room.root;
  root["extensions"]["KHR_materials_variants"]["variants"] =
      json::array({{{"name", "day"}}, {{"name", "night"}}});
  root["meshes"][back_wall]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
      json::array({{{"material", 1}, {"variants", {1}}}});
  const auto times = add_floats(room, {0, 1}, "SCALAR", 1);
  const auto places = add_floats(room, {0, 0, 0, 0, 0.0625F, 0}, "VEC3", 3);
  root["animations"] = json::array(
      {{{"channels", {{{"sampler", 0}, {"target", {{"node", lamp}, {"path", "translation"}}}}}},
        {"samplers", {{{"input", times}, {"output", places}}}}}});
  root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}, {"intensity", 20.0}}});
  root["scenes"][0]["nodes"].push_back(root["nodes"].size());
  root["nodes"].push_back({{"name", "bulb"},
                           {"translation", {0.5, 0.5, 0.7}},
                           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return room;
}

class StateOptions : public testing::Test {
protected:
  StateOptions() {
    std::filesystem::create_directories(folder_ / "changed");
    write_room(folder_ / "room.glb", changing_room());
  }

  Outcome run(std::vector<std::string> arguments) {
    return run_program(folder_.path(), arguments);
  }

  /// The picture of a file of that name, quickly.
  std::string picture(const std::string& file, const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments{"render", file,        "-o", "a.exr",     "--size", "16x16",
                                       "--rays", "16",        "--element-size", "0.25", "--samples",
                                       "1",      "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_file(folder_ / "a.exr");
  }

  /// That of the room changed in the file itself.
  std::string picture_of(void (*change)(json& root)) {
    TinyRoom room = changing_room();
    change(room.root);
    write_room(folder_ / "changed/room.glb", room);
    return picture("changed/room.glb");
  }

  TemporaryFolder folder_;
};

TEST_F(StateOptions, ThePictureIsThatOfAFileInThatState) {
  const std::string rest = picture("room.glb");
  const std::string night = picture("room.glb", {"--variant", "night"});
  const std::string later = picture("room.glb", {"--at", "0.5"});
  const std::string dimmed = picture("room.glb", {"--light-scale", "0.25"});
  EXPECT_EQ(picture("room.glb", {"--variant", "day"}), rest);
  EXPECT_EQ(picture("room.glb", {"--at", "-1", "--light-scale", "1"}), rest);
  EXPECT_EQ(night, picture_of([](json& root) {
              root["meshes"][back_wall]["primitives"][0]["material"] = 1;
            }));
  EXPECT_EQ(later, picture_of([](json& root) {
              root["nodes"][lamp]["translation"] = {0, 0.03125, 0};
            }));
  EXPECT_EQ(dimmed, picture_of([](json& root) {
              root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 5.0;
            }));
  EXPECT_NE(night, rest);
  EXPECT_NE(later, rest);
  EXPECT_NE(dimmed, rest);
}

TEST_F(StateOptions, EveryCommandThatReadsASceneHasThem) {
  const std::vector<std::vector<std::string>> commands{
      {"plan", "room.glb"},
      {"solve", "room.glb", "-o", "s.glb"},
      {"compare", "room.glb", "-o", "compared"},
      {"trade", "room.glb", "-o", "traded"},
      {"formfactors", "room.glb", "--from", "floor", "--to", "back"},
      {"render", "room.glb", "-o", "r.exr"}};
  for (auto command : commands) {
    command.insert(command.end(), {"--at", "0.5", "--variant", "nigth"});
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 2) << command.front();
    EXPECT_THAT(outcome.err, HasSubstr("no variant 'nigth', did you mean 'night'?"))
        << command.front();
  }
  EXPECT_EQ(run({"plan", "room.glb", "--at", "soon"}).code, 2);
  EXPECT_EQ(run({"plan", "room.glb", "--light-scale", "-1"}).code, 2);
}

TEST_F(StateOptions, ThePlanListsVariants) {
  EXPECT_THAT(run({"plan", "room.glb"}).out, HasSubstr("'day', 'night'"));
  EXPECT_EQ(json::parse(run({"plan", "room.glb", "--json"}).out)["variants"],
            json({"day", "night"}));
  write_room(folder_ / "plain.glb", tiny_room());
  EXPECT_THAT(run({"plan", "plain.glb"}).out, Not(HasSubstr("variant")));
}

TEST_F(StateOptions, SolutionsBelongToTheirState) {
  ASSERT_EQ(run({"solve", "room.glb", "-o", "s.glb", "--variant", "night", "--rays", "16",
                 "--element-size", "0.25", "--quiet"})
                .code,
            0);
  const std::vector<std::string> view{"render", "room.glb", "-o",     "v.exr",      "--quiet",
                                      "--size", "8x8",      "--solution", "s.glb"};
  auto of_night = view;
  of_night.insert(of_night.end(), {"--variant", "night"});
  EXPECT_EQ(run(of_night).code, 0);
  const Outcome by_day = run(view);
  EXPECT_EQ(by_day.code, 3);
  EXPECT_THAT(by_day.err, HasSubstr("s.glb"));
}

TEST_F(StateOptions, JobsOfABatchMayDifferInThem) {
  std::ofstream(folder_ / "jobs.json") << json{
      {"defaults",
       {{"scenes", "room.glb"},
        {"settings",
         {{"size", "16x16"}, {"rays", 16}, {"element-size", 0.25}, {"samples", 1}}}}},
      {"jobs",
       {{{"outputs", "rest.exr"}},
        {{"settings", {{"variant", "night"}}}, {"outputs", "night.exr"}},
        {{"settings", {{"at", 0.5}}}, {"outputs", "later.exr"}},
        {{"settings", {{"light-scale", 0.25}}}, {"outputs", "dimmed.exr"}}}}};
  const Outcome outcome = run({"batch", "jobs.json", "-o", "made", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto made = [&](const char* name) { return read_file(folder_ / "made" / name); };
  EXPECT_EQ(made("rest.exr"), picture("room.glb"));
  EXPECT_EQ(made("night.exr"), picture("room.glb", {"--variant", "night"}));
  EXPECT_EQ(made("later.exr"), picture("room.glb", {"--at", "0.5"}));
  EXPECT_EQ(made("dimmed.exr"), picture("room.glb", {"--light-scale", "0.25"}));
}

TEST_F(StateOptions, LightsOutOfProportionAreNamed) {
  // 20 W/sr in this room of a few square metres are 50 W/m^2; the lamp has a radiance of 1.
  const char* words = "out of proportion";
  EXPECT_THAT(run({"plan", "room.glb"}).out, Not(HasSubstr(words)));
  EXPECT_THAT(run({"plan", "room.glb", "--light-scale", "683"}).out, HasSubstr(words));
}

TEST_F(StateOptions, ACameraThatCutsTheSceneOpenSaysSo) {
  TinyRoom room = tiny_room();
  const std::string whole = picture("room.glb");
  room.root["cameras"][0]["perspective"]["znear"] = 1.75; // 0.25 m into the room
  write_room(folder_ / "cut.glb", room);
  const char* words = "camera 'camera' cuts the scene open: what is nearer than its znear of 1.75 m";
  EXPECT_THAT(run({"plan", "cut.glb"}).out, HasSubstr(words));
  for (const std::string mode : {"hybrid", "reference"}) {
    const Outcome outcome = run({"render", "cut.glb", "-o", "c.png", "--size", "16x16", "--samples",
                                 "16", "--mode", mode});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << mode;
  }
  room.root["cameras"][0]["perspective"]["znear"] = 1.4; // before it
  write_room(folder_ / "cut.glb", room);
  EXPECT_THAT(run({"plan", "cut.glb"}).out, Not(HasSubstr("znear")));
}

} // namespace
} // namespace meninas::test
