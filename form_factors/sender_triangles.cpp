#include "form_factors/sender_triangles.h"

#include "form_factors/discontinuity_lines.h"

#include <algorithm>

namespace meninas {

namespace {

void append_fan(const ConvexPolygon& polygon, std::uint32_t face, std::vector<SenderTriangle>& triangles) {
  for (std::size_t k = 2; k < polygon.size; ++k) {
    const std::array corners{polygon.vertices[0], polygon.vertices[k - 1], polygon.vertices[k]};
    triangles.push_back({corners, face, glm::length(area_vector(corners))});
  }
}

} // namespace

std::vector<SenderTriangle> triangles_of(std::span<const Sender> senders) {
  std::vector<SenderTriangle> triangles;
  for (const Sender& sender : senders)
    append_fan(sender.face.polygon, sender.id, triangles);
  return triangles;
}

CutSenders cut_senders(std::span<const Sender> senders, const WorldView& view, const CutLimits& limits) {
  std::vector<BlockerEdge> edges;
  if (view.blockers.size() < limits.max_lines)
    edges = edges_of(view.blockers);
  CutSenders cut;
  std::size_t left = limits.max_triangles;
  for (std::size_t s = 0; s < senders.size(); ++s) {
    const Sender& sender = senders[s];
    // A part is a quadrilateral, mostly. Faces that need less leave the rest to those behind them.
    const std::size_t max_parts = std::max<std::size_t>(1, left / (2 * (senders.size() - s)));
    std::vector<ConvexPolygon> parts =
        cut_at_contacts(sender.face, view.blockers, view.tolerance, std::min(max_parts, enough_parts_at_contacts));
    cut_at_discontinuity_lines(parts, sender.face, view, edges, sender.known,
                               {limits.by_mirrors, limits.max_lines, max_parts});
    cut.cut_short = cut.cut_short || (parts.size() >= max_parts && max_parts < enough_parts_at_lines);
    const std::size_t before = cut.triangles.size();
    for (const ConvexPolygon& part : parts)
      append_fan(part, sender.id, cut.triangles);
    left -= std::min(left, cut.triangles.size() - before);
  }
  return cut;
}

} // namespace meninas
