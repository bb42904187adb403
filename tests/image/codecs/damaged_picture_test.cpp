// Files that are no pictures, or not whole, are refused with one line,
// without crash, noise or a grab for memory.
#include "image/image_file.h"
#include "scenes/errors.h"
#include "tests/image/picture_files.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstring>

namespace meninas::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class DamagedPicture : public PictureFiles {
protected:
  std::string read_error(const std::filesystem::path& file) {
    return error_line<InputError>([&] { read_image(file); });
  }
  std::string decode_error(const std::vector<std::byte>& bytes) {
    return error_line<InputError>(
        [&] { decode_image(bytes, Encoding::srgb, "scene.gltf: images/3"); });
  }
};

void put_little_endian(std::vector<std::byte>& bytes, std::size_t place, std::int32_t value) {
  for (std::size_t k = 0; k < 4; ++k)
    bytes.at(place + k) = static_cast<std::byte>(static_cast<std::uint32_t>(value) >> 8 * k);
}

/// Where the value of a header attribute begins:
/// after its name, its type and the size of the value.
std::size_t value_place(const std::vector<std::byte>& exr, std::string_view name,
                        std::string_view type) {
  const std::string_view text(reinterpret_cast<const char*>(exr.data()), exr.size());
  const auto header = std::string(name) + '\0' + std::string(type) + '\0';
  const auto place = text.find(header);
  if (place == std::string_view::npos)
    throw std::logic_error("no such attribute");
  return place + header.size() + 4;
}

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST_F(DamagedPicture, NoFile) {
  const auto file = folder / "none.png";
  EXPECT_EQ(read_error(file), file.string() + ": no such file");
}

TEST_F(DamagedPicture, NotAnOrdinaryFile) {
  EXPECT_EQ(read_error(folder), folder.string() + ": is a folder, not a picture");
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  EXPECT_THAT(read_error(folder / "pipe.png"), EndsWith("not an ordinary file"));
  EXPECT_THAT(read_error("/dev/zero"), EndsWith("not an ordinary file"));
}

TEST_F(DamagedPicture, NotAPicture) {
  for (const std::string text :
       {"", "{", "<svg/>", "a note, long enough to hold any header that a reader may look for"}) {
    std::ofstream(folder / "a.png") << text;
    EXPECT_EQ(read_error(folder / "a.png"),
              (folder / "a.png").string() +
                  ": cannot read the picture: not a picture: neither EXR, PNG, JPEG, WebP, TIFF nor HDR");
  }
}

TEST_F(DamagedPicture, ErrorsInMemoryCarryTheGivenName) {
  EXPECT_THAT(decode_error({}), StartsWith("scene.gltf: images/3: cannot read the picture: "));
}

TEST_F(DamagedPicture, EveryTruncationIsNoticed) {
  const auto picture = random_picture(12, 9);
  const Layer layer{"diffuse", picture};
  write_exr(folder / "a.exr", picture, {&layer, 1}, PixelType::half, {{"key", "value"}});
  write_png(folder / "a.png", picture, 0.0);
  ::testing::internal::CaptureStderr();
  for (const char* name : {"a.exr", "a.png"}) {
    auto bytes = bytes_of(folder / name);
    while (!bytes.empty()) {
      bytes.pop_back();
      ASSERT_THAT(decode_error(bytes), HasSubstr("cannot read the picture: "))
          << name << " of " << bytes.size() << " bytes";
    }
  }
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), IsEmpty())
      << "the reason belongs into the error alone";
}

TEST_F(DamagedPicture, ReasonsAreNamed) {
  write_png(folder / "a.png", random_picture(12, 9), 0.0);
  auto bytes = bytes_of(folder / "a.png");
  bytes.resize(bytes.size() - 1);
  EXPECT_THAT(decode_error(bytes), EndsWith("the PNG ends too early"));
  bytes = bytes_of(folder / "a.png");
  bytes[bytes.size() - 20] ^= std::byte{1};
  EXPECT_THAT(decode_error(bytes),
              EndsWith("the PNG is damaged: IDAT: incorrect data check"));

  write_exr(folder / "a.exr", random_picture(12, 9));
  bytes = bytes_of(folder / "a.exr");
  bytes.resize(bytes.size() - 1);
  EXPECT_THAT(decode_error(bytes),
              AllOf(HasSubstr("Unexpected end of file"), ::testing::Not(HasSubstr("memory"))));
  bytes.resize(20);
  EXPECT_THAT(decode_error(bytes), EndsWith("the EXR ends within its header"));
}

