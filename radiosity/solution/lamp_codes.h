// The light of a lamp at vertices as a file keeps it: 12 bytes a vertex.
//
// Direct and indirect irradiance have six bytes each: three mantissas of 14 bits with the exponent of
// the brightest channel, of 6 bits, as EXT_texture_shared_exponent has them with fewer (after Ward 1991):
//
//   H_c = m_c / 16383 * 2^(x + top - 63),     top of the whole lamp
//
// The error is at most 2^-14 of the brightest channel at the vertex; what is 2^-63 of the lamp's brightest is 0.
#pragma once

#include "radiosity/field/irradiance_field.h"

#include <cstdint>
#include <span>
#include <vector>

namespace meninas {

struct LampCodes {
  int top = 0;                      ///< 2^top is more than the lamp has anywhere
  std::vector<std::uint8_t> bytes; ///< direct, then indirect, six of each vertex
};

LampCodes encoded(const VertexLightOfLamp& light);

/// `bytes` are twelve times the vertices.
VertexLightOfLamp decoded(int top, std::span<const std::uint8_t> bytes);

} // namespace meninas
