#include "raytrace/beams/frustum.h"

#include "radiosity/scene/light_scene.h"
#include "scenes/rays/frame_geometry.h"

#include <algorithm>

namespace meninas {

namespace {


double height_over(const HalfSpace& half, const Point3& p) {
  return glm::dot(half.normal, p) - half.offset;
}

/// The plane of the picture's corner rays i and i + 1, with the others inside.
HalfSpace side_plane(const Frustum& f, std::size_t i) {
  const std::size_t j = (i + 1) % 4, across = (i + 2) % 4;
  const Point3 on = f.origin[i] + f.direction[i];
  Vec3 n = glm::cross(f.direction[i], f.origin[j] + f.direction[j] - on);
  n /= glm::length(n);
  if (glm::dot(n, f.origin[across] + f.direction[across] - on) < 0.0)
    n = -n;
  return {n, glm::dot(n, on)};
}

/// The affine weights of the second and third corner, w(p) = gradient . p + constant.
struct Weight {
  Vec3 gradient;
  double constant;
  double at(const Point3& p) const { return glm::dot(gradient, p) + constant; }
};
std::array<Weight, 2> weights_of(const std::array<Point3, 3>& corners) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec3 n = glm::cross(e1, e2);
  const double nn = glm::dot(n, n);
  const Vec3 g1 = glm::cross(e2, n) / nn, g2 = glm::cross(n, e1) / nn;
  return {Weight{g1, -glm::dot(g1, corners[0])}, Weight{g2, -glm::dot(g2, corners[0])}};
}

bool reaches_out(const HalfSpace& half, std::span<const Point3> polygon) {
  return std::ranges::any_of(polygon,
                             [&](const Point3& p) { return height_over(half, p) < -frustum_margin; });
}

Ball ball_around(std::span<const Point3> polygon) {
  Ball ball;
  for (const Point3& p : polygon)
    ball.centre += p / static_cast<double>(polygon.size());
  for (const Point3& p : polygon)
    ball.radius = std::max(ball.radius, glm::distance(p, ball.centre));
  return ball;
}

FrustumFace face_of(const FrameGeometry& geometry, std::uint32_t triangle,
                    std::span<const Point3> corners) {
  constexpr double steepest = 1e3; // change of a weight over half of the scene
  const TriangleFacts& facts = geometry.facts[triangle];
  const auto own = corners_of(geometry, triangle);
  const auto [w1, w2] = weights_of(own);
  FrustumFace face{.corner_count = corners.size(),
                   .normal = glm::normalize(glm::cross(own[1] - own[0], own[2] - own[0])),
                   .triangle = triangle,
                   .plane = facts.plane,
                   .single_sided = facts.single_sided};
  face.can_be_sure =
      !facts.cut_out && glm::length(w1.gradient) < steepest && glm::length(w2.gradient) < steepest;
  face.offset = glm::dot(face.normal, own[0]);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point3& from = corners[k];
    face.corners[k] = from;
    const Direction inward =
        glm::normalize(glm::cross(face.normal, corners[(k + 1) % corners.size()] - from));
    face.edges[k] = {inward, glm::dot(inward, from)};
  }
  face.around = ball_around(corners);
  return face;
}

/// The parallelogram that a triangle is half of, if rays meet both halves.
const Patch* whole_patch_of(const LightScene& light, std::uint32_t triangle) {
  const PatchId id = light.surfaces.patch_of_triangle[triangle];
  if (id == none<PatchId>)
    return nullptr;
  const Patch& patch = light.surfaces.patches[index(id)];
  const auto shows = [&](TriangleId half) {
    return half != none<TriangleId> && !light.rays.geometry().facts[index(half)].hidden;
  };
  return patch.corner_count == 4 && patch.affine && std::ranges::all_of(patch.triangles, shows)
             ? &patch
             : nullptr;
}

} // namespace

std::vector<FrustumFace> frustum_faces(const LightScene& light, std::size_t most) {
  std::vector<FrustumFace> faces;
  const FrameGeometry& geometry = light.rays.geometry();
  if (light.has_glass || geometry.noise > 0.25 * frustum_margin || geometry.detail < 1.0F ||
      geometry.triangles.size() > most)
    return faces;
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const auto own = corners_of(geometry, t);
    if (geometry.facts[t].hidden || area_vector(own) == Vec3(0.0))
      continue;
    const Patch* patch = whole_patch_of(light, t);
    if (!patch)
      faces.push_back(face_of(geometry, t, own));
    else if (index(patch->triangles[0]) == t) {
      std::array<Point3, 4> corners;
      std::ranges::transform(patch->corners, corners.begin(),
                             [&](const Point3& p) { return to_frame(geometry.frame, p); });
      faces.push_back(face_of(geometry, t, corners));
    }
  }
  return faces;
}

PictureRays reflected(const PictureRays& rays, const HalfSpace& mirror) {
  const Direction& n = mirror.normal;
  PictureRays behind = rays;
  behind.origin -= 2.0 * height_over(mirror, rays.origin) * n;
  for (Vec3* v : {&behind.origin_x, &behind.origin_y, &behind.direction, &behind.direction_x,
                  &behind.direction_y})
    *v -= 2.0 * glm::dot(n, *v) * n;
  behind.near = mirror;
  return behind;
}

Frustum frustum_of(const PictureRays& rays, Vec2 to) {
  const std::array corners{Vec2(0.0), Vec2(to.x, 0.0), to, Vec2(0.0, to.y)};
  Frustum f;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [x, y] = std::pair(corners[i].x, corners[i].y);
    f.origin[i] = rays.origin + x * rays.origin_x + y * rays.origin_y;
    f.direction[i] = rays.direction + x * rays.direction_x + y * rays.direction_y;
  }
  for (std::size_t i = 0; i < 4; ++i)
    f.bounds[i] = side_plane(f, i);
  f.bounds[4] = rays.near;
  return f;
}

bool is_outside(const Frustum& f, const Ball& ball) {
  return std::ranges::any_of(f.bounds, [&](const HalfSpace& half) {
    return height_over(half, ball.centre) < -frustum_margin - ball.radius;
  });
}

ConvexPolygon clip_to(const Frustum& f, ConvexPolygon part) {
  for (const HalfSpace& half : f.bounds)
    if (reaches_out(half, part.span()))
      clip_in_place(part, (half.offset - frustum_margin) * half.normal, half.normal);
  return part;
}

LandingForms landing_forms(const std::array<Point3, 3>& corners, const PictureRays& rays) {
  const auto [w1, w2] = weights_of(corners);
  const Direction n = area_vector(corners);
  const double slope = glm::dot(n, rays.direction);
  const double height = glm::dot(n, corners[0] - rays.origin);
  // b = w(o + t d) with t = height / slope, times slope:
  // of its changes with x and y those of o or those of d are zero.
  const auto numerator = [&](const Weight& w) {
    const double here = w.at(rays.origin), along = glm::dot(w.gradient, rays.direction);
    const auto change = [&](const Vec3& o, const Vec3& d) {
      return here * glm::dot(n, d) + glm::dot(w.gradient, o) * slope +
             height * glm::dot(w.gradient, d) - glm::dot(n, o) * along;
    };
    return Vec3(here * slope + height * along, change(rays.origin_x, rays.direction_x),
                change(rays.origin_y, rays.direction_y));
  };
  // The plane may be seen edge on from (0, 0), but not from everywhere.
  const Vec3 over(slope, glm::dot(n, rays.direction_x), glm::dot(n, rays.direction_y));
  const double scale = 1.0 / glm::length(over);
  return {scale * numerator(w1), scale * numerator(w2), scale * over};
}

} // namespace meninas
