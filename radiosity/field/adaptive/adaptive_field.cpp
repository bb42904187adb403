#include "radiosity/field/adaptive/adaptive_field.h"

#include "radiosity/light/gather_noise.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/adaptive/source_field.h"
#include "radiosity/field/vertex_light.h"
#include "radiosity/field/vertex_places.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

namespace meninas {

namespace {

/// w = rho / (B + B_mean) of every root cell, by CellId:
/// what an error of irradiance there is to the eye.
/// B_mean is a mean over the area that counts. `irradiance` by ElementId.
std::vector<double> error_weights(const ElementMesh& mesh, const std::vector<Rgb>& irradiance) {
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
    const double counted = counted_area(mesh, mesh.cells[root]);
    sum += counted * reflected(root);
    area += counted;
  }
  if (!(sum > 0.0))
    return weight;
  for (std::uint32_t root = 0; root < roots; ++root)
    weight[root] = largest(mesh.sides[index(mesh.cells[root].side)].reflectance) /
                   (reflected(root) + sum / area);
  return weight;
}

/// For that share of the error that is wanted.
RefinementSettings refinement_of(const AdaptiveSettings& adaptive, double share) {
  RefinementSettings refinement;
  refinement.error = share * adaptive.error;
  refinement.max_elements = adaptive.max_elements;
  return refinement;
}

/// The values of a field at the vertices of a mesh that has all of its cells.
std::vector<glm::vec3> carried(const ElementMesh& mesh, const std::vector<glm::vec3>& values,
                               const ElementMesh& finer, const SurfaceModel& surfaces) {
  std::vector<glm::vec3> result;
  result.reserve(finer.vertices.size());
  for (std::uint32_t v = 0; v < finer.vertices.size(); ++v)
    result.push_back(value_in(mesh, values, place_in(mesh, surfaces, finer, ElementVertexId{v})));
  return result;
}

std::vector<glm::vec3> sum_of(std::vector<glm::vec3> a, const std::vector<glm::vec3>& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>{});
  return a;
}

/// What light is gathered from:
/// a mesh with the irradiance and the reflected radiosity of its elements.
struct Surroundings {
  std::shared_ptr<const LightScene> scene;
  std::vector<Rgb> irradiance, reflected;
};

/// D and I on a mesh that has the cells of both, and all roots divided so often.
Surroundings surroundings(const LightScene& light, const SampledField& direct,
                          const SampledField& indirect, int levels) {
  ElementMesh even = light.mesh;
  for (int level = 0; level < levels; ++level)
    even = divide_elements(even, light.surfaces, std::vector<std::uint8_t>(element_count(even), 1));
  Surroundings around;
  even = overlaid(even, indirect.mesh, light.surfaces);
  around.scene = light_scene_on(light, overlaid(even, direct.mesh, light.surfaces));
  const ElementMesh& mesh = around.scene->mesh;
  around.irradiance =
      corner_means(mesh, sum_of(carried(direct.mesh, direct.total, mesh, light.surfaces),
                                carried(indirect.mesh, indirect.total, mesh, light.surfaces)));
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    around.reflected.push_back(mesh.reflectance[e] * around.irradiance[e]);
  return around;
}

/// How light is gathered.
struct Gathering {
  const FormFactorSettings& form_factors;
  const DirectSettings& direct;
  const InterpolationSettings& interpolation;
};

/// Samples of light gathered from `elements` of the mesh of `lit`, with so many rays.
/// The result refers to `gathering` and `workspaces`.
SamplePoint gathered_samples(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                             tbb::enumerable_thread_specific<PointWorkspace>& workspaces) {
  return [&](const Receiver& receiver, double element_size, std::uint32_t seed) -> PointSample {
    const VertexValue value =
        indirect_value_at(gathering, irradiance,
                          {receiver, element_size, hash(seed, gathering.form_factors.seed, 0x7e27)},
                          workspaces.local());
    return {value.indirect, value.cover};
  };
}

/// The rays of a sample: those that are asked for, or as many as their noise needs.
struct SampleRays {
  int asked = 0;
  double needed = 0.0; ///< in elements of a size
  double size = 0.0;
};

/// How many rays keep the noise of a vertex within a bound. `first` was sampled with `rays`
/// a vertex, and between vertices twice with a quarter of them, of whose mean it knows the noise.
double rays_within(double bound, const SampledField& first, int rays) {
  return 2.0 * std::max(1, rays / 4) * std::pow(first.noise / bound, 1.0 / noise_order);
}

