#include "scenes/surfaces/plane_search.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meninas {

namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::uint32_t large = 4096; ///< enough planes to share out their work
constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

/// Fixed, oblique to the planes people build: tells the two orientations of a plane apart.
const Direction orientation = glm::normalize(Vec3(0.5309, 0.6713, 0.5171));

Plane flipped(const Plane& plane) { return {-plane.normal, -plane.offset}; }

Plane oriented(const Plane& plane) {
  return glm::dot(plane.normal, orientation) < 0.0 ? flipped(plane) : plane;
}

std::uint32_t leaves_over(std::uint32_t planes) { return (planes + leaf_size - 1) / leaf_size; }
std::uint32_t nodes_over(std::uint32_t planes) { return 2 * leaves_over(planes) - 1; }

/// Everything else in the search is a bound on this.
bool may_hold_all(const KnownPlane& known, const PlaneQuery& query) {
  return std::ranges::all_of(query.points, [&](const Point3& x) {
    const double slack = query.tolerance + known.uncertainty * glm::distance(x, known.centre);
    return std::abs(signed_distance(known.plane, x)) <= slack;
  });
}

} // namespace

struct PlaneSearch::Search {
  const PlaneQuery& query;
  const std::function<bool(std::uint32_t)>& accepts;
  Key low{}, high{};
  std::uint32_t found = nothing;
};

PlaneSearch::Key PlaneSearch::key_of(const Plane& plane) const {
  return {plane.normal.x, plane.normal.y, plane.normal.z, signed_distance(plane, middle_) / reach_};
}

void PlaneSearch::add(const KnownPlane& plane) {
  recent_.push_back(size());
  planes_.push_back(plane);
  keys_.push_back(key_of(oriented(plane.plane)));
}

void PlaneSearch::settle() {
  if (recent_.empty())
    return;
  Tree tree;
  tree.planes.swap(recent_);
  while (!trees_.empty() && trees_.back().planes.size() < 2 * tree.planes.size()) {
    const auto& last = trees_.back().planes;
    tree.planes.insert(tree.planes.end(), last.begin(), last.end());
    trees_.pop_back();
  }
  const auto count = static_cast<std::uint32_t>(tree.planes.size());
  tree.nodes.resize(nodes_over(count));
  build(tree, 0, 0, count);
  trees_.push_back(std::move(tree));
}

PlaneSearch::Node PlaneSearch::bounds(const Tree& tree, std::uint32_t begin,
                                      std::uint32_t end) const {
  Node node;
  node.begin = begin;
  node.end = end;
  node.first_plane = nothing;
  node.low.fill(std::numeric_limits<double>::infinity());
  node.high.fill(-std::numeric_limits<double>::infinity());
  node.centre_low = Point3(std::numeric_limits<double>::infinity());
  node.centre_high = -node.centre_low;
  for (std::uint32_t k = begin; k < end; ++k) {
    const std::uint32_t plane = tree.planes[k];
    for (std::size_t axis = 0; axis < key_size; ++axis) {
      node.low[axis] = std::min(node.low[axis], keys_[plane][axis]);
      node.high[axis] = std::max(node.high[axis], keys_[plane][axis]);
    }
    node.centre_low = glm::min(node.centre_low, planes_[plane].centre);
    node.centre_high = glm::max(node.centre_high, planes_[plane].centre);
    node.uncertainty = std::max(node.uncertainty, planes_[plane].uncertainty);
    node.first_plane = std::min(node.first_plane, plane);
  }
  return node;
}

void PlaneSearch::build(Tree& tree, std::uint32_t id, std::uint32_t begin,
                        std::uint32_t end) const {
  Node& node = tree.nodes[id];
  node = bounds(tree, begin, end);
  if (end - begin <= leaf_size)
    return;
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < key_size; ++axis)
    if (node.high[axis] - node.low[axis] > node.high[widest] - node.low[widest])
      widest = axis;
  // The first half has full leaves, so that the number of its nodes is known before it is built.
  const std::uint32_t half = begin + leaves_over(end - begin) / 2 * leaf_size;
  const auto place = [&](std::uint32_t k) { return tree.planes.begin() + k; };
  std::nth_element(place(begin), place(half), place(end), [&](std::uint32_t a, std::uint32_t b) {
    return keys_[a][widest] < keys_[b][widest];
  });
  node.second_child = id + 1 + nodes_over(half - begin);
  const auto build_first = [&] { build(tree, id + 1, begin, half); };
  const auto build_second = [&] { build(tree, node.second_child, half, end); };
  if (end - begin < large) {
    build_first();
    build_second();
  } else {
    tbb::parallel_invoke(build_first, build_second);
  }
}

