// Shadow rays to points of emitters and of their images, leg by leg.
#pragma once

#include "radiosity/light_scene.h"

#include <array>

namespace meninas {

/// A point of a convex polygon with density one over its area, whose area vector is given.
Point3 point_on(const ConvexPolygon& polygon, const Vec3& area, Vec2 sample);

/// Tests up to sixteen folded segments of as many legs each; bit k of the result is set where segment k is blocked. Adds to `rays`.
std::uint32_t blocked(const LightScene& light, const std::array<std::vector<Leg>, 16>& folded,
                      std::uint32_t count, std::uint64_t& rays);

} // namespace meninas
