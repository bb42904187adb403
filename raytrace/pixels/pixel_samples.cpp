#include "raytrace/pixels/pixel_samples.h"

#include "raytrace/beams/packet_reflection.h"
#include "raytrace/beams/coherent_beams.h"
#include "raytrace/specular_paths.h"
#include "raytrace/wide_lanes.h"
#include "scenes/sampling.h"

#include <algorithm>

namespace meninas {

namespace {

/// Samples of one or more pixels, lane by lane.
struct alignas(64) SampleLanes {
  std::array<std::uint32_t, packet_size> bits_x, bits_y; ///< of the place in the pixel
  std::array<std::uint32_t, packet_size> bits_u, bits_v; ///< of that on the lens, if there is one
  std::array<float, packet_size> left, top;              ///< of the pixel in the picture, in pixels
  std::array<std::uint32_t, packet_size> pixel, number;
  std::uint32_t count = 0;
};

/// The path of a full packet, if it has one and that is known.
const CoherentBeam* path_of_all(const CoherentBeams& sure, const SampleLanes& lanes) {
  const std::uint16_t path = sure.path_of[lanes.pixel[0]];
  if (path == CoherentBeams::unknown || lanes.count != packet_size)
    return nullptr;
  // Pixels come in their order.
  if (lanes.pixel.front() != lanes.pixel.back())
    for (const std::uint32_t pixel : lanes.pixel)
      if (sure.path_of[pixel] != path)
        return nullptr;
  return &sure.paths[path];
}

/// Places in the picture, from 0 to 1, of samples at `bits` / 2^32 of pixels that begin at `start`.
MENINAS_WIDE_LANES
void places_in_picture(const std::array<std::uint32_t, packet_size>& bits,
                       const std::array<float, packet_size>& start, int pixels,
                       const FilterPlaces* filter, std::array<float, packet_size>& places) {
  const float pixel = 1.0F / static_cast<float>(pixels);
  for (std::size_t k = 0; k < packet_size; ++k)
    places[k] = static_cast<float>(static_cast<std::int32_t>(bits[k] >> 8U)) * 0x1p-24F;
  if (filter)
    for (float& place : places)
      place = place_of(*filter, place);
  for (std::size_t k = 0; k < packet_size; ++k)
    places[k] = (start[k] + places[k]) * pixel;
}

/// Points of the disc, as evenly spread as those of the square.
std::array<glm::vec2, packet_size> places_on_lens(const SampleLanes& lanes) {
  std::array<glm::vec2, packet_size> places;
  for (std::size_t k = 0; k < packet_size; ++k)
    places[k] = concentric_disc(static_cast<float>(lanes.bits_u[k] >> 8U) * 0x1p-24F,
                                static_cast<float>(lanes.bits_v[k] >> 8U) * 0x1p-24F);
  return places;
}

void set_rays(const RenderContext& context, const SampleLanes& lanes,
              const std::array<float, packet_size>& x, const std::array<float, packet_size>& y,
              RayPacket& packet) {
  if (is_panorama(context.camera.projection)) {
    alignas(64) std::array<float, packet_size> middle;
    for (std::size_t k = 0; k < packet_size; ++k)
      middle[k] = (lanes.left[k] + 0.5F) / static_cast<float>(context.settings.width);
    set_panorama_rays(packet, context.camera, x, y, middle);
    return;
  }
  set_camera_rays(packet, context.camera, x, y);
  if (!context.net_u.empty())
    start_on_lens(packet, context.camera, places_on_lens(lanes));
}

void trace_samples(const RenderContext& context, const SampleLanes& lanes, TileWorkspace& work) {
  alignas(64) std::array<float, packet_size> x, y;
  places_in_picture(lanes.bits_x, lanes.left, context.settings.width, context.filter, x);
  places_in_picture(lanes.bits_y, lanes.top, context.settings.height, context.filter, y);
  RayPacket packet;
  packet.count = lanes.count;
  const LaneState state{lanes.pixel.data(), nullptr, lanes.bits_x.data(), lanes.number.data()};
  if (const CoherentBeam* path = path_of_all(work.sure, lanes)) {
    HitPacket hits;
    land_surely(*path, x, y, hits);
    shade_behind_mirrors(context, packet, state, *path, hits, work);
    return;
  }
  set_rays(context, lanes, x, y, packet);
  trace_together(context, packet, state, work);
  // Lobes send many rays on: what is under way stays within memory.
  constexpr std::size_t max_queued = 1 << 17;
  if (work.next.size() > max_queued)
    follow_mirrors(context, work);
}

} // namespace

std::vector<std::uint32_t> pixel_net(const SampleRange& range, std::size_t d) {
  std::vector<std::uint32_t> net;
  for (int k = range.first; k < range.first + range.count; ++k)
    net.push_back(
        static_cast<std::uint32_t>(sobol4(static_cast<std::uint32_t>(k), 0)[d] * 0x1p32F));
  return net;
}

void trace_camera_rays(const RenderContext& context, const TileArea& tile, TileWorkspace& work) {
  const auto samples = static_cast<std::uint32_t>(context.net_x.size());
  const auto pixels = static_cast<std::uint32_t>(tile.width * tile.height);
  std::uint64_t traced = 0;
  find_coherent_beams(context, tile, work.sure);
  SampleLanes lanes{};
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const int px = tile.x0 + static_cast<int>(pixel) % tile.width,
              py = tile.y0 + static_cast<int>(pixel) / tile.width;
    if (!is_chosen(context, px, py))
      continue;
    ++traced;
    const std::uint32_t shift_x =
        hash(static_cast<std::uint32_t>(px), static_cast<std::uint32_t>(py), context.settings.seed);
    const std::uint32_t shift_y = hash(shift_x, 1);
    for (std::uint32_t sample = 0; sample < samples;) {
      const std::uint32_t first = lanes.count;
      const auto count =
          std::min(static_cast<std::uint32_t>(packet_size) - first, samples - sample);
      for (std::uint32_t k = 0; k < count; ++k)
        lanes.bits_x[first + k] = context.net_x[sample + k] ^ shift_x;
      for (std::uint32_t k = 0; k < count; ++k)
        lanes.bits_y[first + k] = context.net_y[sample + k] ^ shift_y;
      for (std::uint32_t k = 0; k < count && !context.net_u.empty(); ++k) {
        lanes.bits_u[first + k] = context.net_u[sample + k] ^ hash(shift_x, 2);
        lanes.bits_v[first + k] = context.net_v[sample + k] ^ hash(shift_x, 3);
      }
      for (std::uint32_t k = 0; k < count; ++k)
        lanes.number[first + k] = context.first_sample + sample + k;
      std::fill_n(lanes.left.begin() + first, count, static_cast<float>(px));
      std::fill_n(lanes.top.begin() + first, count, static_cast<float>(py));
      std::fill_n(lanes.pixel.begin() + first, count, pixel);
      sample += count;
      lanes.count = first + count;
      if (lanes.count < packet_size)
        continue;
      trace_samples(context, lanes, work);
      lanes.count = 0;
    }
  }
  if (lanes.count > 0)
    trace_samples(context, lanes, work);
  work.camera_rays += traced * samples;
}

} // namespace meninas
