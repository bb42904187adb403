#include "radiosity/mesh/contact_segments.h"

#include "mirror/median_split.h"
#include "radiosity/mesh/vertex_welder.h"
#include "scenes/surfaces/disjoint_sets.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/texture_lookup.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace meninas {

namespace {

constexpr double hovering = 1.0 / 16.0; ///< of an element
constexpr double min_side = 1.0 / 16.0; ///< of an element

struct Box {
  Point3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
  void add(const Point3& x) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  void grow(double by) {
    low -= by;
    high += by;
  }
  bool meets(const Box& other) const {
    return glm::all(glm::lessThanEqual(low, other.high)) &&
           glm::all(glm::lessThanEqual(other.low, high));
  }
};

/// Textured glass may be opaque in places.
bool is_clear(const Material& material) { return is_glass(material) && !is_textured(material); }

/// The opaque faces of a scene by their boxes, in a binary tree.
class FaceTree {
public:
  explicit FaceTree(const Scene& scene) {
    std::vector<Point3> middles(scene.triangles.size());
    boxes_.resize(scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      if (is_clear(material_of(scene, TriangleId{t})))
        continue;
      for (const Point3& corner : corners(scene, TriangleId{t}))
        boxes_[t].add(corner);
      middles[t] = 0.5 * (boxes_[t].low + boxes_[t].high);
      members_.push_back(t);
    }
    if (members_.empty())
      return;
    nodes_.resize(nodes_of_halves(members_.size(), max_in_leaf));
    build(members_, 0, 0, middles);
  }

  template <typename Use>
  void for_each(const Box& box, const Use& use) const {
    std::vector<std::uint32_t> open;
    if (!nodes_.empty())
      open.push_back(0);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (!node.box.meets(box))
        continue;
      if (node.second != 0) {
        open.push_back(node.second);
        open.push_back(node.first);
        continue;
      }
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        if (boxes_[members_[k]].meets(box))
          use(TriangleId{members_[k]});
    }
  }

private:
  struct Node {
    Box box;
    std::uint32_t first = 0, second = 0; ///< nodes; of a leaf, second 0 and first among members
    std::uint32_t count = 0;
  };

