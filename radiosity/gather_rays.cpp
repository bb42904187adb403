#include "radiosity/gather_rays.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr float to_unit = 0x1p-32F;
constexpr float below_one = 0x1.fffffep-1F;

float unit_float(std::uint32_t bits) { return std::min(static_cast<float>(bits) * to_unit, below_one); }

/// What a packet's rays carry besides their geometry.
struct LaneState {
  std::array<glm::dvec3, packet_size> origin, direction;
  std::array<glm::vec3, packet_size> throughput;
  std::array<WorldId, packet_size> world;
};

void set_lane(RayPacket& packet, LaneState& state, std::uint32_t k, const MirroredRay& ray) {
  state.origin[k] = ray.origin;
  state.direction[k] = ray.direction;
  state.throughput[k] = ray.throughput;
  state.world[k] = ray.world;
  packet.origin_x[k] = static_cast<float>(ray.origin.x);
  packet.origin_y[k] = static_cast<float>(ray.origin.y);
  packet.origin_z[k] = static_cast<float>(ray.origin.z);
  packet.direction_x[k] = static_cast<float>(ray.direction.x);
  packet.direction_y[k] = static_cast<float>(ray.direction.y);
  packet.direction_z[k] = static_cast<float>(ray.direction.z);
  packet.max_distance[k] = std::numeric_limits<float>::infinity();
  packet.leaving[k] = ray.leaving;
}

/// The ray behind the mirror: the meeting point comes from the mirror's exact plane, not from the rounded distance.
MirroredRay reflected(const LightScene& light, const FaceRecord& face, const LaneState& state, std::uint32_t k,
                      float distance) {
  const glm::dvec3& d = state.direction[k];
  const double approach = glm::dot(face.normal, d);
  double t = (face.frame_offset - glm::dot(face.normal, state.origin[k])) / approach;
  if (!(t > 0.0) || t > 2.0 * distance + 1e-6) t = distance;
  MirroredRay ray;
  ray.origin = state.origin[k] + t * d;
  ray.direction = d - 2.0 * approach * face.normal;
  ray.throughput = state.throughput[k] * face.reflectance;
  ray.world = child(light.worlds, state.world[k], face.mirror);
  ray.leaving = face.plane_class;
  return ray;
}

float largest(const glm::vec3& c) { return std::max({c.r, c.g, c.b}); }

/// Sorts the hits of a packet into landings, ends and rays that go on behind a mirror.
void sort_hits(const LightScene& light, const FormFactorSettings& settings, const RayPacket& packet,
               const LaneState& state, const HitPacket& hits, GatherWorkspace& work) {
  GatheredRays& result = work.result;
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>)) {
      ++result.escaped;
      result.escaped_light += state.throughput[k];
      result.mirror_absorbed += 1.0F - state.throughput[k];
      continue;
    }
    const FaceRecord& face = light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
    if (face.side != FaceRecord::nothing) {
      const glm::vec2 uv = landing_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
      const Landing landing = land(light.landing.sides[face.side], uv);
      result.landings.push_back({landing.element, state.world[k], state.throughput[k]});
    }
    if (face.mirrors) {
      const MirroredRay ray = reflected(light, face, state, k, hits.distance[k]);
      if (largest(ray.throughput) >= settings.min_throughput) {
        work.next.push_back(ray);
        continue;
      }
      ++result.cut;
      result.cut_light += ray.throughput;
      result.mirror_absorbed += 1.0F - ray.throughput;
      continue;
    }
    if (face.side == FaceRecord::nothing) {
      ++result.black;
      result.black_light += state.throughput[k];
      work.black_lanes |= 1U << k;
    }
    result.mirror_absorbed += 1.0F - state.throughput[k];
  }
}

void trace_packet(const LightScene& light, const FormFactorSettings& settings, const RayPacket& packet,
                  const LaneState& state, Coherence coherence, GatherWorkspace& work) {
  HitPacket hits;
  closest_hits(light.rays, packet, hits, Backs::absorb, coherence);
  work.result.traced += packet.count;
  work.black_lanes = 0;
  sort_hits(light, settings, packet, state, hits, work);
}

