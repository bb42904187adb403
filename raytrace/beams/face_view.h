// A face as the rays of a picture see it:
// what a block of pixels asks of it are the signs of affine functions of the place in the picture.
//
// The ray o + t d through the point (u, v), in pixels of the tile, has o and d affine in (u, v),
// one of them constant. It meets the plane n . p = c at t = h / s with the height h = c - n .
// o and the slope s = n . d, and its foot there is over another plane g . p = e by
//
//   (g . o - e) + t g . d = ((g . o - e) s + h g . d) / s.
//
// One factor of each product is constant, so all of these are affine in (x, y): their least and
// largest values over a rectangle are at its corners.
#pragma once

#include "raytrace/beams/frustum.h"

#include <cmath>

namespace meninas {

/// constant + u x + v y.
struct AffineForm {
  double constant = 0.0, x = 0.0, y = 0.0;
};

/// A rectangle of the picture, in the units of the rays.
struct PictureBlock {
  double u, v;           ///< its middle
  double half_u, half_v; ///< of its width and height
};

struct FormRange {
  double low, high;
};

inline double value_at(const AffineForm& form, double u, double v) {
  return form.constant + form.x * u + form.y * v;
}

inline FormRange range_over(const AffineForm& form, const PictureBlock& block) {
  const double middle = value_at(form, block.u, block.v);
  const double reach = std::abs(form.x) * block.half_u + std::abs(form.y) * block.half_v;
  return {middle - reach, middle + reach};
}

struct FaceView {
  AffineForm height, slope;
  std::array<AffineForm, 4>
      edges; ///< the foot's height over the sides of the face, times the slope
  std::size_t edge_count = 0;
  AffineForm near;            ///< and over the plane that the rays come from
  Vec2 least{0.0}, most{0.0}; ///< of the picture, where the face is seen
};

/// The view of the part of a face that the rays can come near to, from (0, 0) on.
FaceView view_of(const PictureRays& rays, const FrustumFace& face, const ConvexPolygon& part);

/// The length of the longest direction between (0, 0) and `to`.
double longest_direction(const PictureRays& rays, Vec2 to);

/// To the plane of the face along the ray in the middle of the block, in lengths of its direction.
inline double distance_in_middle(const FaceView& view, const PictureBlock& block) {
  return value_at(view.height, block.u, block.v) / value_at(view.slope, block.u, block.v);
}

/// Whether no ray of the block comes near the face.
bool is_outside(const FaceView& view, const PictureBlock& block, double longest);

/// Whether all rays of the block meet the face, far from its edges.
bool covers(const FaceView& view, const PictureBlock& block, double longest);

/// Whether all rays of the block go along the normal, to see a back.
inline bool sees_back(const FaceView& view, const PictureBlock& block) {
  return range_over(view.slope, block).low > 0.0;
}

/// Whether all rays of the block come to the plane of the face before that of the other,
/// far from both.
bool is_behind(const FaceView& face, const FaceView& other, const PictureBlock& block);

} // namespace meninas
