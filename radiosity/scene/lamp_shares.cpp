#include "radiosity/scene/lamp_shares.h"

namespace meninas {

void add_up_to(const std::vector<Rgb>& whole, LightByLamp& parts) {
  for (std::size_t row = 0; row < parts.rows; ++row)
    for (int band = 0; band < 3; ++band) {
      const std::span<double> part = parts[row].subspan(static_cast<std::size_t>(band));
      double sum = 0.0;
      for (std::size_t k = 0; k < part.size(); k += 3)
        sum += part[k];
      const double all = whole[row][band];
      if (!(sum > 0.0))
        continue;
      for (std::size_t k = 0; k < part.size(); k += 3)
        part[k] *= all / sum;
    }
}

void set_row(LightByLamp& light, std::size_t row, const ArrivedByLamp& values) {
  for (std::size_t l = 0; l < values.size(); ++l)
    for (int band = 0; band < 3; ++band)
      light[row][3 * l + static_cast<std::size_t>(band)] = values[l][band];
}

std::vector<Rgb> light_of_lamp(const LightByLamp& light, std::size_t lamp) {
  std::vector<Rgb> values;
  values.reserve(light.rows);
  for (std::size_t row = 0; row < light.rows; ++row) {
    const std::span<const double> own = light[row].subspan(3 * lamp);
    values.emplace_back(own[0], own[1], own[2]);
  }
  return values;
}

void set_light_of_lamp(LightByLamp& light, std::size_t lamp, const std::vector<Rgb>& values) {
  for (std::size_t row = 0; row < values.size(); ++row)
    for (int band = 0; band < 3; ++band)
      light[row][3 * lamp + static_cast<std::size_t>(band)] = values[row][band];
}

LightByLamp no_light(std::size_t rows, std::size_t lamps) {
  return {.rows = rows, .columns = 3 * lamps};
}

LightByLamp& operator+=(LightByLamp& light, const LightByLamp& more) {
  for (std::size_t k = 0; k < light.values.size(); ++k)
    light.values[k] += more.values[k];
  return light;
}

} // namespace meninas
