#include "raytrace/render.h"

#include "raytrace/camera_rays.h"
#include "raytrace/field_shading.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace meninas {

namespace {

constexpr int tile_size = 32; ///< pixels square

/// A specular path that goes on: where, in which pixel of the tile, with what throughput.
struct SpecularRay {
  glm::dvec3 origin, direction; ///< in the frame of the ray scene
  glm::vec3 throughput;
  std::uint32_t pixel;
  std::uint32_t leaving;
};

struct TileWorkspace {
  std::vector<glm::vec3> sums; ///< by pixel of the tile
  std::vector<SpecularRay> current, next;
  std::uint64_t camera_rays = 0, specular_rays = 0;
};

struct TileArea {
  int x0, y0, width, height;
};

/// Everything the tiles share.
struct RenderContext {
  const LightScene& light;
  const DiffuseField& field;
  const RenderSettings& settings;
  CameraFrame camera;
  std::vector<SideShading> shading;
  std::vector<std::array<std::uint32_t, 2>> net; ///< stratified points of the pixel, as integers
};

struct LaneState {
  std::array<glm::dvec3, packet_size> origin, direction;
  std::array<glm::vec3, packet_size> throughput;
  std::array<std::uint32_t, packet_size> pixel;
};

float largest(const glm::vec3& c) { return std::max({c.r, c.g, c.b}); }

/// Adds what each ray has landed on to its pixel, and queues the rays that a mirror sends on.
void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state, const HitPacket& hits,
                  TileWorkspace& work) {
  const LightScene& light = context.light;
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>)) continue;
    const FaceRecord& face = light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
    if (face.side != FaceRecord::nothing) {
      const glm::vec2 uv = landing_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
      work.sums[state.pixel[k]] += state.throughput[k] * field_radiance(light.mesh, context.field, context.shading[face.side],
                                                                        light.landing.sides[face.side], uv);
    }
    if (!face.mirrors || context.settings.mode == RenderMode::radiosity) continue;

    // The path goes on in the mirror world from where it meets the mirror's exact plane.
    SpecularRay ray;
    ray.throughput = state.throughput[k] * face.reflectance;
    if (largest(ray.throughput) < context.settings.min_throughput) continue;
    const glm::dvec3& d = state.direction[k];
    const double approach = glm::dot(face.normal, d);
    double t = (face.frame_offset - glm::dot(face.normal, state.origin[k])) / approach;
    if (!(t > 0.0) || t > 2.0 * hits.distance[k] + 1e-6) t = hits.distance[k];
    ray.origin = state.origin[k] + t * d;
    ray.direction = d - 2.0 * approach * face.normal;
    ray.pixel = state.pixel[k];
    ray.leaving = face.plane_class;
    work.next.push_back(ray);
  }
}

void follow_mirrors(const RenderContext& context, TileWorkspace& work) {
  RayPacket packet;
  HitPacket hits;
  LaneState state;
  for (int bounce = 0; !work.next.empty() && bounce < context.settings.max_bounces; ++bounce) {
    work.current.swap(work.next);
    work.next.clear();
    work.specular_rays += work.current.size();
    for (std::size_t first = 0; first < work.current.size(); first += packet_size) {
      packet.count = static_cast<std::uint32_t>(std::min(packet_size, work.current.size() - first));
      for (std::uint32_t k = 0; k < packet.count; ++k) {
        const SpecularRay& ray = work.current[first + k];
        state.origin[k] = ray.origin;
        state.direction[k] = ray.direction;
        state.throughput[k] = ray.throughput;
        state.pixel[k] = ray.pixel;
        packet.origin_x[k] = static_cast<float>(ray.origin.x);
        packet.origin_y[k] = static_cast<float>(ray.origin.y);
        packet.origin_z[k] = static_cast<float>(ray.origin.z);
        packet.direction_x[k] = static_cast<float>(ray.direction.x);
        packet.direction_y[k] = static_cast<float>(ray.direction.y);
        packet.direction_z[k] = static_cast<float>(ray.direction.z);
        packet.max_distance[k] = std::numeric_limits<float>::infinity();
        packet.leaving[k] = ray.leaving;
      }
      closest_hits(context.light.rays, packet, hits, Backs::absorb, Coherence::coherent);
      shade_packet(context, packet, state, hits, work);
    }
  }
  work.next.clear();
}

