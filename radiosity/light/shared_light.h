// Direct irradiance where several points of one plane share their shadow rays:
// points of an element. One point may send its rays in rounds, as many as it takes.
//
//   mean_p D(x_p)  ~  sum_w tau_w sum_e E_e  mean_p F(x_p, T_w e past known blockers)  sum_pk g_pk V_pk / sum_pk g_pk
//
// The points on each image that shadow rays go to are one low-discrepancy sequence,
// counted on from point to point: a few rays from each do what many would from one.
// g is the share of the form factor a ray stands for, so that a fully visible image comes
// out as the closed form's mean, without noise. Points are doubled until the mean settles.
// The number of rays of a point depends only on earlier points, so the mean is unbiased. If it depended
// on the point's own rays, the outer half of each penumbra would be too dark and the inner half too bright.
// Limit: a mean may settle early and miss light or shade that none of its first rays met. Where one point learns what
// blocks its rays, others of no weight look at the rim of each image, of which frames hide the thinnest strips.
//
// Occluders that rays have met are cached for later means that share the workspace (occluder_cache.h).
// These take the shadows of cached occluders out of F exactly and send their rays past them:
// once all are cached V is 1, and a penumbra has no noise, but that of an uneven sky in a window.
// The mean stays unbiased, because cached occluders were found by other rays.
#pragma once

#include "radiosity/light/element_images.h"
#include "radiosity/light/image_sums.h"
#include "radiosity/light/light_samples.h"
#include "radiosity/light/spot_parts.h"
#include "radiosity/light/waiting_rays.h"

#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace meninas {

struct SharedLightSettings {
  int points = 2;       ///< to begin with
  int max_points = 16; ///< doubled up to this while the mean is unsure
  int images = 256;     ///< emitter images computed at a point; of more, a choice
  int rays = 4;         ///< from each point to an image, to begin with
  int penumbra_rays =
      4; ///< from each of the later points to an image that is seen in part; one goes to others
  int solid_rays = 256; ///< from all points together to a body of solid glass that fills the hemisphere (glass_light.h)
  double unsure = 0.01;         ///< relative change of the mean by the last doubling
  double unsure_shadow = 0.005; ///< error of the mean by shadow rays, relative
  bool rays_by_brightness =
      false; ///< images that bring less than the brightest one in sight take fewer rays
  bool one_place = false; ///< all points are the same one, which sends rays in rounds
  bool caches_occluders = false; ///< what blocks its rays, and uses what others have learned
};

/// The visible part of an image from one point, past cached occluders.
struct ImageAtPoint {
  std::uint32_t image = 0;          ///< index of its ImageSum
  double form_factor = 0.0;         ///< times how many images it stands for
  bool whole = true;                ///< nothing known is in the way
  std::size_t first = 0, parts = 0; ///< otherwise: in SharedLightWorkspace::parts
};

/// Storage reused from one mean to the next; one for each thread.
struct SharedLightWorkspace {
  DirectWorkspace point;
  std::vector<ImageSum> images;
  std::unordered_map<std::uint64_t, std::uint32_t> image_of; ///< by world and emitter
  std::vector<ImageAtPoint> at_point;                        ///< the images of one point
  std::vector<ConvexPolygon> parts;                          ///< of these
  std::vector<ConvexPolygon> cutting;                        ///< of one of them
  WaitingRays waiting;
  ElementImages elements;
  std::vector<PunctualArrival> arrivals;
  std::vector<SpotPart> spots; ///< of lights that are left out of the means
  double shadow_error = 0.0; ///< of the last mean, about, by the choice of shadow rays: its brightest channel, W/m^2
  bool has_new_occluders = false;  ///< something that blocks, from the last mean
  /// By world and emitter. Kept from mean to mean until it is cleared:
  /// to be done where results are not to depend on what came before.
  std::unordered_map<std::uint64_t, ImageOccluders> blockers_of;
};

struct NumberedPoint {
  Receiver receiver;
  std::uint32_t number;                ///< in its sequence, of which some may be left out
  ElementId element = none<ElementId>; ///< the one it is in, if many other points are
};
/// The next of the points, all in one plane.
using NextPoint = std::function<NumberedPoint()>;

/// The mean over as many points as it takes.
ArrivingLight mean_direct_irradiance(const Lighting& light, const NextPoint& next_point,
                                const SharedLightSettings& settings, std::uint32_t seed,
                                SharedLightWorkspace& workspace);

} // namespace meninas
