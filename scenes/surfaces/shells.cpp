#include "scenes/surfaces/shells.h"

#include "scenes/surfaces/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {
namespace {

/// The bounds, which way the faces look, and the volume if the shell has one.
void measure(const Scene& scene, Shell& shell) {
  for (const TriangleId face : shell.faces) {
    for (const Point3& corner : corners(scene, face)) {
      shell.bounds.low = glm::min(shell.bounds.low, corner);
      shell.bounds.high = glm::max(shell.bounds.high, corner);
    }
    shell.double_sided = shell.double_sided || material_of(scene, face).double_sided;
  }
  const Point3 middle = 0.5 * (shell.bounds.low + shell.bounds.high);
  double volume = 0.0;
  double away = 0.0;
  double most = 0.0;
  for (const TriangleId face : shell.faces) {
    const auto p = corners(scene, face);
    const Vec3 area = area_vector(p);
    const Vec3 out = (p[0] + p[1] + p[2]) / 3.0 - middle;
    volume += glm::dot(p[0] - middle, area) / 3.0;
    away += glm::dot(out, area);
    most += glm::length(out) * glm::length(area);
  }
  shell.outwards = most > 0.0 ? away / most : 0.0;
  shell.volume = shell.closed && shell.oriented ? volume : 0.0;
}

} // namespace

std::vector<Shell> find_shells(const Scene& scene, const Topology& topology) {
  const auto count = static_cast<std::uint32_t>(scene.triangles.size());
  DisjointSets groups(count);
  const auto edges = static_cast<std::uint32_t>(topology.first_use.size() - 1);
  for (std::uint32_t edge = 0; edge < edges; ++edge) {
    if (const auto uses = uses_of(topology, edge); uses.size() == 2) {
      groups.join(index(uses[0].triangle), index(uses[1].triangle));
    }
  }

  std::vector<Shell> shells;
  std::vector<std::uint32_t> shell_of(count);
  for (std::uint32_t face = 0; face < count; ++face) {
    const std::uint32_t root = groups.root(face);
    if (root == face) {
      shell_of[face] = static_cast<std::uint32_t>(shells.size());
      shells.emplace_back();
    }
    shell_of[face] = shell_of[root];
    shells[shell_of[face]].faces.push_back(TriangleId{face});
  }
  for (std::uint32_t edge = 0; edge < edges; ++edge) {
    const auto uses = uses_of(topology, edge);
    if (uses.size() == 2) {
      Shell& shell = shells[shell_of[index(uses[0].triangle)]];
      const bool clash = uses[0].forward == uses[1].forward;
      const bool one_node = scene.triangles[index(uses[0].triangle)].node ==
                            scene.triangles[index(uses[1].triangle)].node;
      shell.oriented = shell.oriented && !clash;
      shell.clashes += clash && one_node ? 1 : 0;
      continue;
    }
    for (const EdgeUse& use : uses) {
      shells[shell_of[index(use.triangle)]].closed = false;
    }
  }
  for (Shell& shell : shells) {
    measure(scene, shell);
  }
  return shells;
}

double solid_angle(const std::array<Point3, 3>& triangle, const Point3& x) {
  const Vec3 a = triangle[0] - x, b = triangle[1] - x, c = triangle[2] - x;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  // tan(Omega / 2) = a . (b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
  return 2.0 *
         std::atan2(glm::dot(a, glm::cross(b, c)),
                    la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

double winding_number(const Scene& scene, const Shell& shell, const Point3& x) {
  double angle = 0.0;
  for (const TriangleId face : shell.faces)
    angle += solid_angle(corners(scene, face), x);
  return angle / (4.0 * std::numbers::pi);
}

} // namespace meninas
