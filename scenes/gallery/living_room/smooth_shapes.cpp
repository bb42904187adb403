#include "scenes/gallery/living_room/smooth_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace meninas::gallery {

double chance(std::uint64_t seed) {
  std::uint64_t z = (seed + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9U;
  z = (z ^ z >> 27U) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ z >> 31U) >> 11U) * 0x1p-53;
}

Mesh smoothed(Mesh mesh) {
  mesh.normals.assign(mesh.positions.size(), Vec3(0.0));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3& p = mesh.positions[a];
    const Vec3 twice_area = glm::cross(mesh.positions[b] - p, mesh.positions[c] - p);
    for (const auto vertex : {a, b, c})
      mesh.normals[vertex] += twice_area;
  }
  for (auto& normal : mesh.normals)
    normal = glm::normalize(normal);
  return mesh;
}

Mesh faceted(const Mesh& mesh) {
  Mesh apart;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.positions.size());
    for (const auto vertex : triangle) {
      apart.positions.push_back(mesh.positions[vertex]);
      if (!mesh.texcoords.empty())
        apart.texcoords.push_back(mesh.texcoords[vertex]);
    }
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return smoothed(std::move(apart));
}

namespace {

/// The body's equation without its size, and its gradient.
double implicit(const Superellipsoid& body, const Vec3& d) {
  const double s = std::pow(std::abs(d.x), body.p) + std::pow(std::abs(d.z), body.p);
  return std::pow(s, body.q / body.p) + std::pow(std::abs(d.y), body.q);
}

Direction gradient(const Superellipsoid& body, const Vec3& d) {
  const double s = std::pow(std::abs(d.x), body.p) + std::pow(std::abs(d.z), body.p);
  const double outer = s > 0.0 ? std::pow(s, body.q / body.p - 1.0) : 0.0;
  const auto part = [](double x, double power) {
    return std::copysign(std::pow(std::abs(x), power - 1.0), x);
  };
  return glm::normalize(
      Vec3(outer * part(d.x, body.p), part(d.y, body.q), outer * part(d.z, body.p)) / body.half);
}

/// -1 to 1 for i from 0 to n, evenly in the angle.
double eighth_turns(int i, int n) {
  return i == 0 ? -1.0 : i == n ? 1.0 : std::tan(0.25 * std::numbers::pi * (2 * i - n) / n);
}

/// A point of a side of the cube from -1 to 1; u and v run so that the side faces outwards.
Vec3 on_cube(int axis, double side, double u, double v) {
  Vec3 d;
  d[axis] = side;
  d[(axis + 1) % 3] = side * u;
  d[(axis + 2) % 3] = v;
  return d;
}

/// Triangles of a grid of vertices from `first` on, `columns` + 1 in a row.
void add_grid(Mesh& mesh, std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = first + j * (columns + 1) + i;
      const std::uint32_t d = a + columns + 1;
      mesh.triangles.push_back({a, a + 1, d + 1});
      mesh.triangles.push_back({a, d + 1, d});
    }
}

} // namespace

Mesh superellipsoid(const Superellipsoid& body, int n) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(n);
  // Each axis as the outward one of two sides; (u, v, w) stays right-handed.
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          // Tangents spread the grid evenly over angles.
          Vec3 d = on_cube(axis, side, eighth_turns(i, n), eighth_turns(j, n));
          d *= std::pow(implicit(body, d), -1.0 / body.q);
          const Vec3 from = body.half * d;
          mesh.positions.push_back(body.centre + from);
          mesh.normals.push_back(gradient(body, d));
          mesh.texcoords.emplace_back(from[(axis + 1) % 3] / body.size,
                                      from[(axis + 2) % 3] / body.size);
        }
      add_grid(mesh, first, count, count);
    }
  return mesh;
}

Mesh rounded_box(const Point3& low, const Point3& high, double radius, int n, double size) {
  const Point3 centre = 0.5 * (low + high);
  const Vec3 core = 0.5 * (high - low) - radius;
  // Arcs of n faces either side of a flat one: entries k of a row, and to which end they belong.
  const auto entry = [&](int k) { return eighth_turns(k <= n ? k : k - 1, 2 * n); };
  Mesh mesh;
  const int last = 2 * n + 1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int j = 0; j <= last; ++j)
        for (int i = 0; i <= last; ++i) {
          const Direction d = glm::normalize(on_cube(axis, side, entry(i), entry(j)));
          const Vec3 end = on_cube(axis, side, i <= n ? -1.0 : 1.0, j <= n ? -1.0 : 1.0);
          const Vec3 from = core * end + radius * d;
          mesh.positions.push_back(centre + from);
          mesh.normals.push_back(d);
          mesh.texcoords.emplace_back(from[(axis + 1) % 3] / size, from[(axis + 2) % 3] / size);
        }
      add_grid(mesh, first, static_cast<std::uint32_t>(last), static_cast<std::uint32_t>(last));
    }
  return mesh;
}

