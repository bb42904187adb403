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

/// What the rays of a packet carry: camera rays nothing but their pixel, specular rays their record.
struct LaneState {
  std::array<std::uint32_t, packet_size> pixel;
  const SpecularRay* specular = nullptr; ///< of lane 0; null for camera rays
};

float largest(const glm::vec3& c) { return std::max({c.r, c.g, c.b}); }

/// The path behind the mirror, from where it meets the mirror's exact plane.
void reflect(const RenderContext& context, const FaceRecord& face, const RayPacket& packet, const LaneState& state,
             std::uint32_t k, float distance, TileWorkspace& work) {
  SpecularRay ray;
  ray.pixel = state.pixel[k];
  ray.leaving = face.plane_class;
  ray.throughput = face.reflectance * (state.specular ? state.specular[k].throughput : glm::vec3(1.0F));
  if (largest(ray.throughput) < context.settings.min_throughput) return;

  const glm::dvec3 origin = state.specular ? state.specular[k].origin
                                           : glm::dvec3(packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]);
  const glm::dvec3 d = state.specular ? state.specular[k].direction
                                      : glm::dvec3(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
  const double approach = glm::dot(face.normal, d);
  double t = (face.frame_offset - glm::dot(face.normal, origin)) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6) t = distance;
  ray.origin = origin + t * d;
  ray.direction = d - 2.0 * approach * face.normal;
  work.next.push_back(ray);
}

const FaceRecord& face_of(const LandingTable& landing, const HitPacket& hits, std::uint32_t k) {
  return landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
}

/// Adds what each ray has landed on to its pixel, and queues the rays that a mirror sends on.
void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state, const HitPacket& hits,
                  TileWorkspace& work) {
  const LightScene& light = context.light;
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>)) continue;
    const FaceRecord& face = face_of(light.landing, hits, k);
    if (face.side != FaceRecord::nothing) {
      const glm::vec2 uv = landing_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
      const glm::vec3 radiance = field_radiance(light.mesh, context.field, context.shading[face.side], light.landing.sides[face.side], uv);
      work.sums[state.pixel[k]] += state.specular ? state.specular[k].throughput * radiance : radiance;
    }
    if (face.mirrors && context.settings.mode == RenderMode::hybrid) reflect(context, face, packet, state, k, hits.distance[k], work);
  }
}

/// The common case of sixteen samples of one pixel that land in one element: the bilinear field is linear in the means of s, t
/// and s t, so one look-up gives the exact sum. Returns false where the samples are not so.
bool shade_as_one(const RenderContext& context, const HitPacket& hits, std::uint32_t pixel, TileWorkspace& work) {
  const LightScene& light = context.light;
  std::uint32_t differ = 0;
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= (hits.triangle[k] ^ hits.triangle[0]) | static_cast<std::uint32_t>(hits.front[k] ^ hits.front[0]);
  if (differ != 0) return false;
  if (hits.triangle[0] == index(none<TriangleId>)) return true;
  const FaceRecord& face = face_of(light.landing, hits, 0);
  if (face.mirrors || !face.affine || face.side == FaceRecord::nothing) return false;
  const SideRecord& side = light.landing.sides[face.side];
  if (side.triangle) return false;

  // The span of the samples in units of elements; it lies in one element when its bounds do.
  const auto nu = static_cast<float>(side.nu), nv = static_cast<float>(side.nv);
  float low_u = nu, high_u = 0.0F, low_v = nv, high_v = 0.0F, sum_u = 0.0F, sum_v = 0.0F, sum_uv = 0.0F;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const float u = nu * (face.uv0.x + hits.b1[k] * face.uv1.x + hits.b2[k] * face.uv2.x);
    const float v = nv * (face.uv0.y + hits.b1[k] * face.uv1.y + hits.b2[k] * face.uv2.y);
    low_u = std::min(low_u, u);
    high_u = std::max(high_u, u);
    low_v = std::min(low_v, v);
    high_v = std::max(high_v, v);
    sum_u += u;
    sum_v += v;
    sum_uv += u * v;
  }
  if (low_u < 0.0F || low_v < 0.0F || high_u >= nu || high_v >= nv) return false;
  const int i = static_cast<int>(low_u), j = static_cast<int>(low_v);
  if (static_cast<int>(high_u) != i || static_cast<int>(high_v) != j) return false;

  // From means of u, v, u v to those of s = u - i, t = v - j, s t.
  constexpr float share = 1.0F / packet_size;
  const auto fi = static_cast<float>(i), fj = static_cast<float>(j);
  const float s = sum_u * share - fi, t = sum_v * share - fj;
  const float st = sum_uv * share - fi * sum_v * share - fj * sum_u * share + fi * fj;
  const auto element = side.first_element + static_cast<std::uint32_t>(j * side.nu + i);
  work.sums[pixel] += float{packet_size} * field_radiance(light.mesh, context.field, context.shading[face.side], element, s, t, st);
  return true;
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
      state.specular = &work.current[first];
      for (std::uint32_t k = 0; k < packet.count; ++k) {
        const SpecularRay& ray = state.specular[k];
        state.pixel[k] = ray.pixel;
        set_ray(packet, k, glm::vec3(ray.origin), glm::vec3(ray.direction), ray.leaving);
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
  const auto pixels = static_cast<std::uint32_t>(tile.width * tile.height);
  const float pixel_width = 1.0F / static_cast<float>(settings.width), pixel_height = 1.0F / static_cast<float>(settings.height);
  RayPacket packet;
  HitPacket hits;
  LaneState state;
  std::uint32_t filled = 0;
  const auto flush = [&] {
    packet.count = filled;
    closest_hits(context.light.rays, packet, hits, Backs::transparent, Coherence::coherent);
    const bool one_pixel = filled == packet_size && state.pixel[0] == state.pixel[packet_size - 1];
    if (!one_pixel || !shade_as_one(context, hits, state.pixel[0], work)) shade_packet(context, packet, state, hits, work);
    filled = 0;
  };
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const int px = tile.x0 + static_cast<int>(pixel) % tile.width, py = tile.y0 + static_cast<int>(pixel) / tile.width;
    const std::uint32_t shift_x = hash(static_cast<std::uint32_t>(px), static_cast<std::uint32_t>(py), settings.seed);
    const std::uint32_t shift_y = hash(shift_x, 1);
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      const float x = (static_cast<float>(px) + static_cast<float>((context.net[sample][0] ^ shift_x) >> 8U) * 0x1p-24F) * pixel_width;
      const float y = (static_cast<float>(py) + static_cast<float>((context.net[sample][1] ^ shift_y) >> 8U) * 0x1p-24F) * pixel_height;
      set_camera_ray(packet, filled, context.camera, x, y);
      state.pixel[filled] = pixel;
      if (++filled == packet_size) flush();
    }
  }
  if (filled > 0) flush();
  work.camera_rays += std::uint64_t{pixels} * samples;
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
