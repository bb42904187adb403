#include "radiosity/field/interpolation_error.h"

#include "radiosity/mesh/vertex_edges.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

double brightest(const Rgb& light) {
  return std::max({std::abs(light.r), std::abs(light.g), std::abs(light.b)});
}

/// The largest |f''| at a vertex, over pairs of its edges.
double largest_derivative(const ElementMesh& mesh, std::span<const glm::vec3> irradiance,
                          std::size_t v, std::span<const std::uint32_t> ends) {
  double largest_bend = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = i + 1; k < ends.size(); ++k) {
      const std::uint32_t a = ends[i], b = ends[k];
      if (are_in_line(mesh.vertices[a] - mesh.vertices[v], mesh.vertices[b] - mesh.vertices[v]))
        largest_bend =
            std::max(largest_bend, brightest(second_derivative(mesh, irradiance, v, a, b)));
    }
  return largest_bend;
}

/// By ElementVertexId.
std::vector<double> second_derivatives(const ElementMesh& mesh,
                                       std::span<const glm::vec3> irradiance) {
  const VertexEdges edges = edges_of(mesh);
  std::vector<double> derivatives;
  derivatives.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    derivatives.push_back(largest_derivative(mesh, irradiance, v, edges.of(v)));
  return derivatives;
}

double off_in_the_middle(double derivative, double size) { return derivative * size * size / 8.0; }

/// The median over vertices of e / H.
double ordinary_bend(const ElementMesh& mesh, std::span<const glm::vec3> irradiance,
                     std::span<const double> derivatives,
                     std::span<const std::uint8_t> on_lamps) {
  std::vector<double> ratios;
  for (std::size_t v = 0; v < derivatives.size(); ++v)
    if (const double light = brightest(irradiance[v]);
        light > 0.0 && (on_lamps.empty() || on_lamps[v] == 0))
      ratios.push_back(off_in_the_middle(derivatives[v], size_of(mesh, mesh.element_of_vertex[v])) /
                       light);
  if (ratios.empty())
    return 0.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  return *middle;
}

/// The error of an element, as a share of B_mean, weighted by its part of all area.
double of_all(const ElementMesh& mesh, std::size_t e, double off, const BendScale& scale) {
  const Rgb rho = scattered_share(mesh, e);
  return std::max({rho.r, rho.g, rho.b}) * off * std::sqrt(mesh.area[e] / scale.area) /
         scale.radiosity;
}

} // namespace

BendScale bend_scale(const ElementMesh& mesh, std::span<const Rgb> reflected) {
  double area = 0.0;
  Rgb power(0.0);
  for (std::size_t e = 0; e < reflected.size(); ++e) {
    area += mesh.area[e];
    power += mesh.area[e] * reflected[e];
  }
  if (!(area > 0.0))
    return {};
  return {area / double(reflected.size()), std::max({power.r, power.g, power.b}) / area};
}

std::vector<double> interpolation_error(const ElementMesh& mesh,
                                      std::span<const glm::vec3> irradiance, const BendScale& scale,
                                      NoiseThreshold stands_out,
                                      std::span<const std::uint8_t> on_lamps) {
  std::vector<double> bends(element_count(mesh), 0.0);
  if (!(scale.radiosity > 0.0))
    return bends;
  const std::vector<double> derivatives = second_derivatives(mesh, irradiance);
  const double ordinary = stands_out.times * ordinary_bend(mesh, irradiance, derivatives, on_lamps);
  for (std::size_t e = 0; e < bends.size(); ++e) {
    const double size = size_of(mesh, static_cast<ElementId>(e));
    double off = 0.0;
    for (const auto corner : mesh.corners[e])
      off = std::max(off, off_in_the_middle(derivatives[index(corner)], size) -
                              ordinary * brightest(irradiance[index(corner)]));
    bends[e] = of_all(mesh, e, off, scale);
  }
  return bends;
}

std::vector<double> edge_difference_error(const ElementMesh& mesh,
                                        std::span<const glm::vec3> irradiance,
                                        const BendScale& scale) {
  std::vector<double> bends(element_count(mesh), 0.0);
  if (!(scale.radiosity > 0.0))
    return bends;
  const VertexEdges edges = edges_of(mesh);
  const auto goes_on = [&](std::uint32_t v, std::uint32_t from) {
    const auto ends = edges.of(v);
    return std::ranges::any_of(ends, [&](std::uint32_t to) {
      return are_in_line(mesh.vertices[from] - mesh.vertices[v], mesh.vertices[to] - mesh.vertices[v]);
    });
  };
  for (std::size_t e = 0; e < bends.size(); ++e)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto a = index(mesh.corners[e][c]), b = index(mesh.corners[e][(c + 1) % 4]);
      if (a != b && !goes_on(a, b) && !goes_on(b, a))
        bends[e] = std::max(bends[e],
                            of_all(mesh, e, brightest(irradiance[a] - irradiance[b]) / 4.0, scale));
    }
  return bends;
}

std::vector<std::uint8_t> bent_by_more(std::span<const double> bends, double x) {
  std::vector<std::uint8_t> bent;
  bent.reserve(bends.size());
  for (const double bend : bends)
    bent.push_back(bend > x ? 1 : 0);
  return bent;
}

} // namespace meninas
