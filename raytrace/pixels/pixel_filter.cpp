#include "raytrace/pixels/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

std::string_view name_of(PixelFilter filter) {
  switch (filter) {
  case PixelFilter::box:
    return "box";
  case PixelFilter::tent:
    return "tent";
  case PixelFilter::gaussian:
    return "gaussian";
  case PixelFilter::blackman_harris:
    break;
  }
  return "blackman-harris";
}

/// Half the width of what the filter covers.
static double radius_of(PixelFilter filter) {
  switch (filter) {
  case PixelFilter::box:
    return 0.5;
  case PixelFilter::tent:
    return 1.0;
  case PixelFilter::gaussian:
  case PixelFilter::blackman_harris:
    break;
  }
  return 1.5;
}

/// w(x) within the radius, but for a factor.
static double shape_of(PixelFilter filter, double x) {
  const double radius = radius_of(filter);
  switch (filter) {
  case PixelFilter::box:
    return 1.0;
  case PixelFilter::tent:
    return 1.0 - std::abs(x);
  case PixelFilter::gaussian:
    return std::exp(-2.0 * x * x) - std::exp(-2.0 * radius * radius);
  case PixelFilter::blackman_harris:
    break;
  }
  const double a = std::numbers::pi * x / radius;
  return 0.35875 + 0.48829 * std::cos(a) + 0.14128 * std::cos(2.0 * a) +
         0.01168 * std::cos(3.0 * a);
}

// Steps of the midpoint rule over the filter; a power of two, so that the box comes out exactly.
static constexpr int fine_steps = 1 << 12;

static double place_at(PixelFilter filter, double step) {
  return radius_of(filter) * (2.0 * step / fine_steps - 1.0);
}

static double integral_of(PixelFilter filter) {
  double sum = 0.0;
  for (int k = 0; k < fine_steps; ++k)
    sum += shape_of(filter, place_at(filter, k + 0.5));
  return sum * 2.0 * radius_of(filter) / fine_steps;
}

double filter_weight(PixelFilter filter, double x) {
  if (std::abs(x) > radius_of(filter))
    return 0.0;
  return shape_of(filter, x) / integral_of(filter);
}

FilterPlaces filter_places(PixelFilter filter) {
  FilterPlaces places;
  places.fill(static_cast<float>(0.5 + radius_of(filter)));
  places.front() = static_cast<float>(0.5 - radius_of(filter));
  const double whole = integral_of(filter) / (2.0 * radius_of(filter) / fine_steps);
  double below = 0.0;
  std::size_t k = 1;
  for (int step = 0; step < fine_steps && k < filter_steps; ++step) {
    const double weight = shape_of(filter, place_at(filter, step + 0.5));
    // The weight of a fine step is spread evenly over it.
    for (; k < filter_steps && below + weight >= whole * double(k) / filter_steps; ++k) {
      const double share = (whole * double(k) / filter_steps - below) / weight;
      places[k] = static_cast<float>(0.5 + place_at(filter, step + share));
    }
    below += weight;
  }
  return places;
}

} // namespace meninas
