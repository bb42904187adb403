// The vertices and triangles of a room in a page: tables of whole numbers (packed_numbers.h).
//
//   position     from the middle of the scene, by the step of `PageVertices`
//   irradiance   halves times a scale (walk_lamps.h): of the room, and of each lamp, "lamp0" and so on
//   normal       on the octahedron (Meyer et al. 2010), two coordinates in 2^-14; left out where no vertex has one
//   place        on the two textures, in 2^-16 of the image; left out where all are 0
//   colour       by 1 / 65535; left out where all are white
//   look         which of the room's
//   triangles    three vertices each;   elementEnds   those of the room
//
// Corners of a batch that are the same row in all of these are one vertex. A room has many: each facet of a finely
// tessellated object has corners of its own, and where the light is the same they differ in nothing. The page computes
// data of single triangles, as the slope of black backs, from its triangles.
#pragma once

#include "runs/walk/packed_numbers.h"
#include "runs/walk/walk_room.h"

#include <vector>

namespace meninas {

/// Whether the page has a vertex for each of the room, in its order, as it must where other light of the room's
/// vertices is to follow; or one for all that are alike, in the order in which the triangles meet them.
enum class VertexNumbering { by_room, joined };

struct PageVertices {
  PackedNumbers packed;
  double step = 1.0;              ///< of positions, metres
  float light = 1.0F;             ///< of irradiance, W/m^2
  std::vector<float> lamp_lights; ///< the same of each lamp's
};

/// With the light of the first so many lamps apart.
PageVertices page_vertices(const WalkRoom& room, std::size_t lamps, VertexNumbering numbering);

} // namespace meninas
