#include "runs/trade/trade_sweep.h"

#include "runs/steering/setting_options.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace meninas {

namespace {

struct Sweeping {
  const RunSettings& base;
  const TradeScene& scene;
  const MeasurePoint& measure;
  const SweepSettings& settings;
  std::vector<TradePoint> points = {};
  std::set<std::vector<std::string>> tried = {};

  double left(double share) const { return share * settings.budget - settings.spent(); }

  /// Whether it was new.
  bool add(const RunSettings& chosen, std::vector<ParameterChange> turns) {
    if (!tried.insert(options_of(chosen)).second)
      return false;
    TradePoint point;
    point.settings = chosen;
    point.turns = std::move(turns);
    measure_again(point);
    points.push_back(std::move(point));
    return true;
  }
  void measure_again(TradePoint& point) {
    if (settings.progress)
      settings.progress("trade", std::min(settings.spent() / settings.budget, 1.0));
    measure(point);
  }
};

/// What share of a picture's squared error a finer turn may take away,
/// or a coarser one touches, by the picture's own estimate of its parts.
double at_stake(const ParameterChange& turn, const PictureError& e) {
  const double all = e.total * e.total;
  if (!(all > 0.0))
    return 0.0;
  const auto share = [&](double part, double of_it) { return of_it * part * part / all; };
  if (turn.parameter == "elements")
    return share(e.mesh, 0.4);
  if (turn.parameter == "link-error")
    return share(e.mesh, 0.6);
  if (turn.parameter == "diffuse")
    return turn.to == name_of(DiffuseTerm::gather) ? share(std::hypot(e.mesh, e.form_factors), 0.9)
                                                   : share(e.mesh_direct, 1.0);
  if (turn.parameter == "rays" || turn.parameter == "hemicube-resolution")
    return share(e.form_factors, 0.55);
  if (turn.parameter == "samples")
    return share(e.pixels, 0.9);
  if (turn.parameter == "pixel-error")
    return share(e.pixels, 0.6);
  return 0.0;
}

/// The finer ones first, those with most at stake before others;
/// then the coarser ones, those with least.
std::vector<ChangedSettings> ranked_turns(const TradePoint& point, const TradeScene& scene) {
  std::vector<ChangedSettings> turns = turned(point.settings, scene);
  const auto rank = [&](const ChangedSettings& next) {
    const double stake = at_stake(next.turn, point.estimate);
    return next.finer ? stake : -1.0 - stake;
  };
  std::ranges::stable_sort(turns, std::greater{}, rank);
  return turns;
}

/// A turn takes about as long as what it was turned from, a finer one twice as long;
/// gathering at every hit tens of times.
double expected_seconds(const TradePoint& parent, const ChangedSettings& next) {
  constexpr double longer = 2.5, gathering = 30.0;
  if (next.settings.diffuse == DiffuseTerm::gather &&
      parent.settings.diffuse != DiffuseTerm::gather)
    return gathering * mean_of(parent.seconds);
  return (next.finer ? longer : 1.0) * mean_of(parent.seconds);
}

bool turn_from(Sweeping& sweeping, std::size_t parent, ChangedSettings next) {
  next.turn.parent = parent;
  return sweeping.add(next.settings, {next.turn});
}

/// Every parameter, one turn from a point.
void turn_all(Sweeping& sweeping, std::size_t parent, double share) {
  for (ChangedSettings& next : ranked_turns(sweeping.points[parent], sweeping.scene)) {
    if (sweeping.left(share) < expected_seconds(sweeping.points[parent], next))
      continue;
    turn_from(sweeping, parent, std::move(next));
  }
}

/// A gap of the front: between two of its points, or beyond its last.
struct Gap {
  std::size_t fast = 0;
  std::optional<std::size_t> slow = {};
  double width = 0.0;
};

std::vector<Gap> gaps_of(const std::vector<TradePoint>& points) {
  constexpr double open_end =
      1.4; // a factor of four in either: the last point is always worth a look
  constexpr double least = 1e-9;
  const auto front = pareto_front(points);
  std::vector<Gap> gaps;
  for (std::size_t k = 0; k + 1 < front.size(); ++k) {
    const TradePoint &a = points[front[k]], &b = points[front[k + 1]];
    gaps.push_back({front[k], front[k + 1],
                    std::hypot(std::log(mean_of(b.seconds) / mean_of(a.seconds)),
                               std::log(std::max(mean_of(a.errors), least) /
                                        std::max(mean_of(b.errors), least)))});
  }
  if (!front.empty())
    gaps.push_back({front.back(), std::nullopt, open_end});
  std::ranges::stable_sort(gaps, std::greater{}, &Gap::width);
  return gaps;
}

/// One new point in a gap. False where all turns have been tried, or do not fit.
bool look_into(Sweeping& sweeping, const Gap& gap, double share) {
  const auto try_turns = [&](std::size_t parent, bool finer) {
    const TradePoint& point = sweeping.points[parent];
    for (ChangedSettings& next : ranked_turns(point, sweeping.scene))
      if (next.finer == finer && sweeping.left(share) >= expected_seconds(point, next) &&
          turn_from(sweeping, parent, std::move(next)))
        return true;
    return false;
  };
  return try_turns(gap.fast, true) || (gap.slow && try_turns(*gap.slow, false));
}

void repeat_front(Sweeping& sweeping) {
  constexpr std::size_t most = 3;
  for (std::size_t times = 1; times < most; ++times)
    for (const std::size_t k : pareto_front(sweeping.points)) {
      TradePoint& point = sweeping.points[k];
      if (point.seconds.size() <= times && sweeping.left(1.0) > mean_of(point.seconds))
        sweeping.measure_again(point);
    }
}

} // namespace

std::vector<TradePoint> sweep(const RunSettings& base, const TradeScene& scene,
                              const MeasurePoint& measure, const SweepSettings& settings) {
  constexpr double for_parameters = 0.5, for_gaps = 0.8;
  Sweeping sweeping{base, scene, measure, settings};
  for (const RunSettings& first : first_settings(base)) {
    // A preset has four to eight times the elements of the one before, and as many times the rays.
    constexpr double longer = 25.0;
    if (sweeping.points.size() < 2 ||
        sweeping.left(for_parameters) > longer * mean_of(sweeping.points.back().seconds))
      sweeping.add(first, {});
  }
  const std::size_t draft = std::min<std::size_t>(1, sweeping.points.size() - 1);
  turn_all(sweeping, draft, for_parameters);
  for (bool found = true; found;) {
    found = false;
    for (const Gap& gap : gaps_of(sweeping.points))
      if (look_into(sweeping, gap, for_gaps)) {
        found = true;
        break;
      }
  }
  repeat_front(sweeping);
  return std::move(sweeping.points);
}

} // namespace meninas