Mesh box_mapped(const Mesh& mesh, double size) {
  Mesh flat = faceted(mesh);
  flat.texcoords.clear();
  for (std::size_t k = 0; k < flat.positions.size(); ++k) {
    const Vec3 n = glm::abs(flat.normals[k]);
    const Point3& p = flat.positions[k];
    const Vec2 at = n.x >= n.y && n.x >= n.z ? Vec2(p.z, p.y)
                    : n.y >= n.z             ? Vec2(p.x, p.z)
                                             : Vec2(p.x, p.y);
    flat.texcoords.push_back(at / size);
  }
  return flat;
}

Mesh plain_box(const Point3& low, const Point3& high, double size) {
  return box_mapped(box(low, high), size);
}

/// The slope at a point of a profile: zero at an extreme, and never so steep that the curve overshoots.
static Vec2 slope_at(const Vec2& before, const Vec2& at, const Vec2& after) {
  Vec2 slope = 0.5 * (after - before);
  for (int axis = 0; axis < 2; ++axis) {
    const double in = at[axis] - before[axis], out = after[axis] - at[axis];
    const double most = in * out > 0.0 ? 3.0 * std::min(std::abs(in), std::abs(out)) : 0.0;
    slope[axis] = std::clamp(slope[axis], -most, most);
  }
  return slope;
}

std::vector<Vec2> rounded_profile(std::span<const Vec2> points, int steps) {
  std::vector<Vec2> profile;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Vec2 &b = points[k], &c = points[k + 1];
    if (b == c)
      continue;
    const bool starts = k == 0 || points[k - 1] == b;
    const bool ends = k + 2 == points.size() || points[k + 2] == c;
    const Vec2 first = starts ? c - b : slope_at(points[k - 1], b, c);
    const Vec2 last = ends ? c - b : slope_at(b, c, points[k + 2]);
    if (starts && k != 0)
      profile.push_back(b); // an edge: the ring is there twice
    profile.push_back(b);
    for (int step = 1; step < steps; ++step) {
      const double t = static_cast<double>(step) / steps; // Hermite's cubic
      profile.push_back(b + t * t * (3.0 - 2.0 * t) * (c - b) + t * (1.0 - t) * (1.0 - t) * first -
                        t * t * (1.0 - t) * last);
    }
  }
  profile.push_back(points.back());
  return profile;
}

Mesh turned_body(const Point3& foot, std::span<const Vec2> profile, int sides) {
  // Rings apart where the profile has an edge: pieces between points that are there twice.
  std::vector<Mesh> pieces;
  std::size_t first = 0;
  for (std::size_t k = 1; k <= profile.size(); ++k) {
    if (k < profile.size() && profile[k] != profile[k - 1])
      continue;
    if (k - first > 1)
      pieces.push_back(smoothed(lathe(foot, profile.subspan(first, k - first), sides)));
    first = k;
  }
  return merged(pieces);
}

Mesh tube(std::span<const Point3> line, double first_radius, double last_radius, int sides) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  const std::size_t last = line.size() - 1;
  // Carried along without a twist (Bishop 1975), as a fixed direction would flip where they align.
  const Direction start = glm::normalize(line[1] - line[0]);
  Vec3 across = std::abs(start.x) < 0.7 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  for (std::size_t k = 0; k <= last; ++k) {
    const Direction along = glm::normalize(line[std::min(k + 1, last)] - line[k == 0 ? 0 : k - 1]);
    const Direction u = glm::normalize(across - glm::dot(across, along) * along);
    across = u;
    const Direction v = glm::cross(along, u);
    const double radius =
        glm::mix(first_radius, last_radius, static_cast<double>(k) / static_cast<double>(last));
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      mesh.positions.push_back(line[k] + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  const auto rings = static_cast<std::uint32_t>(line.size());
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = ring * n + i, b = ring * n + (i + 1) % n;
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
  for (const std::uint32_t end : {0U, rings - 1}) {
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(line[end]);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = end * n + i, b = end * n + (i + 1) % n;
      mesh.triangles.push_back(end == 0 ? std::array{middle, b, a} : std::array{middle, a, b});
    }
  }
  return smoothed(std::move(mesh));
}

Mesh sheet_of(const SheetFunction& at, int columns, int rows) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double s = static_cast<double>(i) / columns, t = static_cast<double>(j) / rows;
      mesh.positions.push_back(at(s, t));
      mesh.texcoords.emplace_back(s, t);
    }
  add_grid(mesh, 0, static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
  return smoothed(std::move(mesh));
}

Mesh bent(Mesh mesh, const std::function<Point3(const Point3&)>& by) {
  for (auto& position : mesh.positions)
    position = by(position);
  // Vertices at one place, as along the edges of a cube's grid, have one normal.
  std::map<std::array<double, 3>, std::uint32_t> known;
  Mesh welded = mesh;
  for (auto& triangle : welded.triangles)
    for (auto& vertex : triangle) {
      const Point3& p = mesh.positions[vertex];
      vertex = known.try_emplace({p.x, p.y, p.z}, vertex).first->second;
    }
  welded = smoothed(std::move(welded));
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const Point3& p = mesh.positions[k];
    const auto at = known.find({p.x, p.y, p.z});
    mesh.normals[k] = welded.normals[at == known.end() ? k : at->second];
  }
  return mesh;
}

} // namespace meninas::gallery
