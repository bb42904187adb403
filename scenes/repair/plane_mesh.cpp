#include "scenes/repair/plane_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

namespace meninas {
namespace {

constexpr std::uint32_t outline = PlaneTriangle::outline;
constexpr double max_wanted = 3.0; ///< of a triangle's area

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

double taken_by(const Vec2& a, const Vec2& b, const Vec2& c) {
  return 0.5 * std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
}

/// Whether d lies in the circle through a, b, c by more than rounding.
bool is_in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double pp = glm::dot(p, p), qq = glm::dot(q, q), rr = glm::dot(r, r);
  const double sum = pp * cross(q, r) + qq * cross(r, p) + rr * cross(p, q);
  const double scale = pp * glm::length(q) * glm::length(r) + qq * glm::length(r) * glm::length(p) +
                       rr * glm::length(p) * glm::length(q);
  return sum > 1e-10 * scale;
}

struct Side {
  std::uint32_t triangle, side;
};

struct Editor {
  PlaneMesh& mesh;
  std::vector<Side> suspects{};         ///< edges that may have to be flipped
  std::vector<std::uint32_t> changed{}; ///< triangles that are new since this was cleared

  const Vec2& point(std::uint32_t p) const { return mesh.points[p]; }
  const Vec2& corner(std::uint32_t t, std::uint32_t k) const {
    return point(mesh.triangles[t].corners[k % 3]);
  }

  std::uint32_t side_towards(std::uint32_t t, std::uint32_t neighbour) const {
    const auto& n = mesh.triangles[t].neighbours;
    return static_cast<std::uint32_t>(std::find(n.begin(), n.end(), neighbour) - n.begin());
  }

  void replace_neighbour(std::uint32_t t, std::uint32_t before, std::uint32_t now) {
    if (t != outline)
      mesh.triangles[t].neighbours[side_towards(t, before)] = now;
  }

  /// Flips the edge if that makes the two triangles Delaunay. Both new ones must have area.
  void settle(const Side& edge) {
    const std::uint32_t t = edge.triangle;
    const std::uint32_t k = edge.side;
    const std::uint32_t u = mesh.triangles[t].neighbours[k];
    if (u == outline)
      return;
    const std::uint32_t j = side_towards(u, t);
    const PlaneTriangle a = mesh.triangles[t], b = mesh.triangles[u];
    // The edge runs from `from` to `to` in t; the apexes are opposite.
    const std::uint32_t from = a.corners[k], to = a.corners[(k + 1) % 3];
    const std::uint32_t apex = a.corners[(k + 2) % 3], other = b.corners[(j + 2) % 3];
    if (!is_in_circle(point(from), point(to), point(apex), point(other)))
      return;
    const double whole = twice_area(point(from), point(to), point(apex)) +
                         twice_area(point(to), point(from), point(other));
    constexpr double least = 1e-9;
    if (!(twice_area(point(apex), point(from), point(other)) > least * whole) ||
        !(twice_area(point(other), point(to), point(apex)) > least * whole))
      return;
    const std::uint32_t from_other = b.neighbours[(j + 1) % 3],
                        other_to = b.neighbours[(j + 2) % 3];
    const std::uint32_t to_apex = a.neighbours[(k + 1) % 3], apex_from = a.neighbours[(k + 2) % 3];
    mesh.triangles[t] = {{apex, from, other}, {apex_from, from_other, u}};
    mesh.triangles[u] = {{other, to, apex}, {other_to, to_apex, t}};
    replace_neighbour(from_other, u, t);
    replace_neighbour(to_apex, t, u);
    changed.insert(changed.end(), {t, u});
    for (std::uint32_t side = 0; side < 2; ++side) {
      suspects.push_back({t, side});
      suspects.push_back({u, side});
    }
  }

  void settle_all() {
    // Each flip brings the triangulation nearer to Delaunay; rounding is kept from going round in
    // circles by the bound.
    std::size_t left = 64 + 16 * mesh.triangles.size() * 64;
    while (!suspects.empty() && left-- > 0) {
      const Side edge = suspects.back();
      suspects.pop_back();
      settle(edge);
    }
    suspects.clear();
  }

  /// Divides a triangle at a point inside of it.
  void insert(std::uint32_t t, const Vec2& at) {
    const PlaneTriangle whole = mesh.triangles[t];
    const auto p = static_cast<std::uint32_t>(mesh.points.size());
    const auto u = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.points.push_back(at);
    const std::array<std::uint32_t, 3> parts{t, u, u + 1};
    mesh.triangles.resize(mesh.triangles.size() + 2);
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh.triangles[parts[k]] = {{whole.corners[k], whole.corners[(k + 1) % 3], p},
                                  {whole.neighbours[k], parts[(k + 1) % 3], parts[(k + 2) % 3]}};
      if (k > 0)
        replace_neighbour(whole.neighbours[k], t, parts[k]);
      suspects.push_back({parts[k], 0});
      changed.push_back(parts[k]);
    }
    settle_all();
  }

