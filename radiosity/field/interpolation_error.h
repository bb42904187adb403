// Where a field bends within elements:
// what interpolation between vertices hides, by second differences.
//
// Along two edges that go on from one another, from a by way of v to b, the second derivative is
//
//   f'' = 2 ((f_a - f_v) / |a - v| + (f_b - f_v) / |b - v|) / (|a - v| + |b - v|),
//
// and linear interpolation over an element of size s is off by e = s^2 |f''| / 8 in its middle:
// of the irradiance of its corners, the largest, in the brightest channel. An element is bent where
//
//   rho max(e - k noise H, 0) sqrt(A / A_mean) / B_mean  >  X.
//
// The noise of e / H is taken to be its median over all vertices, as most of a field is smooth.
// The threshold is 3 times the median for gathered light (ray noise) and once the median for direct
// light (noise only in penumbrae). A lamp may have thousands of small faces, which take the mean of
// their elements (curves/smoothing_groups.h) and so no noise: the median is that of the others.
// Limit: borders of a surface have no second difference across them;
// elements there have it from their inner corners.
//
// An edge that goes on at neither end, on a surface of one element, has none at all:
// if light is even at one end and from there a parabola, f'' = 2 |f_a - f_b| / s^2,
// an element with such edges is off by e = |f_a - f_b| / 4, the largest.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <span>
#include <vector>

namespace meninas {

/// The scale of the interpolation error.
struct BendScale {
  double area = 0.0;      ///< A_mean, m^2
  double radiosity = 0.0; ///< B_mean, W/m^2, the brightest channel
};

/// The scale of the elements that were solved; `reflected` by ElementId.
BendScale bend_scale(const ElementMesh& mesh, std::span<const Rgb> reflected);

/// k.
struct NoiseThreshold {
  double times;
};
inline constexpr NoiseThreshold of_gathered{3.0}, of_source{1.0};

/// By ElementId, what is held against X. `irradiance` by ElementVertexId,
/// `on_lamps` likewise: 1 for vertices of a lamp that take means; empty: none does.
std::vector<double> interpolation_error(const ElementMesh& mesh,
                                      std::span<const glm::vec3> irradiance, const BendScale& scale,
                                      NoiseThreshold stands_out = of_gathered,
                                      std::span<const std::uint8_t> on_lamps = {});

/// The same from edges without a continuation: an upper bound for parabolic light, not an estimate.
std::vector<double> edge_difference_error(const ElementMesh& mesh,
                                        std::span<const glm::vec3> irradiance,
                                        const BendScale& scale);

/// By ElementId, 1 where the element is bent by more than X.
std::vector<std::uint8_t> bent_by_more(std::span<const double> bends, double x);

} // namespace meninas
