// The format shared by the writer and the reader of solution files (solution_file.h).
#pragma once

#include "radiosity/field/irradiance_field.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <string>

namespace meninas {

/// Raised when what files hold changes: 2 has the light of lamps apart.
inline constexpr int solution_format = 2;

inline constexpr std::size_t vec3_size = sizeof(glm::vec3);
static_assert(vec3_size == 12);

/// The attributes that keep a field; all but the first may be missing.
struct FieldPart {
  const char* attribute;
  std::vector<glm::vec3> VertexIrradiance::*values;
};
inline constexpr FieldPart field_parts[] = {
    {"_IRRADIANCE", &VertexIrradiance::irradiance},
    {"_IRRADIANCE_MIRRORED", &VertexIrradiance::mirrored},
    {"_IRRADIANCE_INDIRECT", &VertexIrradiance::indirect},
    {"_IRRADIANCE_INDIRECT_MIRRORED", &VertexIrradiance::indirect_mirrored}};

inline std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace meninas
