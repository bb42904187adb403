#include "raytrace/tiles.h"

#include "raytrace/beams/coherent_beams.h"
#include "raytrace/pixels/picture_window.h"
#include "raytrace/pixels/pixel_samples.h"
#include "raytrace/specular_paths.h"
#include "scenes/materials/lobes.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace meninas {

namespace {

void render_tile(const RenderContext& context, const TileArea& tile, TileWorkspace& work,
                 const StorePixel& store) {
  for (auto& sums : work.sums)
    sums.assign(static_cast<std::size_t>(tile.width * tile.height), glm::vec3(0.0F));
  work.next.clear();
  work.area = tile;
  trace_camera_rays(context, tile, work);
  follow_mirrors(context, work);
  const float share = 1.0F / static_cast<float>(context.net_x.size());
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      if (!is_chosen(context, tile.x0 + x, tile.y0 + y))
        continue;
      const auto pixel = static_cast<std::size_t>(y * tile.width + x);
      store(
          tile.x0 + x, tile.y0 + y,
          {share * work.sums[0][pixel], share * work.sums[1][pixel], share * work.sums[2][pixel]});
    }
}

} // namespace

static FilterPlaces places_of(const RenderSettings& settings) {
  return settings.filter == PixelFilter::box ? FilterPlaces{} : filter_places(settings.filter);
}

/// As RenderContext::blurred.
static std::vector<std::uint8_t> blurred_worlds(const LightScene& light) {
  std::vector<std::uint8_t> blurred;
  for (const MirrorWorld& world : light.worlds.worlds)
    blurred.push_back(std::ranges::any_of(world.chain, [&](MirrorId mirror) {
      return light.mirrors.mirrors[index(mirror)].has_width;
    }));
  return blurred;
}

/// Refers to all it is given.
static RenderContext context_of(const TracedView& view, const SampleShare& share,
                                const FilterPlaces& places) {
  const auto& [light, visible, gathering, camera, settings] = view;
  const double aspect = double(settings.width) / settings.height;
  RenderContext context{light,
                        visible,
                        gathering,
                        settings,
                        make_camera_frame(camera, aspect, light.rays.frame()),
                        pixel_net(share.samples, 0),
                        pixel_net(share.samples, 1),
                        share.pixels,
                        settings.filter == PixelFilter::box ? nullptr : &places,
                        static_cast<double>(share.samples.first + share.samples.count),
                        static_cast<std::uint32_t>(share.samples.first),
                        {},
                        {},
                        blurred_worlds(light),
                        {},
                        {},
                        {}};
  if (context.camera.lens_x != glm::vec3(0.0F)) {
    context.net_u = pixel_net(share.samples, 2);
    context.net_v = pixel_net(share.samples, 3);
  }
  // The rays of a lobe share the pixel:
  // what one of them sees of a shadow, the others see differently.
  context.behind_lobes = settings.diffuse;
  context.behind_lobes.direct.shadow_rays = context.behind_lobes.direct.penumbra_rays = 1;
  context.behind_lobes.direct.images = context.behind_lobes.direct.solid_rays = 2;
  if (std::ranges::any_of(light.scene.materials, has_lobes))
    for (const Material& material : light.scene.materials)
      context.bsdfs.push_back(make_bsdf(material, untextured(material)));
  return context;
}

/// Beyond so many triangles a tile's rays are traced sooner than it is known what comes near it,
/// or little of that would be certain.
static std::size_t max_frustum_faces(const RenderSettings& settings, std::size_t samples) {
  constexpr std::size_t pixels = std::size_t{tile_size} * tile_size;
  const std::size_t tiles =
      std::max<std::size_t>(1, static_cast<std::size_t>(settings.width) *
                                   static_cast<std::size_t>(settings.height) / pixels);
  return pixels * samples / std::max(rays_to_a_face, rays_to_a_piece / tiles);
}

static RayTotals totals_of(const tbb::enumerable_thread_specific<TileWorkspace>& workspaces) {
  RayTotals totals;
  for (const auto& work : workspaces) {
    totals.camera += work.camera_rays;
    totals.specular += work.specular_rays;
    totals.sure += work.sure_rays;
    totals.shadow += work.point.direct.shadow_rays;
    totals.gather += work.point.rays;
  }
  return totals;
}

RayTotals trace_picture(const TracedView& view, const SampleShare& share, const Progress& progress,
                        const StorePixel& store) {
  const RenderSettings& settings = view.settings;
  const FilterPlaces places = places_of(settings);
  RenderContext context = context_of(view, share, places);
  if (is_affine(context.camera))
    context.frustum_faces =
        frustum_faces(view.light, max_frustum_faces(settings, context.net_x.size()));
  const PictureWindow window =
      share.window ? *share.window : PictureWindow{0, 0, settings.width, settings.height};
  const int columns = (window.width + tile_size - 1) / tile_size,
            rows = (window.height + tile_size - 1) / tile_size;
  tbb::enumerable_thread_specific<TileWorkspace> workspaces;
  std::atomic<int> done{0};
  tbb::parallel_for(0, columns * rows, [&](int t) {
    const int x0 = window.x + t % columns * tile_size, y0 = window.y + t / columns * tile_size;
    const TileArea tile{x0, y0, std::min(tile_size, settings.width - x0),
                        std::min(tile_size, settings.height - y0)};
    TileWorkspace& work = workspaces.local();
    render_tile(context, tile, work, store);
    if (progress)
      progress("render", double(++done) / (columns * rows));
  });
  return totals_of(workspaces);
}

RayTotals trace_pixels(const TracedView& view, std::span<const glm::ivec2> pixels,
                       const StorePixel& store) {
  const RenderSettings& settings = view.settings;
  const FilterPlaces places = places_of(settings);
  const RenderContext context = context_of(view, {{0, std::max(settings.samples, 1)}}, places);
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const std::size_t run = std::clamp<std::size_t>(pixels.size() / threads, 1, 32);
  tbb::enumerable_thread_specific<TileWorkspace> workspaces;
  tbb::parallel_for(std::size_t{0}, (pixels.size() + run - 1) / run, [&](std::size_t first) {
    TileWorkspace& work = workspaces.local();
    for (std::size_t k = run * first; k < std::min(run * (first + 1), pixels.size()); ++k) {
      const auto keep = [&](int, int, const SeenRadiance& seen) {
        store(static_cast<int>(k), 0, seen);
      };
      render_tile(context, {pixels[k].x, pixels[k].y, 1, 1}, work, keep);
    }
  });
  return totals_of(workspaces);
}

void add(Rendering& rendering, const RayTotals& rays) {
  rendering.camera_rays += rays.camera;
  rendering.specular_rays += rays.specular;
  rendering.sure_rays += rays.sure;
  rendering.shadow_rays += rays.shadow;
  rendering.gather_rays += rays.gather;
}

} // namespace meninas
