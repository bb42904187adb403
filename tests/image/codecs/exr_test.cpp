// EXR files come back as they were written: exactly as float, to half's rounding as half.
#include "image/image_file.h"
#include "scenes/errors.h"
#include "tests/image/picture_files.h"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>

namespace meninas::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class Exr : public PictureFiles {};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// Half has 11 significant bits: rounded to nearest, a value is off by at most 2^-11 of itself.
constexpr float half_rounding = 1.0F / 2048.0F;

void expect_near_relative(const Image& read, const Image& written, float tolerance) {
  ASSERT_EQ(read.width, written.width);
  ASSERT_EQ(read.height, written.height);
  for (std::size_t k = 0; k < written.pixels.size(); ++k)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(read.pixels[k][c], written.pixels[k][c], tolerance * written.pixels[k][c])
          << "pixel " << k;
}

TEST_F(Exr, FloatIsExact) {
  const auto picture = random_picture(37, 21);
  write_exr(folder / "a.exr", picture, {}, PixelType::float32);
  EXPECT_EQ(read_image(folder / "a.exr").picture.pixels, picture.pixels);
}

/// How many threads the process has once a picture is written by at most so many.
std::ptrdiff_t threads_after_writing(const std::filesystem::path& file, std::size_t limit) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
  write_exr(file, Image(64, 64));
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return std::distance(begin(threads), end(threads));
}

TEST_F(Exr, IsCompressedByAsManyThreadsAsMayWork) {
  const auto alone = threads_after_writing(folder / "a.exr", 1);
  EXPECT_EQ(threads_after_writing(folder / "b.exr", 3), alone + 3);
  EXPECT_EQ(threads_after_writing(folder / "c.exr", 1), alone);
}

/// Whether the process has mapped the library that reads.
bool reader_is_open() {
  std::ifstream maps("/proc/self/maps");
  const std::string text{std::istreambuf_iterator<char>(maps), {}};
  return text.find("libOpenImageIO") != std::string::npos;
}

TEST_F(Exr, WritingNeedsNothingOfWhatReads) {
  if (reader_is_open())
    GTEST_SKIP() << "another test of this process has read a picture";
  write_exr(folder / "a.exr", Image(2, 2));
  write_png(folder / "a.png", Image(2, 2), 0.0);
  EXPECT_FALSE(reader_is_open());
  read_image(folder / "a.png");
  EXPECT_TRUE(reader_is_open()) << "the test must be able to see it";
}

TEST_F(Exr, HalfIsRoundedToNearest) {
  const auto picture = random_picture(37, 21);
  write_exr(folder / "a.exr", picture);
  const auto read = read_image(folder / "a.exr").picture;
  expect_near_relative(read, picture, half_rounding);
  EXPECT_NE(read.pixels, picture.pixels) << "the values were chosen to need rounding";
}

TEST_F(Exr, OddSizes) {
  // 5000 rows are more than the encoder takes at a time.
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(1, 5000), std::pair(5000, 1), std::pair(3, 513)}) {
    const auto picture = random_picture(width, height);
    const Layer layer{"diffuse", random_picture(width, height, 2)};
    write_exr(folder / "a.exr", picture, {&layer, 1}, PixelType::float32);
    const auto read = read_image(folder / "a.exr");
    EXPECT_EQ(read.picture.pixels, picture.pixels) << width << " x " << height;
    EXPECT_EQ(read.layers.at(0).image.pixels, layer.image.pixels) << width << " x " << height;
  }
}

TEST_F(Exr, LayersComeBackByName) {
  const auto picture = random_picture(9, 5);
  const std::vector<Layer> layers{{"variance", random_picture(9, 5, 2)},
                                  {"diffuse.direct", random_picture(9, 5, 3)},
                                  {"A", random_picture(9, 5, 4)},
                                  {"R", random_picture(9, 5, 5)}};
  write_exr(folder / "a.exr", picture, layers, PixelType::float32);
  const auto read = read_image(folder / "a.exr");
  EXPECT_EQ(read.picture.pixels, picture.pixels);
  ASSERT_EQ(read.layers.size(), 4U);
  const std::array<std::size_t, 4> order{2, 3, 1, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(read.layers[k].name, layers[order[k]].name);
    EXPECT_EQ(read.layers[k].image.pixels, layers[order[k]].image.pixels) << read.layers[k].name;
  }
  EXPECT_TRUE(read.ignored_channels.empty());
}

TEST_F(Exr, DepthsAndVectorsHaveTheNamesThatCompositorsKnow) {
  const auto picture = random_picture(9, 5);
  const std::vector<Layer> layers{{"depth", random_picture(9, 5, 2)},
                                  {"normal", random_picture(9, 5, 3)},
                                  {"alpha", random_picture(9, 5, 4)}};
  write_exr(folder / "a.exr", picture, layers, PixelType::float32);
  std::ifstream file(folder / "a.exr", std::ios::binary);
  std::string header(1000, '\0');
  file.read(header.data(), 1000);
  for (const std::string name : {"A", "depth.Z", "normal.X", "normal.Y", "normal.Z"})
    EXPECT_NE(header.find(name + '\0'), std::string::npos) << name;
  EXPECT_EQ(header.find("depth.R"), std::string::npos);

  const auto read = read_image(folder / "a.exr");
  EXPECT_EQ(read.picture.pixels, picture.pixels);
  EXPECT_EQ(read.ignored_channels, std::vector<std::string>{"A"}) << "a picture is compared without its alpha";
  ASSERT_EQ(read.layers.size(), 2U);
  EXPECT_EQ(read.layers[1].image.pixels, layers[1].image.pixels);
  for (std::size_t k = 0; k < picture.pixels.size(); ++k)
    EXPECT_EQ(read.layers[0].image.pixels[k], glm::vec3(layers[0].image.pixels[k].r));
}

