#include "radiosity/hierarchical/node_solution.h"

#include "radiosity/hierarchical/node_light.h"
#include "radiosity/solvers/linear_system.h"
#include "scenes/stopwatch.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

namespace {

template <typename Value>
std::vector<Value> by_element(const NodeCut& cut, const std::vector<Value>& by_receiver) {
  std::vector<Value> values;
  values.reserve(cut.receiver_of_element.size());
  for (const std::uint32_t receiver : cut.receiver_of_element)
    values.push_back(by_receiver[receiver]);
  return values;
}

/// m^2 by ElementId, of what is there and on which nothing stands.
std::vector<double> exposed_areas(const ElementMesh& mesh,
                                  const std::vector<CoveredCells>& covered) {
  std::vector<double> areas;
  for (std::size_t e = 0; e < covered.size(); ++e)
    areas.push_back(mesh.area[e] * double{exposed_share(mesh, e, covered[e])});
  return areas;
}

/// The system of the receivers and its solution.
struct Received {
  SolverResult solver;         ///< of rho H, by receiver
  std::vector<Rgb> irradiance; ///< H by receiver
  Transport links;
};

Received solve_receivers(const NodeTree& tree, const NodeCut& cut, const FirstLight& first,
                         const std::vector<double>& areas, SolverSettings settings) {
  Received received;
  received.links = between_receivers(cut);
  const std::vector<Rgb> reflectance = means_below(tree, cut, areas, first.reflectance);
  const std::vector<Rgb> from_first = transport_product(cut.rows, first.source);
  std::vector<Rgb> source = from_first;
  for (std::size_t c = 0; c < source.size(); ++c)
    source[c] *= reflectance[c];
  settings.method = SolverMethod::bicgstab;
  received.solver = solve(received.links, source, reflectance, settings);
  received.irradiance = apply_transport(received.links, received.solver.radiosity);
  for (std::size_t c = 0; c < source.size(); ++c)
    received.irradiance[c] += from_first[c];
  return received;
}

/// Area means of what receivers have, by TreeNodeId: of themselves and of what is above them.
std::vector<Rgb> pulled(const NodeTree& tree, const NodeCut& cut, const std::vector<double>& areas,
                        const std::vector<Rgb>& by_receiver) {
  std::vector<Rgb> sum(tree.nodes.size(), Rgb(0.0));
  std::vector<double> area(tree.nodes.size(), 0.0);
  for (std::size_t c = 0; c < cut.receivers.size(); ++c) {
    const std::size_t node = index(cut.receivers[c]);
    for (const ElementId element : elements_below(tree, cut.receivers[c]))
      area[node] += areas[index(element)];
    sum[node] = area[node] * by_receiver[c];
  }
  for (std::size_t n = tree.nodes.size(); n-- > 0;)
    if (const TreeNodeId parent = tree.nodes[n].parent; parent != none<TreeNodeId>) {
      sum[index(parent)] += sum[n];
      area[index(parent)] += area[n];
    }
  for (std::size_t n = 0; n < sum.size(); ++n)
    sum[n] = area[n] > 0.0 ? sum[n] / area[n] : Rgb(0.0);
  return sum;
}

/// Receivers over which what their rays gather varies by more than it may: H, G and the sky.
std::vector<std::uint8_t> to_divide(const NodeTree& tree, const NodeCut& cut,
                                    const FirstLight& first, const std::vector<double>& areas,
                                    const std::vector<Rgb>& irradiance, double link_error) {
  const std::vector<Rgb> reflectance = means_below(tree, cut, areas, first.reflectance),
                         at_first = means_below(tree, cut, areas, first.irradiance),
                         from_source = means_below(tree, cut, areas, first.from_source);
  std::vector<Rgb> gathered = irradiance, radiosity;
  for (std::size_t c = 0; c < irradiance.size(); ++c) {
    gathered[c] += at_first[c] - from_source[c];
    radiosity.push_back(reflectance[c] * (at_first[c] + irradiance[c]));
  }
  const std::vector<Rgb> mean = by_element(cut, radiosity);
  double light = 0.0, area = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e) {
    light += areas[e] * largest(mean[e]);
    area += areas[e];
  }

