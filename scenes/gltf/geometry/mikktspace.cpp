#include "scenes/gltf/geometry/mikktspace.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace meninas::gltf {

namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr std::uint32_t no_group = std::numeric_limits<std::uint32_t>::max();

Vec3 unit_or_zero(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : Vec3(0.0);
}

/// The direction of v across the normal n; zero along it.
Vec3 projected(const Vec3& v, const Vec3& n) {
  constexpr double along = 1e-6; // a sine; nearer to it rounding decides
  const Vec3 unit = unit_or_zero(v);
  const Vec3 across = unit - glm::dot(n, unit) * n;
  return glm::length(across) > along ? glm::normalize(across) : Vec3(0.0);
}

struct Face {
  Vec3 normal{0.0}; ///< of its own
  Vec3 along_u{0.0};
  bool tells = false;       ///< its coordinates change both ways
  bool is_mirrored = false; ///< sign < 0; where it does not tell, that of those it goes with
  Corners points{};         ///< equal where corners are one
  Corners neighbours{no_group, no_group, no_group}; ///< across the edges from corner k to k + 1
  Corners groups{no_group, no_group, no_group};
};

class Groups {
public:
  explicit Groups(const TexturedMesh& mesh) : mesh_(mesh), faces_(mesh.triangles.size()) {
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      measure(f);
    number_points();
    find_neighbours();
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (faces_[f].tells && faces_[f].groups[k] == no_group)
          fill(f, k);
  }

  std::vector<std::array<glm::vec4, 3>> tangents() const {
    // Of the directions by their angles, and of the angles.
    std::vector<glm::dvec4> sums(count_, glm::dvec4(0.0));
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (faces_[f].tells && faces_[f].groups[k] != no_group)
          sums[faces_[f].groups[k]] +=
              angle(f, k) * glm::dvec4(projected(faces_[f].along_u, normal(f, k)), 1.0);
    std::vector<std::array<glm::vec4, 3>> tangents(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr double cancelled = 1e-9;
        const std::uint32_t group = faces_[f].groups[k];
        const glm::dvec4 sum = group == no_group ? glm::dvec4(0.0) : sums[group];
        const double length = glm::length(Vec3(sum));
        tangents[f][k] = length > cancelled * sum.w
                             ? glm::vec4(Vec3(sum) / length, faces_[f].is_mirrored ? 1.0 : -1.0)
                             : glm::vec4(0.0F);
      }
    return tangents;
  }

private:
  const Vec3& position(std::uint32_t f, std::size_t k) const {
    return mesh_.positions[mesh_.triangles[f][k % 3]];
  }
  Vec3 given_normal(std::uint32_t f, std::size_t k) const {
    return mesh_.normals.empty() ? Vec3(0.0) : mesh_.normals[mesh_.triangles[f][k]];
  }
  Vec3 normal(std::uint32_t f, std::size_t k) const {
    const Vec3 given = unit_or_zero(given_normal(f, k));
    return given == Vec3(0.0) ? faces_[f].normal : given;
  }

  double angle(std::uint32_t f, std::size_t k) const {
    const Vec3 n = normal(f, k);
    const Vec3 next = projected(position(f, k + 1) - position(f, k), n);
    const Vec3 last = projected(position(f, k + 2) - position(f, k), n);
    return std::acos(std::clamp(glm::dot(next, last), -1.0, 1.0));
  }

  void measure(std::uint32_t f) {
    Face& face = faces_[f];
    const Vec3 e1 = position(f, 1) - position(f, 0), e2 = position(f, 2) - position(f, 0);
    face.normal = unit_or_zero(glm::cross(e1, e2));
    const auto uv = [&](std::size_t k) { return mesh_.texcoords[mesh_.triangles[f][k]]; };
    const Vec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const double det = d1.x * d2.y - d1.y * d2.x;
    face.is_mirrored = det < 0.0;
    face.along_u = (face.is_mirrored ? -1.0 : 1.0) * unit_or_zero(d2.y * e1 - d1.y * e2);
    const Vec3 along_v = unit_or_zero(d1.x * e2 - d2.x * e1);
    face.tells = det != 0.0 && face.along_u != Vec3(0.0) && along_v != Vec3(0.0);
  }

