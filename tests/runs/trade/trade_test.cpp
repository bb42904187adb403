// Fronts, turns of parameters, and how a sweep spends its budget,
// on a scene whose times and errors are made up.
#include "runs/steering/setting_options.h"
#include "runs/trade/trade_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace meninas {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TradePoint point_of(double seconds, double error) {
  TradePoint point;
  point.seconds = {seconds};
  point.errors = {error};
  return point;
}

TEST(ParetoFront, HoldsWhatNoOtherBeats) {
  EXPECT_THAT(pareto_front({}), IsEmpty());
  EXPECT_THAT(
      pareto_front({point_of(3, 0.1), point_of(1, 0.5), point_of(2, 0.6), point_of(2, 0.2)}),
      ElementsAre(1, 3, 0));
  EXPECT_THAT(pareto_front({point_of(1, 0.5), point_of(1, 0.5), point_of(1, 0.4)}), ElementsAre(2));
  EXPECT_THAT(pareto_front({point_of(1, 0.5), point_of(2, 0.5)}), ElementsAre(0))
      << "slower, no better";
}

TEST(ParetoFront, SpreadIsRelativeToTheMean) {
  EXPECT_DOUBLE_EQ(mean_of(std::vector{1.0, 3.0}), 2.0);
  EXPECT_DOUBLE_EQ(spread_of({1.0, 3.0}), 1.0);
  EXPECT_DOUBLE_EQ(spread_of({}), 0.0);
}

const TradeScene room{.mirrors = true};

std::set<std::string> parameters_of(const RunSettings& settings, const TradeScene& scene) {
  std::set<std::string> parameters;
  for (const ChangedSettings& next : turned(spelled_out(settings), scene))
    parameters.insert(next.turn.parameter);
  return parameters;
}

TEST(Parameters, AreAllTurned) {
  EXPECT_THAT(parameters_of({}, room),
              ElementsAre("bends", "diffuse", "elements", "form-factors", "interpolation", "link-error",
                          "mesh", "mirror-depth", "pixel-error", "rays", "samples", "solver",
                          "tolerance"));
  EXPECT_FALSE(parameters_of({}, {.mirrors = false}).contains("mirror-depth"));
}

// A quick look has its numbers written out as the presets have: each can be turned.
TEST(Parameters, OfAQuickLookAreTurnedToo) {
  std::set<std::string> link_errors;
  for (const ChangedSettings& next : turned(first_settings({}).front(), room))
    if (next.turn.parameter == "link-error")
      link_errors.insert(next.turn.from + " " + next.turn.to);
  EXPECT_THAT(link_errors, ElementsAre("0.02 0.01", "0.02 0.04"));
}

TEST(Parameters, EveryTurnIsAnotherSettingAndSaysWhichValueItTook) {
  const RunSettings settings = spelled_out({});
  std::set<std::vector<std::string>> all{options_of(settings)};
  for (const ChangedSettings& next : turned(settings, room)) {
    EXPECT_TRUE(all.insert(options_of(next.settings)).second) << next.turn.parameter;
    EXPECT_NE(next.turn.from, next.turn.to);
  }
}

TEST(Parameters, ElementsAreDoubledAndHalvedWithinLimits) {
  const auto elements = [](int from) {
    RunSettings settings = spelled_out({});
    settings.elements = from;
    std::vector<std::pair<int, bool>> all;
    for (const ChangedSettings& next : turned(settings, room))
      if (next.turn.parameter == "elements")
        all.emplace_back(*next.settings.elements, next.finer);
    return all;
  };
  using Turns = std::vector<std::pair<int, bool>>;
  EXPECT_EQ(*spelled_out({}).elements, 16'000);
  EXPECT_EQ(elements(2250), (Turns{{4500, true}, {1125, false}}));
  EXPECT_EQ(elements(150), (Turns{{300, true}}));
  EXPECT_EQ(elements(150'000), (Turns{{75'000, false}}));
}

TEST(Parameters, ManySamplesCanBeMadeAdaptiveAndThenMoreOrLessSo) {
  const auto pixel_errors = [](const RunSettings& settings) {
    std::set<std::pair<std::string, bool>> all;
    for (const ChangedSettings& next : turned(settings, room))
      if (next.turn.parameter == "pixel-error")
        all.insert({next.turn.to, next.finer});
    return all;
  };
  using Turns = std::set<std::pair<std::string, bool>>;
  RunSettings settings = spelled_out({});
  EXPECT_EQ(settings.pixel_error, preset_of(Quality::normal).pixel_error);
  settings.pixel_error.reset();
  settings.samples = 4;
  EXPECT_EQ(pixel_errors(settings), Turns{});
  settings.samples = 16;
  EXPECT_EQ(pixel_errors(settings), (Turns{{"0.05", false}}));
  settings.pixel_error = 0.05;
  EXPECT_EQ(pixel_errors(settings), (Turns{{"0.025", true}, {"0.1", false}}));
}

