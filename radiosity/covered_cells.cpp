#include "radiosity/covered_cells.h"

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

/// Rays along the surface from all over the cell, all the way round, meet nothing but black:
/// the cell is enclosed. The few rays of a cell may all meet the black
/// back of something that only hangs above; these pass under it.
bool is_enclosed(const LightScene& light, const RaySource& source, std::uint32_t cell) {
  constexpr double rise = 0.02; // of the rays over the surface
  static const std::array<Vec2, packet_size> round = all_round();
  RayPacket packet;
  packet.count = packet_size;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const Vec2 place(k / 4 + 0.5, k % 4 + 0.5);
    const Vec3 from = point_in(source.area, (Vec2(cell / 8, cell % 8) + 0.25 * place) / 8.0);
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

/// Those that share an edge with it; at the border, itself instead.
std::array<std::uint32_t, 4> cells_beside(std::uint32_t cell) {
  const std::uint32_t i = cell / 8, j = cell % 8;
  return {i > 0 ? cell - 8 : cell, i < 7 ? cell + 8 : cell, j > 0 ? cell - 1 : cell,
          j < 7 ? cell + 1 : cell};
}

CellCounts count_cells(const DirectionNet& net, const RaySource& source,
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

} // namespace

Covered find_covered(const LightScene& light, const DirectionNet& net, const RaySource& source,
                     std::span<const std::uint32_t> black_lanes) {
  const CellCounts counts = count_cells(net, source, black_lanes);
  // A few rays leave cells out:
  // what is covered is looked for from cells with black rays on, through those without any.
  std::array<std::uint32_t, 64> waiting;
  std::size_t count = 0;
  CoveredCells asked = 0;
  const auto ask = [&](std::uint32_t cell) {
    if (counts.may_be_covered(cell) && ((asked >> cell) & 1U) == 0) {
      asked |= CoveredCells{1} << cell;
      waiting[count++] = cell;
    }
  };
  for (std::uint32_t cell = 0; cell < 64; ++cell)
    if (counts.black[cell] > 0)
      ask(cell);

  Covered covered;
  for (std::size_t next = 0; next < count; ++next) {
    const std::uint32_t cell = waiting[next];
    if (!is_enclosed(light, source, cell))
      continue;
    covered.cells |= CoveredCells{1} << cell;
    covered.rays += counts.rays[cell];
    for (const std::uint32_t beside : cells_beside(cell))
      ask(beside);
  }
  return covered;
}

} // namespace meninas
