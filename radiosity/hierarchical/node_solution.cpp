#include "radiosity/hierarchical/node_solution.h"

#include "radiosity/light/gather_noise.h"
#include "radiosity/solvers/error_bound.h"
#include "radiosity/solvers/solve_together.h"
#include "radiosity/transport/linear_system.h"
#include "scenes/stopwatch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

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

/// The system of the receivers and its solution.
struct Received {
  SolverResult solver;         ///< of rho H, by receiver
  std::vector<Rgb> irradiance; ///< H by receiver, 0 in traps (solve.h)
  std::vector<Rgb> open;       ///< likewise and by channel, 0 in traps; empty where there is none
  Transport links;
};

/// The area of what is below each receiver, m^2.
std::vector<double> areas_of_receivers(const NodeCut& cut, const std::vector<double>& areas) {
  std::vector<double> of_receivers(cut.receivers.size(), 0.0);
  for (std::uint32_t e = 0; e < areas.size(); ++e)
    of_receivers[cut.receiver_of_element[e]] += areas[e];
  return of_receivers;
}

/// tau_cd, the mean over the elements of c of the sum over those of d.
TranslucentLinks translucent_links_of_receivers(const NodeCut& cut,
                                                const TranslucentLinks& elements,
                                                const std::vector<double>& areas) {
  TranslucentLinks links;
  if (elements.empty())
    return links;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Rgb> sums;
  const std::vector<double> area = areas_of_receivers(cut, areas);
  for (std::uint32_t e = 0; e < areas.size(); ++e) {
    const std::uint32_t c = cut.receiver_of_element[e];
    for (std::uint32_t k = elements.row_begin[e]; k < elements.row_begin[e + 1]; ++k)
      sums[{c, cut.receiver_of_element[elements.columns[k]]}] +=
          areas[e] * elements.transmittance[k];
  }
  links.row_begin.assign(area.size() + 1, 0);
  for (const auto& [pair, sum] : sums) {
    ++links.row_begin[pair.first + 1];
    links.columns.push_back(pair.second);
    links.transmittance.push_back(area[pair.first] > 0.0 ? sum / area[pair.first] : Rgb(0.0));
  }
  for (std::size_t c = 0; c < area.size(); ++c)
    links.row_begin[c + 1] += links.row_begin[c];
  return links;
}

Received solve_receivers(const NodeTree& tree, const NodeCut& cut, const FirstLight& first,
                         const std::vector<double>& areas, const SolverSettings& settings) {
  Received received;
  received.links = between_receivers(cut);
  const std::vector<Rgb> reflectance = means_below(tree, cut, areas, first.reflectance);
  const std::vector<Rgb> from_first = transport_product(cut.rows, first.source);
  const TranslucentLinks translucent =
      translucent_links_of_receivers(cut, first.translucent, areas);
  const std::vector<Rgb> source = scattered(reflectance, translucent, from_first);
  const std::vector<double> of_receivers = areas_of_receivers(cut, areas);
  received.solver = solve(received.links, source, {reflectance, translucent}, settings,
                          {.shooters = {}, .watch = {}, .progress = {}, .areas = of_receivers});
  received.irradiance = apply_transport(received.links, received.solver.radiosity);
  for (std::size_t c = 0; c < source.size(); ++c)
    received.irradiance[c] += from_first[c];
  if (!received.solver.trapped.empty()) {
    received.open = open_rows(LinearSystem<Rgb>{received.links, source, reflectance});
    for (std::size_t c = 0; c < source.size(); ++c)
      received.irradiance[c] *= received.open[c];
  }
  return received;
}

