#include "scenes/materials/microfacets.h"

#include "scenes/materials/table_cell.h"

#include "scenes/material.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

namespace meninas {

double facet_density(double alpha, const Direction& h) {
  if (h.z <= 0.0)
    return 0.0;
  // 1 + (alpha^2 - 1) cos^2 without its cancellation at smooth surfaces
  const double a2 = alpha * alpha;
  const double spread = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 / (std::numbers::pi * spread * spread);
}

double smith_lambda(double alpha, const Direction& w) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  const double a2tan2 = alpha * alpha * tan2;
  // (sqrt(1 + x) - 1) / 2 without its cancellation at small x
  return 0.5 * a2tan2 / (std::sqrt(1.0 + a2tan2) + 1.0);
}

/// A facet of the hemisphere as `o` sees it: the visible part projects to a half disc and a half
/// ellipse.
static Vec3 visible_of_hemisphere(const Direction& o, double u, double v) {
  const TangentFrame frame = tangent_frame(o);
  // The first tangent lies level, so that the second points up the hemisphere.
  const double level = o.x * o.x + o.y * o.y;
  const Direction t1 =
      level > 1e-14 ? Direction(Vec3(-o.y, o.x, 0.0) / std::sqrt(level)) : frame.tangent;
  const Direction t2 = glm::cross(o, t1);
  const double r = std::sqrt(u), phi = 2.0 * std::numbers::pi * v;
  const double x = r * std::cos(phi), s = 0.5 * (1.0 + o.z);
  const double y = (1.0 - s) * std::sqrt(std::max(0.0, 1.0 - x * x)) + s * r * std::sin(phi);
  return x * t1 + y * t2 + std::sqrt(std::max(0.0, 1.0 - x * x - y * y)) * o;
}

Direction visible_facet(double alpha, const Direction& out, double u, double v) {
  // Stretched by 1/alpha the facets are a hemisphere.
  const Direction o = glm::normalize(Vec3(alpha * out.x, alpha * out.y, out.z));
  const Vec3 h = visible_of_hemisphere(o, u, v);
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(1e-12, h.z)));
}

/// With x along the axis and y across it, and back.
static Vec3 along_axis(const Facets& facets, const Vec3& w) {
  const Vec2& a = facets.axis;
  return {a.x * w.x + a.y * w.y, a.x * w.y - a.y * w.x, w.z};
}
static Vec3 from_axis(const Facets& facets, const Vec3& w) {
  const Vec2& a = facets.axis;
  return {a.x * w.x - a.y * w.y, a.y * w.x + a.x * w.y, w.z};
}

double facet_density(const Facets& facets, const Direction& h) {
  if (facets.along == facets.across)
    return facet_density(facets.across, h);
  if (h.z <= 0.0)
    return 0.0;
  const Vec3 m = along_axis(facets, h);
  const double x = m.x * facets.across, y = m.y * facets.along, a2 = facets.along * facets.across;
  const double spread = (x * x + y * y) / a2 + a2 * m.z * m.z;
  return a2 / (std::numbers::pi * spread * spread);
}

double smith_lambda(const Facets& facets, const Direction& w) {
  if (facets.along == facets.across)
    return smith_lambda(facets.across, w);
  const Vec3 o = along_axis(facets, w);
  // as of facets of width 1
  return smith_lambda(1.0, {facets.along * o.x, facets.across * o.y, o.z});
}

Direction visible_facet(const Facets& facets, const Direction& out, double u, double v) {
  if (facets.along == facets.across)
    return visible_facet(facets.across, out, u, v);
  const Vec3 o = along_axis(facets, out);
  const Vec3 h = visible_of_hemisphere(
      glm::normalize(Vec3(facets.along * o.x, facets.across * o.y, o.z)), u, v);
  return glm::normalize(
      from_axis(facets, {facets.along * h.x, facets.across * h.y, std::max(1e-12, h.z)}));
}

namespace {

constexpr int roughness_steps = 32, cosine_steps = 64;

/// By roughness and by the square root of the cosine,
/// because albedos change fast at grazing angles.
struct AlbedoTable {
  std::array<std::array<SchlickAlbedo, cosine_steps + 1>, roughness_steps + 1> at;
  std::array<SchlickAlbedo, roughness_steps + 1> mean;
};

double fifth_power(double x) { return x * x * x * x * x; }

SchlickAlbedo ideal_albedo(double cosine) {
  const double grazing = fifth_power(1.0 - cosine);
  return {1.0 - grazing, grazing};
}

/// The mean over visible facets of G2 / G1 times the parts of Schlick's term.
SchlickAlbedo rough_albedo(double alpha, double cosine) {
  constexpr std::uint32_t points = 512;
  const Direction out{std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), 0.0, cosine};
  const double lambda = smith_lambda(alpha, out);
  SchlickAlbedo sum;
  for (std::uint32_t k = 0; k < points; ++k) {
    const auto u = sobol4(k, 1);
    const Direction h = visible_facet(alpha, out, u[0], u[1]);
    const Direction in = 2.0 * glm::dot(out, h) * h - out;
    if (in.z <= 0.0)
      continue;
    const double seen = (1.0 + lambda) / (1.0 + lambda + smith_lambda(alpha, in));
    const double grazing = fifth_power(1.0 - glm::dot(out, h));
    sum.f0 += seen * (1.0 - grazing) / points;
    sum.f90 += seen * grazing / points;
  }
  return sum;
}

