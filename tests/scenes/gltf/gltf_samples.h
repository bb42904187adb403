// Files that use all the loader reads, for tests that break them and for the fuzzer to begin with.
#pragma once

#include "tests/scenes/gltf/gltf_file.h"

namespace meninas::test {

/// Sparse and strided accessors, strips, textures with their transform,
/// cameras, a light, extensions of materials, a tree of nodes.
GltfFile everything();

/// The square, all of it following joint 1 of two, whose node is node 2.
GltfFile skinned_square();

/// The square with two morph targets and default weights.
GltfFile morphed_square();

/// Two copies of the square: moved, turned and scaled.
GltfFile instanced_square();

/// A square with a specular-glossiness material and a WebP texture that is none.
GltfFile old_material();

} // namespace meninas::test
