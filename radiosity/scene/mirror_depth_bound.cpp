#include "radiosity/scene/mirror_depth_bound.h"

#include "form_factors/area_form_factor.h"

#include <algorithm>

namespace meninas {

namespace {

/// The polygon counter-clockwise seen from where `front` points.
ConvexPolygon facing(const ConvexPolygon& polygon, const Direction& front) {
  ConvexPolygon turned = polygon;
  if (glm::dot(area_vector(polygon.span()), front) < 0.0)
    std::reverse(turned.vertices.begin(),
                 turned.vertices.begin() + static_cast<std::ptrdiff_t>(turned.size));
  return turned;
}

/// A(window_1) F(window_1, window_k):
/// how much of the light that enters the first window can reach the last.
double passage(const MirrorWorld& first, std::span<const ConvexPolygon> last,
               const Plane& last_plane) {
  double sum = 0.0;
  for (const auto& from : first.window) {
    const double area = glm::length(area_vector(from.span()));
    for (const auto& to : last) {
      const Estimate factor =
          area_form_factor(facing(from, -first.plane.normal), facing(to, last_plane.normal));
      sum += area * std::min(1.0, factor.value + factor.error);
    }
  }
  return sum;
}

} // namespace

double mirror_depth_bound(const WorldTree& tree, const MirrorSet& mirrors, double area) {
  double sum = 0.0;
  for (const auto& cut : tree.cut) {
    const double throughput = std::max({cut.throughput.r, cut.throughput.g, cut.throughput.b});
    const Mirror& mirror = mirrors.mirrors[index(cut.mirror)];
    if (cut.parent == real_world) {
      sum += throughput * mirror.area;
      continue;
    }
    const MirrorWorld& parent = tree.worlds[index(cut.parent)];
    const MirrorWorld* first = &parent;
    while (first->parent != real_world)
      first = &tree.worlds[index(first->parent)];
    sum += throughput *
           passage(*first, window_in_world(parent, mirror), apply(parent.image, mirror.plane));
  }
  return area > 0.0 ? std::min(1.0, sum / area) : 0.0;
}

double receiving_area(const Scene& scene, const SurfaceModel& surfaces) {
  double area = 0.0;
  for (const auto& surface : surfaces.surfaces) {
    const Material& material = scene.materials[index(surface.material)];
    if (!is_mirror(material) && !is_glass(material))
      area += (material.double_sided ? 2.0 : 1.0) * surface.area;
  }
  return area;
}

} // namespace meninas