/// The elements below these receivers, indices of ElementId.
std::vector<std::uint32_t> elements_of(const NodeTree& tree, const NodeCut& cut,
                                       std::span<const std::uint32_t> receivers) {
  std::vector<std::uint32_t> elements;
  for (const std::uint32_t receiver : receivers)
    for (const ElementId element : elements_below(tree, cut.receivers[receiver]))
      elements.push_back(index(element));
  return elements;
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

/// Receivers over which the light gathered by their rays (H, G and the sky) varies by more than it may.
/// Their error is reflected on and on: the more often, the smaller the bound.
std::vector<std::uint8_t> to_divide(const NodeTree& tree, const NodeCut& cut,
                                    const FirstLight& first, const std::vector<double>& areas,
                                    const std::vector<Rgb>& irradiance, double link_error) {
  const std::vector<Rgb> reflectance = means_below(
                             tree, cut, areas, total_shares(first.reflectance, first.translucent)),
                         at_first = means_below(tree, cut, areas, first.irradiance),
                         direct = means_below(tree, cut, areas, first.direct);
  std::vector<Rgb> gathered = irradiance, radiosity;
  for (std::size_t c = 0; c < irradiance.size(); ++c) {
    gathered[c] += at_first[c] - direct[c];
    radiosity.push_back(reflectance[c] * (at_first[c] + irradiance[c]));
  }
  const std::vector<Rgb> mean = by_element(cut, radiosity);
  double light = 0.0, at_first_alone = 0.0, area = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e) {
    light += areas[e] * largest(mean[e]);
    at_first_alone += areas[e] * largest(first.source[e]);
    area += areas[e];
  }
  constexpr double often = 4.0; // more than in most rooms
  const double bound = link_error * std::min(1.0, often * at_first_alone / std::max(light, 1e-300));

  // The largest difference between a node and its parts:
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
    marked[c] = varies > bound * (largest(radiosity[c]) + light / area) ? 1 : 0;
  }
  return marked;
}

/// The problem that receivers solve.
struct NodeProblem {
  const LightScene& light;
  const NodeTree& tree;
  const DirectSettings& direct;
  const VertexSamples* vertices; ///< that are seen; null: elements are
  const Progress& progress;
};

/// A cut, what stands on the elements, and their first light.
struct LitCut {
  NodeCut cut;
  std::vector<ContactMask> covered; ///< by ElementId, as are those below
  std::vector<float> exposed;
  std::vector<double> areas; ///< exposed, m^2
  DirectIrradiance direct;
  FirstLight first;
};

/// The light of those elements whose covered part is another than `before`.
void light_changed(const NodeProblem& problem, const std::vector<ContactMask>& before,
                   LitCut& lit) {
  std::vector<ElementId> changed;
  for (std::uint32_t e = 0; e < before.size(); ++e)
    if (lit.covered[e] != before[e])
      changed.push_back(static_cast<ElementId>(e));
  recompute_direct(problem.light, changed, lit.covered, problem.direct, problem.progress, lit.direct);
}

void recompute_direct_of_cut(const NodeProblem& problem, LitCut& lit) {
  const LightScene& light = problem.light;
  // Smaller receivers may find that something stands on elements: then less of them is lit.
  if (std::vector<ContactMask> now = covered_elements(problem.tree, lit.cut); now != lit.covered) {
    std::swap(lit.covered, now);
    lit.exposed = exposed_shares(light.mesh, problem.tree, lit.cut);
    lit.areas.clear();
    for (std::size_t e = 0; e < lit.exposed.size(); ++e)
      lit.areas.push_back(light.mesh.area[e] * double{lit.exposed[e]});
    if (!now.empty())
      light_changed(problem, now, lit);
    else
      lit.direct = problem.vertices == nullptr
                       ? direct_irradiance(light, lit.covered, problem.direct, problem.progress)
                       : light_by_corners(light, problem.tree, lit.covered, *problem.vertices,
                                          problem.direct, problem.progress);
  }
  const std::vector<RowClosure> closure = by_element(lit.cut, lit.cut.closure);
  LightByLamp gathered;
  if (light.lamps) {
    gathered = no_light(lit.areas.size(), light.lamps.count);
    for (std::size_t e = 0; e < lit.areas.size(); ++e)
      std::ranges::copy(lit.cut.emission_by_lamp[lit.cut.receiver_of_element[e]],
                        gathered[e].begin());
  }
  lit.first = first_light(light,
                          {by_element(lit.cut, lit.cut.emission), closure, lit.covered, lit.exposed,
                           std::move(gathered)},
                          lit.direct, FormFactorMethod::rays);
}

