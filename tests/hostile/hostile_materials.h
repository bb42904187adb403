// Materials of all kinds that the loader reads, with factors at their ends as often as between them.
#pragma once

#include "tests/scenes/gltf/gltf_file.h"
#include "tests/support/random.h"

namespace meninas::test {

/// A material as glTF has it: diffuse, metal, glass, translucent, with holes, coats, sheen, films.
Json hostile_material(Random& random);

/// 0, 1, or a number between them.
double hostile_factor(Random& random);
/// As often grey as not.
Rgb hostile_colour(Random& random);

Json as_json(const Vec3& v);

} // namespace meninas::test