double table_roughness(int step) {
  return ideal_mirror_roughness + (1.0 - ideal_mirror_roughness) * step / roughness_steps;
}

SchlickAlbedo mixed(const SchlickAlbedo& a, const SchlickAlbedo& b, double t) {
  return {(1.0 - t) * a.f0 + t * b.f0, (1.0 - t) * a.f90 + t * b.f90};
}

/// 2 integral of e(c) c dc of what is linear in s = sqrt(c):
/// 4 integral of e(s) s^3 ds, by the midpoints of fine steps.
SchlickAlbedo mean_of(const std::array<SchlickAlbedo, cosine_steps + 1>& row) {
  constexpr int parts = 16;
  SchlickAlbedo mean;
  for (int k = 0; k < cosine_steps * parts; ++k) {
    const double place = (k + 0.5) / parts, s = place / cosine_steps;
    const auto cell = static_cast<std::size_t>(k / parts);
    const SchlickAlbedo e = mixed(row[cell], row[cell + 1], place - static_cast<double>(cell));
    const double weight = 4.0 * s * s * s / (cosine_steps * parts);
    mean.f0 += weight * e.f0;
    mean.f90 += weight * e.f90;
  }
  return mean;
}

AlbedoTable make_table() {
  AlbedoTable table;
  for (int r = 0; r <= roughness_steps; ++r) {
    auto& row = table.at[static_cast<std::size_t>(r)];
    const double roughness = table_roughness(r);
    for (int c = 0; c <= cosine_steps; ++c) {
      const double s = std::max(1e-3, double(c) / cosine_steps);
      row[static_cast<std::size_t>(c)] = rough_albedo(roughness * roughness, s * s);
    }
    table.mean[static_cast<std::size_t>(r)] = mean_of(row);
  }
  return table;
}

const AlbedoTable& albedo_table() {
  static const AlbedoTable table = make_table();
  return table;
}

TableCell roughness_cell(double roughness) {
  return table_cell((roughness - ideal_mirror_roughness) / (1.0 - ideal_mirror_roughness),
                    roughness_steps);
}

// --- Facets of two widths

constexpr int ratio_steps = 16, stretched_cosine_steps = 32, azimuth_steps = 12;

/// Of one pair of widths, by the square roots of the cosine and of the cosine of the azimuth: towards
/// the horizon, and across the axis, albedos change fast.
struct StretchedRow {
  std::array<std::array<SchlickAlbedo, azimuth_steps + 1>, stretched_cosine_steps + 1> at;
  SchlickAlbedo mean;
};

Facets stretched_facets(int roughness, int ratio) {
  constexpr double least = ideal_mirror_roughness;
  const double along = table_roughness(roughness);
  const double across = std::max(least, along * ratio / ratio_steps);
  return {along * along, across * across};
}

SchlickAlbedo looked_up(const StretchedRow& row, double cosine, double azimuth_cosine) {
  const TableCell c = table_cell(std::sqrt(std::max(0.0, cosine)), stretched_cosine_steps);
  const TableCell a = table_cell(std::sqrt(azimuth_cosine), azimuth_steps);
  const auto along = [&](const auto& at) { return mixed(at[a.first], at[a.first + 1], a.place); };
  return mixed(along(row.at[c.first]), along(row.at[c.first + 1]), c.place);
}

/// Over the hemisphere, evenly in the square of the cosine and in the azimuth.
SchlickAlbedo mean_of(const StretchedRow& row) {
  constexpr int rings = 128, sectors = 64;
  SchlickAlbedo mean;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double azimuth = 0.5 * std::numbers::pi * (j + 0.5) / sectors;
      const auto e = looked_up(row, std::sqrt((i + 0.5) / rings), std::cos(azimuth));
      mean.f0 += e.f0 / (rings * sectors);
      mean.f90 += e.f90 / (rings * sectors);
    }
  return mean;
}

