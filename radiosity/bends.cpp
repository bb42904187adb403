#include "radiosity/bends.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

struct Edge {
  std::uint32_t from, to;
  auto operator<=>(const Edge&) const = default;
};

/// Both ways, by `from`.
std::vector<Edge> edges_of(const ElementMesh& mesh) {
  std::vector<Edge> edges;
  for (const ElementCorners& corners : mesh.corners)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto a = index(corners[c]), b = index(corners[(c + 1) % 4]);
      if (a != b) {
        edges.push_back({a, b});
        edges.push_back({b, a});
      }
    }
  std::ranges::sort(edges);
  const auto same = std::ranges::unique(edges);
  edges.erase(same.begin(), same.end());
  return edges;
}

double brightest(const glm::vec3& light) {
  return std::max(
      {std::abs(double{light.r}), std::abs(double{light.g}), std::abs(double{light.b})});
}

/// The largest |f''| at a vertex, over pairs of its edges.
double second_derivative(const ElementMesh& mesh, std::span<const glm::vec3> irradiance,
                         std::span<const Edge> edges) {
  constexpr double straight = -0.9; // the cosine between edges that go on from one another
  double largest_bend = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      const std::uint32_t v = edges[i].from, a = edges[i].to, b = edges[k].to;
      const Vec3 to_a = mesh.vertices[a] - mesh.vertices[v],
                 to_b = mesh.vertices[b] - mesh.vertices[v];
      const double la = glm::length(to_a), lb = glm::length(to_b);
      if (!(glm::dot(to_a, to_b) < straight * la * lb))
        continue;
      const glm::vec3 slope = (irradiance[a] - irradiance[v]) / static_cast<float>(la) +
                              (irradiance[b] - irradiance[v]) / static_cast<float>(lb);
      largest_bend = std::max(largest_bend, 2.0 * brightest(slope) / (la + lb));
    }
  return largest_bend;
}

/// By ElementVertexId.
std::vector<double> second_derivatives(const ElementMesh& mesh,
                                       std::span<const glm::vec3> irradiance) {
  const std::vector<Edge> edges = edges_of(mesh);
  std::vector<double> derivatives(mesh.vertices.size(), 0.0);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first;
    while (last < edges.size() && edges[last].from == edges[first].from)
      ++last;
    derivatives[edges[first].from] = second_derivative(
        mesh, irradiance, std::span<const Edge>(edges).subspan(first, last - first));
    first = last;
  }
  return derivatives;
}

double off_in_the_middle(double derivative, double size) { return derivative * size * size / 8.0; }

/// The median over vertices of e / H.
double ordinary_bend(const ElementMesh& mesh, std::span<const glm::vec3> irradiance,
                     std::span<const double> derivatives) {
  std::vector<double> ratios;
  for (std::size_t v = 0; v < derivatives.size(); ++v)
    if (const double light = brightest(irradiance[v]); light > 0.0)
      ratios.push_back(off_in_the_middle(derivatives[v], size_of(mesh, mesh.element_of_vertex[v])) /
                       light);
  if (ratios.empty())
    return 0.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  return *middle;
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

std::vector<std::uint8_t> bent_elements(const ElementMesh& mesh,
                                        std::span<const glm::vec3> irradiance,
                                        const BendScale& scale, double x) {
  constexpr double stands_out = 3.0; // times what is ordinary
  std::vector<std::uint8_t> bent(element_count(mesh), 0);
  if (!(scale.radiosity > 0.0))
    return bent;
  const std::vector<double> derivatives = second_derivatives(mesh, irradiance);
  const double ordinary = stands_out * ordinary_bend(mesh, irradiance, derivatives);
  for (std::size_t e = 0; e < bent.size(); ++e) {
    const double size = size_of(mesh, static_cast<ElementId>(e));
    double off = 0.0;
    for (const auto corner : mesh.corners[e])
      off = std::max(off, off_in_the_middle(derivatives[index(corner)], size) -
                              ordinary * brightest(irradiance[index(corner)]));
    const Rgb& rho = mesh.reflectance[e];
    const double share = std::max({rho.r, rho.g, rho.b}) * std::sqrt(mesh.area[e] / scale.area);
    bent[e] = share * off > x * scale.radiosity ? 1 : 0;
  }
  return bent;
}

} // namespace meninas
