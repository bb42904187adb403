#include "radiosity/transport/contact_mask.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// Counts, cell by cell of the receiver, the rays and those that met a black back at once.
struct CellCounts {
  std::array<std::uint32_t, 64> rays{}, black{};

  /// No ray of the cell has met anything else.
  bool may_be_covered(std::uint32_t cell) const { return black[cell] == rays[cell]; }
};

/// Directions all the way round, neighbours of which start far apart.
std::array<Vec2, packet_size> all_round() {
  std::array<Vec2, packet_size> directions;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const double turn =
        2.0 * std::numbers::pi * static_cast<double>(7 * k % packet_size) / packet_size;
    directions[k] = {std::cos(turn), std::sin(turn)};
  }
  return directions;
}

/// Rays along the surface from `place(k)`, ray by ray, all the way round, meet nothing but black.
template <typename Place>
bool is_enclosed(const LightScene& light, const RaySource& source, const Place& place) {
  constexpr double rise = 0.02; // of the rays over the surface
  static const std::array<Vec2, packet_size> round = all_round();
  RayPacket packet;
  packet.count = packet_size;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const Vec3 from = point_in(source.area, place(k));
    const Vec3 along = round[k].x * source.tangents.tangent +
                       round[k].y * source.tangents.bitangent + rise * source.area.normal;
    set_ray(packet, k, from, along, index(source.area.plane_class));
  }
  HitPacket hits;
  closest_hits(light.rays, packet, hits, Backs::absorb, Coherence::incoherent);
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    if (hits.triangle[k] == index(none<TriangleId>))
      return false;
    const FaceRecord& face =
        light.landing.faces[2 * hits.triangle[k] + (hits.front[k] != 0 ? 0 : 1)];
    if (face.side != FaceRecord::nothing || face.mirrors)
      return false;
  }
  return true;
}

/// The few rays of a cell may all meet the black back of something that only hangs above;
/// these pass under it.
bool is_enclosed_cell(const LightScene& light, const RaySource& source, std::uint32_t cell) {
  return is_enclosed(light, source, [cell](std::uint32_t k) {
    return (Vec2(cell / 8, cell % 8) + 0.25 * Vec2(k / 4 + 0.5, k % 4 + 0.5)) / 8.0;
  });
}

/// The cells that share an edge with it; at the border, itself instead.
std::array<std::uint32_t, 4> cells_beside(std::uint32_t cell) {
  const std::uint32_t i = cell / 8, j = cell % 8;
  return {i > 0 ? cell - 8 : cell, i < 7 ? cell + 8 : cell, j > 0 ? cell - 1 : cell,
          j < 7 ? cell + 1 : cell};
}

CellCounts count_cells(const HemisphereSamples& net, const RaySource& source,
                       std::span<const std::uint32_t> black_lanes) {
  CellCounts counts;
  LanePlaces places{};
  for (std::size_t n = 0; n < net.points.size(); ++n) {
    const std::size_t k = n % packet_size;
    if (k == 0)
      places = places_of(net.packets[n / packet_size], source);
    const std::uint32_t cell = cell_of(places.s[k], places.t[k]);
    ++counts.rays[cell];
    counts.black[cell] += (black_lanes[n / packet_size] >> k) & 1U;
  }
  return counts;
}

/// Rays, and of them those that met black at once, of some of the cells.
struct CountsOfCells {
  double rays = 0.0, black = 0.0;
  double black_share() const { return rays > 0.0 ? black / rays : 0.0; }
};
CountsOfCells counts_of(const CellCounts& counts, ContactMask cells) {
  CountsOfCells sum;
  for (std::uint32_t cell = 0; cell < 64; ++cell)
    if (((cells >> cell) & 1U) != 0) {
      sum.rays += counts.rays[cell];
      sum.black += counts.black[cell];
    }
  return sum;
}

/// Adds the covered places of the cells at the foot.
void add_boundary_places(const CellCounts& counts, Covered& covered) {
  const ContactMask foot = boundary_cells(covered.cells);
  const double elsewhere = counts_of(counts, ~(foot | covered.cells)).black_share();
  const CountsOfCells at_foot = counts_of(counts, foot);
  const double share = elsewhere < 1.0
                           ? std::max(0.0, (at_foot.black_share() - elsewhere) / (1.0 - elsewhere))
                           : 0.0;
  covered.rays += share * at_foot.rays;
  covered.exposed -= static_cast<float>(share * std::popcount(foot) / 64.0);
}

} // namespace

