#include "runs/walk/walk_lamps.h"

#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

void check_walk_lamps(const std::string& file, std::size_t lamps, std::size_t vertices) {
  constexpr const char* advice = "give several the same `extras.lamp`, or go by --by-lamp material";
  if (lamps > max_walk_lamps)
    throw InputError(file, "", fmt::format("has {} lamps, and a page has dimmers for {} at the most: {}",
                                           lamps, max_walk_lamps, advice));
  if (lamps * vertices > max_lamp_vertices)
    throw InputError(file, "",
                     fmt::format("has {} lamps at {} vertices, and a page takes {} lamps at so many: {}, "
                                 "or try --quality draft",
                                 lamps, vertices, max_lamp_vertices / vertices, advice));
}

float scale_of_halves(std::span<const glm::vec3> irradiance) {
  constexpr float brightest_half = 16384.0F;
  float most = 0.0F;
  for (const glm::vec3& value : irradiance)
    most = std::max(most, largest(value));
  return most > 0.0F ? most / brightest_half : 1.0F;
}

std::vector<std::uint32_t> halves_by_green(std::span<const glm::vec3> irradiance, float scale) {
  std::vector<std::uint32_t> rows;
  rows.reserve(3 * irradiance.size());
  for (const glm::vec3& value : irradiance) {
    const auto bits = [&](int band) { return half_bits(std::max(value[band], 0.0F) / scale); };
    const std::uint32_t green = bits(1);
    rows.insert(rows.end(), {green, bits(0) - green, bits(2) - green});
  }
  return rows;
}

std::vector<glm::vec3> under_factors(std::span<const std::vector<glm::vec3>> irradiance_by_lamp,
                                     std::span<const WalkLamp> lamps) {
  expects(irradiance_by_lamp.size() == lamps.size(), "a factor for each lamp");
  std::vector<glm::vec3> sum(lamps.empty() ? 0 : irradiance_by_lamp.front().size(), glm::vec3(0.0F));
  for (std::size_t l = 0; l < lamps.size(); ++l)
    for (std::size_t v = 0; v < sum.size(); ++v)
      sum[v] += glm::vec3(lamps[l].factor) * irradiance_by_lamp[l][v];
  return sum;
}

} // namespace meninas
