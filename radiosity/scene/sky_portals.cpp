#include "radiosity/scene/sky_portals.h"

#include "scenes/materials/lobes.h"
#include "scenes/sampling.h"
#include "radiosity/scene/open_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meninas {

namespace {

constexpr std::size_t max_portals = 64, max_candidates = 1024;
constexpr int points = 16;          ///< of an opening that are asked
constexpr double open_enough = 0.25; ///< share of rays outwards that escape
constexpr double shut_enough = 0.25; ///< share of rays inwards that may escape
constexpr double small_enough = 0.5; ///< share of the area that it lights

/// The free path of a ray past panes, metres: infinite where it meets nothing else.
double free_path(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays, Ray ray) {
  constexpr int max_panes = 16;
  double path = 0.0;
  for (int pane = 0; pane < max_panes; ++pane) {
    const auto hit = closest_hit(rays, ray);
    if (!hit)
      return std::numeric_limits<double>::infinity();
    path += hit->distance;
    const Material& material = material_of(scene, hit->triangle);
    if (!is_glass(material) || is_solid_glass(material))
      break;
    ray.origin += hit->distance * ray.direction;
    ray.leaving = surfaces.plane_of_triangle[index(hit->triangle)];
  }
  return path;
}

/// A ray from a point of the opening, number k of `points`, to its front or back, cosine-distributed.
class Outlooks {
public:
  Outlooks(const SkyPortal& opening, double off) : opening_(opening), off_(off) {
    const Vec3 n = opening.plane.normal;
    tangent_ = glm::normalize(
        glm::cross(n, std::abs(n.x) < 0.7 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0)));
    for (const Point3& corner : opening.polygon.span())
      middle_ += corner / double(opening.polygon.size);
  }

  Point3 point(std::uint32_t k) const {
    const auto u = sobol4(k, seed);
    const std::span<const Point3> corners = opening_.polygon.span();
    const double edge = double{u[0]} * double(corners.size());
    const auto c = std::min(static_cast<std::size_t>(edge), corners.size() - 1);
    const Point3 rim =
        glm::mix(corners[c], corners[(c + 1) % corners.size()], std::min(edge - double(c), 1.0));
    return middle_ + std::sqrt(double{u[1]}) * (rim - middle_);
  }

  Ray ray(std::uint32_t k, double side) const {
    const auto u = sobol4(k, seed);
    const Vec3 n = opening_.plane.normal;
    const double r = std::sqrt(double{u[2]}), phi = 2.0 * std::numbers::pi * double{u[3]};
    const Vec3 along = r * (std::cos(phi) * tangent_ + std::sin(phi) * glm::cross(n, tangent_));
    return {.origin = point(k) + side * off_ * n,
            .direction = glm::normalize(along + side * std::sqrt(std::max(0.0, 1.0 - r * r)) * n),
            .leaving = opening_.plane_class};
  }

private:
  static constexpr std::uint32_t seed = 0x0b5e55;
  const SkyPortal& opening_;
  double off_;
  Vec3 tangent_{0.0};
  Point3 middle_{0.0};
};

double hair_of(const SurfaceModel& surfaces, const SkyPortal& opening) {
  return std::max(4.0 * surfaces.tolerance, 1e-5 * std::sqrt(opening.area));
}

/// The view of rays from points of a polygon on one side of it.
struct Outlook {
  double escaping = 0.0; ///< share of them
  double lit = 0.0;      ///< mean of pi d^2 of the others: about the area of what it lights, m^2
};

Outlook outlook_of(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                   const SkyPortal& opening, double side) {
  const Outlooks from(opening, hair_of(surfaces, opening));
  Outlook outlook;
  int ended = 0;
  for (std::uint32_t k = 0; k < points; ++k) {
    const double path = free_path(scene, surfaces, rays, from.ray(k, side));
    if (std::isinf(path)) {
      outlook.escaping += 1.0 / points;
      continue;
    }
    outlook.lit += std::numbers::pi * path * path;
    ++ended;
  }
  outlook.lit /= std::max(1, ended);
  return outlook;
}

/// Whether it is a pane, or no point of it is on a surface: the outline of a pane is no hole.
bool is_open(const SurfaceModel& surfaces, const RayScene& rays, const SkyPortal& opening) {
  if (opening.plane_class != none<PlaneId>)
    return true;
  const double off = hair_of(surfaces, opening);
  const Outlooks from(opening, off);
  const Vec3 hair = off * opening.plane.normal;
  for (std::uint32_t k = 0; k < points; ++k) {
    const Ray through{.origin = from.point(k) + hair,
                      .direction = -opening.plane.normal,
                      .max_distance = 2.0 * off};
    if (closest_hit(rays, through))
      return false;
  }
  return true;
}

