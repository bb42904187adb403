#include "radiosity/hemisphere_survey.h"

#include "radiosity/element_hemicube.h"
#include "radiosity/gather_rays.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>

namespace meninas {

namespace {

/// Sides that are known to see one another, as a forest; which tree a side is in does not depend on the order of unions.
class SideParts {
public:
  explicit SideParts(std::size_t sides) : parent_(sides) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t root(std::uint32_t side) {
    while (parent_[side] != side)
      side = parent_[side] = parent_[parent_[side]];
    return side;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parent_;
};

struct Workspace {
  explicit Workspace(std::size_t sides) : parts(sides) {}
  GatherWorkspace gather;
  SideParts parts;
  std::uint64_t rays = 0;
};

/// Whether some emission is not found in closed form: that of emitters gathered as a whole, or beyond the enumerated worlds.
bool gathers_emission(const LightScene& light) {
  const auto& sides = light.mesh.sides;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (sides[s].emission != Rgb(0.0) && light.from_source[s] == 0)
      return true;
  return !light.emitters.empty() &&
         std::ranges::any_of(light.landing.faces, [](const FaceRecord& f) { return f.mirrors; });
}

void survey_element(const LightScene& light, const DirectionNet& net, std::size_t element,
                    const FormFactorSettings& settings, Workspace& work,
                    HemisphereSurvey& survey) {
  const auto id = static_cast<ElementId>(element);
  gather_rays(light, net, receiver_of(light, id),
              hash(static_cast<std::uint32_t>(element), settings.seed, 0x9a7e), settings,
              work.gather);
  const GatheredRays& rays = work.gather.result;
  survey.closure[element] = closure_of(rays);
  survey.covered[element] = rays.covered;
  survey.exposed[element] = 1.0F - static_cast<float>(std::popcount(rays.covered)) / 64.0F;
  const std::uint32_t own = index(light.mesh.side_of_element[element]);
  Rgb gathered(0.0), returned(0.0);
  for (const RayLanding& landing : rays.landings) {
    const SideId side = light.mesh.side_of_element[landing.element];
    gathered += gathered_emission(light, landing);
    returned += Rgb(landing.light) * light.mesh.sides[index(side)].reflectance;
    work.parts.unite(own, index(side));
  }
  survey.gathered[element] = gathered / kept_light(rays);
  survey.returned[element] = returned / kept_light(rays);
  work.rays += rays.traced;
}

} // namespace

HemisphereSurvey survey_hemispheres(const LightScene& light, const FormFactorSettings& settings,
                                    const Progress& progress) {
  constexpr std::size_t chunk_size = 64;
  const std::size_t size = element_count(light.mesh);
  const DirectionNet few = make_coverage_net();
  const DirectionNet net =
      gathers_emission(light) || static_cast<std::size_t>(settings.rays) < few.points.size()
          ? make_direction_net(settings.rays)
          : few;
  HemisphereSurvey survey;
  survey.closure.resize(size);
  survey.covered.resize(size);
  survey.exposed.resize(size);
  survey.gathered.resize(size);
  survey.returned.resize(size);

  const std::size_t sides = light.mesh.sides.size(), chunks = (size + chunk_size - 1) / chunk_size;
  tbb::enumerable_thread_specific<Workspace> workspaces(sides);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    Workspace& work = workspaces.local();
    for (std::size_t e = c * chunk_size; e < std::min(size, (c + 1) * chunk_size); ++e)
      survey_element(light, net, e, settings, work, survey);
    if (progress)
      progress("hemispheres", static_cast<double>(++done) / static_cast<double>(chunks));
  });

  SideParts parts(sides);
  for (Workspace& work : workspaces) {
    survey.rays_traced += work.rays;
    for (std::uint32_t s = 0; s < sides; ++s)
      parts.unite(s, work.parts.root(s));
  }
  for (std::uint32_t s = 0; s < sides; ++s)
    survey.part.push_back(parts.root(s));
  return survey;
}

bool has_lit_trap(const ElementMesh& mesh, const HemisphereSurvey& survey,
                  const std::vector<Rgb>& source) {
  constexpr double rounding = 1.2e-7; // of the rays' weights, which are floats
  std::vector<Rgb> lost(mesh.sides.size(), Rgb(0.0)), lit = lost;
  for (std::size_t e = 0; e < source.size(); ++e) {
    const std::uint32_t part = survey.part[index(mesh.side_of_element[e])];
    if (survey.exposed[e] == 0.0F)
      continue;
    lost[part] = glm::max(lost[part], 1.0 - survey.returned[e]);
    lit[part] = glm::max(lit[part], source[e]);
  }
  for (std::size_t part = 0; part < lost.size(); ++part)
    for (int band = 0; band < 3; ++band)
      if (lit[part][band] > 0.0 && lost[part][band] <= rounding)
        return true;
  return false;
}

} // namespace meninas
