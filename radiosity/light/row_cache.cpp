#include "radiosity/light/row_cache.h"

#include <algorithm>

namespace meninas {

void append(const GatheredRays& more, GatheredRays& result) {
  result.landings.insert(result.landings.end(), more.landings.begin(), more.landings.end());
  result.rays += more.rays;
  result.landed += more.landed;
  result.escaped += more.escaped;
  result.black += more.black;
  result.cut += more.cut;
  result.escaped_straight += more.escaped_straight;
  result.sky += more.sky;
  result.sky_straight += more.sky_straight;
  result.owned_light += more.owned_light;
  result.owned_straight += more.owned_straight;
  result.by_portals += more.by_portals;
  result.mirror_absorbed += more.mirror_absorbed;
  result.escaped_light += more.escaped_light;
  result.black_light += more.black_light;
  result.cut_light += more.cut_light;
}

void RowCache::make_room(std::span<const std::uint32_t> vertices, std::size_t rays_each) {
  for (const std::uint32_t v : vertices) {
    if (rays_each > room_)
      return;
    if (v >= places_.size())
      places_.resize(std::size_t{v} + 1, nowhere);
    if (places_[v] != nowhere)
      continue;
    places_[v] = static_cast<std::uint32_t>(rays_.size());
    rays_.emplace_back();
    room_ -= rays_each;
  }
}

VertexRays* RowCache::of(std::uint32_t vertex) {
  return vertex < places_.size() && places_[vertex] != nowhere ? &rays_[places_[vertex]] : nullptr;
}

} // namespace meninas
