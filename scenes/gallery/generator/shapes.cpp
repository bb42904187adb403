#include "scenes/gallery/generator/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::gallery {

Mesh polygon(std::span<const Point3> corners) {
  Mesh mesh{{corners.begin(), corners.end()}, {}};
  for (std::uint32_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({0, k - 1, k});
  return mesh;
}

Mesh quad(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return polygon(std::array{a, b, c, d});
}

Mesh panel(const Sheet& sheet, const Rect& rect, double off) {
  const auto& [low, high] = rect;
  return quad(sheet.at(low.x, low.y, off), sheet.at(high.x, low.y, off),
              sheet.at(high.x, high.y, off), sheet.at(low.x, high.y, off));
}

/// Where a wall is divided, in order; sums that differ by rounding alone are one line.
static std::vector<double> dividing_lines(double low, double high, std::span<const Rect> openings,
                                          int axis) {
  std::vector<double> lines{low, high};
  for (const auto& opening : openings)
    lines.insert(lines.end(), {opening.low[axis], opening.high[axis]});
  std::ranges::sort(lines);
  constexpr double rounding = 1e-9;
  const auto same = [](double a, double b) { return b - a < rounding; };
  lines.erase(std::ranges::unique(lines, same).begin(), lines.end());
  return lines;
}

Mesh wall(const Sheet& sheet, const Rect& extent, std::span<const Rect> openings) {
  const auto s = dividing_lines(extent.low.x, extent.high.x, openings, 0);
  const auto t = dividing_lines(extent.low.y, extent.high.y, openings, 1);

  Mesh mesh;
  for (const auto row : t)
    for (const auto column : s)
      mesh.positions.push_back(sheet.at(column, row));
  const auto columns = static_cast<std::uint32_t>(s.size());
  for (std::uint32_t j = 0; j + 1 < t.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < s.size(); ++i) {
      const Vec2 middle{0.5 * (s[i] + s[i + 1]), 0.5 * (t[j] + t[j + 1])};
      const auto open = std::ranges::any_of(openings, [&](const Rect& rect) {
        return glm::all(glm::lessThan(rect.low, middle)) &&
               glm::all(glm::lessThan(middle, rect.high));
      });
      if (open)
        continue;
      const auto a = j * columns + i;
      mesh.triangles.push_back({a, a + 1, a + 1 + columns});
      mesh.triangles.push_back({a, a + 1 + columns, a + columns});
    }
  return mesh;
}

/// The four corners of a rectangle, counter-clockwise, at two distances from the sheet:
/// a band of four quads.
/// It faces away from the middle when `from` is nearer to the sheet than `to`, else towards it.
static Mesh band(const Sheet& sheet, const Rect& first, double from, const Rect& second,
                 double to) {
  const auto corner = [&](const Rect& rect, std::size_t k, double off) {
    return sheet.at(k == 1 || k == 2 ? rect.high.x : rect.low.x, k >= 2 ? rect.high.y : rect.low.y,
                    off);
  };
  Mesh mesh;
  for (std::size_t k = 0; k < 4; ++k)
    mesh.positions.push_back(corner(first, k, from));
  for (std::size_t k = 0; k < 4; ++k)
    mesh.positions.push_back(corner(second, k, to));
  for (std::uint32_t k = 0; k < 4; ++k) {
    const auto next = (k + 1) % 4;
    mesh.triangles.push_back({k, next, 4 + next});
    mesh.triangles.push_back({k, 4 + next, 4 + k});
  }
  return mesh;
}

Mesh reveal(const Sheet& sheet, const Rect& opening, double depth) {
  return band(sheet, opening, 0.0, opening, -depth);
}

Mesh frame(const Sheet& sheet, const Rect& inside, const Moulding& moulding) {
  const auto outside = grown(inside, moulding.width);
  return merged(std::array{band(sheet, outside, 0.0, outside, moulding.depth),
                           band(sheet, outside, moulding.depth, inside, moulding.depth),
                           band(sheet, inside, moulding.depth, inside, moulding.rebate)});
}

Mesh batten(const Sheet& sheet, const Rect& rect, double from, double to) {
  return merged(std::array{band(sheet, rect, from, rect, to), panel(sheet, rect, to)});
}

Mesh bar(const Point3& from, const Point3& to, double thickness) {
  const auto axis = glm::normalize(to - from);
  const auto helper = std::abs(axis.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
  const auto u = glm::normalize(glm::cross(helper, axis));
  const Sheet end{to, u, glm::cross(axis, u)};
  const Sheet start{from, glm::cross(axis, u), u};
  const Rect section{Vec2(-0.5 * thickness), Vec2(0.5 * thickness)};
  return merged(
      std::array{batten(end, section, -glm::distance(from, to), 0.0), panel(start, section, 0.0)});
}

/// Corners of a face of the box, counter-clockwise seen from outside.
static std::array<Point3, 4> face_corners(const Point3& a, const Point3& b, Face face) {
  switch (face) {
  case Face::x0:
    return {{{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}};
  case Face::x1:
    return {{{b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}}};
  case Face::y0:
    return {{{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}};
  case Face::y1:
    return {{{a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}}};
  case Face::z0:
    return {{{b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}}};
  case Face::z1:
    return {{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}};
  }
  return {};
}

Mesh box(const Point3& low, const Point3& high, std::span<const Face> open) {
  std::vector<Mesh> faces;
  for (const auto face : {Face::x0, Face::x1, Face::y0, Face::y1, Face::z0, Face::z1})
    if (std::ranges::find(open, face) == open.end())
      faces.push_back(polygon(face_corners(low, high, face)));
  return merged(faces);
}

Mesh standing_box(const Point3& low, const Point3& high) {
  return box(low, high, std::array{Face::y0});
}

Mesh room_wall(const Point3& low, const Point3& high, Face face) {
  auto corners = face_corners(low, high, face);
  std::ranges::reverse(corners);
  return polygon(corners);
}

Mesh standing_prism(std::span<const Vec2> base, double bottom, double top) {
  double twice_area = 0.0;
  for (std::size_t k = 0; k < base.size(); ++k) {
    const auto& a = base[k];
    const auto& b = base[(k + 1) % base.size()];
    twice_area += a.x * b.y - a.y * b.x;
  }

  // Seen from above, x runs right and z towards the viewer,
  // so a positive area in (x, z) runs clockwise.
  std::vector<Vec2> ring(base.begin(), base.end());
  if (twice_area > 0.0)
    std::ranges::reverse(ring);

  std::vector<Point3> lid;
  std::vector<Mesh> meshes;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto& a = ring[k];
    const auto& b = ring[(k + 1) % ring.size()];
    meshes.push_back(
        quad({a.x, bottom, a.y}, {b.x, bottom, b.y}, {b.x, top, b.y}, {a.x, top, a.y}));
    lid.emplace_back(a.x, top, a.y);
  }
  meshes.push_back(polygon(lid));
  return merged(meshes);
}

std::vector<Vec2> regular(const Vec2& centre, double radius, int sides) {
  std::vector<Vec2> corners;
  for (int k = 0; k < sides; ++k) {
    const auto angle = 2.0 * std::numbers::pi * (k + 0.5) / sides;
    corners.emplace_back(centre.x + radius * std::sin(angle), centre.y + radius * std::cos(angle));
  }
  return corners;
}

Mesh lathe(const Point3& foot, std::span<const Vec2> profile, int sides) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  std::vector<std::uint32_t> starts;
  for (const auto& point : profile) {
    const auto radius = point.x;
    starts.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    if (radius == 0.0)
      mesh.positions.push_back(foot + Vec3(0.0, point.y, 0.0));
    else
      for (const auto& corner : regular({foot.x, foot.z}, radius, sides))
        mesh.positions.emplace_back(corner.x, foot.y + point.y, corner.y);
  }
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
    for (std::uint32_t k = 0; k < n; ++k) {
      const auto vertex = [&](std::size_t r, std::uint32_t i) {
        return starts[r] + (profile[r].x == 0.0 ? 0 : i % n);
      };
      if (profile[ring].x != 0.0)
        mesh.triangles.push_back({vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1)});
      if (profile[ring + 1].x != 0.0)
        mesh.triangles.push_back({vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
    }
  return mesh;
}

Mesh merged(std::span<const Mesh> meshes) {
  Mesh all;
  for (const auto& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& [a, b, c] : mesh.triangles)
      all.triangles.push_back({first + a, first + b, first + c});
    all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
    all.texcoords.insert(all.texcoords.end(), mesh.texcoords.begin(), mesh.texcoords.end());
  }
  return all;
}

Mesh moved(Mesh mesh, const Vec3& by) {
  for (auto& position : mesh.positions)
    position += by;
  return mesh;
}

Mesh turned(Mesh mesh, const Point3& centre, const Direction& axis, double degrees) {
  const auto angle = glm::radians(degrees);
  const auto c = std::cos(angle);
  const auto s = std::sin(angle);
  // Rodrigues' rotation formula.
  const auto about_axis = [&](const Vec3& r) {
    return c * r + s * glm::cross(axis, r) + (1.0 - c) * glm::dot(axis, r) * axis;
  };
  for (auto& position : mesh.positions)
    position = centre + about_axis(position - centre);
  for (auto& normal : mesh.normals)
    normal = about_axis(normal);
  return mesh;
}

Mesh scaled(Mesh mesh, const Point3& centre, const Vec3& factors) {
  for (auto& position : mesh.positions)
    position = centre + factors * (position - centre);
  return mesh;
}

Mesh papered(Mesh mesh, const Sheet& sheet, double size) {
  mesh.texcoords.clear();
  for (const Point3& position : mesh.positions) {
    const Vec3 from = position - sheet.corner;
    mesh.texcoords.emplace_back(glm::dot(from, sheet.u) / size,
                                1.0 - glm::dot(from, sheet.v) / size);
  }
  return mesh;
}

Mesh mirrored_in_x(Mesh mesh) {
  for (auto& position : mesh.positions)
    position.x = -position.x;
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

} // namespace meninas::gallery
