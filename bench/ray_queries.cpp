// Rates of the ray queries beside bare Embree loops over the same rays:
// millions of rays a second, and the share of the bare robust loop that is reached.
// Figures are of one core.
#include "bench/bare_embree.h"
#include "scenes/rays/ray_scene.h"
#include "scenes/sampling.h"
#include "tests/support/scene_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <functional>

using namespace meninas;
using namespace meninas::bench;

namespace {

constexpr std::size_t packet_count = 1 << 13;
constexpr std::size_t block_size = 128;
constexpr int repetitions = 16;

struct Workload {
  std::string name;
  Query query = Query::closest;
  Coherence coherence = Coherence::incoherent;
  Backs backs = Backs::absorb;
  std::vector<RayPacket> packets;
};

// --- Scenes

Scene cornell_room() {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(test::diffuse(0.7));
  test::add_room(scene, {-1, -1, -1}, {1, 1, 1}, walls);
  test::add_box(scene, "short", {-0.6, -1, -0.1}, {-0.1, -0.5, 0.5}, test::diffuse(0.7));
  test::add_box(scene, "tall", {0.1, -1, -0.6}, {0.6, 0.2, -0.1}, test::diffuse(0.7));
  // The bottoms of the boxes lie on the floor, where no light comes.
  std::erase_if(scene.triangles, [&](const Triangle& t) {
    return scene.nodes[index(t.node)].name.ends_with(".y0");
  });
  test::add_box(scene, "lamp", {-0.3, 0.97, -0.3}, {0.3, 0.99, 0.3}, test::diffuse(0.0, 10.0));
  return scene;
}

// A room whose floor is a relief of many small triangles
Scene relief_room() {
  auto scene = cornell_room();
  constexpr std::uint32_t cells = 500;
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const auto material = scene.triangles.front().material;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const auto x = 2.0 * i / cells - 1.0;
      const auto z = 2.0 * j / cells - 1.0;
      scene.vertices.push_back({{x, -0.8 + 0.1 * std::sin(19.0 * x) * std::cos(17.0 * z), z}, {}});
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const auto a = first + j * (cells + 1) + i;
      const auto b = a + cells + 1;
      scene.triangles.push_back({{VertexId{a}, VertexId{b}, VertexId{b + 1}}, material, NodeId{0}});
      scene.triangles.push_back(
          {{VertexId{a}, VertexId{b + 1}, VertexId{a + 1}}, material, NodeId{0}});
    }
  return scene;
}

// --- Rays

RayPacket empty_packet() {
  RayPacket packet{};
  packet.count = packet_size;
  std::fill_n(packet.arriving, packet_size, index(none<PlaneId>));
  return packet;
}

// Tiles of 4 x 4 pixels of a view into the room, from inside or through the back of its front wall
Workload camera_rays(const std::string& name, double eye_z) {
  Workload workload{name, Query::closest, Coherence::coherent, Backs::transparent, {}};
  const std::uint32_t tiles = 1U << (std::bit_width(packet_count) / 2);
  for (std::uint32_t tile = 0; tile < packet_count; ++tile) {
    auto packet = empty_packet();
    for (std::uint32_t k = 0; k < packet_size; ++k) {
      const auto x = (4.0 * (tile % tiles) + k % 4) / (4.0 * tiles) - 0.5;
      const auto y = (4.0 * (tile / tiles) + k / 4) * tiles / (4.0 * packet_count) - 0.5;
      set_ray(packet, k, {0.0, 0.0, eye_z}, glm::normalize(Vec3(x, y, -0.4 - 0.4 * eye_z)),
              index(none<PlaneId>));
    }
    workload.packets.push_back(packet);
  }
  return workload;
}

struct SurfacePoint {
  Point3 position;
  Direction normal;
  PlaneId plane;
};

// Rays start on everything but the lamp.
std::vector<std::uint32_t> receivers(const Scene& scene) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (!scene.nodes[index(scene.triangles[t].node)].name.starts_with("lamp"))
      triangles.push_back(t);
  return triangles;
}

SurfacePoint surface_point(const FrameGeometry& geometry, std::span<const std::uint32_t> triangles,
                           std::uint32_t n) {
  const auto sample = sobol4(n, 17);
  const auto count = static_cast<double>(triangles.size());
  const auto triangle = triangles[static_cast<std::size_t>(static_cast<double>(sample[2]) * count)];
  const auto corners = corners_of(geometry, triangle);
  const auto root = std::sqrt(static_cast<double>(sample[0]));
  const auto b = root * static_cast<double>(sample[1]);
  return {corners[0] + (root - b) * (corners[1] - corners[0]) + b * (corners[2] - corners[0]),
          glm::normalize(area_vector(corners)), PlaneId{geometry.facts[triangle].plane}};
}

Workload gather_rays(const FrameGeometry& geometry, const Scene& scene) {
  const auto triangles = receivers(scene);
  Workload workload{"cosine gather", Query::closest, Coherence::incoherent, Backs::absorb, {}};
  for (std::uint32_t n = 0; n < packet_count; ++n) {
    auto packet = empty_packet();
    const auto point = surface_point(geometry, triangles, n);
    const auto frame = tangent_frame(point.normal);
    for (std::uint32_t k = 0; k < packet_size; ++k) {
      const auto sample = sobol4(k, n);
      const auto d = Vec3(cosine_hemisphere(sample[0], sample[1]));
      set_ray(packet, k, point.position,
              d.x * frame.tangent + d.y * frame.bitangent + d.z * point.normal, index(point.plane));
    }
    workload.packets.push_back(packet);
  }
  return workload;
}

