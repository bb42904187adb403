#include "radiosity/field/view/cell_light.h"

#include "radiosity/field/view/view_receivers.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The same wherever the vertex is asked for.
std::uint32_t seed_of(const ElementMesh& mesh, const LatticeVertex& vertex, std::uint32_t seed) {
  const auto folded = [](std::int64_t x) { return static_cast<std::uint32_t>(x ^ (x >> 32)); };
  return hash(hash(index(mesh.side_of_element[index(vertex.element)]), folded(vertex.at.x),
                   folded(vertex.at.y)),
              seed, 0x71e3);
}

/// The mean of the points. Where its rays have met occluders that were not known before, it is found again, by other
/// rays: an occluder that some rays hit is one that others have just missed, and the mean must not depend on which.
template <typename MeanOf> ArrivingLight past_occluders(SharedLightWorkspace& work, const MeanOf& mean_of) {
  constexpr std::uint32_t times_learned = 4;
  ArrivingLight light = mean_of(0);
  for (std::uint32_t time = 1; time <= times_learned && work.has_new_occluders; ++time)
    light = mean_of(time);
  return light;
}

/// The points that a vertex stands for.
class VertexFootprint {
public:
  VertexFootprint(const LightScene& light, const CellVertex& vertex, int level)
      : light_(light), cells_(vertex.cells), vertex_(vertex.cells.vertices()[vertex.number]),
        width_(std::ldexp(1.0, LatticeCells::finest - level)), apart_(cells_.stands_apart(vertex_.element)) {}

  /// Sample in [0, 1)^2. Beyond a border it is mirrored at the vertex, into what there is of the footprint.
  NumberedPoint at(const Vec2& sample, std::uint32_t number) const {
    const Vec2 step = width_ * (sample - 0.5);
    for (const Vec2& turned : {step, Vec2(-step.x, step.y), Vec2(step.x, -step.y), -step})
      if (const ElementId element = element_at(turned); element != none<ElementId>)
        return point(moved(turned), element, number);
    return point(vertex_, vertex_.element, number);
  }

private:
  LatticeVertex moved(const Vec2& step) const {
    LatticeVertex there = vertex_;
    there.at.x += std::llround(step.x);
    there.at.y += std::llround(step.y);
    return there;
  }

  NumberedPoint point(LatticeVertex at, ElementId element, std::uint32_t number) const {
    at.element = element;
    const Receiver receiver = receiver_of(light_, cells_, at);
    return {receiver, number, is_on_curve(receiver) ? none<ElementId> : element};
  }

  /// The element that the point is in; none beyond the border.
  ElementId element_at(const Vec2& step) const {
    const SideId side = light_.mesh.side_of_element[index(vertex_.element)];
    const LatticeVertex there = moved(step);
    const Vec2 uv = cells_.place_in_patch(there);
    const bool triangle = light_.mesh.sides[index(side)].triangle;
    if (uv.x < 0.0 || uv.y < 0.0 || (triangle ? uv.x + uv.y > 1.0 : std::max(uv.x, uv.y) > 1.0))
      return none<ElementId>;
    const ElementId element{land(light_.landing.elements, static_cast<std::uint32_t>(index(side)), uv).element};
    // What is behind something that stands there has other light.
    if (element != vertex_.element && (apart_ || cells_.stands_apart(element)))
      return none<ElementId>;
    return element;
  }

  const LightScene& light_;
  const LatticeCells& cells_;
  const LatticeVertex& vertex_;
  double width_; ///< of the lattice
  bool apart_;
};

} // namespace

ArrivingLight direct_at(const LightScene& light, const CellVertex& of, double pixels, const ViewRefinement& how,
                        SharedLightWorkspace& work) {
  constexpr int rounds = 8;
  const LatticeVertex& vertex = of.cells.vertices()[of.number];
  const Receiver receiver = receiver_of(light, of.cells, vertex);
  // The curve over an element may see light that its plane cannot see.
  const ElementId element = is_on_curve(receiver) ? none<ElementId> : vertex.element;
  const SharedLightSettings settings{.points = 1,
                                     .max_points = pixels > 4.0   ? rounds
                                                   : pixels > 1.5 ? rounds / 2
                                                                  : rounds / 4,
                                     .images = how.images,
                                     .rays = how.rays,
                                     .penumbra_rays = std::max(1, how.penumbra_rays / rounds),
                                     .solid_rays = how.solid_rays,
                                     .unsure = 1.0,
                                     .unsure_shadow = 0.1 * how.tolerance,
                                     .rays_by_brightness = true,
                                     .one_place = true,
                                     .caches_occluders = true};
  return past_occluders(work, [&](std::uint32_t time) {
    std::uint32_t next = 0;
    return mean_direct_irradiance(
        light, [&] { return NumberedPoint{receiver, next++, element}; }, settings,
        seed_of(light.mesh, vertex, hash(how.seed, time)), work);
  });
}

ArrivingLight mean_direct_around(const LightScene& light, const CellVertex& of, int level, const ViewRefinement& how,
                                 SharedLightWorkspace& work) {
  constexpr int points = 8; // an edge is off by about a sixteenth of the cell
  constexpr std::uint32_t footprint = 0xf007;
  const LatticeVertex& vertex = of.cells.vertices()[of.number];
  const VertexFootprint its(light, of, level);
  const SharedLightSettings settings{.points = points,
                                     .max_points = points,
                                     .images = how.images,
                                     .rays = 1,
                                     .penumbra_rays = 1,
                                     .solid_rays = how.solid_rays,
                                     .caches_occluders = true};
  return past_occluders(work, [&](std::uint32_t time) {
    const std::uint32_t seed = seed_of(light.mesh, vertex, hash(how.seed, time, footprint));
    std::uint32_t next = 0;
    return mean_direct_irradiance(
        light,
        [&] {
          const std::uint32_t number = next++;
          return its.at(Vec2(sobol2(number, seed, SobolPair::first)), number);
        },
        settings, seed, work);
  });
}

} // namespace meninas
