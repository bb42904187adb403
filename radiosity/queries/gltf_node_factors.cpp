#include "radiosity/queries/gltf_node_factors.h"

#include "radiosity/queries/node_sides.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

namespace {

/// Every mirror has its worlds here: they are entered only as far as they matter.
constexpr MirrorSettings every_mirror{.max_mirrors = 1 << 20, .smallest_share = 0.0};

std::vector<std::uint8_t> marked(const Scene& scene, const NodeSet& nodes) {
  std::vector<std::uint8_t> mark(scene.nodes.size(), 0);
  for (const NodeId node : nodes)
    mark[index(node)] = 1;
  return mark;
}

const std::string& name_of(const Scene& scene, const NodeSet& nodes) {
  return scene.nodes[index(nodes.front())].name;
}

struct Senders {
  std::vector<Face> faces;
  bool mirrors_left_out = false;
};

Senders scattering_faces(const Scene& scene, const std::vector<Face>& faces, const NodeSet& from) {
  const auto mark = marked(scene, from);
  Senders senders;
  for (const Face& face : faces) {
    if (mark[index(face.node)] == 0)
      continue;
    if (is_mirror(scene.materials[index(face.material)]))
      senders.mirrors_left_out = true;
    else
      senders.faces.push_back(face);
  }
  if (senders.faces.empty())
    throw UsageError(
        scene.file,
        fmt::format("node '{}' {}", name_of(scene, from),
                    senders.mirrors_left_out ? "is a mirror, which has no form factors of its own"
                                             : "has no area that could send light"));
  return senders;
}

/// The sides of the faces asked for, with their sets. Throws where one has no face.
void add_targets(const Scene& scene, std::span<const NodeSet> to, NodeSides sides,
                 WorldView& view) {
  const auto sets = sets_of_nodes(scene, to);
  std::vector<std::uint8_t> found(to.size(), 0);
  std::vector<Face> faces;
  for (const Face& face : view.blockers)
    if (const auto set = sets[index(face.node)]; set != none_of_sets) {
      faces.push_back(face);
      found[set] = 1;
    }
  for (std::size_t s = 0; s < to.size(); ++s)
    if (found[s] == 0)
      throw UsageError(scene.file, fmt::format("node '{}' has no area that could receive light",
                                               name_of(scene, to[s])));
  view.targets = without_overlaps(sides_of_faces(scene, faces, sides), view.tolerance);
  for (const Face& face : view.targets)
    view.groups.push_back(sets[index(face.node)]);
}

} // namespace

NodeFactors node_form_factors(const Scene& scene, const SurfaceModel& surfaces, const NodeSet& from,
                              std::span<const NodeSet> to, const NodeFactorSettings& settings) {
  const std::vector<Face> faces = joined_faces(surfaces);
  const Senders candidates = scattering_faces(scene, faces, from);
  NodeFactors result;
  result.mirrors = find_mirrors(scene, surfaces, every_mirror);
  WorldView view{result.mirrors, faces, {}, {}, surfaces.tolerance};
  add_targets(scene, to, settings.sides, view);
  CountedSides counted = counted_sides(
      {scene, surfaces, result.mirrors, faces, to, settings.max_depth, settings.sides},
      candidates.faces);
  if (counted.faces.empty())
    throw UsageError(scene.file,
                     fmt::format("node '{}' is single-sided: its back sends no light",
                                 name_of(scene, from)));
  result.fronts = counted.fronts;
  result.backs = counted.backs;
  result.area = counted.fronts + counted.backs;
  result.not_counted = std::move(counted.not_counted);
  if (candidates.mirrors_left_out)
    result.not_counted.emplace_back("mirrors of the sender do not count");

  switch (settings.method) {
  case NodeFactorMethod::analytic: {
    if (std::ranges::any_of(scene.materials, is_glass))
      throw UsageError(scene.file,
                       "--method analytic takes glass for opaque: rays or hemicubes see "
                       "through it");
    ExtendedSettings extended;
    extended.accuracy = settings.accuracy;
    extended.max_depth = settings.max_depth;
    ExtendedFactors factors = extended_form_factors(view, counted.faces, to.size(), extended);
    result.to = std::move(factors.to);
    result.converged = factors.converged;
    break;
  }
  case NodeFactorMethod::rays:
    result.to = ray_form_factors(scene, surfaces, result.mirrors, counted.faces, to, settings);
    break;
  case NodeFactorMethod::hemicube:
    result.to = hemicube_form_factors(scene, surfaces, result.mirrors, counted.faces, to, settings);
    break;
  }
  return result;
}

} // namespace meninas
