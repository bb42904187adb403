#include "mirror/region_images.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meninas {

namespace {

enum class Seen : std::uint8_t { none, part, whole };

/// The visibility of something that is seen by way of one and then of the other.
Seen both(Seen a, Seen b) { return std::min(a, b); }

/// By values at all corners: above, below, or neither by more than `margin`.
Seen above(double least, double most, double margin) {
  return least > margin ? Seen::whole : most < -margin ? Seen::none : Seen::part;
}

struct Classifier {
  const WorldTree& tree;
  std::span<const Emitter> emitters;
  const ReceivingRegion& region;
  RegionImages& images;

  /// Over the corners of the region, how far in front of a plane they are.
  Seen before(const Plane& plane) const {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const Point3& x : region.corners) {
      const double d = signed_distance(plane, x);
      least = std::min(least, d);
      most = std::max(most, d);
    }
    return above(least, most, margin());
  }

  double margin() const {
    constexpr double tolerances = 8.0; // points may be off by about one
    return tolerances * region.tolerance;
  }

  Seen over_horizon(const ConvexPolygon& target) const {
    constexpr double slope = 1e-3; // normals of a surface that is not quite flat
    double least = HUGE_VAL, most = -HUGE_VAL, reach = 0.0;
    for (const Point3& y : target.span())
      for (const Point3& x : region.corners) {
        const double height = glm::dot(region.normal, y - x);
        least = std::min(least, height);
        most = std::max(most, height);
        reach = std::max(reach, glm::distance(x, y));
      }
    return above(least, most, margin() + slope * reach);
  }

