#include "scenes/rays/ray_contacts.h"

#include <algorithm>

namespace meninas {

namespace {

double edge_parameter(const Point3& from, const Point3& to, const Point3& x) {
  const auto edge = to - from;
  const auto length_squared = glm::dot(edge, edge);
  return length_squared > 0.0 ? std::clamp(glm::dot(x - from, edge) / length_squared, 0.0, 1.0)
                              : 0.0;
}

Point3 point_of(const std::array<Point3, 3>& corners, Vec2 weights) {
  return corners[0] + weights.x * (corners[1] - corners[0]) + weights.y * (corners[2] - corners[0]);
}

Direction normal_of(const ContactTriangle& contact) {
  return glm::normalize(area_vector(contact.corners));
}

/// Whether what a departing ray leaves and the wall are the same to rounding at its origin.
bool are_one(const ContactTriangle& wall, const Direction& wall_normal, const Departure& departure,
             double noise) {
  constexpr double along = 0.05; // sine
  return wall.sidedness == Sidedness::both &&
         std::abs(glm::dot(wall_normal, departure.origin - wall.corners[0])) <= noise &&
         glm::length(glm::cross(wall_normal, departure.plane_normal)) <= along;
}

// The side of the wall on which the point's own surface lies: +1 in front, -1 behind.
double own_side(const Contacts& contacts, const ContactTriangle& wall, const Direction& wall_normal,
                const Departure& departure, double noise) {
  double low = 0.0;
  double high = 0.0;
  for (const auto& own : contacts.own)
    for (const auto& corner : own.corners) {
      const auto height = glm::dot(wall_normal, corner - wall.corners[0]);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  if (low >= -noise && high > noise)
    return 1.0;
  if (high <= noise && low < -noise)
    return -1.0;

  // A surface that passes through below the wall does not tell.
  if (!departure.is_leg && are_one(wall, wall_normal, departure, noise)) {
    const bool passes = std::ranges::any_of(contacts.own, &ContactTriangle::glass);
    const bool rises = glm::dot(departure.direction, wall_normal) > 0.0;
    return rises == passes ? -1.0 : 1.0;
  }
  // The point does, as far as it can be known.
  const auto height = glm::dot(wall_normal, departure.origin - wall.corners[0]);
  if (std::abs(height) <= noise && wall.sidedness == Sidedness::single)
    return 1.0;
  return height < 0.0 ? -1.0 : 1.0;
}

bool rises_above(const ContactTriangle& wall, const Departure& departure, double noise) {
  const auto side = glm::dot(departure.direction, departure.plane_normal) < 0.0 ? -1.0 : 1.0;
  return std::ranges::any_of(wall.corners, [&](const Point3& corner) {
    return side * glm::dot(departure.plane_normal, corner - departure.origin) > noise;
  });
}

} // namespace

Vec2 nearest_barycentric(const std::array<Point3, 3>& corners, const Point3& x) {
  // The foot of the perpendicular, when it falls into the triangle
  const auto e1 = corners[1] - corners[0];
  const auto e2 = corners[2] - corners[0];
  const auto n = glm::cross(e1, e2);
  const auto n_squared = glm::dot(n, n);
  if (n_squared > 0.0) {
    const auto w = x - corners[0];
    const Vec2 foot{glm::dot(glm::cross(w, e2), n) / n_squared,
                    glm::dot(glm::cross(e1, w), n) / n_squared};
    if (foot.x >= 0.0 && foot.y >= 0.0 && foot.x + foot.y <= 1.0)
      return foot;
  }

  // Otherwise the nearest point of an edge
  const auto a = edge_parameter(corners[0], corners[1], x);
  const auto b = edge_parameter(corners[0], corners[2], x);
  const auto c = edge_parameter(corners[1], corners[2], x);
  return std::min({Vec2(a, 0.0), Vec2(0.0, b), Vec2(1.0 - c, c)}, [&](Vec2 p, Vec2 q) {
    return glm::distance(point_of(corners, p), x) < glm::distance(point_of(corners, q), x);
  });
}

double distance_to(const std::array<Point3, 3>& corners, const Point3& x) {
  return glm::distance(point_of(corners, nearest_barycentric(corners, x)), x);
}

bool is_within(const std::array<Point3, 3>& corners, const Point3& x, double reach) {
  // The distance to the box is no greater than that to the triangle, nor is that to the plane,
  // |n . (x - a)| / |n|;
  // what rounding may decide is left to the latter.
  constexpr double rounding = 1e-14; // of products of lengths up to 2, generously
  const double beside = reach + rounding;
  if (glm::any(glm::lessThan(x + beside, glm::min(corners[0], glm::min(corners[1], corners[2])))) ||
      glm::any(glm::lessThan(glm::max(corners[0], glm::max(corners[1], corners[2])), x - beside)))
    return false;
  const auto n = area_vector(corners);
  if (std::abs(glm::dot(n, x - corners[0])) > 2.0 * reach * glm::length(n) + rounding)
    return false;
  return distance_to(corners, x) <= reach;
}

std::optional<ContactTriangle> blocking_contact(const Contacts& contacts,
                                                const Departure& departure, double noise) {
  std::optional<ContactTriangle> blocker;
  double steepest = 0.0;
  for (const auto& wall : contacts.others) {
    // The side of the wall is a sign, and takes a look at all of the own surface: it is asked for last.
    const auto normal = normal_of(wall);
    const auto along = -glm::dot(departure.direction, normal);
    const auto squareness = std::abs(along);
    const auto further = squareness == steepest && blocker && wall.triangle < blocker->triangle;
    if (squareness <= noise || (squareness <= steepest && !further))
      continue;
    if (!rises_above(wall, departure, noise))
      continue;
    const auto approach = along * own_side(contacts, wall, normal, departure, noise);
    if (approach < 0.0)
      continue;
    blocker = wall;
    steepest = approach;
  }
  return blocker;
}

} // namespace meninas
