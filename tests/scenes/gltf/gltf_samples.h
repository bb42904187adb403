// Files that use all the loader reads, for tests that break them and for the fuzzer to begin with.
#pragma once

#include "tests/scenes/gltf/gltf_file.h"

namespace meninas::test {

/// Sparse and strided accessors, strips, tangents, textures with their transform,
/// cameras, a light, extensions of materials, a tree of nodes.
GltfFile everything();

/// The square, all of it following joint 1 of two, whose node is node 2.
GltfFile skinned_square();

/// The square with two morph targets and default weights.
GltfFile morphed_square();

/// Adds an animation of one channel, LINEAR, STEP or CUBICSPLINE: keys at these times, in seconds,
/// with four numbers each of rotations, three of translations and scales, one for each weight.
void animate(GltfFile& file, std::size_t node, const std::string& path,
             const std::string& interpolation, const std::vector<float>& times,
             const std::vector<float>& values);

/// The morphed square with a channel of every kind in one second.
GltfFile animated_square();

/// Two copies of the square: moved, turned and scaled.
GltfFile instanced_square();

/// A square of three materials, of films, sheen, coats, cloth and tinted glass, which is a lamp under a cube of sky.
GltfFile layered_square();

/// A square with a specular-glossiness material and a WebP texture that is none.
GltfFile old_material();

} // namespace meninas::test
