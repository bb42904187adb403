#include "radiosity/interpolation.h"

#include "radiosity/adaptive_field.h"
#include "radiosity/contact_vertices.h"
#include "radiosity/facets.h"
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

using PointWorkspaces = tbb::enumerable_thread_specific<PointWorkspace>;

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

/// Of each facet's light from the source, and of the rest, what comes by way of mirrors: in the share that a few rays find at its middle.
static std::array<std::vector<Rgb>, 2> mirrored_parts(const LightScene& light,
                                                      const std::vector<std::uint8_t>& averaged,
                                                      const std::array<std::vector<Rgb>, 2>& parts,
                                                      const PointGathering& gathering,
                                                      PointWorkspaces& workspaces) {
  const ElementMesh& mesh = light.mesh;
  std::array<std::vector<Rgb>, 2> mirrored;
  for (auto& part : mirrored)
    part.assign(element_count(mesh), Rgb(0.0));
  const auto share = [](const ArrivingLight& arrived) {
    return glm::clamp(arrived.mirrored / glm::max(arrived.total, Rgb(1e-300)), 0.0, 1.0);
  };
  tbb::parallel_for(std::size_t{0}, element_count(mesh), [&](std::size_t e) {
    if (averaged[e] == 0)
      return;
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[e])];
    const Receiver middle{centre_of(mesh, static_cast<ElementId>(e)), side.normal, side.plane_class,
                          side.tangent};
    const PointLight found = light_at(
        gathering, middle, hash(static_cast<std::uint32_t>(e), 0xface7), workspaces.local());
    mirrored[0][e] = share(found.from_source) * parts[0][e];
    mirrored[1][e] = share(found.indirect()) * parts[1][e];
  });
  return mirrored;
}

/// Vertices of facets take the means of what these have received.
static void average_facets(const LightScene& light, const ElementLight& elements,
                           const VertexElements& facets, const FormFactorSettings& form_factors,
                           PointWorkspaces& workspaces, DiffuseField& field) {
  constexpr int few_rays = 16;
  const ElementMesh& mesh = light.mesh;
  std::array<std::vector<Rgb>, 2> parts{elements.from_source, elements.irradiance}, mirrored;
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    parts[1][e] -= parts[0][e];
  if (!light.mirrors.mirrors.empty() || light.mirrors.facets > 0) {
    const PointGathering gathering(light, elements.reflected, form_factors,
                                   {.shadow_rays = 4, .penumbra_rays = 4},
                                   {.rays = few_rays, .cluster_shadow_rays = 1});
    mirrored = mirrored_parts(light, averaged_facets(mesh, facets), parts, gathering, workspaces);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto own = around(facets, v);
    if (own.empty())
      continue;
    const auto mean = [&](const std::vector<Rgb>& values) {
      return values.empty() ? glm::vec3(0.0F) : facet_mean(mesh, own, elements.irradiance, values);
    };
    field.indirect[v] = mean(parts[1]);
    field.irradiance[v] = field.indirect[v] + mean(parts[0]);
    field.indirect_mirrored[v] = mean(mirrored[1]);
    field.mirrored[v] = field.indirect_mirrored[v] + mean(mirrored[0]);
  }
}

/// Vertices on which something stands, or at whose side it does, take what is gathered beside it; those of facets keep their means.
static void light_contacts(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                           std::span<const Receiver> receivers, const VertexElements& facets,
                           PointWorkspaces& workspaces, std::vector<std::uint8_t>& valid,
                           DiffuseField& field) {
  const ElementMesh& mesh = gathering.light.mesh;
  std::vector<std::uint8_t> open = valid;
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t v) {
    if (open[v] != 0 && !is_averaged(facets, v) && is_at_foot(gathering.light, receivers[v]))
      open[v] = 0;
  });
  const std::vector<ContactEdge> edges = contact_edges(mesh, open);
  std::vector<ContactLight> lights(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t k) {
    const auto [covered, exposed] = edges[k];
    lights[k] =
        light_at_contact(gathering, irradiance, receivers[exposed], receivers[covered].position,
                         size_of(mesh, mesh.element_of_vertex[exposed]),
                         hash(covered, exposed, gathering.form_factors.seed), workspaces.local());
  });
  extend_to_contacts(edges, lights, valid, field);
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
  const VertexElements facets =
      elements.from_source.empty() ? VertexElements{} : facets_around(light);
  PointWorkspaces workspaces;
  if (!facets.elements.empty())
    average_facets(light, elements, facets, form_factors, workspaces, field);
  const auto light_vertex = [&](std::size_t v, PointWorkspace& work) {
    if (is_averaged(facets, v))
      return;
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
  if (shares != nullptr)
    share_indirect(*shares, valid, field);
  light_contacts(gathering, elements.irradiance, receivers, facets, workspaces, valid, field);
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
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
