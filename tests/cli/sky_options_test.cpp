// --environment and --sky: what they light, what they refuse, and every command that has them.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>

namespace meninas::test {
namespace {

using testing::HasSubstr;

class SkyOptions : public testing::Test {
protected:
  SkyOptions() {
    write_room(folder_ / "room.glb", tiny_room());
    write_sky("sky.exr", 16, 8);
  }

  /// An even sky of 0.25, 0.5, 1.
  void write_sky(const std::string& name, int width, int height) {
    Image sky(width, height);
    sky.pixels.assign(sky.pixels.size(), glm::vec3(0.25F, 0.5F, 1.0F));
    write_exr(folder_ / name, sky, {}, PixelType::float32);
  }

  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }

  Outcome rendered(const std::string& out, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "room.glb", "-o", out, "--size", "24x18", "--quality", "draft"});
    return run(options);
  }

  TemporaryFolder folder_;
};

TEST_F(SkyOptions, AnEvenPictureIsTheBackgroundOfThatRadiance) {
  EXPECT_EQ(rendered("sky.out.exr", {"--environment", "sky.exr"}).code, 0);
  EXPECT_EQ(rendered("even.out.exr", {"--background", "0.25,0.5,1"}).code, 0);
  const ImageFile sky = read_image(folder_ / "sky.out.exr"), even = read_image(folder_ / "even.out.exr");
  // The tiny room is open in front; half floats and the sums of its rays round.
  double worst = 0.0;
  for (std::size_t p = 0; p < sky.picture.pixels.size(); ++p)
    worst = std::max(worst, double{glm::distance(sky.picture.pixels[p], even.picture.pixels[p])} /
                                (0.05 + double{glm::length(even.picture.pixels[p])}));
  EXPECT_LT(worst, 0.003);
  EXPECT_THAT(sky.attributes, testing::Contains(testing::Pair("environment", "sky.exr")));
}

TEST_F(SkyOptions, StrengthMultiplies) {
  EXPECT_EQ(rendered("one.exr", {"--environment", "sky.exr", "--mode", "reference", "--samples", "64"}).code, 0);
  EXPECT_EQ(rendered("four.exr", {"--environment", "sky.exr", "--environment-strength", "1e6", "--mode", "reference", "--samples", "64"}).code, 0);
  const Image one = read_image(folder_ / "one.exr").picture, four = read_image(folder_ / "four.exr").picture;
  // So strong that the lamp does not count; the first pixel looks past the room.
  EXPECT_GT(four.pixels[24 * 9].b, 1e4F * one.pixels[24 * 9].b * 0.5F);
}

TEST_F(SkyOptions, PlanSaysWhatLightsTheScene) {
  EXPECT_THAT(run({"plan", "room.glb", "--environment", "sky.exr"}).out,
              HasSubstr("sky: sky.exr, 16 x 8 texels, mean radiance 0.25, 0.5, 1 W/m^2/sr"));
  EXPECT_THAT(run({"plan", "room.glb", "--sky", "overcast"}).out, HasSubstr("sky: overcast sky"));
  const Outcome placed = run({"plan", "room.glb", "--sky", "preetham", "--place", "40.4,-3.7", "--date", "2026-06-21T14:00+02:00"});
  EXPECT_EQ(placed.code, 0) << placed.err;
  EXPECT_THAT(placed.out, HasSubstr("preetham sky with the sun at azimuth"));
  EXPECT_THAT(placed.out, HasSubstr("directional light"));
  // The same moment, said otherwise.
  const std::string line = placed.out.substr(placed.out.find("sky: "), 80);
  EXPECT_THAT(run({"plan", "room.glb", "--sky", "preetham", "--place", "40.4,-3.7", "--date", "2026-06-21T12:00:00Z"}).out,
              HasSubstr(line));
}

TEST_F(SkyOptions, WrongValuesAreNamed) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--sky", "cloudy"}, "--sky: no value 'cloudy', there is uniform, overcast, clear, preetham"},
      {{"--sky", "clear"}, "--sky: clear needs --sun AZIMUTH,ELEVATION, or --place LAT,LON and --date TIME"},
      {{"--sky", "clear", "--sun", "90"}, "--sun: '90' is not two numbers A,B"},
      {{"--sky", "clear", "--sun", "90,91"}, "--sun: 91 is not between -90 and 90 degrees"},
      {{"--sky", "clear", "--sun", "90,-5"}, "--sun: the sun is 5.0 degrees below the horizon: these skies are of the day"},
      {{"--sky", "overcast", "--sun", "90,5"}, "--sun: no sun shines in --sky overcast"},
      {{"--sky", "overcast", "--turbidity", "3"}, "--turbidity: --sky overcast does not depend on it"},
      {{"--sky", "clear", "--sun", "90,5", "--turbidity", "30"}, "--turbidity: 30 is not between 2 and 10"},
      {{"--sky", "clear", "--place", "40,0"}, "--place: the sun is found by --place LAT,LON and --date TIME together"},
      {{"--sky", "clear", "--place", "40,0", "--date", "noon"},
       "--date: 'noon' is not a time such as 2026-06-21T12:00Z or 2026-06-21T14:00+02:00"},
      {{"--sky", "clear", "--place", "40,0", "--date", "2026-02-30T12:00Z"},
       "--date: '2026-02-30T12:00Z' is not a time such as 2026-06-21T12:00Z or 2026-06-21T14:00+02:00"},
      {{"--sun", "90,5"}, "--sun: needs --sky"},
      {{"--environment-strength", "2"}, "--environment-strength: needs --environment FILE; a sky has --sky-illuminance LUX"},
      {{"--environment-rotation", "2"}, "--environment-rotation: needs --environment FILE or --sky"},
      {{"--environment", "sky.exr", "--sky", "overcast"}, "--sky: there is --environment already: one sky surrounds a scene"},
      {{"--environment", "sky.exr", "--background", "1"}, "--background: there is --environment already: one sky surrounds a scene"}};
  for (auto [options, line] : cases) {
    options.insert(options.begin(), {"render", "room.glb", "-o", "out.png"});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 2) << line;
    EXPECT_EQ(outcome.err, "meninas: " + line + '\n');
  }
}

