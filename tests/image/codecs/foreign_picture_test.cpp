// Pictures as other programs write them: layers, parts, windows, tiles, integers, TIFF.
#include "image/display.h"
#include "image/image_file.h"
#include "scenes/errors.h"
#include "tests/image/picture_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <gmock/gmock.h>

#include <cmath>
#include <sys/resource.h>

namespace meninas::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Imath::Box2i box(int x0, int y0, int x1, int y1) {
  return {Imath::V2i(x0, y0), Imath::V2i(x1, y1)};
}

/// A part of one value per channel, but that the first pixel of all is 8 times as bright.
struct TestPart {
  std::string name = {};
  std::vector<std::pair<std::string, float>> channels;
  Imath::Box2i display = box(0, 0, 7, 5);
  Imath::Box2i data = box(0, 0, 7, 5);
  Imf::PixelType type = Imf::FLOAT;
  bool tiled = false;
};

Imf::Header header_of(const TestPart& part) {
  Imf::Header header(part.display, part.data);
  for (const auto& [name, value] : part.channels)
    header.channels().insert(name, Imf::Channel(part.type));
  header.setName(part.name);
  header.setType(part.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (part.tiled)
    header.setTileDescription({4, 4, Imf::ONE_LEVEL});
  return header;
}

/// By OpenEXR itself, which writes what no picture of ours has.
void write_parts(const std::filesystem::path& file, const std::vector<TestPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const TestPart& part : parts)
    headers.push_back(header_of(part));
  Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const TestPart& part = parts[p];
    const int width = part.data.max.x - part.data.min.x + 1;
    const int height = part.data.max.y - part.data.min.y + 1;
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<std::vector<float>> floats;
    std::vector<std::vector<unsigned>> integers;
    Imf::FrameBuffer buffer;
    for (const auto& [name, value] : part.channels) {
      floats.emplace_back(count, value).front() *= 8.0F;
      integers.emplace_back(count, static_cast<unsigned>(value)).front() *= 8U;
    }
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
      char* base = part.type == Imf::UINT ? reinterpret_cast<char*>(integers[c].data())
                                          : reinterpret_cast<char*>(floats[c].data());
      const std::ptrdiff_t first = 4 * (part.data.min.x + std::ptrdiff_t{part.data.min.y} * width);
      buffer.insert(part.channels[c].first,
                    Imf::Slice(part.type, base - first, 4, 4 * static_cast<std::size_t>(width)));
    }
    if (part.tiled) {
      Imf::TiledOutputPart tiles(output, static_cast<int>(p));
      tiles.setFrameBuffer(buffer);
      tiles.writeTiles(0, tiles.numXTiles() - 1, 0, tiles.numYTiles() - 1);
    } else {
      Imf::OutputPart rows(output, static_cast<int>(p));
      rows.setFrameBuffer(buffer);
      rows.writePixels(height);
    }
  }
}

std::vector<std::pair<std::string, float>> colour(const std::string& prefix, float value) {
  return {{prefix + "R", value}, {prefix + "G", 2.0F * value}, {prefix + "B", 4.0F * value}};
}