/// Whether rays from what it lights would seldom find the sky through it: a window, not the mouth of a pot.
bool is_window(const SkyPortal& opening, const Outlook& inside, const Outlook& outside) {
  return inside.escaping <= shut_enough && outside.escaping >= open_enough &&
         opening.area <= small_enough * inside.lit;
}

/// Leaves out portals behind which all rays leave by another, as a hole in whose frame there is a pane.
void keep_last(const SurfaceModel& surfaces, std::vector<SkyPortal>& portals) {
  for (std::uint32_t p = 0; p < portals.size();) {
    const Outlooks from(portals[p], hair_of(surfaces, portals[p]));
    bool is_last = false;
    for (std::uint32_t k = 0; k < points && !is_last; ++k) {
      const Ray out = from.ray(k, -1.0);
      is_last = last_portal(portals, out.origin, out.direction, 0.0) == no_portal;
    }
    if (is_last)
      ++p;
    else
      portals.erase(portals.begin() + p);
  }
}

/// The other side of it.
SkyPortal turned_round(SkyPortal opening) {
  std::reverse(opening.polygon.vertices.begin(),
               opening.polygon.vertices.begin() + static_cast<std::ptrdiff_t>(opening.polygon.size));
  opening.plane = {-opening.plane.normal, -opening.plane.offset};
  return opening;
}

SkyPortal opening_of(std::span<const Point3> corners, PlaneId plane_class) {
  SkyPortal opening;
  opening.polygon = ConvexPolygon(corners);
  const Vec3 area = area_vector(corners);
  opening.area = glm::length(area);
  if (opening.area > 0.0) {
    opening.plane.normal = area / opening.area;
    for (const Point3& corner : corners)
      opening.plane.offset += glm::dot(opening.plane.normal, corner) / double(corners.size());
  }
  opening.plane_class = plane_class;
  return opening;
}

std::vector<SkyPortal> candidates_of(const Scene& scene, const SurfaceModel& surfaces) {
  std::vector<SkyPortal> candidates;
  for (const Patch& patch : surfaces.patches) {
    const Material& material = scene.materials[index(patch.material)];
    if (is_glass(material) && !is_solid_glass(material) && !is_blended(material))
      candidates.push_back(opening_of(polygon_of(patch),
                                      surfaces.surfaces[index(patch.surface)].plane_class));
  }
  for (const std::vector<Point3>& hole : open_polygons(scene, surfaces))
    candidates.push_back(opening_of(hole, none<PlaneId>));
  std::erase_if(candidates, [&](const SkyPortal& c) {
    return !(std::sqrt(c.area) > 100.0 * surfaces.tolerance);
  });
  std::ranges::stable_sort(candidates, std::greater{}, &SkyPortal::area);
  return candidates;
}

/// Whether the point of a portal's plane is in the portal.
bool contains(const SkyPortal& portal, const Point3& point) {
  const auto corners = portal.polygon.span();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 edge = corners[(k + 1) % corners.size()] - corners[k];
    if (glm::dot(glm::cross(edge, point - corners[k]), portal.plane.normal) < 0.0)
      return false;
  }
  return true;
}

} // namespace

std::vector<SkyPortal> find_sky_portals(const Scene& scene, const SurfaceModel& surfaces,
                                        const RayScene& rays) {
  std::vector<SkyPortal> portals;
  if (is_dark(scene.background))
    return portals;
  std::vector<SkyPortal> candidates = candidates_of(scene, surfaces);
  // Boards and leaves have outlines as well: what is open is told by a few rays each.
  std::erase_if(candidates, [&](const SkyPortal& c) { return !is_open(surfaces, rays, c); });
  if (candidates.size() > max_candidates)
    candidates.resize(max_candidates);
  for (SkyPortal& opening : candidates) {
    if (portals.size() == max_portals)
      break;
    const Outlook front = outlook_of(scene, surfaces, rays, opening, 1.0),
                  back = outlook_of(scene, surfaces, rays, opening, -1.0);
    if (is_window(opening, front, back))
      portals.push_back(std::move(opening));
    else if (is_window(opening, back, front))
      portals.push_back(turned_round(std::move(opening)));
  }
  keep_last(surfaces, portals);
  return portals;
}

std::uint32_t last_portal(std::span<const SkyPortal> portals, const Point3& origin,
                          const Vec3& direction, double min_height) {
  std::uint32_t last = no_portal;
  double farthest = -std::numeric_limits<double>::infinity();
  const double length = glm::length(direction);
  for (std::uint32_t p = 0; p < portals.size(); ++p) {
    const Plane& plane = portals[p].plane;
    const double approach = glm::dot(plane.normal, direction);
    if (!(approach < 0.0))
      continue;
    const double height = glm::dot(plane.normal, origin) - plane.offset;
    const double t = height / -approach;
    if (height <= min_height || t * length <= farthest)
      continue;
    if (contains(portals[p], origin + t * direction)) {
      last = p;
      farthest = t * length;
    }
  }
  return last;
}

} // namespace meninas
