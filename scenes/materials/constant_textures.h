// Textures that say the same everywhere are factors.
//
// Exporters bake one value into an image: a metallic-roughness texture that is (0, 0, 255) all
// over is a mirror, an emission that is black is no lamp. Decisions by factors alone
// (mirrors, lamps, panes, reflectors that count as mirrors) are made after such textures are gone.
//
// Only texels that the triangles of a material show count (texel_ranges.h), and only channels that
// are read: green and blue of metallic-roughness, whose red often is occlusion; alpha where the
// material is no opaque one. A texture is constant where its 8-bit codes, as they are stored,
// differ by two or less: a colour that was taken to JPEG's luminance and chroma and back
// is off by one at the most either way. Its value is then the mean over the texels shown,
// or the end of the range, 0 or 1, that they reach, where noise is cut off.
// Larger differences are seen and stay. Pass one, though, takes a metal whose roughness differs by
// 16 codes or less for one of its mean: noise of JPEG at middling qualities, which widens a lobe
// of alpha = roughness^2 by less than the elements of pass one tell apart. If that is smooth,
// the metal throws light as a mirror does (smooth_surfaces.h), and pass two shows the texture.
// It is to be metal all over, for what is not has a share that scatters.
//
// Where one image holds many things (an atlas), a part whose triangles hang together and show one
// value gets a material of its own, if that value is of what is decided: metallic-roughness,
// transmission, emission, and the base colour of metals. Up to 64 such materials
// come from one, and so many texels are looked at that it takes some tenths of a second;
// beyond that textures stay what they are, which is slower and no less right.
//
// Textures of specular reflection and of clear coats are read for this alone: where they vary, the
// factors count without them, and that is said by name.
//
// A normal map that is constant and leans to no side is none.
//
// A cut-out material (alphaMode MASK) none of whose triangles shows a hole is opaque. One that is
// blended (BLEND) by a texture is opaque likewise; it is a cut-out where few texels are neither
// there nor open, as of leaves, whose outlines exporters smooth.
#pragma once

#include "scenes/materials/texture_lookup.h"

namespace meninas {

/// The largest difference of 8-bit codes of a texture that is constant.
inline constexpr double constant_codes = 2.0;

/// The largest difference of codes of roughness that pass one takes for its mean.
inline constexpr double nearly_constant_codes = 16.0;

/// Puts constant textures into the factors, marks smooth surfaces anew if any was (smooth_surfaces.h),
/// and drops the pixels of those that no material uses any more. Clear coats are decided on
/// (clear_coat.h). Returns what users are to be told.
std::vector<std::string> fold_constant_textures(Scene& scene, DecodedTextures& textures);

} // namespace meninas
