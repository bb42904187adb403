#include "image/metrics/metrics.h"

#include "image/metrics/ssim.h"
#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meninas {

const char* name_of(Metric metric) {
  switch (metric) {
  case Metric::rmse:
    return "rmse";
  case Metric::relmse:
    return "relmse";
  case Metric::mae:
    return "mae";
  case Metric::psnr:
    return "psnr";
  case Metric::max_abs:
    return "max_abs";
  case Metric::ssim:
    return "ssim";
  case Metric::flip:
    return "flip";
  }
  return "";
}

bool larger_is_nearer(Metric metric) { return metric == Metric::psnr || metric == Metric::ssim; }

double value_of(const PictureDifference& difference, Metric metric) {
  switch (metric) {
  case Metric::rmse:
    return difference.rmse;
  case Metric::relmse:
    return difference.relmse;
  case Metric::mae:
    return difference.mae;
  case Metric::psnr:
    return difference.psnr;
  case Metric::max_abs:
    return difference.max_abs;
  case Metric::ssim:
    return difference.ssim;
  case Metric::flip:
    return difference.flip;
  }
  return 0.0;
}

static Image displayed(const Image& picture, double exposure) {
  Image result(picture.width, picture.height);
  const double scale = std::exp2(exposure);
  std::ranges::transform(picture.pixels, result.pixels.begin(), [&](const glm::vec3& pixel) {
    return glm::vec3(glm::clamp(scale * Vec3(pixel), 0.0, 1.0));
  });
  return result;
}

static double largest_value(const Image& picture) {
  double largest = 0.0;
  for (const glm::vec3& pixel : picture.pixels)
    largest = std::max<double>(largest, std::max({pixel.r, pixel.g, pixel.b}));
  return largest;
}

static double largest_difference(const glm::vec3& a, const glm::vec3& b) {
  const Vec3 d = glm::abs(Vec3(a) - Vec3(b));
  return std::max({d.r, d.g, d.b});
}

static Vec3 relative_squares(const glm::vec3& a, const glm::vec3& b, double epsilon) {
  const Vec3 d = Vec3(a) - Vec3(b);
  return d * d / (Vec3(b) * Vec3(b) + epsilon);
}

static double sum_of(const Vec3& v) { return v.x + v.y + v.z; }

PictureDifference compare_pictures(const Image& picture, const Image& reference,
                                   const MetricSettings& settings) {
  expects(picture.width == reference.width && picture.height == reference.height,
          "pictures that are compared have one size");
  expects(!picture.pixels.empty(), "pictures that are compared have pixels");
  PictureDifference result;
  result.width = picture.width;
  result.height = picture.height;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec3 &a = picture.at(x, y), &b = reference.at(x, y);
      const Vec3 d = Vec3(a) - Vec3(b);
      result.rmse += sum_of(d * d);
      result.relmse += sum_of(relative_squares(a, b, settings.relmse_epsilon));
      result.mae += sum_of(glm::abs(d));
      if (const double largest = largest_difference(a, b); largest > result.max_abs) {
        result.max_abs = largest;
        result.worst = {x, y};
      }
    }
  const double values = 3.0 * static_cast<double>(picture.pixels.size());
  result.rmse = std::sqrt(result.rmse / values);
  result.relmse /= values;
  result.mae /= values;
  const double peak = settings.peak.value_or(largest_value(reference));
  result.psnr = result.rmse > 0.0 ? 20.0 * std::log10(peak / result.rmse)
                                  : std::numeric_limits<double>::infinity();

  const Image seen = displayed(picture, settings.exposure);
  const Image wanted = displayed(reference, settings.exposure);
  result.ssim_map = ssim_map(seen, wanted);
  result.ssim = mean_ssim(result.ssim_map);
  result.flip_map = flip_map(seen, wanted, settings.flip);
  result.flip = mean_of(result.flip_map);
  return result;
}

Channel error_map(const PictureDifference& difference, Metric metric, const Image& picture,
                  const Image& reference, const MetricSettings& settings) {
  if (metric == Metric::flip)
    return difference.flip_map;
  Channel map(picture.width, picture.height);
  if (metric == Metric::ssim) {
    std::ranges::transform(difference.ssim_map.values, map.values.begin(),
                           [](float ssim) { return 1.0F - ssim; });
    return map;
  }
  const auto error = [&](const glm::vec3& a, const glm::vec3& b) {
    const Vec3 d = glm::abs(Vec3(a) - Vec3(b));
    if (metric == Metric::relmse)
      return sum_of(relative_squares(a, b, settings.relmse_epsilon)) / 3.0;
    if (metric == Metric::mae)
      return sum_of(d) / 3.0;
    if (metric == Metric::max_abs)
      return largest_difference(a, b);
    return std::sqrt(sum_of(d * d) / 3.0);
  };
  std::ranges::transform(
      picture.pixels, reference.pixels, map.values.begin(),
      [&](const glm::vec3& a, const glm::vec3& b) { return static_cast<float>(error(a, b)); });
  return map;
}

std::optional<std::string> first_bad_pixel(const Image& picture) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (const float value = picture.at(x, y)[c]; !std::isfinite(value))
          return fmt::format("pixel ({}, {}) is {}", x, y, std::isnan(value) ? "NaN" : "infinite");
  return std::nullopt;
}

} // namespace meninas
