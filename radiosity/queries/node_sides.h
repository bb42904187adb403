// The sides of the faces of nodes that count in form factors between them.
//
// A single-sided face has its front. A double-sided one has two sides, and exporters make nearly
// everything double-sided. `facing` counts of each double-sided face of A those sides that see B:
//   1. sides that see nodes other than A; if neither does, both are looked at;
//   2. of two, one of which sees out of the scene and one does not, the latter:
//      the inside of a room, which outer walls have besides;
//   3. of these the sides that see B, directly or in mirrors; both where both do;
//      a face that sees nothing of B counts once, as it would if it were single-sided.
// So F = 1/A sum A_s F_s over these sides s, the sides of B are all there are, and
// reciprocity holds for A and B that lie on the same sides of everything between.
// By (1) the inside of a closed double-sided box does not dilute what its outside sends.
// Where faces lie on one another in one plane, the side there counts once, as that of the first.
// For several B together (rows of a matrix) a side counts when it sees any of them.
//
// The view of a side is found by cosine-distributed rays, also in mirrors, and by straight lines
// between points of A and B. A side counts as seeing B if it sees at least a thousandth of what the other side
// sees: seams between faces let through less. With few rays for each of very many faces
// (below 64) a side that sees next to nothing may be missed.
#pragma once

#include "mirror/mirrors.h"
#include "radiosity/queries/node_sets.h"
#include "form_factors/visible_parts.h"

#include <span>
#include <string>
#include <vector>

namespace meninas {

/// The same face seen from behind.
Face turned_round(const Face& face);

/// The sides of faces that may count, fronts first; those of backs are turned round.
std::vector<Face> sides_of_faces(const Scene& scene, std::span<const Face> faces, NodeSides sides);

struct CountedSides {
  std::vector<Face> faces;
  double fronts = 0.0, backs = 0.0; ///< their areas, m^2
  std::vector<std::string> not_counted;
};

struct SideQuestion {
  const Scene& scene;
  const SurfaceModel& surfaces;
  const MirrorSet& mirrors;
  const std::vector<Face>& all;  ///< faces of the scene
  std::span<const NodeSet> to;
  int max_depth = 0;
  NodeSides sides = NodeSides::facing;
};

/// The sides of `from`, none of which is a mirror, that count.
CountedSides counted_sides(const SideQuestion& question, const std::vector<Face>& from);

} // namespace meninas