/// The mean of the squares over the square of the mean.
double unevenness(const std::vector<double>& areas, const std::vector<Rgb>& values) {
  double area = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e) {
    const double value = largest(values[e]);
    area += areas[e];
    sum += areas[e] * value;
    squares += areas[e] * value * value;
  }
  return sum * sum > 0.0 ? area * squares / (sum * sum) : 1.0;
}

/// The first cut, lit, and how its rows are found:
/// where elements only light others with few rays, and once more if light is very uneven.
LitCut first_lit_cut(const NodeProblem& problem, const FormFactorSettings& form_factors,
                     FormFactorSettings& of_rows) {
  constexpr double very_uneven = 8.0; // which takes 2.5 times as many rays, and more
  const std::size_t rows = first_receivers(problem.light.mesh, problem.tree).size();
  const auto find = [&](const FormFactorSettings& settings, LitCut& lit) {
    of_rows = settings;
    const std::uint64_t before = lit.cut.rays_traced;
    lit.cut = first_cut(problem.light, problem.tree, of_rows, problem.progress);
    lit.cut.rays_traced += before;
    recompute_direct_of_cut(problem, lit);
  };
  LitCut lit;
  if (problem.vertices == nullptr) {
    find(form_factors, lit);
    return lit;
  }
  find(rays_per_row(form_factors, rows, 1.0), lit);
  const double uneven = unevenness(lit.areas, lit.first.source);
  const FormFactorSettings more = rays_per_row(form_factors, rows, uneven);
  if (form_factors.method == FormFactorMethod::rays && uneven > very_uneven &&
      more.rays > of_rows.rays)
    find(more, lit);
  return lit;
}

/// Enough to tell which receivers have to be divided: what few bounces leave is smooth.
SolverSettings roughly(SolverSettings settings) {
  constexpr double tolerance = 0.01;
  constexpr int iterations = 12;
  settings.method = SolverMethod::bicgstab;
  settings.tolerance = std::max(settings.tolerance, tolerance);
  settings.max_iterations = std::min(settings.max_iterations, iterations);
  return settings;
}

/// Each lamp's light by the same rows: H_l of receivers, and of elements X_l = S_l + rho H_l.
void tell_lamps_apart(const LitCut& lit, const NodeTree& tree, const Received& solved,
                      const SolverSettings& settings, NodeSolution& result) {
  const Transport& links = solved.links;
  const NodeCut& cut = lit.cut;
  const FirstLight& first = lit.first;
  const Scattering of_elements{first.reflectance, first.translucent};
  const LightByLamp source = scattered(of_elements, first.by_lamp);
  const LightByLamp from_first = transport_product(cut.rows, source);
  const std::vector<Rgb> reflectance = means_below(tree, cut, lit.areas, first.reflectance);
  const TranslucentLinks translucent =
      translucent_links_of_receivers(cut, first.translucent, lit.areas);
  const Scattering of_receivers{reflectance, translucent};
  const LightByLamp sent =
      solve_together(links, scattered(of_receivers, from_first), of_receivers, settings);
  LightByLamp received = from_first;
  received += transport_product(links, sent);
  for (std::size_t c = 0; c < solved.open.size(); ++c)
    for (std::size_t k = 0; k < received.columns; ++k)
      received[c][k] *= solved.open[c][static_cast<int>(k % 3)];
  LightByLamp arrived{.rows = source.rows, .columns = source.columns};
  for (std::size_t e = 0; e < arrived.rows; ++e)
    std::ranges::copy(received[cut.receiver_of_element[e]], arrived[e].begin());
  result.reflected_by_lamp = source;
  result.reflected_by_lamp += scattered(of_elements, arrived);
  result.irradiance_by_lamp = first.by_lamp;
  result.irradiance_by_lamp += arrived;
}