  static Seen behind(const Plane& plane, const ConvexPolygon& target, double margin) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const Point3& y : target.span()) {
      const double d = -signed_distance(plane, y);
      least = std::min(least, d);
      most = std::max(most, d);
    }
    return above(least, most, margin);
  }

  /// The visibility of the target through one part of a window that all of the region is in front of.
  Seen through_part(const ConvexPolygon& part, const ConvexPolygon& target) const {
    const Point3& origin = region.corners[0];
    const double side =
        glm::dot(area_vector(part.span()), part.vertices[0] - origin) > 0.0 ? 1.0 : -1.0;
    double reach = 0.0, magnitude = 0.0;
    for (const auto& points : {region.corners, part.span(), target.span()})
      for (const Point3& point : points) {
        reach = std::max(reach, glm::distance(point, origin));
        magnitude = std::max(magnitude, glm::length(point));
      }
    // Corners of a window that was cut are off by their rounding,
    // which is all that the direction of a very short edge has.
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * magnitude;
    Seen seen = Seen::whole;
    Point3 from = part.vertices[part.size - 1];
    for (std::size_t k = 0; k < part.size; ++k) {
      const Point3 &a = from, &b = part.vertices[k];
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (const Point3& x : region.corners) {
        const Vec3 inward = side * glm::cross(a - x, b - x);
        for (const Point3& y : target.span()) {
          const double f = glm::dot(inward, y - x);
          least = std::min(least, f);
          most = std::max(most, f);
        }
      }
      // x or y that is off by d changes f by at most |b - a| |y - a| d,
      // a or b by |b - x| |y - x| d.
      const double length = glm::distance(a, b);
      const double unsure = 2.0 * reach * (length * margin() + 2.0 * reach * rounding);
      seen = both(seen, length > margin() ? above(least, most, unsure) : Seen::part);
      if (seen == Seen::none)
        return seen;
      from = b;
    }
    return seen;
  }

  Seen through_window(const MirrorWorld& world, const ConvexPolygon& target) const {
    if (before(world.plane) != Seen::whole)
      return Seen::part;
    bool any_part = false;
    for (const ConvexPolygon& part : world.window) {
      const Seen seen = through_part(part, target);
      if (seen == Seen::whole)
        return seen;
      any_part |= seen == Seen::part;
    }
    return any_part ? Seen::part : Seen::none;
  }

  /// By way of the windows of the world at this place and of those before it.
  Seen through_chain(std::uint32_t place, const ConvexPolygon& target) const {
    Seen seen = Seen::whole;
    for (; place != 0 && seen != Seen::none; place = images.worlds[place].parent)
      seen = both(seen, through_window(tree.worlds[index(images.worlds[place].world)], target));
    return seen;
  }

  Seen image(std::uint32_t place, const Emitter& emitter) const {
    const MirrorWorld& world = tree.worlds[index(images.worlds[place].world)];
    const bool real = world.depth == 0;
    Seen seen = before(real ? emitter.plane : apply(world.image, emitter.plane));
    if (seen == Seen::none)
      return seen;
    ConvexPolygon polygon(emitter.corners);
    if (!real)
      for (std::size_t k = 0; k < polygon.size; ++k)
        polygon.vertices[k] = apply(world.image, polygon.vertices[k]);
    seen = both(seen, over_horizon(polygon));
    if (real || seen == Seen::none)
      return seen;
    seen = both(seen, behind(world.plane, polygon, margin()));
    return seen == Seen::none ? seen : both(seen, through_chain(place, polygon));
  }

  Seen window(std::uint32_t parent, const MirrorWorld& world) const {
    const Seen faces = before(world.plane);
    if (faces == Seen::none)
      return faces;
    bool all = true, any = false;
    for (const ConvexPolygon& part : world.window) {
      Seen seen = over_horizon(part);
      if (seen != Seen::none)
        seen = both(seen, through_chain(parent, part));
      all &= seen == Seen::whole;
      any |= seen != Seen::none;
    }
    return !any ? Seen::none : all && faces == Seen::whole ? Seen::whole : Seen::part;
  }

  void visit(WorldId world, std::uint32_t parent, bool whole) {
    const auto place = static_cast<std::uint32_t>(images.worlds.size());
    const auto first = static_cast<std::uint32_t>(images.images.size());
    images.worlds.push_back({world, parent, whole, false, first, first});
    for (std::uint32_t e = 0; e < emitters.size(); ++e)
      if (const Seen seen = image(place, emitters[e]); seen != Seen::none)
        images.images.push_back({e, seen == Seen::whole});
    images.worlds[place].last = static_cast<std::uint32_t>(images.images.size());
    for (const WorldId next : tree.children[index(world)])
      if (next != none<WorldId>)
        if (const Seen seen = window(place, tree.worlds[index(next)]); seen != Seen::none)
          visit(next, place, seen == Seen::whole);
    const RegionWorld& done = images.worlds[place];
    const bool empty = done.first == done.last && images.worlds.size() == place + 1;
    if (empty && place != 0)
      images.worlds.pop_back();
  }

  /// Windows are cut where an image or the next window has to be cut by them.
  void find_opening() {
    for (std::size_t place = images.worlds.size(); place-- > 0;) {
      RegionWorld& at = images.worlds[place];
      for (std::uint32_t k = at.first; k < at.last; ++k)
        at.opens |= !images.images[k].whole;
      if (at.opens && !at.whole)
        images.worlds[at.parent].opens = true;
    }
  }
};

} // namespace

void images_of_region(const WorldTree& tree, std::span<const Emitter> emitters,
                      const ReceivingRegion& region, RegionImages& images) {
  images.worlds.clear();
  images.images.clear();
  Classifier classifier{tree, emitters, region, images};
  classifier.visit(real_world, 0, true);
  classifier.find_opening();
}

void lights_in_region(const WorldTree& tree, std::span<const Emitter> emitters,
                      const RegionImages& images, const Observer& observer, SeenWorlds& seen,
                      std::vector<VirtualLight>& lights) {
  lights.clear();
  seen.clear();
  for (const RegionWorld& at : images.worlds) {
    const MirrorWorld& world = tree.worlds[index(at.world)];
    const auto first = static_cast<std::uint32_t>(seen.openings.size());
    if (at.opens && at.whole)
      for (const ConvexPolygon& part : world.window)
        seen.add_opening(observer, part);
    else if (at.opens)
      add_openings(world, observer, seen.worlds[at.parent], seen);
    seen.worlds.push_back({at.world, first, static_cast<std::uint32_t>(seen.openings.size())});
    for (std::uint32_t k = at.first; k < at.last; ++k) {
      const RegionImage& image = images.images[k];
      if (image.whole)
        add_whole_image(tree, emitters, at.world, image.emitter, lights);
      else
        add_images({tree, seen, seen.worlds.back(), observer}, emitters, image.emitter, 1.0,
                   lights);
    }
  }
}

} // namespace meninas
