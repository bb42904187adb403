#include "scenes/surfaces/plane_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meninas {

namespace {

constexpr std::size_t smallest_tree = 32;
constexpr std::uint32_t leaf_size = 4;
constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

/// Fixed, oblique to the planes people build: tells the two orientations of a plane apart.
const Direction orientation = glm::normalize(Vec3(0.5309, 0.6713, 0.5171));

Plane flipped(const Plane& plane) { return {-plane.normal, -plane.offset}; }

Plane oriented(const Plane& plane) {
  return glm::dot(plane.normal, orientation) < 0.0 ? flipped(plane) : plane;
}

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
  if (recent_.size() < smallest_tree)
    return;
  // As a carry runs through the digits of a binary number.
  Tree tree;
  tree.planes.swap(recent_);
  std::size_t k = 0;
  for (; k < trees_.size() && !trees_[k].planes.empty(); ++k) {
    tree.planes.insert(tree.planes.end(), trees_[k].planes.begin(), trees_[k].planes.end());
    trees_[k] = {};
  }
  if (k == trees_.size())
    trees_.emplace_back();
  build(tree, 0, static_cast<std::uint32_t>(tree.planes.size()));
  trees_[k] = std::move(tree);
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

std::uint32_t PlaneSearch::build(Tree& tree, std::uint32_t begin, std::uint32_t end) const {
  const auto id = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back(bounds(tree, begin, end));
  if (end - begin <= leaf_size)
    return id;
  const Node& node = tree.nodes[id];
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < key_size; ++axis)
    if (node.high[axis] - node.low[axis] > node.high[widest] - node.low[widest])
      widest = axis;
  const std::uint32_t half = begin + (end - begin) / 2;
  const auto place = [&](std::uint32_t k) { return tree.planes.begin() + k; };
  std::nth_element(place(begin), place(half), place(end), [&](std::uint32_t a, std::uint32_t b) {
    return keys_[a][widest] < keys_[b][widest];
  });
  build(tree, begin, half);
  const std::uint32_t second = build(tree, half, end);
  tree.nodes[id].second_child = second;
  return id;
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

std::optional<std::uint32_t>
PlaneSearch::first(const PlaneQuery& query,
                   const std::function<bool(std::uint32_t)>& accepts) const {
  Search search{query, accepts};
  const auto search_along = [&](const Plane& plane) {
    const Key key = key_of(plane);
    for (std::size_t axis = 0; axis < key_size; ++axis) {
      search.low[axis] = key[axis] - query.radius;
      search.high[axis] = key[axis] + query.radius;
    }
    // The oldest planes are in the largest trees.
    for (std::size_t k = trees_.size(); k-- > 0;)
      if (!trees_[k].planes.empty())
        look(trees_[k], 0, search);
    look_at(recent_, search);
  };
  const Plane plane = oriented(query.plane);
  search_along(plane);
  // A plane nearly along the fixed direction may have been filed under its other orientation.
  if (glm::dot(plane.normal, orientation) <= 2.0 * query.radius)
    search_along(flipped(plane));
  return search.found == nothing ? std::nullopt : std::optional(search.found);
}

} // namespace meninas
