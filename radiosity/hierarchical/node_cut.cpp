#include "radiosity/hierarchical/node_cut.h"

#include "radiosity/transport/gathered_emission.h"
#include "radiosity/transport/linear_system.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

namespace {

/// Nodes of a cut and what they have gathered;
/// without `receiver_of_element`, which is of whole cuts.
NodeCut gathered_by(const LightScene& light, const NodeTree& tree, std::vector<TreeNodeId> nodes,
                    FormFactorSettings settings, const Progress& progress) {
  // Rows are numbered anew from round to round:
  // so that their samples are not the same, each round has its seed.
  settings.seed = hash(settings.seed, nodes.empty() ? 0 : index(nodes.front()), 0x40de);
  const auto receiver = [&](std::size_t row) {
    return area_of(light, tree, nodes[row]);
  };
  FormFactors factors = assemble_rows(light, nodes.size(), receiver, settings, progress);
  NodeCut part;
  part.emission = gathered_emission(light, factors);
  const LightByLamp by_lamp = gathered_by_lamp(light, factors);
  for (std::size_t row = 0; row < by_lamp.rows; ++row)
    part.emission_by_lamp.emplace_back(by_lamp[row].begin(), by_lamp[row].end());
  part.receivers = std::move(nodes);
  part.rows = std::move(factors.transport);
  part.closure = std::move(factors.closure);
  part.covered = std::move(factors.covered);
  part.exposed = std::move(factors.exposed);
  part.rays_traced = factors.rays_traced;
  return part;
}

void append(const NodeCut& from, std::size_t receiver, NodeCut& to) {
  append_row(from.rows, receiver, to.rows);
  to.receivers.push_back(from.receivers[receiver]);
  to.closure.push_back(from.closure[receiver]);
  to.emission.push_back(from.emission[receiver]);
  if (!from.emission_by_lamp.empty())
    to.emission_by_lamp.push_back(from.emission_by_lamp[receiver]);
  to.covered.push_back(from.covered[receiver]);
  to.exposed.push_back(from.exposed[receiver]);
}

/// The receivers left of a cut, and those that have taken the place of the rest, in the order of the tree.
NodeCut merged(const NodeTree& tree, const NodeCut& before, const std::vector<std::uint8_t>& gone,
               const NodeCut& fresh) {
  NodeCut cut;
  cut.rows.bands = fresh.rows.bands;
  cut.rows.row_begin.push_back(0);
  cut.rays_traced = before.rays_traced + fresh.rays_traced;
  const std::size_t columns = before.rows.columns.size() + fresh.rows.columns.size();
  cut.rows.columns.reserve(columns);
  cut.rows.weights.reserve(columns * static_cast<std::size_t>(cut.rows.bands));
  for (std::size_t a = 0, b = 0; a < before.receivers.size() || b < fresh.receivers.size();) {
    const bool old = b == fresh.receivers.size() ||
                     (a < before.receivers.size() && before.receivers[a] < fresh.receivers[b]);
    if (!old)
      append(fresh, b++, cut);
    else if (gone[a++] == 0)
      append(before, a - 1, cut);
  }
  cut.rows.size = cut.receivers.size();
  cut.receiver_of_element.resize(tree.elements.size());
  for (std::uint32_t r = 0; r < cut.receivers.size(); ++r)
    for (const ElementId element : elements_below(tree, cut.receivers[r]))
      cut.receiver_of_element[index(element)] = r;
  return cut;
}

/// Receivers on a part of which something stands, or may stand: clusters that say so (gathered_rays.h), and
/// of those that meet black backs, elements that are covered are found as far
/// as they are several of the cells that the receiver is looked at in.
std::vector<std::uint8_t> covered_in_part(const NodeTree& tree, const NodeCut& cut) {
  constexpr std::uint32_t max_elements = 16;
  std::vector<std::uint8_t> marked;
  for (std::size_t r = 0; r < cut.receivers.size(); ++r) {
    const TreeNode& node = tree.nodes[index(cut.receivers[r])];
    const bool meets_black = cut.closure[r].black > 0.0F && node.leaf_count > max_elements;
    const bool partly = (cut.covered[r] != 0 || meets_black) && cut.covered[r] != wholly_covered;
    marked.push_back(!is_leaf(node) && partly ? 1 : 0);
  }
  return marked;
}

NodeCut divided(const LightScene& light, const NodeTree& tree, const NodeCut& cut,
                const std::vector<std::uint8_t>& marked, const FormFactorSettings& settings,
                const Progress& progress) {
  std::vector<TreeNodeId> children;
  for (std::size_t r = 0; r < cut.receivers.size(); ++r)
    if (marked[r] != 0) {
      const TreeNode& node = tree.nodes[index(cut.receivers[r])];
      for (std::uint32_t c = 0; c < node.child_count; ++c)
        children.push_back(static_cast<TreeNodeId>(index(node.first_child) + c));
    }
  std::ranges::sort(children);
  return merged(tree, cut, marked,
                gathered_by(light, tree, std::move(children), settings, progress));
}

bool any(const std::vector<std::uint8_t>& marked) {
  return std::ranges::find(marked, 1) != marked.end();
}

} // namespace

