#include "scenes/materials/sheen.h"

#include "scenes/materials/table_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr int sheen_roughness_steps = 16, sheen_cosine_steps = 32; // of the square root of the cosine
constexpr double min_roughness = 0.1;                ///< smoother fibres are as those

/// The fit of Conty and Kulla: its parameters between those for a = 0 and a = 1.
class Shadowing {
public:
  explicit Shadowing(double alpha) : rough_(1.0 - (1.0 - alpha) * (1.0 - alpha)) {}

  double lambda(double cosine) const {
    return cosine < 0.5 ? std::exp(exponent(cosine))
                        : std::exp(2.0 * exponent(0.5) - exponent(1.0 - cosine));
  }

private:
  double between(double smooth, double rough) const { return std::lerp(smooth, rough, rough_); }
  double exponent(double x) const {
    const double a = between(25.3245, 21.5473), b = between(3.32435, 3.82987),
                 c = between(0.16801, 0.19823), d = between(-1.27393, -1.97760),
                 e = between(-4.85967, -4.32054);
    return a / (1.0 + b * std::pow(x, c)) + d * x + e;
  }

  double rough_;
};

/// E by the midpoints of cells of the hemisphere, half of which is as the other.
double integrated_albedo(double roughness, double cos_out) {
  constexpr int steps = 64;
  const double alpha = roughness * roughness, power = 0.5 / alpha;
  const Shadowing shadowing(alpha);
  const double of_out = shadowing.lambda(cos_out);
  const double sin_out = std::sqrt(std::max(0.0, 1.0 - cos_out * cos_out));
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double cos_in = (i + 0.5) / steps, sin_in = std::sqrt(1.0 - cos_in * cos_in);
    double density = 0.0;
    for (int j = 0; j < steps; ++j) {
      const double cos_phi = std::cos(std::numbers::pi * (j + 0.5) / steps);
      const double twice = 2.0 * (1.0 + cos_out * cos_in + sin_out * sin_in * cos_phi); // |o + i|^2
      const double up = cos_out + cos_in;
      density += std::pow(std::max(0.0, 1.0 - up * up / twice), power) / steps;
    }
    sum += density / (1.0 + of_out + shadowing.lambda(cos_in)) / steps;
  }
  // 2 pi of the circle, over the 2 pi of D and 4 cos_out
  return std::min(1.0, sum * (2.0 + 1.0 / alpha) / (4.0 * cos_out));
}

struct SheenTable {
  std::array<std::array<double, sheen_cosine_steps + 1>, sheen_roughness_steps + 1> at;
  std::array<double, sheen_roughness_steps + 1> mean;
};

SheenTable make_sheen_table() {
  SheenTable table{};
  for (std::size_t r = 0; r <= sheen_roughness_steps; ++r) {
    auto& row = table.at[r];
    const double roughness =
        std::lerp(min_roughness, 1.0, static_cast<double>(r) / sheen_roughness_steps);
    for (std::size_t c = 0; c <= sheen_cosine_steps; ++c) {
      const double root = std::max(0.03, static_cast<double>(c) / sheen_cosine_steps);
      row[c] = integrated_albedo(roughness, root * root);
    }
    // 2 integral of E(w) w dw = 4 integral of E(s) s^3 ds, exactly of what is linear in s between
    // the steps: so the mean is that of what is looked up.
    constexpr double h = 1.0 / sheen_cosine_steps;
    for (std::size_t c = 0; c < sheen_cosine_steps; ++c) {
      const double s = static_cast<double>(c) * h, t = s + h;
      const double cubes = 0.25 * (std::pow(t, 4) - std::pow(s, 4));
      const double fourths = 0.2 * (std::pow(t, 5) - std::pow(s, 5));
      const double slope = (row[c + 1] - row[c]) / h;
      table.mean[r] += 4.0 * ((row[c] - slope * s) * cubes + slope * fourths);
    }
  }
  return table;
}

const SheenTable& sheen_table() {
  static const SheenTable table = make_sheen_table();
  return table;
}

TableCell sheen_roughness_cell(double roughness) {
  return table_cell((roughness - min_roughness) / (1.0 - min_roughness), sheen_roughness_steps);
}

} // namespace

double sheen_albedo(double roughness, double cosine) {
  const SheenTable& table = sheen_table();
  const TableCell r = sheen_roughness_cell(roughness),
                  c = table_cell(std::sqrt(std::max(0.0, cosine)), sheen_cosine_steps);
  const auto along = [&](const auto& row) {
    return std::lerp(row[c.first], row[c.first + 1], c.place);
  };
  return std::lerp(along(table.at[r.first]), along(table.at[r.first + 1]), r.place);
}

double mean_sheen_albedo(double roughness) {
  const SheenTable& table = sheen_table();
  const TableCell r = sheen_roughness_cell(roughness);
  return std::lerp(table.mean[r.first], table.mean[r.first + 1], r.place);
}

double below_sheen(const Bsdf& bsdf, double cosine) {
  return bsdf.sheen == Rgb(0.0)
             ? 1.0
             : 1.0 - largest(bsdf.sheen) * sheen_albedo(bsdf.sheen_roughness, cosine);
}

double mean_below_sheen(const Bsdf& bsdf) {
  return bsdf.sheen == Rgb(0.0)
             ? 1.0
             : 1.0 - largest(bsdf.sheen) * mean_sheen_albedo(bsdf.sheen_roughness);
}

double lobe_below_sheen(const Bsdf& bsdf, double cos_out, double cos_in) {
  return bsdf.sheen == Rgb(0.0) ? 1.0
                                : std::min(below_sheen(bsdf, cos_out), below_sheen(bsdf, cos_in));
}

Rgb sheen_lobe(const Bsdf& bsdf, double cos_out, double cos_in) {
  if (bsdf.sheen == Rgb(0.0))
    return Rgb(0.0);
  const double r = bsdf.sheen_roughness;
  return bsdf.sheen * (sheen_albedo(r, cos_out) * sheen_albedo(r, cos_in) /
                       (std::numbers::pi * mean_sheen_albedo(r)));
}

std::string settle_sheen(Material& material) {
  const bool varies = material.sheen_color_texture || material.sheen_roughness_texture;
  material.sheen_color_texture.reset();
  material.sheen_roughness_texture.reset();
  return varies ? "textures of sheen that vary are left out in materials" : "";
}

} // namespace meninas
