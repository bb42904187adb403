// Direct irradiance of elements: the mean over an element of what emitters and their images send (direct_irradiance.h).
//
//   D_i = 1/A_i integral over element i of D(x)  ~  sum_w tau_w sum_e E_e  mean_p F(x_p, T_w e clipped)  sum_pk g_pk V_pk / sum_pk g_pk
//
// Points x_p are a low-discrepancy sequence over the element, and so are the points on each image that shadow rays go to, counted on
// from point to point: a ray or two from each do what many would from a few. g is the share of the form factor a ray stands for, so that
// a fully visible image comes out as the closed form's mean, without noise. Points are doubled until the mean settles.
#pragma once

#include "radiosity/gather_rays.h"
#include "radiosity/light_samples.h"

#include <unordered_map>

namespace meninas {

/// One emitter in one world, over all points of the element so far.
struct ImageSum {
  Rgb source{0.0}; ///< tau E
  WorldId world = real_world;
  double form_factor = 0.0;       ///< sum over points, blockers aside
  double all = 0.0, seen = 0.0;   ///< weights of its shadow rays, and of those that arrive
  Rgb left{0.0};                  ///< of the latter, what glass on their way leaves
  std::uint32_t rays = 0;         ///< shadow rays so far
  std::uint32_t from_a_point = 1; ///< from each of the next points
};

/// A shadow ray that waits for others through the same mirrors.
struct WaitingRay {
  WorldId world = real_world;
  std::uint32_t image = 0; ///< index of its ImageSum
  PlaneId arriving = none<PlaneId>;
  double weight = 0.0;
  Point3 from, to;
};

/// Storage reused from element to element; one for each thread.
struct ElementWorkspace {
  DirectWorkspace point;
  std::vector<ImageSum> images;
  std::unordered_map<std::uint64_t, std::uint32_t> image_of; ///< by world and emitter
  std::vector<WaitingRay> waiting;
  std::vector<PunctualArrival> arrivals;
};

/// The mean over the exposed part of an element: points are doubled until it settles.
ArrivingLight direct_irradiance(const LightScene& light, ElementId element, CoveredCells covered,
                                const DirectSettings& settings, ElementWorkspace& workspace);

struct DirectIrradiance {
  std::vector<Rgb> irradiance; ///< by ElementId, the mean over the element
  std::vector<Rgb>
      punctual; ///< the part of it that punctual lights sent; empty where there are none
  std::uint64_t shadow_rays = 0;
};

/// `covered` by ElementId (gather_rays.h): the mean is over the exposed part. Empty: all is exposed.
DirectIrradiance direct_irradiance(const LightScene& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& settings, const Progress& progress = {});

} // namespace meninas
