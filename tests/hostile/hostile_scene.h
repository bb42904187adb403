// A whole glTF file from a seed: hostile shapes (hostile_shapes.h) in a room or in the open, at any
// scale, of all materials, under all lights, seen from inside, from corners and from far away.
//
// It is a file, not a Scene, so that what the loader decides (which triangles have an area, how far
// positions are rounded) is as for users, and so that a finding can be given to the program.
#pragma once

#include "tests/scenes/gltf/gltf_file.h"

namespace meninas::test {

/// The same for the same seed, on every machine.
GltfFile hostile_scene(std::uint32_t seed);

} // namespace meninas::test