/// Samples with as many rays as they need, up to sixteen times those that are asked for.
/// Noise counts with the area that a sample stands for,
/// so that those of small elements may have more of it.
class GatheredSamples {
public:
  /// Gathers from that scene. The rest must outlive what is made.
  GatheredSamples(const LightScene& lit, const std::vector<Rgb>& irradiance,
                  const std::vector<Rgb>& reflected, const Gathering& how, const SampleRays& rays,
                  tbb::enumerable_thread_specific<PointWorkspace>& workspaces)
      : rays_(rays) {
    constexpr int step = 4;
    for (int times = 1; times <= max_times_asked; times *= step) {
      counts_.push_back(times * rays.asked);
      const PointGathering& gathering = gatherings_.emplace_back(
          lit, reflected, how.form_factors, how.direct,
          PointGatheringSettings{.rays = counts_.back(),
                                 .cluster_shadow_rays = how.interpolation.cluster_shadow_rays});
      samples_.push_back(gathered_samples(gathering, irradiance, workspaces));
      if (counts_.back() >= rays.needed)
        break;
    }
  }

  PointSample operator()(const Receiver& receiver, double element_size, std::uint32_t seed) const {
    const double needed =
        rays_.needed * std::pow(std::min(1.0, element_size / rays_.size), 1.0 / noise_order);
    std::size_t k = 0;
    while (k + 1 < counts_.size() && counts_[k] < needed)
      ++k;
    return samples_[k](receiver, element_size, seed);
  }

  const PointGathering& fewest() const { return gatherings_.front(); }

private:
  SampleRays rays_;
  std::deque<PointGathering> gatherings_; // which stay where they are made
  std::vector<int> counts_;
  std::vector<SamplePoint> samples_;
};

/// How far a field is refined; `weight` is w by CellId of the roots.
struct Refinement {
  std::span<const double> weight;
  RefinementSettings settings;
};

/// Light from the elements, twice: with few rays from the elements as they were solved,
/// then from what that makes of them. Where two walls meet,
/// light changes within an element as much as from one to the next, and comes from near by.
SampledField gathered_field(const LightScene& light, const ElementLight& elements,
                            const SampledField& from_source, const Gathering& how,
                            const Refinement& to, InterpolatedField& result) {
  constexpr int levels = 2;
  RefinementSettings refinement = to.settings;
  refinement.root_points = refinement.points = 0; // smooth: its centre tells what an element hides
  tbb::enumerable_thread_specific<PointWorkspace> workspaces;
  const auto refined = [&](const LightScene& lit, const std::vector<Rgb>& irradiance,
                           const std::vector<Rgb>& reflected, const SampleRays& rays) {
    const GatheredSamples at_vertices(lit, irradiance, reflected, how, rays, workspaces),
        between(lit, irradiance, reflected, how,
                {std::max(1, rays.asked / 4), 0.25 * rays.needed, rays.size}, workspaces);
    const FieldSampler sampler{
        std::cref(at_vertices), mean_of_two(std::cref(between)),
        [&](const Receiver& receiver, double element_size, std::uint32_t seed) {
          return is_open(between.fewest(), irradiance, {receiver, element_size, seed},
                         workspaces.local());
        }};
    return refine_field(light, sampler, to.weight, {}, refinement);
  };
  const int asked = how.interpolation.rays, few = std::max(1, asked / 4);
  const double size = light.mesh.element_size;
  const SampledField first =
      refined(light, elements.irradiance, elements.reflected, {few, double(few), size});
  const Surroundings around = surroundings(light, from_source, first, levels);
  SampledField field =
      refined(*around.scene, around.irradiance, around.reflected,
              {asked, rays_within(how.interpolation.adaptive->error, first, few), size});
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
  return field;
}

} // namespace

InterpolatedField adaptive_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings) {
  constexpr double direct_share = 0.8, gathered_share = 0.6;
  const std::vector<double> weight = error_weights(light.mesh, elements.irradiance);
  const SourceField source = field_from_source(light, weight, form_factors, direct,
                                               refinement_of(*settings.adaptive, direct_share));
  const SampledField& from_source = source.field;
  InterpolatedField result;
  result.form_factor_rays = source.form_factor_rays;
  result.shadow_rays = source.shadow_rays;
  const SampledField gathered =
      gathered_field(light, elements, from_source, {form_factors, direct, settings},
                     {weight, refinement_of(*settings.adaptive, gathered_share)}, result);

  result.mesh = overlaid(from_source.mesh, gathered.mesh, light.surfaces);
  const auto on_mesh = [&](const SampledField& field, const std::vector<glm::vec3>& values) {
    return carried(field.mesh, values, *result.mesh, light.surfaces);
  };
  VertexIrradiance& field = result.field;
  field.indirect = on_mesh(gathered, gathered.total);
  field.indirect_mirrored = on_mesh(gathered, gathered.mirrored);
  field.irradiance = sum_of(on_mesh(from_source, from_source.total), field.indirect);
  field.mirrored = sum_of(on_mesh(from_source, from_source.mirrored), field.indirect_mirrored);
  result.error = std::hypot(from_source.error, gathered.error);
  return result;
}

} // namespace meninas