TEST_F(SkyOptions, FilesThatAreNoPicturesAreNamed) {
  const Outcome missing = rendered("out.exr", {"--environment", "none.hdr"});
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("meninas: none.hdr: "));
  std::ofstream(folder_ / "text.hdr") << "no picture";
  const Outcome text = rendered("out.exr", {"--environment", "text.hdr"});
  EXPECT_EQ(text.code, 3);
  EXPECT_THAT(text.err, HasSubstr("meninas: text.hdr: "));
}

TEST_F(SkyOptions, OddPicturesAreReadAndSaid) {
  Image sky(10, 8);
  sky.pixels.assign(sky.pixels.size(), glm::vec3(1.0F));
  sky.pixels[3].r = -1.0F;
  sky.pixels[4].g = std::numeric_limits<float>::infinity();
  write_exr(folder_ / "odd.exr", sky, {}, PixelType::float32);
  const Outcome outcome = rendered("out.exr", {"--environment", "odd.exr"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("odd.exr: 10 x 8 pixels, not twice as wide as high: it is stretched over the sphere"));
  EXPECT_THAT(outcome.err, HasSubstr("odd.exr: 1 texel is negative: taken for 0"));
}

TEST_F(SkyOptions, EveryCommandThatHasABackgroundHasThem) {
  const std::vector<std::string> sky{"--environment", "sky.exr", "--environment-rotation", "30"};
  const auto with_sky = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), sky.begin(), sky.end());
    return run(arguments);
  };
  EXPECT_EQ(with_sky({"solve", "room.glb", "-o", "out.glb", "--quality", "draft"}).code, 0);
  EXPECT_EQ(with_sky({"compare", "room.glb", "-o", "compared", "--quality", "draft", "--size", "16x12", "--reference", "--max-seconds", "1"}).code, 0);
  EXPECT_EQ(with_sky({"render", "room.glb", "-o", "ref.exr", "--mode", "reference", "--samples", "4", "--size", "16x12"}).code, 0);
  // A solution belongs to its sky.
  EXPECT_EQ(with_sky({"render", "room.glb", "-o", "again.exr", "--solution", "out.glb", "--quality", "draft", "--size", "16x12"}).code, 0);
  EXPECT_EQ(run({"render", "room.glb", "-o", "again.exr", "--solution", "out.glb", "--quality", "draft", "--size", "16x12"}).code, 3);
  std::ofstream(folder_ / "jobs.json")
      << R"({"jobs": [{"scenes": "room.glb", "settings": {"quality": "draft", "size": "16x12", "environment": "sky.exr"}}]})";
  const Outcome batch = run({"batch", "jobs.json", "-o", "pictures"});
  EXPECT_EQ(batch.code, 0) << batch.err;
}

TEST_F(SkyOptions, ABatchFindsItsPictureBesideItsFileAndKnowsItsContent) {
  std::filesystem::create_directory(folder_ / "jobs");
  const auto write_jobs = [&](const std::string& picture) {
    std::ofstream(folder_ / "jobs/jobs.json")
        << R"({"jobs": [{"scenes": "../room.glb", "outputs": "out.exr", "settings": {"quality": "draft", "size": "16x12", "environment": ")"
        << picture << R"("}}]})";
  };
  const auto batch = [&] { return run({"batch", "jobs/jobs.json", "-o", "pictures", "--resume"}); };
  write_jobs("none.exr");
  const Outcome missing = batch();
  EXPECT_EQ(missing.code, 3) << missing.err;
  EXPECT_THAT(missing.err, HasSubstr("none.exr: no such file"));
  write_jobs("../sky.exr");
  ASSERT_EQ(batch().code, 0);
  const Image before = read_image(folder_ / "pictures/out.exr").picture;
  // Another picture of that name is another sky.
  Image sky(16, 8);
  sky.pixels.assign(sky.pixels.size(), glm::vec3(4.0F, 2.0F, 1.0F));
  write_exr(folder_ / "sky.exr", sky, {}, PixelType::float32);
  ASSERT_EQ(batch().code, 0);
  const Image after = read_image(folder_ / "pictures/out.exr").picture;
  EXPECT_GT(after.pixels[16 * 6].r, 2.0F * before.pixels[16 * 6].r);
}

} // namespace
} // namespace meninas::test
