// `diff`: figures, limits and exit codes, layers, heat maps, and what it refuses.
#include "image/image_file.h"
#include "tests/cli/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Image grey(int width, int height, float value) {
  Image picture(width, height);
  for (glm::vec3& pixel : picture.pixels) {
    pixel = glm::vec3(value);
  }
  return picture;
}

class Diff : public testing::Test {
protected:
  Diff() {
    // A quarter of the pixels is brighter by a quarter: both are exact as half floats.
    Image picture = grey(16, 12, 0.5F);
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 8; ++x) {
        picture.at(x, y) = glm::vec3(0.75F);
      }
    }
    const std::vector<Layer> layers{{"emission", grey(16, 12, 2.0F)}};
    write_exr(folder_ / "a.exr", picture, layers);
    write_exr(folder_ / "b.exr", grey(16, 12, 0.5F), layers);
    write_exr(folder_ / "other-size.exr", grey(12, 16, 0.5F));
  }

  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "diff");
    return run_program(folder_.path(), arguments);
  }
  void expect(int code, const std::string& line, const std::vector<std::string>& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
  }

  TemporaryFolder folder_;
};

TEST_F(Diff, FiguresAsJson) {
  const Outcome outcome = run({"a.exr", "b.exr", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json figures = json::parse(outcome.out);
  EXPECT_DOUBLE_EQ(figures["rmse"], 0.125);
  EXPECT_DOUBLE_EQ(figures["mae"], 0.0625);
  EXPECT_DOUBLE_EQ(figures["max_abs"], 0.25);
  EXPECT_NEAR(figures["relmse"], 0.25 * 0.0625 / 0.26, 1e-12);
  EXPECT_NEAR(figures["psnr"], 20.0 * std::log10(0.5 / 0.125), 1e-9);
  EXPECT_EQ(figures["width"], 16);
  EXPECT_EQ(figures["height"], 12);
  EXPECT_LT(figures["ssim"], 0.999);
  EXPECT_GT(figures["flip"], 0.01);
  EXPECT_EQ(figures["worst_pixel"], json::array({0, 0}));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Diff, IdenticalPicturesHoldEveryLimit) {
  const Outcome outcome =
      run({"a.exr", "a.exr", "--json", "--max-rmse", "0", "--max-relmse", "0", "--max-mae", "0",
           "--max-abs", "0", "--max-flip", "0", "--min-psnr", "200", "--min-ssim", "0.999999"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(json::parse(outcome.out)["psnr"].is_null());
  EXPECT_THAT(run({"a.exr", "a.exr"}).out, HasSubstr("psnr       infinite"));
}

TEST_F(Diff, BrokenLimitsAreSaidInOneLine) {
  expect(1, "a.exr: rmse 0.125 exceeds 0.1", {"a.exr", "b.exr", "--max-rmse", "0.1"});
  expect(1, "a.exr: mae 0.0625 exceeds 0.05, max_abs 0.25 exceeds 0.2",
         {"a.exr", "b.exr", "--max-mae", "0.05", "--max-abs", "0.2", "--max-rmse", "0.2"});
  expect(1, "a.exr: psnr 12.04 is below 40 dB", {"a.exr", "b.exr", "--min-psnr", "40"});
  for (const std::string option : {"--max-flip", "--max-relmse"}) {
    EXPECT_EQ(run({"a.exr", "b.exr", option, "0.001"}).code, 1) << option;
  }
  EXPECT_EQ(run({"a.exr", "b.exr", "--min-ssim", "0.999"}).code, 1);
  EXPECT_EQ(run({"a.exr", "b.exr", "--max-rmse", "0.125"}).code, 0);
}

TEST_F(Diff, TheTableShowsEveryMetricAndLimit) {
  const Outcome outcome = run({"a.exr", "b.exr", "--max-rmse", "0.1", "--max-abs", "0.3"});
  for (const std::string word : {"rmse", "relmse", "mae", "psnr", "max_abs", "ssim", "flip"}) {
    EXPECT_THAT(outcome.out, HasSubstr('\n' + word + ' '));
  }
  EXPECT_THAT(outcome.out, HasSubstr("at most 0.1: BROKEN"));
  EXPECT_THAT(outcome.out, HasSubstr("at most 0.3: held"));
  EXPECT_THAT(outcome.out, HasSubstr("0.25 at pixel (0, 0)"));
}

// Pictures of other programs do not say their unit. What says it may be radiance, a layer of another unit,
// or colours that stand for numbers.
TEST_F(Diff, FiguresHaveTheUnitThatThePicturesState) {
  EXPECT_THAT(run({"a.exr", "b.exr"}).out, HasSubstr("unit       the files do not state theirs"));
  EXPECT_EQ(json::parse(run({"a.exr", "b.exr", "--json"}).out)["units"]["rmse"], "not stated");
  const auto write = [&](const char* name, float value, const char* unit) {
    write_exr(folder_ / name, grey(16, 12, value), std::vector<Layer>{{"depth", grey(16, 12, value)}}, PixelType::half,
              {{"units", unit}, {"units.depth", "m"}});
  };
  write("one.exr", 1.0F, "W/m^2/sr");
  write("two.exr", 2.0F, "W/m^2/sr");
  write("colours.exr", 1.0F, "of white");
  EXPECT_THAT(run({"one.exr", "two.exr", "--max-abs", "3"}).out,
              testing::ContainsRegex("max_abs +1 W/m\\^2/sr at pixel \\(0, 0\\) +at most 3 W/m\\^2/sr: held"));
  EXPECT_THAT(run({"one.exr", "two.exr", "--layer", "depth"}).out, testing::ContainsRegex("rmse +1 m\n"));
  EXPECT_THAT(run({"one.exr", "b.exr"}).out, testing::ContainsRegex("rmse +[0-9.]+ W/m\\^2/sr\n"));
  expect(1, "one.exr: rmse 1 exceeds 0.5 W/m^2/sr", {"one.exr", "two.exr", "--max-rmse", "0.5"});
  const Outcome mixed = run({"colours.exr", "two.exr"});
  EXPECT_THAT(mixed.err, HasSubstr("their units differ: colours.exr has of white, two.exr has W/m^2/sr"));
}

TEST_F(Diff, LayersAreComparedByName) {
  EXPECT_EQ(run({"a.exr", "b.exr", "--layer", "emission", "--max-abs", "0"}).code, 0);
  expect(3, "a.exr: no layer 'emision', did you mean 'emission'?",
         {"a.exr", "b.exr", "--layer", "emision"});
  expect(3, "other-size.exr: no layer 'emission'; it has no layers",
         {"a.exr", "other-size.exr", "--layer", "emission"});
}

TEST_F(Diff, DisplayedPicturesAreTakenToLinearLight) {
  // Code values 188 and 255 are the linear values 0.5029 and 1.
  write_png(folder_ / "half.png", grey(16, 12, 0.5029F), 0.0);
  write_png(folder_ / "white.png", grey(16, 12, 1.0F), 0.0);
  const json figures = json::parse(run({"half.png", "white.png", "--json"}).out);
  EXPECT_NEAR(figures["rmse"], 1.0 - 0.5029, 1e-4);
  EXPECT_NEAR(figures["psnr"], -20.0 * std::log10(1.0 - 0.5029), 1e-2);
  const Outcome mixed = run({"half.png", "b.exr", "--max-abs", "0.01"});
  EXPECT_EQ(mixed.code, 0);
  EXPECT_THAT(mixed.err, HasSubstr("one holds radiance, the other a displayed picture"));
}

TEST_F(Diff, HeatMapsAreWrittenWhetherOrNotLimitsHold) {
  EXPECT_EQ(run({"a.exr", "b.exr", "-o", "heat.png", "--max-abs", "0"}).code, 1);
  const Image map = read_image(folder_ / "heat.png").picture;
  EXPECT_EQ(map.width, 512);
  EXPECT_GT(map.height, 384);
  for (const std::string metric : {"rmse", "relmse", "mae", "max_abs", "ssim"}) {
    EXPECT_EQ(run({"a.exr", "b.exr", "-o", "heat.png", "--heat", metric}).code, 0);
    // The brighter corner is the bright corner of the map.
    const Image heat = read_image(folder_ / "heat.png").picture;
    EXPECT_GT(heat.at(64, 64).g, 4.0F * heat.at(500, 370).g) << metric;
  }
}

TEST_F(Diff, WhatCannotBeComparedIsRefused) {
  expect(3, "missing.exr: no such file", {"missing.exr", "b.exr"});
  expect(3, "a.exr: is 16x12 pixels, other-size.exr is 12x16", {"a.exr", "other-size.exr"});
  std::ofstream(folder_ / "text.exr") << "This is no picture.";
  expect(3, "text.exr: cannot read the picture: not a picture: neither EXR, PNG, JPEG, WebP, TIFF nor HDR",
         {"a.exr", "text.exr"});
  expect(4, "heat.exr: cannot write: a heat map is a .png file",
         {"a.exr", "b.exr", "-o", "heat.exr"});
  expect(4, "missing/heat.png: cannot write: no such folder 'missing'",
         {"a.exr", "b.exr", "-o", "missing/heat.png"});
  write_png(folder_ / "half.png", grey(16, 12, 0.5F), 0.0);
  expect(2, "half.png: is an input, which would be overwritten",
         {"half.png", "half.png", "-o", "half.png"});
  EXPECT_THAT(files_in(folder_.path()),
              ElementsAre("a.exr", "b.exr", "half.png", "other-size.exr", "text.exr"));
}

TEST_F(Diff, OptionsAreChecked) {
  expect(2, "diff: B is required", {"a.exr"});
  expect(2, "--max-rmse: 'little' is not a number", {"a.exr", "b.exr", "--max-rmse", "little"});
  expect(2, "diff: no option '--max-rmes', did you mean '--max-rmse'?",
         {"a.exr", "b.exr", "--max-rmes", "1"});
  expect(2, "--heat: no value 'flop', did you mean 'flip'?", {"a.exr", "b.exr", "--heat", "flop"});
}

TEST_F(Diff, NotANumberIsNamedByItsPixel) {
  // A picture of one pixel is too small to be compressed,
  // so its bytes stand in the file as they are.
  const float marker = 12345.678F, nan = std::numeric_limits<float>::quiet_NaN();
  Image picture(1, 1);
  picture.at(0, 0) = {1.0F, marker, 1.0F};
  write_exr(folder_ / "nan.exr", picture, {}, PixelType::float32);
  std::string bytes = read_file(folder_ / "nan.exr");
  char pattern[4], bad[4];
  std::memcpy(pattern, &marker, 4);
  std::memcpy(bad, &nan, 4);
  const auto place = bytes.find(std::string(pattern, 4));
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, 4, bad, 4);
  std::ofstream(folder_ / "nan.exr", std::ios::binary) << bytes;
  write_exr(folder_ / "one.exr", picture);
  expect(3, "nan.exr: pixel (0, 0) is NaN", {"nan.exr", "one.exr"});
  expect(3, "nan.exr: pixel (0, 0) is NaN", {"one.exr", "nan.exr"});
}

} // namespace
} // namespace meninas::test
