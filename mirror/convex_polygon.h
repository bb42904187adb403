// Convex polygons in space and their clipping (Sutherland and Hodgman 1974), without allocation.
#pragma once

#include "mirror/reflection.h"
#include "scenes/surfaces/surfaces.h"

#include <array>
#include <span>

namespace meninas {

/// Up to `capacity` vertices in order. A clip adds at most one vertex; the (rare) clip that would
/// exceed the capacity is left out, so the polygon stays convex and errs on the large side:
/// quads through chains of quads are exact up to depth 10 at the least.
struct ConvexPolygon {
  static constexpr std::size_t capacity = 48;
  std::array<Point3, capacity> vertices;
  std::size_t size = 0;

  ConvexPolygon() {} // not defaulted: that would clear the vertices, wherever one is made by {}
  explicit ConvexPolygon(std::span<const Point3> corners);
  ConvexPolygon(const ConvexPolygon& other) { *this = other; }
  /// Copies the vertices in use only.
  ConvexPolygon& operator=(const ConvexPolygon& other) {
    size = other.size;
    for (std::size_t k = 0; k < size; ++k)
      vertices[k] = other.vertices[k];
    return *this;
  }

  std::span<const Point3> span() const { return {vertices.data(), size}; }
  bool empty() const { return size < 3; }
  void push_back(const Point3& vertex) { vertices[size++] = vertex; }
};

/// The part of the polygon where dot(normal, x - origin) >= 0; empty if that has no area.
ConvexPolygon clip(const ConvexPolygon& polygon, const Point3& origin, const Vec3& normal);

/// The same of a polygon that is not needed whole any more.
void clip_in_place(ConvexPolygon& polygon, const Point3& origin, const Vec3& normal);

/// The cone from an apex through a window: the planes through the apex a and the edges from p to q,
///
///   n = (p - a) x (q - a), inwards, m^2
///
/// without those of edges that are as short as their rounding.
/// The window may be of either orientation. An apex in the window's plane sees nothing,
/// nor does one that looks through a point: then there is no plane.
struct ViewCone {
  std::array<Vec3, ConvexPolygon::capacity> inward;
  std::size_t size = 0;

  ViewCone() {} // as ConvexPolygon, so that vectors of them copy what is in use
  ViewCone(const ViewCone& other) { *this = other; }
  ViewCone& operator=(const ViewCone& other) {
    size = other.size;
    for (std::size_t k = 0; k < size; ++k)
      inward[k] = other.inward[k];
    return *this;
  }
  void push_back(const Vec3& normal) { inward[size++] = normal; }
};

ViewCone view_cone(const Point3& apex, const ConvexPolygon& window);

/// The part of the polygon inside the cone from the apex: one clip per plane.
ConvexPolygon clip_to_cone(const ConvexPolygon& polygon, const Point3& apex, const ViewCone& cone);
ConvexPolygon clip_to_cone(const ConvexPolygon& polygon, const Point3& apex,
                           const ConvexPolygon& window);

/// Whether all edges are as short as their rounding,
/// as what is left of a polygon that a cone only touches: nothing is seen through it.
bool is_point(const ConvexPolygon& polygon, const Point3& apex);

/// Where the polygon appears, with its corners in the same order.
ConvexPolygon apply(const Isometry& map, const ConvexPolygon& polygon);

/// A = 1/2 sum of x_i x x_i+1 over the edges, m^2: its length is the area.
Vec3 area_vector(std::span<const Point3> polygon);

} // namespace meninas
