#include "radiosity/light/virtual_light_visibility.h"

#include "radiosity/scene/mirror_holes.h"
#include "radiosity/scene/surface_colour.h"
#include "scenes/rays/glass_crossings.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

namespace {

/// The share of the fan's triangle that ends in corner k, by area.
double share_of(const ConvexPolygon& polygon, const Vec3& area, std::size_t k) {
  const Vec3 edge_a = polygon.vertices[k - 1] - polygon.vertices[0],
             edge_b = polygon.vertices[k] - polygon.vertices[0];
  return 0.5 * glm::dot(glm::cross(edge_a, edge_b), area) / glm::dot(area, area);
}

/// A fan triangle by area, then a point in it.
template <typename ShareOf>
Point3 point_in_fan(const ConvexPolygon& polygon, const ShareOf& share_of_triangle, Vec2 sample) {
  const auto& corners = polygon.vertices;
  double before = 0.0;
  for (std::size_t k = 2; k < polygon.size; ++k) {
    const double share = share_of_triangle(k);
    if (sample.x < before + share || k + 1 == polygon.size) {
      const double u = share > 0.0 ? std::clamp((sample.x - before) / share, 0.0, 1.0) : 0.5;
      const double root = std::sqrt(u);
      return corners[0] + root * (1.0 - sample.y) * (corners[k - 1] - corners[0]) +
             root * sample.y * (corners[k] - corners[0]);
    }
    before += share;
  }
  return corners[0];
}

} // namespace

PolygonFan::PolygonFan(const ConvexPolygon& whole, const Vec3& area) : polygon(whole) {
  for (std::size_t k = 2; k < polygon.size; ++k)
    shares[k] = share_of(polygon, area, k);
}

Point3 point_on(const PolygonFan& fan, Vec2 sample) {
  return point_in_fan(
      fan.polygon, [&](std::size_t k) { return fan.shares[k]; }, sample);
}

Point3 point_on(const ConvexPolygon& polygon, const Vec3& area, Vec2 sample) {
  return point_in_fan(
      polygon, [&](std::size_t k) { return share_of(polygon, area, k); }, sample);
}

double area_of(std::span<const ConvexPolygon> parts) {
  double sum = 0.0;
  for (const ConvexPolygon& part : parts)
    sum += glm::length(area_vector(part.span()));
  return sum;
}

Point3 point_on(std::span<const ConvexPolygon> parts, double area, const Vec3& last, Vec2 sample) {
  double before = 0.0;
  for (const ConvexPolygon& part : parts.first(parts.size() - 1)) {
    const Vec3 own = area_vector(part.span());
    const double share = glm::length(own) / area;
    if (sample.x < before + share)
      return point_on(part, own, Vec2((sample.x - before) / share, sample.y));
    before += share;
  }
  const double within =
      before < 1.0 ? std::clamp((sample.x - before) / (1.0 - before), 0.0, 1.0) : 0.5;
  return point_on(parts.back(), last, Vec2(within, sample.y));
}

void fold(const LightScene& light, WorldId world, const Leg& whole, FoldedSegment& segment,
          Solids solids) {
  segment.world = world;
  segment.solids = solids;
  fold_legs(light.worlds, light.mirrors, world, whole, segment.legs);
}

/// By bits, the segments that meet a mirror in a hole.
static std::uint32_t lost_in_holes(const LightScene& light, std::span<const FoldedSegment> folded) {
  std::uint32_t lost = 0;
  for (std::size_t k = 0; k < folded.size(); ++k)
    if (meets_hole(light, folded[k].world, folded[k].legs))
      lost |= 1U << k;
  return lost;
}

/// The lanes whose rays something blocks, solids as of their segments.
static std::uint32_t occluded_lanes(const LightScene& light, RayPacket& packet,
                                    const std::array<FoldedSegment, 16>& folded,
                                    Blockers* triangles) {
  const auto trace = [&](Solids solids) {
    return occluded(light.rays, packet, Coherence::coherent, triangles, solids);
  };
  const auto alike = [&](const FoldedSegment& segment) { return segment.solids == folded[0].solids; };
  if (light.solids.empty() || std::all_of(folded.begin(), folded.begin() + packet.count, alike))
    return trace(folded[0].solids);
  // Rays of one kind at a time; a ray of no length meets nothing.
  std::uint32_t dark = 0;
  const auto lengths = packet.max_distance;
  Blockers found{};
  for (const Solids solids : {Solids::opaque, Solids::sheets}) {
    for (std::uint32_t k = 0; k < packet.count; ++k)
      packet.max_distance[k] = folded[k].solids == solids ? lengths[k] : 0.0F;
    const std::uint32_t of_kind = trace(solids);
    for (std::uint32_t rest = triangles ? of_kind : 0; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(rest));
      found[k] = (*triangles)[k];
    }
    dark |= of_kind;
  }
  if (triangles)
    *triangles = found;
  return dark;
}

