#include "radiosity/field/adaptive/source_field.h"

#include "radiosity/field/vertex_light.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

namespace meninas {

SamplePoint mean_of_two(const SamplePoint& sample) {
  return
      [sample](const Receiver& receiver, double element_size, std::uint32_t seed) -> PointSample {
        const PointSample a = sample(receiver, element_size, seed),
                          b = sample(receiver, element_size, ~seed);
        const ArrivingLight sum = a.light + b.light;
        const double apart = 0.5 * largest(glm::abs(a.light.total - b.light.total));
        return {{0.5 * sum.total, 0.5 * sum.mirrored}, std::min(a.cover, b.cover), apart * apart};
      };
}

SourceField field_from_source(const LightScene& light, std::span<const double> weight,
                              const FormFactorSettings& form_factors, const DirectSettings& asked,
                              const RefinementSettings& refinement) {
  constexpr double outline_step = 0.125; // of a root cell
  // At the rim of a penumbra, where the first rays may all agree by chance,
  // points must not say now dark, now bright.
  DirectSettings direct = asked;
  direct.shadow_rays = std::max(asked.shadow_rays, asked.penumbra_rays / 2);
  DirectSettings few = asked;
  few.penumbra_rays = std::max(1, asked.penumbra_rays / 4);
  few.shadow_rays = std::min(few.shadow_rays, few.penumbra_rays);
  tbb::enumerable_thread_specific<PointWorkspace> workspaces;
  const auto sampled_with = [&](const DirectSettings& settings) -> SamplePoint {
    return [&](const Receiver& receiver, double element_size, std::uint32_t seed) -> PointSample {
      PointWorkspace& work = workspaces.local();
      const ArrivingLight arrived =
          direct_irradiance(light, receiver, settings, hash(seed, settings.seed, 1), work.direct);
      // A dark point may be inside something that stands on its surface, which a few rays tell.
      if (arrived.total == Rgb(0.0))
        return {arrived,
                clearance_of_unlit(light, form_factors, receiver, element_size, seed, work)};
      return {arrived,
              is_under_something(light, receiver, element_size) ? Cover::low : Cover::open};
    };
  };
  const SamplePoint sample = sampled_with(direct);
  const IsOpenPoint is_open = [&](const Receiver& receiver, double element_size,
                                  std::uint32_t seed) {
    return !is_nearly_under_something(light, receiver, element_size) &&
           sample(receiver, element_size, seed).cover == Cover::open;
  };
  const auto outlines = mirror_outlines(light, outline_step * light.mesh.element_size);
  SourceField found{refine_field(light, {sample, mean_of_two(sample), is_open, sampled_with(few)},
                                 weight, outlines, refinement)};
  for (const auto& work : workspaces) {
    found.form_factor_rays += work.rays;
    found.shadow_rays += work.direct.shadow_rays;
  }
  return found;
}

} // namespace meninas