/// As rough_albedo, by 24 x 24 midpoints in t and v with u = 1 - t^2: what is lost is lost by the
/// outermost facets. Each ring is turned on from the one before it. Good to 1e-3.
SchlickAlbedo stretched_albedo(const Facets& facets, const Direction& out) {
  constexpr int rings = 24, points = 24;
  constexpr double golden = 0.6180339887498949;
  const double lambda = smith_lambda(facets, out);
  double lost = 0.0, grazed = 0.0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < points; ++j) {
      const double t = (i + 0.5) / rings, turn = golden * i - std::floor(golden * i);
      const Direction h = visible_facet(facets, out, 1.0 - t * t, (j + turn) / points);
      const Direction in = 2.0 * glm::dot(out, h) * h - out;
      const double seen =
          in.z > 0.0 ? (1.0 + lambda) / (1.0 + lambda + smith_lambda(facets, in)) : 0.0;
      const double grazing = fifth_power(1.0 - glm::dot(out, h));
      const double weight = 2.0 * t / (rings * points);
      lost += weight * (1.0 - seen);
      grazed += weight * seen * grazing;
    }
  return {1.0 - lost - grazed, grazed};
}

StretchedRow make_row(const Facets& facets) {
  StretchedRow row;
  for (std::size_t c = 0; c < row.at.size(); ++c)
    for (std::size_t a = 0; a < row.at[c].size(); ++a) {
      const double s = std::max(1e-3, static_cast<double>(c) / stretched_cosine_steps);
      const double t = static_cast<double>(a) / azimuth_steps;
      const double sine = std::sqrt(std::max(0.0, 1.0 - s * s * s * s));
      row.at[c][a] = stretched_albedo(
          facets, {sine * t * t, sine * std::sqrt(std::max(0.0, 1.0 - t * t * t * t)), s * s});
    }
  row.mean = mean_of(row);
  return row;
}

/// A row is made when it is first asked for: few are.
const StretchedRow& stretched_row(std::size_t roughness, std::size_t ratio) {
  constexpr std::size_t ratios = ratio_steps + 1;
  static std::array<std::once_flag, (roughness_steps + 1) * ratios> made;
  static std::array<std::unique_ptr<const StretchedRow>, (roughness_steps + 1) * ratios> rows;
  const std::size_t place = roughness * ratios + ratio;
  std::call_once(made[place], [&] {
    rows[place] = std::make_unique<const StretchedRow>(
        make_row(stretched_facets(static_cast<int>(roughness), static_cast<int>(ratio))));
  });
  return *rows[place];
}

/// Between the rows of the widths around.
template <typename Look>
SchlickAlbedo between_rows(const Facets& facets, Look look) {
  const double along = std::sqrt(std::max(facets.along, facets.across)),
               across = std::sqrt(std::min(facets.along, facets.across));
  const TableCell r = roughness_cell(along), q = table_cell(across / along, ratio_steps);
  const auto at = [&](std::size_t roughness) {
    return mixed(look(stretched_row(roughness, q.first)),
                 look(stretched_row(roughness, q.first + 1)), q.place);
  };
  return mixed(at(r.first), at(r.first + 1), r.place);
}

} // namespace

SchlickAlbedo schlick_albedo(const Facets& facets, const Direction& w) {
  if (facets.along == facets.across)
    return schlick_albedo(std::sqrt(facets.across), w.z);
  const Vec3 o = along_axis(facets, w);
  const double wide = facets.along > facets.across ? o.x : o.y, level = std::hypot(o.x, o.y);
  const double azimuth = level > 0.0 ? std::min(1.0, std::abs(wide) / level) : 1.0;
  return between_rows(facets,
                      [&](const StretchedRow& row) { return looked_up(row, w.z, azimuth); });
}

SchlickAlbedo mean_schlick_albedo(const Facets& facets) {
  if (facets.along == facets.across)
    return mean_schlick_albedo(std::sqrt(facets.across));
  return between_rows(facets, [](const StretchedRow& row) { return row.mean; });
}

SchlickAlbedo schlick_albedo(double roughness, double cosine) {
  if (roughness <= ideal_mirror_roughness)
    return ideal_albedo(cosine);
  const AlbedoTable& table = albedo_table();
  const TableCell r = roughness_cell(roughness);
  const TableCell c = table_cell(std::sqrt(std::max(0.0, cosine)), cosine_steps);
  return mixed(mixed(table.at[r.first][c.first], table.at[r.first][c.first + 1], c.place),
               mixed(table.at[r.first + 1][c.first], table.at[r.first + 1][c.first + 1], c.place),
               r.place);
}

SchlickAlbedo mean_schlick_albedo(double roughness) {
  // 2 integral of (1 - c)^5 c dc = 1/21
  if (roughness <= ideal_mirror_roughness)
    return {20.0 / 21.0, 1.0 / 21.0};
  const TableCell r = roughness_cell(roughness);
  const AlbedoTable& table = albedo_table();
  return mixed(table.mean[r.first], table.mean[r.first + 1], r.place);
}

} // namespace meninas
