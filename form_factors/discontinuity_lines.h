// The lines on a face at which the shadows of blockers begin and end, where that is sudden.
//
// The plane through a corner of the target and an edge of a blocker meets the face in a line where the
// visible part of the target changes its law (a VE discontinuity: Heckbert 1992). With v the corner and a, b the
// ends of the edge, in metres, the line holds the points p of the face with
//
//   (p - v) . ((a - v) x (b - v)) = 0.
//
// All corners give one edge a band of lines, the penumbra, as narrow as the blocker's gap to the face. Samples
// further apart can miss the band and its light, with no sign in their values; so the face is cut where a band
// begins and ends.
// Between cuts the visible part changes at the scale of the part of the face, and the samples resolve it.
#pragma once

#include "form_factors/point_worlds.h"

namespace meninas {

/// An edge of a blocker; `beside` are the middles of the faces that share it.
struct BlockerEdge {
  Point3 from, to;
  PlaneId plane_class = none<PlaneId>;
  std::vector<Point3> beside;
};

/// All edges, each once: those that several faces share exactly are one.
std::vector<BlockerEdge> edges_of(const std::vector<Face>& blockers);

/// Some tens of parts are needed for a blocker; each has about a hundred points.
inline constexpr std::size_t enough_parts_at_lines = 128;

/// Cuts parts of a face along the bands that are narrow beside it, the widest first.
/// `known` are the targets that are not looked at by points.
struct LineLimits {
  bool by_mirrors;       ///< what is seen by way of one of the view's mirrors is looked at as well
  std::size_t max_lines; ///< where there are more to draw a part of them is, or none
  std::size_t max_parts; ///< of the face: one in as many is cut no further
};
void cut_at_discontinuity_lines(std::vector<ConvexPolygon>& parts, const Face& face, const WorldView& view,
                    const std::vector<BlockerEdge>& edges, const std::vector<std::uint8_t>& known,
                    const LineLimits& limits);

} // namespace meninas
