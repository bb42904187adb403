// An estimate of a picture's own error, without a reference:
// the root of the mean square over pixels and channels,
// relative to the mean radiance, both over the pixels outside emitters (probes.h).
//
//   total^2 = mesh^2 + form_factors^2 + mirror_tail^2 + pixels^2 + solver^2
//
// At some pixels (probe_choice.h) light is also gathered: L is what the field shows
// through one camera ray, L_1 and L_2 what two independent gatherings of N rays and shadow
// rays show at its end, n of variance sigma^2 each. As n_1 and n_2 are independent,
//
//   mean (L_1 - L)(L_2 - L)  =  (error of L)^2              whatever the noise of either,
//   mean (L_1 - L_2)^2 / 2   =  sigma^2                     the noise of a vertex that gathers N rays.
//
// where light that is computed at the hit in both is drawn alike, and drops out:
// its noise is that of the pixels.
// Where the view has a field as fine as its pixels, edges are off to either side within a pixel, which its
// samples do not show. There light from emitters is compared in means,
//
//   mean over pixels of (D_a - L_a)(D_b - L_b),      a and b means over different rays of the same pixel
//
// and indirect light by itself at the ends of the same rays; products of both are left out. Each counts for no less
// than its standard error, below which it is not known.
// The sum is mesh^2 + form_factors^2 + mirror_tail^2. Its part form_factors^2 = 4/9 sigma^2
// is noise of vertices (4/9 is the mean of the sum of squared weights of bilinear interpolation),
// mirror_tail^2 is the difference between gatherings without and with the picture's cap on mirrors, and
// mesh^2 is the rest, the interpolation error. Direct light is cheap and has the edges:
// it is computed at many more pixels.
// pixels^2 is half the mean square of the change by another draw of all camera rays,
// at pixels of each number of samples for themselves:
// where sampling is adaptive, the few that have many have most of the error;
// and of those rather at edges (noise_choice.h). solver is the relative error of the solution in the mean
// over all surfaces; where that is not known, or is larger, the bound of the brightest spot.
//
// A picture that gathers at every hit has the error of the field that it gathers from. There
// L_1 - L and L_2 - L are the changes when, at some places where its rays land, light is gathered
// once more instead of taken from the elements (one_more_bounce()).
//
// Limits: gathered light comes from the picture's own field.
// An error that all of the field has alike is seen as what one more bounce changes, which
// is divided by the share of light that a bounce loses. Light that no draw has met is not known.
#pragma once

#include "raytrace/error/probes.h"
#include "raytrace/two_pass.h"

namespace meninas {

struct PictureErrorSettings {
  int gathered_pixels = 128; ///< where light is gathered, twice
  int pixels = 1024;         ///< where the rest is computed; of another draw more of those that have few samples
};

struct PictureError {
  double mesh = 0.0, form_factors = 0.0, mirror_tail = 0.0, pixels = 0.0, solver = 0.0;
  double mesh_direct =
      0.0; ///< the part of mesh that direct light at every hit would not have
  double total = 0.0;
  double mean_radiance = 0.0; ///< what all are relative to
  std::uint64_t rays = 0;     ///< traced to find out
  double seconds = 0.0;
  /// The cost of one hit with these terms; 0: none was made.
  double direct_seconds = 0.0, gather_seconds = 0.0, direct_rays = 0.0, gather_rays = 0.0;
};

/// As render() made it.
struct SampledPicture {
  const Image& image;
  const SampleCounts& samples;
  const IrradianceField* finer = nullptr; ///< Rendering::finer
};

/// So many pixels that finding out takes a few per cent of the rays of pass one, within limits.
PictureErrorSettings error_settings(const TwoPassSettings& settings, std::size_t elements);

/// The error of `picture`, which render() made of this field with these settings.
/// `largest_reflected` is the largest reflected radiosity, W/m^2.
PictureError estimate_error(const IrradianceField& field,
                            const Camera& camera, const TwoPassSettings& settings,
                            const SolverResult& solver, const SampledPicture& picture,
                            const PictureErrorSettings& how);

} // namespace meninas
