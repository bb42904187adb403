// Lamps apart, as the program says and does it.
#include "image/image_file.h"
#include "scenes/glb_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The tiny room with its lamp and a point light of its own, which is called `desk` by its extras.
TinyRoom two_lamps() {
  TinyRoom room = tiny_room();
  room.root["extensionsUsed"] = json::array({"KHR_lights_punctual"});
  room.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}, {"intensity", 0.5}}});
  room.root["nodes"].push_back({{"name", "bulb"},
                                {"translation", {0.7, 0.3, 0.6}},
                                {"extras", {{"lamp", "desk"}}},
                                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size() - 1);
  return room;
}

class LampsOfTheProgram : public testing::Test {
protected:
  LampsOfTheProgram() { write_room(folder_ / "room.glb", two_lamps()); }

  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }

  Outcome solved(std::vector<std::string> options = {"--by-lamp"}) {
    options.insert(options.begin(), {"solve", "room.glb", "-o", "out.glb", "--quality", "draft",
                                     "--elements", "600"});
    return run(options);
  }

  Outcome rendered(const std::string& picture, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "room.glb", "-o", picture, "--size", "24x24",
                                     "--samples", "16", "--float"});
    return run(options);
  }

  Image picture(const std::string& name) { return read_image(folder_ / name).picture; }

  TemporaryFolder folder_;
};

double mean_of(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels)
    sum += double{pixel.r + pixel.g + pixel.b};
  return sum / double(3 * image.pixels.size());
}

TEST_F(LampsOfTheProgram, AreRelitFromASolution) {
  ASSERT_EQ(solved().code, 0);
  ASSERT_EQ(rendered("all.exr", {"--solution", "out.glb"}).code, 0);
  ASSERT_EQ(rendered("lamp.exr", {"--solution", "out.glb", "--lamp", "desk=0"}).code, 0);
  ASSERT_EQ(rendered("desk.exr", {"--solution", "out.glb", "--lamp", "all=0;desk=1"}).code, 0);
  ASSERT_EQ(rendered("none.exr", {"--solution", "out.glb", "--lamp", "all=0"}).code, 0);
  const double all = mean_of(picture("all.exr")), lamp = mean_of(picture("lamp.exr")),
               desk = mean_of(picture("desk.exr"));
  EXPECT_GT(lamp, 0.0);
  EXPECT_GT(desk, 0.0);
  EXPECT_NEAR(lamp + desk, all, 0.005 * all); // samples of direct light differ
  EXPECT_EQ(mean_of(picture("none.exr")), 0.0);
}

TEST_F(LampsOfTheProgram, AreSolvedUnderTheirFactorsWithoutASolution) {
  ASSERT_EQ(solved().code, 0);
  ASSERT_EQ(rendered("relit.exr", {"--solution", "out.glb", "--lamp", "lamp=0.2,1,0.5"}).code, 0);
  ASSERT_EQ(rendered("solved.exr", {"--quality", "draft", "--elements", "600", "--diffuse",
                                    "direct", "--lamp", "lamp=0.2,1,0.5"})
                .code,
            0);
  const double expected = mean_of(picture("solved.exr"));
  EXPECT_NEAR(mean_of(picture("relit.exr")), expected, 0.02 * expected);
}

TEST_F(LampsOfTheProgram, HaveALayerEachWhichAddUpToThePicture) {
  ASSERT_EQ(solved().code, 0);
  ASSERT_EQ(rendered("rack.exr", {"--solution", "out.glb", "--layers", "lamps"}).code, 0);
  const std::vector<Layer> layers = read_image(folder_ / "rack.exr").layers;
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0].name, "lamp.desk"); // by name, as an EXR has them; a sum of two has no order
  EXPECT_EQ(layers[1].name, "lamp.lamp");
  const Image all = picture("rack.exr");
  for (std::size_t k = 0; k < all.pixels.size(); ++k)
    EXPECT_EQ(all.pixels[k], layers[0].image.pixels[k] + layers[1].image.pixels[k]);
}

TEST_F(LampsOfTheProgram, HaveAnEstimateOfTheErrorOfTheirSum) {
  ASSERT_EQ(solved().code, 0);
  ASSERT_EQ(rendered("rack.exr", {"--solution", "out.glb", "--layers", "lamps", "--stats", "rack.json"}).code, 0);
  ASSERT_EQ(rendered("whole.exr", {"--solution", "out.glb", "--stats", "whole.json"}).code, 0);
  const auto error_of = [&](const char* stats) {
    return json::parse(std::ifstream(folder_ / stats))["error_estimate"]["total"].get<double>();
  };
  // The same picture but for the draws of its samples, which the estimates find at other places.
  EXPECT_NEAR(error_of("rack.json"), error_of("whole.json"), 0.5 * error_of("whole.json"));
  EXPECT_GT(error_of("rack.json"), 0.0);
}

