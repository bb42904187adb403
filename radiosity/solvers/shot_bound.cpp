#include "radiosity/solvers/shot_bound.h"

#include <limits>

namespace meninas {

namespace {

/// Parts of the scene, by SideId of their first side.
struct Parts {
  std::vector<Rgb> lit;  ///< the largest source
  std::vector<Rgb> lost; ///< the largest share of an element's light that does not return
};

Parts parts_of(const ElementMesh& mesh, const HemisphereSurvey& survey,
               const std::vector<Rgb>& source) {
  Parts parts;
  parts.lit = parts.lost = std::vector<Rgb>(mesh.sides.size(), Rgb(0.0));
  for (std::size_t e = 0; e < source.size(); ++e) {
    if (survey.exposed[e] == 0.0F)
      continue;
    const std::uint32_t part = survey.part[index(mesh.side_of_element[e])];
    parts.lit[part] = glm::max(parts.lit[part], source[e]);
    parts.lost[part] = glm::max(parts.lost[part], 1.0 - survey.returned[e]);
  }
  return parts;
}

/// Whether light in a part never ends, by channel.
bool is_lit_trap(const Parts& parts, std::uint32_t part, int band) {
  constexpr double rounding = 1.2e-7; // of the rays' weights, which are floats
  return parts.lit[part][band] > 0.0 && parts.lost[part][band] <= rounding;
}

void find_traps(const ElementMesh& mesh, const HemisphereSurvey& survey, const Parts& parts,
                const std::vector<Rgb>& source, ShotBound& bound) {
  bool outside = false;
  std::vector<Rgb> open(source.size(), Rgb(1.0));
  for (std::uint32_t e = 0; e < source.size(); ++e) {
    if (survey.exposed[e] == 0.0F)
      continue;
    const std::uint32_t part = survey.part[index(mesh.side_of_element[e])];
    for (int band = 0; band < 3; ++band)
      open[e][band] = is_lit_trap(parts, part, band) ? 0.0 : 1.0;
    if (largest(source[e] * (1.0 - open[e])) > 0.0)
      bound.trapped.push_back(e);
    outside = outside || largest(source[e] * open[e]) > 0.0;
  }
  bound.unsolvable = !bound.trapped.empty() && !outside;
  if (!bound.trapped.empty())
    bound.open = std::move(open);
}

/// By ElementId and channel: 1 for what may ever shoot.
std::vector<Rgb> shooting(const ElementMesh& mesh, const HemisphereSurvey& survey,
                          const Parts& parts, const std::vector<Rgb>& reflectance) {
  std::vector<Rgb> may(reflectance.size(), Rgb(0.0));
  for (std::size_t e = 0; e < may.size(); ++e) {
    const std::uint32_t part = survey.part[index(mesh.side_of_element[e])];
    for (int band = 0; band < 3; ++band)
      if (survey.exposed[e] > 0.0F && parts.lit[part][band] > 0.0 && reflectance[e][band] > 0.0 &&
          !is_lit_trap(parts, part, band))
        may[e][band] = 1.0;
  }
  return may;
}

Rgb largest_of(const std::vector<Rgb>& values, const std::vector<Rgb>& counted) {
  Rgb largest(0.0);
  for (std::size_t e = 0; e < values.size(); ++e)
    largest = glm::max(largest, values[e] * counted[e]);
  return largest;
}

/// size / (1 - q)
Rgb bound(const Rgb& size, const Rgb& q) {
  Rgb bound(std::numeric_limits<double>::infinity());
  for (int band = 0; band < 3; ++band)
    if (q[band] < 1.0)
      bound[band] = size[band] / (1.0 - q[band]);
  return bound;
}

std::vector<double> receiving_areas(const ElementMesh& mesh, const HemisphereSurvey& survey) {
  std::vector<double> areas = mesh.area;
  for (std::size_t e = 0; e < areas.size(); ++e)
    areas[e] *= double{survey.exposed[e]};
  return areas;
}

} // namespace

ShotBound bound_of_shots(const LightScene& light, const HemisphereSurvey& survey,
                         const FormFactorSettings& rays, const std::vector<Rgb>& source,
                         const Scattering& scattering) {
  constexpr double bright = 0.9; // of kappa: below it the bound costs few shots
  constexpr double better = 0.8;
  constexpr int max_bounces = 8;
  const Parts parts = parts_of(light.mesh, survey, source);
  const std::vector<Rgb> may = shooting(
      light.mesh, survey, parts, total_shares(scattering.reflectance, scattering.translucent));
  ShotBound result;
  find_traps(light.mesh, survey, parts, source, result);
  result.kept = largest_of(survey.returned, may);
  result.amplification = bound(Rgb(1.0), result.kept);
  if (result.unsolvable || glm::all(glm::lessThanEqual(result.kept, Rgb(bright))))
    return result;

  std::vector<Rgb> q = survey.returned, sum(q.size(), Rgb(1.0));
  for (int m = 2; m <= max_bounces; ++m) {
    for (std::size_t e = 0; e < q.size(); ++e)
      sum[e] += q[e];
    Returned returned = returned_share(
        light, rays, q, passed_on(scattering.translucent, receiving_areas(light.mesh, survey), q));
    q = std::move(returned.share);
    result.rays_traced += returned.rays_traced;
    const Rgb before = result.amplification;
    result.amplification = glm::min(before, bound(largest_of(sum, may), largest_of(q, may)));
    if (!glm::any(glm::lessThan(result.amplification, better * before)))
      break;
  }
  return result;
}

} // namespace meninas
