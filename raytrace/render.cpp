#include "raytrace/render.h"

#include "raytrace/camera_rays.h"
#include "raytrace/field_shading.h"
#include "raytrace/quad_lanes.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>

namespace meninas {

namespace {

constexpr int tile_size = 32; ///< pixels square

/// A pixel's radiance by how it is seen: straight, in one mirror, by way of several.
constexpr std::size_t seen_ways = 3;
using SeenRadiance = std::array<glm::vec3, seen_ways>;

/// A specular path that goes on: where, in which pixel of the tile, with what throughput.
struct SpecularRay {
  glm::dvec3 origin, direction; ///< in the frame of the ray scene
  glm::vec3 throughput;
  std::uint32_t pixel;
  std::uint32_t leaving;
};

struct TileWorkspace {
  std::array<std::vector<glm::vec3>, seen_ways>
      sums;            ///< by way of seeing, then by pixel of the tile
  std::size_t way = 0; ///< that of the rays under way
  std::vector<SpecularRay> current, next;
  std::uint64_t camera_rays = 0, specular_rays = 0;
};

struct TileArea {
  int x0, y0, width, height;
};

/// Everything the tiles share.
struct RenderContext {
  const LightScene& light;
  const VisibleLight& visible;
  const RenderSettings& settings;
  CameraFrame camera;
  std::vector<std::uint32_t> net_x, net_y; ///< stratified points of the pixel, as integers
};

/// What the rays of a packet carry: camera rays nothing but their pixel, specular rays their record.
struct LaneState {
  const std::uint32_t* pixel;
  const SpecularRay* specular; ///< of lane 0; null for camera rays
};

float largest(const glm::vec3& c) { return std::max({c.r, c.g, c.b}); }

/// The path behind the mirror, from where it meets the mirror's exact plane.
void reflect(const RenderContext& context, const FaceRecord& face, const RayPacket& packet,
             const LaneState& state, std::uint32_t k, float distance, TileWorkspace& work) {
  SpecularRay ray;
  ray.pixel = state.pixel[k];
  ray.leaving = face.plane_class;
  ray.throughput =
      face.reflectance * (state.specular ? state.specular[k].throughput : glm::vec3(1.0F));
  if (largest(ray.throughput) < context.settings.min_throughput)
    return;

  const glm::dvec3 origin =
      state.specular ? state.specular[k].origin
                     : glm::dvec3(packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]);
  const glm::dvec3 d = state.specular ? state.specular[k].direction
                                      : glm::dvec3(packet.direction_x[k], packet.direction_y[k],
                                                   packet.direction_z[k]);
  const double approach = glm::dot(face.normal, d);
  double t = (face.frame_offset - glm::dot(face.normal, origin)) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6)
    t = distance;
  ray.origin = origin + t * d;
  ray.direction = d - 2.0 * approach * face.normal;
  work.next.push_back(ray);
}

const FaceRecord& face_of(const LandingTable& landing, const HitPacket& hits, std::uint32_t k) {
  return landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
}

/// Adds what each ray has landed on to its pixel, and queues the rays that a mirror sends on.
void shade_one_by_one(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                      const HitPacket& hits, TileWorkspace& work) {
  const LightScene& light = context.light;
  const bool mirrors = context.settings.mode == RenderMode::hybrid;
  glm::vec3 sum(0.0F); // of lanes of one pixel in a row
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] != index(none<TriangleId>)) {
      const FaceRecord& face = face_of(light.landing, hits, k);
      if (face.side != FaceRecord::nothing) {
        const glm::vec2 uv = uv_of(light, face, hits, k);
        const glm::vec3 radiance =
            field_radiance(light.mesh, context.visible.irradiance,
                           context.visible.shading[face.side], light.landing.sides[face.side], uv);
        sum += state.specular ? state.specular[k].throughput * radiance : radiance;
      }
      if (face.mirrors && mirrors)
        reflect(context, face, packet, state, k, hits.distance[k], work);
    }
    if (k + 1 < packet.count && state.pixel[k + 1] == state.pixel[k])
      continue;
    work.sums[work.way][state.pixel[k]] += sum;
    sum = glm::vec3(0.0F);
  }
}

