#include "radiosity/enclosed_sides.h"

#include "scenes/sampling.h"
#include "scenes/topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>

namespace meninas {

namespace {

using Corners3 = std::array<Point3, 3>;
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

/// Triangles that share edges. Those of a body, as far as they are not turned round,
/// look all outwards or all inwards.
struct Bodies {
  std::vector<Body> bodies;
  std::vector<std::uint32_t> of_triangle; ///< by TriangleId; no_body where it is not opaque
  std::vector<std::uint8_t> turned;       ///< by TriangleId
};

/// The opaque triangles at an edge.
std::vector<EdgeUse> opaque_uses(const Topology& topology, std::uint32_t edge,
                                 const std::vector<std::uint8_t>& opaque) {
  std::vector<EdgeUse> uses;
  for (const EdgeUse& use : uses_of(topology, edge))
    if (opaque[index(use.triangle)] != 0)
      uses.push_back(use);
  return uses;
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
      const std::vector<EdgeUse> uses = opaque_uses(topology, edge, opaque);
      const EdgeUse& own = *std::ranges::find(uses, triangle, &EdgeUse::triangle);
      if (uses.size() != 2 || uses[0].triangle == uses[1].triangle) {
        const bool up = own.forward != is_turned;
        body.loose.push_back(up ? LooseEdge{own.low, own.high} : LooseEdge{own.high, own.low});
        continue;
      }
      // Neighbours that are turned alike run along their edge in opposite directions.
      const EdgeUse& other = uses[0].triangle == triangle ? uses[1] : uses[0];
      const std::uint8_t wanted = (own.forward == other.forward) != is_turned ? 1 : 0;
      if (bodies.of_triangle[index(other.triangle)] == no_body) {
        body.triangles.push_back(other.triangle);
        bodies.turned[index(other.triangle)] = wanted;
        bodies.of_triangle[index(other.triangle)] = number;
      } else if (bodies.turned[index(other.triangle)] != wanted) {
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
  constexpr std::size_t most_edges = 4096;
  if (body.loose.size() > most_edges)
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

/// A plane polygon that closes a loop, its normal away from the inside.
struct Cap {
  std::vector<Point3> corners;
  Direction normal;
  double size = 0.0; ///< of a square as large, m
};

/// The other way round than the loop, as neighbours run; nothing where that is not plane.
std::optional<Cap> cap_of(const Scene& scene, const std::vector<VertexId>& loop, double tolerance) {
  Cap cap;
  for (const VertexId vertex : loop)
    cap.corners.push_back(position(scene, vertex));
  std::ranges::reverse(cap.corners);
  Vec3 twice_area(0.0);
  for (std::size_t k = 1; k + 1 < cap.corners.size(); ++k)
    twice_area += glm::cross(cap.corners[k] - cap.corners[0], cap.corners[k + 1] - cap.corners[0]);
  const double length = glm::length(twice_area);
  cap.size = std::sqrt(0.5 * length);
  if (!(cap.size > tolerance))
    return std::nullopt;
  cap.normal = twice_area / length;
  for (const Point3& corner : cap.corners)
    if (std::abs(glm::dot(corner - cap.corners[0], cap.normal)) > 2.0 * tolerance)
      return std::nullopt;
  return cap;
}

/// Points of a cap: of a grid of 16 x 16 over it, and beside the middles of its edges.
std::vector<Point3> points_of(const Cap& cap) {
  constexpr int side = 16;
  constexpr double beside = 0.01;
  const TangentFrame frame = tangent_frame(cap.normal);
  std::vector<Vec2> outline;
  Vec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Point3& corner : cap.corners) {
    const Vec3 to = corner - cap.corners[0];
    outline.emplace_back(glm::dot(to, frame.tangent), glm::dot(to, frame.bitangent));
    low = glm::min(low, outline.back());
    high = glm::max(high, outline.back());
  }
  const auto is_inside = [&](Vec2 p) {
    bool inside = false;
    for (std::size_t k = 0, before = outline.size() - 1; k < outline.size(); before = k++) {
      const Vec2 a = outline[before], b = outline[k];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        inside = !inside;
    }
    return inside;
  };
  std::vector<Point3> points;
  const auto add = [&](Vec2 p) {
    if (is_inside(p))
      points.push_back(cap.corners[0] + p.x * frame.tangent + p.y * frame.bitangent);
  };
  for (int k = 0; k < side * side; ++k)
    add(low + (high - low) * (Vec2(k % side, k / side) + 0.5) / double(side));
  for (std::size_t k = 0, before = outline.size() - 1; k < outline.size(); before = k++) {
    const Vec2 along = outline[k] - outline[before];
    const double length = glm::length(along);
    const Vec2 across = length > 0.0 ? beside * cap.size * Vec2(-along.y, along.x) / length : along;
    add(0.5 * (outline[k] + outline[before]) + across);
    add(0.5 * (outline[k] + outline[before]) - across);
  }
  return points;
}

/// Whether something opaque that is not of the body lies all over a cap.
bool is_covered(const Cap& cap, std::uint32_t body, const Bodies& bodies, const RayScene& rays) {
  const double inwards = 0.005 * cap.size;
  const std::vector<Point3> points = points_of(cap);
  return !points.empty() && std::ranges::all_of(points, [&](const Point3& point) {
    const Ray ray{.origin = point - inwards * cap.normal,
                  .direction = cap.normal,
                  .max_distance = 1.01 * inwards};
    const auto hit = closest_hit(rays, ray);
    if (!hit)
      return false;
    const std::uint32_t of = bodies.of_triangle[index(hit->triangle)];
    return of != no_body && of != body;
  });
}

/// Of a closed body, with its caps.
struct Shell {
  std::vector<Corners3> triangles;
  Bounds bounds;
};

void add_triangle(Shell& shell, const Corners3& triangle) {
  shell.triangles.push_back(triangle);
  for (const Point3& corner : triangle) {
    shell.bounds.low = glm::min(shell.bounds.low, corner);
    shell.bounds.high = glm::max(shell.bounds.high, corner);
  }
}

double volume_of(const Shell& shell) {
  double volume = 0.0;
  const Point3 from = shell.bounds.low;
  for (const auto& [a, b, c] : shell.triangles)
    volume += glm::dot(a - from, glm::cross(b - from, c - from)) / 6.0;
  return volume;
}

bool is_in_bounds(const Shell& shell, const Point3& x) {
  return glm::all(glm::greaterThanEqual(x, shell.bounds.low)) &&
         glm::all(glm::lessThanEqual(x, shell.bounds.high));
}

bool is_inside(const Shell& shell, const Point3& x) {
  double angle = 0.0;
  for (const Corners3& triangle : shell.triangles) {
    const Vec3 a = triangle[0] - x, b = triangle[1] - x, c = triangle[2] - x;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                 glm::dot(b, c) * la +
                                                                 glm::dot(c, a) * lb);
  }
  return std::abs(angle) > 2.0 * std::numbers::pi;
}

/// Whether any of the points is inside, or there are too many to tell.
bool may_hold_any(const Shell& shell, const std::vector<Point3>& points) {
  constexpr std::size_t most_angles = 20'000'000;
  std::size_t angles = 0;
  return std::ranges::any_of(points, [&](const Point3& point) {
    if (!is_in_bounds(shell, point))
      return false;
    angles += shell.triangles.size();
    return angles > most_angles || is_inside(shell, point);
  });
}

/// Points of all lamps in the scene, of faces as far as `above` on the sides that shine.
std::vector<Point3> points_of_lamps(const Scene& scene, double above) {
  constexpr int steps = 4;
  std::vector<Point3> points;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (!is_emitter(material_of(scene, TriangleId{t})))
      continue;
    const auto [a, b, c] = corners(scene, TriangleId{t});
    const Vec3 up = above * glm::normalize(glm::cross(b - a, c - a));
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const Point3 at = a + (b - a) * (double(i) / steps) + (c - a) * (double(j) / steps);
        points.push_back(at + up);
        if (material_of(scene, TriangleId{t}).double_sided)
          points.push_back(at - up);
      }
  }
  for (const PunctualLight& light : scene.lights)
    if (light.kind != PunctualKind::directional)
      points.push_back(light.position);
  return points;
}

