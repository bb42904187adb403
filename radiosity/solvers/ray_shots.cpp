#include "radiosity/solvers/ray_shots.h"

#include "radiosity/solvers/report.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

constexpr std::uint32_t chunk_rays = 512;
constexpr std::uint32_t min_rays = 64;
constexpr std::uint32_t max_rays = 1U << 22U;

/// Where on an element a ray starts: where `sample` says, or, of an element on which
/// something stands, at a place of its own.
Vec2 start_of(const LightScene& light, std::uint32_t element, ContactMask covered, Vec2 sample,
              std::uint32_t own_seed) {
  if (covered == 0 || covered == wholly_covered)
    return sample;
  return next_open_point(light, receiver_of(light, static_cast<ElementId>(element)), covered,
                       own_seed, 0)
      .st;
}

/// Multiplies the light of rays that leave an element by the transmittance of its coat, if that is a mirror.
void pass_coat(const LightScene& light, std::uint32_t element, const LaneDirections& local,
               LitPacket& packet) {
  const MaterialId coat = light.mesh.sides[index(light.mesh.side_of_element[element])].coat;
  if (coat == none<MaterialId>)
    return;
  for (std::uint32_t k = 0; k < packet.rays.count; ++k)
    packet.light[k] *= glm::vec3(coat_transmittance(light.by_angle[index(coat)], local.z[k]));
}

/// The element's area in the frame of the rays;
/// its source's directions are those of all elements of a side.
RaySource source_of(const LightScene& light, std::uint32_t element) {
  return ray_source(receiver_of(light, static_cast<ElementId>(element)), light.rays.frame(), 0);
}

} // namespace

template <typename Value>
struct RayShots<Value>::Shot {
  std::span<const std::uint32_t> elements;
  std::vector<double> until;    ///< by member: the sum of the weights up to it
  std::vector<glm::vec3> light; ///< by member: of a ray that starts there
  std::uint32_t rays = 0;
  std::uint32_t seed = 0;

  /// The member that the ray belongs to, not before `from`.
  std::size_t member_of(std::uint32_t ray, std::size_t from) const {
    const double place = (ray + 0.5) / rays * until.back();
    return static_cast<std::size_t>(
        std::ranges::upper_bound(until.begin() + static_cast<std::ptrdiff_t>(from), until.end() - 1,
                                 place) -
        until.begin());
  }
};

template <typename Value>
typename RayShots<Value>::ChunkResult RayShots<Value>::follow(const Shot& shot, std::uint32_t first,
                                                              std::uint32_t end) {
  std::array<LitPacket, chunk_rays / packet_size> packets;
  std::size_t used = 0, member = 0;
  std::size_t shown = shot.elements.size();
  RaySource source = source_of(light_, shot.elements[0]);
  ChunkResult result;
  for (std::uint32_t begin = first; begin < end; begin += packet_size, ++used) {
    LitPacket& packet = packets[used];
    packet.rays.count = std::min<std::uint32_t>(packet_size, end - begin);
    LaneFloats u{}, v{};
    for (std::uint32_t k = 0; k < packet.rays.count; ++k) {
      member = shot.member_of(begin + k, member);
      const std::uint32_t element = shot.elements[member];
      if (member != shown)
        source = source_of(light_, element);
      shown = member;
      const auto sample = sobol4(begin + k, shot.seed);
      const Vec2 st = start_of(light_, element, survey_.covered[element],
                               Vec2(sample[0], sample[1]), hash(begin + k, shot.seed, 0x57a7));
      const Point3 from = point_in(source.area, st);
      packet.rays.origin_x[k] = static_cast<float>(from.x);
      packet.rays.origin_y[k] = static_cast<float>(from.y);
      packet.rays.origin_z[k] = static_cast<float>(from.z);
      packet.rays.max_distance[k] = std::numeric_limits<float>::infinity();
      packet.rays.leaving[k] = index(source.area.plane_class);
      u[k] = sample[2];
      v[k] = sample[3];
      packet.light[k] = shot.light[member];
      result.kept += Rgb(packet.light[k]);
    }
    const LaneDirections directions = cosine_hemisphere(u, v);
    set_directions(directions, source, packet.rays);
    pass_coat(light_, shot.elements[0], directions, packet);
  }
  GatherWorkspace& work = workspaces_.local();
  follow_light(light_, std::span(packets).first(used), hash(shot.seed, first), settings_, work);
  result.kept -= Rgb(work.result.cut_light);
  result.landings = work.result.landings;
  result.traced = work.result.traced;
  return result;
}

template <typename Value>
void RayShots<Value>::shoot(std::size_t block, ShotState<Value>& state) {
  // Members weigh as much as the largest share of what
  // they have left in all the light of a channel.
  Shot shot;
  shot.elements = state.shooters.members(block);
  shot.seed = hash(static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(state.shots),
                   settings_.seed);
  Value power(0.0);
  double weight = 0.0;
  for (const auto element : shot.elements) {
    const Value own = state.shooters.measure[element] * state.unshot[element];
    const Value share = share_of(own, state.power);
    const double size = worst(share);
    weight += size;
    shot.until.push_back(weight);
    shot.light.emplace_back(Rgb(size > 0.0 ? share / size : Value(0.0)));
    power += own;
    state.unshot[element] = Value(0.0);
  }
  state.left[block] = Value(0.0);
  if (!(weight > 0.0))
    return;
  const double wanted = weight * static_cast<double>(state.reflectance.size()) * settings_.rays;
  shot.rays = min_rays * static_cast<std::uint32_t>(std::clamp(wanted / min_rays, 1.0,
                                                                 double{max_rays} / min_rays));

  const std::uint32_t chunks = (shot.rays + chunk_rays - 1) / chunk_rays;
  std::vector<ChunkResult> results(chunks);
  tbb::parallel_for(0U, chunks, [&](std::uint32_t c) {
    results[c] = follow(shot, c * chunk_rays, std::min(shot.rays, (c + 1) * chunk_rays));
  });

  // In the order of the rays, whoever has traced them.
  Rgb kept(0.0);
  for (const ChunkResult& result : results) {
    kept += result.kept;
    rays_traced_ += result.traced;
  }
  const Value per_light = share_of(power, value_of<Value>(glm::max(kept, Rgb(0.0))));
  for (const ChunkResult& result : results)
    for (const ElementHit& landing : result.landings)
      if (const double area = state.shooters.measure[landing.element]; area > 0.0)
        state.arrive(landing.element, per_light * value_of<Value>(Rgb(landing.light)) / area);
}

template class RayShots<Rgb>;
template class RayShots<double>;

} // namespace meninas
