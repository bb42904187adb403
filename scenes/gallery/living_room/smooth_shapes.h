// Closed bodies with curved sides, and their normals: cushions, turned wood, tubes; and sheets of cloth.
//
// Normals are those of the curved surface, by its equation or as the mean of the faces around a
// vertex weighted by area (Gouraud 1971). Metres; fronts face outwards.
#pragma once

#include "scenes/gallery/generator/shapes.h"

#include <functional>

namespace meninas::gallery {

/// A number from 0 to 1 by its place in a row: the same on every run (Steele et al. 2014, SplitMix64).
double chance(std::uint64_t seed);

/// Normals by the faces around each vertex; vertices that faces do not share stay sharp.
Mesh smoothed(Mesh mesh);

/// Each face apart, with its own normal; texture coordinates are kept.
Mesh faceted(const Mesh& mesh);

/// (|x / a|^p + |z / c|^p)^(q / p) + |y / b|^q = 1 about `centre`: a superellipsoid (Barr 1981),
/// as a cube's grid of `n` x `n` faces drawn onto it from its middle;
/// `size` is that of its texture in metres.
struct Superellipsoid {
  Point3 centre;
  Vec3 half; ///< a, b, c
  double p = 4.0;
  double q = 4.0;
  double size = 0.25;
};
Mesh superellipsoid(const Superellipsoid& body, int n);

/// A box whose edges are rounded with that radius, by 2 `n` faces a quarter of a circle;
/// textured as every box is here, by its coordinates along each side over `size` metres.
Mesh rounded_box(const Point3& low, const Point3& high, double radius, int n, double size = 0.5);

/// A box with normals, textured likewise.
Mesh plain_box(const Point3& low, const Point3& high, double size = 0.5);

/// Flat faces apart, each textured along its own plane's axes.
Mesh box_mapped(const Mesh& mesh, double size = 0.5);

/// Smooth between the points of a profile of (radius, height), by cubics that do not overshoot
/// (Fritsch, Carlson 1980) in `steps` a span; a point that is there twice is an edge.
std::vector<Vec2> rounded_profile(std::span<const Vec2> points, int steps);

/// A surface of revolution with normals; its profile ends on the axis, or at what it stands on.
Mesh turned_body(const Point3& foot, std::span<const Vec2> profile, int sides);

/// A tube along a line, thinner from its first radius to its last, closed at both ends.
Mesh tube(std::span<const Point3> line, double first_radius, double last_radius, int sides);

/// A point of a sheet for s and t from 0 to 1.
using SheetFunction = std::function<Point3(double s, double t)>;

/// An open sheet, its front along d/ds x d/dt, with (s, t) as texture coordinates.
Mesh sheet_of(const SheetFunction& at, int columns, int rows);

/// Every vertex moved by a function; normals are made anew.
Mesh bent(Mesh mesh, const std::function<Point3(const Point3&)>& by);

} // namespace meninas::gallery