  /// Position, normal and texture coordinates in bits, in which both zeros are one.
  std::array<std::uint64_t, 8> key(std::uint32_t vertex, const Vec3& n) const {
    const Vec3& p = mesh_.positions[vertex];
    const Vec2& uv = mesh_.texcoords[vertex];
    std::array<std::uint64_t, 8> bits{};
    std::ranges::transform(std::array{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}, bits.begin(),
                           [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); });
    return bits;
  }

  /// Vertices that are equal have one number. Without normals corners have those of their faces.
  void number_points() {
    const bool by_vertex = !mesh_.normals.empty();
    std::vector<std::uint32_t> order(by_vertex ? mesh_.positions.size() : 3 * faces_.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key_of = [&](std::uint32_t k) {
      return by_vertex ? key(k, mesh_.normals[k])
                       : key(mesh_.triangles[k / 3][k % 3], Vec3(glm::vec3(faces_[k / 3].normal)));
    };
    std::ranges::sort(order, {}, key_of);
    std::vector<std::uint32_t> numbers(order.size(), 0);
    for (std::size_t k = 1; k < order.size(); ++k)
      numbers[order[k]] =
          numbers[order[k - 1]] + (key_of(order[k]) != key_of(order[k - 1]) ? 1 : 0);
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::uint32_t k = 0; k < 3; ++k)
        faces_[f].points[k] = numbers[by_vertex ? mesh_.triangles[f][k] : 3 * f + k];
  }

  struct Edge {
    std::uint32_t low, high;
    bool forward; ///< from low to high
    std::uint32_t face, side;
    auto operator<=>(const Edge&) const = default;
  };

  std::vector<Edge> edges() const {
    std::vector<Edge> edges;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      // Two corners in one place: nothing is around it.
      if (position(f, 0) == position(f, 1) || position(f, 1) == position(f, 2) ||
          position(f, 2) == position(f, 0))
        continue;
      for (std::uint32_t side = 0; side < 3; ++side) {
        const auto a = faces_[f].points[side], b = faces_[f].points[(side + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), a < b, f, side});
      }
    }
    std::ranges::sort(edges);
    return edges;
  }

  /// Pairs of triangles that run along an edge in opposite ways, the first with the first.
  void find_neighbours() {
    const std::vector<Edge> all = edges();
    for (auto first = all.begin(); first != all.end();) {
      const auto is_other = [&](const Edge& e) {
        return e.low != first->low || e.high != first->high;
      };
      const auto end = std::find_if(first, all.end(), is_other);
      const auto middle = std::find_if(first, end, [](const Edge& e) { return e.forward; });
      for (auto back = first, forth = middle; back != middle && forth != end; ++back, ++forth) {
        faces_[back->face].neighbours[back->side] = forth->face;
        faces_[forth->face].neighbours[forth->side] = back->face;
      }
      first = end;
    }
  }

  /// The group of a corner: what edges reach around its point.
  void fill(std::uint32_t f, std::size_t k) {
    const std::uint32_t group = count_++, point = faces_[f].points[k];
    const bool is_mirrored = faces_[f].is_mirrored;
    std::vector<std::uint32_t> reached{f};
    while (!reached.empty()) {
      Face& face = faces_[reached.back()];
      reached.pop_back();
      const auto corner =
          static_cast<std::size_t>(std::ranges::find(face.points, point) - face.points.begin());
      if (face.groups[corner] != no_group)
        continue;
      if (!face.tells && face.groups == Corners{no_group, no_group, no_group})
        face.is_mirrored = is_mirrored;
      if (face.is_mirrored != is_mirrored)
        continue;
      face.groups[corner] = group;
      for (const std::size_t side : {(corner + 2) % 3, corner})
        if (face.neighbours[side] != no_group)
          reached.push_back(face.neighbours[side]);
    }
  }

  const TexturedMesh& mesh_;
  std::vector<Face> faces_;
  std::uint32_t count_ = 0; ///< of groups
};

} // namespace

std::vector<std::array<glm::vec4, 3>> mikktspace_tangents(const TexturedMesh& mesh) {
  return Groups(mesh).tangents();
}

} // namespace meninas::gltf