/// The number of receivers a side begins with: the more, the larger a share of all surfaces it is.
static double first_on_side(double share) {
  constexpr double in_all = 1024.0, least = 4.0, most = 16.0;
  return std::clamp(in_all * share, least, most);
}

std::vector<TreeNodeId> first_receivers(const ElementMesh& mesh, const NodeTree& tree) {
  double all = 0.0;
  std::vector<double> areas(mesh.sides.size(), 0.0);
  for (std::size_t e = 0; e < mesh.area.size(); ++e) {
    areas[index(mesh.side_of_element[e])] += mesh.area[e];
    all += mesh.area[e];
  }
  std::vector<TreeNodeId> nodes;
  std::vector<std::uint32_t> most(mesh.sides.size()); // elements of a receiver, by side
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const TreeNode& node = tree.nodes[n];
    if (is_cluster(node)) {
      if (!node.cut)
        nodes.push_back(static_cast<TreeNodeId>(n));
      continue;
    }
    std::uint32_t& limit = most[index(node.side)];
    const bool is_top = node.parent == none<TreeNodeId> || is_cluster(tree.nodes[index(node.parent)]);
    if (is_top)
      limit = std::max(1U, static_cast<std::uint32_t>(
                               node.leaf_count / first_on_side(areas[index(node.side)] / all)));
    const auto is_divided = [&](const TreeNode& other) {
      return !is_leaf(other) && (other.cut || (!is_cluster(other) && other.leaf_count > limit));
    };
    const bool above_is_divided =
        node.parent == none<TreeNodeId> || is_divided(tree.nodes[index(node.parent)]);
    if (above_is_divided && !is_divided(node))
      nodes.push_back(static_cast<TreeNodeId>(n));
  }
  return nodes;
}

NodeCut first_cut(const LightScene& light, const NodeTree& tree, const FormFactorSettings& settings,
                  const Progress& progress) {
  const NodeCut found =
      gathered_by(light, tree, first_receivers(light.mesh, tree), settings, progress);
  NodeCut cut = merged(tree, {}, {}, found);
  return moved_down(light, tree, std::move(cut),
                    std::vector<std::uint8_t>(found.receivers.size(), 0), settings, progress);
}

NodeCut moved_down(const LightScene& light, const NodeTree& tree, NodeCut cut,
                   const std::vector<std::uint8_t>& marked, const FormFactorSettings& settings,
                   const Progress& progress) {
  for (std::vector<std::uint8_t> now = marked;;) {
    if (any(now))
      cut = divided(light, tree, cut, now, settings, progress);
    now = covered_in_part(tree, cut);
    if (!any(now))
      return cut;
  }
}

NodeCut traced_anew(const LightScene& light, const NodeTree& tree, NodeCut cut,
                    FormFactorSettings settings, const Progress& progress) {
  settings.seed = hash(settings.seed, 0xa11e);
  NodeCut again = gathered_by(light, tree, cut.receivers, settings, progress);
  again.receiver_of_element = std::move(cut.receiver_of_element);
  again.covered = std::move(cut.covered);
  again.exposed = std::move(cut.exposed);
  again.rays_traced += cut.rays_traced;
  return again;
}

/// Whether what a receiver knows of what stands on it is true of its elements.
static bool tells_of_elements(const NodeTree& tree, const NodeCut& cut, std::size_t receiver) {
  return is_leaf(tree.nodes[index(cut.receivers[receiver])]) ||
         cut.covered[receiver] == wholly_covered;
}

std::vector<ContactMask> covered_elements(const NodeTree& tree, const NodeCut& cut) {
  std::vector<ContactMask> covered(tree.elements.size(), 0);
  for (std::size_t r = 0; r < cut.receivers.size(); ++r)
    if (tells_of_elements(tree, cut, r))
      for (const ElementId element : elements_below(tree, cut.receivers[r]))
        covered[index(element)] = cut.covered[r];
  return covered;
}

