#include "radiosity/adaptive_field.h"

#include "radiosity/field_refinement.h"
#include "radiosity/mesh_division.h"
#include "radiosity/vertex_light.h"
#include "radiosity/vertex_places.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

double largest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }

/// w = rho / (B + B_mean) of every root cell: what an error of irradiance there is to the eye.
std::vector<double> weights(const ElementMesh& mesh, const std::vector<Rgb>& irradiance) {
  const std::size_t roots =
      mesh.sides.empty() ? 0 : mesh.sides.back().first_cell + mesh.sides.back().root_count;
  std::vector<double> weight(roots, 0.0);
  const auto reflected = [&](std::uint32_t root) {
    const MeshCell& cell = mesh.cells[root];
    Rgb sum(0.0);
    for (std::uint32_t e = cell.first_element; e < cell.first_element + cell.element_count; ++e)
      sum += mesh.area[e] * irradiance[e];
    return largest(mesh.sides[index(cell.side)].reflectance * sum) / cell.area;
  };
  double sum = 0.0, area = 0.0;
  for (std::uint32_t root = 0; root < roots; ++root) {
    sum += mesh.cells[root].area * reflected(root);
    area += mesh.cells[root].area;
  }
  if (!(sum > 0.0))
    return weight;
  for (std::uint32_t root = 0; root < roots; ++root)
    weight[root] = largest(mesh.sides[index(mesh.cells[root].side)].reflectance) /
                   (reflected(root) + sum / area);
  return weight;
}

/// The values of a field at the vertices of a mesh that has all of its cells.
std::vector<glm::vec3> carried(const ElementMesh& mesh, const std::vector<glm::vec3>& values,
                               const ElementMesh& finer, const SurfaceModel& surfaces) {
  std::vector<glm::vec3> result;
  result.reserve(finer.vertices.size());
  for (std::size_t v = 0; v < finer.vertices.size(); ++v) {
    const SideId side = finer.side_of_element[index(finer.element_of_vertex[v])];
    const Patch& patch = surfaces.patches[index(finer.sides[index(side)].patch)];
    result.push_back(value_in(mesh, values, locate(mesh, side, uv_at(patch, finer.vertices[v]))));
  }
  return result;
}

RefinementSettings refinement_of(const AdaptiveSettings& adaptive, double share) {
  RefinementSettings refinement;
  refinement.error = share * adaptive.error;
  refinement.max_elements = adaptive.max_elements;
  return refinement;
}

/// Light from the source.
SampledField direct_field(const LightScene& light, std::span<const double> weight,
                          const DirectSettings& direct, const RefinementSettings& refinement,
                          std::uint64_t& shadow_rays) {
  constexpr double outline_step = 0.125; // of a root cell
  tbb::enumerable_thread_specific<DirectWorkspace> workspaces;
  const SamplePoint sample = [&](const Receiver& receiver, double element_size,
                                 std::uint32_t seed) -> PointSample {
    return {
        direct_irradiance(light, receiver, direct, hash(seed, direct.seed, 1), workspaces.local()),
        is_under_something(light, receiver, element_size)};
  };
  const auto outlines = mirror_outlines(light, outline_step * light.mesh.element_size);
  SampledField field = refine_field(light, {sample, sample}, weight, outlines, refinement);
  for (const auto& work : workspaces)
    shadow_rays += work.shadow_rays;
  return field;
}

/// Light from the elements. Between vertices it is the mean of two halves, whose difference tells its variance.
SampledField gathered_field(const LightScene& light, const ElementLight& elements,
                            const FormFactorSettings& form_factors, const DirectSettings& direct,
                            std::span<const double> weight, const InterpolationSettings& settings,
                            RefinementSettings refinement, InterpolatedField& result) {
  refinement.root_points = refinement.points = 0; // smooth: its centre tells what an element hides
  const auto gathering_with = [&](int rays) {
    return PointGathering(light, elements.reflected, form_factors, direct,
                          {.rays = rays, .cluster_shadow_rays = settings.cluster_shadow_rays});
  };
  const PointGathering whole = gathering_with(settings.rays),
                       half = gathering_with(std::max(1, settings.rays / 2));
  tbb::enumerable_thread_specific<PointWorkspace> workspaces;
  const auto gathered = [&](const PointGathering& gathering, const Receiver& receiver,
                            double element_size, std::uint32_t seed) {
    return value_at(gathering, elements.irradiance, receiver, element_size,
                    hash(seed, form_factors.seed, 0x7e27), workspaces.local());
  };
  const SamplePoint at_vertices = [&](const Receiver& receiver, double size,
                                      std::uint32_t seed) -> PointSample {
    const VertexValue value = gathered(whole, receiver, size, seed);
    return {value.indirect, value.covered};
  };
  const SamplePoint between = [&](const Receiver& receiver, double size,
                                  std::uint32_t seed) -> PointSample {
    const VertexValue a = gathered(half, receiver, size, seed),
                      b = gathered(half, receiver, size, ~seed);
    const ArrivingLight sum = a.indirect + b.indirect;
    const Rgb apart = 0.5 * glm::abs(a.indirect.total - b.indirect.total);
    return {{0.5 * sum.total, 0.5 * sum.mirrored},
            a.covered && b.covered,
            largest(apart) * largest(apart)};
  };
  SampledField field = refine_field(light, {at_vertices, between}, weight, {}, refinement);
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
  return field;
}

std::vector<glm::vec3> sum_of(std::vector<glm::vec3> a, const std::vector<glm::vec3>& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>{});
  return a;
}

} // namespace

InterpolatedField adaptive_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings) {
  constexpr double direct_share = 0.8, gathered_share = 0.6;
  const std::vector<double> weight = weights(light.mesh, elements.irradiance);
  InterpolatedField result;
  const SampledField from_source = direct_field(
      light, weight, direct, refinement_of(*settings.adaptive, direct_share), result.shadow_rays);
  const SampledField gathered =
      gathered_field(light, elements, form_factors, direct, weight, settings,
                     refinement_of(*settings.adaptive, gathered_share), result);

  result.mesh = overlaid(from_source.mesh, gathered.mesh, light.surfaces);
  const auto on_mesh = [&](const SampledField& field, const std::vector<glm::vec3>& values) {
    return carried(field.mesh, values, *result.mesh, light.surfaces);
  };
  DiffuseField& field = result.field;
  field.indirect = on_mesh(gathered, gathered.total);
  field.indirect_mirrored = on_mesh(gathered, gathered.mirrored);
  field.irradiance = sum_of(on_mesh(from_source, from_source.total), field.indirect);
  field.mirrored = sum_of(on_mesh(from_source, from_source.mirrored), field.indirect_mirrored);
  result.error = std::hypot(from_source.error, gathered.error);
  return result;
}

} // namespace meninas
