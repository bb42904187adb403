// Irradiance at points of the room, on its surfaces or in the middle of it, on one side of a plane each.
//
//   H(x, n) = D(x, n) + 1/N sum over rays of tau B(landing) + what bright elements send,      W/m^2
//
// as at vertices (light/point_irradiance.h), but at the point itself and by many more rays: nothing is
// interpolated between vertices. Its parts:
//
//   direct     no diffuse surface has reflected it: from lamps, punctual lights and the sky, also by way of mirrors
//   by mirrors its last leg came by way of mirrors, whatever it left
//
// Elements reflect what the field of pass one says. Error: that of the field's means over elements, and
// of N rays, about 1 / N of what varies smoothly over the hemisphere.
#pragma once

#include "radiosity/light/point_irradiance.h"

#include <span>
#include <vector>

namespace meninas {

struct QueryPoint {
  Point3 position{0.0};
  Direction normal{0.0, 1.0, 0.0};
};

struct PointQuerySettings {
  int rays = 4096; ///< over the hemisphere of each point
  /// Points are few: as many rays where nothing seems to differ as in penumbrae. An image of a lamp that brings
  /// a thousandth is not decided by one ray then, and a sky differs across a portal.
  DirectSettings direct{.shadow_rays = 2048,
                        .penumbra_rays = 2048,
                        .penumbra_samples = PenumbraSamples::together,
                        .images = 4096};
  FormFactorSettings form_factors = {}; ///< how the rays are followed
};

/// W/m^2
struct PointIrradiance {
  Rgb total{0.0}, direct{0.0}, by_mirrors{0.0};
  std::vector<Rgb> by_lamp = {}; ///< parts of the total; empty where light is not told apart
  bool inside = false; ///< of something: no light is there, and all its rays end on backs and dark sides
};

/// In the order of the points. `reflected` is B by ElementId, emission left out. A point within the
/// tolerance of a surface that faces as it does, or the other way, lies on it. An exception of `progress` ends it.
std::vector<PointIrradiance> irradiance_at_points(const LightScene& light,
                                                  SentLight reflected,
                                                  std::span<const QueryPoint> points,
                                                  const PointQuerySettings& settings,
                                                  const Progress& progress = {});

} // namespace meninas