std::uint32_t blocked(const LightScene& light, const std::array<FoldedSegment, 16>& folded,
                      std::uint32_t count, std::uint64_t& rays,
                      std::array<LegBlocker, 16>* blockers) {
  const RayFrame& frame = light.rays.frame();
  std::uint32_t result = lost_in_holes(light, std::span(folded).first(count));
  for (std::uint32_t rest = blockers ? result : 0; rest != 0; rest &= rest - 1)
    (*blockers)[static_cast<std::size_t>(std::countr_zero(rest))] = {};
  RayPacket packet;
  packet.count = count;
  std::size_t legs = 0;
  for (std::uint32_t k = 0; k < count; ++k)
    legs = std::max(legs, folded[k].legs.size());
  const std::uint32_t all = (1U << count) - 1U;
  for (std::size_t step = 0; step < legs && result != all; ++step) {
    for (std::uint32_t k = 0; k < count; ++k) {
      if (step >= folded[k].legs.size() || ((result >> k) & 1U) != 0) {
        packet.max_distance[k] = 0.0F; // no ray
        continue;
      }
      const Leg& leg = folded[k].legs[step];
      const Vec3 from = (leg.from - frame.centre) * frame.scale,
                 along = (leg.to - leg.from) * frame.scale;
      set_ray(packet, k, from, along, index(leg.leaving), 1.0F);
      packet.arriving[k] = index(leg.arriving);
      ++rays;
    }
    Blockers triangles;
    const std::uint32_t dark =
        occluded_lanes(light, packet, folded, blockers ? &triangles : nullptr);
    for (std::uint32_t rest = blockers ? dark & ~result : 0; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(rest));
      (*blockers)[k] = {TriangleId{triangles[k]}, static_cast<std::uint32_t>(step)};
    }
    result |= dark;
  }
  return result;
}

namespace {

double cosine_of(const Leg& leg, const Direction& normal) {
  const Vec3 way = leg.to - leg.from;
  const double length = glm::length(way);
  return length > 0.0 ? std::abs(glm::dot(way, normal)) / length : 1.0;
}

Bsdf glass_there(const LightScene& light, const GlassCrossing& crossing) {
  const MaterialId material = light.scene.triangles[index(crossing.triangle)].material;
  const bool plain = !is_textured(light.scene.materials[index(material)]) &&
                     !has_vertex_colors(light.scene, crossing.triangle);
  return plain ? light.by_angle[index(material)]
               : glass_at(light.scene, light.textures, crossing.triangle, crossing.barycentric);
}

Rgb passed(const LightScene& light, const GlassCrossing& crossing, Solids solids) {
  if (solids == Solids::opaque && is_solid_glass(material_of(light.scene, crossing.triangle)))
    return Rgb(0.0);
  return facet_transmittance(glass_there(light, crossing), crossing.cosine);
}

/// By the pane or the coat in which a leg ends.
Rgb reflected(const LightScene& light, const Leg& leg, const Mirror& mirror) {
  const double cosine = cosine_of(leg, mirror.plane.normal);
  if (!mirror.is_coat && is_textured(light.scene.materials[index(mirror.by_angle)]))
    if (const auto end = glass_at_end(light.rays, leg, mirror.plane_class))
      return facet_reflectance(glass_there(light, *end), cosine);
  return facet_reflectance(light.by_angle[index(mirror.by_angle)], cosine);
}

} // namespace

Rgb transmittance_by_angle(const LightScene& light, const FoldedSegment& segment) {
  Rgb left(1.0);
  if (light.by_angle.empty())
    return left;
  const auto& legs = segment.legs;
  std::vector<GlassCrossing> crossings;
  for (std::size_t k = 0; light.has_glass && k < legs.size(); ++k) {
    glass_crossings(light.rays, legs[k], crossings);
    for (const GlassCrossing& crossing : crossings) {
      left *= passed(light, crossing, segment.solids);
      // Behind a pane that is opaque there, as leaves are within their outline, the others do not matter.
      if (left == Rgb(0.0))
        return left;
    }
  }
  // The last mirror of the chain is met by the last leg but one, and so on.
  std::size_t step = legs.size() - 1;
  for (WorldId world = segment.world; world != real_world;
       world = light.worlds.worlds[index(world)].parent) {
    const Leg& leg = legs[--step];
    const Mirror& mirror = light.mirrors.mirrors[index(light.worlds.worlds[index(world)].mirror)];
    if (mirror.by_angle == none<MaterialId>)
      continue;
    const Rgb there = reflected(light, leg, mirror);
    for (int band = 0; band < 3; ++band)
      left[band] *= mirror.reflectance[band] > 0.0 ? there[band] / mirror.reflectance[band] : 0.0;
  }
  return left;
}

/// By the coat of a surface at which a leg ends.
static Rgb let_through(const LightScene& light, const SegmentEnd& end, const Leg& leg) {
  return end.coat == none<MaterialId>
             ? Rgb(1.0)
             : coat_transmittance(light.by_angle[index(end.coat)], cosine_of(leg, end.normal));
}

Rgb transmittance_between(const LightScene& light, const SegmentEnd& receiver, const SegmentEnd& sender,
                 const FoldedSegment& segment) {
  return let_through(light, receiver, segment.legs.front()) *
         let_through(light, sender, segment.legs.back()) * transmittance_by_angle(light, segment);
}

} // namespace meninas
