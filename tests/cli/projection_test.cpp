// `--projection`: panoramas in the commands that make pictures.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class ProjectionOption : public testing::Test {
protected:
  ProjectionOption() {
    TinyRoom room = tiny_room();
    for (auto& node : room.root["nodes"])
      if (node["name"] == "camera")
        node["translation"] = {0.5, 0.5, 0.5};
    write_room(folder_ / "room.glb", room);
    room.root["cameras"][0]["extras"] = {{"fstop", 1.0}, {"focus_distance", 0.5}, {"focal_length", 400.0}};
    write_room(folder_ / "lens.glb", room);
  }

  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }

  Outcome render(std::vector<std::string> options, const std::string& file = "room.glb") {
    options.insert(options.begin(), {"render", file, "-o", "a.exr", "--rays", "16",
                                     "--element-size", "0.25", "--samples", "1"});
    return run(options);
  }

  TemporaryFolder folder_;
};

TEST_F(ProjectionOption, PicturesAreAsWideAsWholeSpheresAndCubes) {
  ASSERT_EQ(render({"--projection", "equirectangular"}).code, 0);
  const Image sphere = read_image(folder_ / "a.exr").picture;
  EXPECT_EQ(sphere.width, 1024);
  EXPECT_EQ(sphere.height, 512);
  ASSERT_EQ(render({"--projection", "cube"}).code, 0);
  const Image cube = read_image(folder_ / "a.exr").picture;
  EXPECT_EQ(cube.width, 3072);
  EXPECT_EQ(cube.height, 512);
}

TEST_F(ProjectionOption, SaysWhatCannotBe) {
  Outcome outcome = render({"--projection", "cube", "--size", "60x12"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--size: 60x12 is no row of six squares, such as 72x12"));
  outcome = render({"--projection", "fisheye"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("fisheye"));
  outcome = render({"--projection", "cube", "--size", "72x12"}, "lens.glb");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("has a lens, which panoramas do without"));
}

TEST_F(ProjectionOption, IsASettingOfBatchesAndSharesTheirSolves) {
  std::ofstream(folder_ / "jobs.json") << json{
      {"defaults",
       {{"scenes", "room.glb"},
        {"settings", {{"rays", 16}, {"element-size", 0.25}, {"samples", 1}, {"size", "24x12"}}}}},
      {"jobs",
       {{{"outputs", "plain.exr"}},
        {{"settings", {{"projection", "equirectangular"}}}, {"outputs", "around.exr"}}}}};
  ASSERT_EQ(run({"batch", "jobs.json", "-o", "made", "--quiet"}).code, 0);
  ASSERT_EQ(render({"--projection", "equirectangular", "--size", "24x12", "--quiet"}).code, 0);
  EXPECT_EQ(read_file(folder_ / "made/around.exr"), read_file(folder_ / "a.exr"));
  EXPECT_NE(read_file(folder_ / "made/plain.exr"), read_file(folder_ / "a.exr"));
  EXPECT_EQ(json::parse(read_file(folder_ / "made/summary.json"))["solves"].size(), 1U);
}

TEST_F(ProjectionOption, IsComparedWithTheReference) {
  const Outcome outcome =
      run({"compare", "room.glb", "-o", "compared", "--projection", "equirectangular", "--size",
           "32x16", "--rays", "64", "--element-size", "0.1", "--samples", "64", "--reference",
           "--max-error", "0.02"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(read_file(folder_ / "compared/index.html"),
              HasSubstr("--projection equirectangular"));
  const Image hybrid = read_image(folder_ / "compared/hybrid.exr").picture,
              truth = read_image(folder_ / "compared/reference.exr").picture;
  ASSERT_EQ(truth.width, 32);
  double off = 0.0, mean = 0.0;
  for (std::size_t k = 0; k < truth.pixels.size(); ++k) {
    off += std::pow(hybrid.pixels[k].g - truth.pixels[k].g, 2);
    mean += truth.pixels[k].g;
  }
  const double pixels = double(truth.pixels.size());
  // The noise that was asked for, and as much of coarse elements and shadows.
  EXPECT_LT(std::sqrt(off / pixels) / (mean / pixels), 0.1);
}

} // namespace
} // namespace meninas::test
