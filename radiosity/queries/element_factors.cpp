#include "radiosity/queries/element_factors.h"

#include <algorithm>
#include <unordered_map>

namespace meninas {

namespace {

/// Mean of the channels of entry k, whose bands are times `share`.
double mean_weight(const Transport& row, std::size_t k, const Rgb& share) {
  double sum = 0.0;
  for (int band = 0; band < row.bands; ++band)
    sum += double{row.weights[k * static_cast<std::size_t>(row.bands) + static_cast<std::size_t>(band)]} * share[band];
  return sum / row.bands;
}

} // namespace

ElementFactors element_factors(const LightScene& light, ElementId element, FormFactorSettings settings) {
  if (settings.method == FormFactorMethod::analytic)
    settings.method = FormFactorMethod::rays;
  const RowRange one{index(element), 1};
  const FormFactors whole = assemble_some_rows(light, one, settings);
  settings.max_bounces = 0;
  const FormFactors straight = assemble_some_rows(light, one, settings);

  // Rows are shares of the light that was not cut: what mirrors would have reflected is part of the whole.
  const Rgb cut(straight.closure[0].cut_light), cut_of_whole(whole.closure[0].cut_light);
  const Rgb share = glm::max(Rgb(0.0), 1.0 - cut) / glm::max(Rgb(1e-9), 1.0 - cut_of_whole);
  std::unordered_map<std::uint32_t, double> direct;
  for (std::size_t k = 0; k < straight.transport.columns.size(); ++k)
    direct[straight.transport.columns[k]] = mean_weight(straight.transport, k, share);

  ElementFactors factors;
  factors.closure = whole.closure[0];
  for (std::size_t k = 0; k < whole.transport.columns.size(); ++k) {
    const std::uint32_t to = whole.transport.columns[k];
    const double all = mean_weight(whole.transport, k, Rgb(1.0));
    const auto known = direct.find(to);
    // Weights are single precision: what differs by its rounding is the same.
    constexpr double rounding = 1e-5;
    const double seen = known == direct.end() ? 0.0 : known->second, mirrored = all - seen;
    const bool is_mirrored = mirrored > rounding * all;
    factors.row.push_back({static_cast<ElementId>(to), is_mirrored ? seen : all, is_mirrored ? mirrored : 0.0});
  }
  return factors;
}

} // namespace meninas