  static constexpr std::size_t max_in_leaf = 4;
  /// The children follow node `number`, the first with all that is below it before the second.
  void build(std::span<std::uint32_t> members, std::uint32_t first, std::size_t number,
             const std::vector<Point3>& middles) {
    constexpr std::size_t large = 4096; // enough to share out
    Node& node = nodes_[number];
    if (members.size() <= max_in_leaf) {
      for (const std::uint32_t t : members)
        node.box.add(boxes_[t]);
      node.first = first;
      node.count = static_cast<std::uint32_t>(members.size());
      return;
    }
    const std::uint32_t half = split_at_median(members, middles, 3);
    node.first = static_cast<std::uint32_t>(number + 1);
    node.second = static_cast<std::uint32_t>(number + 1 + nodes_of_halves(half, max_in_leaf));
    const auto build_first = [&] { build(members.first(half), first, node.first, middles); };
    const auto build_second = [&] {
      build(members.subspan(half), first + half, node.second, middles);
    };
    if (members.size() < large) {
      build_first();
      build_second();
    } else {
      tbb::parallel_invoke(build_first, build_second);
    }
    node.box = nodes_[node.first].box;
    node.box.add(nodes_[node.second].box);
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> members_;
  std::vector<Node> nodes_;
};

/// Heights above the plane of a side that count as on it, and as hovering close above it, metres.
struct Heights {
  double on, close;
};

bool is_along(const std::array<Point3, 3>& face, const MeshSide& side) {
  constexpr double max_sine = 0.3;
  const Vec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
  return glm::length(glm::cross(normal, side.normal)) <= max_sine * glm::length(normal);
}

/// Where a face stands on the plane of a side, as the side's normal sees it.
std::optional<Segment2> contact_of(const std::array<Point3, 3>& face, const MeshSide& side,
                                   const PlanePlace& place, Heights limit) {
  std::array<double, 3> height;
  for (std::size_t k = 0; k < 3; ++k)
    height[k] = glm::dot(side.normal, face[k] - place.origin);
  std::array<std::size_t, 3> by_height{0, 1, 2};
  std::ranges::sort(by_height, {}, [&](std::size_t k) { return height[k]; });
  const auto [lowest, second, highest] = by_height;
  if (height[highest] <= limit.on || height[lowest] > limit.close)
    return std::nullopt;
  const auto crossing = [&](std::size_t a, std::size_t b) {
    return place(glm::mix(face[a], face[b], height[a] / (height[a] - height[b])));
  };
  if (height[lowest] < -limit.on) {
    if (height[second] < 0.0)
      return Segment2{crossing(lowest, highest), crossing(second, highest)};
    // An edge that dips into the plane with one end stands close to it up to the other.
    const bool stands = height[second] <= limit.close && !is_along(face, side);
    return Segment2{crossing(lowest, highest),
                    stands ? place(face[second]) : crossing(lowest, second)};
  }
  if (height[second] > limit.close || is_along(face, side))
    return std::nullopt;
  return Segment2{place(face[lowest]), place(face[second])};
}

/// Whether a face hovers close above the plane of a side, along it.
bool hovers_along(const std::array<Point3, 3>& face, const MeshSide& side, const PlanePlace& place,
                  Heights limit) {
  return is_along(face, side) && std::ranges::all_of(face, [&](const Point3& x) {
           const double height = glm::dot(side.normal, x - place.origin);
           return height > limit.on && height <= limit.close;
         });
}

/// Measures the extent of the runs of segments whose ends meet within `grain`.
void measure_runs(std::vector<ContactSegment>& segments, double grain) {
  struct Key {
    std::int64_t x, y;
    bool operator==(const Key&) const = default;
  };
  const auto hash_of = [](const Key& key) {
    return static_cast<std::size_t>(key.x) * 0x9e3779b97f4a7c15ULL ^
           static_cast<std::size_t>(key.y) * 0xff51afd7ed558ccdULL;
  };
  std::unordered_map<Key, std::uint32_t, decltype(hash_of)> ends(2 * segments.size(), hash_of);
  DisjointSets runs(segments.size());
  for (std::uint32_t s = 0; s < segments.size(); ++s)
    for (const Vec2& end : {segments[s].at.a, segments[s].at.b}) {
      const Key key{static_cast<std::int64_t>(std::floor(end.x / grain + 0.37)),
                    static_cast<std::int64_t>(std::floor(end.y / grain + 0.37))};
      runs.join(ends.try_emplace(key, s).first->second, s);
    }
  std::vector<std::array<Vec2, 2>> bounds(segments.size(),
                                          {Vec2(std::numeric_limits<double>::max()),
                                           Vec2(std::numeric_limits<double>::lowest())});
  for (std::uint32_t s = 0; s < segments.size(); ++s)
    for (const Vec2& end : {segments[s].at.a, segments[s].at.b}) {
      auto& [low, high] = bounds[runs.root(s)];
      low = glm::min(low, end);
      high = glm::max(high, end);
    }
  for (std::uint32_t s = 0; s < segments.size(); ++s)
    segments[s].reach = glm::distance(bounds[runs.root(s)][0], bounds[runs.root(s)][1]);
}

/// By PatchId, bit k: edge k is shared with another patch that faces the same way in its plane.
std::vector<std::uint8_t> inner_edges(const SurfaceModel& surfaces) {
  struct Edge {
    std::array<std::uint32_t, 2> ends; ///< places, the lower first
    std::uint32_t patch;
    std::uint8_t bit;
  };
  VertexWelder welder(16.0 * surfaces.tolerance + 1e-300);
  std::vector<Point3> places;
  std::vector<Edge> edges;
  std::vector<std::uint8_t> inner(surfaces.patches.size(), 0);
  std::vector<std::uint32_t> in_plane(2 * surfaces.planes.size(), 0);
  const auto face_of = [&](const Patch& patch) {
    const Surface& surface = surfaces.surfaces[index(patch.surface)];
    const std::uint32_t plane = index(surface.plane_class);
    return 2 * plane +
           (glm::dot(surface.plane.normal, surfaces.planes[plane].normal) > 0.0 ? 0U : 1U);
  };
  for (const Patch& patch : surfaces.patches)
    ++in_plane[face_of(patch)];
  for (std::uint32_t p = 0; p < surfaces.patches.size(); ++p) {
    const std::uint32_t face = face_of(surfaces.patches[p]);
    if (in_plane[face] < 2)
      continue;
    const auto polygon = polygon_of(surfaces.patches[p]);
    std::array<std::uint32_t, 4> place{};
    for (std::size_t k = 0; k < polygon.size(); ++k)
      place[k] = index(welder.vertex_at(face, polygon[k], places));
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const auto [low, high] = std::minmax(place[k], place[(k + 1) % polygon.size()]);
      edges.push_back({{low, high}, p, static_cast<std::uint8_t>(1U << k)});
    }
  }
  tbb::parallel_sort(edges.begin(), edges.end(),
                     [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  for (std::size_t k = 1; k < edges.size(); ++k)
    if (edges[k].ends == edges[k - 1].ends)
      for (const Edge& edge : {edges[k - 1], edges[k]})
        inner[edge.patch] |= edge.bit;
  return inner;
}

/// The data for finding the faces that stand on sides.
struct StandingFaces {
  const Scene& scene;
  const SurfaceModel& surfaces;
  FaceTree faces;
  std::vector<std::uint8_t> inner_edges; ///< by PatchId
};

/// The contacts on one side.
std::vector<ContactSegment> contacts_on(const StandingFaces& standing, const MeshSide& side) {
  const auto& [scene, surfaces, faces, inner] = standing;
  std::vector<ContactSegment> found;
  const Patch& patch = surfaces.patches[index(side.patch)];
  const double cell = patch.area / side.root_count;
  if (!(cell > min_side * min_side * side.element_size * side.element_size))
    return found;
  // Elements may be wanted larger than there is room.
  const double size = std::min(side.element_size, std::sqrt(cell));
  const double tolerance = surfaces.surfaces[index(patch.surface)].tolerance;
  const Heights limit{4.0 * tolerance, hovering * size};
  const PlanePlace place(patch, side);
  const double grain = 1e-4 * size + 8.0 * tolerance;
  std::vector<Vec2> outline;
  Box box;
  for (const Point3& corner : polygon_of(patch)) {
    outline.push_back(place(corner));
    box.add(corner);
    box.add(corner + limit.close * side.normal);
  }
  if (area_of(outline) < 0.0)
    std::ranges::reverse(outline);
  box.grow(grain);
  faces.for_each(box, [&](TriangleId t) {
    if (surfaces.plane_of_triangle[index(t)] == side.plane_class)
      return;
    const auto add = [&](const Segment2& contact) {
      Segment2 inside = contact;
      if (clip_to(outline, grain, inside))
        found.push_back({contact, 0.0});
    };
    const std::array<Point3, 3> face = corners(scene, t);
    if (const auto contact = contact_of(face, side, place, limit))
      add(*contact);
    // The outline of a face that hovers along the side separates light and shade.
    const Patch& hovering_patch = surfaces.patches[index(surfaces.patch_of_triangle[index(t)])];
    if (hovering_patch.triangles[0] == t && hovers_along(face, side, place, limit)) {
      const std::span<const Point3> polygon = polygon_of(hovering_patch);
      const std::uint8_t shared = inner[index(surfaces.patch_of_triangle[index(t)])];
      for (std::size_t k = 0; k < polygon.size(); ++k)
        if (((shared >> k) & 1U) == 0)
          add({place(polygon[k]), place(polygon[(k + 1) % polygon.size()])});
    }
  });
  measure_runs(found, grain);
  return found;
}

/// The root cells a segment may touch, as a range of rows and columns.
struct RootRange {
  int i0, i1, j0, j1;
};
RootRange roots_near(const Patch& patch, const MeshSide& side, const PlanePlace& place,
                     const Segment2& segment) {
  // The bounds of the part of the segment beside the patch; (u, v) need not be affine, so one cell more.
  Vec2 low(1.0), high(0.0);
  constexpr int steps = 8;
  std::vector<Vec2> outline;
  for (const Point3& corner : polygon_of(patch))
    outline.push_back(place(corner));
  if (area_of(outline) < 0.0)
    std::ranges::reverse(outline);
  Segment2 inside = segment;
  clip_to(outline, 1e-3 * side.element_size, inside);
  for (int k = 0; k <= steps; ++k) {
    const Vec2 uv = uv_at(patch, place.at(glm::mix(inside.a, inside.b, double(k) / steps)));
    low = glm::min(low, uv);
    high = glm::max(high, uv);
  }
  const auto from = [](double u, int n) {
    return std::max(0, static_cast<int>(std::floor(u * n - 0.1)));
  };
  const auto to = [](double u, int n) {
    return std::min(n - 1, static_cast<int>(std::floor(u * n + 0.1)));
  };
  const int margin = patch.affine ? 0 : 1;
  return {std::max(0, from(low.x, side.nu) - margin),
          std::min(side.nu - 1, to(high.x, side.nu) + margin),
          std::max(0, from(low.y, side.nv) - margin),
          std::min(side.nv - 1, to(high.y, side.nv) + margin)};
}

/// Calls `use(root)` for the root cells of a range.
template <typename Use>
void for_each_root(const MeshSide& side, const RootRange& range, const Use& use) {
  for (int j = range.j0; j <= range.j1; ++j)
    for (int i = range.i0; i <= range.i1; ++i) {
      if (!side.triangle) {
        use(side.first_cell + static_cast<std::uint32_t>(j * side.nu + i));
        continue;
      }
      if (i + j >= side.nu)
        continue;
      const int first = j * (2 * side.nu - j) + 2 * i;
      use(side.first_cell + static_cast<std::uint32_t>(first));
      if (i + j < side.nu - 1)
        use(side.first_cell + static_cast<std::uint32_t>(first + 1));
    }
}

} // namespace

ContactSegments find_contact_segments(const Scene& scene, const SurfaceModel& surfaces,
                                      const ElementMesh& mesh) {
  const StandingFaces standing{scene, surfaces, FaceTree(scene), inner_edges(surfaces)};
  std::vector<std::vector<ContactSegment>> on_side(mesh.sides.size());
  std::vector<std::vector<RootRange>> ranges(mesh.sides.size());
  tbb::parallel_for(std::size_t{0}, mesh.sides.size(), [&](std::size_t s) {
    const MeshSide& side = mesh.sides[s];
    const Patch& patch = surfaces.patches[index(side.patch)];
    on_side[s] = contacts_on(standing, side);
    const PlanePlace place(patch, side);
    for (const ContactSegment& segment : on_side[s])
      ranges[s].push_back(roots_near(patch, side, place, segment.at));
  });
  ContactSegments contacts;
  std::size_t roots = 0;
  for (const MeshSide& side : mesh.sides)
    roots += side.root_count;
  contacts.begin.assign(roots + 1, 0);
  const auto for_each = [&](const auto& use) {
    std::uint32_t number = 0;
    for (std::size_t s = 0; s < mesh.sides.size(); ++s)
      for (const RootRange& range : ranges[s]) {
        for_each_root(mesh.sides[s], range, [&](std::uint32_t root) { use(root, number); });
        ++number;
      }
  };
  for_each([&](std::uint32_t root, std::uint32_t) { ++contacts.begin[root + 1]; });
  std::partial_sum(contacts.begin.begin(), contacts.begin.end(), contacts.begin.begin());
  contacts.in_cell.resize(contacts.begin.back());
  auto next = contacts.begin;
  for_each([&](std::uint32_t root, std::uint32_t number) {
    contacts.in_cell[next[root]++] = number;
  });
  for (const auto& some : on_side)
    contacts.segments.insert(contacts.segments.end(), some.begin(), some.end());
  return contacts;
}

} // namespace meninas