  /// Whether the point is in the circle about an edge of the outline of the triangle.
  bool crowds_outline(std::uint32_t t, const Vec2& at) const {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.triangles[t].neighbours[k] == outline &&
          glm::dot(corner(t, k) - at, corner(t, k + 1) - at) < 0.0)
        return true;
    return false;
  }

  /// Whether triangles take a tenth less after a point has been added. It replaces those that have
  /// it in their circles, its cavity (Bowyer 1981), by triangles from itself to the cavity's edges.
  /// Only slivers have it in common by the hundred: of them it is not asked.
  bool saves(std::uint32_t in, const Vec2& at) const {
    std::vector<std::uint32_t> cavity{in};
    double before = 0.0, after = 0.0;
    constexpr std::size_t many = 256;
    for (std::size_t i = 0; i < cavity.size(); ++i) {
      if (cavity.size() > many)
        return true;
      const std::uint32_t t = cavity[i];
      before += wanted_area(mesh, mesh.triangles[t]);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t u = mesh.triangles[t].neighbours[k];
        if (u != outline && std::ranges::find(cavity, u) != cavity.end())
          continue;
        if (u != outline && is_in_circle(corner(u, 0), corner(u, 1), corner(u, 2), at))
          cavity.push_back(u);
        else
          after += taken_by(corner(t, k), corner(t, k + 1), at);
      }
    }
    constexpr double worth_a_point = 0.9;
    return after < worth_a_point * before;
  }

  /// The triangle that a point is in, by a walk from another one; none beyond the outline.
  std::optional<std::uint32_t> walk(std::uint32_t t, const Vec2& to) const {
    for (std::size_t steps = 0; steps < mesh.triangles.size(); ++steps) {
      std::uint32_t way = 3;
      double farthest = 0.0;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const Vec2 edge = corner(t, k + 1) - corner(t, k);
        const double inside = cross(edge, to - corner(t, k)) / glm::length(edge);
        if (inside < farthest) {
          farthest = inside;
          way = k;
        }
      }
      if (way == 3)
        return t;
      t = mesh.triangles[t].neighbours[way];
      if (t == outline)
        return std::nullopt;
    }
    return std::nullopt;
  }

  std::optional<Vec2> circumcentre(std::uint32_t t) const {
    const Vec2 b = corner(t, 1) - corner(t, 0), c = corner(t, 2) - corner(t, 0);
    const double twice = 2.0 * cross(b, c);
    if (!(twice > 0.0))
      return std::nullopt;
    const double bb = glm::dot(b, b), cc = glm::dot(c, c);
    return corner(t, 0) + Vec2(c.y * bb - b.y * cc, b.x * cc - c.x * bb) / twice;
  }

  /// Adds the circumcentre of a triangle where it may be.
  bool add_circumcentre(std::uint32_t t) {
    auto at = circumcentre(t);
    if (!at)
      return false;
    const auto in = walk(t, *at);
    if (!in || crowds_outline(*in, *at))
      return false;
    for (const std::uint32_t beside : mesh.triangles[*in].neighbours)
      if (beside != outline && crowds_outline(beside, *at))
        return false;
    const Vec2 &a = corner(*in, 0), &b = corner(*in, 1), &c = corner(*in, 2);
    // On an edge, as the centre of a disc is, there is no triangle to be divided in three.
    constexpr double least = 1e-2; // of the triangle
    const auto is_inside = [&] {
      const double all = least * twice_area(a, b, c);
      return twice_area(a, b, *at) > all && twice_area(b, c, *at) > all &&
             twice_area(c, a, *at) > all;
    };
    if (!is_inside())
      at = glm::mix(*at, (a + b + c) / 3.0, 0.1);
    if (!is_inside() || !saves(*in, *at))
      return false;
    insert(*in, *at);
    return true;
  }
};

} // namespace

double wanted_area(const PlaneMesh& mesh, const PlaneTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return taken_by(mesh.points[a], mesh.points[b], mesh.points[c]);
}

void make_delaunay(PlaneMesh& mesh) {
  Editor editor{mesh};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      editor.suspects.push_back({t, k});
  editor.settle_all();
}

void refine(PlaneMesh& mesh, std::size_t max_points) {
  struct Bad {
    double excess;
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> corners;
    bool operator<(const Bad& other) const {
      return excess != other.excess ? excess < other.excess : triangle > other.triangle;
    }
  };
  Editor editor{mesh};
  std::priority_queue<Bad> queue;
  const auto look_at = [&](std::uint32_t t) {
    const double area =
        0.5 * twice_area(editor.corner(t, 0), editor.corner(t, 1), editor.corner(t, 2));
    const double excess = wanted_area(mesh, mesh.triangles[t]) - max_wanted * area;
    if (excess > 0.0)
      queue.push({excess, t, mesh.triangles[t].corners});
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    look_at(t);
  while (!queue.empty() && mesh.points.size() < max_points) {
    const Bad worst = queue.top();
    queue.pop();
    if (mesh.triangles[worst.triangle].corners != worst.corners)
      continue; // it has been flipped or divided since
    editor.changed.clear();
    if (editor.add_circumcentre(worst.triangle))
      std::ranges::for_each(editor.changed, look_at);
  }
}

} // namespace meninas