std::vector<std::uint8_t> clustered_elements(const NodeTree& tree, const NodeCut& cut) {
  std::vector<std::uint8_t> clustered(tree.elements.size(), 0);
  for (const TreeNodeId id : cut.receivers)
    if (is_cluster(tree.nodes[index(id)]))
      for (const ElementId e : elements_below(tree, id))
        clustered[index(e)] = 1;
  return clustered;
}

std::vector<float> exposed_shares(const ElementMesh& mesh, const NodeTree& tree,
                                  const NodeCut& cut) {
  std::vector<float> exposed = mesh.solid;
  for (std::size_t r = 0; r < cut.receivers.size(); ++r)
    if (tells_of_elements(tree, cut, r))
      for (const ElementId element : elements_below(tree, cut.receivers[r]))
        exposed[index(element)] *= cut.exposed[r];
  return exposed;
}

std::vector<Rgb> means_below(const NodeTree& tree, const NodeCut& cut,
                             const std::vector<double>& areas, const std::vector<Rgb>& values) {
  std::vector<Rgb> means;
  means.reserve(cut.receivers.size());
  for (const TreeNodeId receiver : cut.receivers) {
    Rgb sum(0.0);
    double area = 0.0;
    for (const ElementId element : elements_below(tree, receiver)) {
      sum += areas[index(element)] * values[index(element)];
      area += areas[index(element)];
    }
    means.push_back(area > 0.0 ? sum / area : Rgb(0.0));
  }
  return means;
}

namespace {

/// The rows [begin, end) of what receivers gather from one another; `place` is by receiver, 0, and left so.
Transport links_of_rows(const NodeCut& cut, std::size_t begin, std::size_t end,
                        std::vector<std::uint32_t>& place) {
  const Transport& rows = cut.rows;
  const auto bands = static_cast<std::size_t>(rows.bands);
  Transport result;
  for (std::size_t r = begin; r < end; ++r) {
    const std::size_t first = result.columns.size();
    for (auto k = rows.row_begin[r]; k < rows.row_begin[r + 1]; ++k) {
      const std::uint32_t source = cut.receiver_of_element[rows.columns[k]];
      if (place[source] == 0) {
        result.columns.push_back(source);
        result.weights.resize(result.weights.size() + bands, 0.0F);
        place[source] = static_cast<std::uint32_t>(result.columns.size() - first);
      }
      for (std::size_t band = 0; band < bands; ++band)
        result.weights[(first + place[source] - 1) * bands + band] +=
            rows.weights[k * bands + band];
    }
    for (std::size_t k = first; k < result.columns.size(); ++k)
      place[result.columns[k]] = 0;
    result.row_begin.push_back(result.columns.size());
  }
  return result;
}

} // namespace

Transport between_receivers(const NodeCut& cut) {
  constexpr std::size_t chunk_size = 1024;
  const std::size_t size = cut.rows.size, chunks = (size + chunk_size - 1) / chunk_size;
  std::vector<Transport> parts(chunks);
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> places(
      [size] { return std::vector<std::uint32_t>(size, 0); }); // 1 + its place among the row's columns, or 0
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    parts[c] = links_of_rows(cut, c * chunk_size, std::min(size, (c + 1) * chunk_size),
                             places.local());
  });

  // One table of all, chunk by chunk.
  Transport result;
  result.size = size;
  result.bands = cut.rows.bands;
  std::vector<std::size_t> first(chunks + 1, 0);
  for (std::size_t c = 0; c < chunks; ++c)
    first[c + 1] = first[c] + parts[c].columns.size();
  result.row_begin.assign(size + 1, 0);
  result.columns.resize(first[chunks]);
  result.weights.resize(first[chunks] * static_cast<std::size_t>(result.bands));
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    const auto begin = static_cast<std::ptrdiff_t>(first[c]);
    std::ranges::copy(parts[c].columns, result.columns.begin() + begin);
    std::ranges::copy(parts[c].weights, result.weights.begin() + begin * result.bands);
    for (std::size_t k = 0; k < parts[c].row_begin.size(); ++k)
      result.row_begin[c * chunk_size + k + 1] = first[c] + parts[c].row_begin[k];
    parts[c] = {};
  });
  return result;
}

} // namespace meninas
