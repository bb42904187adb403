// What blocks of pixels are told of a face holds for every ray of theirs.
#include "raytrace/beams/face_view.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

namespace meninas::test {
namespace {

constexpr double size = 16.0; // pixels of the picture, square

FrustumFace parallelogram(const Point3& from, const Vec3& a, const Vec3& b) {
  FrustumFace face{.corner_count = 4};
  face.corners = {from, from + a, from + a + b, from + b};
  face.normal = glm::normalize(glm::cross(a, b));
  face.offset = glm::dot(face.normal, from);
  for (std::size_t k = 0; k < 4; ++k) {
    const Point3& corner = face.corners[k];
    const Direction inward =
        glm::normalize(glm::cross(face.normal, face.corners[(k + 1) % 4] - corner));
    face.edges[k] = {inward, glm::dot(inward, corner)};
  }
  return face;
}

FrustumFace any_face(Random& random) {
  return parallelogram(random.in_box(Vec3(-1.0), Vec3(1.0)), random.in_box(Vec3(-1.0), Vec3(1.0)),
                       random.in_box(Vec3(-1.0), Vec3(1.0)));
}

PictureRays any_rays(Random& random, bool perspective) {
  const Direction ahead = random.direction();
  const Vec3 right = glm::normalize(glm::cross(ahead, random.direction()));
  const Vec3 down = glm::cross(ahead, right);
  const double pixel = random.between(0.001, 0.1);
  PictureRays rays{};
  rays.origin = random.in_box(Vec3(-1.5), Vec3(1.5));
  rays.direction = ahead;
  (perspective ? rays.direction_x : rays.origin_x) = pixel * right;
  (perspective ? rays.direction_y : rays.origin_y) = pixel * down;
  (perspective ? rays.direction : rays.origin) -= 0.5 * size * pixel * (right + down);
  rays.near = {ahead, glm::dot(ahead, rays.origin)};
  return rays;
}

struct Meeting {
  double distance; // to the plane
  bool on_face;
};

Meeting meet(const PictureRays& rays, double u, double v, const FrustumFace& face) {
  const Point3 o = rays.origin + u * rays.origin_x + v * rays.origin_y;
  const Vec3 d = rays.direction + u * rays.direction_x + v * rays.direction_y;
  const double t = (face.offset - glm::dot(face.normal, o)) / glm::dot(face.normal, d);
  const Point3 foot = o + t * d;
  bool inside = t > 0.0;
  for (const HalfSpace& edge : face.edges)
    inside = inside && glm::dot(edge.normal, foot) >= edge.offset;
  return {t, inside};
}

/// Whether it holds for rays all over the block, its corners among them.
bool holds_all_over(const PictureBlock& block, const std::function<bool(double, double)>& holds) {
  constexpr int steps = 8;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      if (!holds(block.u + (2.0 * i / steps - 1.0) * block.half_u,
                 block.v + (2.0 * j / steps - 1.0) * block.half_v))
        return false;
  return true;
}

PictureBlock any_block(Random& random) {
  const double half = random.between(0.1, 4.0);
  return {random.between(half, size - half), random.between(half, size - half), half, half};
}

FaceView view_in(const PictureRays& rays, const FrustumFace& face) {
  const Frustum picture = frustum_of(rays, Vec2(size));
  return view_of(rays, face, clip_to(picture, ConvexPolygon(face.corners)));
}

class ViewOfAFace : public testing::TestWithParam<bool> {};

TEST_P(ViewOfAFace, HoldsForAllRaysOfTheBlock) {
  Random random(7);
  int outside = 0, covered = 0, behind = 0, partly = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const PictureRays rays = any_rays(random, GetParam());
    const FrustumFace face = any_face(random), other = any_face(random);
    const PictureBlock block = any_block(random);
    const double longest = longest_direction(rays, Vec2(size));
    const FaceView view = view_in(rays, face), others = view_in(rays, other);
    const auto on_face = [&](double u, double v) { return meet(rays, u, v, face).on_face; };
    const auto off_face = [&](double u, double v) { return !on_face(u, v); };
    if (is_outside(view, block, longest)) {
      ++outside;
      ASSERT_TRUE(holds_all_over(block, off_face)) << trial;
    } else if (covers(view, block, longest)) {
      ++covered;
      ASSERT_TRUE(holds_all_over(block, on_face)) << trial;
      if (is_behind(view, others, block)) {
        ++behind;
        ASSERT_TRUE(holds_all_over(block, [&](double u, double v) {
          const Meeting beyond = meet(rays, u, v, other);
          return !beyond.on_face || beyond.distance > meet(rays, u, v, face).distance;
        })) << trial;
      }
    } else {
      partly += !holds_all_over(block, on_face) && !holds_all_over(block, off_face) ? 1 : 0;
    }
  }
  EXPECT_GT(outside, 50000);
  EXPECT_GT(covered, 500);
  EXPECT_GT(behind, 200);
  EXPECT_GT(partly, 500);
}

TEST_P(ViewOfAFace, DecidesAllButWhatIsAtItsEdges) {
  // A block that is well inside of the face, or well beside it, is told so.
  Random random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    const PictureRays rays = any_rays(random, GetParam());
    const PictureBlock block = any_block(random);
    const Vec3 right = glm::normalize(rays.direction_x + rays.origin_x),
               down = glm::normalize(rays.direction_y + rays.origin_y);
    const auto at = [&](double u, double v, double t) {
      return rays.origin + u * rays.origin_x + v * rays.origin_y +
             t * (rays.direction + u * rays.direction_x + v * rays.direction_y);
    };
    const Point3 low = at(block.u - 2.0 * block.half_u, block.v - 2.0 * block.half_v, 1.0),
                 high = at(block.u + 2.0 * block.half_u, block.v + 2.0 * block.half_v, 1.0);
    const double width = glm::dot(high - low, right), height = glm::dot(high - low, down);
    const double longest = longest_direction(rays, Vec2(size));
    const FaceView around = view_in(rays, parallelogram(low, width * right, height * down));
    EXPECT_TRUE(covers(around, block, longest));
    EXPECT_FALSE(is_outside(around, block, longest));
    const FrustumFace beside = parallelogram(low, 0.2 * width * right, height * down);
    EXPECT_TRUE(is_outside(view_in(rays, beside), block, longest));
    const FaceView farther =
        view_in(rays, parallelogram(low + 0.1 * (low - at(block.u - 2.0 * block.half_u,
                                                          block.v - 2.0 * block.half_v, 0.0)),
                                    width * right, height * down));
    EXPECT_TRUE(is_behind(around, farther, block));
    EXPECT_FALSE(is_behind(farther, around, block));
  }
}

INSTANTIATE_TEST_SUITE_P(Rays, ViewOfAFace, testing::Values(true, false),
                         [](const auto& with) { return with.param ? "FromAnEye" : "Parallel"; });

} // namespace
} // namespace meninas::test
