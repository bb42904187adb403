// Shadow rays to points of emitters and of their images, leg by leg.
#pragma once

#include "radiosity/light_scene.h"

#include <array>
#include <span>

namespace meninas {

/// A point of a convex polygon with density one over its area, whose area vector is given.
Point3 point_on(const ConvexPolygon& polygon, const Vec3& area, Vec2 sample);

/// What blocks a segment, and on which of its legs: none where it touches an end of the leg.
struct LegBlocker {
  TriangleId triangle = none<TriangleId>;
  std::uint32_t leg = 0;
};

/// Tests up to sixteen folded segments, best of about as many legs each; bit k of the result is set where segment k is blocked, `blockers[k]` by what. Adds to
/// `rays`.
std::uint32_t blocked(const LightScene& light, const std::array<std::vector<Leg>, 16>& folded,
                      std::uint32_t count, std::uint64_t& rays,
                      std::array<LegBlocker, 16>* blockers = nullptr);

/// What glass makes of light on a free segment in a world, beside the throughput of that world: the product of what passes each pane at the
/// angle at which it is crossed, and of what each pane that is a mirror of the world reflects at its angle over the mean that the world's
/// throughput has for it. 1 where there is no glass. Solids count as the sheets that their faces are, or, for those whose rays find what is refracted, pass nothing.
enum class Solids { sheets, opaque };
Rgb left_by_glass(const LightScene& light, WorldId world, std::span<const Leg> legs,
                  Solids solids = Solids::sheets);

} // namespace meninas
