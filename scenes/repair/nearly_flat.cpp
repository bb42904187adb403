#include "scenes/repair/nearly_flat.h"

#include "scenes/repair/common_place.h"
#include "scenes/surfaces/disjoint_sets.h"
#include "scenes/surfaces/principal_axes.h"
#include "scenes/surfaces/regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace meninas {
namespace {

constexpr double sharpest_turn = 0.35; ///< of a smooth part at an edge, radians
constexpr double unseen_offset = 1e-4; ///< of the width
constexpr double unseen_turn = 5e-3;   ///< of a facet, radians
constexpr double noise_offset = 5e-4;  ///< of the width
constexpr double max_alike = 0.5;     ///< Moran's I
/// Of fewer vertices the plane takes so much that what is left always looks like noise.
constexpr std::size_t min_vertices = 12;
/// A share of the border across which a flat surface may go on smoothly.
constexpr double max_going_on = 0.25;

struct Edge {
  TriangleId a = none<TriangleId>, b = none<TriangleId>;
  VertexId low = none<VertexId>, high = none<VertexId>; ///< welded
  double height = 0.0; ///< of b's far corner over the plane of a, or the other way round
};

struct FlatSurface {
  Plane plane;
  std::vector<VertexId> vertices; ///< welded, ascending
};

/// What is known of some triangles as one plane.
struct Fit {
  FlatSurface surface;
  double offset = 0.0;   ///< the largest distance from the plane
  double stated = 0.0;   ///< what the file's integers make of it
  double width = 0.0;    ///< area over length
  double turn = 0.0;     ///< the largest of a facet that is wide enough to tell
  double alike = 1.0;    ///< Moran's I of the heights
  double going_on = 0.0; ///< the share of the border where the part goes on
};

class Flattener {
public:
  Flattener(Scene& scene, std::span<const float> half_steps)
      : scene_(scene), half_steps_(half_steps), precision_(scene),
        topology_(find_topology(scene, precision_)), parts_(scene.triangles.size()) {
    shapes_.resize(scene.triangles.size());
    tolerances_.resize(scene.triangles.size());
    for (std::uint32_t t = 0; t < shapes_.size(); ++t) {
      shapes_[t] = shape_of(corners(scene, TriangleId{t}));
      tolerances_[t] = precision_.of(TriangleId{t});
    }
  }

  Flattening flatten() {
    find_parts();
    if (uneven_.empty())
      return {};
    add_whole_parts();
    add_grown_parts();
    return move_vertices();
  }

private:
  VertexId corner(TriangleId t, std::size_t k) const {
    return topology_.welded[index(scene_.triangles[index(t)].vertices[k])];
  }
  const Point3& at(VertexId v) const { return position(scene_, v); }

  double half_step(VertexId v) const {
    return index(v) < half_steps_.size() ? double{half_steps_[index(v)]} : 0.0;
  }

  double half_step(TriangleId t) const {
    const auto& v = scene_.triangles[index(t)].vertices;
    return std::max({half_step(v[0]), half_step(v[1]), half_step(v[2])});
  }

  /// The triangle may be one of the smooth part of the other. Rounding of its corners by the half
  /// step turns it about its longest side.
  bool is_smooth(TriangleId a, TriangleId b) const {
    const TriangleShape &sa = shapes_[index(a)], &sb = shapes_[index(b)];
    if (scene_.triangles[index(a)].material != scene_.triangles[index(b)].material ||
        !(sa.height > 0.0) || !(sb.height > 0.0) || !(glm::dot(sa.normal, sb.normal) > 0.0))
      return false;
    const double rounding = 2.0 * half_step(a) / sa.height + 2.0 * half_step(b) / sb.height;
    return glm::length(glm::cross(sa.normal, sb.normal)) <= sharpest_turn + rounding;
  }

