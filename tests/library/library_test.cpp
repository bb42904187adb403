// The library as its users have it: by its header alone.
#include "library/meninas.h"

#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <future>

namespace meninas {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Not;

Room gallery(const std::string& name, Settings settings = {}) {
  settings.emplace_back("quality", "draft");
  return Room(std::filesystem::path(test::source_dir()) / "scenes/gallery" / (name + ".gltf"), settings);
}

std::vector<float> copied(std::span<const float> values) { return {values.begin(), values.end()}; }

/// The error of a call that goes wrong.
template <typename Call>
Error error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return {Error::Kind::cancelled, "nothing went wrong"};
}

TEST(Library, NodesEmitWhatTheyAreTold) {
  const Room room = gallery("furnace"), dark = room.emitting({{"floor", {0.0, 0.0, 0.0}}});
  // One wall of six less: the others send less back to each other too, and the room itself is as it was.
  const auto before = room.solve(), after = dark.solve();
  for (std::size_t k = 0; k < after.irradiance().size(); ++k)
    EXPECT_LT(after.irradiance()[k], before.irradiance()[k]);
  EXPECT_EQ(copied(room.solve().irradiance()), copied(before.irradiance()));
  EXPECT_THAT(error_of([&] { room.emitting({{"nobody", {1.0, 1.0, 1.0}}}); }).what(), HasSubstr("no node 'nobody'"));
}

