// Ray hits per vertex, cached so that a second gathering traces only the additional rays.
//
// Where elements are lit by a field that they make themselves (hierarchical/node_field.h)
// vertices gather twice: with few rays, then with many, from other radiosities.
// A net of few rays is the beginning of one of many (hemisphere_samples.h) and a vertex has one seed:
// what the few have met is a part of what the many meet, and only the others are traced then.
// Sums are those of all rays traced at once, but for rounding and for the choices of glass.
// Cache limit: 2^21 rays (about 50 MB); vertices beyond it are traced again.
#pragma once

#include "radiosity/transport/hemisphere_rays.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace meninas {

inline constexpr std::size_t max_cached_rays = std::size_t{1} << 21U;

/// Adds hits of other rays of the same point, traced before: `traced` stays.
void append(const GatheredRays& more, GatheredRays& result);

/// The rays of one vertex.
struct VertexRays {
  GatheredRays rays;                      ///< none: not traced yet
  std::optional<bool> is_under_something; ///< vertex_light.h; none: not asked yet
};

/// The rays of the vertices of one mesh.
class RowCache {
public:
  /// Makes room for the rays of these vertices, so many each, as far as there is any.
  void make_room(std::span<const std::uint32_t> vertices, std::size_t rays_each);

  /// None where there was no room.
  VertexRays* of(std::uint32_t vertex);

private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> places_; ///< in `rays_`, by ElementVertexId
  std::vector<VertexRays> rays_;
  std::size_t room_ = max_cached_rays;
};

} // namespace meninas