TEST_F(LampsOfTheProgram, MayHaveASemicolonInTheirName) {
  TinyRoom room = two_lamps();
  room.root["nodes"].back()["extras"]["lamp"] = "desk; left";
  write_room(folder_ / "room.glb", room);
  ASSERT_EQ(solved().code, 0);
  ASSERT_EQ(rendered("a.exr", {"--solution", "out.glb", "--lamp", "all=0;desk; left=1"}).code, 0);
  ASSERT_EQ(rendered("b.exr", {"--solution", "out.glb", "--lamp", "lamp=0", "--lamp", "desk; left=1,1,1"}).code, 0);
  const double desk = mean_of(picture("a.exr"));
  EXPECT_GT(desk, 0.0);
  EXPECT_EQ(mean_of(picture("b.exr")), desk);
  EXPECT_EQ(rendered("a.exr", {"--solution", "out.glb", "--lamp", "all=0;desk"}).code, 2);
}

TEST_F(LampsOfTheProgram, AreListedByThePlanAndWhereANameIsUnknown) {
  EXPECT_THAT(run({"plan", "room.glb"}).out, HasSubstr("'lamp', 'desk'"));
  ASSERT_EQ(solved().code, 0);
  const Outcome unknown = rendered("a.exr", {"--solution", "out.glb", "--lamp", "dsk=1"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--lamp: there is no lamp 'dsk': there are lamp, desk"));
}

TEST_F(LampsOfTheProgram, AreRefusedWhereTheyCannotBe) {
  for (const char* wrong : {"lamp=-1", "lamp=nan", "lamp=1,2", "lamp", "=1", "lamp="})
    EXPECT_EQ(rendered("a.exr", {"--lamp", wrong}).code, 2) << wrong;
  ASSERT_EQ(solved({}).code, 0);
  const Outcome together = rendered("a.exr", {"--solution", "out.glb", "--lamp", "desk=1"});
  EXPECT_EQ(together.code, 3);
  EXPECT_THAT(together.err, HasSubstr("out.glb: does not know its lamps apart: solve again with --by-lamp"));
  EXPECT_EQ(solved({"--by-lamp", "--solver", "progressive"}).code, 2);
  EXPECT_EQ(solved({"--by-lamp", "--interpolation", "average"}).code, 2);
}

TEST_F(LampsOfTheProgram, ASolutionOfAFormerFormatIsRefused) {
  ASSERT_EQ(solved().code, 0);
  GlbContent glb = read_glb(folder_ / "out.glb");
  glb.root["asset"]["extras"]["meninas"].erase("format");
  const auto bytes =
      glb_bytes(glb.root, std::as_bytes(std::span(glb.binary)), folder_ / "old.glb");
  std::ofstream(folder_ / "old.glb", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  const Outcome old = rendered("a.exr", {"--solution", "old.glb"});
  EXPECT_EQ(old.code, 3);
  EXPECT_THAT(old.err, HasSubstr("old.glb: has format 1 of solution files, this program reads 2: solve again"));
}

TEST_F(LampsOfTheProgram, OfABatchShareOneSolution) {
  const json jobs{
      {"defaults", {{"settings", {{"quality", "draft"}, {"elements", 600}, {"size", "16x16"}}}}},
      {"jobs",
       {{{"scenes", "room.glb"}, {"settings", {{"lamp", "desk=0"}}}, {"outputs", "a.exr"}},
        {{"scenes", "room.glb"}, {"settings", {{"lamp", "all=0;desk=1"}}}, {"outputs", "b.exr"}},
        {{"scenes", "room.glb"}, {"settings", {{"lamp", "all=1"}}}, {"outputs", "c.exr"}}}}};
  std::ofstream(folder_ / "jobs.json") << jobs.dump();
  const Outcome planned = run({"batch", "jobs.json", "-o", "pictures", "--dry-run"});
  EXPECT_THAT(planned.out + planned.err, HasSubstr("1 to solve"));
  ASSERT_EQ(run({"batch", "jobs.json", "-o", "pictures"}).code, 0);
  const double without = mean_of(picture("pictures/a.exr")), desk = mean_of(picture("pictures/b.exr")),
               both = mean_of(picture("pictures/c.exr"));
  EXPECT_GT(std::min(without, desk), 0.0);
  // Pictures of halves are rounded to 2^-11 of each pixel.
  EXPECT_NEAR(without + desk, both, 1e-3 * both);
}

} // namespace
} // namespace meninas::test
