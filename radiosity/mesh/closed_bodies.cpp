#include "radiosity/mesh/closed_bodies.h"

#include "mirror/convex_polygon.h"
#include "scenes/surfaces/shells.h"
#include "scenes/surfaces/topology.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <ranges>
#include <span>

namespace meninas {

namespace {

constexpr std::uint32_t no_body = std::numeric_limits<std::uint32_t>::max();

bool is_opaque(const Material& material) {
  return material.alpha_mode == AlphaMode::opaque && !is_glass(material);
}

/// An edge of a body that only one of its triangles has, the way that triangle runs.
struct LooseEdge {
  VertexId from, to;
};

struct Body {
  std::vector<TriangleId> triangles;
  std::vector<LooseEdge> loose;
  bool is_orientable = true;
};

/// Triangles that share edges. All triangles of a body, as far as they are not turned round, look outwards, or all
/// look inwards.
struct Bodies {
  std::vector<Body> bodies;
  std::vector<std::uint32_t> of_triangle; ///< by TriangleId; no_body where it is not opaque
  std::vector<std::uint8_t> turned;       ///< by TriangleId
};

/// The one other opaque triangle at an edge, if there is one and no more.
const EdgeUse* other_at(std::span<const EdgeUse> uses, TriangleId triangle,
                        const std::vector<std::uint8_t>& opaque) {
  const EdgeUse* other = nullptr;
  int own = 0;
  for (const EdgeUse& use : uses) {
    if (opaque[index(use.triangle)] == 0)
      continue;
    if (use.triangle == triangle ? ++own > 1 : other != nullptr)
      return nullptr;
    if (use.triangle != triangle)
      other = &use;
  }
  return other;
}

/// Follows the triangles that share edges from one on.
Body body_from(TriangleId first, std::uint32_t number, const Topology& topology,
               const std::vector<std::uint8_t>& opaque, Bodies& bodies) {
  Body body;
  body.triangles = {first};
  bodies.of_triangle[index(first)] = number;
  for (std::size_t k = 0; k < body.triangles.size(); ++k) {
    const TriangleId triangle = body.triangles[k];
    const bool is_turned = bodies.turned[index(triangle)] != 0;
    for (const std::uint32_t edge : topology.edge_of[index(triangle)]) {
      if (edge == no_edge)
        continue;
      const std::span<const EdgeUse> uses = uses_of(topology, edge);
      const EdgeUse& own = *std::ranges::find(uses, triangle, &EdgeUse::triangle);
      const EdgeUse* const other = other_at(uses, triangle, opaque);
      if (other == nullptr) {
        const bool up = own.forward != is_turned;
        body.loose.push_back(up ? LooseEdge{own.low, own.high} : LooseEdge{own.high, own.low});
        continue;
      }
      // Neighbours that are turned alike run along their edge in opposite directions.
      const std::uint8_t wanted = (own.forward == other->forward) != is_turned ? 1 : 0;
      if (bodies.of_triangle[index(other->triangle)] == no_body) {
        body.triangles.push_back(other->triangle);
        bodies.turned[index(other->triangle)] = wanted;
        bodies.of_triangle[index(other->triangle)] = number;
      } else if (bodies.turned[index(other->triangle)] != wanted) {
        body.is_orientable = false;
      }
    }
  }
  return body;
}

Bodies find_bodies(const Scene& scene, double tolerance) {
  const Topology topology = find_topology(scene, tolerance);
  std::vector<std::uint8_t> opaque;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    opaque.push_back(is_opaque(material_of(scene, TriangleId{t})) ? 1 : 0);
  Bodies bodies;
  bodies.of_triangle.assign(scene.triangles.size(), no_body);
  bodies.turned.assign(scene.triangles.size(), 0);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (opaque[t] != 0 && bodies.of_triangle[t] == no_body)
      bodies.bodies.push_back(body_from(TriangleId{t},
                                        static_cast<std::uint32_t>(bodies.bodies.size()), topology,
                                        opaque, bodies));
  return bodies;
}

/// The loops of the loose edges, or nothing where they do not make loops.
std::optional<std::vector<std::vector<VertexId>>> loops_of(const Body& body) {
  constexpr std::size_t max_edges = 4096;
  if (body.loose.size() > max_edges)
    return std::nullopt;
  std::map<VertexId, VertexId> next;
  for (const LooseEdge& edge : body.loose)
    if (!next.try_emplace(edge.from, edge.to).second)
      return std::nullopt;
  std::vector<std::vector<VertexId>> loops;
  while (!next.empty()) {
    std::vector<VertexId>& loop = loops.emplace_back();
    for (VertexId at = next.begin()->first;;) {
      const auto step = next.find(at);
      if (step == next.end())
        break;
      loop.push_back(at);
      at = step->second;
      next.erase(step);
    }
    // It has come back to where it began: every vertex is left once.
    const bool is_closed = std::ranges::any_of(
        body.loose, [&](const LooseEdge& e) { return e.from == loop.back() && e.to == loop[0]; });
    if (loop.size() < 3 || !is_closed)
      return std::nullopt;
  }
  return loops;
}

/// A plane polygon that closes a loop, as triangles about one of its corners.
struct Cap {
  std::vector<TriangleCorners> triangles;
  Direction normal;
  double area = 0.0;
};

/// The other way round than the loop, as neighbours run;
/// nothing where it is not plane, or not star-shaped about a corner.
std::optional<Cap> cap_of(const Scene& scene, const std::vector<VertexId>& loop, double tolerance) {
  std::vector<Point3> corners;
  for (const VertexId vertex : loop)
    corners.push_back(position(scene, vertex));
  std::ranges::reverse(corners);
  const Vec3 area = area_vector(std::span<const Point3>(corners));
  Cap cap{{}, area / glm::length(area), glm::length(area)};
  if (!(cap.area > tolerance * tolerance))
    return std::nullopt;
  for (const Point3& corner : corners)
    if (std::abs(glm::dot(corner - corners[0], cap.normal)) > tolerance)
      return std::nullopt;
  for (std::size_t apex = 0; apex < corners.size(); ++apex) {
    std::ranges::rotate(corners, corners.begin() + 1);
    cap.triangles.clear();
    bool is_star = true;
    for (std::size_t k = 1; is_star && k + 1 < corners.size(); ++k) {
      const TriangleCorners part{corners[0], corners[k], corners[k + 1]};
      is_star = glm::dot(area_vector(part), cap.normal) > -1e-9 * cap.area;
      cap.triangles.push_back(part);
    }
    if (is_star)
      return cap;
  }
  return std::nullopt;
}

/// The parts minus a triangle in their plane. Parts that it misses stay whole.
std::vector<ConvexPolygon> left_by(const TriangleCorners& triangle, const Direction& normal,
                                   const std::vector<ConvexPolygon>& parts) {
  const double sign = glm::dot(area_vector(triangle), normal) > 0.0 ? 1.0 : -1.0;
  std::vector<ConvexPolygon> left;
  for (const ConvexPolygon& part : parts) {
    const std::size_t before = left.size();
    ConvexPolygon rest = part;
    for (std::size_t k = 0; k < 3 && !rest.empty(); ++k) {
      const Vec3 inwards = sign * glm::cross(normal, triangle[(k + 1) % 3] - triangle[k]);
      const ConvexPolygon outside = clip(rest, triangle[k], -inwards);
      if (!outside.empty())
        left.push_back(outside);
      clip_in_place(rest, triangle[k], inwards);
    }
    if (rest.empty()) {
      left.resize(before);
      left.push_back(part);
    }
  }
  return left;
}

/// Opaque triangles by the plane that they lie in.
class Planes {
public:
  Planes(const Scene& scene, const SurfaceModel& surfaces, const Bodies& bodies)
      : surfaces_(surfaces), triangles_(surfaces.planes.size()) {
    for (std::uint32_t p = 0; p < surfaces.planes.size(); ++p)
      by_distance_.emplace_back(std::abs(surfaces.planes[p].offset), p);
    std::ranges::sort(by_distance_);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
      if (bodies.of_triangle[t] != no_body)
        triangles_[index(surfaces.plane_of_triangle[t])].push_back(TriangleId{t});
    // A floor before what stands on it: little is left to cut after it.
    tbb::parallel_for(std::size_t{0}, triangles_.size(), [&](std::size_t plane) {
      std::vector<std::pair<double, TriangleId>> by_area;
      for (const TriangleId t : triangles_[plane])
        by_area.emplace_back(-glm::length(area_vector(corners(scene, t))), t);
      std::ranges::sort(by_area);
      std::ranges::copy(by_area | std::views::values, triangles_[plane].begin());
    });
  }