TEST(Parameters, LightThatIsNotToldApartIsNotComputedAtHits) {
  const auto turns_diffuse = [](const RunSettings& settings) {
    return std::ranges::any_of(turned(spelled_out(settings), room),
                               [](const auto& next) { return next.turn.parameter == "diffuse"; });
  };
  RunSettings settings;
  settings.interpolation = Interpolation::average;
  EXPECT_TRUE(turns_diffuse(settings));
  settings.form_factors = FormFactorMethod::analytic;
  EXPECT_FALSE(turns_diffuse(settings));
}

TEST(Parameters, OptionsSayWhatDiffersFromTheDefaults) {
  EXPECT_THAT(options_of({}), IsEmpty());
  RunSettings settings;
  settings.quality = Quality::draft;
  settings.element_size = 0.1;
  settings.rays = 64;
  settings.diffuse = DiffuseTerm::direct;
  settings.mesh = MeshCut::uniform;
  settings.background = Rgb(0.5, 0.0, 1.0);
  EXPECT_THAT(options_of(settings),
              ElementsAre("--quality", "draft", "--background", "0.5,0,1", "--element-size", "0.1",
                          "--mesh", "uniform", "--rays", "64", "--diffuse", "direct"));
  settings = {};
  settings.elements = 4'000'000;
  EXPECT_THAT(options_of(settings), ElementsAre("--elements", "4000000"));
}

/// A clock that only measuring moves:
/// more elements, rays and samples take longer and are more accurate.
struct MadeUp {
  double clock = 0.0;

  void measure(TradePoint& point) {
    const RunSettings& s = point.settings;
    const double elements = *s.elements, rays = s.rays.value_or(256), samples = *s.samples;
    const double seconds = 1e-7 * elements * (rays + 128.0) + 2e-3 * samples;
    point.seconds.push_back(seconds);
    point.processor_seconds.push_back(2.0 * seconds);
    point.errors.push_back(std::sqrt(1.0 / elements + 0.2 / (rays * rays) + 1e-3 / samples));
    clock += seconds;
  }
  std::vector<TradePoint> sweep_for(double budget) {
    return sweep({}, room, [this](TradePoint& point) { measure(point); },
                 {budget, [this] { return clock; }, {}});
  }
};

TEST(Sweep, KeepsToItsBudgetAndMeasuresSomethingWithNone) {
  for (const double budget : {1.0, 4.0, 20.0}) {
    MadeUp made_up;
    const auto points = made_up.sweep_for(budget);
    EXPECT_LT(made_up.clock, 1.3 * budget) << "the last one may take longer than was expected";
    EXPECT_GT(made_up.clock, 0.7 * budget);
  }
  MadeUp made_up;
  EXPECT_EQ(made_up.sweep_for(1e-9).size(), 2U);
}

TEST(Sweep, MoreBudgetFindsABetterFront) {
  const auto best = [](double budget) {
    MadeUp made_up;
    const auto points = made_up.sweep_for(budget);
    return mean_of(points[pareto_front(points).back()].errors);
  };
  EXPECT_LT(best(30.0), 0.7 * best(1.0));
}

TEST(Sweep, PointsDifferAndKnowWhereTheyCameFrom) {
  MadeUp made_up;
  const auto points = made_up.sweep_for(20.0);
  std::set<std::vector<std::string>> all;
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_TRUE(all.insert(options_of(points[k].settings)).second) << k;
    for (const ParameterChange& turn : points[k].turns)
      EXPECT_LT(turn.parent, k);
  }
}

TEST(Sweep, RepeatsItsFront) {
  MadeUp made_up;
  const auto points = made_up.sweep_for(20.0);
  const auto front = pareto_front(points);
  const auto repeated =
      std::ranges::count_if(front, [&](std::size_t k) { return points[k].seconds.size() >= 2; });
  EXPECT_GE(2 * static_cast<std::size_t>(repeated), front.size())
      << "the faster half at least: a fifth of the budget is for that";
}

} // namespace
} // namespace meninas
