// The radiance of glossy metals, coated surfaces and panes, W/m^2/sr:
//
//   L(o) = L_e + rho(o) H / pi + sum_k w_k L(i_k) + sum_p f(o, i_p) E_p + sum_e f(o, i_e) cos_e L_e
//
// and of translucent surfaces tau(o) H_behind / pi (lane_surface.h).
// rho(o) is what the lobes without a direction of their own reflect towards o (even_reflectance,
// scenes/materials/bsdf.h), H the field; the first sum is over the grid of the lobe,
// each of whose rays is followed as those of a mirror are (glossy_frustum.h);
// the second over punctual lights and their images in the mirror worlds, which no ray can meet;
// the third over points of emitters and of their images.
// Few rays of the lobe meet a small lamp, and few of its points lie in a narrow lobe:
// where both find it, in the enumerated worlds, their shares are
//
//   p / (p + q)  and  q / (p + q),   p = n^2 D G1 / (4 cos_o),   q = N r^2 / (cos_e A)
//
// (balance heuristic, Veach 1997), p the rays' density,
// q about that of the N points on an emitter of area A, over any chain of mirrors.
//
// The first lobe of a path has a grid of up to `RenderSettings::glossy_samples` rays to each
// camera ray, shifted evenly among those of the pixel. Lobes behind it have one ray each.
// After `max_lobes` the field stands for the rest: pass one scatters evenly what lobes reflect.
//
// Light through a pane counts as if the pane were not there: a pane is no mirror on the way.
// Solids refract light and absorb it by the metre (glass.h).
// Without mirrors (`RenderMode::radiosity`) surfaces show the field,
// and panes what is straight behind them.
#pragma once

#include "raytrace/beams/lane_state.h"
#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"
#include "scenes/materials/lobes.h"

namespace meninas {

inline constexpr int max_lobes = 4;

/// Whether lane k has met a material with lobes, on a side where they show.
inline bool meets_lobes(const RenderContext& context, const FaceRecord& face, const HitPacket& hits,
                        std::uint32_t k) {
  return !context.bsdfs.empty() && (face.side != FaceRecord::nothing || face.mirrors) &&
         has_lobes(material_of(context.light.scene, TriangleId{hits.triangle[k]}));
}

/// The radiance of L_e and of the field where the lane has landed. The rays of its lobe are queued;
/// light of punctual lights and of points on emitters in the lobe goes to the pixel,
/// as if seen in a mirror, and by way of the mirrors of its world.
glm::vec3 scattered_radiance(const LandedLane& lane, TileWorkspace& work);

} // namespace meninas