/// Camera rays of the tile, pixel by pixel, sixteen at a time.
void trace_camera_rays(const RenderContext& context, const TileArea& tile, TileWorkspace& work) {
  const RenderSettings& settings = context.settings;
  const auto samples = static_cast<std::uint32_t>(context.net.size());
  const std::uint32_t total = static_cast<std::uint32_t>(tile.width * tile.height) * samples;
  const CameraFrame& camera = context.camera;
  RayPacket packet;
  HitPacket hits;
  LaneState state;
  for (std::uint32_t first = 0; first < total; first += packet_size) {
    packet.count = std::min<std::uint32_t>(packet_size, total - first);
    for (std::uint32_t k = 0; k < packet.count; ++k) {
      const std::uint32_t pixel = (first + k) / samples, sample = (first + k) % samples;
      const int px = tile.x0 + static_cast<int>(pixel) % tile.width, py = tile.y0 + static_cast<int>(pixel) / tile.width;
      const std::uint32_t shift_x = hash(static_cast<std::uint32_t>(px), static_cast<std::uint32_t>(py), settings.seed);
      const std::uint32_t shift_y = hash(shift_x, 1);
      const float x = (static_cast<float>(px) + static_cast<float>((context.net[sample][0] ^ shift_x) >> 8U) * 0x1p-24F) / static_cast<float>(settings.width);
      const float y = (static_cast<float>(py) + static_cast<float>((context.net[sample][1] ^ shift_y) >> 8U) * 0x1p-24F) / static_cast<float>(settings.height);
      const glm::vec3 origin = camera.origin + x * camera.origin_x + y * camera.origin_y;
      const glm::vec3 direction = camera.direction + x * camera.direction_x + y * camera.direction_y;
      packet.origin_x[k] = origin.x;
      packet.origin_y[k] = origin.y;
      packet.origin_z[k] = origin.z;
      packet.direction_x[k] = direction.x;
      packet.direction_y[k] = direction.y;
      packet.direction_z[k] = direction.z;
      packet.max_distance[k] = std::numeric_limits<float>::infinity();
      packet.leaving[k] = index(none<PlaneId>);
      state.origin[k] = origin;
      state.direction[k] = direction;
      state.throughput[k] = glm::vec3(1.0F);
      state.pixel[k] = pixel;
    }
    closest_hits(context.light.rays, packet, hits, Backs::transparent, Coherence::coherent);
    shade_packet(context, packet, state, hits, work);
  }
  work.camera_rays += total;
}

void render_tile(const RenderContext& context, const TileArea& tile, TileWorkspace& work, Image& image) {
  work.sums.assign(static_cast<std::size_t>(tile.width * tile.height), glm::vec3(0.0F));
  work.next.clear();
  trace_camera_rays(context, tile, work);
  follow_mirrors(context, work);
  const float share = 1.0F / static_cast<float>(context.net.size());
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x)
      image.at(tile.x0 + x, tile.y0 + y) = share * work.sums[static_cast<std::size_t>(y * tile.width + x)];
}

std::vector<std::array<std::uint32_t, 2>> pixel_net(int samples) {
  std::vector<std::array<std::uint32_t, 2>> net(static_cast<std::size_t>(std::max(samples, 1)));
  for (std::uint32_t k = 0; k < net.size(); ++k) {
    const auto point = sobol4(k, 0);
    net[k] = {static_cast<std::uint32_t>(point[0] * 0x1p32F), static_cast<std::uint32_t>(point[1] * 0x1p32F)};
  }
  return net;
}

} // namespace

Rendering render(const LightScene& light, const DiffuseField& field, const Camera& camera, const RenderSettings& settings,
                 const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  const double aspect = double(settings.width) / settings.height;
  const RenderContext context{light, field, settings, make_camera_frame(camera, aspect, light.rays.frame()),
                              make_side_shading(light.mesh), pixel_net(settings.samples)};
  Rendering result{Image(settings.width, settings.height), 0, 0};
  const int columns = (settings.width + tile_size - 1) / tile_size, rows = (settings.height + tile_size - 1) / tile_size;
  tbb::enumerable_thread_specific<TileWorkspace> workspaces;
  std::atomic<int> done{0};
  tbb::parallel_for(0, columns * rows, [&](int t) {
    const int x0 = t % columns * tile_size, y0 = t / columns * tile_size;
    const TileArea tile{x0, y0, std::min(tile_size, settings.width - x0), std::min(tile_size, settings.height - y0)};
    render_tile(context, tile, workspaces.local(), result.image);
    if (progress) progress("render", double(++done) / (columns * rows));
  });
  for (const auto& work : workspaces) {
    result.camera_rays += work.camera_rays;
    result.specular_rays += work.specular_rays;
  }
  return result;
}

} // namespace meninas