std::uint64_t bytes_of(const Transport& transport) {
  return transport.row_begin.size() * sizeof(transport.row_begin[0]) +
         transport.columns.size() * sizeof(transport.columns[0]) +
         transport.weights.size() * sizeof(transport.weights[0]);
}

} // namespace

FormFactorSettings rays_per_row(FormFactorSettings settings, std::size_t rows,
                                   double unevenness) {
  // The noise of N rays is sqrt(unevenness) N^-3/4 (gather_noise.h).
  constexpr double few = 512.0, most = 4096.0, even = 2.0;
  constexpr int least = 32;
  const double with_all =
      std::clamp(few * std::pow(unevenness / even, 0.5 / noise_order), few, most);
  const double share =
      settings.rays * std::min(with_all / double(std::max<std::size_t>(rows, 1)), 1.0);
  const auto shared = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(share))));
  settings.rays = std::min(settings.rays, std::max(least, shared));
  return settings;
}

NodeSolution solve_by_nodes(const LightScene& light, const NodeSolverSettings& settings,
                            std::optional<LitVertices> vertices, const Progress& progress) {
  NodeSolution result;
  Stopwatch watch;
  NodeTree tree = make_node_tree(light);
  const NodeProblem problem{light, tree, settings.direct, vertices ? &vertices->found : nullptr,
                            progress};
  FormFactorSettings of_rows;
  LitCut lit = first_lit_cut(problem, settings.form_factors, of_rows);
  const double spread = settings.hierarchical.link_error * (vertices ? 20.0 : 1.0);
  Received received;
  for (;;) {
    result.seconds_gathering += watch.lap();
    received = solve_receivers(tree, lit.cut, lit.first, lit.areas, roughly(settings.solver));
    const auto marked = to_divide(tree, lit.cut, lit.first, lit.areas, received.irradiance, spread);
    result.seconds_solving += watch.lap();
    if (std::ranges::find(marked, 1) == marked.end())
      break;
    lit.cut = moved_down(light, tree, std::move(lit.cut), marked, of_rows, progress);
    recompute_direct_of_cut(problem, lit);
  }

  received = solve_receivers(tree, lit.cut, lit.first, lit.areas, settings.solver);
  result.seconds_solving += watch.lap();

  // B = S + rho H, what receivers have pushed down to their elements.
  const NodeCut& cut = lit.cut;
  if (light.lamps)
    tell_lamps_apart(lit, tree, received, settings.solver, result);
  result.first = std::move(lit.first);
  result.arrived = by_element(cut, received.irradiance);
  result.solver = std::move(received.solver);
  result.solver.trapped = elements_of(tree, cut, result.solver.trapped);
  result.solver.radiosity = result.first.source;
  const std::vector<Rgb> again =
      scattered(result.first.reflectance, result.first.translucent, result.arrived);
  for (std::size_t e = 0; e < again.size(); ++e)
    result.solver.radiosity[e] += again[e];
  result.closure = by_element(cut, cut.closure);
  result.exposed = std::move(lit.exposed);
  result.rays_traced = cut.rays_traced;
  result.figures = {cut.receivers.size(), received.links.columns.size(),
                    tree.nodes.size() * sizeof(TreeNode) + bytes_of(cut.rows) +
                        bytes_of(received.links)};
  std::vector<std::uint8_t> clustered = clustered_elements(tree, cut);
  std::vector<TreeNodeId> receivers = with_faces_of_clusters(tree, cut.receivers);
  result.receivers = {
      std::move(tree),        std::move(receivers), settings.hierarchical.link_error,
      std::move(lit.covered), std::move(lit.direct.shared), std::move(clustered), {}};
  if (vertices) {
    result.rays_traced += vertices->rays;
    result.first.shadow_rays += vertices->shadow_rays;
    result.receivers.vertices = std::move(vertices->found);
    result.receivers.vertices.entering.clear();
  }
  return result;
}

} // namespace meninas
