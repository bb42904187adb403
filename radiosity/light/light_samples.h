// Points of emitters and of their images in the mirror worlds,
// as a surface that reflects by a lobe sees them:
//
//   L(o) = sum_w tau_w sum_e integral over T_w e of f(o, i) cos_x cos_y / r^2 L_e V dA
//
// with V by shadow rays on every leg, and punctual lights and their images one by one.
// direct_irradiance.h has the same for f = 1 / pi, in closed form.
#pragma once

#include "radiosity/light/direct_samples.h"
#include "radiosity/scene/lighting.h"

namespace meninas {

/// Light of a punctual light, or of an image of it, as it arrives.
struct PunctualArrival {
  Direction towards; ///< the light
  Rgb irradiance{0.0};
  WorldId world = real_world; ///< by which it comes
  std::uint32_t light = 0;    ///< its number among the punctual lights
};

/// The light of punctual lights and their images. Clears and fills `arrivals`.
void punctual_arrivals(const Lighting& light, const Receiver& receiver,
                       DirectWorkspace& workspace, std::vector<PunctualArrival>& arrivals);

/// A point of an emitter or of an image of it.
/// A surface with the BSDF f reflects f cos_receiver cosine / r^2 area radiance of it.
struct EmissionSample {
  Vec3 towards{0.0};         ///< from the receiver to the point, in unfolded space
  double cosine = 0.0;       ///< at the emitter
  double area = 0.0;         ///< that it stands for, m^2
  double emitter_area = 0.0; ///< of the whole emitter
  Rgb radiance{
      0.0}; ///< as it arrives: mirrors' reflectances are in it, and 0 where something blocks it
  WorldId world = real_world; ///< of the image
};

/// Points `first` to `first + per_image` (at most 16) of the low-discrepancy sequence
/// of `seed` on every image of every emitter of direct light,
/// of which about `images` are chosen where there are more.
struct EmissionSampling {
  int per_image = 4;
  int images = 32;
  std::uint32_t first = 0, seed = 0;
};

/// Clears and fills `samples`.
void emission_samples(const Lighting& light, const Receiver& receiver,
                      const EmissionSampling& sampling, DirectWorkspace& workspace,
                      std::vector<EmissionSample>& samples);

} // namespace meninas
