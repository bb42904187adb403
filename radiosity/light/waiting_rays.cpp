#include "radiosity/light/waiting_rays.h"

#include "radiosity/light/portal_light.h"
#include "radiosity/light/virtual_light_visibility.h"

#include <algorithm>
#include <numeric>

namespace meninas {

namespace {

/// Keeps what has blocked a ray to the image.
void cache_occluder(const Lighting& light, const LegBlocker& by, ImageSum& image) {
  ImageOccluders& blockers = *image.blockers;
  if (by.triangle == none<TriangleId> || blockers.too_many())
    return;
  const PatchId patch = light.scene.surfaces.patch_of_triangle[index(by.triangle)];
  const auto is_it = [&](const CachedOccluder& blocker) {
    return blocker.patch == patch && blocker.leg == by.leg;
  };
  if (std::ranges::any_of(blockers.known, is_it) || std::ranges::any_of(blockers.met, is_it))
    return;
  if (auto blocker = blocker_of(light.scene, image.world, light.emitters[image.emitter], by))
    blockers.met.push_back(*std::move(blocker));
}

/// The rays by their number of mirrors, fewest first, in order where these are as many.
void put_in_order(WaitingRays& waiting) {
  std::vector<std::uint32_t>& begin = waiting.first_with;
  begin.assign(1, 0);
  for (const WaitingRay& ray : waiting.rays) {
    const auto next = static_cast<std::size_t>(ray.mirrors) + 1;
    if (begin.size() <= next)
      begin.resize(next + 1, 0);
    ++begin[next];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  waiting.order.resize(waiting.rays.size());
  for (std::uint32_t k = 0; k < waiting.rays.size(); ++k)
    waiting.order[begin[static_cast<std::size_t>(waiting.rays[k].mirrors)]++] = k;
}

} // namespace

void trace_waiting(const Lighting& light, const Receiver& receiver, WaitingRays& waiting,
                   std::vector<ImageSum>& images, DirectWorkspace& work) {
  put_in_order(waiting);
  std::array<LegBlocker, 16> blockers;
  for (std::size_t first = 0; first < waiting.rays.size();) {
    const auto count =
        static_cast<std::uint32_t>(std::min<std::size_t>(16, waiting.rays.size() - first));
    for (std::uint32_t k = 0; k < count; ++k) {
      const WaitingRay& ray = waiting.rays[waiting.order[first + k]];
      fold(light.scene, ray.world, {ray.from, ray.to, receiver.plane_class, ray.arriving},
           work.folded[k], solids_before(light.emitters[images[ray.image].emitter]));
    }
    const std::uint32_t dark =
        blocked(light.scene, work.folded, count, work.shadow_rays, &blockers);
    for (std::uint32_t k = 0; k < count; ++k) {
      const WaitingRay& ray = waiting.rays[waiting.order[first + k]];
      ImageSum& image = images[ray.image];
      image.all += ray.weight;
      if (((dark >> k) & 1U) != 0U) {
        if (image.blockers)
          cache_occluder(light, blockers[k], image);
        continue;
      }
      image.seen += ray.weight;
      const Rgb left = transmittance_between(light.scene, end_of(receiver), {}, work.folded[k]) *
                       shown_by(light.scene, light.emitters[image.emitter], work.folded[k]);
      image.left += ray.weight * left;
      image.squares += ray.weight * largest(left) * largest(left);
    }
    first += count;
  }
  waiting.rays.clear();
}

} // namespace meninas