  bool are_asked_too_much() const { return compared > max_compared; }

  /// Visits the triangles in planes as far from the origin as a point's plane, and as steep; each is counted.
  template <typename Visit>
  void visit(const Point3& point, const Direction& normal, const Visit& visit) {
    const double distance = std::abs(glm::dot(point, normal));
    const double slack = 2.0 * surfaces_.tolerance + 1e-6 * distance;
    const auto first = std::ranges::lower_bound(by_distance_, std::pair(distance - slack, 0U));
    for (auto plane = first; plane != by_distance_.end() && plane->first <= distance + slack;
         ++plane) {
      ++compared;
      if (std::abs(glm::dot(surfaces_.planes[plane->second].normal, normal)) < 0.999)
        continue;
      compared += triangles_[plane->second].size();
      for (const TriangleId triangle : triangles_[plane->second])
        visit(triangle);
    }
  }

  std::size_t compared = 0;

private:
  static constexpr std::size_t max_compared = 20'000'000;
  const SurfaceModel& surfaces_;
  std::vector<std::pair<double, std::uint32_t>> by_distance_; ///< of planes from the origin
  std::vector<std::vector<TriangleId>> triangles_;            ///< by PlaneId
};

/// Whether opaque triangles that are not of the body lie all over a cap.
bool is_covered(const Scene& scene, const Cap& cap, std::uint32_t body, const Bodies& bodies,
                double tolerance, Planes& planes) {
  constexpr double nothing = 1e-6; // of the area
  constexpr std::size_t cut = 16;  // as long as so many comparisons
  const Bounds around = bounds_of(cap.triangles);
  std::vector<ConvexPolygon> left;
  for (const TriangleCorners& part : cap.triangles)
    left.emplace_back(std::span<const Point3>(part));
  planes.visit(cap.triangles[0][0], cap.normal, [&](TriangleId id) {
    if (left.empty() || planes.are_asked_too_much() || bodies.of_triangle[index(id)] == body)
      return;
    const TriangleCorners triangle = corners(scene, id);
    if (!overlap(bounds_of({&triangle, 1}), around, tolerance))
      return;
    const Direction normal = glm::normalize(area_vector(triangle));
    const bool in_plane = std::ranges::all_of(cap.triangles, [&](const TriangleCorners& part) {
      return std::ranges::all_of(part, [&](const Point3& corner) {
        return std::abs(glm::dot(corner - triangle[0], normal)) <= tolerance;
      });
    });
    if (!in_plane)
      return;
    planes.compared += cut * left.size();
    left = left_by(triangle, cap.normal, left);
  });
  double open = 0.0;
  for (const ConvexPolygon& part : left)
    open += glm::length(area_vector(part.span()));
  return open <= nothing * cap.area;
}

double volume_of(const std::vector<TriangleCorners>& shell) {
  double volume = 0.0;
  const Point3 from = shell.front()[0];
  for (const auto& [a, b, c] : shell)
    volume += glm::dot(a - from, glm::cross(b - from, c - from)) / 6.0;
  return volume;
}

/// The caps that close the loops of a body, or nothing where they cannot be closed.
std::optional<std::vector<Cap>> caps_of(const Scene& scene, const Body& body, double tolerance) {
  const auto loops = loops_of(body);
  if (!loops)
    return std::nullopt;
  std::vector<Cap> caps;
  for (const auto& loop : *loops) {
    const auto cap = cap_of(scene, loop, tolerance);
    if (!cap)
      return std::nullopt;
    caps.push_back(*cap);
  }
  return caps;
}

/// A body's shell, turned outwards, if it is closed and has room inside:
/// a sheet on another, which closes it, is off its plane by its rounding.
std::optional<ClosedBody> closed_body(const Scene& scene, const Bodies& bodies,
                                      std::uint32_t number, double tolerance, Planes& planes) {
  const Body& body = bodies.bodies[number];
  ClosedBody closed{body.triangles, {}, {}};
  for (const TriangleId triangle : body.triangles) {
    TriangleCorners part = corners(scene, triangle);
    if (bodies.turned[index(triangle)] != 0)
      std::swap(part[1], part[2]);
    closed.shell.push_back(part);
  }
  const auto caps = caps_of(scene, body, tolerance);
  if (!caps)
    return std::nullopt;
  for (const Cap& cap : *caps)
    closed.shell.insert(closed.shell.end(), cap.triangles.begin(), cap.triangles.end());
  double area = 0.0;
  for (const TriangleCorners& part : closed.shell)
    area += glm::length(area_vector(part));
  const double volume = volume_of(closed.shell);
  if (!(std::abs(volume) > 8.0 * tolerance * area))
    return std::nullopt;
  if (!std::ranges::all_of(*caps, [&](const Cap& cap) {
        return is_covered(scene, cap, number, bodies, tolerance, planes);
      }))
    return std::nullopt;
  for (TriangleCorners& part : closed.shell)
    if (volume < 0.0)
      std::swap(part[1], part[2]);
  for (const TriangleId triangle : body.triangles)
    closed.looks_in.push_back((bodies.turned[index(triangle)] != 0) != (volume < 0.0) ? 1 : 0);
  return closed;
}

} // namespace

std::vector<ClosedBody> find_closed_bodies(const Scene& scene, const SurfaceModel& surfaces,
                                           const std::vector<std::uint8_t>& wanted) {
  const double tolerance = surfaces.tolerance;
  const Bodies bodies = find_bodies(scene, 0.5 * tolerance);
  const auto is_wanted = [&](const Body& body) {
    return body.is_orientable &&
           std::ranges::any_of(body.triangles, [&](TriangleId t) { return wanted[index(t)] != 0; });
  };
  Planes planes(scene, surfaces, bodies);
  std::vector<ClosedBody> closed;
  for (std::uint32_t b = 0; b < bodies.bodies.size(); ++b) {
    const Body& body = bodies.bodies[b];
    if (!is_wanted(body) || (!body.loose.empty() && planes.are_asked_too_much()))
      continue;
    if (auto found = closed_body(scene, bodies, b, tolerance, planes))
      closed.push_back(*std::move(found));
  }
  return closed;
}

double winding_number(const std::vector<TriangleCorners>& shell, const Point3& x) {
  double angle = 0.0;
  for (const TriangleCorners& triangle : shell)
    angle += solid_angle(triangle, x);
  return angle / (4.0 * std::numbers::pi);
}

Bounds bounds_of(std::span<const TriangleCorners> triangles) {
  Bounds bounds;
  for (const TriangleCorners& triangle : triangles)
    for (const Point3& corner : triangle) {
      bounds.low = glm::min(bounds.low, corner);
      bounds.high = glm::max(bounds.high, corner);
    }
  return bounds;
}

bool overlap(const Bounds& a, const Bounds& b, double tolerance) {
  return glm::all(glm::lessThanEqual(a.low, b.high + tolerance)) &&
         glm::all(glm::lessThanEqual(b.low, a.high + tolerance));
}

} // namespace meninas
