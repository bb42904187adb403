// Finer elements where the field does not tell what lies between its vertices (substructuring:
// Cohen, Greenberg, Immel, Brock 1986).
//
// A field is sampled at the vertices of the root cells.
// Each element is then looked at in a few more points x_k between: what its vertices say there, H~,
// against what a sample says, H. The relative error of its radiosity counts with its area,
//
//   eta_e^2 = A_e mean_k (w |H(x_k) - H~(x_k)|)^2,    w = rho / (B + B_mean)   of the root cell, brightest channel,
//
// less what the samples' own noise adds to it (below),
// and elements are divided whose eta_e^2 is above their share X^2 A / N,
// until the sum over all of them is below X^2 A: until the radiosity is X right in the mean square,
// relative to what is there, to the scene's mean where it is darker. So a smooth field gets large
// elements, and along the edge of a shadow, where the error does not fall with the size, elements
// become small until their area makes up for it: what an element costs brings the same everywhere.
// A, and the scene's mean, count no more of a wide ground than counted_area() does (element_mesh.h).
//
// Noise: samples with variance sigma^2 are off by H - H~ of variance (1 + 1/4) sigma^2
// in the middle of four vertices, however small the element. sigma is estimated relative to H,
// from points around, and taken off; elements are divided only for what stands out of it.
// So the bound is one for what elements hide.
// The noise of the vertices themselves is a matter of how many rays they take (adaptive_field.h).
//
// Most elements are plain: quick samples show next to nothing in all of their points.
// Only the others are looked at with samples whose noise is known.
//
// Vertices on which something stands, or at whose side it does,
// take what is sampled beside it, as on undivided meshes (contact_vertices.h).
//
// Limit: what is smaller than the distance of the points in a root cell may be overlooked.
// Edges of light that mirrors throw are not:
// they are known (mirror_outlines.h), and elements on them are looked at there too.
#pragma once

#include "radiosity/field/adaptive/field_sampler.h"


namespace meninas {

struct RefinementSettings {
  double error = 0.02;  ///< X
  int root_points = 15; ///< between the vertices, besides the centre: in root cells and on outlines
  int points = 4;       ///< in what is divided from them
  int max_levels = 6;
  std::size_t max_elements = 1'000'000;
};

/// `weight` is w by CellId of the roots of light.mesh, whose elements are looked at first.
/// The settings' error may not be reached: refinement ends at the limits of levels and elements,
/// and where elements are hardly wider than the scene's tolerance (subdivision.h).
SampledField refine_field(const LightScene& light, const FieldSampler& sampler,
                          std::span<const double> weight, const MirrorOutlines& outlines,
                          const RefinementSettings& settings);

} // namespace meninas
