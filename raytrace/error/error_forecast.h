// How the error of a picture and what it costs change with the settings, from one run to the next.
//
// Costs are seconds, or rays where the same choice has to be made on every run: one unit in all of a run.
// From a measured run with its parts of the error (raytrace/error/picture_error.h) and costs:
//   elements x r   mesh_direct^2 r^-1/2 (an edge hides in a strip one element wide), the rest of mesh^2 r^-1;
//                  pass one r^0.7: nodes that light does not ask for are not divided
//   rays x r       form_factors^2 r^-1.2 (low-discrepancy rays); pass one (128 + rays), as direct light costs about so much
//   samples x 4    pixels^2 4^-1.7 (stratified samples at edges), 4^-1.1 where they gather; pass two as the pixels that would take them
//   direct         mesh_direct^2 none, of which the rest of mesh^2 is not known to less than a hundredth; pass two three tenths of a hit a pixel more, of those that were made to find out: the vertices of the view's field
//   gather         mesh^2 and form_factors^2 none, but the noise of a hit's own rays, a share in pixels^2; pass two as the hits say
//                  and once light is gathered, mesh^2 is what it is gathered from, and falls with r^-e
//   the estimate   as the pixels it looks at, a share of the elements within limits; two thirds of it 128 + rays, a third the samples drawn again, of each number as many pixels
// The exponents are those of the gallery, roughly;
// every run is measured again, and only what comes next is foretold.
// How the mesh's error falls is measured as well, once two meshes have been seen.
#pragma once

#include "raytrace/error/picture_error.h"

#include <array>

namespace meninas {

/// The settings that are turned to make a picture more accurate.
struct Parameters {
  double elements = 600.0; ///< wanted
  int rays = 64;
  int samples = 4; ///< of a pixel, at most: sampling is adaptive
  DiffuseTerm term = DiffuseTerm::interpolated;

  bool operator==(const Parameters&) const = default;
};

struct MeasuredRun {
  Parameters knobs;
  PictureError error;
  double pass_one_cost = 0.0, pass_two_cost = 0.0, estimate_cost = 0.0;
  double direct_cost = 0.0, gather_cost = 0.0; ///< of one hit with these terms; 0: not known
  double pixels = 0.0;
  double divided = 0.0;         ///< into so many elements, before the light had any divided further
  double samples_a_pixel = 4.0; ///< in the mean
  /// The share of pixels that would take more than 1,
  /// 4, 16, 64 times as many samples as `knobs` say.
  std::array<double, 4> uncertain{1.0, 1.0, 1.0, 1.0};
  double mesh_exponent =
      1.0; ///< e: the mesh's error squared falls with r^-e, what direct light would not have aside
};

/// How fast the mesh's error falls, by two runs with meshes of their own;
/// as before where it is nearly all edges, or where hardly more elements were made than before:
/// what is not divided tells nothing of what division does.
double measured_mesh_exponent(const MeasuredRun& coarse, const MeasuredRun& fine);

struct Forecast {
  double error = 0.0;
  /// Of what has to be done anew: nothing of pass one where only pass two changes,
  /// nor of the view's field where only samples do.
  double cost = 0.0;
};
Forecast forecast(const MeasuredRun& run, const Parameters& knobs);

/// Samples of a pixel: the fewest that are asked for.
inline constexpr int min_samples = 4;

} // namespace meninas
