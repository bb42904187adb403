// Finding, among planes that are known to a stated accuracy, the first in which some points may
// lie.
//
// A plane whose normal is known to u radians about a centre c holds a point x that is itself known
// to e, as far as anybody can tell, where
//
//   |n . x - d| <= e + u |x - c|.
//
// The search finds the first added plane that holds all the points, among those whose normal and
// distance from the middle of the scene are alike within a radius. Asking all planes in turn would
// find the same one; no plane is left out because there are many.
//
// The planes are in binary trees over (normal, distance) whose nodes know the ranges of these, of
// the centres and of u, so that the inequality is bounded over all that is below a node and most of
// it is not looked at. Each tree is at least twice as large as the next one: those that are not
// become one (Bentley, Saxe 1980), and n additions take O(n log^2 n). A search takes O(log^2 n)
// where few planes come near; there is no bound for planes made to defeat it. Planes that were added
// since the last call of settle() are in no tree: they are asked in turn.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace meninas {

struct KnownPlane {
  Plane plane;
  Point3 centre{0.0};       ///< where it is known best
  double uncertainty = 0.0; ///< of the normal, radians
};

struct PlaneQuery {
  Plane plane;                     ///< as the points themselves tell it
  std::array<Point3, 3> points{};  ///< that lie in the plane that is looked for
  double tolerance = 0.0;          ///< of the points, metres
  double radius = 0.0; ///< of normals, along each axis, and of distances in units of the reach
};

class PlaneSearch {
public:
  /// The scene lies in the ball about `middle` whose radius is `reach` > 0.
  PlaneSearch(const Point3& middle, double reach) : middle_(middle), reach_(reach) {}

  /// Planes are counted from 0.
  void add(const KnownPlane& plane);
  /// Puts those that were added since the last time into a tree.
  void settle();

  const KnownPlane& operator[](std::uint32_t plane) const { return planes_[plane]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(planes_.size()); }

  /// The first plane of those near the query's whose inequality holds for its points and that
  /// `accepts` takes. Either orientation of a plane is the same plane.
  std::optional<std::uint32_t> first(const PlaneQuery& query,
                                     const std::function<bool(std::uint32_t)>& accepts) const;
  /// Among those that are in trees, which were added before all others.
  std::optional<std::uint32_t> first_settled(const PlaneQuery& query,
                                             const std::function<bool(std::uint32_t)>& accepts) const;
  /// Among those that are in none.
  std::optional<std::uint32_t> first_recent(const PlaneQuery& query,
                                            const std::function<bool(std::uint32_t)>& accepts) const;

private:
  static constexpr std::size_t key_size = 4;
  using Key = std::array<double, key_size>; ///< normal, and distance of the middle in reaches

  struct Node {
    Key low{}, high{};
    Point3 centre_low{0.0}, centre_high{0.0};
    double uncertainty = 0.0;       ///< the largest
    std::uint32_t first_plane = 0;  ///< the least
    std::uint32_t begin = 0, end = 0; ///< in Tree::planes
    std::uint32_t second_child = 0; ///< the first one follows its parent; 0: a leaf
  };
  struct Tree {
    std::vector<std::uint32_t> planes;
    std::vector<Node> nodes;
  };
  struct Search;

  Key key_of(const Plane& plane) const;
  void build(Tree& tree, std::uint32_t id, std::uint32_t begin, std::uint32_t end) const;
  Node bounds(const Tree& tree, std::uint32_t begin, std::uint32_t end) const;
  template <typename Look>
  std::optional<std::uint32_t> search_either_way(const PlaneQuery& query,
                                                 const std::function<bool(std::uint32_t)>& accepts,
                                                 const Look& look) const;
  void look_at_trees(Search& search) const;
  void look(const Tree& tree, std::uint32_t node, Search& search) const;
  void look_at(std::span<const std::uint32_t> planes, Search& search) const;
  bool may_hold(const Node& node, const Search& search) const;

  Point3 middle_;
  double reach_;
  std::vector<KnownPlane> planes_;
  std::vector<Key> keys_;
  std::vector<std::uint32_t> recent_; ///< in no tree yet
  std::vector<Tree> trees_;           ///< the largest first, which has the oldest planes
};

} // namespace meninas
