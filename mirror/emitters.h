// Emitters, and a tree over them for scenes that have thousands.
//
// A node stands for a range of emitters: a sphere around them, their power,
// and a cone that holds their normals. From any point it says how much of their light can arrive,
// roughly and never nothing where there is something (Conty Estevez and Kulla 2018).
//
// From afar the emitters of a node, of powers P_i and normals n_i, have the intensity
//
//   I(omega) = 1 / pi sum_i P_i max(0, n_i . omega),     W/sr, of the brightest channel
//
// as a cluster has in hierarchical radiosity (Smits, Arvo, Greenberg 1994). If emitters are many, those
// whose normals fall into one cell of a cube of 6 x 8 x 8 are summed beforehand:
// they face omega together or not at all, but for cells that see it edge-on, where all cosines are small.
#pragma once

#include "mirror/convex_polygon.h"
#include "scenes/surfaces/surfaces.h"

#include <span>
#include <vector>

namespace meninas {

inline constexpr std::uint32_t no_portal = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::uint32_t no_area_light = std::numeric_limits<std::uint32_t>::max();

/// One emitting face, the front or the back of a patch; or an opening, or an area light, which are none.
struct Emitter {
  std::vector<Point3> corners; ///< of a convex polygon, counter-clockwise seen from the side that emits
  Plane plane; ///< normal towards that side
  PlaneId plane_class = none<PlaneId>;
  Rgb radiosity{0.0}; ///< E = pi L
  double area = 0.0;
  MaterialId coat = none<MaterialId>; ///< above it, where that is a mirror: of what reflects, not of lamps
  std::uint32_t portal = no_portal; ///< of an opening, whose light comes from beyond it, its number (radiosity/scene/sky_portals.h)

  std::uint32_t area_light = no_area_light; ///< of what is no face, its number in Scene::area_lights

  bool shows_sky() const { return portal != no_portal; }
  /// Whether rays meet it; what they do not meet its points alone tell of, or what is beyond.
  bool is_face() const { return portal == no_portal && area_light == no_area_light; }
};

struct EmitterNode {
  Point3 centre{0.0}; ///< of a sphere around the emitters
  double radius = 0.0;
  double power = 0.0; ///< sum of area times the brightest channel of E, W
  Direction axis{0.0, 0.0, 1.0};
  double cos_spread =
      1.0; ///< of the angle around the axis that holds all normals; -1: they point anywhere
  std::uint32_t first = 0, count = 0; ///< range of LightTree::order
  std::uint32_t first_flux = 0, flux_count = 0; ///< range of LightTree::flux
  Point3 middle{0.0}; ///< mean of the emitters' middles by power
  std::uint32_t second_child = 0; ///< the first one follows its parent; 0: a leaf, of one emitter
};

struct LightTree {
  std::vector<EmitterNode> nodes; ///< depth first, [0] the root; empty when there are no emitters
  std::vector<std::uint32_t> order;
  std::vector<Vec3> flux;   ///< sums of power times normal, W: first of each emitter, in order
  std::vector<double> sent; ///< power of all emitters before each in order, W; one longer
};

LightTree make_emitter_tree(std::span<const Emitter> emitters);

/// pi I(omega), W; omega away from the node.
double intensity_times_pi(const LightTree& tree, const EmitterNode& node, const Direction& omega);

} // namespace meninas
