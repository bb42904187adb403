// A convex polygon cut along segments, and which of its pieces are one region.
//
// Each segment cuts the piece in which it lies along its whole line (binary space partition: Fuchs,
// Kedem, Naylor 1980), the longest first. So pieces are convex, and a point finds its own by signs.
// Pieces that meet where no segment lies between them are one region again; gaps that segments
// leave along a line, narrower than a sixteenth of the polygon, count as closed.
// Where segments end within the polygon, the pieces on either side of them stay two regions: what
// lies between is a step that tapers off to where the segment's line leaves the polygon.
//
// Two-dimensional; lengths in the units of the points. Segments nearer than `grain` to a border of
// a piece are taken to lie on it, and cut nothing.
#pragma once

#include "scenes/types.h"

#include <array>
#include <span>
#include <vector>

namespace meninas {

struct Segment2 {
  Vec2 a{0.0}, b{0.0};
};

/// Signed distance dot(normal, x) - offset: `next[0]` below zero, `next[1]` from zero on.
struct CutLine {
  static constexpr std::uint32_t piece = 0x80000000U; ///< marks a piece in `next`
  Vec2 normal{1.0, 0.0};
  double offset = 0.0;
  std::array<std::uint32_t, 2> next{0, 0};
};

struct CutPolygon {
  std::vector<CutLine> lines;              ///< the first is the root; none: one piece
  std::vector<std::vector<Vec2>> pieces;   ///< convex, counter-clockwise
  std::vector<std::uint32_t> region;       ///< by piece
  std::uint32_t regions = 1;
};

/// The polygon is convex and counter-clockwise.
CutPolygon cut_polygon(std::span<const Vec2> polygon, std::span<const Segment2> segments,
                       double grain);

/// The part of the segment within a convex polygon, borders included; false where there is none.
bool clip_to(std::span<const Vec2> polygon, double grain, Segment2& segment);

/// Where along the way from a to b (0 to 1) segments meet it: places or stretches, in order.
/// Stretches nearer to one another than `grain` are one.
struct Stretch {
  double from = 0.0, to = 0.0;
};
std::vector<Stretch> met_along(Vec2 a, Vec2 b, std::span<const Segment2> segments, double grain);

/// The stretches of the way from a to b along which the pieces of a region lie, within `grain`.
std::vector<Stretch> stretches_along(Vec2 a, Vec2 b, const CutPolygon& cut, std::uint32_t region,
                                     double grain);

/// Whether a piece of the region has a corner within `grain` of the point.
bool has_corner(const CutPolygon& cut, std::uint32_t region, Vec2 point, double grain);

/// Signed, positive if counter-clockwise, in the square of the points' unit.
double area_of(std::span<const Vec2> polygon);

} // namespace meninas