TEST_F(Exr, AttributesComeBackByKey) {
  const std::string text = "a=1\n\"b\": 'x' \\ \xc3\xa9";
  write_exr(folder / "a.exr", Image(2, 2), {}, PixelType::half,
            {{"settings", text},
             {"empty", ""},
             {"Software", "mine"},
             {"long", std::string(100000, 'x')}});
  EXPECT_THAT(read_image(folder / "a.exr").attributes,
              ElementsAre(Pair("Software", "mine"), Pair("long", std::string(100000, 'x')),
                          Pair("settings", text)));
}

TEST_F(Exr, ValuesBeyondTheTypeAreClipped) {
  Image picture(1, 4);
  picture.pixels = {{65519.0F, 65520.0F, 1e12F},
                    {infinity, -infinity, -1e12F},
                    {1e-12F, 0.0F, -1.0F},
                    {6e-8F, 1e-4F, 1.0F}};
  write_exr(folder / "half.exr", picture);
  const auto half = read_image(folder / "half.exr").picture;
  EXPECT_EQ(half.at(0, 0), glm::vec3(65504.0F));
  EXPECT_EQ(half.at(0, 1), glm::vec3(65504.0F, -65504.0F, -65504.0F));
  EXPECT_EQ(half.at(0, 2), glm::vec3(0.0F, 0.0F, -1.0F));
  // Below 2^-14 half's steps are all 2^-24.
  EXPECT_NEAR(half.at(0, 3).r, 6e-8F, 0.5F * std::ldexp(1.0F, -24));

  write_exr(folder / "float.exr", picture, {}, PixelType::float32);
  const auto full = read_image(folder / "float.exr").picture;
  EXPECT_EQ(full.at(0, 0), picture.at(0, 0));
  EXPECT_EQ(full.at(0, 1).r, std::numeric_limits<float>::max());
  EXPECT_EQ(full.at(0, 1).g, std::numeric_limits<float>::lowest());
  EXPECT_EQ(full.at(0, 2), picture.at(0, 2));
}

TEST_F(Exr, NeverHoldsNan) {
  Image picture(2, 1);
  picture.at(1, 0).b = nan;
  EXPECT_THROW(write_exr(folder / "a.exr", picture), std::logic_error);
  const Layer layer{"variance", picture};
  EXPECT_THROW(write_exr(folder / "a.exr", Image(2, 1), {&layer, 1}), std::logic_error);
  EXPECT_EQ(entries(), 0U);
}

TEST_F(Exr, MisusedLayersAndAttributesAreProgrammerErrors) {
  const std::vector<std::vector<Layer>> misuses{{{"", Image(2, 2)}},
                                                {{"a", Image(2, 1)}},
                                                {{"a", Image(2, 2)}, {"a", Image(2, 2)}},
                                                {{std::string(300, 'a'), Image(2, 2)}}};
  for (const auto& layers : misuses)
    EXPECT_THROW(write_exr(folder / "a.exr", Image(2, 2), layers), std::logic_error);
  EXPECT_THROW(write_exr(folder / "a.exr", Image(2, 2), {}, PixelType::half, {{"", "x"}}),
               std::logic_error);
  EXPECT_THROW(
      write_exr(folder / "a.exr", Image(2, 2), {}, PixelType::half, {{"a", "x"}, {"a", "y"}}),
      std::logic_error);
  EXPECT_THROW(write_exr(folder / "a.exr", Image()), std::logic_error);
  EXPECT_EQ(entries(), 0U);
}

TEST_F(Exr, SamePictureIsSameFile) {
  const auto picture = random_picture(64, 300);
  write_exr(folder / "a.exr", picture, {}, PixelType::half, {{"key", "value"}});
  write_exr(folder / "b.exr", picture, {}, PixelType::half, {{"key", "value"}});
  const auto bytes = bytes_of(folder / "a.exr");
  EXPECT_EQ(bytes, bytes_of(folder / "b.exr"));

  // The writing library would add the time of day, of which two quick files might not tell.
  const std::string text(reinterpret_cast<const char*>(bytes.data()),
                         std::min<std::size_t>(bytes.size(), 1000));
  EXPECT_THAT(text, HasSubstr("Meninas "));
  EXPECT_FALSE(std::regex_search(text, std::regex("[0-9]:[0-9]{2}:[0-9]{2} ")));
}

TEST_F(Exr, NamesWithSpacesAndOtherLetters) {
  const auto picture = random_picture(4, 3);
  const auto inner = folder / "sala d'\xc3\xa1tico \xe9\x8f\xa1";
  std::filesystem::create_directory(inner);
  for (const char* name : {"las meninas.exr", "espejo \xe9\x8f\xa1.EXR", ".exr.exr", "%d#x.exr"}) {
    write_exr(inner / name, picture, {}, PixelType::float32);
    EXPECT_EQ(read_image(inner / name).picture.pixels, picture.pixels) << name;
  }
}

TEST_F(Exr, LongestNameTheSystemAllows) {
  const auto file = folder / (std::string(251, 'n') + ".exr");
  write_exr(file, Image(1, 1));
  EXPECT_EQ(read_image(file).picture.width, 1);
}

} // namespace
} // namespace meninas::test