/// The common case of sixteen samples of one pixel that land on one quad side. Returns false where they do not.
bool shade_as_one(const RenderContext& context, const LaneState& state, const HitPacket& hits,
                  TileWorkspace& work) {
  std::uint32_t differ = 0;
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= hits.triangle[k] ^ hits.triangle[0];
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= static_cast<std::uint32_t>(hits.front[k] ^ hits.front[0]);
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= state.pixel[k] ^ state.pixel[0];
  if (differ != 0)
    return false;
  if (hits.triangle[0] == index(none<TriangleId>))
    return true;
  const LightScene& light = context.light;
  const FaceRecord& face = face_of(light.landing, hits, 0);
  if (face.mirrors || face.side == FaceRecord::nothing || light.landing.sides[face.side].triangle)
    return false;
  glm::vec3 throughput(1.0F);
  if (state.specular) {
    throughput = state.specular[0].throughput;
    for (std::uint32_t k = 1; k < packet_size; ++k)
      if (state.specular[k].throughput != throughput)
        return false;
  }

  const LanePoints at = land_on_quad(light, face, light.landing.sides[face.side], hits);
  work.sums[work.way][state.pixel[0]] +=
      throughput * quad_radiance(light.mesh, context.visible, face.side, at);
  return true;
}

void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                  const HitPacket& hits, TileWorkspace& work) {
  if (packet.count == packet_size && shade_as_one(context, state, hits, work))
    return;
  shade_one_by_one(context, packet, state, hits, work);
}

void follow_mirrors(const RenderContext& context, TileWorkspace& work) {
  RayPacket packet;
  HitPacket hits;
  std::array<std::uint32_t, packet_size> pixel;
  for (int bounce = 0; !work.next.empty() && bounce < context.settings.max_bounces; ++bounce) {
    work.current.swap(work.next);
    work.next.clear();
    work.way = std::min(work.way + 1, seen_ways - 1);
    work.specular_rays += work.current.size();
    for (std::size_t first = 0; first < work.current.size(); first += packet_size) {
      packet.count = static_cast<std::uint32_t>(std::min(packet_size, work.current.size() - first));
      const LaneState state{pixel.data(), &work.current[first]};
      for (std::uint32_t k = 0; k < packet.count; ++k) {
        const SpecularRay& ray = state.specular[k];
        pixel[k] = ray.pixel;
        set_ray(packet, k, glm::vec3(ray.origin), glm::vec3(ray.direction), ray.leaving);
      }
      closest_hits(context.light.rays, packet, hits, Backs::absorb, Coherence::coherent);
      shade_packet(context, packet, state, hits, work);
    }
  }
  work.next.clear();
}

/// Samples of one or more pixels, lane by lane.
struct alignas(64) SampleLanes {
  std::array<std::uint32_t, packet_size> bits_x, bits_y; ///< of the place in the pixel
  std::array<float, packet_size> left, top;              ///< of the pixel in the picture, in pixels
  std::array<std::uint32_t, packet_size> pixel;
  std::uint32_t count = 0;
};

void trace_samples(const RenderContext& context, const SampleLanes& lanes, TileWorkspace& work) {
  const float pixel_width = 1.0F / static_cast<float>(context.settings.width);
  const float pixel_height = 1.0F / static_cast<float>(context.settings.height);
  const auto unit = [](std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int32_t>(bits >> 8U)) * 0x1p-24F;
  };
  alignas(64) std::array<float, packet_size> x, y;
  for (std::size_t k = 0; k < packet_size; ++k)
    x[k] = (lanes.left[k] + unit(lanes.bits_x[k])) * pixel_width;
  for (std::size_t k = 0; k < packet_size; ++k)
    y[k] = (lanes.top[k] + unit(lanes.bits_y[k])) * pixel_height;
  RayPacket packet;
  HitPacket hits;
  packet.count = lanes.count;
  set_camera_rays(packet, context.camera, x, y);
  closest_hits(context.light.rays, packet, hits, Backs::transparent, Coherence::coherent);
  shade_packet(context, packet, {lanes.pixel.data(), nullptr}, hits, work);
}

