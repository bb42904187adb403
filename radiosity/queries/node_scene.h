// A scene as rays see it that are to find form factors between nodes: a mesh of whole patches.
#pragma once

#include "radiosity/queries/node_sets.h"
#include "radiosity/transport/form_factor_rows.h"
#include "radiosity/scene/light_scene.h"

namespace meninas {

/// Where rays are to land: on those sides of those sets of nodes.
struct AskedSides {
  std::span<const NodeSet> nodes;
  NodeSides sides = NodeSides::facing;
};

/// One element for each side: enough to know whose it is.
/// A mirror's landing is known by its table.
struct NodeScene {
  NodeScene(const Scene& scene, const SurfaceModel& surfaces, const MirrorSet& mirrors,
            const AskedSides& to, int max_depth);
  NodeScene(const NodeScene&) = delete;
  NodeScene& operator=(const NodeScene&) = delete;

  std::size_t group_count;
  ElementMesh mesh;
  std::vector<std::uint32_t> groups; ///< by SideId: the place of its set among those asked for
  RayScene rays;
  WorldTree worlds;
  LightScene light;
  FormFactorSettings settings;
};

/// Throws UsageError when nothing can land on one of the sets.
void require_landings(const NodeScene& scene, const AskedSides& to);

} // namespace meninas
