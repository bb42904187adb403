// Hashes of everything form factors depend on: stored rows T_ij (factor_file.h) are those of a scene and settings
// with the same key, but for one chance in 2^64. They do not depend on emission and diffuse reflectances.
#pragma once

#include "radiosity/transport/form_factors.h"

#include <cstdint>

namespace meninas {

/// The hashes of the parts that form factors were made from.
struct FactorKey {
  std::uint64_t geometry = 0; ///< vertices, triangles, which sides of them are there
  std::uint64_t mirrors =
      0; ///< which triangles are mirrors, their reflectances, the enumerated worlds
  std::uint64_t mesh = 0;     ///< sides and elements
  std::uint64_t sky = 0;      ///< of a picture of the sky: rows hold what windows and rays have seen of it
  std::uint64_t sampling = 0; ///< all of FormFactorSettings

  bool operator==(const FactorKey&) const = default;
};
FactorKey factor_key(const LightScene& light, const FormFactorSettings& settings);

} // namespace meninas