TEST(Library, ARoomNamesWhatItHas) {
  const Room room = gallery("cornell-mirror");
  EXPECT_THAT(room.cameras(), ElementsAre("main", "mirror"));
  EXPECT_THAT(room.lamps(), ElementsAre("lamp"));
  EXPECT_THAT(room.nodes(), testing::Contains("mirror"));
  EXPECT_THAT(room.plan(), HasSubstr("\"mirrors\""));
  EXPECT_THAT(version(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(Library, SettingsOfACallGoOverThoseOfItsRoom) {
  const Room room = gallery("furnace", {{"size", "6x5"}});
  EXPECT_EQ(room.render().width(), 6);
  EXPECT_EQ(room.render({{"size", "3x2"}}).width(), 3);
}

TEST(Library, PicturesAreTheSameBitsForAnyNumberOfThreadsAndFromAnyOfThem) {
  const Room room = gallery("cornell-mirror", {{"size", "24x24"}});
  const auto alone = copied(room.render({{"threads", "1"}}).pixels());
  auto first = std::async(std::launch::async, [&] { return copied(room.render().pixels()); });
  auto second = std::async(std::launch::async, [&] { return copied(room.render().pixels()); });
  EXPECT_EQ(first.get(), alone);
  EXPECT_EQ(second.get(), alone);
}

TEST(Library, LayersAddUpToThePicture) {
  const RoomPicture picture = gallery("cornell-mirror").render({{"size", "16x16"}, {"layers", "light"}});
  std::vector<float> sum(picture.pixels().size(), 0.0F);
  for (const std::string& name : picture.layers())
    for (std::size_t k = 0; k < sum.size(); ++k)
      sum[k] += picture.layer(name)[k];
  const float brightest = *std::ranges::max_element(picture.pixels());
  for (std::size_t k = 0; k < sum.size(); ++k)
    EXPECT_NEAR(sum[k], picture.pixels()[k], 1e-5F * brightest); // sums of nine floats in another order
  EXPECT_EQ(distance(picture, picture).rmse, 0.0);
}

TEST(Library, AReferenceAndAnErrorCanBeAskedFor) {
  const Room room = gallery("furnace", {{"size", "8x8"}});
  EXPECT_THAT(room.render({{"mode", "reference"}, {"samples", "64"}}).stats(), HasSubstr("standard_error"));
  EXPECT_THAT(room.render({{"error", "0.05"}}).stats(), HasSubstr("wanted_error"));
  EXPECT_THAT(error_of([&] { room.render({{"error", "0.05"}, {"quality", "fine"}}); }).what(), HasSubstr("chooses"));
}

TEST(Library, ASolutionIsLinearInItsLamps) {
  const RoomSolution solution = gallery("cornell-mirror").solve({{"by-lamp", ""}});
  const RoomSolution dimmed = solution.relit({{"lamp", {0.5, 0.25, 0.0}}});
  for (std::size_t k = 0; k < solution.irradiance().size(); k += 3) {
    EXPECT_EQ(dimmed.irradiance()[k], 0.5F * solution.irradiance()[k]);
    EXPECT_EQ(dimmed.irradiance()[k + 1], 0.25F * solution.irradiance()[k + 1]);
    EXPECT_EQ(dimmed.irradiance()[k + 2], 0.0F);
  }
  // Of light that is by lamp layers have the same sum.
  const RoomPicture lamps = solution.render({{"size", "8x8"}, {"layers", "lamps"}});
  EXPECT_THAT(lamps.layers(), ElementsAre("lamp.lamp"));
  EXPECT_EQ(copied(lamps.layer("lamp.lamp")), copied(lamps.pixels()));
}

TEST(Library, ADimmedSolutionIsThatOfARoomWithDimmedLamps) {
  // Lamps by another way: the scene itself. Both draw alike, so that all but rounding is the same.
  const Room room = gallery("cornell-mirror", {{"size", "16x16"}});
  const RoomPicture by_scene = room.render({{"lamp", "all=0.5"}});
  const RoomPicture by_solution = room.solve({{"by-lamp", ""}}).relit({{"all", {0.5, 0.5, 0.5}}}).render();
  EXPECT_LT(distance(by_solution, by_scene).rmse, 1e-5);
}

TEST(Library, AnEmptyRoomOfOneRadiosityShowsItAnywhere) {
  const RoomSolution solution = gallery("furnace").solve();
  double mean = 0.0;
  for (const float value : solution.irradiance())
    mean += value / static_cast<double>(solution.irradiance().size());
  const std::array points{MeasuringPoint{{0.1, 0.5, 0.2}, {0.0, 3.0, 0.0}}, MeasuringPoint{{0.3, 0.6, 0.4}, {1.0, -2.0, 0.5}}};
  for (const Arriving& at : solution.irradiance_at(points)) {
    EXPECT_FALSE(at.inside);
    for (const double channel : at.total)
      EXPECT_NEAR(channel, mean, 0.01 * mean); // the scatter of a draft's walls
  }
}

TEST(Library, FormFactorsOfAClosedRoomAddUpAndAreReciprocal) {
  const RoomFactors factors = gallery("furnace").form_factors({{"elements", "96"}, {"rays", "4096"}});
  const std::size_t size = factors.size();
  std::vector<double> exchange(size * size, 0.0);
  double largest = 0.0;
  for (std::size_t row = 0; row < size; ++row) {
    double sum = 0.0;
    for (auto k = factors.row_begin()[row]; k < factors.row_begin()[row + 1]; ++k) {
      const double weight = factors.weights()[k * static_cast<std::size_t>(factors.channels())];
      sum += weight;
      exchange[row * size + factors.columns()[k]] = factors.area()[row] * weight;
      largest = std::max(largest, factors.area()[row] * weight);
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
  }
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NEAR(exchange[i * size + j], exchange[j * size + i], 0.06 * largest); // 4096^-3/4 of a row, at 4 sigma of its largest
}

TEST(Library, WithoutMirrorsTheirLightIsLost) {
  const Room room = gallery("cornell-mirror");
  const auto sums = [&](const Settings& settings) {
    const RoomFactors factors = room.form_factors(settings);
    double sum = 0.0;
    for (const float weight : factors.weights())
      sum += weight;
    return sum / factors.channels();
  };
  EXPECT_LT(sums({{"elements", "96"}, {"mirror-depth", "0"}}), 0.99 * sums({{"elements", "96"}}));
}

TEST(Library, ErrorsAreOneLineAndSayWhoIsToBlame) {
  const Room room = gallery("furnace", {{"size", "4x4"}});
  const RoomPicture picture = room.render();
  struct Case {
    Error error;
    Error::Kind kind;
    std::string part;
  };
  const std::vector<Case> cases{
      {error_of([&] { room.render({{"qualty", "draft"}}); }), Error::Kind::usage, "did you mean 'quality'"},
      {error_of([&] { room.render({{"size", "4"}}); }), Error::Kind::usage, "size"},
      {error_of([&] { room.render({{"threads", "none"}}); }), Error::Kind::usage, "threads"},
      {error_of([&] { room.render({{"at", "1"}}); }), Error::Kind::usage, "where the room is loaded"},
      {error_of([&] { room.solve({{"lamp", "all=2"}}); }), Error::Kind::usage, "lamp: has no effect on a solution"},
      {error_of([&] { room.form_factors({{"samples", "4"}}); }), Error::Kind::usage, "samples: has no effect on form factors"},
      {error_of([&] { room.solve().render({{"rays", "64"}}); }), Error::Kind::usage, "rays: has no effect"},
      {error_of([&] { room.render({{"by-lamp", ""}}); }), Error::Kind::usage, "by-lamp: has no effect"},
      {error_of([&] { room.render({{"mode", "reference"}, {"error", "0.1"}}); }), Error::Kind::usage, "error: has no effect with mode reference"},
      {error_of([&] { picture.write("room.png", {{"camera", "main"}}); }), Error::Kind::usage, "camera: has no effect"},
      {error_of([&] { room.solve({{"by-lamp", ""}}).relit({{"all", {2, 2, 2}}}).relit({{"all", {2, 2, 2}}}); }), Error::Kind::usage, "relight the one"},
      {error_of([&] { room.solve({{"by-lamp", ""}}).relit({{"all", {1e38, 0, 0}}}); }), Error::Kind::usage, "from 0 to 1e+06"},
      {error_of([&] { const MeasuringPoint far{{1e18, 0, 0}, {0, 1, 0}}; room.solve().irradiance_at({&far, 1}); }), Error::Kind::usage, "within 1e+06 m"},
      {error_of([&] { room.solve().relit({{"all", {2, 2, 2}}}); }), Error::Kind::usage, "by-lamp"},
      {error_of([&] { room.solve({{"by-lamp", ""}}).relit({{"all", {-1, 2, 2}}}); }), Error::Kind::usage, "-1"},
      {error_of([&] { room.solve({{"by-lamp", "colour"}}); }), Error::Kind::usage, "colour"},
      {error_of([&] { room.solve().render({{"mode", "reference"}}); }), Error::Kind::usage, "a reference has no solution"},
      {error_of([&] { picture.layer("nobody"); }), Error::Kind::usage, "nobody"},
      {error_of([&] { distance(picture, room.render({{"size", "5x4"}})); }), Error::Kind::usage, "one size"},
      {error_of([&] { room.form_factors({{"elements", "20"}}).solve(std::vector<double>(3, 1.0)); }), Error::Kind::usage, "emission"},
      {error_of([&] { Room("nowhere.gltf"); }), Error::Kind::input, "nowhere.gltf"},
      {error_of([&] { room.read_solution("nowhere.glb"); }), Error::Kind::input, "nowhere.glb"},
      {error_of([&] { RoomPicture::read("nowhere.exr"); }), Error::Kind::input, "nowhere.exr"},
      {error_of([&] { picture.write("/no folder/room.png"); }), Error::Kind::output, "/no folder"},
      {error_of([&] { picture.write("room.bmp"); }), Error::Kind::output, "room.bmp"},
  };
  for (const Case& one : cases) {
    EXPECT_EQ(static_cast<int>(one.error.kind()), static_cast<int>(one.kind)) << one.error.what();
    EXPECT_THAT(one.error.what(), HasSubstr(one.part));
    EXPECT_THAT(one.error.what(), Not(HasSubstr("\n")));
  }
}

TEST(Library, CallsHeedWhatTheirRoomSaysAndLeaveTheRestAside) {
  const Room plain = gallery("cornell-mirror");
  const Room room = gallery("cornell-mirror", {{"lamp", "all=2"}, {"error", "0.2"}, {"samples", "4"}, {"size", "8x8"}});
  EXPECT_EQ(copied(room.solve().irradiance()), copied(plain.solve().irradiance()));
  const RoomFactors bright = room.form_factors({{"elements", "20"}}), as_it_is = plain.form_factors({{"elements", "20"}});
  for (std::size_t k = 0; k < bright.emission().size(); ++k)
    EXPECT_EQ(bright.emission()[k], 2.0 * as_it_is.emission()[k]);
}

TEST(Library, RowsAreInTheOrderOfTheirColumns) {
  const RoomFactors factors = gallery("cornell-mirror").form_factors({{"elements", "60"}});
  for (std::size_t row = 0; row < factors.size(); ++row)
    EXPECT_TRUE(std::ranges::is_sorted(
        factors.columns().subspan(factors.row_begin()[row], factors.row_begin()[row + 1] - factors.row_begin()[row])));
}

TEST(Library, WhatIsSaidOfAFileGoesOverWhatTheRenderSaid) {
  const RoomPicture picture = gallery("furnace", {{"size", "4x4"}}).render({{"exposure", "-3"}});
  const std::string file = testing::TempDir() + "meninas-library-test.png";
  picture.write(file);
  const float dim = RoomPicture::read(file).pixels()[0];
  picture.write(file, {{"depth", "16"}});
  const RoomPicture deep = RoomPicture::read(file);
  EXPECT_NEAR(deep.pixels()[0], dim, 0.01F); // the exposure is still that of the render; steps of 8 bits
  EXPECT_THAT(error_of([&] { deep.write(file); }).what(), HasSubstr("input")); // and what was read is kept
  picture.write(file, {{"exposure", "0"}});
  EXPECT_GT(RoomPicture::read(file).pixels()[0], 4.0F * dim);
  std::filesystem::remove(file);
}

TEST(Library, EndingACallOfNestedTasksLeavesNothingHalfDone) {
  // The analytic rows of a room with mirrors: tasks in tasks, ended at many places.
  const Room room = gallery("cornell-mirror");
  for (const int last : {1, 2, 3}) {
    std::atomic<int> calls{0};
    const Listener listener{{}, [&](const std::string&, double) { return ++calls < last; }};
    error_of([&] { room.form_factors({{"form-factors", "analytic"}, {"elements", "16"}}, listener); });
  }
  EXPECT_GT(room.form_factors({{"elements", "30"}}).size(), 0U);
}

TEST(Library, AListenerHearsAndMayEndACall) {
  std::vector<std::string> warnings;
  std::atomic<int> calls{0};
  Listener listener;
  listener.warning = [&](const std::string& text) { warnings.push_back(text); };
  listener.progress = [&](const std::string&, double done) {
    EXPECT_GE(done, 0.0);
    EXPECT_LE(done, 1.0);
    return ++calls < 3;
  };
  const Room room = gallery("cornell-mirror");
  EXPECT_EQ(static_cast<int>(error_of([&] { room.render({{"size", "64x64"}}, listener); }).kind()),
            static_cast<int>(Error::Kind::cancelled));
  EXPECT_GE(calls, 3);
  EXPECT_EQ(room.render({{"size", "4x4"}}).height(), 4); // and nothing is lost
}

} // namespace
} // namespace meninas
