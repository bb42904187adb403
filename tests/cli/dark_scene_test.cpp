// What is said of pictures that are, or will be, black.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

using testing::HasSubstr;
using testing::Not;

Outcome render(const TinyRoom& room, std::vector<std::string> options, Image* picture = nullptr) {
  const TemporaryFolder folder;
  write_room(folder / "room.glb", room);
  options.insert(options.begin(), {"render", "room.glb", "-o", "out.exr", "--size", "16x12",
                                   "--quality", "draft", "--quiet"});
  Outcome outcome = run_program(folder.path(), options);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  if (picture != nullptr) {
    *picture = read_image(folder / "out.exr").picture;
  }
  return outcome;
}

TinyRoom room_without_lamp() {
  TinyRoom room = tiny_room();
  room.root["materials"][1].erase("emissiveFactor");
  return room;
}

TEST(DarkScene, WithoutAnEmitterThePictureIsBlackAndThatIsSaid) {
  Image picture;
  const Outcome outcome = render(room_without_lamp(), {}, &picture);
  EXPECT_EQ(outcome.err, "meninas: warning: nothing emits light: the picture will be black; "
                         "--background 1 lights it from all around\n");
  for (const glm::vec3& pixel : picture.pixels) {
    ASSERT_EQ(pixel, glm::vec3(0.0F));
  }
}

TEST(DarkScene, UnderABackgroundNothingIsSaidOfBlackPictures) {
  for (const char* mode : {"hybrid", "reference"}) {
    const std::vector<std::string> options{"--mode", mode, "--samples", "1"};
    EXPECT_THAT(render(room_without_lamp(), options).err, HasSubstr("nothing emits light")) << mode;
    std::vector<std::string> lit = options;
    lit.insert(lit.end(), {"--background", "1"});
    EXPECT_THAT(render(room_without_lamp(), lit).err, Not(HasSubstr("nothing emits light")))
        << mode;
  }
}

TEST(DarkScene, ABlackPictureOfALitSceneIsSaidToBe) {
  TinyRoom room = tiny_room();
  room.root["nodes"][7]["translation"] = {0, 100, 0}; // above the room, looking along it
  const Outcome outcome = render(room, {"--stats", "a.json"});
  EXPECT_THAT(outcome.err, Not(HasSubstr(" off"))) << "there is nothing to be relative to";
  EXPECT_THAT(outcome.err, HasSubstr("the picture is black: no light reaches what camera"));
}

} // namespace
} // namespace meninas::test
