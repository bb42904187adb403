// The visibility of virtual lights: shadow rays to points of emitters and of their images, leg by leg; V of D = sum tau
// E F V.
//
// The segment from x to a point of the image of an emitter in world w = (m1 ... mk) crosses the
// planes of its mirrors; folded back it has k + 1 legs in the real room, each of which must be free:
//
//   V = product over the legs of (free ? t : 0),    t what panes pass and coats let through, per channel, relative to tau
#pragma once

#include "radiosity/scene/light_scene.h"

#include <array>
#include <span>

namespace meninas {

/// A convex polygon as the fan of triangles about its first corner, of which points are chosen.
struct PolygonFan {
  const ConvexPolygon& polygon;
  std::array<double, ConvexPolygon::capacity> shares; ///< of the area: of the triangle that ends in a corner

  /// With the polygon's area vector.
  PolygonFan(const ConvexPolygon& whole, const Vec3& area);
};

/// A point of a convex polygon with density one over its area:
/// of a fan where many are asked for.
Point3 point_on(const PolygonFan& fan, Vec2 sample);
Point3 point_on(const ConvexPolygon& polygon, const Vec3& area, Vec2 sample);

/// The area of parts of a polygon, m^2, and a point with density one over it. `last` is the area vector
/// of the last part.
double area_of(std::span<const ConvexPolygon> parts);
Point3 point_on(std::span<const ConvexPolygon> parts, double area, const Vec3& last, Vec2 sample);

/// The triangle that blocks a segment, and the leg that it blocks:
/// none where the blocker touches an end of the leg, or a mirror has a hole.
struct LegBlocker {
  TriangleId triangle = none<TriangleId>;
  std::uint32_t leg = 0;
};

/// The real legs of a segment from a point to one in the unfolded space of a world,
/// as `fold_legs` tells them.
struct FoldedSegment {
  WorldId world = real_world;
  std::vector<Leg> legs;
  Solids solids = Solids::opaque; ///< sheets to light that no ray would meet: each of their faces is one
};

/// Folds `whole`, as if it had one leg, in the storage of `segment`.
void fold(const LightScene& light, WorldId world, const Leg& whole, FoldedSegment& segment,
          Solids solids = Solids::opaque);

/// The treatment of solids for the light of an emitter: rays find no area light behind them.
inline Solids solids_before(const Emitter& emitter) {
  return emitter.area_light == no_area_light ? Solids::opaque : Solids::sheets;
}

/// Tests up to sixteen folded segments, best of about as many legs each; bit k of the result
/// is set where segment k is blocked, `blockers[k]` by what, or meets a mirror in a hole.
/// Solids of glass block them: what these bend, rays find (glass_light.h, hemisphere_rays.h); only for
/// light that none would meet each of their faces is a sheet. Adds to `rays`.
std::uint32_t blocked(const LightScene& light, const std::array<FoldedSegment, 16>& folded,
                      std::uint32_t count, std::uint64_t& rays,
                      std::array<LegBlocker, 16>* blockers = nullptr);

/// The factor of glass and coats on a free segment, beside the throughput of its world (dimensionless):
/// the product of the transmittances of all panes at the angles at which they are crossed, and of the
/// reflectances R(c) / R_mean of the panes and coats that are mirrors of the world. R_mean is in the
/// world's throughput. 1 where there are none.
Rgb transmittance_by_angle(const LightScene& light, const FoldedSegment& segment);

/// A surface at the end of a segment, and the coat above it where that is a mirror.
struct SegmentEnd {
  Direction normal;
  MaterialId coat = none<MaterialId>;
};

/// The same, for light that is sent from below one coat and received below another:
/// each lets through (1 - R(cos)) / (1 - R_mean) (coat_transmittance).
Rgb transmittance_between(const LightScene& light, const SegmentEnd& receiver, const SegmentEnd& sender,
                 const FoldedSegment& segment);

} // namespace meninas
