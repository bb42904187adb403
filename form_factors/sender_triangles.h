// The triangles that the integral over the senders begins with (extended_form_factor.h): the faces, in m^2 of area,
// cut where others stand on them (visible_parts.h) and where shadows begin suddenly (discontinuity_lines.h).
#pragma once

#include "form_factors/point_worlds.h"

#include <span>

namespace meninas {

struct SenderTriangle {
  std::array<Point3, 3> corners;
  std::uint32_t face = 0; ///< of the senders
  double area = 0.0;
};

/// A sending face, with what points of it are asked for: `known` marks the targets that they are not.
struct Sender {
  const Face& face;
  std::uint32_t id;
  const std::vector<std::uint8_t>& known;
};

/// The faces themselves.
std::vector<SenderTriangle> triangles_of(std::span<const Sender> senders);

struct CutLimits {
  bool by_mirrors;
  std::size_t max_lines;     ///< that are drawn for each face
  std::size_t max_triangles; ///< in all, which the faces share; each has what its corners need at the least
};

struct CutSenders {
  std::vector<SenderTriangle> triangles;
  bool cut_short = false; ///< there may have been more to cut
};

CutSenders cut_senders(std::span<const Sender> senders, const WorldView& view, const CutLimits& limits);

} // namespace meninas
