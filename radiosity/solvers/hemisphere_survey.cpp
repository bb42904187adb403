#include "radiosity/solvers/hemisphere_survey.h"

#include "radiosity/transport/element_hemicube.h"
#include "radiosity/transport/hemisphere_rays.h"
#include "scenes/surfaces/disjoint_sets.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace meninas {

namespace {

struct Workspace {
  explicit Workspace(std::size_t sides) : parts(sides) {}
  GatherWorkspace gather;
  DisjointSets parts; ///< sides that are known to see one another
  std::uint64_t rays = 0;
};

/// Whether some emission is not found in closed form:
/// that of emitters gathered as a whole, beyond the enumerated worlds, or of an uneven sky.
bool gathers_emission(const LightScene& light) {
  if (light.sky != nullptr)
    return true;
  const auto& sides = light.mesh.sides;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides[s].emission != Rgb(0.0) && light.direct_sides[s] == 0)
      return true;
  return !light.emitters.empty() &&
         std::ranges::any_of(light.landing.faces,
                             [](const FaceRecord& f) { return f.mirrors || f.coat; });
}

void gather_own_rays(const LightScene& light, const HemisphereSamples& net, std::size_t element,
                     const FormFactorSettings& settings, GatherWorkspace& work) {
  gather_rays(light, net, receiver_of(light, static_cast<ElementId>(element)),
              hash(static_cast<std::uint32_t>(element), settings.seed, 0x9a7e), settings, work);
}

HemisphereSamples own_rays(const LightScene& light, const FormFactorSettings& settings) {
  HemisphereSamples few = make_coverage_net();
  return gathers_emission(light) || static_cast<std::size_t>(settings.rays) < few.points.size()
             ? make_direction_net(settings.rays)
             : few;
}

void survey_element(const LightScene& light, const HemisphereSamples& net, std::size_t element,
                    const FormFactorSettings& settings, Workspace& work, HemisphereSurvey& survey) {
  gather_own_rays(light, net, element, settings, work.gather);
  const GatheredRays& rays = work.gather.result;
  survey.closure[element] = closure_of(rays);
  survey.covered[element] = rays.covered;
  survey.exposed[element] = light.mesh.solid[element] * rays.exposed;
  const std::uint32_t own = index(light.mesh.side_of_element[element]);
  Rgb gathered(0.0), returned(0.0);
  for (const ElementHit& landing : rays.landings) {
    const SideId side = light.mesh.side_of_element[landing.element];
    gathered += gathered_emission(light, landing);
    returned += Rgb(landing.light) * scattered_share(light.mesh, landing.element);
    work.parts.join(own, index(side));
  }
  survey.gathered[element] = gathered / kept_light(rays);
  survey.returned[element] = returned / kept_light(rays);
  work.rays += rays.traced;
}

constexpr std::size_t chunk_size = 64;

/// For every element, by chunks that a thread takes whole.
template <typename Visit>
void for_each_element(std::size_t size, const Visit& visit, const Progress& progress) {
  const std::size_t chunks = (size + chunk_size - 1) / chunk_size;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    for (std::size_t e = c * chunk_size; e < std::min(size, (c + 1) * chunk_size); ++e)
      visit(e);
    if (progress)
      progress("hemispheres", static_cast<double>(++done) / static_cast<double>(chunks));
  });
}

} // namespace

HemisphereSurvey survey_hemispheres(const LightScene& light, const FormFactorSettings& settings,
                                    const Progress& progress) {
  const std::size_t size = element_count(light.mesh);
  const HemisphereSamples net = own_rays(light, settings);
  HemisphereSurvey survey;
  survey.closure.resize(size);
  survey.covered.resize(size);
  survey.exposed.resize(size);
  survey.gathered.resize(size);
  survey.returned.resize(size);

  const std::size_t sides = light.mesh.sides.size();
  tbb::enumerable_thread_specific<Workspace> workspaces(sides);
  for_each_element(
      size,
      [&](std::size_t e) { survey_element(light, net, e, settings, workspaces.local(), survey); },
      progress);

  DisjointSets parts(sides);
  for (std::uint32_t s = 0; s < sides; ++s)
    if (const SideId behind = side_behind(light.mesh, SideId{s}); behind != none<SideId>)
      parts.join(s, index(behind));
  for (Workspace& work : workspaces) {
    survey.rays_traced += work.rays;
    for (std::uint32_t s = 0; s < sides; ++s)
      parts.join(s, work.parts.root(s));
  }
  for (std::uint32_t s = 0; s < sides; ++s)
    survey.part.push_back(parts.root(s));
  return survey;
}

Returned returned_share(const LightScene& light, const FormFactorSettings& settings,
                        const std::vector<Rgb>& worth, const std::vector<Rgb>& passed) {
  struct Counted {
    GatherWorkspace gather;
    std::uint64_t rays = 0;
  };
  Returned result{std::vector<Rgb>(worth.size()), 0};
  const HemisphereSamples net = own_rays(light, settings);
  tbb::enumerable_thread_specific<Counted> workspaces;
  for_each_element(worth.size(),
                   [&](std::size_t e) {
                     Counted& work = workspaces.local();
                     gather_own_rays(light, net, e, settings, work.gather);
                     const GatheredRays& rays = work.gather.result;
                     Rgb returned(0.0);
                     for (const ElementHit& landing : rays.landings) {
                       returned += Rgb(landing.light) * light.mesh.reflectance[landing.element] *
                                       worth[landing.element] +
                                   Rgb(landing.light) * passed[landing.element];
                     }
                     result.share[e] = returned / kept_light(rays);
                     work.rays += rays.traced;
                   },
                   {});
  for (const Counted& work : workspaces)
    result.rays_traced += work.rays;
  return result;
}

} // namespace meninas
