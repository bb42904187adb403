#include "form_factors/visible_parts.h"

#include "mirror/window.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <map>

namespace meninas {

namespace {

void set_polygon(Face& face, const ConvexPolygon& polygon, double tolerance) {
  face.polygon = polygon;
  face.area = glm::length(area_vector(polygon.span()));
  face.centre = Point3(0.0);
  for (const auto& vertex : polygon.span())
    face.centre += vertex / static_cast<double>(polygon.size);
  face.radius = 0.0;
  for (const auto& vertex : polygon.span())
    face.radius = std::max(face.radius, glm::distance(vertex, face.centre));
  face.radius += tolerance;
}

Face make_face(const SurfaceModel& model, const Surface& surface, NodeId node,
               const ConvexPolygon& polygon) {
  Face face;
  face.plane = surface.plane;
  face.plane_class = surface.plane_class;
  face.material = surface.material;
  face.node = node;
  set_polygon(face, polygon, model.tolerance);
  return face;
}

/// Whether no side of `a` has all of `b`, which lies in its plane, outside or within `depth` of it.
bool reaches_into(const ConvexPolygon& a, const ConvexPolygon& b, const Direction& normal,
                  double depth) {
  for (std::size_t k = 0; k < a.size; ++k) {
    const Vec3 edge = a.vertices[k + 1 < a.size ? k + 1 : 0] - a.vertices[k];
    const Vec3 inwards = glm::cross(normal, edge);
    if (inwards == Vec3(0.0)) // two corners in one place
      continue;
    const auto is_outside = [&](const Point3& vertex) {
      return glm::dot(inwards, vertex - a.vertices[k]) <= depth * glm::length(inwards);
    };
    if (std::ranges::all_of(b.span(), is_outside))
      return false;
  }
  return true;
}

bool overlap(const Face& a, const Face& b, double tolerance) {
  return glm::distance(a.centre, b.centre) <= a.radius + b.radius &&
         glm::dot(a.plane.normal, b.plane.normal) > 0.0 &&
         reaches_into(a.polygon, b.polygon, a.plane.normal, tolerance) &&
         reaches_into(b.polygon, a.polygon, b.plane.normal, tolerance);
}

/// By face, those before it that overlap it.
std::vector<std::vector<std::size_t>> covers_of(const std::vector<Face>& faces, double tolerance) {
  std::map<PlaneId, std::vector<std::size_t>> by_plane;
  for (std::size_t f = 0; f < faces.size(); ++f)
    by_plane[faces[f].plane_class].push_back(f);
  std::vector<std::vector<std::size_t>> covers(faces.size());
  for (auto& [plane, members] : by_plane) {
    // Along an axis of the plane only those whose intervals overlap can do so themselves.
    const Direction along = tangent_frame(faces[members.front()].plane.normal).tangent;
    const auto begin = [&](std::size_t f) {
      return glm::dot(along, faces[f].centre) - faces[f].radius;
    };
    std::ranges::stable_sort(members, {}, begin);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const double end = begin(members[k]) + 2.0 * faces[members[k]].radius;
      for (std::size_t l = k + 1; l < members.size() && begin(members[l]) < end; ++l)
        if (overlap(faces[members[k]], faces[members[l]], tolerance))
          covers[std::max(members[k], members[l])].push_back(std::min(members[k], members[l]));
    }
  }
  return covers;
}

/// The inward normals of the cone's sides; none when the apex is in the blocker's plane.
struct Cone {
  std::array<Vec3, ConvexPolygon::capacity> inward;
  std::size_t size = 0;
};

Cone cone_over(const Point3& x, const ConvexPolygon& blocker) {
  Cone cone;
  if (blocker.empty())
    return cone;
  const double side = glm::dot(area_vector(blocker.span()), blocker.vertices[0] - x);
  if (side == 0.0)
    return cone;
  for (std::size_t k = 0; k < blocker.size; ++k) {
    const Point3 &from = blocker.vertices[k],
                 &to = blocker.vertices[k + 1 < blocker.size ? k + 1 : 0];
    // a x b = a x (b - a), without the cancellation b would bring far away.
    const Vec3 normal = glm::cross(from - x, to - from);
    if (normal == Vec3(0.0))
      continue;
    cone.inward[cone.size++] = side > 0.0 ? normal : -normal;
  }
  return cone;
}

bool is_beyond(const ConvexPolygon& part, const Point3& x, const Vec3& inward) {
  for (const auto& vertex : part.span())
    if (glm::dot(inward, vertex - x) > 0.0)
      return false;
  return true;
}

bool misses(const ConvexPolygon& part, const Point3& x, const Cone& cone) {
  for (std::size_t k = 0; k < cone.size; ++k)
    if (is_beyond(part, x, cone.inward[k]))
      return true;
  return false;
}

/// Slivers of the rounding of a cut.
constexpr double min_share = 1e-14;

/// Appends what of the part lies outside the cone.
void cut_out(const ConvexPolygon& part, const Point3& x, const Cone& cone,
             std::vector<ConvexPolygon>& outside) {
  const std::size_t before = outside.size();
  const double least = min_share * glm::length(area_vector(part.span()));
  ConvexPolygon rest = part;
  for (std::size_t k = 0; k < cone.size && !rest.empty(); ++k) {
    const ConvexPolygon piece = clip(rest, x, -cone.inward[k]);
    if (!piece.empty() && glm::length(area_vector(piece.span())) > least)
      outside.push_back(piece);
    clip_in_place(rest, x, cone.inward[k]);
  }
  // Nothing of it is hidden: it stays whole.
  if (rest.empty() || glm::length(area_vector(rest.span())) <= least) {
    outside.resize(before);
    outside.push_back(part);
  }
}

enum class Sides { none, below, above, both };

/// On which sides of a plane the polygon has corners, those within `tolerance` of it on neither.
Sides sides_of(const ConvexPolygon& polygon, const Point3& origin, const Direction& normal,
               double tolerance) {
  bool above = false, below = false;
  for (const auto& vertex : polygon.span()) {
    const double height = glm::dot(normal, vertex - origin);
    above |= height > tolerance;
    below |= height < -tolerance;
  }
  return above && below ? Sides::both : above ? Sides::above : below ? Sides::below : Sides::none;
}

/// Whether a plane through an edge of `a` and a corner of `b`
/// bounds both on one side and has the blocker on the other.
bool bounded_by_edges(const ConvexPolygon& a, const ConvexPolygon& b, const ConvexPolygon& blocker,
                      double tolerance) {
  for (std::size_t k = 0; k < a.size; ++k) {
    const Point3& origin = a.vertices[k];
    const Vec3 edge = a.vertices[k + 1 < a.size ? k + 1 : 0] - origin;
    for (const auto& corner : b.span()) {
      const Vec3 cross = glm::cross(edge, corner - origin);
      const double length = glm::length(cross);
      if (length <= tolerance * glm::length(edge))
        continue;
      const Direction normal = cross / length;
      const Sides of_a = sides_of(a, origin, normal, tolerance),
                  of_b = sides_of(b, origin, normal, tolerance);
      const Sides other = sides_of(blocker, origin, normal, tolerance);
      for (const Sides inside : {Sides::above, Sides::below}) {
        const bool bounds =
            (of_a == inside || of_a == Sides::none) && (of_b == inside || of_b == Sides::none);
        if (bounds && other != inside && other != Sides::both)
          return true;
      }
    }
  }
  return false;
}

} // namespace

