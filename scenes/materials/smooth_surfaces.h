// Nearly ideal flat reflectors: the light they cast on other surfaces forms a recognisable patch.
//
// Pass one reflects evenly or ideally. The ideal mirror is nearer to a lobe of width alpha = roughness^2
// while the lobe is narrow beside the lit surface. This holds for flat surfaces, whose mirror worlds are few.
// Light from curved ones would be found by rays alone, by chance, and is spread evenly. Pass two shows the lobe
// in any case.
//
// Metals are mirrors of one reflectance then. Polished dielectrics (floors, table tops,
// tiles) are diffuse below a coat that is a mirror by Schlick's R(c), a twentieth of the light
// straight on and all of it at grazing angles: so much is worth mirror worlds where
// the coat covers a share of the scene that can be seen in the light of other surfaces.
#pragma once

#include "scenes/scene.h"

#include <span>

namespace meninas {

/// Beyond this roughness, along the direction in which facets are widest, metals throw light evenly;
/// coats show, and throw light, up to visible_coat_roughness (material.h).
inline constexpr double smooth_metal_roughness = 0.3;
/// The largest number of planes that the faces of such a material may lie in.
inline constexpr std::size_t max_smooth_planes = 8;
/// A plane is worth mirror worlds if its coats, of one material or many, have this share of the
/// scene's area: a table top in a furnished room has.
inline constexpr double min_coat_share = 0.005;
/// The largest number of such planes; the largest planes come first.
inline constexpr std::size_t max_coat_planes = 16;

/// Sets Material::specular_in_pass_one for every material:
/// true of metals rougher than ideal mirrors, but smooth, and of the coats of diffuse surfaces,
/// where their roughness has no texture, they are flat and, some of them, in a large plane.
/// `nearly_smooth` names metals besides, by MaterialId: those whose textures of roughness
/// vary little about a smooth mean (constant_textures.h).
void mark_smooth_surfaces(Scene& scene, std::span<const std::uint8_t> nearly_smooth = {});

/// Makes coats throw light evenly: for transports that know no reflectance by the angle.
void spread_coats(Scene& scene);

} // namespace meninas