/// Counts, cell by cell of the receiver, the rays and those that met a black back at once.
struct CellCounts {
  std::array<std::uint16_t, 64> rays{}, black{};

  /// Every ray met black; a cell without rays is not known to be.
  bool is_black(std::uint32_t cell) const { return rays[cell] >= 2 && black[cell] == rays[cell]; }
};

/// Rays along the surface from all over the cell, all the way round, meet nothing but black: the cell is enclosed. The few rays of a cell
/// may all meet the black back of something that only hangs above; these pass under it.
bool is_enclosed(const LightScene& light, const ReceiverArea& area, const TangentFrame& tangents, std::uint32_t cell) {
  constexpr double rise = 0.02; // of the rays over the surface
  RayPacket packet;
  packet.count = packet_size;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const Vec2 place(k / 4 + 0.5, k % 4 + 0.5);
    const Vec3 from = point_in(area, (Vec2(cell / 8, cell % 8) + 0.25 * place) / 8.0);
    const double turn = 2.0 * std::numbers::pi * (7 * k % packet_size) / packet_size;
    const Vec3 along = std::cos(turn) * tangents.tangent + std::sin(turn) * tangents.bitangent + rise * area.normal;
    packet.origin_x[k] = static_cast<float>(from.x);
    packet.origin_y[k] = static_cast<float>(from.y);
    packet.origin_z[k] = static_cast<float>(from.z);
    packet.direction_x[k] = static_cast<float>(along.x);
    packet.direction_y[k] = static_cast<float>(along.y);
    packet.direction_z[k] = static_cast<float>(along.z);
    packet.max_distance[k] = std::numeric_limits<float>::infinity();
    packet.leaving[k] = index(area.plane_class);
  }
  HitPacket hits;
  closest_hits(light.rays, packet, hits, Backs::absorb, Coherence::incoherent);
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>)) return false;
    const FaceRecord& face = light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
    if (face.side != FaceRecord::nothing || face.mirrors) return false;
  }
  return true;
}

/// Takes the rays of covered cells out of the count.
void find_covered(const LightScene& light, const ReceiverArea& area, const TangentFrame& tangents, const CellCounts& cells,
                  GatheredRays& result) {
  for (std::uint32_t cell = 0; cell < 64; ++cell) {
    if (!cells.is_black(cell) || !is_enclosed(light, area, tangents, cell)) continue;
    result.covered |= CoveredCells{1} << cell;
    result.covered_rays += cells.rays[cell];
  }
}

/// Mirror after mirror, until no ray goes on.
void follow_mirrors(const LightScene& light, const FormFactorSettings& settings, GatherWorkspace& work) {
  RayPacket packet;
  LaneState state;
  for (int bounce = 1; !work.next.empty(); ++bounce) {
    work.current.swap(work.next);
    work.next.clear();
    if (bounce > settings.max_bounces) {
      for (const auto& ray : work.current) {
        work.result.cut_light += ray.throughput;
        work.result.mirror_absorbed += 1.0F - ray.throughput;
      }
      work.result.cut += static_cast<std::uint32_t>(work.current.size());
      return;
    }
    for (std::size_t first = 0; first < work.current.size(); first += packet_size) {
      packet.count = static_cast<std::uint32_t>(std::min(packet_size, work.current.size() - first));
      for (std::uint32_t k = 0; k < packet.count; ++k) set_lane(packet, state, k, work.current[first + k]);
      trace_packet(light, settings, packet, state, Coherence::incoherent, work);
    }
  }
}

} // namespace

DirectionNet make_direction_net(int rays) {
  DirectionNet net;
  net.points.resize(static_cast<std::size_t>(std::max(rays, 1)));
  for (std::uint32_t k = 0; k < net.points.size(); ++k) {
    const auto point = sobol4(k, 0);
    for (std::size_t d = 0; d < 4; ++d) net.points[k][d] = static_cast<std::uint32_t>(point[d] * 0x1p32F);
  }

  // Group by the leading bits of the direction: a power-of-two net puts sixteen points into each of its N / 16 cells.
  int cells_log2 = 0;
  while ((net.points.size() >> (cells_log2 + 4)) > 1) ++cells_log2;
  const int bits_u = (cells_log2 + 1) / 2, bits_v = cells_log2 / 2;
  const auto cell_of = [bits_u, bits_v](const std::array<std::uint32_t, 4>& p) {
    const std::uint32_t u = bits_u == 0 ? 0 : p[2] >> (32 - bits_u), v = bits_v == 0 ? 0 : p[3] >> (32 - bits_v);
    return (u << bits_v) | v;
  };
  std::stable_sort(net.points.begin(), net.points.end(),
                   [&cell_of](const auto& a, const auto& b) { return cell_of(a) < cell_of(b); });
  return net;
}