  Edge edge_of(const EdgeUse& a, const EdgeUse& b) const {
    Edge edge{a.triangle, b.triangle, a.low, a.high};
    // The wider of the two tells a plane, the other one how far off it is.
    const bool a_is_wider = shapes_[index(a.triangle)].height >= shapes_[index(b.triangle)].height;
    const EdgeUse& wide = a_is_wider ? a : b;
    const EdgeUse& other = a_is_wider ? b : a;
    const Point3& apex = at(corner(other.triangle, (other.side + 2U) % 3U));
    edge.height = std::abs(glm::dot(shapes_[index(wide.triangle)].normal, apex - at(a.low)));
    return edge;
  }

  /// Smooth parts, and those of them that are not flat as they are.
  void find_parts() {
    for (std::uint32_t e = 0; e + 1 < topology_.first_use.size(); ++e) {
      const auto uses = uses_of(topology_, e);
      if (uses.size() != 2 || uses[0].forward == uses[1].forward ||
          !is_smooth(uses[0].triangle, uses[1].triangle))
        continue;
      edges_.push_back(edge_of(uses[0], uses[1]));
      parts_.join(index(uses[0].triangle), index(uses[1].triangle));
    }
    std::map<std::uint32_t, std::pair<double, std::size_t>> squares;
    for (const Edge& edge : edges_) {
      const double tolerance = std::max(tolerances_[index(edge.a)], tolerances_[index(edge.b)]);
      if (edge.height <= tolerance)
        continue;
      auto& [sum, count] = squares[parts_.root(index(edge.a))];
      sum += edge.height * edge.height;
      ++count;
    }
    for (const auto& [part, sum] : squares)
      uneven_[part].noise = std::sqrt(sum.first / static_cast<double>(sum.second));
    for (std::uint32_t t = 0; t < shapes_.size(); ++t)
      if (const auto found = uneven_.find(parts_.root(t)); found != uneven_.end())
        found->second.triangles.push_back(TriangleId{t});
  }

  struct Part {
    std::vector<TriangleId> triangles;
    double noise = 0.0; ///< rms of the heights that are more than rounding of floats
    bool is_done = false;
  };

