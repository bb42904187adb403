// Form factors as a file, so that a scene under other light is only solved again.
//
// Transport depends on where surfaces are, what mirrors reflect, how the scene is divided
// and how rays are drawn, and not on what emits how much nor on diffuse reflectances:
// those may change, as may cameras and names. What must not change is hashed part by part,
// so that a refusal can say what did. Direct light is computed anew.
//
// Layout, little-endian: magic, version of the program, the hashes,
// the arrays of FormFactors each with its length, and at the end a hash of all bytes before it.
// A file is as large as the factors in memory, and is written whole or not at all.
#pragma once

#include "radiosity/transport/form_factors.h"

#include <filesystem>

namespace meninas {

/// What form factors were made from.
struct FactorKey {
  std::uint64_t geometry = 0; ///< vertices, triangles, which sides of them are there
  std::uint64_t mirrors =
      0; ///< which triangles are mirrors, their reflectances, the enumerated worlds
  std::uint64_t mesh = 0;     ///< sides and elements
  std::uint64_t sampling = 0; ///< all of FormFactorSettings
};
FactorKey factor_key(const LightScene& light, const FormFactorSettings& settings);

void write_factors(const std::filesystem::path& file, const FormFactors& factors,
                   const FactorKey& key);

/// Throws InputError when the file is damaged,
/// of another version of the program, or made from something else than `key`.
FormFactors read_factors(const std::filesystem::path& file, const FactorKey& key);

} // namespace meninas