ContactMask boundary_cells(ContactMask covered) {
  constexpr ContactMask lowest = 0x0101010101010101ULL, highest = lowest << 7U;
  ContactMask around = covered | (covered & ~highest) << 1U | (covered & ~lowest) >> 1U;
  around |= around << 8U | around >> 8U;
  return around & ~covered;
}

/// (s, t) of the middle of a region's largest triangle: a point well within its outline.
static Vec2 inside_of(const RegionElement& region) {
  std::size_t largest = 0;
  double area = 0.0, before = 0.0;
  Vec2 st(0.5);
  for (std::size_t k = 0; k < region.area_up_to.size(); ++k) {
    const double own = region.area_up_to[k] - (k == 0 ? 0.0 : region.area_up_to[k - 1]);
    if (own > area) {
      largest = k;
      area = own;
    }
  }
  if (area > 0.0) {
    before = largest == 0 ? 0.0 : region.area_up_to[largest - 1];
    // The root of what is left of s is 2/3 there (point_in_region()).
    st = Vec2((before + 4.0 / 9.0 * area) / region.area_up_to.back(), 0.5);
  }
  return st;
}

/// A region is cut along what stands there: all of it is covered, or none. Rays may begin at its
/// very rim, on either side of the wall there, so nearly all of them have to meet black.
static Covered covered_region(const LightScene& light, const HemisphereSamples& net,
                              const RaySource& source,
                              std::span<const std::uint32_t> black_lanes) {
  constexpr double nearly_all = 0.97;
  double black = 0.0;
  for (const std::uint32_t lanes : black_lanes)
    black += std::popcount(lanes);
  const auto rays = static_cast<double>(net.points.size());
  if (black < nearly_all * rays ||
      !is_enclosed(light, source, [st = inside_of(*source.area.region)](std::uint32_t) { return st; }))
    return {};
  return {wholly_covered, rays, 0.0F};
}

Covered find_covered(const LightScene& light, const HemisphereSamples& net, const RaySource& source,
                     std::span<const std::uint32_t> black_lanes) {
  if (source.area.region != nullptr)
    return covered_region(light, net, source, black_lanes);
  const CellCounts counts = count_cells(net, source, black_lanes);
  // A few rays leave cells out:
  // what is covered is looked for from cells with black rays on, through those without any.
  std::array<std::uint32_t, 64> waiting;
  std::size_t count = 0;
  ContactMask asked = 0;
  const auto ask = [&](std::uint32_t cell) {
    if (counts.may_be_covered(cell) && ((asked >> cell) & 1U) == 0) {
      asked |= ContactMask{1} << cell;
      waiting[count++] = cell;
    }
  };
  for (std::uint32_t cell = 0; cell < 64; ++cell)
    if (counts.black[cell] > 0)
      ask(cell);

  Covered covered;
  for (std::size_t next = 0; next < count; ++next) {
    const std::uint32_t cell = waiting[next];
    if (!is_enclosed_cell(light, source, cell))
      continue;
    covered.cells |= ContactMask{1} << cell;
    covered.rays += counts.rays[cell];
    for (const std::uint32_t beside : cells_beside(cell))
      ask(beside);
  }
  covered.exposed = 1.0F - static_cast<float>(std::popcount(covered.cells)) / 64.0F;
  if (covered.cells != 0 && covered.cells != wholly_covered)
    add_boundary_places(counts, covered);
  return covered;
}

NumberedPlace next_open_point(const LightScene& light, const ReceiverArea& receiver,
                            ContactMask covered, std::uint32_t seed, std::uint32_t first) {
  constexpr int max_looked_at = 64;
  const ContactMask foot = boundary_cells(covered);
  for (int looked_at = 0;; ++first) {
    const Vec2 st(sobol2(first, seed, SobolPair::first));
    if (contains(covered, st))
      continue;
    if (!contains(foot, st) || ++looked_at > max_looked_at)
      return {st, first};
    const RaySource source = ray_source(receiver, light.rays.frame(), 0);
    if (!is_enclosed(light, source, [st](std::uint32_t) { return st; }))
      return {st, first};
  }
}

} // namespace meninas