  std::vector<VertexId> vertices_of(std::span<const TriangleId> triangles) const {
    std::vector<VertexId> vertices;
    vertices.reserve(3 * triangles.size());
    for (const TriangleId t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        vertices.push_back(corner(t, k));
    std::ranges::sort(vertices);
    vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
    return vertices;
  }

  /// Least squares of the distances, about the mean so that far coordinates cancel.
  Plane plane_through(std::span<const VertexId> vertices, const Vec3& area) const {
    const Point3 origin = at(vertices.front());
    std::vector<Vec3> offsets;
    offsets.reserve(vertices.size());
    for (const VertexId v : vertices)
      offsets.push_back(at(v) - origin);
    return fitted_plane(offsets, origin, area);
  }

  Fit fit_of(std::span<const TriangleId> triangles) const {
    Fit fit;
    auto& [plane, vertices] = fit.surface;
    vertices = vertices_of(triangles);
    Vec3 area(0.0);
    for (const TriangleId t : triangles)
      area += shapes_[index(t)].area * shapes_[index(t)].normal;
    plane = plane_through(vertices, area);
    Bounds bounds;
    const Vec3 n = glm::abs(plane.normal);
    for (const VertexId v : vertices) {
      fit.offset = std::max(fit.offset, std::abs(signed_distance(plane, at(v))));
      fit.stated = std::max(fit.stated, (n.x + n.y + n.z) * half_step(v));
      bounds.low = glm::min(bounds.low, at(v));
      bounds.high = glm::max(bounds.high, at(v));
    }
    // What is rounded is at most so far off its plane; that of least squares is a little beside it.
    fit.stated *= 2.0;
    const double length = glm::distance(bounds.low, bounds.high);
    fit.width = length > 0.0 ? glm::length(area) / length : 0.0;
    for (const TriangleId t : triangles) {
      const TriangleShape& shape = shapes_[index(t)];
      fit.turn = std::max(fit.turn, glm::length(glm::cross(shape.normal, plane.normal)));
    }
    return fit;
  }

  static bool is_of(std::span<const TriangleId> triangles, TriangleId t) {
    return std::ranges::binary_search(triangles, t);
  }

  /// Moran's I, and how much of the border goes on, over the smooth edges that touch the triangles.
  void judge_edges(std::span<const TriangleId> triangles, Fit& fit) const {
    const Plane& plane = fit.surface.plane;
    double products = 0.0, squares = 0.0, border = 0.0, going_on = 0.0;
    std::size_t pairs = 0;
    for (const VertexId v : fit.surface.vertices)
      squares += std::pow(signed_distance(plane, at(v)), 2);
    for (const TriangleId t : triangles)
      for (const std::uint32_t e : topology_.edge_of[index(t)]) {
        if (e == no_edge)
          continue;
        const auto uses = uses_of(topology_, e);
        const bool is_inner = std::ranges::all_of(
            uses, [&](const EdgeUse& use) { return is_of(triangles, use.triangle); });
        const Point3 &low = at(uses[0].low), &high = at(uses[0].high);
        products += signed_distance(plane, low) * signed_distance(plane, high);
        ++pairs;
        if (is_inner && uses.size() > 1)
          continue;
        border += glm::distance(low, high);
        const bool goes_on = std::ranges::any_of(uses, [&](const EdgeUse& use) {
          return use.triangle != t && !is_of(triangles, use.triangle) && is_smooth(t, use.triangle);
        });
        going_on += goes_on ? glm::distance(low, high) : 0.0;
      }
    fit.going_on = border > 0.0 ? going_on / border : 0.0;
    const auto count = static_cast<double>(fit.surface.vertices.size());
    if (squares > 0.0 && pairs > 0)
      fit.alike = products / static_cast<double>(pairs) / (squares / count);
  }

  bool is_flat(std::span<const TriangleId> triangles, Fit& fit) const {
    const bool is_stated = fit.offset <= fit.stated;
    if (!is_stated && fit.offset > noise_offset * fit.width)
      return false;
    if (fit.offset <= unseen_offset * fit.width && fit.turn <= unseen_turn)
      return true;
    judge_edges(triangles, fit);
    if (fit.surface.vertices.size() >= min_vertices && fit.alike <= max_alike)
      return true;
    return is_stated && fit.going_on <= max_going_on;
  }

  void accept(FlatSurface surface) {
    const auto id = static_cast<std::uint32_t>(flat_.size());
    for (const VertexId v : surface.vertices)
      planes_of_[v].push_back(id);
    flat_.push_back(std::move(surface));
  }

  void add_whole_parts() {
    for (auto& [root, part] : uneven_) {
      Fit fit = fit_of(part.triangles);
      const bool is_as_it_is = fit.offset <= region_tolerance(part.triangles);
      const bool is_made_flat = !is_as_it_is && is_flat(part.triangles, fit);
      part.is_done = is_as_it_is || is_made_flat;
      const double most = std::max(fit.stated, noise_offset * fit.width);
      part.noise = std::min(4.0 * part.noise, most);
      if (is_made_flat)
        accept(std::move(fit.surface));
    }
  }

  /// Regions of the parts that are flat here and curved there.
  void add_grown_parts() {
    std::vector<double> tolerances(shapes_.size(), -1.0);
    bool any = false;
    for (const auto& [root, part] : uneven_)
      for (const TriangleId t : part.triangles)
        if (!part.is_done) {
          tolerances[index(t)] = std::max(part.noise, tolerances_[index(t)]);
          any = true;
        }
    if (!any)
      return;
    const Regions regions = grow_regions(scene_, shapes_, topology_, tolerances);
    for (const Region& region : regions.regions) {
      const auto triangles = triangles_of(regions, region);
      if (triangles.size() < 2)
        continue;
      Fit fit = fit_of(triangles);
      const bool is_as_it_is = fit.offset <= region_tolerance(triangles);
      if (!is_as_it_is && is_flat(triangles, fit))
        accept(std::move(fit.surface));
    }
  }

  double region_tolerance(std::span<const TriangleId> triangles) const {
    double most = 0.0;
    for (const TriangleId t : triangles)
      most = std::max(most, tolerances_[index(t)]);
    return most;
  }

  /// Surfaces that are flat as they are and have corners in common with those that are made flat
  /// stay in their planes. Three corners do anyway.
  void keep_neighbours() {
    const std::size_t made = flat_.size();
    const Regions regions = grow_regions(scene_, shapes_, topology_, tolerances_);
    for (const Region& region : regions.regions) {
      const auto triangles = triangles_of(regions, region);
      if (triangles.size() < 2)
        continue;
      FlatSurface surface{region.plane, vertices_of(triangles)};
      const auto is_moved = [&](VertexId v) { return planes_of_.contains(v); };
      const bool is_beside = std::ranges::any_of(surface.vertices, is_moved);
      if (!is_beside || surface.vertices.size() < 4 || is_within_one(surface, made))
        continue;
      std::erase_if(surface.vertices, [&](VertexId v) { return !is_moved(v); });
      accept(std::move(surface));
    }
  }

  /// Whether all its corners are those of one surface that is made flat.
  bool is_within_one(const FlatSurface& surface, std::size_t made) const {
    const auto found = planes_of_.find(surface.vertices.front());
    return found != planes_of_.end() && std::ranges::any_of(found->second, [&](std::uint32_t id) {
             return id < made && std::ranges::includes(flat_[id].vertices, surface.vertices);
           });
  }

  Flattening move_vertices() {
    if (flat_.empty())
      return {};
    Flattening result{.surfaces = flat_.size()};
    keep_neighbours();
    std::vector<Plane> planes;
    for (std::uint32_t v = 0; v < scene_.vertices.size(); ++v) {
      const auto found = planes_of_.find(topology_.welded[v]);
      if (found == planes_of_.end())
        continue;
      planes.clear();
      for (const std::uint32_t id : found->second)
        planes.push_back(flat_[id].plane);
      Point3& x = scene_.vertices[v].position;
      const Vec3 way = way_into(x, planes);
      x += way;
      ++result.vertices;
      result.farthest = std::max(result.farthest, glm::length(way));
    }
    flatten_normals();
    drop_what_has_no_area();
    return result;
  }

  /// What is made flat reflects as what is flat: the normals of its triangles were as noisy.
  void flatten_normals() {
    for (Triangle& triangle : scene_.triangles) {
      if (!triangle.curved)
        continue;
      std::array<VertexId, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = topology_.welded[index(triangle.vertices[k])];
      std::ranges::sort(corners);
      const auto found = planes_of_.find(corners[0]);
      if (found != planes_of_.end() && std::ranges::any_of(found->second, [&](std::uint32_t id) {
            return std::ranges::includes(flat_[id].vertices, corners);
          }))
        triangle.curved = false;
    }
  }

  /// Slivers that stood across the plane have fallen into it.
  void drop_what_has_no_area() {
    scene_.degenerate_triangles += std::erase_if(scene_.triangles, [&](const Triangle& triangle) {
      const auto& v = triangle.vertices;
      const bool is_moved = std::ranges::all_of(
          v, [&](VertexId c) { return planes_of_.contains(topology_.welded[index(c)]); });
      return is_moved && !(shape_of({at(v[0]), at(v[1]), at(v[2])}).height >
                           std::max(scene_.position_error, 0.0));
    });
  }

  Scene& scene_;
  std::span<const float> half_steps_;
  Precision precision_;
  Topology topology_;
  std::vector<TriangleShape> shapes_;
  std::vector<double> tolerances_; ///< of surfaces, by triangle
  DisjointSets parts_;
  std::vector<Edge> edges_; ///< within smooth parts
  std::map<std::uint32_t, Part> uneven_;
  std::vector<FlatSurface> flat_;
  std::map<VertexId, std::vector<std::uint32_t>> planes_of_; ///< welded vertex to flat surfaces
};

} // namespace

Flattening flatten_nearly_flat(Scene& scene, std::span<const float> half_steps) {
  if (scene.triangles.empty())
    return {};
  return Flattener(scene, half_steps).flatten();
}

} // namespace meninas