std::vector<Face> joined_faces(const SurfaceModel& surfaces) {
  std::vector<Face> faces;
  for (const Surface& surface : surfaces.surfaces) {
    std::map<NodeId, std::vector<ConvexPolygon>> by_node;
    for (const PatchId id : surface.patches) {
      const Patch& patch = surfaces.patches[index(id)];
      by_node[patch.node].emplace_back(polygon_of(patch));
    }
    for (auto& [node, polygons] : by_node)
      for (const auto& polygon : merge_convex(std::move(polygons), surface.tolerance))
        faces.push_back(make_face(surfaces, surface, node, polygon));
  }
  return faces;
}

std::vector<Face> without_overlaps(const std::vector<Face>& faces, double tolerance) {
  const auto covers = covers_of(faces, tolerance);
  std::vector<Face> once;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::vector<ConvexPolygon> parts{faces[f].polygon};
    for (const std::size_t cover : covers[f]) {
      // Seen straight from above, a cover's cone cuts the plane along the cover's own edges.
      const Face& above = faces[cover];
      subtract_cone(parts, above.centre + above.radius * above.plane.normal, above.polygon);
    }
    for (const ConvexPolygon& part : parts) {
      once.push_back(faces[f]);
      if (!covers[f].empty())
        set_polygon(once.back(), part, tolerance);
    }
  }
  return once;
}

