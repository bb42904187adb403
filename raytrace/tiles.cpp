#include "raytrace/tiles.h"

#include "raytrace/pixel_samples.h"
#include "raytrace/specular_paths.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace meninas {

namespace {

constexpr int tile_size = 32; ///< pixels square

void render_tile(const RenderContext& context, const TileArea& tile, TileWorkspace& work,
                 const StorePixel& store) {
  for (auto& sums : work.sums)
    sums.assign(static_cast<std::size_t>(tile.width * tile.height), glm::vec3(0.0F));
  work.next.clear();
  work.way = 0;
  trace_camera_rays(context, tile, work);
  follow_mirrors(context, work);
  const float share = 1.0F / static_cast<float>(context.net_x.size());
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * tile.width + x);
      store(
          tile.x0 + x, tile.y0 + y,
          {share * work.sums[0][pixel], share * work.sums[1][pixel], share * work.sums[2][pixel]});
    }
}

} // namespace

RayTotals trace_picture(const LightScene& light, const VisibleLight& visible,
                        const PointGathering* gathering, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress,
                        const StorePixel& store) {
  const double aspect = double(settings.width) / settings.height;
  const RenderContext context{light,
                              visible,
                              gathering,
                              settings,
                              make_camera_frame(camera, aspect, light.rays.frame()),
                              pixel_net(settings.samples, 0),
                              pixel_net(settings.samples, 1)};
  const int columns = (settings.width + tile_size - 1) / tile_size,
            rows = (settings.height + tile_size - 1) / tile_size;
  tbb::enumerable_thread_specific<TileWorkspace> workspaces;
  std::atomic<int> done{0};
  tbb::parallel_for(0, columns * rows, [&](int t) {
    const int x0 = t % columns * tile_size, y0 = t / columns * tile_size;
    const TileArea tile{x0, y0, std::min(tile_size, settings.width - x0),
                        std::min(tile_size, settings.height - y0)};
    render_tile(context, tile, workspaces.local(), store);
    if (progress)
      progress("render", double(++done) / (columns * rows));
  });
  RayTotals totals;
  for (const auto& work : workspaces) {
    totals.camera += work.camera_rays;
    totals.specular += work.specular_rays;
    totals.shadow += work.point.direct.shadow_rays;
    totals.gather += work.point.rays;
  }
  return totals;
}

void add(Rendering& rendering, const RayTotals& rays) {
  rendering.camera_rays += rays.camera;
  rendering.specular_rays += rays.specular;
  rendering.shadow_rays += rays.shadow;
  rendering.gather_rays += rays.gather;
}

} // namespace meninas