void gather_rays(const LightScene& light, const DirectionNet& net, const ReceiverArea& receiver, std::uint32_t seed,
                 const FormFactorSettings& settings, GatherWorkspace& work) {
  GatheredRays& result = work.result;
  result.landings.clear();
  result.escaped = result.black = result.cut = 0;
  result.mirror_absorbed = result.escaped_light = result.black_light = result.cut_light = glm::vec3(0.0F);
  result.traced = 0;
  result.covered = 0;
  result.covered_rays = 0;
  work.next.clear();

  const RayFrame& frame = light.rays.frame();
  ReceiverArea area = receiver;
  area.corner = (receiver.corner - frame.centre) * frame.scale;
  area.edge_u *= frame.scale;
  area.edge_v *= frame.scale;
  area.edge_uv *= frame.scale;
  const TangentFrame tangents = frame_along(receiver.normal, receiver.tangent);
  const std::array<std::uint32_t, 4> shift{hash(seed, 0), hash(seed, 1), hash(seed, 2), hash(seed, 3)};

  RayPacket packet;
  LaneState state;
  CellCounts cells;
  std::array<std::uint32_t, packet_size> cell{};
  for (std::size_t first = 0; first < net.points.size(); first += packet_size) {
    packet.count = static_cast<std::uint32_t>(std::min(packet_size, net.points.size() - first));
    for (std::uint32_t k = 0; k < packet.count; ++k) {
      const auto& point = net.points[first + k];
      const Vec2 st(unit_float(point[0] ^ shift[0]), unit_float(point[1] ^ shift[1]));
      const glm::vec3 local = cosine_hemisphere(unit_float(point[2] ^ shift[2]), unit_float(point[3] ^ shift[3]));
      cell[k] = cell_of(st.x, st.y);
      MirroredRay ray;
      ray.origin = point_in(area, st);
      ray.direction = double{local.x} * tangents.tangent + double{local.y} * tangents.bitangent +
                      double{local.z} * receiver.normal;
      ray.throughput = glm::vec3(1.0F);
      ray.world = real_world;
      ray.leaving = index(receiver.plane_class);
      set_lane(packet, state, k, ray);
    }
    trace_packet(light, settings, packet, state, Coherence::coherent, work);
    for (std::uint32_t k = 0; k < packet.count; ++k) {
      ++cells.rays[cell[k]];
      cells.black[cell[k]] += static_cast<std::uint16_t>((work.black_lanes >> k) & 1U);
    }
  }
  if (result.black > 0 && !receiver.is_point()) find_covered(light, area, tangents, cells, result);
  follow_mirrors(light, settings, work);
}

ReceiverArea receiver_of(const LightScene& light, ElementId element) {
  const MeshSide& side = light.mesh.sides[index(light.mesh.side_of_element[index(element)])];
  const Patch& patch = light.surfaces.patches[index(side.patch)];
  const std::uint32_t local = index(element) - side.first_element;
  const auto at = [&](double s, double t) { return point_at(patch, patch_uv_of(side, local, Vec2(s, t))); };
  ReceiverArea area;
  area.corner = at(0.0, 0.0);
  area.edge_u = at(1.0, 0.0) - area.corner;
  area.edge_v = at(0.0, 1.0) - area.corner;
  if (!side.triangle) area.edge_uv = at(1.0, 1.0) - area.corner - area.edge_u - area.edge_v;
  area.triangle = side.triangle;
  area.normal = side.normal;
  area.plane_class = side.plane_class;
  area.tangent = side.tangent;
  return area;
}

} // namespace meninas