/// Camera rays of the tile, pixel by pixel, sixteen at a time.
void trace_camera_rays(const RenderContext& context, const TileArea& tile, TileWorkspace& work) {
  const auto samples = static_cast<std::uint32_t>(context.net_x.size());
  const auto pixels = static_cast<std::uint32_t>(tile.width * tile.height);
  SampleLanes lanes{};
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const int px = tile.x0 + static_cast<int>(pixel) % tile.width,
              py = tile.y0 + static_cast<int>(pixel) / tile.width;
    const std::uint32_t shift_x =
        hash(static_cast<std::uint32_t>(px), static_cast<std::uint32_t>(py), context.settings.seed);
    const std::uint32_t shift_y = hash(shift_x, 1);
    for (std::uint32_t sample = 0; sample < samples;) {
      const std::uint32_t first = lanes.count;
      const auto end = std::min(static_cast<std::uint32_t>(packet_size), first + samples - sample);
      for (std::uint32_t k = first; k < end; ++k) {
        lanes.bits_x[k] = context.net_x[sample + k - first] ^ shift_x;
        lanes.bits_y[k] = context.net_y[sample + k - first] ^ shift_y;
        lanes.left[k] = static_cast<float>(px);
        lanes.top[k] = static_cast<float>(py);
        lanes.pixel[k] = pixel;
      }
      sample += end - first;
      lanes.count = end % packet_size;
      if (lanes.count != 0)
        continue;
      lanes.count = packet_size;
      trace_samples(context, lanes, work);
      lanes.count = 0;
    }
  }
  if (lanes.count > 0)
    trace_samples(context, lanes, work);
  work.camera_rays += std::uint64_t{pixels} * samples;
}

using StorePixel = std::function<void(int x, int y, const SeenRadiance&)>;

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

/// Coordinate d of the stratified points of a pixel.
std::vector<std::uint32_t> pixel_net(int samples, std::size_t d) {
  std::vector<std::uint32_t> net(static_cast<std::size_t>(std::max(samples, 1)));
  for (std::uint32_t k = 0; k < net.size(); ++k)
    net[k] = static_cast<std::uint32_t>(sobol4(k, 0)[d] * 0x1p32F);
  return net;
}

struct RayTotals {
  std::uint64_t camera = 0, specular = 0;
};

/// Every pixel of what is visible, handed to `store` from any thread.
RayTotals trace_picture(const LightScene& light, const VisibleLight& visible, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress,
                        const StorePixel& store) {
  const double aspect = double(settings.width) / settings.height;
  const RenderContext context{light,
                              visible,
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
  }
  return totals;
}

} // namespace

Rendering render(const LightScene& light, const DiffuseField& field, const Camera& camera,
                 const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  if (settings.layers == WithLayers::yes)
    return render_layers(light, field, camera, settings, progress);
  Rendering result;
  result.image = Image(settings.width, settings.height);
  const VisibleLight all{make_side_shading(light.mesh), field.irradiance};
  const RayTotals rays = trace_picture(light, all, camera, settings, progress,
                                       [&](int x, int y, const SeenRadiance& seen) {
                                         result.image.at(x, y) = seen[0] + seen[1] + seen[2];
                                       });
  result.camera_rays = rays.camera;
  result.specular_rays = rays.specular;
  return result;
}

Rendering render_layers(const LightScene& light, const DiffuseField& field, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  expects(field.mirrored.size() == field.irradiance.size(), "the field knows its mirrored part");
  Rendering result;
  result.image = Image(settings.width, settings.height);
  for (const LightPart& part : light_parts(light.mesh, field)) {
    const std::size_t first = result.layers.size();
    for (const char* way : {"", ".mirror", ".mirrors"})
      result.layers.push_back({part.name + way, Image(settings.width, settings.height)});
    const RayTotals rays = trace_picture(light, part.light, camera, settings, progress,
                                         [&](int x, int y, const SeenRadiance& seen) {
                                           for (std::size_t way = 0; way < seen_ways; ++way)
                                             result.layers[first + way].image.at(x, y) = seen[way];
                                         });
    result.camera_rays += rays.camera;
    result.specular_rays += rays.specular;
  }
  for (std::size_t p = 0; p < result.image.pixels.size(); ++p)
    for (const Layer& layer : result.layers)
      result.image.pixels[p] += layer.image.pixels[p];
  return result;
}

} // namespace meninas
