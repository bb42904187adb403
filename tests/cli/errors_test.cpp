// One line on standard error, the documented exit code, and nothing left behind.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Errors : public testing::Test {
protected:
  Errors() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }

  /// Runs, and expects exactly this error, nothing on standard output and no new file.
  void expect(int code, const std::string& line, const std::vector<std::string>& arguments) {
    const auto before = files_in(folder_.path());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
    EXPECT_EQ(outcome.code, code) << line;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_EQ(files_in(folder_.path()), before);
  }

  void expect_spoilt(const TinyRoom& room, const std::string& line) {
    write_room(folder_ / "spoilt.glb", room);
    expect(3, "spoilt.glb: " + line, {"render", "spoilt.glb", "-o", "out.exr"});
  }

  TemporaryFolder folder_;
};

TEST_F(Errors, UnknownCommandsAndOptionsGetAHint) {
  expect(2, "no command 'rendre', did you mean 'render'?", {"rendre", "room.glb"});
  expect(2, "no command 'xyzzy'", {"xyzzy"});
  expect(2, "render: no option '--smaples', did you mean '--samples'?",
         {"render", "room.glb", "-o", "out.png", "--smaples", "4"});
  expect(2, "plan: no option '--jsn', did you mean '--json'?", {"plan", "--jsn", "room.glb"});
  expect(2, "render: too many arguments: 'other.glb'",
         {"render", "room.glb", "other.glb", "-o", "out.png"});
}

TEST_F(Errors, WhatIsMissingIsNamed) {
  expect(2, "render: SCENE is required", {"render", "-o", "out.png"});
  expect(2, "solve: --output is required", {"solve", "room.glb"});
}

TEST_F(Errors, ValuesAreChecked) {
  const std::vector<std::array<std::string, 3>> cases{
      {"--mode", "raytracing", "no value 'raytracing', there is radiosity, hybrid, reference"},
      {"--quality", "drafd", "no value 'drafd', did you mean 'draft'?"},
      {"--form-factors", "hemicub", "no value 'hemicub', did you mean 'hemicube'?"},
      {"--hemicube-resolution", "0", "'0' is not an even number from 2 to 1024"},
      {"--hemicube-resolution", "2048", "'2048' is not an even number from 2 to 1024"},
      {"--hemicube-resolution", "63", "'63' is not an even number from 2 to 1024"},
      {"--hemicube-resolution", "64x64", "'64x64' is not an even number from 2 to 1024"},
      {"--hemicube-resolution", "64", "has no effect without --form-factors hemicube"},
      {"--glossy-samples", "0", "'0' is not a whole number from 1 to 4096"},
      {"--rays", "0", "'0' is not a whole number from 1 to 1048576"},
      {"--rays", "1e3", "'1e3' is not a whole number from 1 to 1048576"},
      {"--seed", "-1", "'-1' is not a whole number from 0 to 4294967295"},
      {"--threads", "0", "'0' is not a whole number from 1 to 1024"},
      {"--tolerance", "nan", "'nan' is not a number"},
      {"--element-size", "inf", "'inf' is not a number"},
      {"--element-size", "-0.1", "'-0.1' is not positive"},
      {"--elements", "0", "'0' is not a whole number from 1 to 4000000"},
      {"--elements", "4000001", "'4000001' is not a whole number from 1 to 4000000"},
      {"--elements", "2e3", "'2e3' is not a whole number from 1 to 4000000"},
      {"--size", "640", "'640' is not a size such as 640x480"},
      {"--size", "640x0", "'640x0' is not a size such as 640x480"},
      {"--size", "65536x65536",
       "'65536x65536' is larger than 65536 pixels on a side or 134217728 in all"},
      {"--background", "1e40", "'1e40' is over 1e+30 W/m^2/sr"},
      {"--background", "1,2e30,0", "'1,2e30,0' is over 1e+30 W/m^2/sr"},
      {"--exposure", "bright", "'bright' is not a number"}};
  for (const auto& [option, value, what] : cases) {
    expect(2, option + ": " + what, {"render", "room.glb", "-o", "out.png", option, value});
  }
}

TEST_F(Errors, UnknownCamerasGetAHint) {
  expect(2, "room.glb: no camera 'camrea', did you mean 'camera'?",
         {"render", "room.glb", "-o", "out.png", "--camera", "camrea"});
}

