#include "radiosity/hierarchical/node_light.h"

#include "radiosity/facets.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

DirectSettings shared_out(DirectSettings settings, std::size_t nodes) {
  const double share = double(points_of_sources) / double(std::max<std::size_t>(nodes, 1));
  if (share >= settings.points)
    return settings;
  const auto points = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(share))));
  // Doubling where the first points disagree darkens the outer half of a penumbra,
  // the more the fewer they are.
  const double fewer = double(points) / settings.points;
  settings.most_points = std::max(points, static_cast<int>(settings.most_points * fewer * fewer));
  settings.points = points;
  return settings;
}

std::uint32_t most_lit_together(std::size_t elements) {
  // Nodes are parted in four:
  // they have from a quarter of the most to that, and there are from N / 2 to 2 N of them.
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, 2 * elements / points_of_sources));
}

std::vector<TreeNodeId> nodes_lit_together(const NodeTree& tree, std::uint32_t most_elements,
                                           std::span<const std::uint8_t> alone) {
  std::vector<std::uint8_t> apart(tree.nodes.size(), 0); // something below is alone
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const TreeNode& node = tree.nodes[n];
    if (is_leaf(node) && alone[index(node.element)] != 0)
      apart[n] = 1;
    if (apart[n] != 0 && node.parent != none<TreeNodeId>)
      apart[index(node.parent)] = 1;
  }
  std::vector<TreeNodeId> nodes;
  std::vector<std::uint8_t> below(tree.nodes.size(), 0); // of one of them, or below it
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const TreeNode& node = tree.nodes[n];
    if (node.parent != none<TreeNodeId> && below[index(node.parent)] != 0) {
      below[n] = 1;
    } else if (is_leaf(node) || (node.leaf_count <= most_elements && apart[n] == 0)) {
      below[n] = 1;
      nodes.push_back(static_cast<TreeNodeId>(n));
    }
  }
  return nodes;
}

namespace {

/// The largest node above that has at most so many elements, or the node itself.
TreeNodeId group_of(const NodeTree& tree, TreeNodeId node, std::uint32_t most_elements) {
  for (TreeNodeId above = tree.nodes[index(node)].parent;
       above != none<TreeNodeId> && tree.nodes[index(above)].leaf_count <= most_elements;
       above = tree.nodes[index(above)].parent)
    node = above;
  return node;
}

/// Light that arrives at elements, and what they reflect of it, W.
struct Powers {
  double arriving = 0.0, reflected = 0.0;

  void add(const Powers& more) {
    arriving += more.arriving;
    reflected += more.reflected;
  }
};

Powers powers_at(const ElementMesh& mesh, std::span<const ElementId> elements, const Rgb& light) {
  Powers powers;
  for (const ElementId element : elements) {
    const std::size_t e = index(element);
    powers.add(
        {mesh.area[e] * largest(light), mesh.area[e] * largest(mesh.reflectance[e] * light)});
  }
  return powers;
}

/// Of the nodes those, by their place, in groups of nodes at which a large part of all light
/// arrives, or that reflect a large part: where a lamp throws a spot, few points would tell
/// how bright it is, and beside a lamp corners do not tell what black surfaces absorb.
/// Whole groups, as those of its nodes that were dark by chance lie at its edge.
std::vector<std::size_t> brightest_nodes(const LightScene& light, const NodeTree& tree,
                                         std::span<const TreeNodeId> nodes,
                                         std::span<const ArrivingLight> arriving,
                                         std::span<const std::uint8_t> of_few_points) {
  constexpr std::size_t groups = 512;
  constexpr double large = 1.0 / 256.0;
  const auto most = static_cast<std::uint32_t>(element_count(light.mesh) / groups);
  std::vector<Powers> of_group(tree.nodes.size());
  Powers all;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Powers powers = powers_at(light.mesh, elements_below(tree, nodes[k]), arriving[k].total);
    of_group[index(group_of(tree, nodes[k], most))].add(powers);
    all.add(powers);
  }
  std::vector<std::size_t> brightest;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Powers& group = of_group[index(group_of(tree, nodes[k], most))];
    const bool is_bright =
        group.arriving > large * all.arriving || group.reflected > large * all.reflected;
    if (of_few_points[k] != 0 && is_bright)
      brightest.push_back(k);
  }
  return brightest;
}

