#include "reference/light_layers.h"

#include <algorithm>
#include <cmath>

namespace meninas::reference {

namespace {

constexpr std::size_t seen_ways = 3;

double sum_where(const LayerLuminances& batch, const LayerChoice& counts) {
  double sum = 0.0;
  for (std::size_t layer = 0; layer < layer_count; ++layer)
    if (counts(layer_name(layer)))
      sum += batch[layer];
  return sum;
}

} // namespace

std::string layer_name(std::size_t layer) {
  constexpr std::array arrivals{"emission", "diffuse.direct", "diffuse.mirrored"};
  constexpr std::array ways{"", ".mirror", ".mirrors"};
  return std::string(arrivals[layer / seen_ways]) + ways[layer % seen_ways];
}

Rgb sum_of(const LayerRadiance& layers) {
  Rgb sum(0.0);
  for (const Rgb& radiance : layers)
    sum += radiance;
  return sum;
}

LightRoute scattered(LightRoute route) {
  ++route.scatterings;
  return route;
}

LightRoute reflected(LightRoute route, std::size_t mirrors) {
  if (route.scatterings == 0)
    route.mirrors_seen += mirrors;
  if (route.scatterings == 1)
    route.last_leg_mirrors += mirrors;
  return route;
}

std::size_t layer_of(const LightRoute& route) {
  const std::size_t way = std::min(route.mirrors_seen, seen_ways - 1);
  const std::size_t arrival = route.scatterings == 0 ? 0 : route.last_leg_mirrors == 0 ? 1 : 2;
  return arrival * seen_ways + way;
}

Share share_of(const std::vector<LayerLuminances>& batches, const LayerChoice& part,
               const LayerChoice& whole) {
  expects(batches.size() >= 2, "one batch says nothing about its error");
  double parts = 0.0, wholes = 0.0;
  for (const LayerLuminances& batch : batches) {
    parts += sum_where(batch, part);
    wholes += sum_where(batch, whole);
  }
  if (wholes == 0.0)
    return {};
  const double share = parts / wholes;
  double squares = 0.0;
  for (const LayerLuminances& batch : batches) {
    const double residual = sum_where(batch, part) - share * sum_where(batch, whole);
    squares += residual * residual;
  }
  // sum / (m (m - 1)) / (wholes / m)^2
  const auto m = double(batches.size());
  return {share, std::sqrt(squares * m / (m - 1.0)) / wholes};
}

} // namespace meninas::reference
