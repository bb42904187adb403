#include "radiosity/light/glass_light.h"

#include "scenes/rays/frame_geometry.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// A rectangle of the unit disc below a hemisphere, with its axes in space.
struct DiscPart {
  Direction along{0.0}, across{0.0};
  double low = -1.0, high = 1.0; ///< along
  double half_width = 1.0;       ///< across

  double area() const { return (high - low) * 2.0 * half_width; }
};

/// Holds all directions above the horizon from the point to the sphere;
/// area 0 where there are none.
DiscPart part_towards(const SolidBody& body, const Point3& x, const Direction& normal,
                      const Vec3& tangent) {
  const Vec3 to = body.centre - x;
  const double distance = glm::length(to);
  const TangentFrame any = frame_along(normal, tangent);
  const DiscPart all{any.tangent, any.bitangent};
  if (!(distance > body.radius))
    return all;
  // theta from the normal to the middle, alpha from there to the rim.
  const double height = glm::dot(to, normal) / distance;
  const Vec3 flat = to / distance - height * normal;
  const double theta = std::acos(std::clamp(height, -1.0, 1.0)),
               alpha = std::asin(body.radius / distance);
  constexpr double quarter = 0.5 * std::numbers::pi;
  if (theta - alpha >= quarter)
    return {any.tangent, any.bitangent, 0.0, 0.0, 0.0};
  const double flat_length = glm::length(flat);
  DiscPart part = all;
  if (flat_length > 1e-9) {
    part.along = flat / flat_length;
    part.across = glm::cross(normal, part.along);
  }
  part.half_width = std::sin(alpha);
  part.low = std::sin(theta - alpha);
  part.high = theta + alpha < quarter ? std::sin(theta + alpha) : 1.0;
  // On the horizon the rim is nearer to the middle of the disc.
  if (theta + alpha > quarter && std::sin(theta) > 0.0)
    part.low = std::min(part.low, std::cos(alpha) / std::sin(theta));
  return part;
}

/// Cells along an edge of the rectangle.
constexpr std::uint32_t edge_cells = 8;
constexpr std::uint32_t cells = edge_cells * edge_cells;

/// The data that the rays to one body share.
struct BodyRays {
  const LightScene& light;
  const PlanePoints& points;
  std::uint32_t body;
  double area; ///< of the first point's rectangle, that light is counted in
  std::uint32_t seed;

  DiscPart part_at(std::size_t point) const {
    return part_towards(light.solids.bodies[body],
                        to_frame(light.rays.frame(), points.positions[point]), points.normal,
                        points.tangent);
  }
};

/// A point of the rectangle [0, 1]^2, in a cell drawn by its density.
struct PlacedSample {
  glm::vec2 at;
  std::uint32_t cell;
};
PlacedSample place(glm::vec2 u, std::span<const float> density) {
  const float along = u.x * static_cast<float>(cells);
  std::uint32_t cell = 0;
  float before = 0.0F;
  while (cell + 1 < cells && before + density[cell] <= along)
    before += density[cell++];
  const float within = std::clamp((along - before) / density[cell], 0.0F, 0x1.fffffep-1F);
  const glm::vec2 corner(cell % edge_cells, cell / edge_cells);
  return {(corner + glm::vec2(within, u.y)) / float(edge_cells), cell};
}

/// Adds the ray to that point of the rectangle, where it lies in the disc.
void add_ray(const BodyRays& rays, const DiscPart& part, const Point3& origin,
             const PlacedSample& sample, float light, SolidWorkspace& work) {
  const double u = std::lerp(part.low, part.high, double{sample.at.x}),
               v = part.half_width * (2.0 * double{sample.at.y} - 1.0),
               height2 = 1.0 - u * u - v * v;
  if (!(height2 > 0.0))
    return;
  if (work.packets.empty() || work.packets.back().rays.count == packet_size) {
    work.packets.emplace_back();
    work.packets.back().rays.count = 0;
  }
  LitPacket& packet = work.packets.back();
  const double height = std::sqrt(height2);
  const Vec3 direction = u * part.along + v * part.across + height * rays.points.normal;
  packet.light[packet.rays.count] = glm::vec3(light);
  if (rays.points.coat != none<MaterialId>)
    packet.light[packet.rays.count] *=
        glm::vec3(coat_transmittance(rays.light.by_angle[index(rays.points.coat)], height));
  set_ray(packet.rays, packet.rays.count++, glm::vec3(origin), glm::vec3(direction),
          index(rays.points.plane_class));
  work.cell_of_ray.push_back(static_cast<std::uint16_t>(sample.cell));
}

