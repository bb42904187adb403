#include "scenes/materials/microfacets.h"

#include "scenes/materials/table_cell.h"

#include "scenes/material.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
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

Direction visible_facet(double alpha, const Direction& out, double u, double v) {
  // Stretched by 1/alpha the facets are a hemisphere,
  // whose visible part projects to a half disc and a half ellipse.
  const Direction o = glm::normalize(Vec3(alpha * out.x, alpha * out.y, out.z));
  const TangentFrame frame = tangent_frame(o);
  // The first tangent lies level, so that the second points up the hemisphere.
  const double level = o.x * o.x + o.y * o.y;
  const Direction t1 =
      level > 1e-14 ? Direction(Vec3(-o.y, o.x, 0.0) / std::sqrt(level)) : frame.tangent;
  const Direction t2 = glm::cross(o, t1);
  const double r = std::sqrt(u), phi = 2.0 * std::numbers::pi * v;
  const double x = r * std::cos(phi), s = 0.5 * (1.0 + o.z);
  const double y = (1.0 - s) * std::sqrt(std::max(0.0, 1.0 - x * x)) + s * r * std::sin(phi);
  const Vec3 h = x * t1 + y * t2 + std::sqrt(std::max(0.0, 1.0 - x * x - y * y)) * o;
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(1e-12, h.z)));
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

} // namespace

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