// From one point of a surface to sixteen points of the lamp's lower face
Workload shadow_rays(const RayScene& rays, const Scene& scene, const SurfaceModel& surfaces) {
  Workload workload{"shadow", Query::occlusion, Coherence::coherent, Backs::absorb, {}};
  const auto triangles = receivers(scene);
  const auto& lamp = *std::ranges::find_if(scene.triangles, [&](const Triangle& t) {
    return scene.nodes[index(t.node)].name == "lamp.y0";
  });
  const auto plane =
      surfaces.plane_of_triangle[static_cast<std::size_t>(&lamp - scene.triangles.data())];
  for (std::uint32_t n = 0; n < packet_count; ++n) {
    auto packet = empty_packet();
    const auto point = surface_point(rays.geometry(), triangles, n);
    for (std::uint32_t k = 0; k < packet_size; ++k) {
      const auto sample = sobol4(k, n);
      const auto target = to_frame(rays.frame(), {-0.3 + 0.6 * static_cast<double>(sample[0]), 0.97,
                                                  -0.3 + 0.6 * static_cast<double>(sample[1])});
      set_ray(packet, k, point.position, target - point.position, index(point.plane), 1.0F);
      packet.arriving[k] = index(plane);
    }
    workload.packets.push_back(packet);
  }
  return workload;
}

// --- Loops

std::uint32_t bare_packet(const BareScene& bare, const Workload& workload,
                          const RayPacket& packet) {
  return trace_bare(bare, workload.query, workload.coherence, packet);
}

std::uint32_t our_packet(const RayScene& rays, const Workload& workload, const RayPacket& packet) {
  if (workload.query == Query::occlusion)
    return static_cast<std::uint32_t>(std::popcount(occluded(rays, packet, workload.coherence)));
  HitPacket hits;
  closest_hits(rays, packet, hits, workload.backs, workload.coherence);
  std::uint32_t met = 0;
  for (const auto triangle : hits.triangle)
    met += triangle != index(none<TriangleId>);
  return met;
}

struct Rate {
  double seconds = 0.0;
  std::uint64_t met = 0;
};

using Loop = std::function<std::uint32_t(const RayPacket&)>;

// Best times of each block of packets, added up. The loops take turns block by block,
// so that a busy machine slows all of them alike and hardly shows.
std::array<Rate, 3> measure(const std::vector<RayPacket>& packets,
                            const std::array<Loop, 3>& loops) {
  std::array<Rate, 3> rates{};
  for (std::size_t first = 0; first + block_size <= packets.size(); first += block_size) {
    std::array<double, 3> best{};
    best.fill(std::numeric_limits<double>::infinity());
    std::array<std::uint64_t, 3> met{};
    for (int repetition = 0; repetition < repetitions; ++repetition)
      for (std::size_t k = 0; k < loops.size(); ++k) {
        met[k] = 0;
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t n = first; n < first + block_size; ++n)
          met[k] += loops[k](packets[n]);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        best[k] = std::min(best[k], elapsed.count());
      }
    for (std::size_t k = 0; k < loops.size(); ++k) {
      rates[k].seconds += best[k];
      rates[k].met += met[k];
    }
  }
  return rates;
}

void report(const std::string& name, const Scene& scene) {
  const auto surfaces = find_surfaces(scene);
  const auto rays = make_ray_scene(scene, surfaces);
  const auto robust = make_bare_scene(rays.geometry(), RTC_SCENE_FLAG_ROBUST);
  const auto fast = make_bare_scene(rays.geometry(), RTC_SCENE_FLAG_NONE);
  fmt::print("\n{}, {} triangles: million rays/s on one "
             "core\n{:<22}{:>10}{:>10}{:>10}{:>10}{:>10}{:>14}\n",
             name, scene.triangles.size(), "", "default", "robust", "ours", "share", "met",
             "met (bare)");
  for (const auto& workload :
       {camera_rays("camera inside", 0.9), camera_rays("camera through back", 3.0),
        gather_rays(rays.geometry(), scene), shadow_rays(rays, scene, surfaces)}) {
    const auto [plain, bare, ours] = measure(
        workload.packets, {[&](const RayPacket& p) { return bare_packet(fast, workload, p); },
                           [&](const RayPacket& p) { return bare_packet(robust, workload, p); },
                           [&](const RayPacket& p) { return our_packet(rays, workload, p); }});
    const auto count = static_cast<double>(packet_count * packet_size);
    const auto rate = [&](const Rate& loop) { return count / loop.seconds / 1e6; };
    const auto share_met = [&](const Rate& loop) { return static_cast<double>(loop.met) / count; };
    fmt::print("{:<22}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.2f}{:>10.4f}{:>14.4f}\n", workload.name,
               rate(plain), rate(bare), rate(ours), bare.seconds / ours.seconds, share_met(ours),
               share_met(bare));
  }
  release(robust);
  release(fast);
}

} // namespace

int main() {
  report("room", cornell_room());
  report("room with a relief", relief_room());
}