/// False where no plane below the node is near and holds all points.
bool PlaneSearch::may_hold(const Node& node, const Search& search) const {
  for (std::size_t axis = 0; axis < key_size; ++axis)
    if (node.high[axis] < search.low[axis] || search.high[axis] < node.low[axis])
      return false;
  constexpr double rounding = 1e-13; // of the sums below, of the terms' sizes
  for (const Point3& point : search.query.points) {
    // n . x - d over the box of all n and d, with x from the middle.
    const Vec3 x = point - middle_;
    double least = reach_ * node.low[3], most = reach_ * node.high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double a = node.low[k] * x[axis], b = node.high[k] * x[axis];
      least += std::min(a, b);
      most += std::max(a, b);
    }
    const Vec3 far =
        glm::max(glm::abs(point - node.centre_low), glm::abs(point - node.centre_high));
    const double slack = search.query.tolerance + node.uncertainty * glm::length(far) +
                         rounding * (reach_ + glm::length(x) + glm::length(middle_));
    if (least > slack || most < -slack)
      return false;
  }
  return true;
}

void PlaneSearch::look(const Tree& tree, std::uint32_t id, Search& search) const {
  const Node& node = tree.nodes[id];
  if (node.first_plane >= search.found || !may_hold(node, search))
    return;
  if (node.second_child == 0) {
    look_at(std::span(tree.planes).subspan(node.begin, node.end - node.begin), search);
    return;
  }
  // What was added first is looked at first: the rest is then often too late.
  const std::uint32_t a = id + 1, b = node.second_child;
  const bool in_order = tree.nodes[a].first_plane < tree.nodes[b].first_plane;
  look(tree, in_order ? a : b, search);
  look(tree, in_order ? b : a, search);
}

void PlaneSearch::look_at(std::span<const std::uint32_t> planes, Search& search) const {
  for (const std::uint32_t plane : planes) {
    const Key& key = keys_[plane];
    bool near = plane < search.found;
    for (std::size_t axis = 0; axis < key_size; ++axis)
      near = near && search.low[axis] <= key[axis] && key[axis] <= search.high[axis];
    if (near && may_hold_all(planes_[plane], search.query) && search.accepts(plane))
      search.found = plane;
  }
}

void PlaneSearch::look_at_trees(Search& search) const {
  for (const Tree& tree : trees_)
    look(tree, 0, search);
}

template <typename Look>
std::optional<std::uint32_t>
PlaneSearch::search_either_way(const PlaneQuery& query,
                               const std::function<bool(std::uint32_t)>& accepts,
                               const Look& look) const {
  Search search{query, accepts};
  const auto search_along = [&](const Plane& plane) {
    const Key key = key_of(plane);
    for (std::size_t axis = 0; axis < key_size; ++axis) {
      search.low[axis] = key[axis] - query.radius;
      search.high[axis] = key[axis] + query.radius;
    }
    look(search);
  };
  const Plane plane = oriented(query.plane);
  search_along(plane);
  // A plane nearly along the fixed direction may have been filed under its other orientation.
  if (glm::dot(plane.normal, orientation) <= 2.0 * query.radius)
    search_along(flipped(plane));
  return search.found == nothing ? std::nullopt : std::optional(search.found);
}

std::optional<std::uint32_t>
PlaneSearch::first_settled(const PlaneQuery& query,
                           const std::function<bool(std::uint32_t)>& accepts) const {
  return search_either_way(query, accepts, [&](Search& search) { look_at_trees(search); });
}

std::optional<std::uint32_t>
PlaneSearch::first_recent(const PlaneQuery& query,
                          const std::function<bool(std::uint32_t)>& accepts) const {
  return search_either_way(query, accepts, [&](Search& search) { look_at(recent_, search); });
}

std::optional<std::uint32_t>
PlaneSearch::first(const PlaneQuery& query,
                   const std::function<bool(std::uint32_t)>& accepts) const {
  const auto settled = first_settled(query, accepts);
  return settled ? settled : first_recent(query, accepts);
}

} // namespace meninas
