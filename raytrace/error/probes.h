// Single pixels of a picture, and what of it shows emitters:
// what errors are estimated and measured on.
#pragma once

#include "raytrace/field_shading.h"
#include "raytrace/render.h"

#include <cstdint>
#include <span>
#include <vector>

namespace meninas {

struct ProbedPixels {
  std::vector<glm::vec3> radiance; ///< in the order of the list
  std::uint64_t rays = 0;          ///< of every kind
};
/// The pixels (x, y) that `render` would make with these settings:
/// the same rays where light is interpolated, in other packets;
/// with another draw of the samples at hits where it is computed there.
ProbedPixels render_pixels(const IrradianceField& field, const Camera& camera,
                           const RenderSettings& settings, std::span<const glm::ivec2> pixels);

/// A picture of that light, interpolated, by the first samples of every pixel.
Image first_picture(const LightScene& light, const VisibleLight& visible, const Camera& camera,
                    const RenderSettings& settings);

/// By pixel, row by row: 1 where emitted light is more than a twentieth of what `picture` shows,
/// or next to such a pixel. Lamps are far brighter than what they light:
/// an edge of one, a hundredth of a pixel off, is an error that no light transport made.
/// `samples` per pixel look for them. Where everything glows nothing is left out: all are 0.
std::vector<std::uint8_t> emitter_pixels(const IrradianceField& field,
                                         const Camera& camera, RenderSettings settings,
                                         const Image& picture, int samples);

/// Seconds of a camera ray with its diffuse term, by all threads together: t = elapsed / rays, of the rays of a few
/// pixels over a field of ones.
double camera_ray_seconds(const std::shared_ptr<const LightScene>& light, const Camera& camera,
                          RenderSettings settings);

} // namespace meninas
