// Ray queries over the input geometry: nearest hit and occlusion. (The only user of Embree.)
//
// Sides: a single-sided surface reflects, emits and mirrors at its front;
// its back is an opaque black absorber. Hits say which side they are on.
// `Backs::transparent` (camera rays) lets rays pass through such backs.
// Where two coincident surfaces face opposite ways, the one that faces the ray is hit.
//
// A ray that leaves a surface names the plane it leaves (`leaving`):
// nothing in that plane is hit, so there is no epsilon and no self-hit at any scale.
// A ray whose rounded origin slipped behind an adjoining wall still meets that wall.
//
// Embree works in floats, in a frame recentred and rescaled to the scene:
// x_frame = (x - centre) * scale, which maps the bounds into [-1, 1].
// Packets are given in that frame; single queries in metres. Directions need not be rescaled.
// Distances in packets are in frame units. All queries are const and safe
// from any number of threads; the same ray gets the same bits every time.
#pragma once

#include "scenes/rays/embree_scene.h"

#include <optional>

namespace meninas {

std::optional<Hit> closest_hit(const RayScene& rays, const Ray& ray, Backs backs = Backs::absorb);
bool occluded(const RayScene& rays, const Leg& leg);

void closest_hits(const RayScene& rays, const RayPacket& packet, HitPacket& hits, Backs backs,
                  Coherence coherence);

/// Bit k of the result is set where ray k meets something but glass before max_distance.
std::uint32_t occluded(const RayScene& rays, const RayPacket& packet, Coherence coherence,
                       Blockers* blockers = nullptr, Solids solids = Solids::sheets);

} // namespace meninas
