#include "radiosity/light/waiting_rays.h"

#include "radiosity/light/portal_light.h"
#include "radiosity/light/shared_light.h"
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

/// The waiting rays by their number of mirrors, fewest first, in order where these are as many.
void order_waiting(SharedLightWorkspace& work) {
  std::vector<std::uint32_t>& begin = work.first_with;
  begin.assign(1, 0);
  for (const WaitingRay& ray : work.waiting) {
    const auto next = static_cast<std::size_t>(ray.mirrors) + 1;
    if (begin.size() <= next)
      begin.resize(next + 1, 0);
    ++begin[next];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  work.order.resize(work.waiting.size());
  for (std::uint32_t k = 0; k < work.waiting.size(); ++k)
    work.order[begin[static_cast<std::size_t>(work.waiting[k].mirrors)]++] = k;
}

} // namespace

void trace_waiting(const Lighting& light, const Receiver& receiver, SharedLightWorkspace& work) {
  order_waiting(work);
  std::array<LegBlocker, 16> blockers;
  for (std::size_t first = 0; first < work.waiting.size();) {
    const auto count =
        static_cast<std::uint32_t>(std::min<std::size_t>(16, work.waiting.size() - first));
    for (std::uint32_t k = 0; k < count; ++k) {
      const WaitingRay& ray = work.waiting[work.order[first + k]];
      fold(light.scene, ray.world, {ray.from, ray.to, receiver.plane_class, ray.arriving},
           work.point.folded[k], solids_before(light.emitters[work.images[ray.image].emitter]));
    }
    const std::uint32_t dark =
        blocked(light.scene, work.point.folded, count, work.point.shadow_rays, &blockers);
    for (std::uint32_t k = 0; k < count; ++k) {
      const WaitingRay& ray = work.waiting[work.order[first + k]];
      ImageSum& image = work.images[ray.image];
      image.all += ray.weight;
      if (((dark >> k) & 1U) != 0U) {
        if (image.blockers)
          cache_occluder(light, blockers[k], image);
        continue;
      }
      image.seen += ray.weight;
      const Rgb left = transmittance_between(light.scene, end_of(receiver), {}, work.point.folded[k]) *
                       shown_by(light.scene, light.emitters[image.emitter], work.point.folded[k]);
      image.left += ray.weight * left;
      image.squares += ray.weight * largest(left) * largest(left);
    }
    first += count;
  }
  work.waiting.clear();
}

} // namespace meninas
