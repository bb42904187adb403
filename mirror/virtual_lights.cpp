#include "mirror/virtual_lights.h"

#include <algorithm>

namespace meninas {

namespace {

/// What stays the same while the tree is walked from one point.
struct Observer {
  const WorldTree& tree;
  std::span<const Emitter> emitters;
  Point3 x;
  Direction normal;
  double tolerance;
  std::vector<VirtualLight>& lights;
};

/// The image of one emitter in one world, cut by the horizon, the last mirror's plane and each visible part of its window.
void add_images(const Observer& observer, const MirrorWorld& world, WorldId id,
                std::uint32_t emitter, std::span<const ConvexPolygon> visible) {
  const Emitter& e = observer.emitters[emitter];
  const Plane plane = apply(world.image, e.plane);
  if (signed_distance(plane, observer.x) <= observer.tolerance)
    return;

  ConvexPolygon image;
  for (const auto& vertex : e.polygon.span())
    image.push_back(apply(world.image, vertex));
  image = clip(image, observer.x, observer.normal);
  if (world.depth == 0) {
    if (!image.empty())
      observer.lights.push_back({emitter, id, image, plane.normal});
    return;
  }
  image = clip(image, world.plane.offset * world.plane.normal, -world.plane.normal);
  for (const auto& window : visible) {
    const ConvexPolygon part = clip_to_cone(image, observer.x, window);
    if (!part.empty())
      observer.lights.push_back({emitter, id, part, plane.normal});
  }
}

/// The parts of a child's window that x sees through the visible parts of its parent's.
std::vector<ConvexPolygon> visible_window(const Observer& observer, const MirrorWorld& world,
                                          std::span<const ConvexPolygon> parent_visible) {
  std::vector<ConvexPolygon> visible;
  if (signed_distance(world.plane, observer.x) <= 0.0)
    return visible;
  for (const auto& part : world.window) {
    const ConvexPolygon above = clip(part, observer.x, observer.normal);
    if (above.empty())
      continue;
    if (world.depth == 1) {
      visible.push_back(above);
      continue;
    }
    for (const auto& opening : parent_visible) {
      const ConvexPolygon seen = clip_to_cone(above, observer.x, opening);
      if (!seen.empty())
        visible.push_back(seen);
    }
  }
  return visible;
}

void walk(const Observer& observer, WorldId id, std::span<const ConvexPolygon> visible) {
  const MirrorWorld& world = observer.tree.worlds[index(id)];
  for (std::uint32_t e = 0; e < observer.emitters.size(); ++e)
    add_images(observer, world, id, e, visible);
  for (const WorldId next : observer.tree.children[index(id)]) {
    if (next == none<WorldId>)
      continue;
    const auto opening = visible_window(observer, observer.tree.worlds[index(next)], visible);
    if (!opening.empty())
      walk(observer, next, opening);
  }
}

} // namespace

void virtual_lights(const WorldTree& tree, std::span<const Emitter> emitters, const Point3& x,
                    const Direction& normal, double tolerance, std::vector<VirtualLight>& lights) {
  lights.clear();
  if (emitters.empty())
    return;
  walk({tree, emitters, x, normal, tolerance, lights}, real_world, {});
}

void fold_legs(const WorldTree& tree, const MirrorSet& mirrors, WorldId world, const Point3& x,
               PlaneId leaving, const Point3& y, PlaneId arriving, std::vector<Leg>& legs) {
  legs.clear();
  Leg leg{x, y, leaving, arriving};
  if (world != real_world) {
    // The first leg ends on m1; behind it the rest of the segment is reflected back into the room, and so on.
    for (const MirrorId id : chain_of(tree, world)) {
      const Mirror& mirror = mirrors.mirrors[index(id)];
      const Point3 target = leg.to;
      const double before = signed_distance(mirror.plane, leg.from);
      const double behind = signed_distance(mirror.plane, target);
      const double t = before > behind ? std::clamp(before / (before - behind), 0.0, 1.0) : 0.0;
      leg.to = glm::mix(leg.from, target, t);
      leg.arriving = mirror.plane_class;
      legs.push_back(leg);
      leg = {leg.to, reflect_point(mirror.plane, target), mirror.plane_class, arriving};
    }
  }
  legs.push_back(leg);
}

} // namespace meninas
