// The lamps of a page: their light adds up to that of the room, and what is too much is refused.
#include "runs/walk/walk_lamps.h"

#include "radiosity/pass_one.h"
#include "raytrace/two_pass.h"
#include "runs/walk/walk_room.h"
#include "scenes/errors.h"
#include "tests/support/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas {
namespace {

using testing::HasSubstr;

/// A room with a small mirror, its lamp and a bulb, told apart.
WalkRoom room_with_two_lamps() {
  Scene scene = test::half_room_with_small_mirror();
  PunctualLight bulb;
  bulb.name = "bulb";
  bulb.position = {1.0, 1.0, 1.0};
  bulb.intensity = Rgb(0.5, 0.2, 0.1);
  scene.lights.push_back(bulb);
  PassOneSettings settings;
  settings.mesh.element_size = 0.4;
  settings.lamps = LampGrouping::node;
  const auto prepared = prepare_scene(std::move(scene), settings);
  return walk_room(solve_pass_one(prepared->light(), settings).field);
}

TEST(WalkLamps, AddUpToTheRoomAtEveryVertex) {
  const WalkRoom room = room_with_two_lamps();
  ASSERT_EQ(room.irradiance_by_lamp.size(), 2U);
  const std::vector<WalkLamp> whole(2), bulb{{"lamp", Rgb(0.0)}, {"bulb", Rgb(0.5, 1.0, 2.0)}};
  const auto sum = under_factors(room.irradiance_by_lamp, whole);
  const auto alone = under_factors(room.irradiance_by_lamp, bulb);
  ASSERT_EQ(sum.size(), room.vertices.size());
  for (std::size_t v = 0; v < sum.size(); ++v) {
    const glm::vec3& all = room.vertices[v].irradiance;
    for (int band = 0; band < 3; ++band) {
      // Sums of floats, of means of four.
      EXPECT_NEAR(sum[v][band], all[band], 2e-6 * largest(all)) << v;
      EXPECT_EQ(alone[v][band],
                static_cast<float>(bulb[1].factor[band]) * room.irradiance_by_lamp[1][v][band]);
    }
  }
}

TEST(WalkLamps, WhatGlowsKnowsItsLamp) {
  const WalkRoom room = room_with_two_lamps();
  std::size_t glowing = 0;
  for (const WalkLook& look : room.looks) {
    glowing += look.lamp == 0 ? 1 : 0;
    EXPECT_EQ(look.lamp != no_lamp, look.emission != Rgb(0.0)) << "the bulb has no surface";
  }
  EXPECT_GE(glowing, 1U);
}

TEST(WalkLamps, AreTooManyForAPageBeyondABound) {
  EXPECT_NO_THROW(check_walk_lamps("room.glb", max_walk_lamps, 0));
  const auto refusal = [](std::size_t lamps, std::size_t vertices) -> std::string {
    try {
      check_walk_lamps("room.glb", lamps, vertices);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(300, 0), HasSubstr("has 300 lamps, and a page has dimmers for 64 at the most"));
  EXPECT_THAT(refusal(17, 1'000'000), HasSubstr("a page takes 16 lamps at so many"));
  EXPECT_EQ(refusal(16, 1'000'000), "");
}

TEST(WalkLamps, AreHalvesByGreen) {
  const std::vector<glm::vec3> irradiance{{0.5F, 1.0F, 0.25F}, {-1.0F, 2.0F, 4.0F}};
  const float scale = scale_of_halves(irradiance);
  EXPECT_EQ(scale, 4.0F / 16384.0F);
  // 4096 is the half of exponent 12: twice as bright is one exponent, 1024, more. What is below 0 is dark.
  const std::uint32_t one = half_bits(1.0F / scale), exponent = 1024;
  EXPECT_EQ(one, (12U + 15U) << 10U);
  EXPECT_EQ(halves_by_green(irradiance, scale),
            (std::vector<std::uint32_t>{one, 0U - exponent, 0U - 2U * exponent, one + exponent, 0U - one - exponent, exponent}));
  EXPECT_EQ(scale_of_halves({}), 1.0F);
}

} // namespace
} // namespace meninas