/// Adds the caps of a body's loops, if all of them are covered.
bool close_loops(const Scene& scene, const Body& body, std::uint32_t number, const Bodies& bodies,
                 const RayScene& rays, double tolerance, Shell& shell) {
  const auto loops = loops_of(body);
  if (!loops)
    return false;
  std::vector<Cap> caps;
  for (const auto& loop : *loops) {
    const auto cap = cap_of(scene, loop, tolerance);
    if (!cap)
      return false;
    caps.push_back(*cap);
    for (std::size_t k = 1; k + 1 < cap->corners.size(); ++k)
      add_triangle(shell, {cap->corners[0], cap->corners[k], cap->corners[k + 1]});
  }
  const bool outwards = volume_of(shell) > 0.0;
  return std::ranges::all_of(caps, [&](Cap& cap) {
    cap.normal *= outwards ? 1.0 : -1.0;
    return is_covered(cap, number, bodies, rays);
  });
}

/// Marks the inner sides of a body, if it is closed and dark inside.
void mark_inner_sides(const Scene& scene, const Bodies& bodies, std::uint32_t number,
                      const RayScene& rays, double tolerance, const std::vector<Point3>& lamps,
                      EnclosedSides& enclosed) {
  const Body& body = bodies.bodies[number];
  const auto is_double_sided = [&](TriangleId t) { return material_of(scene, t).double_sided; };
  if (!body.is_orientable || std::ranges::none_of(body.triangles, is_double_sided))
    return;
  Shell shell;
  for (std::size_t k = 0; k < body.triangles.size(); ++k) {
    Corners3 triangle = corners(scene, body.triangles[k]);
    if (bodies.turned[index(body.triangles[k])] != 0)
      std::swap(triangle[1], triangle[2]);
    add_triangle(shell, triangle);
  }
  if (!close_loops(scene, body, number, bodies, rays, tolerance, shell))
    return;
  const double volume = volume_of(shell);
  if (!(std::abs(volume) > 0.0))
    return;

  if (may_hold_any(shell, lamps))
    return;
  for (const TriangleId triangle : body.triangles) {
    const bool looks_out = (volume > 0.0) == (bodies.turned[index(triangle)] == 0);
    enclosed[index(triangle)][looks_out ? 1 : 0] = 1;
  }
}

} // namespace

EnclosedSides find_enclosed_sides(const Scene& scene, const SurfaceModel& surfaces,
                                  const RayScene& rays) {
  EnclosedSides enclosed(scene.triangles.size(), {0, 0});
  if (std::ranges::none_of(scene.materials, &Material::double_sided))
    return enclosed;
  const double tolerance = 0.5 * surfaces.tolerance;
  const Bodies bodies = find_bodies(scene, tolerance);
  const std::vector<Point3> lamps = points_of_lamps(scene, 8.0 * surfaces.tolerance);
  for (std::uint32_t b = 0; b < bodies.bodies.size(); ++b)
    mark_inner_sides(scene, bodies, b, rays, tolerance, lamps, enclosed);
  return enclosed;
}

} // namespace meninas
