// The picture tile by tile: tiles run in parallel, and each writes its own pixels.
#pragma once

#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"

#include <functional>
#include <span>

namespace meninas {

using StorePixel = std::function<void(int x, int y, const SeenRadiance&)>;

struct RayTotals {
  std::uint64_t camera = 0, specular = 0, shadow = 0, gather = 0;
  std::uint64_t sure = 0; ///< of the camera and specular ones, not traced (coherent_beams.h)
};

/// Some samples of some pixels.
struct SampleShare {
  SampleRange samples;
  const PixelMask* pixels = nullptr; ///< null: all
  const PictureWindow* window = nullptr; ///< of whole tiles, whose pixels alone are traced; null: all
};

/// The scene, field and camera that pixels are traced of.
struct TracedView {
  const LightScene& light;
  const VisibleLight& visible;
  const PointGathering* gathering; ///< of the diffuse term `gather`, else null
  const Camera& camera;
  const RenderSettings& settings;
};

/// The means over those samples of what is visible,
/// pixel by pixel, handed to `store` from any thread.
RayTotals trace_picture(const TracedView& view, const SampleShare& share, const Progress& progress,
                        const StorePixel& store);

/// The pixels of a list alone, the same values but for roundings, in its order;
/// `store` is told the place in the list as x.
RayTotals trace_pixels(const TracedView& view, std::span<const glm::ivec2> pixels,
                       const StorePixel& store);

void add(Rendering& rendering, const RayTotals& rays);

} // namespace meninas
