// The plan: the contents of a scene, and so the transport that has to be modelled. Stages that a scene does not
// need are not run.
//
// Worlds w of Eq. 1 (radiosity/pass_one.h) are in the plan while tau_w = product of their mirrors' reflectances >=
// min_throughput (mirror/worlds.h). Areas in m^2; reflectances and the bound of the rest are dimensionless.
#pragma once

#include "mirror/worlds.h"
#include "scenes/surfaces/surfaces.h"

#include <string>
#include <vector>

namespace meninas {

struct PlannedMirror {
  std::string name; ///< the node, or nodes joined by '+'
  double area = 0.0;
  Rgb reflectance{0.0};
};

struct TransportPlan {
  MirrorSet mirrors;
  WorldTree worlds;
  std::vector<PlannedMirror> mirror_list;
  double mirror_depth_bound = 0.0; ///< bound on the mean share of light from beyond the worlds (mirror_depth_bound.h)
  std::size_t emitters = 0; ///< emitting patch sides
  std::size_t punctual_lights = 0;
  std::size_t area_lights = 0; ///< that are no faces
  std::size_t glossy = 0;       ///< materials that are metals too rough for a mirror
  std::size_t transmissive = 0; ///< materials
  std::size_t textured = 0;     ///< materials
  std::size_t colored_triangles = 0; ///< by COLOR_0
  int bands = 1;                ///< 1 when everything is grey
  bool closed = false;          ///< faces without a gap enclose everything, so no light can escape
  std::vector<std::string> stages;
  std::vector<std::string> ignored;
  std::vector<std::string> warnings; ///< the scene's own and the plan's
};

struct PlanSettings {
  MirrorSettings mirrors;
  WorldSettings worlds;
};

TransportPlan plan_transport(const Scene& scene, const SurfaceModel& surfaces,
                             const PlanSettings& settings = {});

} // namespace meninas
