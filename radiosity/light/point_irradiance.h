// The light that arrives at one point:
// from emitters by closed form, from everything else by rays over its hemisphere.
//
//   H(x) = D(x) + 1/N sum over rays of  tau B(landing)  + secondary emitters
//
// D is the direct light (direct_irradiance.h). Rays land on elements of known radiosity;
// elements so bright that rays would find them by chance are sampled as lamps as well
// (secondary_emitters.h), those far away together (cluster_cut.h). Each path is in one of the three.
#pragma once

#include "radiosity/light/secondary_emitters.h"
#include "radiosity/light/cluster_cut.h"
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/transport/hemisphere_rays.h"

namespace meninas {

struct PointGatheringSettings {
  int rays = 512;              ///< over the hemisphere
  int rays_before = 0; ///< of these, that points may have traced before (row_cache.h)
  int cluster_shadow_rays = 8; ///< per secondary emitter, where it matters most; eight times as many for all that are far away together, or an eighth of `rays`
  double clusters_spared = 0.0; ///< ClusterSettings::spared
  double cluster_theta = ClusterCut{}.theta; ///< which are (cluster_cut.h); 0: none
};

/// B by ElementId, emission left out, W/m^2; by lamp too where light is told apart.
struct SentLight {
  SentLight(std::vector<Rgb> sent, const LightByLamp& of_lamps = {})
      : all(std::move(sent)), by_lamp{of_lamps.rows, of_lamps.columns, {of_lamps.values.begin(), of_lamps.values.end()}} {}
  std::vector<Rgb> all;
  SharesByLamp by_lamp;
};

/// The light that points gather from, the same for all points.
struct PointGathering {
  /// `reflected` is B by ElementId, emission left out. Samples follow the methods of pass one.
  PointGathering(const LightScene& light, SentLight sent,
                 const FormFactorSettings& form_factors, const DirectSettings& direct,
                 const PointGatheringSettings& settings);
  PointGathering(const PointGathering&) = delete;
  PointGathering& operator=(const PointGathering&) = delete;

  const LightScene& light;
  std::vector<Rgb> reflected;
  SharesByLamp reflected_by_lamp; ///< empty where light is not told apart
  FormFactorSettings form_factors;
  DirectSettings direct, secondary;
  ClusterCut cut;
  SecondaryEmitters clusters;
  ClusterTree cluster_tree; ///< over their emitters
  LightTree cluster_emitters; ///< over the same, for sampling
  LampShares lamps; ///< of the clusters
  Lighting secondary_lighting; ///< the scene lit by the secondary emitters
  HemisphereSamples net;
  HemisphereSamples others; ///< of the net, without those before; empty where there are none
  Hemicube cube; ///< where the form factors are found so
};

/// Storage reused from point to point; one for each thread.
struct PointWorkspace {
  GatherWorkspace gather;
  DirectWorkspace direct;
  ClusterWorkspace clusters;
  ArrivedByLamp direct_by_lamp, indirect_by_lamp; ///< of the point last asked for; empty: not asked for, or not told apart
  std::uint64_t rays = 0;
};

struct PointLight {
  ArrivingLight from_rays, direct, from_clusters;
  ArrivingLight emission;  ///< of what rays bring, that of emitters
  ArrivingLight sky;       ///< and that from where nothing is met
  std::uint32_t hits = 0;  ///< rays that met it

  ArrivingLight all() const { return from_rays + direct + from_clusters; }
  ArrivingLight indirect() const { return from_rays + from_clusters; }
};

/// The point as an area, for its rays.
ReceiverArea area_of(const Receiver& point);

PointLight light_at(const PointGathering& gathering, const Receiver& receiver, std::uint32_t seed,
                    PointWorkspace& work);

/// The change of the irradiance at the receiver, W/m^2, if elements reflected at every point the light gathered
/// there, in place of `reflected`: estimated at that many of the places where its rays land.
/// Light of clusters and of landed rays is treated alike. Rays are those of the net.
ArrivingLight one_more_bounce(const PointGathering& gathering, const Receiver& receiver, int places,
                              std::uint32_t seed, PointWorkspace& work);

/// light_at() without direct light. `before`: what the rays before have met at this point
/// with this seed, or all of the net; the others are traced. Not where cubes gather.
PointLight indirect_light_at(const PointGathering& gathering, const Receiver& receiver,
                             std::uint32_t seed, PointWorkspace& work,
                             const GatheredRays* before = nullptr);

} // namespace meninas
