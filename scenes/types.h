// Vocabulary of the whole program: vectors, colours, ids and the one check for programmer errors.
//
// Lengths are metres, right-handed, +Y up. Colours are linear RGB with Rec.709 primaries.
// Radiance L is W/m^2/sr, radiosity and irradiance are W/m^2,
// reflectances and form factors are dimensionless.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <source_location>
#include <string_view>
#include <type_traits>

namespace meninas {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Point3 = glm::dvec3;    ///< a position
using Direction = glm::dvec3; ///< a direction of unit length: a stated precondition wherever it is taken
using Rgb = glm::dvec3;       ///< linear RGB

/// Ids are indices that cannot be mixed up:
/// a patch cannot index elements. `none<Id>` names nothing.
enum class VertexId : std::uint32_t {};
enum class AttributesId : std::uint32_t {};
enum class TriangleId : std::uint32_t {};
enum class MaterialId : std::uint32_t {};
enum class NodeId : std::uint32_t {};
enum class TextureId : std::uint32_t {};
enum class PlaneId : std::uint32_t {};
enum class SurfaceId : std::uint32_t {};
enum class PatchId : std::uint32_t {};

template <typename Id>
inline constexpr Id none = static_cast<Id>(std::numeric_limits<std::uint32_t>::max());

template <typename Id>
  requires std::is_enum_v<Id>
constexpr std::uint32_t index(Id id) {
  return static_cast<std::uint32_t>(id);
}

/// The brightest channel.
template <typename Number>
constexpr Number largest(const glm::vec<3, Number>& c) {
  return std::max({c.r, c.g, c.b});
}

/// Throws std::logic_error with the place of the call
/// when a precondition of the code itself is broken.
/// Bad user data never comes here: it is an InputError.
void expects(bool condition, std::string_view message,
             std::source_location where = std::source_location::current());

} // namespace meninas
