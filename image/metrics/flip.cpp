#include "image/metrics/flip.h"

#include "scenes/types.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meninas {
namespace {

using std::numbers::pi;

// --- Colour spaces, with the matrix of linear sRGB and its white as the FLIP authors take them

/// Rows sum to the white point.
constexpr glm::dmat3 xyz_from_rgb{
    {10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0},
    {8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0},
    {4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0}};

const Vec3 white = xyz_from_rgb * Vec3(1.0);
const glm::dmat3 rgb_from_xyz = glm::inverse(xyz_from_rgb);

/// L*a*b* without its cube root, linear in light:
/// achromatic, red-green and blue-yellow (section 4.1).
Vec3 opponents(const Vec3& rgb) {
  const Vec3 t = xyz_from_rgb * rgb / white;
  return {116.0 * t.y - 16.0, 500.0 * (t.x - t.y), 200.0 * (t.y - t.z)};
}

Vec3 rgb_of_opponents(const Vec3& c) {
  const double y = (c.x + 16.0) / 116.0;
  return rgb_from_xyz * (Vec3(y + c.y / 500.0, y, y - c.z / 200.0) * white);
}

/// L*a*b* with Hunt's adjustment: dark colours are less colourful (eq. 5).
Vec3 hunt_lab(const Vec3& rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
  };
  const Vec3 t = xyz_from_rgb * rgb / white;
  const double fx = f(t.x), fy = f(t.y), fz = f(t.z);
  const double lightness = 116.0 * fy - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (fx - fy), 0.01 * lightness * 200.0 * (fy - fz)};
}

/// City block in lightness, Euclidean in chroma (HyAB, eq. 6).
double hyab(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

using Channels = std::array<Channel, 3>;

Channels opponent_channels(const Image& picture) {
  Channels channels;
  channels.fill(Channel(picture.width, picture.height));
  for (std::size_t k = 0; k < picture.pixels.size(); ++k) {
    const Vec3 c = opponents(glm::clamp(Vec3(picture.pixels[k]), 0.0, 1.0));
    for (int i = 0; i < 3; ++i)
      channels[static_cast<std::size_t>(i)].values[k] = static_cast<float>(c[i]);
  }
  return channels;
}

// --- The colour pipeline (section 4.1)

/// One Gaussian of a contrast sensitivity function:
/// a sqrt(pi / b) exp(-pi^2 d^2 / b) at d degrees (eq. 2).
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity achromatic{1.0, 0.0047};
constexpr Sensitivity red_green{1.0, 0.0053};
constexpr Sensitivity blue_yellow_narrow{34.1, 0.04};
constexpr Sensitivity blue_yellow_wide{13.5, 0.025};

/// The channel as the eye resolves it: filtered with the normalised sum of the Gaussians.
Channel as_resolved(const Channel& channel, std::initializer_list<Sensitivity> sensitivities,
                    double pixels_per_degree) {
  // All filters reach as far as the widest:
  // three of its deviations, sqrt(b / (2 pi^2)) degrees each.
  const int radius = static_cast<int>(
      std::ceil(3.0 * std::sqrt(blue_yellow_narrow.b / (2.0 * pi * pi)) * pixels_per_degree));
  std::vector<double> sums(channel.values.size(), 0.0);
  double total = 0.0;
  for (const auto& [a, b] : sensitivities) {
    const Kernel kernel = gaussian(radius, std::sqrt(b / (2.0 * pi * pi)) * pixels_per_degree);
    const double weight = a * std::sqrt(pi / b);
    const double kernel_sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
    const Channel filtered = weighted_sums(channel, kernel, kernel);
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += weight * filtered.values[k];
    total += weight * kernel_sum * kernel_sum;
  }
  Channel result(channel.width, channel.height);
  for (std::size_t k = 0; k < sums.size(); ++k)
    result.values[k] = static_cast<float>(sums[k] / total);
  return result;
}

Channels as_resolved(const Channels& opponent, double pixels_per_degree) {
  return {as_resolved(opponent[0], {achromatic}, pixels_per_degree),
          as_resolved(opponent[1], {red_green}, pixels_per_degree),
          as_resolved(opponent[2], {blue_yellow_narrow, blue_yellow_wide}, pixels_per_degree)};
}

Vec3 perceived_colour(const Channels& resolved, std::size_t k) {
  const Vec3 c(resolved[0].values[k], resolved[1].values[k], resolved[2].values[k]);
  return hunt_lab(glm::clamp(rgb_of_opponents(c), 0.0, 1.0));
}

/// The distance compressed to [0, 1]: small differences take most of the range (eq. 7 and 8).
double redistributed(double distance) {
  constexpr double exponent = 0.7, p_c = 0.4, p_t = 0.95;
  static const double c_max =
      std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), exponent);
  const double power = std::pow(distance, exponent);
  return power < p_c * c_max ? p_t / (p_c * c_max) * power
                             : p_t + (power - p_c * c_max) / (c_max - p_c * c_max) * (1.0 - p_t);
}

