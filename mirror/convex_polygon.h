// Convex polygons in space and their clipping (Sutherland and Hodgman 1974), without allocation.
#pragma once

#include "scenes/surfaces.h"

#include <array>
#include <span>

namespace meninas {

/// Up to `capacity` vertices in order. A clip that would exceed it keeps the polygon unclipped by that plane: a window of
/// depth k has at most 4 (k + 1) corners, so chains up to depth 15 of quads are exact.
struct ConvexPolygon {
  static constexpr std::size_t capacity = 64;
  std::array<Point3, capacity> vertices;
  std::size_t size = 0;

  ConvexPolygon() = default;
  explicit ConvexPolygon(std::span<const Point3> corners);
  std::span<const Point3> span() const { return {vertices.data(), size}; }
  bool empty() const { return size < 3; }
};

/// The part of the polygon where signed_distance(plane, x) >= 0; empty if that has no area.
ConvexPolygon clip(const ConvexPolygon& polygon, const Plane& plane);

/// The part of the polygon inside the cone from the apex through the window: one clip per edge of the window.
/// The window is counter-clockwise or clockwise seen from the apex; an apex in the window's plane sees nothing.
ConvexPolygon clip_to_cone(const ConvexPolygon& polygon, const Point3& apex, const ConvexPolygon& window);

/// Vector area: half the sum of cross products; its length is the area.
Vec3 area_vector(std::span<const Point3> polygon);

} // namespace meninas
