#include "radiosity/transport/ray_comb.h"

#include "scenes/sampling.h"

#include <limits>

namespace meninas {

std::size_t max_rays(const Bounces& bounces) {
  constexpr std::size_t unlimited_bounces = 64;
  if (bounces.done <= unlimited_bounces)
    return std::numeric_limits<std::size_t>::max();
  return unlimited_bounces * bounces.sent_on / bounces.done;
}

void comb_rays(std::vector<MirroredRay>& rays, const Bounces& bounces, std::uint32_t seed) {
  if (rays.size() <= max_rays(bounces))
    return;
  const std::uint32_t key = hash(seed, static_cast<std::uint32_t>(bounces.done), 0xc03b);
  std::size_t kept = 0;
  for (std::size_t k = 0; k + 1 < rays.size(); k += 2) {
    const MirroredRay &a = rays[k], &b = rays[k + 1];
    const float both = a.weight + b.weight;
    const float u = 0x1p-24F * static_cast<float>(hash(key, static_cast<std::uint32_t>(k)) >> 8U);
    MirroredRay one = u * both < a.weight ? a : b;
    one.weight = both;
    rays[kept++] = one;
  }
  if (rays.size() % 2 == 1)
    rays[kept++] = rays.back();
  rays.erase(rays.begin() + static_cast<std::ptrdiff_t>(kept), rays.end());
}

} // namespace meninas
