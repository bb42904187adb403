#include "raytrace/glossy_frustum.h"

#include "scenes/materials/bsdf.h"
#include "scenes/materials/microfacets.h"
#include "scenes/materials/refraction.h"
#include "scenes/materials/sheen.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

Direction mirrored(const Direction& out) { return {-out.x, -out.y, out.z}; }

/// A cell's direction before the weights are brought to their norm:
/// g, and g times the shares of what is no metal.
struct Cell {
  Direction in;
  double visible;
  Rgb metal;          ///< its reflectance at the facet
  Rgb coat;           ///< g times the reflectance of the coat
  Rgb glass, through; ///< and what glass reflects and passes
};

Cell weighed(const Bsdf& bsdf, const Direction& in, double cosine, double visible) {
  const Rgb metal = metal_reflectance(bsdf, cosine);
  Cell cell{in,       visible, metal, visible * (facet_reflectance(bsdf, cosine) - metal),
            Rgb(0.0), Rgb(0.0)};
  if (bsdf.glass > 0.0) {
    const GlassShares shares = glass_shares(bsdf.pane, cosine);
    cell.glass = visible * bsdf.glass * shares.reflected;
    cell.coat -= cell.glass;
    cell.through = visible * bsdf.glass * shares.passed;
  }
  return cell;
}

std::optional<Cell> cell_at(const Bsdf& bsdf, const Direction& out, double u, double v) {
  const Facets facets = facets_of(bsdf);
  const Direction h = visible_facet(facets, out, u, v);
  const double cosine = glm::dot(out, h);
  const Direction in = 2.0 * cosine * h - out;
  if (in.z <= 0.0)
    return std::nullopt;
  const double lambda = smith_lambda(facets, out);
  const double visible = (1.0 + lambda) / (1.0 + lambda + smith_lambda(facets, in));
  return weighed(bsdf, in, cosine, visible);
}

/// The factor that turns a sum into the albedo it should be.
double norm(double albedo, double sum) { return sum > 0.0 ? albedo / sum : 0.0; }

/// The lobe without width.
void add_ideal(const Bsdf& bsdf, const Direction& out, std::vector<LobeRay>& rays) {
  rays.push_back({mirrored(out), ideal_reflection(bsdf, out.z)});
  if (const auto behind = direction_behind(bsdf.pane, out); bsdf.glass > 0.0 && behind)
    rays.push_back({*behind, facet_transmittance(bsdf, out.z), true});
}

void add_cell(const Bsdf& bsdf, const Direction& out, const Cell& cell, double metal_norm,
              double coat_norm, std::vector<LobeRay>& rays) {
  const Rgb weight = cell.metal * (cell.visible * metal_norm) + cell.coat * coat_norm;
  if (!(bsdf.glass > 0.0)) {
    rays.push_back({cell.in, lobe_below_sheen(bsdf, out.z, cell.in.z) * weight});
    return;
  }
  rays.push_back({cell.in, weight + cell.glass * metal_norm});
  rays.push_back({{cell.in.x, cell.in.y, -cell.in.z}, cell.through * metal_norm, true});
}

} // namespace

int lobe_divisions(const Bsdf& bsdf, const Direction& out, double directions) {
  constexpr double most = 64.0;
  if (bsdf.alpha == 0.0)
    return 1;
  const double energy =
      std::max(largest(bsdf.metal) + bsdf.coat * coat_albedo(bsdf, out), bsdf.glass);
  const double cells = directions * bsdf.roughness * energy;
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(cells)), 1.0, most));
}

double lobe_density(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  const Facets facets = facets_of(bsdf);
  const double lambda = smith_lambda(facets, out);
  return 0.25 * facet_density(facets, glm::normalize(out + in)) / (out.z * (1.0 + lambda));
}

void glossy_frustum(const Bsdf& bsdf, const Direction& out, int divisions, Vec2 shift,
               std::vector<LobeRay>& rays) {
  rays.clear();
  if (bsdf.alpha == 0.0)
    return add_ideal(bsdf, out, rays);
  // The two parts of S, each with the sum that its norm is made of.
  std::vector<Cell> cells;
  double metal_sum = 0.0, coat_sum = 0.0;
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; j < divisions; ++j) {
      const auto cell = cell_at(bsdf, out, (i + shift.x) / divisions, (j + shift.y) / divisions);
      if (!cell)
        continue;
      metal_sum += cell->visible;
      coat_sum += largest(cell->coat);
      cells.push_back(*cell);
    }
  // A coarse grid at a grazing angle may dip below the surface as a whole:
  // the mirror direction stands for it.
  if (cells.empty()) {
    cells.push_back(weighed(bsdf, mirrored(out), out.z, 1.0));
    metal_sum = 1.0;
    coat_sum = largest(cells.front().coat);
  }
  const SchlickAlbedo albedo = lobe_albedo(bsdf, out);
  const double metal_norm = norm(albedo.f0 + albedo.f90, metal_sum);
  const double coat_norm = norm(bsdf.coat * coat_albedo(bsdf, out), coat_sum);
  for (const Cell& cell : cells)
    add_cell(bsdf, out, cell, metal_norm, coat_norm, rays);
}

void lobe_sample(const Bsdf& bsdf, const Direction& out, Vec2 u, std::vector<LobeRay>& rays) {
  rays.clear();
  if (bsdf.alpha == 0.0)
    return add_ideal(bsdf, out, rays);
  if (const auto cell = cell_at(bsdf, out, u.x, u.y))
    add_cell(bsdf, out, *cell, 1.0, 1.0, rays);
}

} // namespace meninas
