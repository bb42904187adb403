#include "radiosity/field/emission_kernels.h"

#include <algorithm>

namespace meninas {

namespace {

constexpr std::uint32_t enough_hits = 16, max_rings = 16;

bool is_resolved(const VertexEmission& emission) { return emission.hits >= enough_hits; }

/// The vertices around one, ring by ring.
struct Neighbourhood {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> ring_begin; ///< in `vertices`, by ring; one longer
  std::vector<std::uint32_t> met;        ///< by ElementVertexId: one more than the centre met it last
};

/// Values of few vertices of a mesh.
class SparseEmission {
public:
  explicit SparseEmission(std::size_t count) : places_(count, 0) {}

  /// The value of v, 0 at first.
  VertexEmission& of(std::uint32_t v) {
    if (places_[v] == 0) {
      values_.push_back({.vertex = v});
      places_[v] = static_cast<std::uint32_t>(values_.size());
    }
    return values_[places_[v] - 1];
  }
  const VertexEmission* find(std::uint32_t v) const {
    return places_[v] == 0 ? nullptr : &values_[places_[v] - 1];
  }
  const std::vector<VertexEmission>& values() const { return values_; }

private:
  std::vector<std::uint32_t> places_; // by ElementVertexId: one more than the place among the values, or 0
  std::vector<VertexEmission> values_;
};

struct Spreading {
  const SparseEmission& gathered;
  std::span<const std::uint8_t> taken;
  const VertexSamples& found;

  bool is_taken(std::uint32_t v) const { return taken[v] != 0; }

  double area_around(std::uint32_t v) const {
    double sum = 0.0;
    for (const ElementId element : around(found.around, v))
      sum += found.mesh.area[index(element)];
    return sum;
  }

  /// Rings around u until they hold enough hits; light that is resolved bounds them.
  void gather_rings(const VertexEmission& centre, Neighbourhood& near) const {
    const std::uint32_t u = centre.vertex;
    near.vertices.assign(1, u);
    near.ring_begin.assign({0, 1});
    near.met[u] = u + 1;
    std::uint32_t hits = centre.hits;
    for (std::uint32_t ring = 1; ring <= max_rings && hits < enough_hits; ++ring) {
      const std::uint32_t begin = near.ring_begin[ring - 1], end = near.ring_begin[ring];
      for (std::uint32_t k = begin; k < end; ++k)
        for (const ElementId element : around(found.around, near.vertices[k]))
          for (const ElementVertexId corner : found.mesh.corners[index(element)]) {
            const std::uint32_t v = index(corner);
            if (near.met[v] == u + 1)
              continue;
            const VertexEmission* const there = gathered.find(v);
            if (there != nullptr && is_resolved(*there))
              continue;
            near.met[v] = u + 1;
            near.vertices.push_back(v);
            hits += there != nullptr && is_taken(v) ? there->hits : 0;
          }
      near.ring_begin.push_back(static_cast<std::uint32_t>(near.vertices.size()));
      if (near.ring_begin[ring + 1] == near.ring_begin[ring])
        break;
    }
  }

  /// Adds what the centre has gathered to its neighbourhood.
  void spread(const VertexEmission& centre, const Neighbourhood& near, SparseEmission& result) const {
    const std::size_t rings = near.ring_begin.size() - 1;
    const auto each = [&](const auto& act) {
      for (std::size_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t k = near.ring_begin[ring]; k < near.ring_begin[ring + 1]; ++k)
          if (is_taken(near.vertices[k]))
            act(near.vertices[k], 1.0 - static_cast<double>(ring) / static_cast<double>(rings));
    };
    const auto add = [&](std::uint32_t v, float share) {
      VertexEmission& to = result.of(v);
      to.total += share * centre.total;
      to.mirrored += share * centre.mirrored;
    };
    double all = 0.0;
    each([&](std::uint32_t v, double weight) { all += weight * area_around(v); });
    if (!(all > 0.0))
      return add(centre.vertex, 1.0F);
    const double own = area_around(centre.vertex) / all;
    each([&](std::uint32_t v, double weight) { add(v, static_cast<float>(own * weight)); });
  }
};

/// Takes `to` in place of `from`. Sums of floats less one of their terms may be a rounding below zero.
void change(const VertexEmission& to, const VertexEmission& from, VertexIrradiance& field) {
  const std::size_t v = to.vertex;
  const auto change_one = [v](std::vector<glm::vec3>& values, const glm::vec3& by) {
    values[v] = glm::max(values[v] + by, glm::vec3(0.0F));
  };
  change_one(field.irradiance, to.total - from.total);
  change_one(field.indirect, to.total - from.total);
  change_one(field.mirrored, to.mirrored - from.mirrored);
  change_one(field.indirect_mirrored, to.mirrored - from.mirrored);
}

} // namespace

void spread_emission(std::span<const VertexEmission> gathered, std::span<const std::uint8_t> taken,
                     VertexSamples& found) {
  const auto is_spread = [&](const VertexEmission& emission) {
    return taken[emission.vertex] != 0 && !is_resolved(emission);
  };
  if (std::ranges::none_of(gathered, is_spread))
    return;
  const std::size_t count = found.states.size();
  SparseEmission before(count), after(count);
  for (const VertexEmission& emission : gathered)
    before.of(emission.vertex) = emission;
  const Spreading by{before, taken, found};
  Neighbourhood near;
  near.met.assign(count, 0);
  for (const VertexEmission& emission : gathered) {
    if (taken[emission.vertex] == 0)
      continue;
    VertexEmission& own = after.of(emission.vertex);
    if (is_resolved(emission)) {
      own.total += emission.total;
      own.mirrored += emission.mirrored;
      continue;
    }
    by.gather_rings(emission, near);
    by.spread(emission, near, after);
  }
  for (const VertexEmission& emission : after.values()) {
    const VertexEmission* const from = before.find(emission.vertex);
    change(emission, from != nullptr ? *from : VertexEmission{}, found.field);
  }
}

} // namespace meninas
