#include "radiosity/light/first_light.h"

namespace meninas {

namespace {

void add(std::vector<Rgb>& sum, const std::vector<Rgb>& part) {
  sum.resize(std::max(sum.size(), part.size()), Rgb(0.0));
  for (std::size_t i = 0; i < part.size(); ++i)
    sum[i] += part[i];
}

/// Empty without a background. What was cut of an element's rays is taken to fare like the rest.
std::vector<Rgb> sky_irradiance(const LightScene& light, const std::vector<RowClosure>& closure) {
  std::vector<Rgb> irradiance;
  if (light.background == Rgb(0.0))
    return irradiance;
  for (const RowClosure& row : closure)
    irradiance.push_back(light.background * Rgb(row.escaped_light) /
                         glm::max(Rgb(1e-9), 1.0 - Rgb(row.cut_light)));
  return irradiance;
}

/// D alone; what of it is gathered by the form-factor method is left out.
DirectIrradiance found_light(const LightScene& light, std::span<const std::uint64_t> covered,
                             FormFactorMethod method, const DirectSettings& settings,
                             const Progress& progress) {
  if (method != FormFactorMethod::analytic)
    return direct_irradiance(light, covered, settings, progress);
  if (light.punctual.empty())
    return {};
  const LightTree no_emitters;
  return direct_irradiance({light, light.worlds, {}, no_emitters, light.punctual}, covered, settings,
                           progress);
}

} // namespace

FirstLight first_light(const LightScene& light, FoundByRays rays, const DirectIrradiance& direct,
                       FormFactorMethod method) {
  FirstLight first;
  first.entering = sky_irradiance(light, rays.closure);
  first.irradiance = std::move(rays.gathered);
  add(first.irradiance, first.entering);
  if (method != FormFactorMethod::analytic)
    first.from_source = direct.irradiance;
  first.shadow_rays = direct.shadow_rays;
  add(first.irradiance, direct.irradiance);
  add(first.entering, direct.punctual);

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
