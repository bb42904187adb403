#include "raytrace/error/probes.h"

#include "raytrace/pixels/sample_choice.h"
#include "scenes/sampling.h"
#include "scenes/seconds_of_one.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace meninas {

ProbedPixels render_pixels(const IrradianceField& field, const Camera& camera,
                           const RenderSettings& settings, std::span<const glm::ivec2> pixels) {
  ProbedPixels probed;
  probed.radiance.resize(pixels.size());
  const VisibleLight all = visible_light(field, field_content(field, settings.diffuse));
  const auto gathering = make_gathering(field, settings.diffuse);
  const RayTotals rays = trace_pixels({*field.scene, all, gathering.get(), camera, settings},
                                      pixels, [&](int place, int, const SeenRadiance& seen) {
                                        probed.radiance[static_cast<std::size_t>(place)] =
                                            seen[0] + seen[1] + seen[2];
                                      });
  probed.rays = rays.camera + rays.specular + rays.shadow + rays.gather;
  return probed;
}

Image first_picture(const LightScene& light, const VisibleLight& visible, const Camera& camera,
                    const RenderSettings& settings) {
  Image image(settings.width, settings.height);
  trace_picture({light, visible, nullptr, camera, settings}, {first_samples(settings)}, {},
                [&](int x, int y, const SeenRadiance& seen) {
                  image.at(x, y) = seen[0] + seen[1] + seen[2];
                });
  return image;
}

/// The emission that pixels show.
static Image emission_picture(const IrradianceField& field,
                              const Camera& camera, const RenderSettings& settings) {
  VisibleLight glow = visible_light(field, FieldContent::all);
  glow.part = ReflectedPart::none;
  for (SideShading& side : glow.shading)
    side.albedo_over_pi = side.passed_over_pi = glm::vec3(0.0F);
  return first_picture(*field.scene, glow, camera, settings);
}

std::vector<std::uint8_t> emitter_pixels(const IrradianceField& field,
                                         const Camera& camera, RenderSettings settings,
                                         const Image& picture, int samples) {
  constexpr float share = 0.05F;
  settings.samples = samples;
  settings.diffuse.term = DiffuseTerm::interpolated;
  const Image emission = emission_picture(field, camera, settings);
  const int width = picture.width, height = picture.height;
  std::vector<std::uint8_t> near(picture.pixels.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 glow = emission.at(x, y), seen = picture.at(x, y);
      if (glow.r + glow.g + glow.b <= share * (seen.r + seen.g + seen.b))
        continue;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
          near[static_cast<std::size_t>(v * width + u)] = 1;
    }
  if (std::ranges::find(near, 0) == near.end())
    std::ranges::fill(near, std::uint8_t{0});
  return near;
}

double camera_ray_seconds(const std::shared_ptr<const LightScene>& light, const Camera& camera,
                          RenderSettings settings) {
  constexpr std::uint32_t some = 1024;
  IrradianceField field;
  field.irradiance.assign(light->mesh.vertices.size(), glm::vec3(1.0F));
  field.scene = light;
  field.mirrored = field.indirect = field.indirect_mirrored = field.irradiance;
  settings.samples = std::min(settings.samples, 16);
  settings.layers = WithLayers::no;
  const VisibleLight all = visible_light(field, field_content(field, settings.diffuse));
  const auto gathering = make_gathering(field, settings.diffuse);
  std::vector<glm::ivec2> pixels;
  for (std::uint32_t k = 0; k < some; ++k) {
    const auto at = sobol4(k, 0xc057);
    pixels.emplace_back(
        std::min(static_cast<int>(at[0] * float(settings.width)), settings.width - 1),
        std::min(static_cast<int>(at[1] * float(settings.height)), settings.height - 1));
  }
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  return seconds_of_one(some, threads,
                        [&](std::size_t first, std::size_t last) {
                          trace_pixels({*light, all, gathering.get(), camera, settings},
                                       std::span(pixels).subspan(first, last - first),
                                       [](int, int, const SeenRadiance&) {});
                        }) /
         settings.samples;
}

} // namespace meninas
