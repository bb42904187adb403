#include "reference/trace_paths.h"

#include "reference/light_images.h"
#include "reference/light_points.h"
#include "reference/mirrored_lights.h"
#include "scenes/materials/coverage.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/normal_map.h"
#include "scenes/sampling.h"
#include "scenes/shading_normal.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace meninas::reference {

namespace {

struct Path {
  Ray ray;
  Rgb throughput{1.0};
  LayerRadiance radiance{}; ///< gathered so far
  LightRoutes routes;
  Point3 scattered_at{0.0}; ///< where its direction was drawn, or the image in the mirrors since
  double density =
      0.0; ///< of that direction; 0 where light is met only: from the eye, over long chains
  std::size_t chain_length = 0;     ///< mirrors since
  Backs backs = Backs::transparent; ///< to the eye, up to the first scattering
  bool alive = true;
  bool by_mirrors = true; ///< from the eye so far: it sees what is unlit as it is shown
  MaterialId medium = none<MaterialId>; ///< the solid it has been refracted into
  SurfacePoint at;                      ///< where it is
};
using Paths = std::array<Path, packet_size>;

/// A chosen point of a light, and what it adds to the path if nothing is between.
struct Connection {
  Chain chain;
  Point3 light;
  PlaneId arriving = none<PlaneId>;
  Rgb radiance{0.0};
  LightRoutes routes;
  std::size_t path = 0;
};

/// The solid that a path has crossed to where it is:
/// that whose surface it meets from inside, or else the one it was refracted into.
MaterialId solid_before(const TracedScene& traced, const Path& path) {
  const MaterialId met = traced.scene.triangles[index(path.at.triangle)].material;
  const bool inside = !path.at.front && is_solid_glass(traced.scene.materials[index(met)]);
  return inside ? met : path.medium;
}

/// The weight of light that a path has met and that is chosen with the density p_l as well.
double weight_of_meeting(const Path& path, LightSearch search, double p_l) {
  if (path.density == 0.0 || search == LightSearch::meeting)
    return 1.0;
  return search == LightSearch::choosing ? 0.0 : path.density / (path.density + p_l);
}

/// Light from where nothing is met, with the weight of having been met.
void add_sky(const TracedScene& traced, LightSearch search, Path& path) {
  const Environment& sky = traced.scene.background;
  double weight = 1.0;
  if (path.density > 0.0 && !traced.sky.columns.empty())
    weight = weight_of_meeting(path, search, sky_density(sky, traced.sky, path.ray.direction) *
                                                 chain_chance(traced, path.chain_length));
  path.routes.add(weight * path.throughput * radiance_from(sky, path.ray.direction),
                  path.radiance);
}

/// Area lights that a path passes on the way to what it has met so far ahead; the eye sees none.
void add_area_lights(const TracedScene& traced, LightSearch search, double distance, Path& path) {
  for (const PassedLight& light :
       area_lights_passed(traced, path.ray, distance, path.scattered_at)) {
    const double weight = weight_of_meeting(
        path, search, light.density * chain_chance(traced, path.chain_length));
    path.routes.add(weight * path.throughput * light.radiance, path.radiance);
  }
}

/// Carries the living paths whose backs are alike to the next surface; those that meet none end.
void intersect(const TracedScene& traced, Backs backs, LightSearch search, Paths& paths,
               PathCounts& counts) {
  const RayFrame& frame = traced.rays.frame();
  RayPacket packet{};
  std::array<std::size_t, packet_size> lanes{};
  for (std::size_t k = 0; k < packet_size; ++k) {
    if (!paths[k].alive || paths[k].backs != backs)
      continue;
    const std::uint32_t lane = packet.count++;
    lanes[lane] = k;
    set_ray(packet, lane, (paths[k].ray.origin - frame.centre) * frame.scale,
            paths[k].ray.direction, index(paths[k].ray.leaving));
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
    if (backs == Backs::absorb && !traced.scene.area_lights.empty())
      add_area_lights(traced, search,
                      path.alive ? double{hits.distance[lane]} / frame.scale : HUGE_VAL, path);
    if (!path.alive) {
      add_sky(traced, search, path);
      continue;
    }
    path.at =
        surface_point(traced, triangle, {hits.b1[lane], hits.b2[lane]}, hits.front[lane] != 0);
    bend(traced, {hits.b1[lane], hits.b2[lane]}, -path.ray.direction, path.at);
    path.alive = path.at.hole || !path.at.black;
    if (const MaterialId solid = solid_before(traced, path); solid != none<MaterialId>)
      path.throughput *= attenuation(traced.scene.materials[index(solid)],
                                     glm::distance(path.at.position, path.ray.origin));
  }
}

/// Light the surface emits towards the path, with the weight of having been met.
void add_emission(const TracedScene& traced, LightSearch search, Path& path) {
  const Rgb& emission = path.at.material.emission;
  if (emission == Rgb(0.0))
    return;
  double weight = 1.0;
  if (path.density > 0.0)
    weight = weight_of_meeting(path, search, choosing_density(traced, path.scattered_at, path.at) *
                                                 chain_chance(traced, path.chain_length));
  path.routes.add(path.throughput * emission * weight, path.radiance);
}

/// The ray goes on behind what it has met; where and how its direction was drawn still holds.
void go_straight_on(Path& path) {
  path.ray.origin = path.at.position;
  path.ray.leaving = path.at.plane;
}

/// An unlit surface shows its colour, and in its openings the scene behind.
bool ends_unlit(const TracedScene& traced, Path& path) {
  const Material& material = material_of(traced.scene, path.at.triangle);
  if (!material.unlit || !path.by_mirrors)
    return false;
  path.routes.add(path.throughput * shown_radiance(material, path.at.material), path.radiance);
  path.throughput *= straight_transmission(path.at.bsdf, 1.0);
  path.alive = path.throughput != Rgb(0.0);
  go_straight_on(path);
  return true;
}

/// The routes of what is scattered towards `out` from `in`;
/// glass that is passed is no part of them, translucent surfaces scatter evenly.
LightRoutes routes_on(const TracedScene& traced, const Path& path, const Direction& out,
                      const Direction& in) {
  if (in.z < 0.0)
    return path.at.bsdf.passed == Rgb(0.0) ? path.routes : path.routes.scattered({});
  LobeShares shares = lobe_shares(path.at.bsdf, out, in);
  // A surface that pass one takes for a mirror is one on the way of light, as glass is.
  if (material_of(traced.scene, path.at.triangle).specular_in_pass_one)
    shares.glass += std::exchange(shares.gloss, Rgb(0.0));
  return path.routes.scattered(shares);
}

/// Light from a chosen point of a light, over a chain of mirrors or none,
/// with the weight of having been chosen.
std::optional<Connection> connect(const TracedScene& traced, const Path& path, const Chain& chain,
                                  const LightPoint& point, LightSearch search) {
  const Vec3 leg = first_target(traced, chain, point.position) - path.at.origin;
  if (point.light == Rgb(0.0) || point.density == 0.0 || glm::dot(leg, leg) == 0.0)
    return std::nullopt;
  const Direction out = local_out(path.at.normal, path.ray.direction);
  const Direction in = to_local(path.at.normal, glm::normalize(leg));
  const Rgb f = evaluate(path.at.bsdf, out, in);
  if (f == Rgb(0.0))
    return std::nullopt;
  const double p_s = search == LightSearch::both ? sample_density(path.at.bsdf, out, in) : 0.0;
  const double p_l = point.density * chain_chance(traced, chain.planes.size());
  return Connection{chain, point.position, point.plane,
                    path.throughput * f * point.light * (std::abs(in.z) / (p_s + p_l)),
                    routes_on(traced, path, out, in).reflected(chain.planes.size())};
}

/// Keeps what a path has found.
void keep(std::optional<Connection> connection, std::uint32_t path,
          std::vector<Connection>& connections) {
  if (!connection)
    return;
  connection->path = path;
  connections.push_back(std::move(*connection));
}

/// Looks for emitting surfaces directly and by way of chains of mirrors.
void look_for_surfaces(const TracedScene& traced, const Paths& paths, std::uint32_t k,
                       const VertexNumbers& u, LightSearch search,
                       std::vector<Connection>& connections) {
  if (traced.lights.lights.empty())
    return;
  const std::size_t longest = traced.mirror_planes.empty() ? 0 : longest_chain;
  for (std::size_t length = 0; length <= longest; ++length) {
    const auto& numbers = u.light[length];
    const auto chain = choose_chain(traced, paths[k].at.origin, length, numbers[3]);
    if (!chain)
      continue;
    keep(connect(traced, paths[k], *chain, choose_point(traced, chain->image, numbers), search), k,
         connections);
  }
}

/// Looks for the sky in the same way.
void look_for_sky(const TracedScene& traced, const Paths& paths, std::uint32_t k,
                  const SkyNumbers& u, LightSearch search, std::vector<Connection>& connections) {
  const std::size_t longest = traced.mirror_planes.empty() ? 0 : longest_chain;
  for (std::size_t length = 0; length <= longest; ++length)
    if (const auto chain = choose_chain(traced, paths[k].at.origin, length, u[length][3]))
      keep(connect(traced, paths[k], *chain, choose_sky(traced, chain->image, u[length]), search),
           k, connections);
}

/// Looks for punctual lights, by all chains at once.
void look_for_images(const TracedScene& traced, const Paths& paths, std::uint32_t k,
                     const VertexNumbers& u, std::vector<ImageConnection>& chosen,
                     std::vector<Connection>& connections) {
  const Path& path = paths[k];
  const Direction out = local_out(path.at.normal, path.ray.direction);
  choose_images(traced, path.at, out, {u.light[0][0], u.light[0][1]}, chosen);
  for (const ImageConnection& seen : chosen) {
    const auto& planes = seen.image->planes;
    Point3 light = seen.target;
    for (const PlaneId plane : planes)
      light = reflected_in(traced.surfaces.planes[index(plane)], light);
    const Direction in = to_local(path.at.normal, glm::normalize(seen.target - path.at.origin));
    Connection& connection = connections.emplace_back();
    connection.chain.planes = planes;
    connection.light = light;
    connection.radiance = path.throughput * seen.radiance;
    connection.routes = routes_on(traced, path, out, in).reflected(planes.size());
    connection.path = k;
  }
}

/// Adds what arrives over connections through nothing but air, sixteen or fewer of them.
void add_clear_connections(const TracedScene& traced, std::span<const Connection* const> clear,
                           Paths& paths) {
  RayPacket packet{};
  const RayFrame& frame = traced.rays.frame();
  for (const Connection* connection : clear) {
    const SurfacePoint& x = paths[connection->path].at;
    const std::uint32_t lane = packet.count++;
    set_ray(packet, lane, (x.origin - frame.centre) * frame.scale,
            (connection->light - x.origin) * frame.scale, index(x.leaving), 1.0F);
    packet.arriving[lane] = index(connection->arriving);
  }
  const std::uint32_t blocked = occluded(traced.rays, packet, Coherence::incoherent);
  for (std::uint32_t lane = 0; lane < packet.count; ++lane)
    if (((blocked >> lane) & 1U) == 0)
      clear[lane]->routes.add(clear[lane]->radiance, paths[clear[lane]->path].radiance);
}

/// Adds what arrives over the connections.
void add_connections(const TracedScene& traced, const std::vector<Connection>& connections,
                     Paths& paths, PathCounts& counts) {
  counts.shadow_rays += connections.size();
  std::array<const Connection*, packet_size> clear{};
  std::size_t count = 0;
  for (const Connection& connection : connections) {
    if (traced.see_through || !connection.chain.planes.empty()) {
      const Rgb left = chain_throughput(traced, paths[connection.path].at, connection.chain,
                                        connection.light, connection.arriving);
      connection.routes.add(connection.radiance * left, paths[connection.path].radiance);
      continue;
    }
    clear[count++] = &connection;
    if (count == packet_size) {
      add_clear_connections(traced, clear, paths);
      count = 0;
    }
  }
  if (count > 0)
    add_clear_connections(traced, std::span(clear).first(count), paths);
}

/// Draws the path's next direction, or ends it.
void scatter(const TracedScene& traced, Path& path, const std::array<float, 4>& u) {
  const Direction out = local_out(path.at.normal, path.ray.direction);
  const auto drawn = sample(path.at.bsdf, out, {u[0], u[1], u[2]});
  path.alive = drawn.has_value();
  if (!drawn)
    return;
  path.throughput *= drawn->weight;
  go_straight_on(path);
  const MaterialId met = traced.scene.triangles[index(path.at.triangle)].material;
  const bool into_solid = is_solid_glass(traced.scene.materials[index(met)]);
  if (drawn->lobe == Lobe::straight && !into_solid)
    return;
  path.ray.direction = to_world(path.at.normal, drawn->in);
  const bool through = drawn->in.z < 0.0;
  const bool curved = is_bent(traced.scene, path.at.triangle);
  if (drawn->lobe == Lobe::spread && !through) {
    path.ray.origin = path.at.origin;
    path.ray.leaving = path.at.leaving;
  } else if (curved) {
    path.ray.direction =
        kept_above(path.ray.direction, through ? -path.at.face : path.at.face);
  }
  if (drawn->lobe == Lobe::straight) {
    path.medium = path.at.front ? met : none<MaterialId>;
    // No light is looked for through solids: it is met, and then counts whole.
    path.density = 0.0;
    return;
  }
  if (drawn->lobe == Lobe::ideal_reflection) {
    const bool looked_for = path.chain_length < longest_chain && !curved &&
                            std::ranges::binary_search(traced.mirror_planes, path.at.plane);
    path.density = looked_for ? path.density : 0.0;
    path.scattered_at =
        reflected_in(traced.surfaces.planes[index(path.at.plane)], path.scattered_at);
    ++path.chain_length;
    // A coat that throws no light as a mirror is one to the eye alone.
    const bool is_coat = path.at.bsdf.metal == Rgb(0.0) && path.at.bsdf.glass == 0.0 &&
                         !material_of(traced.scene, path.at.triangle).specular_in_pass_one;
    path.routes = is_coat ? path.routes.scattered({.gloss = Rgb(1.0)}) : path.routes.reflected(1);
  } else {
    path.by_mirrors = false;
    path.density = drawn->density;
    path.scattered_at = path.ray.origin;
    path.chain_length = 0;
    path.routes = routes_on(traced, path, out, drawn->in);
  }
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

std::array<LayerRadiance, packet_size>
trace_paths(const TracedScene& traced, const std::array<CameraRay, packet_size>& camera_rays,
            std::uint32_t seed, LightSearch search, PathCounts& counts, std::size_t count) {
  Paths paths;
  for (std::size_t k = 0; k < packet_size; ++k) {
    paths[k].ray = {.origin = camera_rays[k].origin, .direction = camera_rays[k].direction};
    paths[k].alive = k < count;
  }

  std::vector<Connection> connections;
  std::vector<ImageConnection> chosen;
  const auto goes_on = [](const Path& path) { return path.alive; };
  for (std::uint32_t bounce = 0; std::ranges::any_of(paths, goes_on); ++bounce) {
    intersect(traced, Backs::transparent, search, paths, counts);
    intersect(traced, Backs::absorb, search, paths, counts);
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
      if (ends_unlit(traced, path))
        continue;
      if (search != LightSearch::meeting) {
        look_for_surfaces(traced, paths, k, u, search, connections);
        if (!traced.sky.columns.empty())
          look_for_sky(traced, paths, k, sky_numbers(k, bounce, seed), search, connections);
      }
      look_for_images(traced, paths, k, u, chosen, connections);
      scatter(traced, path, u.scatter);
      if (path.alive)
        play_roulette(path, bounce, u.scatter[3]);
    }
    add_connections(traced, connections, paths, counts);
  }
  std::array<LayerRadiance, packet_size> radiances;
  std::ranges::transform(paths, radiances.begin(), &Path::radiance);
  return radiances;
}

} // namespace meninas::reference