// --- The feature pipeline (section 4.2)

/// Positive weights sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0.0, negative = 0.0;
  for (const double weight : kernel)
    (weight > 0.0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel)
    weight /= weight > 0.0 ? positive : negative;
  return kernel;
}

/// The lengths of the gradient (edges) and of the second
/// derivatives (points) of a Gaussian-smoothed channel.
struct Features {
  Channel edges, points;
};

Channel lengths(const Channel& along_x, const Channel& along_y) {
  Channel result(along_x.width, along_x.height);
  std::ranges::transform(along_x.values, along_y.values, result.values.begin(),
                         [](float x, float y) { return std::hypot(x, y); });
  return result;
}

Features features_of(const Channel& achromatic_channel, double pixels_per_degree) {
  constexpr double edge_width = 0.082; // degrees
  const double deviation = 0.5 * edge_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  Kernel smooth = gaussian(radius, deviation), first = smooth, second = smooth;
  const double sum = std::accumulate(smooth.begin(), smooth.end(), 0.0);
  for (int k = -radius; k <= radius; ++k) {
    const auto i = static_cast<std::size_t>(k + radius);
    first[i] *= -k;
    second[i] *= k * k / (deviation * deviation) - 1.0;
    smooth[i] /= sum;
  }
  first = balanced(first);
  second = balanced(second);
  Channel normalised = achromatic_channel; // Y in [0, 1]
  for (float& value : normalised.values)
    value = (value + 16.0F) / 116.0F;
  return {
      lengths(weighted_sums(normalised, first, smooth), weighted_sums(normalised, smooth, first)),
      lengths(weighted_sums(normalised, second, smooth),
              weighted_sums(normalised, smooth, second))};
}

} // namespace

Channel flip_map(const Image& a, const Image& b, const FlipSettings& settings) {
  expects(a.width == b.width && a.height == b.height, "pictures that are compared have one size");
  const double ppd = settings.pixels_per_degree;
  const Channels opponent_a = opponent_channels(a), opponent_b = opponent_channels(b);
  const Channels resolved_a = as_resolved(opponent_a, ppd),
                 resolved_b = as_resolved(opponent_b, ppd);
  const Features features_a = features_of(opponent_a[0], ppd);
  const Features features_b = features_of(opponent_b[0], ppd);

  Channel map(a.width, a.height);
  tbb::parallel_for(std::size_t{0}, map.values.size(), [&](std::size_t k) {
    const double colour =
        redistributed(hyab(perceived_colour(resolved_a, k), perceived_colour(resolved_b, k)));
    const double feature =
        std::max(std::abs(features_a.edges.values[k] - features_b.edges.values[k]),
                 std::abs(features_a.points.values[k] - features_b.points.values[k]));
    // A difference in features makes one in colour more visible (eq. 9 to 11).
    const double feature_difference = std::sqrt(feature / std::numbers::sqrt2);
    map.values[k] = static_cast<float>(std::pow(colour, 1.0 - feature_difference));
  });
  return map;
}

} // namespace meninas