std::vector<ConvexPolygon> cut_at_contacts(const Face& face, const std::vector<Face>& others,
                                           double tolerance, std::size_t max_parts) {
  std::vector<ConvexPolygon> parts{face.polygon};
  for (const Face& other : others) {
    if (other.plane_class == face.plane_class ||
        glm::distance(other.centre, face.centre) > other.radius + face.radius)
      continue;
    for (std::size_t k = 0; k < other.polygon.size; ++k) {
      const Point3 &from = other.polygon.vertices[k],
                   &to = other.polygon.vertices[k + 1 < other.polygon.size ? k + 1 : 0];
      const bool touches = std::abs(signed_distance(face.plane, from)) <= tolerance &&
                           std::abs(signed_distance(face.plane, to)) <= tolerance;
      if (touches && parts.size() < max_parts)
        cut_along(parts, from, to, face.plane.normal, tolerance);
    }
  }
  return parts;
}

void cut_along(std::vector<ConvexPolygon>& parts, const Point3& from, const Point3& to,
               const Direction& front, double tolerance) {
  const Vec3 edge = to - from;
  const Vec3 across = glm::cross(front, edge);
  const double length = glm::length(across);
  if (length <= tolerance)
    return;
  const std::size_t count = parts.size();
  for (std::size_t p = 0; p < count; ++p) {
    const ConvexPolygon beside = clip(clip(parts[p], from, edge), to, -edge);
    if (beside.empty() || sides_of(beside, from, across / length, tolerance) != Sides::both)
      continue;
    const ConvexPolygon left = clip(parts[p], from, across), right = clip(parts[p], from, -across);
    if (left.empty() || right.empty())
      continue;
    parts[p] = left;
    parts.push_back(right);
  }
}

void subtract_cone(std::vector<ConvexPolygon>& parts, const Point3& x,
                   const ConvexPolygon& blocker) {
  const Cone cone = cone_over(x, blocker);
  if (cone.size < 3)
    return;
  const std::size_t count = parts.size();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (misses(parts[k], x, cone)) {
      if (kept != k)
        parts[kept] = parts[k];
      ++kept;
      continue;
    }
    const ConvexPolygon part = parts[k];
    cut_out(part, x, cone, parts);
  }
  parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(kept),
              parts.begin() + static_cast<std::ptrdiff_t>(count));
}

bool holds_apart(const ConvexPolygon& a, const ConvexPolygon& b, const ConvexPolygon& blocker,
                 double tolerance) {
  const Vec3 front_a = area_vector(a.span()), front_b = area_vector(b.span());
  // Nothing behind either polygon's plane is between their fronts.
  const ConvexPolygon between = clip(clip(blocker, a.vertices[0], front_a), b.vertices[0], front_b);
  if (between.empty())
    return true;
  if (sides_of(between, a.vertices[0], glm::normalize(front_a), tolerance) == Sides::none)
    return true;
  if (sides_of(between, b.vertices[0], glm::normalize(front_b), tolerance) == Sides::none)
    return true;
  return bounded_by_edges(a, b, between, tolerance) || bounded_by_edges(b, a, between, tolerance);
}

} // namespace meninas
