// The covered part of a receiver: what stands on it, no light can reach.
//
// It is found by cells, from the rays of the receiver. Cells on the boundary of a contact are sampled
// point by point, so that direct and gathered light are means over the open part alone, which is
// what others see of the receiver. Of its 64 cells, with k covered ones and f on their boundary,
//
//   exposed = 1 - (k + s f) / 64,   s = max(0, (b_f - b_0) / (1 - b_0))      (dimensionless)
//
// b is the share of rays that meet a black back at once: b_f in the boundary cells, b_0 in the open cells elsewhere.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/hemisphere_samples.h"

#include <span>

namespace meninas {

/// The covered part of a receiver, by cells of 8 x 8 over its (s, t): bit 8 i + j is cell (i, j).
/// Where the rays of a cell, if it has any, meet black backs at once, and all along the surface do,
/// something stands on that part of it: no light can reach it, and nothing sees it.
using ContactMask = std::uint64_t;
constexpr ContactMask wholly_covered = ~ContactMask{0};
inline std::uint32_t cell_of(double s, double t) {
  return 8U * static_cast<std::uint32_t>(8.0 * s) + static_cast<std::uint32_t>(8.0 * t);
}
inline bool contains(ContactMask cells, Vec2 st) {
  return ((cells >> cell_of(st.x, st.y)) & 1U) != 0;
}

/// The open cells that touch a covered one, also by a corner: a contact may cross them.
ContactMask boundary_cells(ContactMask covered);

struct Covered {
  ContactMask cells = 0;
  double rays = 0.0; ///< of the net, from these cells and from covered places in those at the foot
  float exposed = 1.0F; ///< the share of the receiver's area on which nothing stands
};

/// `black_lanes`: by packet of the net, the rays that met a black back at once.
/// In a cell at the foot these are the ones from covered places, as far as they are
/// a larger share than in exposed cells away from it.
Covered find_covered(const LightScene& light, const HemisphereSamples& net, const RaySource& source,
                     std::span<const std::uint32_t> black_lanes);

/// A place on a receiver, and its number among those of a sequence.
struct NumberedPlace {
  Vec2 st;
  std::uint32_t number;
};

/// The first exposed place of a low-discrepancy sequence from `first` on. Precondition: not every
/// place is covered. Where the open part is so small that 64 places in crossed cells are covered, it
/// is one of these.
NumberedPlace next_open_point(const LightScene& light, const ReceiverArea& receiver,
                            ContactMask covered, std::uint32_t seed, std::uint32_t first);

} // namespace meninas
