// The lines on a face at which the shadows of blockers begin and end, where that is sudden.
//
// A corner of what is looked at, an edge of a blocker: the plane through both meets the face
// in a line, across which what the face sees of the target changes its law. All the corners give
// an edge a band of such lines, the penumbra; of a blocker close to the face it is as narrow
// as the gap. Points much further apart than that may miss it altogether,
// as they do where the band lies along the lines by which a region is divided:
// with it goes the light of the band, and nothing in the values tells of it.
// So the face is cut where a band begins and ends. Between cuts everything changes
// at the scale of the part, and what points of a part do not tell apart is small.
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

/// Cuts parts of a face along the bands that are narrow beside it, the widest first.
/// `known` are the targets that are not looked at by points.
struct LineLimits {
  bool by_mirrors;       ///< what is seen by way of one of the view's mirrors is looked at as well
  std::size_t max_lines; ///< where there are more to draw a part of them is, or none
};
void cut_at_shadows(std::vector<ConvexPolygon>& parts, const Face& face, const WorldView& view,
                    const std::vector<BlockerEdge>& edges, const std::vector<std::uint8_t>& known,
                    const LineLimits& limits);

} // namespace meninas
