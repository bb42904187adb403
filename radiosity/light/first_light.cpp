#include "radiosity/light/first_light.h"

#include <numbers>

namespace meninas {

namespace {

void add(std::vector<Rgb>& sum, const std::vector<Rgb>& part) {
  sum.resize(std::max(sum.size(), part.size()), Rgb(0.0));
  for (std::size_t i = 0; i < part.size(); ++i)
    sum[i] += part[i];
}

/// The irradiance from the sky, by the rays of the elements. Empty without a sky. Light of rays that were cut is
/// taken to be distributed like the rest.
struct SkyIrradiance {
  std::vector<Rgb> gathered, by_portals;
};
SkyIrradiance sky_irradiance(const LightScene& light, const std::vector<RowClosure>& closure) {
  SkyIrradiance found;
  if (light.background == Rgb(0.0) && light.sky == nullptr)
    return found;
  const auto irradiance = [&](const RowClosure& row, const glm::vec3& even, const glm::vec3& sky) {
    return (light.background * Rgb(even) + std::numbers::pi * Rgb(sky)) /
           glm::max(Rgb(1e-9), 1.0 - Rgb(row.cut_light));
  };
  for (const RowClosure& row : closure)
    found.gathered.push_back(irradiance(row, row.escaped_light - row.owned_light, row.sky));
  if (!light.portals.empty())
    for (const RowClosure& row : closure)
      found.by_portals.push_back(irradiance(row, row.owned_light, row.by_portals));
  return found;
}

/// D alone; what of it is gathered by the form-factor method is left out.
DirectIrradiance found_light(const LightScene& light, std::span<const std::uint64_t> covered,
                             FormFactorMethod method, const DirectSettings& settings,
                             const Progress& progress) {
  if (method != FormFactorMethod::analytic)
    return direct_irradiance(light, covered, settings, progress);
  // Faces and the sky are in the transport, what is no face is not.
  std::vector<Emitter> area_lights;
  LampShares lamps = light.lamps;
  lamps.of_emitter.clear();
  for (std::size_t k = 0; k < light.emitters.size(); ++k) {
    if (light.emitters[k].area_light == no_area_light)
      continue;
    area_lights.push_back(light.emitters[k]);
    if (lamps)
      lamps.of_emitter.push_back(light.lamps.of_emitter[k]);
  }
  if (light.punctual.empty() && area_lights.empty())
    return {};
  const LightTree tree = make_emitter_tree(area_lights);
  Lighting faceless{light, light.worlds, area_lights, tree, light.punctual};
  faceless.lamps = lamps ? &lamps : nullptr;
  return direct_irradiance(faceless, covered, settings, progress);
}

/// D + G by lamp; the sky is a lamp.
LightByLamp first_by_lamp(const LightScene& light, LightByLamp gathered,
                          const std::vector<Rgb>& sky, const DirectIrradiance& direct) {
  if (!light.lamps)
    return {};
  if (direct.by_lamp.rows > 0)
    gathered += direct.by_lamp;
  if (!sky.empty()) {
    std::vector<Rgb> all = light_of_lamp(gathered, light.lamps.sky);
    for (std::size_t e = 0; e < all.size(); ++e)
      all[e] += sky[e];
    set_light_of_lamp(gathered, light.lamps.sky, all);
  }
  return gathered;
}

} // namespace

FirstLight first_light(const LightScene& light, FoundByRays rays, const DirectIrradiance& direct,
                       FormFactorMethod method) {
  FirstLight first;
  SkyIrradiance sky = sky_irradiance(light, rays.closure);
  first.by_lamp =
      first_by_lamp(light, std::move(rays.gathered_by_lamp), sky.gathered, direct);
  first.direct_by_lamp = direct.by_lamp;
  first.entering = std::move(sky.gathered);
  first.irradiance = std::move(rays.gathered);
  add(first.irradiance, first.entering);
  if (method != FormFactorMethod::analytic)
    first.direct = direct.irradiance;
  first.shadow_rays = direct.shadow_rays;
  add(first.irradiance, direct.irradiance);
  add(first.entering, direct.entering);
  add(first.entering, sky.by_portals);

  first.reflectance = light.mesh.reflectance;
  first.translucent = translucent_links(light.mesh, rays.exposed);
  first.source = scattered(first.reflectance, first.translucent, first.irradiance);
  return first;
}

FirstLight first_light(const LightScene& light, FoundByRays rays, FormFactorMethod method,
                       const DirectSettings& settings, const Progress& progress) {
  const DirectIrradiance direct = found_light(light, rays.covered, method, settings, progress);
  return first_light(light, std::move(rays), direct, method);
}

} // namespace meninas
