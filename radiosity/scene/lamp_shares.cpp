#include "radiosity/scene/lamp_shares.h"

namespace meninas {

void add_up_to(const std::vector<Rgb>& whole, LightByLamp& parts) {
  const Eigen::Index lamps = parts.cols() / 3;
  for (Eigen::Index row = 0; row < parts.rows(); ++row)
    for (Eigen::Index band = 0; band < 3; ++band) {
      double sum = 0.0;
      for (Eigen::Index l = 0; l < lamps; ++l)
        sum += parts(row, 3 * l + band);
      const double all = whole[static_cast<std::size_t>(row)][static_cast<int>(band)];
      if (!(sum > 0.0))
        continue;
      for (Eigen::Index l = 0; l < lamps; ++l)
        parts(row, 3 * l + band) *= all / sum;
    }
}

void set_row(LightByLamp& light, std::size_t row, const ArrivedByLamp& values) {
  for (std::size_t l = 0; l < values.size(); ++l)
    for (int band = 0; band < 3; ++band)
      light(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(3 * l) + band) =
          values[l][band];
}

std::vector<Rgb> light_of_lamp(const LightByLamp& light, std::size_t lamp) {
  std::vector<Rgb> values;
  values.reserve(static_cast<std::size_t>(light.rows()));
  const auto column = static_cast<Eigen::Index>(3 * lamp);
  for (Eigen::Index row = 0; row < light.rows(); ++row)
    values.emplace_back(light(row, column), light(row, column + 1), light(row, column + 2));
  return values;
}

void set_light_of_lamp(LightByLamp& light, std::size_t lamp, const std::vector<Rgb>& values) {
  for (std::size_t row = 0; row < values.size(); ++row)
    for (int band = 0; band < 3; ++band)
      light(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(3 * lamp) + band) =
          values[row][band];
}

LightByLamp no_light(std::size_t rows, std::size_t lamps) {
  return LightByLamp::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(3 * lamps));
}

} // namespace meninas
