#include "radiosity/field/curves/smooth_vertices.h"

#include "radiosity/field/curves/smoothing_groups.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace meninas {

/// Spreads indirect light from cluster to cluster.
static void smooth_over_clusters(const ElementMesh& mesh, const VertexElements& facets,
                                 const ElementLight& elements, std::span<const std::uint8_t> clustered,
                                 std::vector<Rgb>& rest) {
  constexpr int rings = 4; // a cluster of 32 faces is some six across
  if (std::ranges::find(clustered, 1) == clustered.end())
    return;
  std::vector<glm::vec3> at_vertices(mesh.vertices.size());
  for (int ring = 0; ring < rings; ++ring) {
    tbb::parallel_for(std::size_t{0}, at_vertices.size(), [&](std::size_t v) {
      at_vertices[v] = facet_mean(mesh, around(facets, v), elements.irradiance, rest);
    });
    // A facet keeps what it has where its corners are no part of a curve.
    tbb::parallel_for(std::size_t{0}, clustered.size(), [&](std::size_t e) {
      const ElementCorners& corners = mesh.corners[e];
      if (clustered[e] == 0 || elements.irradiance[e] == Rgb(0.0) ||
          !std::ranges::all_of(corners, [&](ElementVertexId v) { return is_averaged(facets, index(v)); }))
        return;
      const std::size_t count = mesh.sides[index(mesh.side_of_element[e])].triangle ? 3 : 4;
      Rgb sum(0.0);
      for (std::size_t c = 0; c < count; ++c)
        sum += Rgb(at_vertices[index(corners[c])]);
      rest[e] = sum / double(count);
    });
  }
}

/// The part of each facet's direct and indirect light that comes by way of mirrors:
/// in the share that a few rays find at its middle.
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
    // The irradiance of a black facet is seen by nobody: a neon tube has thousands of them.
    if (averaged[e] == 0 || scattered_share(mesh, e) == Rgb(0.0))
      return;
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[e])];
    const Receiver middle{centre_of(mesh, static_cast<ElementId>(e)), side.normal, side.plane_class,
                          side.tangent, side.coat};
    const PointLight found = light_at(
        gathering, middle, hash(static_cast<std::uint32_t>(e), 0xface7), workspaces.local());
    mirrored[0][e] = share(found.direct) * parts[0][e];
    mirrored[1][e] = share(found.indirect()) * parts[1][e];
  });
  return mirrored;
}

/// The same means of what one lamp sends.
static void average_lamp(const ElementMesh& mesh, const ElementLight& elements,
                         const VertexElements& facets, std::span<const std::uint8_t> clustered,
                         std::size_t lamp, VertexLightOfLamp& light) {
  const std::vector<Rgb> direct = light_of_lamp(elements.direct_by_lamp, lamp);
  std::vector<Rgb> rest = light_of_lamp(elements.irradiance_by_lamp, lamp);
  for (std::size_t e = 0; e < rest.size(); ++e)
    rest[e] -= direct[e];
  smooth_over_clusters(mesh, facets, elements, clustered, rest);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (const auto own = around(facets, v); !own.empty()) {
      light.direct[v] = facet_mean(mesh, own, elements.irradiance, direct);
      light.indirect[v] = facet_mean(mesh, own, elements.irradiance, rest);
    }
}

void average_facets(const LightScene& light, const ElementLight& elements,
                    const VertexElements& facets, const FacetAverages& how,
                    PointWorkspaces& workspaces, VertexIrradiance& field) {
  constexpr int ray_count = 16;
  const ElementMesh& mesh = light.mesh;
  std::array<std::vector<Rgb>, 2> parts{elements.direct, elements.irradiance}, mirrored;
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    parts[1][e] -= parts[0][e];
  smooth_over_clusters(mesh, facets, elements, how.clustered, parts[1]);
  if (how.mirrored && (!light.mirrors.mirrors.empty() || light.mirrors.facets > 0)) {
    const PointGathering gathering(light, elements.reflected, how.form_factors,
                                   {.shadow_rays = 4, .penumbra_rays = 4},
                                   {.rays = ray_count, .cluster_shadow_rays = 1});
    mirrored = mirrored_parts(light, averaged_facets(mesh, facets), parts, gathering, workspaces);
  }
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l)
    average_lamp(mesh, elements, facets, how.clustered, l, field.by_lamp[l]);
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

} // namespace meninas
