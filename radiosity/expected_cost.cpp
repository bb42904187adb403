#include "radiosity/expected_cost.h"

#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/field/vertex_places.h"
#include "radiosity/hierarchical/node_solution.h"
#include "radiosity/light/element_light.h"
#include "radiosity/light/gather_noise.h"
#include "radiosity/light/point_irradiance.h"
#include "scenes/sampling.h"
#include "scenes/seconds_of_one.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The seconds of one piece of work, measured on at most `some` of `all`, spread over all of them.
template <typename Do>
double seconds_of_one_of(std::size_t all, std::size_t some, const Do& work) {
  return seconds_of_one(std::min(all, some), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      work(std::min(all - 1, static_cast<std::size_t>(sobol4(static_cast<std::uint32_t>(k), 0xc057)[0] * double(all))));
  });
}

/// One gathering, and direct light at one vertex and on one element;
/// seconds of one thread.
struct PointSeconds {
  double gather = 0.0, source = 0.0, on_element = 0.0;
};
PointSeconds point_seconds(const LightScene& light, const PassOneSettings& settings) {
  constexpr std::size_t some = 64;
  const ElementMesh& mesh = light.mesh;
  if (mesh.vertices.empty())
    return {};
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  const PointGathering gathering(
      light, std::vector<Rgb>(element_count(mesh), Rgb(1.0)), settings.form_factors,
      settings.direct,
      {.rays = settings.interpolation.rays,
       .cluster_shadow_rays = settings.interpolation.cluster_shadow_rays});
  PointWorkspace work;
  PointSeconds seconds;
  const auto seed = [](std::size_t v) { return hash(static_cast<std::uint32_t>(v), 0xc057); };
  seconds.gather = seconds_of_one_of(receivers.size(), some, [&](std::size_t v) {
    indirect_light_at(gathering, receivers[v], seed(v), work);
  });
  seconds.source = seconds_of_one_of(receivers.size(), 4 * some, [&](std::size_t v) {
    direct_irradiance(light, receivers[v], settings.direct, seed(v), work.direct);
  });
  SharedLightWorkspace element_work;
  seconds.on_element = seconds_of_one_of(element_count(mesh), some, [&](std::size_t e) {
    direct_irradiance(light, static_cast<ElementId>(e), 0, settings.direct, element_work);
  });
  return seconds;
}

/// The expected counts.
struct Counts {
  double rows = 0.0;     ///< of the transport
  double of_rays = 1.0;  ///< what share of a gathering's rays a row has
  double gathers = 0.0;  ///< by vertices, besides
  double sources = 0.0;  ///< vertices with direct light
  double elements = 0.0; ///< whose direct light is computed
};

/// Where light is received by nodes: about twice as many as at first, and a few vertices for each.
Counts counted_by_nodes(const LightScene& light, const PassOneSettings& settings, Counts all) {
  constexpr double rows_of_first = 2.0, gathers_of_row = 3.0,
                   by_themselves = 0.05; // of the elements, whose corners do not tell
  const NodeTree tree = make_node_tree(light);
  const std::size_t first = first_receivers(light.mesh, tree).size();
  all.rows = std::min(all.elements, rows_of_first * double(first));
  if (!gathers_by_nodes(settings))
    return all;
  all.of_rays = double(rays_per_row(settings.form_factors, first).rays) /
                double(std::max(1, settings.form_factors.rays));
  all.gathers = std::min(all.gathers, gathers_of_row * all.rows);
  all.elements = by_themselves * all.elements;
  return all;
}

/// Vertices with a value of their own.
std::size_t gathering_vertices(const LightScene& light) {
  const VertexElements facets = facets_around(light);
  std::size_t count = 0;
  for (std::size_t v = 0; v < light.mesh.vertices.size(); ++v)
    count += around(facets, v).empty() ? 1 : 0;
  return count;
}

} // namespace

PassOneCost expected_cost(const LightScene& light, int bands, const PassOneSettings& settings) {
  constexpr double products = 16.0, entry_seconds = 2e-9; // of the solver
  const double elements = double(element_count(light.mesh)),
               vertices = settings.interpolation.method == Interpolation::average
                              ? 0.0
                              : double(gathering_vertices(light));
  Counts counts{.rows = elements, .gathers = vertices, .sources = vertices, .elements = elements};
  if (settings.cut == MeshCut::hierarchical)
    counts = counted_by_nodes(light, settings, counts);

  const PointSeconds point = point_seconds(light, settings);
  PassOneCost cost;
  cost.form_factors =
      counts.rows * counts.of_rays * point.gather + counts.elements * point.on_element;
  cost.interpolate = counts.gathers * point.gather + counts.sources * point.source;
  cost.solve = products * entry_seconds * bands * counts.rows *
               std::min<double>(settings.form_factors.rays, elements);
  return cost;
}

} // namespace meninas
