#include "raytrace/beams/face_view.h"

#include <algorithm>
#include <limits>

namespace meninas {

namespace {

constexpr double min_slope = 0.02; ///< cosine at which faces are met

AffineForm operator+(const AffineForm& a, const AffineForm& b) {
  return {a.constant + b.constant, a.x + b.x, a.y + b.y};
}
AffineForm operator*(double k, const AffineForm& a) { return {k * a.constant, k * a.x, k * a.y}; }

/// The product of two forms, one of which is constant.
AffineForm operator*(const AffineForm& a, const AffineForm& b) {
  return {a.constant * b.constant, a.constant * b.x + a.x * b.constant,
          a.constant * b.y + a.y * b.constant};
}

/// g . o - e.
AffineForm height_of_origin(const PictureRays& rays, const HalfSpace& half) {
  return {glm::dot(half.normal, rays.origin) - half.offset, glm::dot(half.normal, rays.origin_x),
          glm::dot(half.normal, rays.origin_y)};
}

/// g . d.
AffineForm along(const PictureRays& rays, const Direction& normal) {
  return {glm::dot(normal, rays.direction), glm::dot(normal, rays.direction_x),
          glm::dot(normal, rays.direction_y)};
}

/// 1 or -1 where the form has one sign all over the block, else 0.
double sign_over(const AffineForm& form, const PictureBlock& block) {
  const FormRange range = range_over(form, block);
  return range.low > 0.0 ? 1.0 : range.high < 0.0 ? -1.0 : 0.0;
}

double min_over(double sign, const AffineForm& form, const PictureBlock& block) {
  const FormRange range = range_over(form, block);
  return sign > 0.0 ? range.low : -range.high;
}

/// Points of space by the rays through them:
/// o + t d = p where (t, t u, t v), or (t, u, v) where d is constant, is rows (p - o).
struct ToPicture {
  std::array<Vec3, 3> rows;
  bool perspective;
};

ToPicture to_picture(const PictureRays& rays) {
  const Vec3 x = rays.direction_x + rays.origin_x, y = rays.direction_y + rays.origin_y;
  const double det = glm::dot(rays.direction, glm::cross(x, y));
  return {{glm::cross(x, y) / det, glm::cross(y, rays.direction) / det,
           glm::cross(rays.direction, x) / det},
          rays.direction_x != Vec3(0.0)};
}

/// Grows the rectangle from `least` to `most` by what may show a point that is known by the margin.
void include(const PictureRays& rays, const ToPicture& to, const Point3& p, Vec2& least,
             Vec2& most) {
  const Vec3 from = p - rays.origin;
  const auto& [depth, across, down] = to.rows;
  const double t = to.perspective ? glm::dot(depth, from) : 1.0;
  // Next to the eye a point may be anywhere.
  if (to.perspective && !(t > 1e3 * frustum_margin * glm::length(depth))) {
    least = Vec2(-std::numeric_limits<double>::infinity());
    most = -least;
    return;
  }
  const auto widen = [&](const Vec3& row, double& low, double& high) {
    const double at = glm::dot(row, from) / t;
    const Vec3 gradient = (to.perspective ? row - at * depth : row) / t;
    const double near = 2.0 * frustum_margin * glm::length(gradient);
    low = std::min(low, at - near);
    high = std::max(high, at + near);
  };
  widen(across, least.x, most.x);
  widen(down, least.y, most.y);
}

} // namespace

FaceView view_of(const PictureRays& rays, const FrustumFace& face, const ConvexPolygon& part) {
  FaceView view;
  view.height = -1.0 * height_of_origin(rays, {face.normal, face.offset});
  view.slope = along(rays, face.normal);
  const auto over = [&](const HalfSpace& half) {
    return height_of_origin(rays, half) * view.slope + view.height * along(rays, half.normal);
  };
  view.edge_count = face.corner_count;
  for (std::size_t k = 0; k < face.corner_count; ++k)
    view.edges[k] = over(face.edges[k]);
  view.near = over(rays.near);
  view.least = Vec2(std::numeric_limits<double>::infinity());
  view.most = -view.least;
  const ToPicture to = to_picture(rays);
  for (const Point3& p : part.span())
    include(rays, to, p, view.least, view.most);
  return view;
}

double longest_direction(const PictureRays& rays, Vec2 to) {
  double longest = 0.0;
  for (const double u : {0.0, to.x})
    for (const double v : {0.0, to.y})
      longest = std::max(longest,
                         glm::length(rays.direction + u * rays.direction_x + v * rays.direction_y));
  return longest;
}

bool is_outside(const FaceView& view, const PictureBlock& block, double longest) {
  if (view.most.x < block.u - block.half_u || view.least.x > block.u + block.half_u ||
      view.most.y < block.v - block.half_v || view.least.y > block.v + block.half_v)
    return true;
  const double sign = sign_over(view.slope, block);
  return sign != 0.0 &&
         std::ranges::any_of(std::span(view.edges).first(view.edge_count),
                             [&](const AffineForm& edge) {
                               return min_over(-sign, edge, block) > frustum_margin * longest;
                             });
}

bool covers(const FaceView& view, const PictureBlock& block, double longest) {
  const double sign = sign_over(view.slope, block);
  // The foot's height over an edge is its distance by the cosine at which rays of that length come.
  return sign != 0.0 && min_over(sign, view.slope, block) > min_slope * longest &&
         min_over(sign, view.near + (-frustum_margin) * view.slope, block) > 0.0 &&
         std::ranges::all_of(std::span(view.edges).first(view.edge_count),
                             [&](const AffineForm& edge) {
                               return min_over(sign, edge, block) > frustum_margin * longest;
                             });
}

bool is_behind(const FaceView& face, const FaceView& other, const PictureBlock& block) {
  const double sign = sign_over(face.slope, block), theirs = sign_over(other.slope, block);
  // h' / s' - h / s, times the lengths of both slopes:
  // by more than a margin under the face, and over the other.
  const AffineForm farther = other.height * face.slope + (-1.0) * (face.height * other.slope);
  const AffineForm apart = sign * theirs * farther;
  return sign * theirs != 0.0 &&
         min_over(1.0, apart + (-frustum_margin * theirs) * other.slope, block) > 0.0 &&
         min_over(1.0, apart + (-frustum_margin * sign) * face.slope, block) > 0.0;
}

} // namespace meninas
