#include "form_factors/extended_form_factor.h"

#include "form_factors/clear_form_factors.h"
#include "form_factors/error_sum.h"
#include "form_factors/kaleidoscope.h"
#include "form_factors/sender_triangles.h"
#include "form_factors/world_shares.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <queue>
#include <tuple>

namespace meninas {

namespace {

/// Radon's rule of degree five on a triangle:
/// barycentric weights of its points, and their shares of the area.
struct TrianglePoint {
  double b0, b1, b2, weight;
};
constexpr double r1 = 0.101286507323456338800987361915123, w1 = 0.125939180544827152595683945500181;
constexpr double r2 = 0.470142064105115089770441209513447, w2 = 0.132394152788506180737649387833152;
constexpr std::array<TrianglePoint, 7> radon{{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.225},
                                              {1.0 - 2.0 * r1, r1, r1, w1},
                                              {r1, 1.0 - 2.0 * r1, r1, w1},
                                              {r1, r1, 1.0 - 2.0 * r1, w1},
                                              {1.0 - 2.0 * r2, r2, r2, w2},
                                              {r2, 1.0 - 2.0 * r2, r2, w2},
                                              {r2, r2, 1.0 - 2.0 * r2, w2}}};

/// A triangle of A with the integrals over it.
struct Region : SenderTriangle {
  WorldShares shares;
  WorldShares errors;
  double tail = 0.0;
};

class Integration {
public:
  Integration(const WorldView& view, const std::vector<Face>& from, std::size_t groups,
              const ExtendedSettings& settings)
      : view_(view), from_(from), settings_(settings), groups_(groups), index_(view.mirrors),
        clear_(clear_form_factors(view, from, groups)), weights_(groups, 1.0), errors_(groups) {
    for (const Face& face : from)
      area_ += face.area;
  }

  ExtendedFactors run() {
    const std::vector<Sender> asked = senders();
    if (!asked.empty()) {
      std::vector<Region> whole = first_regions(asked, affordable_points(triangles_of(asked)));
      evaluate(whole);
      choose_weights(whole);
      split(whole);
      refine();
    }
    return result();
  }

private:
  bool uses_mirrors() const { return !view_.mirrors.mirrors.empty() && settings_.max_depth > 0; }

  bool needs_points(std::size_t face) const {
    if (uses_mirrors())
      return true;
    const auto& known = clear_.known[face];
    return std::any_of(known.begin(), known.end(), [](std::uint8_t k) { return k == 0; });
  }

  /// The sending faces that are looked at from points.
  std::vector<Sender> senders() const {
    std::vector<Sender> senders;
    for (std::uint32_t f = 0; f < from_.size(); ++f)
      if (needs_points(f))
        senders.push_back({from_[f], f, clear_.known[f]});
    return senders;
  }

  /// The senders cut, as far as there is time for the points of their parts: all are split once.
  std::vector<Region> first_regions(std::span<const Sender> senders, std::size_t max_points) {
    const CutLimits limits{uses_mirrors(), settings_.max_discontinuity_lines / from_.size(),
                           max_points / (5 * radon.size())};
    const CutSenders cut = cut_senders(senders, view_, limits);
    cut_short_ = cut.cut_short;
    std::vector<Region> regions;
    for (const SenderTriangle& triangle : cut.triangles)
      regions.push_back({triangle, {}, {}, 0.0});
    return regions;
  }

  WalkPoint point_of(const SenderTriangle& triangle, const TrianglePoint& p) const {
    const Face& face = from_[triangle.face];
    const auto& c = triangle.corners;
    return {p.b0 * c[0] + p.b1 * c[1] + p.b2 * c[2], face.plane.normal, face.plane_class};
  }

  WalkResult walk_from(const SenderTriangle& triangle, const TrianglePoint& p) const {
    return walk_worlds(view_, point_of(triangle, p), walk_, clear_.known[triangle.face]);
  }

