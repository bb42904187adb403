#include "form_factors/kaleidoscope.h"

#include "form_factors/area_form_factor.h"
#include "form_factors/world_shares.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas {

namespace {

/// Reflected an odd number of times,
/// a polygon shows its front with its corners in the opposite order.
ConvexPolygon facing_image(const Isometry& map, const ConvexPolygon& polygon) {
  ConvexPolygon image;
  const bool turned = glm::determinant(map.linear) < 0.0;
  for (std::size_t k = 0; k < polygon.size; ++k)
    image.push_back(apply(map, polygon.vertices[turned ? polygon.size - 1 - k : k]));
  return image;
}

/// An image of the cell.
struct CellImage {
  Isometry map;
  Rgb throughput{1.0};
  std::uint32_t parent = 0; ///< one of its neighbours on the way
  MirrorId mirror = none<MirrorId>;
  int depth = 0;
  double bound = 0.0; ///< on what comes in through the walls between it and those visited
  bool visited = false;
};

/// Images by where they put the cell's inside.
class ImageTable {
public:
  explicit ImageTable(double spacing) : spacing_(spacing) {}

  /// The image there; `fresh` if there was none.
  std::uint32_t find_or_add(const Point3& x, std::uint32_t fresh) {
    // Rounding may put a place into the next cell of the grid:
    // a quarter of a cell to either side finds it.
    for (int k = 0; k < 8; ++k) {
      const Vec3 shift(k & 1 ? 0.25 : -0.25, k & 2 ? 0.25 : -0.25, k & 4 ? 0.25 : -0.25);
      const auto found = places_.find(key(x / spacing_ + shift));
      if (found != places_.end())
        return found->second;
    }
    places_.emplace(key(x / spacing_), fresh);
    return fresh;
  }

private:
  using Key = std::array<std::int64_t, 3>;
  static Key key(const Vec3& x) {
    return {std::llround(x.x), std::llround(x.y), std::llround(x.z)};
  }
  double spacing_;
  std::map<Key, std::uint32_t> places_;
};

/// The result of one visit: form factors from all of A to each target, and out through each wall.
struct Visit {
  std::vector<Estimate> to_targets;
  std::vector<double> through_walls;
};

class Images {
public:
  Images(const WorldView& view, const std::vector<Face>& from, std::size_t groups,
         const ExtendedSettings& settings, const KaleidoscopeCell& cell)
      : view_(view), from_(from), settings_(settings), cell_(cell), table_(0.1 * cell.clearance),
        factors_(groups), errors_(groups, 0.0) {
    for (const Face& face : from)
      area_ += face.area;
    images_.emplace_back();
    images_[0].bound = 1.0;
    waiting_bound_ = 1.0;
    table_.find_or_add(cell.inside, 0);
    heap_.emplace_back(1.0, 0);
  }

  ExtendedFactors run() {
    while (!heap_.empty() && !has_settled() && visited_ < max_images)
      visit_best();
    return result();
  }

private:
  static constexpr std::size_t max_images = 200'000, max_at_once = 64;

  bool has_settled() const {
    constexpr double part = 0.5, rounding = 1e-15;
    return waiting_bound_ <= part * settings_.accuracy * value_ + rounding;
  }

  Visit visit(const CellImage& image) const {
    Visit found;
    found.to_targets.resize(view_.targets.size());
    for (std::size_t t = 0; t < view_.targets.size(); ++t) {
      if (signed_distance(view_.targets[t].plane, cell_.inside) <= view_.tolerance)
        continue; // it shows its front to the outside
      const ConvexPolygon target = facing_image(image.map, view_.targets[t].polygon);
      for (const Face& face : from_)
        if (image.depth > 0 || face.plane_class != view_.targets[t].plane_class)
          found.to_targets[t] =
              found.to_targets[t] + face.area / area_ * area_form_factor(face.polygon, target);
    }
    for (const MirrorId wall : cell_.walls) {
      double out = 0.0;
      if (wall != image.mirror && image.depth < settings_.max_depth)
        for (const ConvexPolygon& part : view_.mirrors.mirrors[index(wall)].window)
          for (const Face& face : from_) {
            const Estimate factor = area_form_factor(face.polygon, facing_image(image.map, part));
            out += face.area / area_ * (factor.value + factor.error);
          }
      found.through_walls.push_back(out);
    }
    return found;
  }