std::vector<std::pair<std::string, float>>
together(std::initializer_list<std::vector<std::pair<std::string, float>>> lists) {
  std::vector<std::pair<std::string, float>> all;
  for (const auto& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::vector<std::string> names_of(const std::vector<Layer>& layers) {
  std::vector<std::string> names;
  for (const Layer& layer : layers)
    names.push_back(layer.name);
  return names;
}

class ForeignPicture : public PictureFiles {
protected:
  ImageFile read(const std::vector<TestPart>& parts, Picture picture = Picture::needed) {
    write_parts(folder / "a.exr", parts);
    return read_image(folder / "a.exr", picture);
  }
};

TEST_F(ForeignPicture, OneLayerOfManyIsThePictureByItsName) {
  struct Case {
    std::vector<std::string> layers;
    std::string picture;
  };
  const std::vector<Case> cases{
      {{"ViewLayer.Combined", "ViewLayer.DiffCol", "Scene.Noisy"}, "ViewLayer.Combined"},
      {{"RenderLayer.Combined", "RenderLayer.Env"}, "RenderLayer.Combined"},
      {{"ViewLayer_001.Combined", "ViewLayer.Combined"}, "ViewLayer.Combined"},
      {{"ViewLayer.Combined", "Composite.Combined"}, "Composite.Combined"},
      {{"ViewLayer.Combined.right", "ViewLayer.Combined.left"}, "ViewLayer.Combined.left"},
      {{"albedo", "beauty"}, "beauty"},
      {{"RGB_IMAGEPIPELINE.rgb", "ALBEDO"}, "RGB_IMAGEPIPELINE.rgb"},
      {{"only one"}, "only one"}};
  for (const Case& c : cases) {
    TestPart part;
    for (const std::string& layer : c.layers)
      for (const auto& channel : colour(layer + ".", layer == c.picture ? 1.0F : 100.0F))
        part.channels.push_back(channel);
    part.channels.emplace_back("ViewLayer.Depth.Z", 5.0F);
    const ImageFile file = read({part});
    EXPECT_EQ(file.picture_name, c.picture);
    EXPECT_EQ(file.picture.at(3, 3), glm::vec3(1, 2, 4)) << c.picture;
    EXPECT_EQ(file.layers.size(), c.layers.size()) << "all but the picture, and the depth";
    EXPECT_THAT(file.remarks, ElementsAre("the picture is its '" + c.picture + "'"));
    EXPECT_TRUE(file.ignored_channels.empty()) << "a depth is a layer";
  }
}

TEST_F(ForeignPicture, PlainChannelsAreThePictureWhateverElseThereIs) {
  const ImageFile file =
      read({{.name = "",
             .channels = together({colour("ViewLayer.Combined.", 9.0F), colour("", 1.0F)})}});
  EXPECT_EQ(file.picture_name, "");
  EXPECT_EQ(file.picture.at(0, 0), glm::vec3(8, 16, 32));
  EXPECT_THAT(file.remarks, IsEmpty());
}

TEST_F(ForeignPicture, NamesInSmallLettersAndWholeWords) {
  EXPECT_EQ(read({{.channels = {{"r", 1.0F}, {"g", 2.0F}, {"b", 4.0F}}}}).picture.at(1, 0),
            glm::vec3(1, 2, 4));
  EXPECT_EQ(read({{.channels = {{"Red", 1.0F}, {"Green", 2.0F}, {"Blue", 4.0F}}}}).picture.at(1, 0),
            glm::vec3(1, 2, 4));
}

TEST_F(ForeignPicture, LuminanceAloneIsGrey) {
  EXPECT_EQ(read({{.channels = {{"Y", 3.0F}, {"Z", 1.0F}}}}).picture.at(1, 0), glm::vec3(3));
  EXPECT_EQ(read({{.channels = {{"lum.Y", 3.0F}}}}).picture.at(1, 0), glm::vec3(3));
}

TEST_F(ForeignPicture, WhichOfManyUnknownLayersIsAsked) {
  const TestPart part{.channels = together({colour("one.", 1.0F), colour("two.", 2.0F)})};
  write_parts(folder / "a.exr", {part});
  EXPECT_THAT(error_line<InputError>([&] { read_image(folder / "a.exr"); }),
              HasSubstr("which of its layers is the picture? There is one, two"));
  EXPECT_THAT(names_of(read_image(folder / "a.exr", Picture::not_needed).layers),
              ElementsAre("one", "two"));
}

TEST_F(ForeignPicture, TheFirstPartWithAPictureIsMeant) {
  const TestPart depth{.name = "depth", .channels = {{"Z", 1.0F}}};
  const TestPart beauty{.name = "rgba", .channels = colour("", 1.0F)};
  const TestPart albedo{.name = "albedo", .channels = colour("albedo.", 3.0F)};
  const ImageFile first = read({beauty, depth, albedo});
  EXPECT_EQ(first.picture_name, "");
  EXPECT_EQ(first.picture.at(1, 1), glm::vec3(1, 2, 4));
  EXPECT_THAT(names_of(first.layers), ElementsAre("albedo"));
  EXPECT_THAT(first.ignored_channels, ElementsAre("depth.Z"));
  const ImageFile second = read({depth, beauty, albedo});
  EXPECT_EQ(second.picture_name, "rgba");
  EXPECT_EQ(second.picture.at(1, 1), glm::vec3(1, 2, 4));
}

TEST_F(ForeignPicture, PixelsAreThoseOfTheDisplayWindow) {
  // Data begin at (2, 1) of the display window and go on beyond it.
  const TestPart crop{.channels = colour("", 1.0F),
                      .display = box(10, 20, 17, 25),
                      .data = box(12, 21, 20, 22)};
  const ImageFile file = read({crop});
  ASSERT_EQ(file.picture.width, 8);
  ASSERT_EQ(file.picture.height, 6);
  EXPECT_EQ(file.picture.at(1, 1), glm::vec3(0));
  EXPECT_EQ(file.picture.at(2, 1), glm::vec3(8, 16, 32));
  EXPECT_EQ(file.picture.at(7, 2), glm::vec3(1, 2, 4));
  EXPECT_EQ(file.picture.at(7, 3), glm::vec3(0));
  EXPECT_THAT(file.remarks, ElementsAre(HasSubstr("9x2 pixels from (2, 1) on are stored of its 8x6")));
  // More than the display window on all sides.
  const ImageFile overscan =
      read({{.channels = colour("", 1.0F), .display = box(0, 0, 7, 5), .data = box(-2, -3, 9, 9)}});
  EXPECT_EQ(overscan.picture.width, 8);
  for (const glm::vec3& pixel : overscan.picture.pixels)
    EXPECT_EQ(pixel, glm::vec3(1, 2, 4)) << "the bright first pixel lies outside";
  // Nothing of it within.
  const ImageFile apart =
      read({{.channels = colour("", 1.0F), .display = box(0, 0, 7, 5), .data = box(20, 0, 27, 5)}});
  for (const glm::vec3& pixel : apart.picture.pixels)
    EXPECT_EQ(pixel, glm::vec3(0));
}

TEST_F(ForeignPicture, AHugeDisplayWindowIsNotBelieved) {
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  read({{.channels = colour("", 1.0F)}});
  const auto before = peak();
  write_parts(folder / "a.exr", {{.channels = colour("", 1.0F),
                                  .display = box(0, 0, 65535, 65535),
                                  .data = box(0, 0, 7, 5)}});
  EXPECT_THAT(error_line<InputError>([&] { read_image(folder / "a.exr"); }),
              HasSubstr("its display window, 65536 x 65536 pixels, is too large for its 8 x 6"));
  EXPECT_LT(peak() - before, 100'000) << "kilobytes, of 51 GB";
}

TEST_F(ForeignPicture, TilesAndHalvesAndIntegers) {
  EXPECT_EQ(read({{.channels = colour("", 1.0F), .tiled = true}}).picture.at(7, 5),
            glm::vec3(1, 2, 4));
  const ImageFile integers = read({{.channels = colour("", 3.0F), .type = Imf::UINT}});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(integers.picture.at(7, 5)[c], 3.0F * std::ldexp(1.0F, c), 1e-5F);
}

TEST_F(ForeignPicture, DeepPartsAreLeftOutAndSaid) {
  Imf::Header deep(2, 2);
  deep.setName("deep");
  deep.setType(Imf::DEEPSCANLINE);
  deep.compression() = Imf::ZIPS_COMPRESSION;
  deep.channels().insert("R", Imf::Channel(Imf::FLOAT));
  { Imf::DeepScanLineOutputFile output((folder / "deep.exr").c_str(), deep); }
  EXPECT_THAT(error_line<InputError>([&] { read_image(folder / "deep.exr"); }),
              HasSubstr("deep data, not a flat picture"));
}

// --- TIFF

void append(std::vector<std::byte>& bytes, std::uint32_t value, int count) {
  for (int k = 0; k < count; ++k)
    bytes.push_back(static_cast<std::byte>(value >> 8 * k));
}

/// One strip without compression; every sample of `bits` is `value`.
std::vector<std::byte> tiff(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                            std::uint32_t bits, std::uint32_t format,
                            const std::vector<std::byte>& pixels) {
  std::vector<std::byte> bytes;
  for (const char c : {'I', 'I', '*', '\0'})
    bytes.push_back(static_cast<std::byte>(c));
  constexpr std::uint32_t entries = 10;
  const std::uint32_t data = 8 + 2 + 12 * entries + 4;
  append(bytes, 8, 4);
  append(bytes, entries, 2);
  const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t value) {
    append(bytes, tag, 2);
    append(bytes, type, 2);
    append(bytes, 1, 4);
    append(bytes, value, 4);
  };
  entry(256, 4, width);
  entry(257, 4, height);
  entry(258, 3, bits);
  entry(259, 3, 1);                       // no compression
  entry(262, 3, channels == 1 ? 1U : 2U); // grey or RGB
  entry(273, 4, data);
  entry(277, 3, channels);
  entry(278, 4, height);
  entry(279, 4, static_cast<std::uint32_t>(pixels.size()));
  entry(339, 3, format); // 1 whole numbers, 2 with signs, 3 floats
  append(bytes, 0, 4);
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

std::vector<std::byte> samples(std::size_t count, std::uint32_t value, int size) {
  std::vector<std::byte> bytes;
  for (std::size_t k = 0; k < count; ++k)
    append(bytes, value, size);
  return bytes;
}

TEST_F(ForeignPicture, TiffOfIntegersIsDisplayedAndOfFloatsLinear) {
  const auto check = [&](const std::vector<std::byte>& bytes, float value, Encoding encoding) {
    write_bytes(folder / "a.tif", bytes);
    const ImageFile file = read_image(folder / "a.tif");
    EXPECT_EQ(file.encoding, encoding);
    ASSERT_EQ(file.picture.width, 3);
    ASSERT_EQ(file.picture.height, 2);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(file.picture.at(2, 1)[c], value, 1e-6F);
  };
  check(tiff(3, 2, 3, 8, 1, samples(18, 188, 1)), srgb_decode(188.0F / 255.0F), Encoding::srgb);
  check(tiff(3, 2, 3, 16, 1, samples(18, 30000, 2)), srgb_decode(30000.0F / 65535.0F),
        Encoding::srgb);
  check(tiff(3, 2, 1, 8, 1, samples(6, 188, 1)), srgb_decode(188.0F / 255.0F), Encoding::srgb);
  check(tiff(3, 2, 3, 16, 2, samples(18, 0x8000, 2)), 0.0F, Encoding::srgb); // -32768
  check(tiff(3, 2, 3, 32, 3, samples(18, 0x40400000, 4)), 3.0F, Encoding::linear);
  check(tiff(3, 2, 1, 32, 3, samples(6, 0x40400000, 4)), 3.0F, Encoding::linear);
}

TEST_F(ForeignPicture, ATiffThatPromisesMoreThanItHoldsIsRefused) {
  write_bytes(folder / "a.tif", tiff(60000, 5000, 3, 8, 1, samples(18, 1, 1)));
  EXPECT_THAT(error_line<InputError>([&] { read_image(folder / "a.tif"); }),
              HasSubstr("promises more than it holds"));
  auto cut = tiff(3, 2, 3, 8, 1, samples(18, 1, 1));
  cut.resize(cut.size() - 4);
  write_bytes(folder / "a.tif", cut);
  EXPECT_THAT(error_line<InputError>([&] { read_image(folder / "a.tif"); }),
              HasSubstr("cannot read the picture"));
  EXPECT_THAT(error_line<InputError>([&] {
                decode_image(tiff(3, 2, 3, 8, 1, samples(18, 1, 1)), Encoding::srgb, "images/0");
              }),
              HasSubstr("a TIFF cannot be a texture"));
}

TEST_F(ForeignPicture, DamagedForeignFilesAreReadOrRefused) {
  write_parts(folder / "a.exr",
              {{.name = "rgba", .channels = colour("", 1.0F), .tiled = true},
               {.name = "deep sea", .channels = colour("x.", 1.0F), .data = box(2, 2, 4, 4)}});
  write_bytes(folder / "b.tif", tiff(3, 2, 3, 16, 1, samples(18, 77, 2)));
  std::mt19937 engine(11);
  for (const char* name : {"a.exr", "b.tif"}) {
    const auto whole = bytes_of(folder / name);
    int refused = 0;
    for (int round = 0; round < 300; ++round) {
      auto bytes = whole;
      for (unsigned k = 0; k <= engine() % 4U; ++k)
        bytes[engine() % bytes.size()] = static_cast<std::byte>(engine());
      if (engine() % 4U == 0)
        bytes.resize(engine() % bytes.size());
      write_bytes(folder / "damaged", bytes);
      try {
        const ImageFile file = read_image(folder / "damaged");
        EXPECT_EQ(file.picture.pixels.size(), static_cast<std::size_t>(file.picture.width) *
                                                  static_cast<std::size_t>(file.picture.height));
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 0) << name;
  }
}

} // namespace
} // namespace meninas::test
