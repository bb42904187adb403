#include "reference/trace_paths.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas::reference {

namespace {

struct Path {
  Ray ray;
  Rgb throughput{1.0};
  Rgb radiance{0.0};
  Point3 scattered_at{0.0}; ///< the vertex where its direction was drawn
  double density =
      0.0; ///< of that direction; 0 at the eye and for ideal lobes, whose light is never looked for
  Backs backs = Backs::transparent; ///< to the eye, up to the first scattering
  bool alive = true;
  SurfacePoint at; ///< where it is
};
using Paths = std::array<Path, packet_size>;

/// A chosen point of a light, and what it adds to the path if nothing is between.
struct Connection {
  Leg leg;
  Rgb radiance{0.0};
  std::size_t path = 0;
};

/// The random numbers of a vertex: four for each of its two decisions.
struct VertexNumbers {
  std::array<float, 4> light, scatter;
};
VertexNumbers vertex_numbers(std::uint32_t path, std::uint32_t bounce, std::uint32_t seed) {
  return {sobol4(path, hash(seed, bounce, 1)), sobol4(path, hash(seed, bounce, 2))};
}

Direction to_local(const Direction& normal, const Direction& w) {
  const TangentFrame frame = tangent_frame(normal);
  return {glm::dot(frame.tangent, w), glm::dot(frame.bitangent, w), glm::dot(normal, w)};
}
Direction to_world(const Direction& normal, const Direction& w) {
  const TangentFrame frame = tangent_frame(normal);
  return glm::normalize(w.x * frame.tangent + w.y * frame.bitangent + w.z * normal);
}

/// Towards where the path came from; rounding must not take a grazing ray below the surface.
Direction local_out(const Path& path) {
  const Direction out = to_local(path.at.normal, -path.ray.direction);
  return glm::normalize(Vec3(out.x, out.y, std::max(1e-9, out.z)));
}

void set_lane(RayPacket& packet, std::uint32_t lane, const Point3& origin, const Vec3& direction) {
  packet.origin_x[lane] = static_cast<float>(origin.x);
  packet.origin_y[lane] = static_cast<float>(origin.y);
  packet.origin_z[lane] = static_cast<float>(origin.z);
  packet.direction_x[lane] = static_cast<float>(direction.x);
  packet.direction_y[lane] = static_cast<float>(direction.y);
  packet.direction_z[lane] = static_cast<float>(direction.z);
}

/// Carries the living paths whose backs are alike to the next surface; those that meet none end.
void intersect(const TracedScene& traced, Backs backs, Paths& paths, PathCounts& counts) {
  const RayFrame& frame = traced.rays.frame();
  RayPacket packet{};
  std::array<std::size_t, packet_size> lanes{};
  for (std::size_t k = 0; k < packet_size; ++k) {
    if (!paths[k].alive || paths[k].backs != backs)
      continue;
    const std::uint32_t lane = packet.count++;
    lanes[lane] = k;
    set_lane(packet, lane, (paths[k].ray.origin - frame.centre) * frame.scale,
             paths[k].ray.direction);
    packet.max_distance[lane] = std::numeric_limits<float>::infinity();
    packet.leaving[lane] = index(paths[k].ray.leaving);
  }
  if (packet.count == 0)
    return;
  HitPacket hits;
  closest_hits(traced.rays, packet, hits, backs,
               backs == Backs::transparent ? Coherence::coherent : Coherence::incoherent);
  (backs == Backs::transparent ? counts.camera_rays : counts.path_rays) += packet.count;
  for (std::uint32_t lane = 0; lane < packet.count; ++lane) {
    Path& path = paths[lanes[lane]];
    const TriangleId triangle{hits.triangle[lane]};
    path.alive = triangle != none<TriangleId>;
    if (!path.alive)
      continue;
    path.at =
        surface_point(traced, triangle, {hits.b1[lane], hits.b2[lane]}, hits.front[lane] != 0);
    path.alive = path.at.hole || !path.at.black;
  }
}

/// p_l of the direction from x to a point of a light.
double choosing_density(const TracedScene& traced, const Point3& x, const SurfacePoint& light) {
  const Vec3 leg = light.position - x;
  const double distance2 = glm::dot(leg, leg);
  const double cosine = std::abs(glm::dot(light.normal, leg)) / std::sqrt(distance2);
  const double area_density = traced.lights.area_density[index(light.triangle)];
  return cosine > 0.0 ? area_density * distance2 / cosine : 0.0;
}

/// Light the surface emits towards the path, with the weight of having been met.
void add_emission(const TracedScene& traced, LightSearch search, Path& path) {
  const Rgb& emission = path.at.material.emission;
  if (emission == Rgb(0.0))
    return;
  double weight = 1.0;
  if (path.density > 0.0 && search == LightSearch::choosing)
    weight = 0.0;
  if (path.density > 0.0 && search == LightSearch::both)
    weight = path.density / (path.density + choosing_density(traced, path.scattered_at, path.at));
  path.radiance += path.throughput * emission * weight;
}

/// Light from a point of an emitting triangle, with the weight of having been chosen.
std::optional<Connection> connect_to_triangle(const TracedScene& traced, const Path& path,
                                              const Light& light, Vec2 u, LightSearch search) {
  const SurfacePoint front =
      surface_point(traced, light.triangle, even_barycentric(u.x, u.y), true);
  const Vec3 leg = front.position - path.at.position;
  const bool seen_in_front = glm::dot(leg, front.normal) < 0.0;
  const SurfacePoint lit =
      seen_in_front ? front
                    : surface_point(traced, light.triangle, even_barycentric(u.x, u.y), false);
  if (lit.material.emission == Rgb(0.0) || glm::dot(leg, leg) == 0.0)
    return std::nullopt;

  const Direction out = local_out(path);
  const Direction in = to_local(path.at.normal, glm::normalize(leg));
  const Rgb f = evaluate(path.at.bsdf, out, in);
  const double p_l = choosing_density(traced, path.at.position, lit);
  if (f == Rgb(0.0) || p_l == 0.0)
    return std::nullopt;
  const double p_s = search == LightSearch::both ? sample_density(path.at.bsdf, out, in) : 0.0;
  return Connection{{path.at.position, lit.position, path.at.plane, lit.plane},
                    path.throughput * f * lit.material.emission * (std::abs(in.z) / (p_s + p_l))};
}

std::optional<Connection> connect_to_punctual(const TracedScene& traced, const Path& path,
                                              const Light& light) {
  const double reach = 8.0 / traced.rays.frame().scale;
  const PunctualSample sample =
      punctual_sample(traced.scene.lights[light.punctual], path.at.position, reach);
  const Vec3 leg = sample.position - path.at.position;
  if (sample.irradiance == Rgb(0.0))
    return std::nullopt;
  const Direction in = to_local(path.at.normal, glm::normalize(leg));
  const Rgb f = evaluate(path.at.bsdf, local_out(path), in);
  return Connection{{path.at.position, sample.position, path.at.plane, none<PlaneId>},
                    path.throughput * f * sample.irradiance * (std::abs(in.z) / light.power)};
}

/// Light straight from a chosen point of a light.
std::optional<Connection> connect_to_light(const TracedScene& traced, const Path& path,
                                           const std::array<float, 4>& u, LightSearch search) {
  if (traced.lights.lights.empty())
    return std::nullopt;
  const Light& light = choose_light(traced.lights, u[0]);
  if (light.triangle == none<TriangleId>)
    return connect_to_punctual(traced, path, light);
  if (search == LightSearch::meeting)
    return std::nullopt;
  return connect_to_triangle(traced, path, light, {u[1], u[2]}, search);
}

/// What a leg lets through: all or nothing, but for panes and holes, which are passed one after the other, up to `most_layers`.
Rgb transmittance(const TracedScene& traced, const Leg& leg) {
  const double length = glm::length(leg.to - leg.from);
  Ray ray{leg.from, (leg.to - leg.from) / length, leg.leaving, length};
  Rgb through(1.0);
  constexpr int most_layers = 256;
  for (int layer = 0;; ++layer) {
    const auto hit = closest_hit(traced.rays, ray);
    if (!hit)
      return through;
    const SurfacePoint at = surface_point(traced, hit->triangle, hit->barycentric, hit->front);
    if (at.plane == leg.arriving)
      return through;
    if (!at.hole)
      through *=
          at.black ? Rgb(0.0) : straight_transmission(at.bsdf, -glm::dot(at.normal, ray.direction));
    if (through == Rgb(0.0) || layer == most_layers)
      return Rgb(0.0);
    ray = {at.position, ray.direction, at.plane, ray.max_distance - hit->distance};
  }
}

/// Adds what arrives over at most sixteen connections.
void add_connections(const TracedScene& traced, const std::vector<Connection>& connections,
                     Paths& paths, PathCounts& counts) {
  counts.shadow_rays += connections.size();
  if (traced.see_through) {
    for (const Connection& connection : connections)
      paths[connection.path].radiance +=
          connection.radiance * transmittance(traced, connection.leg);
    return;
  }
  RayPacket packet{};
  const RayFrame& frame = traced.rays.frame();
  for (const Connection& connection : connections) {
    const std::uint32_t lane = packet.count++;
    const Leg& leg = connection.leg;
    set_lane(packet, lane, (leg.from - frame.centre) * frame.scale,
             (leg.to - leg.from) * frame.scale);
    packet.max_distance[lane] = 1.0F;
    packet.leaving[lane] = index(leg.leaving);
    packet.arriving[lane] = index(leg.arriving);
  }
  if (packet.count == 0)
    return;
  const std::uint32_t blocked = occluded(traced.rays, packet, Coherence::incoherent);
  for (std::uint32_t lane = 0; lane < packet.count; ++lane)
    if (((blocked >> lane) & 1U) == 0)
      paths[connections[lane].path].radiance += connections[lane].radiance;
}

/// The ray goes on behind what it has met; where and how its direction was drawn still holds.
void go_straight_on(Path& path) {
  path.ray.origin = path.at.position;
  path.ray.leaving = path.at.plane;
}

/// Draws the path's next direction, or ends it.
void scatter(Path& path, const std::array<float, 4>& u) {
  const auto drawn = sample(path.at.bsdf, local_out(path), {u[0], u[1], u[2]});
  path.alive = drawn.has_value();
  if (!drawn)
    return;
  path.throughput *= drawn->weight;
  go_straight_on(path);
  if (drawn->lobe == Lobe::straight)
    return;
  path.ray.direction = to_world(path.at.normal, drawn->in);
  path.scattered_at = path.at.position;
  path.density = drawn->density;
  path.backs = Backs::absorb;
}

/// Russian roulette: faint paths rarely go on, and then count for all of their kind.
void play_roulette(Path& path, std::uint32_t bounce, double u) {
  constexpr std::uint32_t first_bounce = 3;
  // Perfect mirrors that face each other would keep a path for ever.
  constexpr double most = 0.99;
  const Rgb& t = path.throughput;
  const double survival = std::min(most, std::max({t.r, t.g, t.b}));
  if (bounce < first_bounce)
    path.alive = path.alive && survival > 0.0;
  else if (u < survival)
    path.throughput /= survival;
  else
    path.alive = false;
}

} // namespace