/// Means of a few nodes, by their place, take the place of those of few points.
void find_again(std::span<const std::size_t> nodes,
                const std::function<ArrivingLight(std::size_t, SharedLightWorkspace&)>& mean,
                const Progress& progress, MeansOfAreas& means, std::vector<std::uint8_t>& few) {
  const MeansOfAreas again = means_of_areas(
      nodes.size(), [&](std::size_t k, SharedLightWorkspace& work) { return mean(nodes[k], work); },
      progress);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    means.light[nodes[k]] = again.light[k];
    few[nodes[k]] = 0;
  }
  means.shadow_rays += again.shadow_rays;
}

} // namespace

DirectIrradiance light_by_nodes(const LightScene& light, const NodeTree& tree,
                                std::span<const CoveredCells> covered,
                                const DirectSettings& settings, const Progress& progress) {
  const std::size_t size = element_count(light.mesh);
  DirectIrradiance result;
  result.irradiance.assign(size, Rgb(0.0));
  result.shared.assign(size, 0);
  if (light.emitters.empty() && light.punctual.empty())
    return result;
  result.punctual.resize(light.punctual.empty() ? 0 : size);

  std::vector<std::uint8_t> alone(size, 0);
  if (const VertexElements facets = facets_around(light); !facets.elements.empty())
    alone = averaged_facets(light.mesh, facets);
  for (std::size_t e = 0; e < size; ++e)
    if (covered[e] != 0)
      alone[e] = 1;
  const std::vector<TreeNodeId> nodes = nodes_lit_together(tree, most_lit_together(size), alone);
  std::vector<std::uint8_t> few;
  for (const TreeNodeId id : nodes) {
    const TreeNode& node = tree.nodes[index(id)];
    few.push_back(is_leaf(node) && alone[index(node.element)] != 0 ? 0 : 1);
  }
  const DirectSettings shared =
      shared_out(settings, static_cast<std::size_t>(std::ranges::count(few, 1)));

  const auto mean = [&](std::size_t k, const DirectSettings& of_node, SharedLightWorkspace& work) {
    const TreeNode& node = tree.nodes[index(nodes[k])];
    if (!is_leaf(node))
      return direct_irradiance(light, area_of(light, node), index(nodes[k]), of_node, work);
    const std::size_t e = index(node.element);
    return direct_irradiance(light, node.element, covered[e], alone[e] != 0 ? settings : of_node,
                             work);
  };
  MeansOfAreas means = means_of_areas(
      nodes.size(),
      [&](std::size_t k, SharedLightWorkspace& work) { return mean(k, shared, work); }, progress);
  if (shared.points == settings.points)
    std::ranges::fill(few, 0);
  else
    find_again(
        brightest_nodes(light, tree, nodes, means.light, few),
        [&](std::size_t k, SharedLightWorkspace& work) { return mean(k, settings, work); },
        progress, means, few);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (const ElementId element : elements_below(tree, nodes[k])) {
      result.irradiance[index(element)] = means.light[k].total;
      result.shared[index(element)] = few[k];
      if (!result.punctual.empty())
        result.punctual[index(element)] = means.light[k].punctual;
    }
  result.shadow_rays = means.shadow_rays;
  return result;
}

std::vector<ElementId> lit_with(const NodeTree& tree, std::span<const ElementId> elements) {
  const std::uint32_t most = most_lit_together(tree.elements.size());
  std::vector<std::uint8_t> are_lit(tree.elements.size(), 0);
  for (const ElementId element : elements)
    are_lit[index(element)] = 1;
  std::vector<ElementId> result;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const TreeNode& node = tree.nodes[n];
    const auto id = static_cast<TreeNodeId>(n);
    if (node.leaf_count > most && !is_leaf(node))
      continue;
    const bool is_group = group_of(tree, id, most) == id;
    const auto below = elements_below(tree, id);
    if (is_group && std::ranges::any_of(below, [&](ElementId e) { return are_lit[index(e)] != 0; }))
      result.insert(result.end(), below.begin(), below.end());
  }
  return result;
}

void light_again(const LightScene& light, std::span<const ElementId> elements,
                 std::span<const CoveredCells> covered, const DirectSettings& settings,
                 const Progress& progress, DirectIrradiance& direct) {
  const MeansOfAreas means = means_of_areas(
      elements.size(),
      [&](std::size_t k, SharedLightWorkspace& work) {
        return direct_irradiance(light, elements[k], covered[index(elements[k])], settings, work);
      },
      progress);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::size_t e = index(elements[k]);
    direct.irradiance[e] = means.light[k].total;
    if (!direct.shared.empty())
      direct.shared[e] = 0;
    if (!direct.punctual.empty())
      direct.punctual[e] = means.light[k].punctual;
  }
  direct.shadow_rays += means.shadow_rays;
}

} // namespace meninas