  double total_of(const WorldShares& shares) const {
    double sum = 0.0;
    for (const WalkShare& share : shares)
      sum += weights_[share.group] * mean_of(index_[share.world].throughput) * share.factor;
    return sum;
  }

  /// Chooses the tail that may be left out at each point, a part of the wanted accuracy, by a first look
  /// from a few points. By what a second look takes, the number of points that there is time for.
  std::size_t affordable_points(const std::vector<SenderTriangle>& triangles) {
    constexpr double part = 0.2, first_look = 1e-2, min_factor = 1e-4;
    constexpr std::size_t looks = 8;
    walk_.max_depth = settings_.max_depth;
    walk_.tail = first_look;
    WorldShares seen;
    const std::size_t stride = (triangles.size() + looks - 1) / looks;
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); t += stride, ++count)
      append(seen, walk_from(triangles[t], radon[0]), 1.0, index_);
    double factor = total_of(seen) / static_cast<double>(std::max<std::size_t>(count, 1));
    for (const Estimate& closed : clear_.factors)
      factor += closed.value;
    walk_.tail = part * settings_.accuracy * std::max(factor, min_factor);

    std::size_t work = count;
    for (std::size_t t = 0; t < triangles.size(); t += stride)
      work += walk_from(triangles[t], radon[0]).work;
    const double points = static_cast<double>(settings_.max_work) * static_cast<double>(count) / static_cast<double>(work);
    return static_cast<std::size_t>(std::min(static_cast<double>(settings_.max_points), points));
  }

  /// Fills in the integrals over the regions, some hundred at a time.
  void evaluate(std::vector<Region>& regions) {
    for (std::size_t first = 0; first < regions.size(); first += batch_) {
      const std::size_t count = std::min(batch_, regions.size() - first);
      std::vector<WalkResult> walks(count * radon.size());
      // The loop is isolated from a caller's cancellation, because half of the result would be read.
      tbb::task_group_context alone(tbb::task_group_context::isolated);
      tbb::parallel_for(std::size_t{0}, walks.size(), [&](std::size_t k) {
        const Region& region = regions[first + k / radon.size()];
        walks[k] = walk_from(region, radon[k % radon.size()]);
      }, alone);
      for (std::size_t k = 0; k < walks.size(); ++k) {
        Region& region = regions[first + k / radon.size()];
        const double weight = radon[k % radon.size()].weight * region.area / area_;
        append(region.shares, walks[k], weight, index_);
        region.tail += weight * walks[k].tail;
        visits_ += walks[k].worlds.size();
        work_ += walks[k].work;
      }
      for (std::size_t r = 0; r < count; ++r)
        combine(regions[first + r].shares);
      points_ += walks.size();
      // The views of the points are kept until they are added up:
      // as many at once as memory has room for.
      batch_ = std::clamp<std::size_t>(max_kept * points_ / (radon.size() * (visits_ + 1)), 1,
                                       max_regions);
    }
  }

  /// The change of a group's total:
  /// as it adds up, and with the near worlds taken one by one, all others together.
  struct Change {
    double error = 0.0, signed_error = 0.0;
  };

  std::vector<Change> changes_by_group(const WorldShares& changes) const {
    constexpr int near = 2;
    std::vector<Change> by_group(groups_);
    std::vector<double> rest(groups_, 0.0);
    for (const WalkShare& change : changes) {
      const auto& world = index_[change.world];
      const double light = mean_of(world.throughput) * change.factor;
      by_group[change.group].signed_error += light;
      if (world.depth <= near)
        by_group[change.group].error += std::abs(light);
      else
        rest[change.group] += light;
    }
    for (std::size_t g = 0; g < groups_; ++g)
      by_group[g].error += std::abs(rest[g]);
    return by_group;
  }

  /// Replaces each region by four, with errors from what that changed.
  void split(const std::vector<Region>& parents) {
    std::vector<Region> children;
    for (const Region& parent : parents) {
      const auto& c = parent.corners;
      const Point3 m01 = 0.5 * (c[0] + c[1]), m12 = 0.5 * (c[1] + c[2]), m20 = 0.5 * (c[2] + c[0]);
      for (const auto& corners : {std::array{c[0], m01, m20}, std::array{m01, c[1], m12},
                                  std::array{m20, m12, c[2]}, std::array{m12, m20, m01}}) {
        Region child;
        child.corners = corners;
        child.face = parent.face;
        child.area = 0.25 * parent.area;
        children.push_back(std::move(child));
      }
    }
    evaluate(children);
    for (std::size_t p = 0; p < parents.size(); ++p) {
      WorldShares sum;
      for (std::size_t k = 4 * p; k < 4 * p + 4; ++k)
        sum.insert(sum.end(), children[k].shares.begin(), children[k].shares.end());
      combine(sum);
      WorldShares changes = difference(sum, parents[p].shares);

      // Splitting halves an error at the least (a jump),
      // so what is left is no more than the change: a quarter of it in each.
      for (WalkShare& change : changes)
        change.factor *= 0.25;
      for (std::size_t k = 4 * p; k < 4 * p + 4; ++k) {
        children[k].errors = changes;
        push(std::move(children[k]));
      }
    }
  }

  void push(Region region) {
    value_ += total_of(region.shares);
    const auto changes = changes_by_group(region.errors);
    double error = 0.0;
    for (std::size_t g = 0; g < groups_; ++g) {
      errors_[g].add(changes[g].error, changes[g].signed_error);
      error += weights_[g] * changes[g].error;
    }
    heap_.emplace(error, regions_.size());
    regions_.push_back(std::move(region));
  }

  Region pop() {
    Region region = std::move(regions_[heap_.top().second]);
    regions_[heap_.top().second] = {};
    heap_.pop();
    value_ -= total_of(region.shares);
    const auto changes = changes_by_group(region.errors);
    for (std::size_t g = 0; g < groups_; ++g)
      errors_[g].remove(changes[g].error, changes[g].signed_error);
    return region;
  }

  double closed_value() const {
    double sum = 0.0;
    for (std::size_t g = 0; g < groups_; ++g)
      sum += weights_[g] * clear_.factors[g].value;
    return sum;
  }

  /// Half of the weight is that of the factors themselves, half that of what they bring.
  void choose_weights(const std::vector<Region>& regions) {
    if (settings_.importance.empty())
      return;
    double all = 0.0, important = 0.0;
    const auto add = [&](std::size_t group, double factor) {
      all += factor;
      important += settings_.importance[group] * factor;
    };
    for (std::size_t g = 0; g < groups_; ++g)
      add(g, clear_.factors[g].value);
    for (const Region& region : regions)
      for (const WalkShare& share : region.shares)
        add(share.group, mean_of(index_[share.world].throughput) * share.factor);
    if (important > 0.0)
      for (std::size_t g = 0; g < groups_; ++g)
        weights_[g] = 1.0 + settings_.importance[g] * all / important;
  }

  bool has_settled() const {
    constexpr double part = 0.7, rounding = 1e-15;
    double error = 0.0;
    for (std::size_t g = 0; g < groups_; ++g)
      error += weights_[g] * errors_[g].estimate();
    return error <= part * settings_.accuracy * (value_ + closed_value()) + rounding;
  }

  void refine() {
    constexpr std::size_t max_at_once = 8;
    while (!has_settled() && points_ < settings_.max_points && visits_ < settings_.max_visits &&
           work_ < settings_.max_work) {
      std::vector<Region> parents;
      const double largest = heap_.top().first;
      while (parents.size() < max_at_once && !heap_.empty() && heap_.top().first >= 0.25 * largest)
        parents.push_back(pop());
      split(parents);
    }
  }

  ExtendedFactors result() const {
    ExtendedFactors factors;
    factors.points = points_;
    factors.to.resize(groups_);
    WorldShares sum, errors;
    double tail = 0.0;
    for (const Region& region : regions_) {
      sum.insert(sum.end(), region.shares.begin(), region.shares.end());
      tail += region.tail;
      for (WalkShare error : region.errors) {
        error.factor = std::abs(error.factor);
        errors.push_back(error);
      }
    }
    for (std::uint32_t g = 0; g < groups_; ++g) {
      if (clear_.factors[g].value > 0.0)
        sum.push_back({0, g, clear_.factors[g].value});
      errors.push_back({0, g, clear_.factors[g].error});
      factors.to[g].total.error = tail;
    }
    factors.tail = tail;
    combine(sum);
    combine(errors);
    add_worlds(sum, errors, factors);
    double error = 0.0, value = 0.0;
    for (const ExtendedFactor& factor : factors.to) {
      value += factor.total.value;
      error = std::max(error, factor.total.error);
    }
    factors.converged = !cut_short_ && error <= settings_.accuracy * value + 1e-15;
    return factors;
  }

  void add_worlds(const WorldShares& sum, const WorldShares& errors,
                  ExtendedFactors& factors) const {
    auto error = errors.begin();
    for (const WalkShare& share : sum) {
      const auto before = [](const WalkShare& a, const WalkShare& b) {
        return std::tie(a.world, a.group) < std::tie(b.world, b.group);
      };
      error = std::lower_bound(error, errors.end(), share, before);
      const bool found =
          error != errors.end() && error->world == share.world && error->group == share.group;
      const Rgb& throughput = index_[share.world].throughput;
      ExtendedFactor& factor = factors.to[share.group];
      factor.total.value += mean_of(throughput) * share.factor;
      factor.light += throughput * share.factor;
      factor.geometric += share.factor;
      if (settings_.listing == WorldListing::worlds)
        factor.worlds.push_back({index_.chain_of(share.world),
                                 throughput,
                                 {share.factor, found ? error->factor : 0.0}});
    }
    for (std::uint32_t g = 0; g < groups_; ++g) {
      factors.to[g].total.error += clear_.factors[g].error + errors_[g].estimate();
      sort_worlds(factors.to[g]);
    }
  }

  const WorldView& view_;
  const std::vector<Face>& from_;
  const ExtendedSettings& settings_;
  std::size_t groups_;
  double area_ = 0.0;
  WorldIndex index_;
  WalkSettings walk_;
  static constexpr std::size_t max_kept = 4'000'000, max_regions = 64;
  std::size_t batch_ = 2; ///< regions evaluated at once
  ClearFormFactors clear_;
  std::vector<double> weights_; ///< by group: how much its errors count
  std::vector<Region> regions_;
  std::priority_queue<std::pair<double, std::size_t>>
      heap_; ///< the region with the largest error first
  double value_ = 0.0;
  std::vector<ErrorSum> errors_; ///< by group, of the regions
  std::size_t points_ = 0, visits_ = 0, work_ = 0;
  bool cut_short_ = false;
};

} // namespace

void sort_worlds(ExtendedFactor& factor) {
  std::stable_sort(
      factor.worlds.begin(), factor.worlds.end(), [](const WorldFactor& a, const WorldFactor& b) {
        return mean_of(a.throughput) * a.factor.value > mean_of(b.throughput) * b.factor.value;
      });
}

ExtendedFactors extended_form_factors(const WorldView& view, const std::vector<Face>& from,
                                      std::size_t group_count, const ExtendedSettings& settings) {
  // Few images in the corner of mirrors are left to the points, which tell the chains apart.
  constexpr std::size_t few = 64;
  const auto cell = settings.max_depth > 0 ? find_kaleidoscope(view, from) : std::nullopt;
  if (cell) {
    ExtendedFactors factors = kaleidoscope_form_factors(view, from, group_count, settings, *cell);
    if (!cell->corners || factors.points > few)
      return factors;
  }
  return Integration(view, from, group_count, settings).run();
}

} // namespace meninas
