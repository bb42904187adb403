#include "radiosity/hierarchical/node_light.h"

#include "radiosity/field/curved_means.h"
#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/light/spot_parts.h"

#include <algorithm>

namespace meninas {

/// By ElementVertexId, 1: a corner of a seen element; none where all are seen.
static std::vector<std::uint8_t> corners_of(const ElementMesh& mesh,
                                            std::span<const std::uint8_t> seen) {
  std::vector<std::uint8_t> corners(seen.empty() ? 0 : mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < seen.size(); ++e)
    if (seen[e] != 0)
      for (const ElementVertexId v : mesh.corners[e])
        corners[index(v)] = 1;
  return corners;
}

LitVertices lit_vertices(const LightScene& light, const VertexGathering& how) {
  LitVertices lit{make_samples(light, facets_around(light))};
  if (sends_from_no_face(light))
    lit.found.entering.assign(lit.found.states.size(), glm::vec3(0.0F));
  PointWorkspaces workspaces;
  const std::vector<Rgb> none_yet(element_count(light.mesh), Rgb(0.0));
  const PointGathering gathering = gathering_from(light, none_yet, how);
  const std::vector<std::uint8_t> seen = corners_of(light.mesh, how.seen);
  light_vertices({.irradiance = none_yet,
                  .gathering = gathering,
                  .workspaces = workspaces,
                  .part = {how.progress, "direct light"},
                  .seen = seen},
                 0, lit.found);
  for (const PointWorkspace& work : workspaces) {
    lit.rays += work.rays;
    lit.shadow_rays += work.direct.shadow_rays;
  }
  return lit;
}

namespace {

constexpr std::size_t groups = 512;

/// Elements that have something on them, at a corner too, those in a narrow spot, or whose
/// means are seen.
std::vector<ElementId> by_themselves(const LightScene& light, std::span<const ContactMask> covered,
                                     const VertexSamples& vertices) {
  const ElementMesh& mesh = light.mesh;
  const auto tells = [&](ElementVertexId v) {
    const VertexState state = vertices.states[index(v)];
    return state != VertexState::covered && state != VertexState::smoothed;
  };
  const auto is_at_spot = [&](ElementId element) {
    return !spots_on(mesh, light.worlds, light.punctual, element).empty();
  };
  const bool all = element_count(mesh) <= groups;
  std::vector<ElementId> elements;
  for (std::uint32_t e = 0; e < covered.size(); ++e)
    if (all || covered[e] != 0 || !std::ranges::all_of(mesh.corners[e], tells) ||
        is_at_spot(static_cast<ElementId>(e)))
      elements.push_back(static_cast<ElementId>(e));
  return elements;
}

/// Nodes of at most so many elements, each as large as it can be.
std::vector<TreeNodeId> groups_of(const NodeTree& tree, std::uint32_t max_elements) {
  std::vector<TreeNodeId> nodes;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const TreeNode& node = tree.nodes[n];
    const bool above_is_large = node.parent == none<TreeNodeId> ||
                                tree.nodes[index(node.parent)].leaf_count > max_elements;
    if (above_is_large && (node.leaf_count <= max_elements || is_leaf(node)))
      nodes.push_back(static_cast<TreeNodeId>(n));
  }
  return nodes;
}

/// Light that arrives at elements, and what they reflect of it, W.
struct Powers {
  double arriving = 0.0, reflected = 0.0;
};

Powers powers_at(const ElementMesh& mesh, std::span<const ElementId> elements,
                 const std::vector<Rgb>& irradiance) {
  Powers powers;
  for (const ElementId element : elements) {
    const std::size_t e = index(element);
    powers.arriving += mesh.area[e] * largest(irradiance[e]);
    powers.reflected += mesh.area[e] * largest(scattered_share(mesh, e) * irradiance[e]);
  }
  return powers;
}

/// Elements with the light of their corners in groups at which a large part of all light arrives,
/// or that reflect a large part: where a lamp throws a spot, corners do not tell how bright it is,
/// nor, beside a lamp, what black surfaces absorb.
/// Whole groups, as those of their elements that were dark by chance lie at its edge.
std::vector<ElementId> brightest(const ElementMesh& mesh, const NodeTree& tree,
                                 const DirectIrradiance& direct) {
  constexpr double large = 1.0 / 256.0;
  const std::vector<TreeNodeId> nodes =
      groups_of(tree, static_cast<std::uint32_t>(element_count(mesh) / groups));
  const Powers all = powers_at(mesh, tree.elements, direct.irradiance);
  std::vector<ElementId> elements;
  for (const TreeNodeId node : nodes) {
    const auto below = elements_below(tree, node);
    const Powers powers = powers_at(mesh, below, direct.irradiance);
    if (powers.arriving > large * all.arriving || powers.reflected > large * all.reflected)
      std::ranges::copy_if(below, std::back_inserter(elements),
                           [&](ElementId e) { return direct.shared[index(e)] != 0; });
  }
  return elements;
}

std::vector<Rgb> at_corners(const ElementMesh& mesh, const VertexEdges& edges,
                            std::vector<glm::vec3> values) {
  settle_hanging(mesh, values);
  return curved_means(mesh, edges, values);
}

} // namespace

DirectIrradiance light_by_corners(const LightScene& light, const NodeTree& tree,
                                  std::span<const ContactMask> covered, const VertexSamples& vertices,
                                  const DirectSettings& settings, const Progress& progress) {
  const std::size_t size = element_count(light.mesh);
  DirectIrradiance result;
  if (light.emitters.empty() && light.punctual.empty()) {
    result.irradiance.assign(size, Rgb(0.0));
    result.shared.assign(size, 0);
    if (light.lamps)
      result.by_lamp = no_light(size, light.lamps.count);
    return result;
  }
  const VertexEdges edges = edges_of(light.mesh);
  result.irradiance = at_corners(light.mesh, edges, vertices.field.irradiance);
  if (sends_from_no_face(light))
    result.entering = at_corners(light.mesh, edges, vertices.entering);
  if (light.lamps) {
    result.by_lamp = no_light(size, light.lamps.count);
    for (std::size_t l = 0; l < light.lamps.count; ++l)
      set_light_of_lamp(result.by_lamp, l,
                        at_corners(light.mesh, edges, vertices.field.by_lamp[l].direct));
    add_up_to(result.irradiance, result.by_lamp);
  }
  result.shared.assign(size, 1);
  recompute_direct(light, by_themselves(light, covered, vertices), covered, settings, progress, result);
  recompute_direct(light, brightest(light.mesh, tree, result), covered, settings, progress, result);
  return result;
}

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

void recompute_direct(const LightScene& light, std::span<const ElementId> elements,
                 std::span<const ContactMask> covered, const DirectSettings& settings,
                 const Progress& progress, DirectIrradiance& direct) {
  const MeansOfAreas means = means_of_areas(
      elements.size(), light.lamps.count,
      [&](std::size_t k, SharedLightWorkspace& work) {
        return direct_irradiance(light, elements[k], covered[index(elements[k])], settings, work);
      },
      progress);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::size_t e = index(elements[k]);
    direct.irradiance[e] = means.light[k].total;
    if (!direct.shared.empty())
      direct.shared[e] = 0;
    if (!direct.entering.empty())
      direct.entering[e] = means.light[k].entering;
  }
  if (light.lamps) {
    for (std::size_t k = 0; k < elements.size(); ++k)
      std::ranges::copy(means.by_lamp[k], direct.by_lamp[index(elements[k])].begin());
    add_up_to(direct.irradiance, direct.by_lamp);
  }
  direct.shadow_rays += means.shadow_rays;
}

} // namespace meninas
