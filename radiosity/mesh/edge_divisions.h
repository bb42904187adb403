// The numbers of elements along the edges of each patch, so that patches of one surface agree on the edges
// they share.
//
// Opposite edges of a quad have one division, the three edges of a triangle as well,
// and an edge shared by two patches of one surface joins theirs: each such class takes
// the largest division any of its members wants, ceil(edge / size). A patch for which that
// would be more than `max_times` what it needs (slivers beside large patches) keeps its own.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <span>
#include <vector>

namespace meninas {

struct Divisions {
  int u = 1, v = 1;
};

/// By PatchId, for the wanted edge lengths by SurfaceId, in metres.
std::vector<Divisions> divide_edges(const SurfaceModel& surfaces,
                                    std::span<const double> element_size,
                                    double max_times = 4.0);

} // namespace meninas
