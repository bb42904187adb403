// Rays that receivers have gathered by, and those that are on their way (hemisphere_rays.h).
#pragma once

#include "radiosity/transport/contact_mask.h"
#include "radiosity/transport/form_factor_rows.h"
#include "radiosity/transport/glass_rays.h"

#include <utility>
#include <vector>

namespace meninas {

struct ElementHit {
  std::uint32_t element;
  WorldId world;   ///< none beyond the enumerated worlds; by way of solids one of glass_rays.h
  glm::vec3 light; ///< weight times tau, the product of the mirrors' reflectances
};

/// All rays of one receiver; storage reused from one to the next.
/// A ray with its weight w ends in one place:
///   landed + escaped + black + cut = rays, exactly where all weigh 1, to rounding otherwise.
struct GatheredRays {
  std::vector<ElementHit> landings;
  double rays = 0.0; ///< how many there are
  double landed = 0.0, escaped = 0.0, black = 0.0,
         cut = 0.0;                ///< sums of w over those that ended so
  glm::vec3 mirror_absorbed{0.0F}; ///< sum of w (1 - tau) over all rays
  glm::vec3 escaped_light{0.0F}, black_light{0.0F},
      cut_light{0.0F};              ///< sums of w tau over the rays that ended so
  glm::vec3 escaped_straight{0.0F}; ///< of `escaped_light`, by rays that met no mirror
  glm::vec3 sky{0.0F}, sky_straight{0.0F}; ///< sums of w tau L(d) of escaped rays, as these two, of a sky that is not even
  glm::vec3 owned_light{0.0F}, owned_straight{0.0F}; ///< of `escaped_light` and `escaped_straight`, what portals bring
  glm::vec3 by_portals{0.0F}; ///< the same of rays that left by portals, which are not among these: W/m^2/sr
  std::uint64_t traced = 0;
  ContactMask covered = 0;
  double covered_rays = 0.0; ///< of `black`, those from where something stands
  float exposed = 1.0F;      ///< the share of the receiver's area on which nothing does

  void clear() {
    auto storage = std::move(landings);
    storage.clear();
    *this = {};
    landings = std::move(storage);
  }
};

/// The number of rays whose light was followed to its end:
/// light that was cut is left out, light absorbed by mirrors on the way is not.
inline Rgb kept_light(const GatheredRays& gathered) {
  return glm::max(Rgb(1.0), gathered.rays - gathered.covered_rays - Rgb(gathered.cut_light));
}

/// A continuing ray between mirrors and glass; kept by the caller so that its storage is reused.
struct MirroredRay {
  glm::dvec3 origin, direction; ///< in the frame of the ray scene
  float weight;
  glm::vec3 throughput;
  WorldId world;
  MaterialId medium = none<MaterialId>; ///< the solid that it was refracted into
  double straight; ///< from where it set out or was last reflected to the origin, in directions
  std::uint32_t leaving;
  std::uint32_t number;   ///< among the rays of its receiver
  std::uint32_t meetings; ///< with mirrors and glass, so far
  int reflections;        ///< of them
};

struct GatherWorkspace {
  GatheredRays result;
  std::uint32_t seed = 0; ///< of what glass does with its rays
  bool counts_rays = false;
  std::vector<std::uint32_t> numbers; ///< by landing, that of the ray, where they are asked for
  bool keeps_places = false;
  std::vector<glm::vec2> places; ///< by landing, (s, t) in the element, where they are asked for
  std::vector<std::uint32_t>
      black_lanes; ///< by packet of the net: the rays that met a black back at once
  std::vector<MirroredRay> current, next;
};

/// The ends of rays: sums of their weights and of their light.
struct Ends {
  double landed = 0.0, escaped = 0.0, black = 0.0, cut = 0.0;
  std::uint32_t black_lanes = 0;
  glm::vec3 mirror_absorbed{0.0F}, escaped_light{0.0F}, black_light{0.0F}, cut_light{0.0F}, sky{0.0F}, by_portals{0.0F};
  glm::vec3 owned_light{0.0F}; ///< of `escaped_light`, what portals bring

  void escape(float weight, const glm::vec3& throughput) {
    escaped += weight;
    escaped_light += weight * throughput;
    mirror_absorbed += weight * (1.0F - throughput);
  }
  /// On a black back, or on an element.
  void end(bool on_black, std::uint32_t lane, float weight, const glm::vec3& throughput) {
    if (on_black) {
      black += weight;
      black_lanes |= 1U << lane;
      black_light += weight * throughput;
    } else {
      landed += weight;
    }
    mirror_absorbed += weight * (1.0F - throughput);
  }
  void stop(float weight, const glm::vec3& throughput) {
    cut += weight;
    cut_light += weight * throughput;
    mirror_absorbed += weight * (1.0F - throughput);
  }
};

inline void add(const Ends& ends, GatheredRays& result) {
  result.landed += ends.landed;
  result.escaped += ends.escaped;
  result.black += ends.black;
  result.cut += ends.cut;
  result.mirror_absorbed += ends.mirror_absorbed;
  result.escaped_light += ends.escaped_light;
  result.sky += ends.sky;
  result.by_portals += ends.by_portals;
  result.owned_light += ends.owned_light;
  result.black_light += ends.black_light;
  result.cut_light += ends.cut_light;
}

} // namespace meninas
