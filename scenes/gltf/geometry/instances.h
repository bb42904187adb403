// One mesh in many places:
// EXT_mesh_gpu_instancing, whose accessors hold a translation, rotation and scale for each copy.
#pragma once

#include "scenes/gltf/stages.h"

namespace meninas::gltf {

/// The number of instances of a node's mesh: 1 without the extension.
std::uint64_t instance_count(const Document& document, std::size_t node);

/// World matrices of the copies; the node's own without the extension.
std::vector<glm::dmat4> instance_matrices(const Document& document, const PlacedNode& node);

} // namespace meninas::gltf
