// Nodes that the file itself does not show.
//
// KHR_node_visibility: a node whose `visible` is false hides its mesh and light and those of
// all nodes below it; cameras and joints stay. MSFT_lod: a node is its own finest level of detail;
// the coarser ones are nodes that it lists, hidden in the same way wherever they stand.
#pragma once

#include "scenes/gltf/document.h"

namespace meninas::gltf {

/// Takes meshes and lights from hidden nodes. The nodes may still be any graph.
void hide_nodes(Json& root, Findings& findings);

} // namespace meninas::gltf