/// The mean by so many rays, spread by the density;
/// points take turns in runs, each of them even. The light that cells show goes to `work.shown`.
SolidLight mean_of(const BodyRays& rays, std::uint32_t count, std::uint32_t seed,
                   SolidWorkspace& work, std::uint64_t& traced) {
  static const FormFactorSettings settings{.min_throughput = 1e-6};
  const LightScene& light = rays.light;
  work.packets.clear();
  work.cell_of_ray.clear();
  const std::size_t points = rays.points.positions.size();
  DiscPart part;
  Point3 origin;
  for (std::size_t k = 0, last = points; k < count; ++k) {
    const std::size_t point = k * points / count;
    if (point != last) {
      part = rays.part_at(point);
      origin = to_frame(light.rays.frame(), rays.points.positions[point]);
      last = point;
    }
    // The first pair's dimensions decide which way a ray goes at faces:
    // of the same it would go one way in each direction.
    const PlacedSample sample =
        place(sobol2(static_cast<std::uint32_t>(k), seed, SobolPair::second), work.density);
    add_ray(rays, part, origin, sample,
            static_cast<float>(part.area() / rays.area) / work.density[sample.cell], work);
  }
  follow_into(light, rays.body, work.packets, seed, settings, work.gather);
  traced += work.gather.result.traced;

  SolidLight sum{.by_lamp = ArrivedByLamp(light.lamps.count, Rgb(0.0))};
  work.shown.assign(cells, 0.0F);
  const double share = rays.area / (std::numbers::pi * count);
  const auto& landings = work.gather.result.landings;
  for (std::size_t k = 0; k < landings.size(); ++k) {
    const ElementHit& landing = landings[k];
    if (light.direct_sides[index(light.mesh.side_of_element[landing.element])] == 0)
      continue;
    const Rgb arrived = share * Rgb(landing.light) * light.mesh.emission[landing.element];
    sum.total += arrived;
    if (light.lamps)
      sum.by_lamp[light.lamps.of_side[index(light.mesh.side_of_element[landing.element])]] += arrived;
    if (landing.world == off_solids)
      sum.mirrored += arrived;
    work.shown[work.cell_of_ray[work.gather.numbers[k]]] += static_cast<float>(largest(arrived));
  }
  return sum;
}

/// q over an even one, by what the cells have shown and their neighbours, a part of it even.
void aim(SolidWorkspace& work) {
  constexpr float even = 0.3F;
  float all = 0.0F;
  for (int y = 0; y < int(edge_cells); ++y)
    for (int x = 0; x < int(edge_cells); ++x) {
      float most = 0.0F;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, int(edge_cells) - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, int(edge_cells) - 1); ++i)
          most = std::max(most, work.shown[static_cast<std::size_t>(j) * edge_cells + i]);
      work.density[static_cast<std::size_t>(y) * edge_cells + x] = most;
      all += most;
    }
  for (float& density : work.density)
    density = all > 0.0F ? even + (1.0F - even) * density * float(cells) / all : 1.0F;
}

void add(const SolidLight& part, double weight, SolidLight& sum) {
  sum.total += weight * part.total;
  sum.mirrored += weight * part.mirrored;
  for (std::size_t l = 0; l < part.by_lamp.size(); ++l)
    sum.by_lamp[l] += weight * part.by_lamp[l];
}

} // namespace

bool has_solid_light(const Lighting& light) {
  // The sky in a window, behind a solid, is gathered; to area lights solids are sheets.
  return !light.scene.solids.empty() && !light.direct_sides.empty() &&
         std::ranges::any_of(light.emitters, &Emitter::is_face);
}

SolidLight solid_light(const LightScene& light, const PlanePoints& points, int rays,
                       std::uint32_t seed, std::uint64_t& traced, SolidWorkspace& work) {
  constexpr double whole = 4.0;        // of the square around the disc
  constexpr double share_first = 0.1;  // in the mean
  constexpr std::uint32_t few = cells; // of which none is spared to aim the others by
  SolidLight sum{.by_lamp = ArrivedByLamp(light.lamps.count, Rgb(0.0))};
  for (std::uint32_t body = 0; body < light.solids.bodies.size(); ++body) {
    BodyRays to_body{light, points, body, 0.0, hash(seed, body, 0x50118)};
    to_body.area = to_body.part_at(0).area();
    if (!(to_body.area > 0.0))
      continue;
    const auto count = static_cast<std::uint32_t>(
        std::max(1.0, std::round(rays * std::sqrt(to_body.area / whole))));
    work.density.assign(cells, 1.0F);
    if (count < few) {
      add(mean_of(to_body, count, to_body.seed, work, traced), 1.0, sum);
      continue;
    }
    add(mean_of(to_body, count / 4, to_body.seed, work, traced), share_first, sum);
    aim(work);
    add(mean_of(to_body, count - count / 4, hash(to_body.seed, 1), work, traced), 1.0 - share_first,
        sum);
  }
  return sum;
}

} // namespace meninas
