// Emitters, and a tree over them for scenes that have thousands.
//
// A node stands for a range of emitters: a sphere around them, their power,
// and a cone that holds their normals. From any point it says how much of their light can arrive,
// roughly and never nothing where there is something (Conty Estevez and Kulla 2018).
#pragma once

#include "mirror/convex_polygon.h"
#include "scenes/surfaces/surfaces.h"

#include <span>
#include <vector>

namespace meninas {

/// One emitting face: the front or the back of a patch.
struct Emitter {
  ConvexPolygon polygon; ///< counter-clockwise seen from the side that emits
  Plane plane;           ///< normal towards that side
  PlaneId plane_class = none<PlaneId>;
  Rgb radiosity{0.0}; ///< E = pi L
  double area = 0.0;
  MaterialId coat = none<MaterialId>; ///< above it, where that is a mirror: of what reflects, not of lamps
};

struct EmitterNode {
  Point3 centre{0.0}; ///< of a sphere around the emitters
  double radius = 0.0;
  double power = 0.0; ///< sum of area times the brightest channel of E, W
  Direction axis{0.0, 0.0, 1.0};
  double cos_spread =
      1.0; ///< of the angle around the axis that holds all normals; -1: they point anywhere
  std::uint32_t first = 0, count = 0; ///< range of LightTree::order
  std::uint32_t second_child = 0; ///< the first one follows its parent; 0: a leaf, of one emitter
};

struct LightTree {
  std::vector<EmitterNode> nodes; ///< depth first, [0] the root; empty when there are no emitters
  std::vector<std::uint32_t> order;
};

LightTree make_emitter_tree(std::span<const Emitter> emitters);

} // namespace meninas
