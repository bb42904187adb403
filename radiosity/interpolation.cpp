#include "radiosity/interpolation.h"

#include "radiosity/adaptive_field.h"
#include "radiosity/mesh_division.h"
#include "radiosity/vertex_fill.h"
#include "radiosity/vertex_light.h"
#include "radiosity/vertex_places.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

namespace {

/// Mean of the elements around; at the border of a surface extrapolated from the elements behind: twice the mean at the
/// vertex less the mean one ring further in.
std::vector<glm::vec3> average_at_vertices(const ElementMesh& mesh,
                                           const std::vector<Rgb>& irradiance) {
  const VertexElements all = elements_around(mesh);
  std::vector<Rgb> mean(mesh.vertices.size(), Rgb(0.0));
  std::vector<Point3> centre(mesh.vertices.size(), Point3(0.0));
  for (std::size_t v = 0; v < mean.size(); ++v) {
    const auto elements = around(all, v);
    for (const ElementId element : elements) {
      mean[v] += irradiance[index(element)] / double(elements.size());
      centre[v] += centre_of(mesh, element) / double(elements.size());
    }
  }

  std::vector<glm::vec3> value(mean.begin(), mean.end());
  for (std::size_t v = 0; v < mean.size(); ++v) {
    // A vertex inside its surface lies at the centre of its elements; on the border they all lie to one side.
    const Vec3 inward = centre[v] - mesh.vertices[v];
    const double reach = glm::length(inward);
    if (reach < 0.2 * size_of(mesh, mesh.element_of_vertex[v]) * 0.5)
      continue;

    // Of the corners of those elements the one most straight inward carries the inner mean.
    double straightest = 0.0;
    std::size_t inner = v;
    for (const ElementId element : around(all, v))
      for (const auto corner : mesh.corners[index(element)]) {
        const Vec3 to = mesh.vertices[index(corner)] - mesh.vertices[v];
        const double cosine =
            index(corner) == v ? 0.0 : glm::dot(to, inward) / (glm::length(to) * reach);
        if (cosine > straightest) {
          straightest = cosine;
          inner = index(corner);
        }
      }
    const double further = glm::dot(centre[inner] - centre[v], inward) / reach;
    if (inner == v || further <= 0.25 * reach)
      continue;
    const double step = std::min(reach / further, 1.0);
    value[v] = glm::max(glm::vec3(mean[v] + step * (mean[v] - mean[inner])), glm::vec3(0.0F));
  }
  settle_hanging(mesh, value);
  return value;
}

} // namespace

/// Vertices that do not gather take what the corners of their receiver have gathered, as far as these are not covered.
static void share_indirect(const VertexShares& shares, std::vector<std::uint8_t>& valid,
                           DiffuseField& field) {
  for (std::size_t v = 0; v < valid.size(); ++v) {
    if (gathers(shares, v))
      continue;
    glm::vec3 total(0.0F), mirrored(0.0F);
    float weights = 0.0F;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint32_t from = index(shares.from[v][c]);
      const float weight = valid[from] != 0 ? shares.weight[v][c] : 0.0F;
      total += weight * field.indirect[from];
      mirrored += weight * field.indirect_mirrored[from];
      weights += weight;
    }
    if (!(weights > 0.0F)) {
      valid[v] = 0;
      continue;
    }
    field.indirect[v] = total / weights;
    field.indirect_mirrored[v] = mirrored / weights;
    field.irradiance[v] += field.indirect[v];
    field.mirrored[v] += field.indirect_mirrored[v];
  }
}

static InterpolatedField gather_at_vertices(const LightScene& light, const ElementLight& elements,
                                            const FormFactorSettings& form_factors,
                                            const DirectSettings& direct,
                                            const InterpolationSettings& settings,
                                            const VertexShares* shares) {
  constexpr std::size_t chunk_size = 64;
  const ElementMesh& mesh = light.mesh;
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  const PointGathering gathering(
      light, elements.reflected, form_factors, direct,
      {.rays = settings.rays, .cluster_shadow_rays = settings.cluster_shadow_rays});

  InterpolatedField result;
  DiffuseField& field = result.field;
  field.irradiance.assign(mesh.vertices.size(), glm::vec3(0.0F));
  field.mirrored = field.indirect = field.indirect_mirrored = field.irradiance;
  std::vector<std::uint8_t> valid(mesh.vertices.size(), 1);
  tbb::enumerable_thread_specific<PointWorkspace> workspaces;
  const auto light_vertex = [&](std::size_t v, PointWorkspace& work) {
    const double size = size_of(mesh, mesh.element_of_vertex[v]);
    const std::uint32_t seed = hash(static_cast<std::uint32_t>(v), form_factors.seed, 0x7e27);
    const VertexValue value =
        shares == nullptr || gathers(*shares, v)
            ? value_at(gathering, elements.irradiance, receivers[v], size, seed, work)
            : value_from_source(gathering, receivers[v], size, seed, work);
    field.irradiance[v] = glm::vec3(value.irradiance.total);
    field.mirrored[v] = glm::vec3(value.irradiance.mirrored);
    field.indirect[v] = glm::vec3(value.indirect.total);
    field.indirect_mirrored[v] = glm::vec3(value.indirect.mirrored);
    valid[v] = value.covered ? 0 : 1;
  };
  tbb::parallel_for(std::size_t{0}, (mesh.vertices.size() + chunk_size - 1) / chunk_size,
                    [&](std::size_t c) {
                      PointWorkspace& work = workspaces.local();
                      for (std::size_t v = c * chunk_size;
                           v < std::min(mesh.vertices.size(), (c + 1) * chunk_size); ++v)
                        light_vertex(v, work);
                    });
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
  if (shares != nullptr)
    share_indirect(*shares, valid, field);
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored}) {
    fill_vertices(mesh, valid, *values);
    settle_hanging(mesh, *values);
  }
  return result;
}

/// The means of elements know nothing of mirrors; what emitters send is known where it was found from the source.
static DiffuseField averaged_field(const ElementMesh& mesh, const ElementLight& elements) {
  DiffuseField field;
  field.irradiance = average_at_vertices(mesh, elements.irradiance);
  if (elements.from_source.empty())
    return field;
  std::vector<Rgb> indirect = elements.irradiance;
  for (std::size_t e = 0; e < indirect.size(); ++e)
    indirect[e] -= elements.from_source[e];
  field.indirect = average_at_vertices(mesh, indirect);
  return field;
}

InterpolatedField interpolate(const LightScene& light, const ElementLight& elements,
                              const FormFactorSettings& form_factors, const DirectSettings& direct,
                              const InterpolationSettings& settings, const VertexShares* shares) {
  if (settings.method == Interpolation::average)
    return {.field = averaged_field(light.mesh, elements)};
  if (settings.adaptive)
    return adaptive_field(light, elements, form_factors, direct, settings);
  return gather_at_vertices(light, elements, form_factors, direct, settings, shares);
}

glm::vec3 irradiance_at(const ElementMesh& mesh, const DiffuseField& field, SideId side, Vec2 uv) {
  return value_in(mesh, field.irradiance, locate(mesh, side, uv));
}

} // namespace meninas