TEST_F(Errors, OutputsAreCheckedBeforeTheWork) {
  expect(4, "missing/out.png: cannot write: no such folder 'missing'",
         {"render", "room.glb", "-o", "out.exr", "-o", "missing/out.png"});
  expect(4, "missing/s.json: cannot write: no such folder 'missing'",
         {"render", "room.glb", "-o", "out.exr", "--stats", "missing/s.json"});
  expect(4, "out.jpg: cannot write pictures as '.jpg', only .exr, .png and .hdr",
         {"render", "room.glb", "-o", "out.jpg"});
  expect(4, "out.gltf: cannot write: a solution is a .glb file",
         {"solve", "room.glb", "-o", "out.gltf"});
  expect(2, "room.glb: is an input, which would be overwritten",
         {"solve", "room.glb", "-o", "room.glb"});
  expect(2, "out.png: is named as an output twice",
         {"render", "room.glb", "-o", "out.png", "-o", "out.png"});
}

TEST_F(Errors, FilesThatAreNoScenes) {
  expect(3, "missing.gltf: no such file", {"render", "missing.gltf", "-o", "out.png"});
  std::ofstream(folder_ / "text.gltf") << "This is not glTF.";
  expect(3, "text.gltf: not a glTF file: it begins with neither '{' nor 'glTF'",
         {"plan", "text.gltf"});
  const std::string whole = read_file(folder_ / "room.glb");
  std::ofstream(folder_ / "cut.glb", std::ios::binary) << whole.substr(0, 1000);
  expect(3,
         "cut.glb: GLB header: truncated: it announces " + std::to_string(whole.size()) +
             " bytes, the file has 1000",
         {"solve", "cut.glb", "-o", "out.glb"});
}

TEST_F(Errors, ScenesThatCannotBeRendered) {
  TinyRoom unknown = tiny_room();
  unknown.root["extensionsRequired"] = {"EXT_unheard_of"};
  unknown.root["extensionsUsed"] = {"EXT_unheard_of"};
  write_room(folder_ / "spoilt.glb", unknown);
  const Outcome outcome = run({"render", "spoilt.glb", "-o", "out.exr"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err,
              testing::MatchesRegex("meninas: spoilt.glb: [^\n]*EXT_unheard_of[^\n]*\n"));

  TinyRoom empty = tiny_room();
  empty.root["scenes"][0]["nodes"] = {7};
  expect_spoilt(empty, "nothing to render: no triangles in the scene");
}

TEST_F(Errors, SolutionsOfOtherScenesAreRefused) {
  ASSERT_EQ(run({"solve", "room.glb", "-o", "room.solution.glb", "--quality", "draft"}).code, 0);
  TinyRoom other = tiny_room();
  other.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][0] = 0.6;
  write_room(folder_ / "other.glb", other);
  expect(3, "room.solution.glb: is not a solution of other.glb: solve again",
         {"render", "other.glb", "--solution", "room.solution.glb", "-o", "out.exr"});
  expect(3, "room.glb: not a solution written by 'meninas solve'",
         {"render", "other.glb", "--solution", "room.glb", "-o", "out.exr"});
  expect(
      2, "--rays: has no effect with --solution: pass one is not run",
      {"render", "room.glb", "--solution", "room.solution.glb", "-o", "out.exr", "--rays", "64"});
}

// On a full disk or a closed stream nobody reads what is said: pictures and exit codes are the same,
// and no picture has messages in it.
TEST_F(Errors, NothingHangsOnStandardError) {
  const auto silently = [&](const std::string& arguments, const std::string& redirection) {
    return run_other_program("/bin/sh", folder_.path(),
                             {"-c", "'" MENINAS_PROGRAM "' " + arguments + redirection});
  };
  const std::string render = "render room.glb --quality draft --size 8x8 -o ";
  ASSERT_THAT(silently(render + "said.png", "").err, testing::HasSubstr("exposure"));
  int k = 0;
  for (const std::string unheard : {" 2>/dev/full", " 2>&-"}) {
    const std::string name = std::to_string(++k);
    EXPECT_EQ(silently(render + name + ".png", unheard).code, 0) << unheard;
    EXPECT_EQ(read_file(folder_ / (name + ".png")), read_file(folder_ / "said.png")) << unheard;
    EXPECT_EQ(silently("plan nowhere.glb", unheard).code, 3) << unheard;
    EXPECT_EQ(silently("render --unknown", unheard).code, 2) << unheard;
  }
}

} // namespace
} // namespace meninas::test
