// The hemisphere of one receiver, followed by rays:
// where they land, in which mirror world, with what light.
//
// The rays are those of a net, which all weigh the same,
// or the cells of a hemicube, which weigh as much as their delta form factors;
// weights are 1 in the mean, so that `rays` stands for the whole hemisphere in either case.
//
// Where glass reflects R and passes T of its light, a ray goes either way:
// on by reflection with chance p = max R / (max R + max T) and R / p of its light,
// else through with T / (1 - p) of it (max over the channels):
// straight through a pane, bent by the face of a solid (glass_rays.h).
// So rays remain as many as they were, however many panes there are, and each ends once.
// The numbers that decide are low-discrepancy over the receiver's rays.
// Of rays that mirrors let not go, one goes on for two from 64 bounces on (ray_comb.h).
//
// On a surface below a coat that is a mirror (scenes/materials/smooth_surfaces.h) a ray lands,
// with (1 - R) / (1 - R_mean) of its light, since the coat lets out less at grazing angles,
// and goes on by reflection with chance max R besides, beyond the enumerated worlds always
// and with R of its light. A coated receiver's own rays leave with as much: F stays reciprocal.
#pragma once

#include "radiosity/transport/gathered_rays.h"
#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/form_factor_rows.h"
#include "scenes/progress.h"
#include "radiosity/transport/hemicube.h"
#include "radiosity/transport/hemisphere_samples.h"
#include "radiosity/transport/glass_rays.h"

#include <span>

namespace meninas {

/// Fractions of the rays of the exposed part.
RowClosure closure_of(const GatheredRays& gathered);

/// Traces the net from the receiver; the result stands in workspace.result.
/// A cluster of faces does not tell which part of it is covered, but whether its faces are to be asked.
void gather_rays(const LightScene& light, const HemisphereSamples& net, const ReceiverArea& receiver,
                 std::uint32_t seed, const FormFactorSettings& settings,
                 GatherWorkspace& workspace);

/// Traces the cells of a hemicube about the corner of the receiver, which is a point.
void gather_rays(const LightScene& light, const Hemicube& cube, const ReceiverArea& receiver,
                 const FormFactorSettings& settings, GatherWorkspace& workspace);

/// Rays that leave with some light each, from anywhere.
struct LitPacket {
  RayPacket rays;
  std::array<glm::vec3, packet_size> light; ///< by lane, the brightest channel of all rays about 1
};

/// Traces them on through mirrors to their ends:
/// landings and ends speak of the light the rays left with times tau.
/// Light absorbed by mirrors is not counted.
void follow_light(const LightScene& light, std::span<const LitPacket> packets, std::uint32_t seed,
                  const FormFactorSettings& settings, GatherWorkspace& workspace);

/// The same for those alone of the rays that meet a face of a solid body first;
/// the others count as escaped. Fills `numbers`. All packets but the last are full.
void follow_into(const LightScene& light, std::uint32_t body, std::span<const LitPacket> packets,
                 std::uint32_t seed, const FormFactorSettings& settings,
                 GatherWorkspace& workspace);

/// The part of the receiver on which something stands, by the first legs of the net.
Covered covered_part(const LightScene& light, const HemisphereSamples& net, const ReceiverArea& receiver,
                     std::uint32_t seed, const FormFactorSettings& settings,
                     GatherWorkspace& workspace);

ReceiverArea receiver_of(const LightScene& light, ElementId element);

/// A part of a side as an area, by the (u, v) in its patch of its own (s, t).
template <typename PatchUv>
ReceiverArea part_of_side(const LightScene& light, const MeshSide& side, bool triangle,
                          const PatchUv& patch_uv) {
  const Patch& patch = light.surfaces.patches[index(side.patch)];
  const auto at = [&](double s, double t) { return point_at(patch, patch_uv(Vec2(s, t))); };
  ReceiverArea area;
  area.corner = at(0.0, 0.0);
  area.edge_u = at(1.0, 0.0) - area.corner;
  area.edge_v = at(0.0, 1.0) - area.corner;
  if (!triangle)
    area.edge_uv = at(1.0, 1.0) - area.corner - area.edge_u - area.edge_v;
  area.triangle = triangle;
  area.normal = side.normal;
  area.plane_class = side.plane_class;
  area.tangent = side.tangent;
  area.coat = side.coat;
  return area;
}

/// The emission (times weight and throughput) a landed ray brings where no closed form owns it:
/// emitters gathered as a whole, and the others beyond the enumerated worlds.
inline Rgb gathered_emission(const LightScene& light, const ElementHit& landing) {
  const SideId side = light.mesh.side_of_element[landing.element];
  const bool owned = light.direct_sides[index(side)] != 0 && landing.world != none<WorldId>;
  return owned ? Rgb(0.0) : light.mesh.emission[landing.element] * Rgb(landing.light);
}

} // namespace meninas
