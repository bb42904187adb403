// A forecast of a picture's error and cost with other settings, from the run before.
//
// Costs are seconds, or rays where the same choice has to be made on every run: one unit in all of a run.
// The forecast starts from a measured run, with the parts of its error (raytrace/error/picture_error.h) and its costs:
//
//   elements x r   mesh_direct^2 r^-1/2 (an edge hides in a strip one element wide), the rest of mesh^2 r^-e, e = 1 at
//                  first; pass one r^0.7: nodes that light does not ask for are not divided
//   rays x r       form_factors^2 r^-1.2 (low-discrepancy rays); pass one 128 + rays: direct light costs about 128. The
//                  link error falls with r^-1/2
//   samples x 4    pixels^2 4^-1.7 (stratified samples at edges), 4^-1.1 with `gather`; pass two in proportion to the
//                  samples of the pixels that would take more
//   direct         mesh_direct^2 becomes 0; the rest of mesh^2 counts as at least mesh_direct^2 / 100.
//                  Pass two adds 0.3 hits with direct light per pixel, at their measured cost
//                  (vertices of the view's field)
//   gather         mesh^2 and form_factors^2 become the noise of the hits' 64 rays,
//                  9/4 form_factors^2 (rays / 64)^1.2 / samples; pass two adds the hits at their measured cost.
//                  In a run that gathers already, mesh^2 is the error of the field it gathers from: r^-e
//   the estimate   in proportion to its pixels, a share of the elements within limits; two thirds of a pixel's cost go
//                  with 128 + rays, a third with the samples drawn again
//
// The exponents are rough fits to the gallery; every run is measured again, and only the next one is forecast.
// The exponent of the mesh's error is measured as well, once two meshes have been solved.
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
  Parameters parameters;
  PictureError error;
  double pass_one_cost = 0.0, pass_two_cost = 0.0, estimate_cost = 0.0;
  double direct_cost = 0.0, gather_cost = 0.0; ///< of one hit with these terms; 0: not known
  double pixels = 0.0;
  double divided = 0.0;         ///< into so many elements, before the light had any divided further
  double samples_a_pixel = 4.0; ///< in the mean
  /// The share of pixels that would take more than 1,
  /// 4, 16, 64 times as many samples as `parameters` say.
  std::array<double, 4> uncertain{1.0, 1.0, 1.0, 1.0};
  double mesh_exponent =
      1.0; ///< e: the mesh's error squared falls with r^-e, what direct light would not have aside
};

/// The exponent of the mesh's error, measured from two runs with different meshes. It stays as it was where the
/// error is nearly all edges, or where hardly more elements were made than before: an undivided mesh says nothing
/// about division.
double measured_mesh_exponent(const MeasuredRun& coarse, const MeasuredRun& fine);

struct Forecast {
  double error = 0.0;
  /// The cost of the work to be done anew: nothing of pass one where only pass two changes,
  /// nor of the view's field where only samples do.
  double cost = 0.0;
  double estimate = 0.0; ///< of the cost, what telling the error takes, at the end
};
Forecast forecast(const MeasuredRun& run, const Parameters& parameters);

/// Samples of a pixel: the fewest that are asked for.
inline constexpr int min_samples = 4;

} // namespace meninas