  /// Some of the images that promise most, at the same time; the result does not depend on how.
  void visit_best() {
    std::vector<std::uint32_t> chosen;
    double least = 0.0;
    while (!heap_.empty() && chosen.size() < max_at_once) {
      const auto [bound, image] = heap_.front();
      if (!chosen.empty() && bound < least)
        break;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      // An image has been put there again each time more was known to reach it.
      if (images_[image].visited || bound < images_[image].bound)
        continue;
      images_[image].visited = true;
      waiting_bound_ -= images_[image].bound;
      least = 0.5 * bound;
      chosen.push_back(image);
    }
    std::vector<Visit> found(chosen.size());
    // The loop is isolated from a caller's cancellation, because half of the result would be read.
    tbb::task_group_context alone(tbb::task_group_context::isolated);
    tbb::parallel_for(std::size_t{0}, chosen.size(),
                      [&](std::size_t k) { found[k] = visit(images_[chosen[k]]); }, alone);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      add(chosen[k], found[k]);
    visited_ += chosen.size();
  }

  void add(std::uint32_t id, const Visit& found) {
    const double tau = mean_of(images_[id].throughput);
    std::vector<Estimate> by_group(factors_.size());
    for (std::size_t t = 0; t < found.to_targets.size(); ++t)
      by_group[view_.groups[t]] = by_group[view_.groups[t]] + found.to_targets[t];
    for (std::size_t g = 0; g < by_group.size(); ++g) {
      if (by_group[g].value <= 0.0)
        continue;
      factors_[g].push_back({id, by_group[g]});
      errors_[g] += tau * by_group[g].error;
      value_ += tau * by_group[g].value;
    }
    for (std::size_t w = 0; w < cell_.walls.size(); ++w)
      if (found.through_walls[w] > 0.0)
        enter(id, cell_.walls[w], found.through_walls[w]);
  }

  void enter(std::uint32_t from, MirrorId wall, double factor) {
    const Mirror& mirror = view_.mirrors.mirrors[index(wall)];
    CellImage next;
    next.map = compose_reflection(images_[from].map, mirror.plane);
    next.throughput = images_[from].throughput * mirror.reflectance;
    next.parent = from;
    next.mirror = wall;
    next.depth = images_[from].depth + 1;
    const double bound = mean_of(next.throughput) * factor;
    if (bound <= 0.0)
      return;
    const std::uint32_t id = table_.find_or_add(apply(next.map, cell_.inside),
                                                static_cast<std::uint32_t>(images_.size()));
    if (id == images_.size())
      images_.push_back(next);
    if (images_[id].visited)
      return;
    images_[id].bound += bound;
    waiting_bound_ += bound;
    heap_.emplace_back(images_[id].bound, id);
    std::push_heap(heap_.begin(), heap_.end());
  }

  std::vector<MirrorId> chain_of(std::uint32_t image) const {
    std::vector<MirrorId> chain;
    for (; image != 0; image = images_[image].parent)
      chain.push_back(images_[image].mirror);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  ExtendedFactors result() const {
    ExtendedFactors result;
    result.to.resize(factors_.size());
    result.points = visited_;
    const double tail = heap_.empty() ? 0.0 : std::max(0.0, waiting_bound_);
    double error = 0.0;
    for (std::size_t g = 0; g < factors_.size(); ++g) {
      ExtendedFactor& factor = result.to[g];
      factor.total.error = tail + errors_[g];
      error = std::max(error, factor.total.error);
      for (const auto& [image, share] : factors_[g]) {
        const Rgb& throughput = images_[image].throughput;
        factor.total.value += mean_of(throughput) * share.value;
        factor.light += throughput * share.value;
        factor.geometric += share.value;
        if (settings_.listing == WorldListing::worlds)
          factor.worlds.push_back({chain_of(image), throughput, share});
      }
      sort_worlds(factor);
    }
    result.tail = tail;
    result.converged = error <= settings_.accuracy * value_ + 1e-15;
    return result;
  }

  const WorldView& view_;
  const std::vector<Face>& from_;
  const ExtendedSettings& settings_;
  const KaleidoscopeCell& cell_;
  double area_ = 0.0;
  std::vector<CellImage> images_; ///< [0] is the real room
  ImageTable table_;
  std::vector<std::pair<double, std::uint32_t>> heap_; ///< bound and image, the largest first
  std::vector<std::vector<std::pair<std::uint32_t, Estimate>>> factors_; ///< by group
  std::vector<double> errors_;                                           ///< by group
  double value_ = 0.0, waiting_bound_ = 0.0;
  std::size_t visited_ = 0;
};

} // namespace

ExtendedFactors kaleidoscope_form_factors(const WorldView& view, const std::vector<Face>& from,
                                          std::size_t group_count, const ExtendedSettings& settings,
                                          const KaleidoscopeCell& cell) {
  return Images(view, from, group_count, settings, cell).run();
}

} // namespace meninas