std::array<Rgb, packet_size> trace_paths(const TracedScene& traced,
                                         const std::array<CameraRay, packet_size>& camera_rays,
                                         std::uint32_t seed, LightSearch search,
                                         PathCounts& counts) {
  Paths paths;
  for (std::size_t k = 0; k < packet_size; ++k)
    paths[k].ray = {.origin = camera_rays[k].origin, .direction = camera_rays[k].direction};

  std::vector<Connection> connections;
  const auto goes_on = [](const Path& path) { return path.alive; };
  for (std::uint32_t bounce = 0; std::ranges::any_of(paths, goes_on); ++bounce) {
    intersect(traced, Backs::transparent, paths, counts);
    intersect(traced, Backs::absorb, paths, counts);
    connections.clear();
    for (std::uint32_t k = 0; k < packet_size; ++k) {
      Path& path = paths[k];
      if (!path.alive)
        continue;
      const VertexNumbers u = vertex_numbers(k, bounce, seed);
      if (path.at.hole) {
        go_straight_on(path);
        play_roulette(path, bounce, u.scatter[3]);
        continue;
      }
      add_emission(traced, search, path);
      if (auto connection = connect_to_light(traced, path, u.light, search)) {
        connection->path = k;
        connections.push_back(*connection);
      }
      scatter(path, u.scatter);
      if (path.alive)
        play_roulette(path, bounce, u.scatter[3]);
    }
    add_connections(traced, connections, paths, counts);
  }
  std::array<Rgb, packet_size> radiances;
  std::ranges::transform(paths, radiances.begin(), &Path::radiance);
  return radiances;
}

} // namespace meninas::reference
