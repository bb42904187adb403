// What is written of a picture whose light 16 bits do not hold.
#include "runs/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace meninas::test {
namespace {

struct Written {
  glm::vec3 brightest{0.0F};
  std::vector<std::string> notes;
};

/// A picture of two pixels, the second a tenth as bright, as it comes back from its file.
Written written(float brightest) {
  std::string place = std::filesystem::temp_directory_path() / "meninas-outputs-XXXXXX";
  const std::filesystem::path folder = mkdtemp(place.data());
  Image picture(2, 1);
  picture.pixels = {glm::vec3(brightest), glm::vec3(0.1F * brightest)};
  Written result;
  const RunEvents events{.warning = {},
                         .note = [&](const std::string& text) { result.notes.push_back(text); },
                         .progress = {},
                         .stages = {}};
  write_pictures({folder / "a.exr"}, {picture}, {}, {}, events);
  result.brightest = read_image(folder / "a.exr").picture.pixels[0];
  std::filesystem::remove_all(folder);
  return result;
}

TEST(WritePictures, HalvesHoldOrdinaryLight) {
  constexpr float third = 1.0F / 3.0F;
  const Written ordinary = written(third);
  EXPECT_NE(ordinary.brightest.g, third);
  EXPECT_NEAR(ordinary.brightest.g, third, third * 0x1p-11F);
  EXPECT_THAT(ordinary.notes, testing::IsEmpty());
  EXPECT_THAT(written(0.0F).notes, testing::IsEmpty()) << "darkness is held by anything";
}

TEST(WritePictures, LightThatHalvesDoNotHoldIsNotLost) {
  for (const float brightest : {7e4F, 3e30F, 1e-4F, 1e-20F}) {
    const Written kept = written(brightest);
    EXPECT_EQ(kept.brightest.g, brightest);
    EXPECT_THAT(kept.notes, testing::ElementsAre(testing::HasSubstr("32 bits a channel")));
  }
}

} // namespace
} // namespace meninas::test
