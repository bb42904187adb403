#include "reference/light_images.h"

#include "reference/mirror_planes.h"
#include "scenes/materials/bsdf.h"
#include "scenes/materials/lobes.h"
#include "scenes/punctual_light.h"

#include <algorithm>
#include <cmath>

namespace meninas::reference {

namespace {

/// Around all of a plane that may mirror ideally, and a little more than that.
Bounds mirror_extent(const Scene& scene, const SurfaceModel& surfaces,
                     const std::vector<Bsdf>& bsdfs, PlaneId plane, double margin) {
  Bounds extent;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const MaterialId material = scene.triangles[t].material;
    if (surfaces.plane_of_triangle[t] != plane ||
        (bsdfs[index(material)].alpha > 0.0 && !is_textured(scene.materials[index(material)])))
      continue;
    for (const Point3& corner : corners(scene, TriangleId{t})) {
      extent.low = glm::min(extent.low, corner - margin);
      extent.high = glm::max(extent.high, corner + margin);
    }
  }
  return extent;
}

bool is_within(const Bounds& bounds, const Point3& x) {
  return glm::all(glm::greaterThanEqual(x, bounds.low)) &&
         glm::all(glm::lessThanEqual(x, bounds.high));
}

PunctualLight mirrored(const Plane& plane, PunctualLight light) {
  light.position = reflected_in(plane, light.position);
  light.direction -= 2.0 * glm::dot(light.direction, plane.normal) * plane.normal;
  for (int axis = 0; axis < 3; ++axis)
    light.frame[axis] -= 2.0 * glm::dot(light.frame[axis], plane.normal) * plane.normal;
  return light;
}

/// Whether the straight line from x to the image passes the extents of all mirrors.
bool passes_mirrors(const TracedScene& traced, const LightImage& image, Point3 x, Point3 target) {
  for (std::size_t k = 0; k < image.planes.size(); ++k) {
    const Plane& plane = traced.surfaces.planes[index(image.planes[k])];
    const double before = signed_distance(plane, x), behind = signed_distance(plane, target);
    if (before * behind >= 0.0)
      return false;
    x += before / (before - behind) * (target - x);
    if (!is_within(image.extents[k], x))
      return false;
    target = reflected_in(plane, target);
  }
  return true;
}

/// Keeps `max_connections` or fewer:
/// those on which equal steps through the sum of what all would bring end.
void thin_out(std::vector<ImageConnection>& chosen, double u) {
  double sum = 0.0;
  for (const ImageConnection& connection : chosen)
    sum += largest(connection.radiance);
  const double step = sum / double(max_connections);
  double next = u * step, below = 0.0;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const double share = largest(chosen[k].radiance);
    below += share;
    double steps = 0.0;
    for (; next < below; next += step)
      ++steps;
    if (steps == 0.0)
      continue;
    chosen[kept] = chosen[k];
    chosen[kept++].radiance *= steps * step / share;
  }
  chosen.resize(kept);
}

} // namespace

std::vector<LightImage> make_light_images(const Scene& scene, const SurfaceModel& surfaces,
                                          const std::vector<Bsdf>& bsdfs,
                                          const std::vector<PlaneId>& mirror_planes) {
  std::vector<LightImage> images;
  for (const PunctualLight& light : scene.lights)
    if (largest(light.intensity) > 0.0)
      images.push_back({light, {}, {}});
  const Bounds bounds = bounds_of(scene);
  const double margin = 1e-6 * glm::length(bounds.high - bounds.low);
  std::vector<Bounds> extents;
  for (const PlaneId plane : mirror_planes)
    extents.push_back(mirror_extent(scene, surfaces, bsdfs, plane, margin));
  // The path meets the newest mirror first.
  std::size_t first = 0;
  for (std::size_t length = 1; length <= longest_chain; ++length) {
    const std::size_t end = images.size();
    for (; first < end; ++first)
      for (std::size_t m = 0; m < mirror_planes.size(); ++m) {
        LightImage image = images[first];
        // No ray meets the plane it leaves.
        if (!image.planes.empty() && image.planes.front() == mirror_planes[m])
          continue;
        image.light =
            mirrored(surfaces.planes[index(mirror_planes[m])], std::move(image.light));
        image.planes.insert(image.planes.begin(), mirror_planes[m]);
        image.extents.insert(image.extents.begin(), extents[m]);
        images.push_back(std::move(image));
      }
  }
  return images;
}

void choose_images(const TracedScene& traced, const SurfacePoint& x, const Direction& out, Vec2 u,
                   std::vector<ImageConnection>& chosen) {
  chosen.clear();
  const std::size_t all = traced.light_images.size(), asked = std::min(all, max_images);
  const double reach = 8.0 / traced.rays.frame().scale;
  const double stride = asked > 0 ? double(all) / double(asked) : 1.0;
  for (std::size_t k = 0; k < asked; ++k) {
    // Evenly: one of each stride, and all where that is 1.
    const auto place = asked < all ? static_cast<std::size_t>((double(k) + u.x) * stride) : k;
    const LightImage& image = traced.light_images[std::min(place, all - 1)];
    const auto [target, irradiance] = punctual_sample(image.light, x.origin, reach);
    const Vec3 leg = target - x.origin;
    if (irradiance == Rgb(0.0) || leg == Vec3(0.0) ||
        !passes_mirrors(traced, image, x.origin, target))
      continue;
    const Direction in = to_local(x.normal, glm::normalize(leg));
    const Rgb radiance = stride * std::abs(in.z) * irradiance * evaluate(x.bsdf, out, in);
    if (radiance != Rgb(0.0))
      chosen.push_back({&image, target, radiance});
  }
  if (chosen.size() > max_connections)
    thin_out(chosen, u.y);
}

} // namespace meninas::reference
