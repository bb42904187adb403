#include "reference/light_layers.h"

#include <algorithm>
#include <cmath>

namespace meninas::reference {

namespace {

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
  return std::string(arrivals[layer / ways.size()]) + ways[layer % ways.size()];
}

Rgb sum_of(const LayerRadiance& layers) {
  Rgb sum(0.0);
  for (const Rgb& radiance : layers)
    sum += radiance;
  return sum;
}

void LightRoutes::take(std::size_t leg, std::size_t way, const Rgb& share) {
  const std::size_t k = leg * way_count + std::min(way, way_count - 1);
  share_[k] = ((some_ >> k) & 1U) != 0 ? share_[k] + share : share;
  some_ |= 1U << k;
}

void LightRoutes::take_mirrored(std::size_t leg, std::size_t way, std::size_t mirrors,
                                const Rgb& share) {
  if (leg == seeing)
    take(seeing, way + mirrors, share);
  else
    take(leg == straight && mirrors > 0 ? mirrored : leg, way, share);
}

LightRoutes LightRoutes::reflected(std::size_t mirrors) const {
  if (mirrors == 0)
    return *this;
  LightRoutes next;
  next.some_ = 0;
  for (std::size_t k = 0; k < share_.size(); ++k)
    if (((some_ >> k) & 1U) != 0)
      next.take_mirrored(k / way_count, k % way_count, mirrors, share_[k]);
  return next;
}

LightRoutes LightRoutes::scattered(const LobeShares& shares) const {
  LightRoutes next;
  next.some_ = 0;
  for (std::size_t k = 0; k < share_.size(); ++k) {
    if (((some_ >> k) & 1U) == 0)
      continue;
    const std::size_t leg = k / way_count, way = k % way_count;
    const std::size_t beyond = leg == seeing ? straight : leg == straight ? straight_done : leg;
    if (const Rgb even = Rgb(1.0) - shares.gloss - shares.glass; even != Rgb(0.0))
      next.take(beyond, way, share_[k] * even);
    if (shares.gloss != Rgb(0.0))
      next.take(leg == seeing ? seeing : beyond, leg == seeing ? way + 1 : way,
                share_[k] * shares.gloss);
    if (shares.glass != Rgb(0.0))
      next.take_mirrored(leg, way, 1, share_[k] * shares.glass);
  }
  return next;
}

void LightRoutes::add(const Rgb& radiance, LayerRadiance& layers) const {
  constexpr std::array<std::size_t, leg_count> arrival{0, 1, 2, 1};
  for (std::size_t k = 0; k < share_.size(); ++k)
    if (((some_ >> k) & 1U) != 0)
      layers[arrival[k / way_count] * way_count + k % way_count] += radiance * share_[k];
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
