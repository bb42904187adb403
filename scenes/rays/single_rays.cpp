// Queries of one ray in double metres:
// carried into the frame, asked there, and measured again in double.
#include "scenes/rays/frame_geometry.h"
#include "scenes/rays/ray_scene.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

// The scene lies within sqrt(3) of the frame's origin;
// what is farther out is clipped before it is rounded to floats.
constexpr double far_out = 2.0;

struct Span {
  double begin = 0.0;
  double end = 0.0;
};

bool is_finite(const Vec3& x) {
  return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

/// The part of the line x + t d, 0 <= t <= end, d of unit length, that can meet the scene.
std::optional<Span> clipped_span(const Point3& x, const Direction& d, double end) {
  Span span{0.0, end};
  const auto towards = -glm::dot(x, d);
  const auto nearest = x + towards * d;
  const auto half_squared = far_out * far_out - glm::dot(nearest, nearest);
  if (half_squared < 0.0)
    return std::nullopt;
  const auto half = std::sqrt(half_squared);
  if (glm::length(x) > far_out)
    span.begin = std::max(0.0, towards - half);
  if (glm::length(x + end * d) > far_out || !std::isfinite(end))
    span.end = std::min(end, towards + half);
  if (span.end <= span.begin)
    return std::nullopt;
  return span;
}

RayPacket packet_of(const Point3& origin, const Vec3& direction, double end) {
  RayPacket packet{};
  packet.count = 1;
  set_ray(packet, 0, origin, direction, index(none<PlaneId>), static_cast<float>(end));
  packet.arriving[0] = index(none<PlaneId>);
  return packet;
}

/// Where the ray meets the plane of the triangle, exactly; floats decide only which triangle it is.
void measure_again(const std::array<Point3, 3>& corners, const Point3& origin,
                   const Direction& direction, Hit& hit) {
  // A grazing ray or a sliver would amplify rounding: it keeps what the query found.
  const auto normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const auto slope = glm::dot(normal, direction);
  if (std::abs(slope) <= 1e-6 * glm::length(normal))
    return;
  const auto distance = std::max(0.0, glm::dot(normal, corners[0] - origin) / slope);
  const auto reachable = 1e-5 * glm::length(normal) / std::abs(slope);
  if (!(std::abs(distance - hit.distance) <= reachable))
    return;

  hit.distance = distance;
  const auto x = origin + distance * direction - corners[0];
  const auto squared = glm::dot(normal, normal);
  const auto b1 = glm::dot(glm::cross(x, corners[2] - corners[0]), normal) / squared;
  const auto b2 = glm::dot(glm::cross(corners[1] - corners[0], x), normal) / squared;
  const Vec2 inside = glm::max(Vec2(b1, b2), Vec2(0.0));
  hit.barycentric = inside / std::max(1.0, inside.x + inside.y);
}

} // namespace

std::optional<Hit> closest_hit(const RayScene& rays, const Ray& ray, Backs backs) {
  const auto& geometry = rays.geometry();
  const auto& frame = geometry.frame;
  const auto length = glm::length(ray.direction);
  const auto origin = to_frame(frame, ray.origin);
  if (!(length > 0.0) || !std::isfinite(length) || !is_finite(origin))
    return std::nullopt;
  const auto direction = ray.direction / length;
  const auto span = clipped_span(origin, direction, ray.max_distance * frame.scale);
  if (!span)
    return std::nullopt;

  auto packet = packet_of(origin + span->begin * direction, direction, span->end - span->begin);
  packet.leaving[0] = index(ray.leaving);
  HitPacket found;
  closest_hits(rays, packet, found, backs, Coherence::incoherent);
  if (found.triangle[0] == index(none<TriangleId>))
    return std::nullopt;

  Hit hit{TriangleId{found.triangle[0]}, static_cast<double>(found.distance[0]) + span->begin,
          Vec2(found.b1[0], found.b2[0]), found.front[0] != 0};
  measure_again(corners_of(geometry, found.triangle[0]), origin, direction, hit);
  hit.distance /= frame.scale;
  return hit;
}

bool occluded(const RayScene& rays, const Leg& leg) {
  const auto& frame = rays.geometry().frame;
  const auto from = to_frame(frame, leg.from);
  const auto to = to_frame(frame, leg.to);
  const auto length = glm::length(to - from);
  if (!(length > 0.0) || !is_finite(from) || !is_finite(to))
    return false;
  const auto direction = (to - from) / length;
  const auto span = clipped_span(from, direction, length);
  if (!span)
    return false;

  const auto begin = from + span->begin * direction;
  const auto end = span->end < length ? from + span->end * direction : to;
  auto packet = packet_of(begin, end - begin, 1.0);
  packet.leaving[0] = index(leg.leaving);
  packet.arriving[0] = index(leg.arriving);
  return occluded(rays, packet, Coherence::incoherent) != 0;
}

} // namespace meninas
