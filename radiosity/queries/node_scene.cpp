#include "radiosity/queries/node_scene.h"

#include "radiosity/mesh/make_mesh.h"
#include "scenes/errors.h"

#include <algorithm>

namespace meninas {

namespace {

/// By SideId: the place of its set among those asked for, where its side is.
std::vector<std::uint32_t> groups_of_sides(const Scene& scene, const ElementMesh& mesh,
                                           const AskedSides& to) {
  const std::vector<std::uint32_t> sets = sets_of_nodes(scene, to.nodes);
  std::vector<std::uint32_t> groups(mesh.sides.size(), none_of_sets);
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const std::uint32_t set = sets[index(mesh.sides[s].node)];
    if (set != none_of_sets && may_count(to.sides, mesh.sides[s].facing == Facing::front))
      groups[s] = set;
  }
  return groups;
}

WorldTree named_worlds(const MirrorSet& mirrors, int max_depth) {
  WorldSettings settings;
  settings.max_depth = std::min(settings.max_depth, max_depth);
  return mirror_worlds(mirrors, settings);
}

} // namespace

NodeScene::NodeScene(const Scene& scene, const SurfaceModel& surfaces, const MirrorSet& mirrors,
                     const AskedSides& to, int max_depth)
    : group_count(to.nodes.size()),
      mesh(make_element_mesh(scene, surfaces, {.target_elements = 1.0})),
      groups(groups_of_sides(scene, mesh, to)), rays(make_ray_scene(scene, surfaces)),
      worlds(named_worlds(mirrors, max_depth)),
      light(make_light_scene(scene, surfaces, rays, {mirrors, worlds}, mesh)) {
  settings.max_bounces = std::min(settings.max_bounces, max_depth);
}

void require_landings(const NodeScene& scene, const AskedSides& to) {
  for (std::uint32_t g = 0; g < to.nodes.size(); ++g)
    if (std::ranges::find(scene.groups, g) == scene.groups.end())
      throw UsageError(scene.light.scene.file,
                       "node '" + scene.light.scene.nodes[index(to.nodes[g].front())].name +
                           "' is a mirror: rays go on through it");
}

} // namespace meninas
