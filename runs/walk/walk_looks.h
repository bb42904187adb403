// The look of a material on a page, in a few numbers: the shading of pass two in terms that a
// shader computes at every pixel (page/room_shader.js).
//
//   L = L_e + rho H / pi,   rho = albedo c + rest
//
// with c the base colour texture times the vertex's colour. rho is linear in c: exact where both
// are 1, and for all dielectrics without sheen.
//
//   plain      as above; lobes that have no mirror world reflect the field evenly, as in pass one
//   unlit      L = albedo c
//   coat       rho (1 - R(cos)), and R(cos) of what its mirror shows, R Schlick's
//   mirror     its reflectance times c of what its mirror shows, above the even part of rough metals
//   pane       R(cos) of what its mirror shows, T(cos) of what is behind (scenes/materials/glass.h)
//   covering   a rho H / pi, and 1 - a of what is behind: alphaMode BLEND
//   unlit_covering  a albedo c, and 1 - a of what is behind
//   curved     its reflectance times c of what the middle of its body sees: an approximation
//   solid      R(cos) and T(cos) of one face of what the middle of its body sees along the mirrored
//              and the refracted ray, as if that met no second face: an approximation
//   glossy     a metal without a mirror world: rho H / pi of what its facets spread, and its lobe of what
//              the middle of its body sees along it, each as the albedo of its facets towards the eye shares them
#pragma once

#include "scenes/lamps.h"
#include "scenes/materials/texture_lookup.h"

namespace meninas {

enum class WalkKind { plain, unlit, coat, mirror, pane, covering, unlit_covering, curved, solid, glossy };

struct WalkLook {
  Rgb albedo{0.0}, rest{0.0};
  Rgb emission{0.0}; ///< radiance, times the emissive texture
  Rgb reflectance{0.0}; ///< of mirrors; of solids ln of what is left of light after a metre
  Rgb f0{0.0}; ///< of coats and panes; of glossy metal what its facets spread of light, from most sides
  double f90 = 0.0; ///< of the same; of glossy metal what its facets throw back at once of it
  double ior = 1.5;
  Rgb tint{1.0};        ///< of panes
  double alpha = 1.0;
  double cutoff = -1.0; ///< holes are where alpha is below it
  double roughness = 1.0;
  WalkKind kind = WalkKind::plain;
  std::uint32_t lamp = no_lamp; ///< whose light it emits, where lamps are known apart
  std::string_view name = {}; ///< of the material, which outlives it
};

/// The role of a face in the page besides its material.
enum class WalkFace {
  plain,  ///< it has no mirror world
  mirror, ///< it has one
  facet   ///< a part of a curved mirror
};

WalkLook walk_look(const Scene& scene, const DecodedTextures& textures, MaterialId material,
                   WalkFace face);

} // namespace meninas
