// Receivers of direct light, how many samples they take of it, and what arrives (direct_irradiance.h).
#pragma once

#include "mirror/light_choice.h"
#include "mirror/punctual_images.h"
#include "radiosity/light/virtual_light_visibility.h"
#include "radiosity/light/glass_light.h"

namespace meninas {

/// The images that take all samples of a penumbra at a point: images whose first samples disagree (`own`), all
/// images if the first samples of any disagree (`together`), or all images everywhere.
enum class PenumbraSamples : std::uint8_t { own, together, everywhere };

struct DirectSettings {
  int points = 16; ///< receiving points per element to begin with
  int max_points =
      256; ///< doubled up to this while the mean over the element is unsure (near a lamp, at a shadow's edge)
  int shadow_rays =
      16; ///< per emitter image and point where it matters most; images that bring less get fewer
  int penumbra_rays = 128; ///< when the first ones disagree
  PenumbraSamples penumbra_samples = PenumbraSamples::own;
  int rays_in_element = 2; ///< per emitter image and each of an element's points (element_light.h)
  int images =
      256; ///< emitter images computed at a point; of more, a choice (mirror/light_choice.h)
  int images_in_element = 32; ///< likewise, at each of an element's many points
  int solid_rays = 256; ///< to a body of solid glass that fills the hemisphere, at a point (glass_light.h)
  int solid_rays_in_element = 128; ///< likewise, of all of an element's points together
  std::uint32_t seed = 0;
};

/// A point that receives light on one side of a plane.
struct Receiver {
  Point3 position;
  Direction normal;
  PlaneId plane_class = none<PlaneId>;
  Vec3 tangent{0.0}; ///< a direction in the plane that samples are counted from; zero: any
  MaterialId coat = none<MaterialId>; ///< above it, where that is a mirror: it lets in what light gets below
};

inline SegmentEnd end_of(const Receiver& receiver) { return {receiver.normal, receiver.coat}; }
inline SegmentEnd end_of(const Emitter& emitter) { return {emitter.plane.normal, emitter.coat}; }

/// Sums of the weights of an image's samples so far, and of those that arrive.
struct VisibleShare {
  double all = 0.0;
  Rgb seen{0.0};
  int samples = 0, arrived = 0;
  int weighed = 0; ///< of the samples: where all arrive or none does, weights are not needed
};

/// An image that is worth several samples.
struct SampledImage {
  std::uint32_t light = 0; ///< its number
  int penumbra_samples = 0;
  VisibleShare share;
};

/// Storage reused from point to point; one for each thread.
struct DirectWorkspace {
  LightChoiceWorkspace choice;
  std::vector<VirtualLight> lights;
  std::vector<double> form_factors; ///< unoccluded, by light
  std::vector<double> brought;      ///< brightest channel of what each light brings unoccluded
  std::vector<std::uint32_t> order; ///< lights that bring any, those that bring most first
  std::vector<SampledImage> sampled;
  std::vector<std::uint32_t> dim;   ///< of them, those worth one shadow ray
  std::vector<Rgb> visible;         ///< of what is dim, by light
  SeenWorlds seen;                  ///< for punctual lights
  std::vector<PunctualImage> images;
  std::array<FoldedSegment, 16> folded; ///< sixteen segments at a time
  SolidWorkspace solids;
  ArrivedByLamp by_lamp; ///< what was asked for last, by lamp; empty where that is not told apart
  std::uint64_t shadow_rays = 0; ///< those that look for lamps behind solids as well
};

/// Irradiance, and the parts of it whose last leg came by way of mirrors, that punctual lights sent,
/// and that no face sent: these and area lights.
struct ArrivingLight {
  Rgb total{0.0}, mirrored{0.0}, punctual{0.0}, entering{0.0};
  bool in_part = false; ///< of an emitter's image some samples arrived and some did not

  friend ArrivingLight operator+(const ArrivingLight& a, const ArrivingLight& b) {
    return {a.total + b.total, a.mirrored + b.mirrored, a.punctual + b.punctual,
            a.entering + b.entering, a.in_part || b.in_part};
  }
};

} // namespace meninas
