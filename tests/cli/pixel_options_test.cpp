// `render --layers LIST`, `--view`, `--filter`, `--pixel-error`.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class PixelOptions : public testing::Test {
protected:
  PixelOptions() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"render", "room.glb", "--quality", "draft", "--size", "20x16"});
    return run_program(folder_.path(), arguments);
  }

  ImageFile picture(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"-o", "out.exr"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = render(all);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_image(folder_ / "out.exr");
  }

  void expect_error(const std::string& line, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--quiet", "-o", "no.exr"});
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
    EXPECT_THAT(files_in(folder_.path()), testing::Not(testing::Contains("no.exr")));
  }

  TemporaryFolder folder_;
};

std::vector<std::string> names_of(const ImageFile& file) {
  std::vector<std::string> names;
  for (const Layer& layer : file.layers)
    names.push_back(layer.name);
  return names;
}

TEST_F(PixelOptions, LayersAreThoseThatWereAskedFor) {
  const ImageFile all = picture({"--layers", "irradiance,depth,albedo,element,normal,depth"});
  EXPECT_THAT(names_of(all), ElementsAre("albedo", "depth", "element", "irradiance", "normal"));
  EXPECT_THAT(names_of(picture({"--layers", "depth"})), ElementsAre("depth"));
  EXPECT_EQ(picture({"--layers", "light,normal"}).layers.size(), 10U);
  EXPECT_EQ(picture({"--layers"}).layers.size(), 9U);
  // The room's back wall is 2.5 + 1/2 before the camera or nearer; what is beside it is nothing.
  float far = 0.0F;
  for (const glm::vec3& depth : all.layers[1].image.pixels)
    far = std::max(far, depth.r);
  EXPECT_NEAR(far, 2.5F, 0.6F);
  const glm::vec3 normal = all.layers[4].image.at(10, 8);
  EXPECT_NEAR(glm::length(normal), 1.0F, 1e-5F);
  EXPECT_THAT(names_of(picture({"--layers", "normal", "--mode", "radiosity"})),
              ElementsAre("normal"));
}

TEST_F(PixelOptions, UnknownLayersGetAHint) {
  expect_error("--layers: no value 'dept', did you mean 'depth'?", {"--layers", "normal,dept"});
  expect_error("--layers: has but those of light with --mode reference",
               {"--layers", "depth", "--mode", "reference"});
}

TEST_F(PixelOptions, ViewsSayTheirRangeAndKeepTheirNumbers) {
  for (const std::string view : {"elements", "irradiance", "closure", "mirror-depth"}) {
    const Outcome outcome = render({"--view", view, "-o", "out.exr", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("view " + view + ": "));
    const ImageFile exr = read_image(folder_ / "out.exr"), png = read_image(folder_ / "out.png");
    EXPECT_THAT(names_of(exr), ElementsAre(view));
    for (std::size_t p = 0; p < exr.picture.pixels.size(); ++p)
      for (int band = 0; band < 3; ++band) // half a step of eight bits, where sRGB is steepest
        EXPECT_NEAR(exr.picture.pixels[p][band], png.picture.pixels[p][band], 0.005F);
  }
  float deepest = 0.0F;
  const ImageFile depths = picture({"--view", "mirror-depth"});
  for (const glm::vec3& depth : depths.layers[0].image.pixels)
    deepest = std::max(deepest, depth.r);
  EXPECT_EQ(deepest, 1.0F) << "the room has one mirror";
}

TEST_F(PixelOptions, ViewsOfASolution) {
  ASSERT_EQ(
      run_program(folder_.path(), {"solve", "room.glb", "--quality", "draft", "-o", "s.glb"}).code,
      0);
  const ImageFile again = picture({"--view", "irradiance", "--solution", "s.glb"});
  EXPECT_EQ(again.layers[0].image.pixels, picture({"--view", "irradiance"}).layers[0].image.pixels);
}

TEST_F(PixelOptions, WhatHasNoEffectIsRefused) {
  expect_error("--view: no value 'element', did you mean 'elements'?", {"--view", "element"});
  expect_error("--layers: has no effect with --view", {"--view", "elements", "--layers", "depth"});
  expect_error("--samples: has no effect with --view", {"--view", "elements", "--samples", "4"});
  expect_error("--view: mirror-depth has no effect with --mode radiosity: its mirrors are black",
               {"--view", "mirror-depth", "--mode", "radiosity"});
  expect_error("--view: has no effect with --mode reference: there is no pass one",
               {"--view", "elements", "--mode", "reference"});
  const std::string boxes =
      ": has no effect with --mode reference: its pixels are boxes of as many samples each";
  expect_error("--filter" + boxes, {"--filter", "tent", "--mode", "reference"});
  expect_error("--pixel-error" + boxes, {"--pixel-error", "0.1", "--mode", "reference"});
  expect_error(
      "--glossy-samples: has no effect with --mode reference: its paths go one way at a time",
      {"--glossy-samples", "4", "--mode", "reference"});
  expect_error("--glossy-samples: has no effect with --mode radiosity: it shows pass one",
               {"--glossy-samples", "4", "--mode", "radiosity"});
  expect_error("--filter: no value 'gausian', did you mean 'gaussian'?", {"--filter", "gausian"});
}

TEST_F(PixelOptions, FiltersAndAdaptiveSamplingChangeThePicture) {
  const Image plain = picture({"--samples", "64"}).picture;
  EXPECT_EQ(picture({"--samples", "64", "--filter", "box"}).picture.pixels, plain.pixels);
  EXPECT_NE(picture({"--samples", "64", "--filter", "blackman-harris"}).picture.pixels,
            plain.pixels);
  const Outcome some = render(
      {"--samples", "64", "--pixel-error", "0.05", "--stats", "some.json", "-o", "some.exr"});
  ASSERT_EQ(some.code, 0) << some.err;
  const auto rays = nlohmann::json::parse(read_file(folder_ / "some.json"))["rays"]["camera"];
  EXPECT_LT(rays.get<int>(), 20 * 16 * 64);
  EXPECT_GE(rays.get<int>(), 20 * 16 * 16);
}

TEST_F(PixelOptions, BatchesWriteThemToo) {
  std::ofstream(folder_ / "jobs.json") << R"({
    "defaults": {"settings": {"quality": "draft", "size": "16x12"}},
    "jobs": [
      {"scenes": "room.glb", "outputs": "a.exr",
       "settings": {"layers": "depth,element", "filter": "tent"}},
      {"scenes": "room.glb", "outputs": "b.exr", "settings": {"view": "closure"}},
      {"scenes": "room.glb", "outputs": "c.exr", "settings": {"layers": true}}]})";
  const Outcome outcome = run_program(folder_.path(), {"batch", "jobs.json", "-o", "made"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(names_of(read_image(folder_ / "made/a.exr")), ElementsAre("depth", "element"));
  EXPECT_THAT(names_of(read_image(folder_ / "made/b.exr")), ElementsAre("closure"));
  EXPECT_EQ(read_image(folder_ / "made/c.exr").layers.size(), 9U);
}

} // namespace
} // namespace meninas::test
