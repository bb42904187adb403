#include "mirror/virtual_lights.h"

#include <algorithm>
#include <cmath>

namespace meninas {

void add_openings(const MirrorWorld& world, const Observer& observer, const SeenWorld& parent,
                  SeenWorlds& seen) {
  if (signed_distance(world.plane, observer.position) <= 0.0)
    return;
  for (const auto& part : world.window) {
    const ConvexPolygon above = clip(part, observer.position, observer.normal);
    if (above.empty())
      continue;
    if (world.depth == 1) {
      seen.add_opening(observer, above);
      continue;
    }
    for (std::uint32_t k = parent.first; k < parent.last; ++k) {
      const ConvexPolygon opening = clip_to_cone(above, observer.position, seen.cones[k]);
      if (!opening.empty() && !is_point(opening, observer.position))
        seen.add_opening(observer, opening);
    }
  }
}

namespace {

void walk(const WorldTree& tree, const Observer& observer, const SeenWorld& at, SeenWorlds& seen) {
  seen.worlds.push_back(at);
  for (const WorldId next : tree.children[index(at.world)]) {
    if (next == none<WorldId>)
      continue;
    const auto first = static_cast<std::uint32_t>(seen.openings.size());
    add_openings(tree.worlds[index(next)], observer, at, seen);
    const auto last = static_cast<std::uint32_t>(seen.openings.size());
    if (last > first)
      walk(tree, observer, {next, first, last}, seen);
  }
}

} // namespace

void seen_worlds(const WorldTree& tree, const Observer& observer, SeenWorlds& seen) {
  seen.clear();
  walk(tree, observer, {}, seen);
}

/// Where a polygon of the real room appears.
static ConvexPolygon image_of(std::span<const Point3> corners, const MirrorWorld& world) {
  const ConvexPolygon polygon(corners);
  return world.depth > 0 ? apply(world.image, polygon) : polygon;
}

void add_images(const WorldSight& sight, std::span<const Emitter> emitters, std::uint32_t emitter,
                double weight, std::vector<VirtualLight>& lights) {
  const SeenWorld& at = sight.at;
  const Observer& observer = sight.observer;
  const Emitter& e = emitters[emitter];
  const MirrorWorld& world = sight.tree.worlds[index(at.world)];
  const Plane plane = world.depth == 0 ? e.plane : apply(world.image, e.plane);
  if (signed_distance(plane, observer.position) <= observer.tolerance)
    return;

  // The image is cut by the horizon, by the last mirror's plane,
  // and by each visible part of the last window.
  ConvexPolygon image = image_of(e.corners, world);
  // An emitter in the plane of the last mirror sends no light to it:
  // the back of a sheet would shine forward through its own front.
  const auto is_in_mirror = [&](const Point3& p) {
    return std::abs(signed_distance(world.plane, p)) <= observer.tolerance;
  };
  if (world.depth > 0 && std::ranges::all_of(image.span(), is_in_mirror))
    return;
  clip_in_place(image, observer.position, observer.normal);
  if (image.empty())
    return;
  if (world.depth == 0) {
    lights.push_back({emitter, at.world, image, plane.normal, weight});
    return;
  }
  clip_in_place(image, origin_of(world.plane), -world.plane.normal);
  for (std::uint32_t k = at.first; k < at.last && !image.empty(); ++k) {
    const ConvexPolygon part = clip_to_cone(image, observer.position, sight.seen.cones[k]);
    if (!part.empty())
      lights.push_back({emitter, at.world, part, plane.normal, weight});
  }
}

void add_whole_image(const WorldTree& tree, std::span<const Emitter> emitters, WorldId id,
                     std::uint32_t emitter, std::vector<VirtualLight>& lights) {
  const MirrorWorld& world = tree.worlds[index(id)];
  const Emitter& e = emitters[emitter];
  const Plane plane = world.depth == 0 ? e.plane : apply(world.image, e.plane);
  lights.push_back({emitter, id, image_of(e.corners, world), plane.normal, 1.0});
}

void all_lights(const WorldTree& tree, std::span<const Emitter> emitters, const SeenWorlds& seen,
                const Observer& observer, std::vector<VirtualLight>& lights) {
  for (const auto& world : seen.worlds)
    for (std::uint32_t e = 0; e < emitters.size(); ++e)
      add_images({tree, seen, world, observer}, emitters, e, 1.0, lights);
}

void virtual_lights(const WorldTree& tree, std::span<const Emitter> emitters, const Point3& x,
                    const Direction& normal, double tolerance, std::vector<VirtualLight>& lights) {
  lights.clear();
  if (emitters.empty())
    return;
  SeenWorlds seen;
  const Observer observer{x, normal, tolerance};
  seen_worlds(tree, observer, seen);
  all_lights(tree, emitters, seen, observer, lights);
}

void fold_legs(const WorldTree& tree, const MirrorSet& mirrors, WorldId world, const Leg& whole,
               std::vector<Leg>& legs) {
  legs.clear();
  Leg leg = whole;
  if (world != real_world) {
    // The first leg ends on m1;
    // behind it the rest of the segment is reflected back into the room, and so on.
    for (const MirrorId id : chain_of(tree, world)) {
      const Mirror& mirror = mirrors.mirrors[index(id)];
      const Point3 target = leg.to;
      const double before = signed_distance(mirror.plane, leg.from);
      const double behind = signed_distance(mirror.plane, target);
      const double t = before > behind ? std::clamp(before / (before - behind), 0.0, 1.0) : 0.0;
      leg.to = glm::mix(leg.from, target, t);
      leg.arriving = mirror.plane_class;
      legs.push_back(leg);
      leg = {leg.to, reflect_point(mirror.plane, target), mirror.plane_class, whole.arriving};
    }
  }
  legs.push_back(leg);
}

} // namespace meninas
