#include "radiosity/field/emission_kernels.h"

#include <algorithm>

namespace meninas {

namespace {

constexpr std::uint32_t enough_hits = 16, max_rings = 16;

/// The vertices around one, ring by ring.
struct Neighbourhood {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> ring_begin; ///< in `vertices`, by ring; one longer
  std::vector<std::uint32_t> met;        ///< by ElementVertexId: one more than the centre met it last
};

struct Spreading {
  const GatheredEmission& gathered;
  std::span<const std::uint8_t> taken;
  const VertexSamples& found;

  bool is_taken(std::uint32_t v) const { return taken[v] != 0; }
  bool is_resolved(std::uint32_t v) const { return gathered.hits[v] >= enough_hits; }

  double area_around(std::uint32_t v) const {
    double sum = 0.0;
    for (const ElementId element : around(found.around, v))
      sum += found.mesh.area[index(element)];
    return sum;
  }

  /// Rings around u until they hold enough hits; light that is resolved bounds them.
  void gather_rings(std::uint32_t u, Neighbourhood& near) const {
    near.vertices.assign(1, u);
    near.ring_begin.assign({0, 1});
    near.met[u] = u + 1;
    std::uint32_t hits = gathered.hits[u];
    for (std::uint32_t ring = 1; ring <= max_rings && hits < enough_hits; ++ring) {
      const std::uint32_t begin = near.ring_begin[ring - 1], end = near.ring_begin[ring];
      for (std::uint32_t k = begin; k < end; ++k)
        for (const ElementId element : around(found.around, near.vertices[k]))
          for (const ElementVertexId corner : found.mesh.corners[index(element)]) {
            const std::uint32_t v = index(corner);
            if (near.met[v] == u + 1 || is_resolved(v))
              continue;
            near.met[v] = u + 1;
            near.vertices.push_back(v);
            hits += is_taken(v) ? gathered.hits[v] : 0;
          }
      near.ring_begin.push_back(static_cast<std::uint32_t>(near.vertices.size()));
      if (near.ring_begin[ring + 1] == near.ring_begin[ring])
        break;
    }
  }

  /// Adds what u has gathered to its neighbourhood.
  void spread(std::uint32_t u, const Neighbourhood& near, GatheredEmission& result) const {
    const std::size_t rings = near.ring_begin.size() - 1;
    const auto each = [&](const auto& act) {
      for (std::size_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t k = near.ring_begin[ring]; k < near.ring_begin[ring + 1]; ++k)
          if (is_taken(near.vertices[k]))
            act(near.vertices[k], 1.0 - static_cast<double>(ring) / static_cast<double>(rings));
    };
    double all = 0.0;
    each([&](std::uint32_t v, double weight) { all += weight * area_around(v); });
    if (!(all > 0.0)) {
      result.total[u] += gathered.total[u];
      result.mirrored[u] += gathered.mirrored[u];
      return;
    }
    const double own = area_around(u) / all;
    each([&](std::uint32_t v, double weight) {
      result.total[v] += static_cast<float>(own * weight) * gathered.total[u];
      result.mirrored[v] += static_cast<float>(own * weight) * gathered.mirrored[u];
    });
  }
};

} // namespace

void spread_emission(const GatheredEmission& gathered, std::span<const std::uint8_t> taken,
                     VertexSamples& found) {
  const Spreading by{gathered, taken, found};
  const std::size_t count = gathered.hits.size();
  GatheredEmission result(count);
  Neighbourhood near;
  near.met.assign(count, 0);
  bool any = false;
  for (std::uint32_t u = 0; u < count; ++u) {
    if (!by.is_taken(u) || gathered.hits[u] == 0)
      continue;
    if (by.is_resolved(u)) {
      result.total[u] += gathered.total[u];
      result.mirrored[u] += gathered.mirrored[u];
      continue;
    }
    any = true;
    by.gather_rings(u, near);
    by.spread(u, near, result);
  }
  if (!any)
    return;
  VertexIrradiance& field = found.field;
  for (std::size_t v = 0; v < count; ++v) {
    if (taken[v] == 0)
      continue;
    // Sums of floats less one of their terms may be a rounding below zero.
    const auto change = [](glm::vec3& value, const glm::vec3& to, const glm::vec3& from) {
      value = glm::max(value + (to - from), glm::vec3(0.0F));
    };
    change(field.irradiance[v], result.total[v], gathered.total[v]);
    change(field.indirect[v], result.total[v], gathered.total[v]);
    change(field.mirrored[v], result.mirrored[v], gathered.mirrored[v]);
    change(field.indirect_mirrored[v], result.mirrored[v], gathered.mirrored[v]);
  }
}

} // namespace meninas
