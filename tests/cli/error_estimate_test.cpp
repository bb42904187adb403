// What `render` says about the error of its picture: in a line, in its figures, as a layer.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

using testing::HasSubstr;

class ErrorEstimate : public testing::Test {
protected:
  ErrorEstimate() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome render(std::vector<std::string> arguments) {
    std::vector<std::string> all{"render", "room.glb", "--size", "40x30"};
    for (const auto& [option, value] :
         {std::pair<std::string, std::string>{"--element-size", "0.2"}, {"--rays", "64"}})
      if (std::ranges::find(arguments, option) == arguments.end())
        all.insert(all.end(), {option, value});
    arguments.insert(arguments.begin(), all.begin(), all.end());
    return run_program(folder_.path(), arguments);
  }
  nlohmann::json figures() { return nlohmann::json::parse(read_file(folder_ / "out.json")); }

  TemporaryFolder folder_;
};

TEST_F(ErrorEstimate, IsThereWhereSquaresAreBeyondFloats) {
  const Outcome outcome = render({"-o", "out.exr", "--background", "1e30"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(" % off ("));
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("nan")));
}

TEST_F(ErrorEstimate, IsInTheFiguresAndTheLine) {
  const Outcome outcome = render({"-o", "out.exr", "--stats", "out.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("out.exr: 40x30 in "));
  EXPECT_THAT(outcome.err, HasSubstr(" % off ("));
  const auto error = figures().at("error_estimate");
  double square = 0.0;
  for (const char* part : {"mesh", "form_factors", "mirror_tail", "pixels", "solver"})
    square += std::pow(error.at(part).get<double>(), 2.0);
  EXPECT_GT(square, 0.0);
  EXPECT_NEAR(error.at("total").get<double>(), std::sqrt(square), 1e-9);
}

TEST_F(ErrorEstimate, IsInTheLineOfEveryPictureThatSomebodyReads) {
  EXPECT_THAT(render({"-o", "out.png"}).err, HasSubstr(" off"));
  EXPECT_THAT(render({"-o", "out.png", "--quiet"}).err, testing::IsEmpty());
}

TEST_F(ErrorEstimate, IsWarnedOfFromTenPerCentOn) {
  const std::string warning = "warning: the picture is about ";
  EXPECT_THAT(render({"-o", "out.png", "--samples", "1", "--rays", "2"}).err, HasSubstr(warning));
  EXPECT_THAT(render({"-o", "out.png", "--samples", "64", "--rays", "1024", "--element-size", "0.1",
                      "--diffuse", "direct"})
                  .err,
              testing::Not(HasSubstr(warning)));
}

TEST_F(ErrorEstimate, SaysWhatToTurnFirst) {
  const Outcome outcome = render({"-o", "out.exr", "--stats", "out.json", "--samples", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("; more --samples would help most"));
}

TEST_F(ErrorEstimate, FallsWithCameraRays) {
  const auto pixels_with = [&](const char* samples) {
    EXPECT_EQ(
        render({"-o", "out.exr", "--stats", "out.json", "--quiet", "--samples", samples}).code, 0);
    return figures().at("error_estimate").at("pixels").get<double>();
  };
  EXPECT_GT(pixels_with("1"), 4.0 * pixels_with("64"))
      << "at least as the root of their number, eight";
}

TEST_F(ErrorEstimate, BelongsToViewsOfASolutionToo) {
  ASSERT_EQ(run_program(folder_.path(), {"solve", "room.glb", "-o", "room.solution.glb", "--rays",
                                         "64", "--element-size", "0.2", "--quiet"})
                .code,
            0);
  ASSERT_EQ(
      run_program(folder_.path(), {"render", "room.glb", "--solution", "room.solution.glb", "-o",
                                   "out.exr", "--size", "40x30", "--stats", "out.json", "--quiet"})
          .code,
      0);
  EXPECT_GT(figures().at("error_estimate").at("total").get<double>(), 0.0);
}

TEST_F(ErrorEstimate, MapIsALayerAndLeavesThePictureAsItIs) {
  ASSERT_EQ(render({"-o", "plain.exr", "--quiet"}).code, 0);
  ASSERT_EQ(render({"-o", "out.exr", "--error-map", "--quiet"}).code, 0);
  const ImageFile plain = read_image(folder_ / "plain.exr"),
                  mapped = read_image(folder_ / "out.exr");
  EXPECT_EQ(plain.picture.pixels, mapped.picture.pixels);
  const auto map = std::ranges::find(mapped.layers, "error", &Layer::name);
  ASSERT_NE(map, mapped.layers.end());
  float largest = 0.0F;
  for (const glm::vec3& pixel : map->image.pixels) {
    ASSERT_TRUE(std::isfinite(pixel.g) && pixel.g >= 0.0F);
    largest = std::max(largest, pixel.g);
  }
  EXPECT_GT(largest, 0.0F);
}

TEST_F(ErrorEstimate, MapNeedsAPlaceAndTwoPasses) {
  EXPECT_EQ(render({"-o", "out.png", "--error-map"}).code, 2);
  EXPECT_EQ(run_program(folder_.path(), {"render", "room.glb", "-o", "out.exr", "--mode",
                                         "reference", "--error-map"})
                .code,
            2);
}

} // namespace
} // namespace meninas::test