  // How far the parts of a node are from it, at the most:
  // in the middle of a slope a part is as bright as the whole.
  const std::vector<Rgb> nodes = pulled(tree, cut, areas, gathered);
  std::vector<double> apart(tree.nodes.size(), 0.0);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const TreeNodeId parent = tree.nodes[n].parent; parent != none<TreeNodeId>)
      apart[index(parent)] =
          std::max(apart[index(parent)], largest(glm::abs(nodes[n] - nodes[index(parent)])));
  std::vector<std::uint8_t> marked(gathered.size(), 0);
  for (std::size_t c = 0; c < marked.size(); ++c) {
    const TreeNode& node = tree.nodes[index(cut.receivers[c])];
    if (is_leaf(node) || node.parent == none<TreeNodeId>)
      continue;
    const double varies = largest(reflectance[c]) * apart[index(node.parent)];
    marked[c] = varies > link_error * (largest(radiosity[c]) + light / area) ? 1 : 0;
  }
  return marked;
}

FirstLight first_light_of(const LightScene& light, const NodeCut& cut,
                          const DirectIrradiance& direct) {
  return first_light(light, by_element(cut, cut.emission), by_element(cut, cut.closure), direct,
                     FormFactorMethod::rays);
}

std::uint64_t bytes_of(const Transport& transport) {
  return transport.row_begin.size() * sizeof(transport.row_begin[0]) +
         transport.columns.size() * sizeof(transport.columns[0]) +
         transport.weights.size() * sizeof(transport.weights[0]);
}

} // namespace

FormFactorSettings rays_shared_out(FormFactorSettings settings, std::size_t rows) {
  constexpr double few = 128.0;
  constexpr int least = 32;
  const double share = settings.rays * std::min(few / double(std::max<std::size_t>(rows, 1)), 1.0);
  const auto shared = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(share))));
  settings.rays = std::min(settings.rays, std::max(least, shared));
  return settings;
}

NodeSolution solve_by_nodes(const LightScene& light, const FormFactorSettings& form_factors,
                            const DirectSettings& direct, const HierarchicalSettings& settings,
                            ElementsAre elements, const SolverSettings& solver,
                            const Progress& progress) {
  NodeSolution result;
  Stopwatch watch;
  NodeTree tree = make_node_tree(light.mesh, light.surfaces);
  const FormFactorSettings of_rows =
      elements == ElementsAre::seen
          ? form_factors
          : rays_shared_out(form_factors, first_receivers(light.mesh, tree).size());
  NodeCut cut = first_cut(light, tree, of_rows, progress);
  std::vector<CoveredCells> covered = covered_elements(tree, cut);
  const double spread = settings.link_error * (elements == ElementsAre::sources ? 20.0 : 1.0);
  const auto find_light = [&] {
    return elements == ElementsAre::seen ? direct_irradiance(light, covered, direct, progress)
                                         : light_by_nodes(light, tree, covered, direct, progress);
  };
  DirectIrradiance found = find_light();
  std::uint64_t shadow_rays = found.shadow_rays;

  Received received;
  std::vector<double> areas;
  for (;;) {
    // Smaller receivers may find that something stands on elements: then less of them is lit.
    if (std::vector<CoveredCells> now = covered_elements(tree, cut); now != covered) {
      covered = std::move(now);
      found = find_light();
      shadow_rays += found.shadow_rays;
    }
    areas = exposed_areas(light.mesh, covered);
    result.first = first_light_of(light, cut, found);
    result.seconds_gathering += watch.lap();
    received = solve_receivers(tree, cut, result.first, areas, solver);
    const auto marked = to_divide(tree, cut, result.first, areas, received.irradiance, spread);
    result.seconds_solving += watch.lap();
    if (std::ranges::find(marked, 1) == marked.end())
      break;
    cut = moved_down(light, tree, std::move(cut), marked, of_rows, progress);
  }

  // B = S + rho H, what receivers have pushed down to their elements.
  result.arrived = by_element(cut, received.irradiance);
  result.solver = std::move(received.solver);
  result.solver.method = SolverMethod::hierarchical;
  result.solver.radiosity = result.first.source;
  for (std::size_t e = 0; e < result.arrived.size(); ++e)
    result.solver.radiosity[e] += result.first.reflectance[e] * result.arrived[e];
  result.first.shadow_rays = shadow_rays;
  result.closure = by_element(cut, cut.closure);
  for (std::size_t e = 0; e < covered.size(); ++e)
    result.exposed.push_back(exposed_share(light.mesh, e, covered[e]));
  result.rays_traced = cut.rays_traced;
  result.figures = {cut.receivers.size(), received.links.columns.size(),
                    tree.nodes.size() * sizeof(TreeNode) + bytes_of(cut.rows) +
                        bytes_of(received.links)};
  result.receivers = {std::move(tree), std::move(cut.receivers), settings.link_error,
                      std::move(covered), std::move(found.shared)};
  return result;
}

} // namespace meninas