TEST_F(DamagedPicture, AbsurdSizesAreRefusedBeforeAllocation) {
  write_exr(folder / "warm-up.exr", Image(1, 1));
  read_image(folder / "warm-up.exr");
  write_exr(folder / "a.exr", random_picture(12, 9));
  const auto exr = bytes_of(folder / "a.exr");
  const auto before = peak_kilobytes();

  auto wide = exr;
  put_little_endian(wide, value_place(wide, "dataWindow", "box2i") + 8, 65536);
  EXPECT_THAT(decode_error(wide),
              HasSubstr("65537 x 9 pixels are too many; a side may have 65536"));
  auto tall = exr;
  put_little_endian(tall, value_place(tall, "dataWindow", "box2i") + 12, 2147483647);
  EXPECT_THAT(decode_error(tall), HasSubstr("12 x 2147483648 pixels are too many"));
  auto negative = exr;
  put_little_endian(negative, value_place(negative, "dataWindow", "box2i") + 8, -5);
  EXPECT_THAT(decode_error(negative), HasSubstr("damaged header"));
  auto many = exr;
  put_little_endian(many, value_place(many, "dataWindow", "box2i") + 8, 65535);
  put_little_endian(many, value_place(many, "dataWindow", "box2i") + 12, 65535);
  EXPECT_THAT(decode_error(many), HasSubstr("cannot read the picture: "));
  auto long_text = exr;
  put_little_endian(long_text, value_place(long_text, "Software", "string") - 4, 2000000000);
  EXPECT_THAT(decode_error(long_text), HasSubstr("ends within its header"));

  // 100 MB would be far less than any of them asks for, and far more than a refusal needs.
  EXPECT_LT(peak_kilobytes() - before, 100000);
}

TEST_F(DamagedPicture, PromisesBeyondTheFileCostNoMemory) {
  // 20000 x 10000 pixels are within the limits: 2.4 GB if they were there.
  write_exr(folder / "a.exr", random_picture(12, 9));
  auto bytes = bytes_of(folder / "a.exr");
  put_little_endian(bytes, value_place(bytes, "dataWindow", "box2i") + 8, 19999);
  put_little_endian(bytes, value_place(bytes, "dataWindow", "box2i") + 12, 9999);
  const auto before = peak_kilobytes();
  EXPECT_THAT(decode_error(bytes), HasSubstr("cannot read the picture: "));
  EXPECT_LT(peak_kilobytes() - before, 200000);
}

TEST_F(DamagedPicture, ChannelsOfAnotherKind) {
  write_exr(folder / "a.exr", Image(2, 2));
  auto bytes = bytes_of(folder / "a.exr");
  // The first channel of the list is called B.
  const auto list = value_place(bytes, "channels", "chlist");
  ASSERT_EQ(bytes.at(list), std::byte{'B'});
  auto renamed = bytes;
  renamed.at(list) = std::byte{'A'};
  EXPECT_THAT(decode_error(renamed), EndsWith("holds no channels R, G and B, only A, G, R"));
  auto mistyped = bytes;
  put_little_endian(mistyped, list + 2, 3);
  EXPECT_THAT(decode_error(mistyped), EndsWith("the EXR has a damaged list of channels"));
}

TEST_F(DamagedPicture, RandomDamageIsReadOrRefused) {
  const auto picture = random_picture(12, 9);
  write_exr(folder / "a.exr", picture);
  write_png(folder / "a.png", picture, 0.0);
  std::mt19937 engine(7);
  for (const char* name : {"a.exr", "a.png"}) {
    const auto whole = bytes_of(folder / name);
    int refused = 0;
    for (int round = 0; round < 300; ++round) {
      auto bytes = whole;
      for (unsigned k = 0; k <= engine() % 4U; ++k)
        bytes[engine() % bytes.size()] = static_cast<std::byte>(engine());
      try {
        const auto bitmap = decode_image(bytes, Encoding::linear, "damaged");
        EXPECT_EQ(bitmap.pixels.size(),
                  static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height));
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 0) << name;
  }
}

} // namespace
} // namespace meninas::test
