#include "raytrace/scattering.h"

#include "raytrace/footprint.h"
#include "raytrace/quad_lanes.h"
#include "raytrace/lane_surface.h"
#include "raytrace/lamp_weights.h"
#include "raytrace/specular_rays.h"
#include "scenes/materials/normal_map.h"
#include "scenes/materials/refraction.h"
#include "scenes/shading_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meninas {

namespace {

Bsdf bsdf_at(const LandedLane& lane) {
  const auto& [context, packet, state, face, hits, k] = lane;
  const LightScene& light = context.light;
  const TriangleId triangle{hits.triangle[k]};
  const Material& material = material_of(light.scene, triangle);
  const bool plain = !is_textured(material) && !has_vertex_colors(light.scene, triangle);
  const Bsdf bsdf =
      plain ? context.bsdfs[index(light.scene.triangles[index(triangle)].material)]
            : make_bsdf(material, material_at(light.scene, light.textures, triangle,
                                              {hits.b1[k], hits.b2[k]}, footprint_of(lane)));
  return hits.front[k] != 0 ? bsdf : from_behind(bsdf);
}

/// The solids on both sides of a surface.
struct Media {
  MaterialId before = none<MaterialId>, behind = none<MaterialId>;
};
Media media_at(const RenderContext& context, const HitPacket& hits, std::uint32_t k,
               MaterialId before) {
  const MaterialId met = context.light.scene.triangles[hits.triangle[k]].material;
  if (!is_solid_glass(context.light.scene.materials[index(met)]))
    return {before, before};
  return hits.front[k] != 0 ? Media{before, met} : Media{met, none<MaterialId>};
}

/// The scattering of a surface towards the origin of a path: its lobes, the root of the number of directions, and
/// the solids on either side.
struct Scatterer {
  const Bsdf& bsdf;
  Direction normal; ///< towards the side that was met; it turns with a curved surface
  Direction out; ///< in the frame of the normal
  int divisions;
  Media media;
};

/// The shift of a grid:
/// spread evenly over the camera rays of a pixel, at random behind another lobe.
Vec2 shift_of(const SpecularRay& ray, std::uint32_t seed_of_pixel) {
  const auto u = ray.lobes == 0 ? sobol4(ray.number, seed_of_pixel) : sobol4(0, ray.key);
  return {u[0], u[1]};
}

/// The first lobe of a path looks for emitters by their points as well.
bool samples_lamps(const RenderContext& context, const Bsdf& bsdf, const SpecularRay& ray) {
  return bsdf.alpha > 0.0 && ray.lobes == 0 &&
         context.light.emitters.size() > context.light.portals.size() &&
         (bsdf.coat > 0.0 || bsdf.glass > 0.0 || bsdf.metal != Rgb(0.0));
}

/// Where light that a rough curved surface reflects is looked for, in the frame of the ray scene.
std::optional<glm::dvec3> curve_at(const LandedLane& lane, const Bsdf& bsdf) {
  if (!lane.face.curved || bsdf.alpha == 0.0 || bsdf.glass > 0.0)
    return std::nullopt;
  const LightScene& light = lane.context.light;
  return to_frame(light.rays.frame(),
                  receiver_at(light, lane.face, lane.hits, lane.k).position);
}

void queue_lobe(const LandedLane& lane, const Scatterer& scatterer, const Meeting& at,
                SpecularRay ray, TileWorkspace& work) {
  const RenderContext& context = lane.context;
  const FaceRecord& face = lane.face;
  const auto& [bsdf, normal, out, n, media] = scatterer;
  const bool lamps_sampled = samples_lamps(context, bsdf, ray);
  const RenderSettings& settings = context.settings;
  const std::uint32_t seed = pixel_seed(work.area, ray.pixel, settings.seed);
  if (ray.lobes == 0)
    glossy_frustum(bsdf, out, n, shift_of(ray, seed), work.lobe);
  else
    lobe_sample(bsdf, out, shift_of(ray, seed), work.lobe);
  const glm::vec3 throughput = ray.throughput;
  const std::uint32_t key = ray.lobes == 0 ? hash(seed, ray.number) : ray.key;
  const std::uint16_t way = ray.way;
  const std::int32_t bounces = ray.bounces;
  const WorldId world = ray.world;
  const std::optional<glm::dvec3> curve = curve_at(lane, bsdf);
  ray.since_lobe = bsdf.alpha > 0.0 ? 0.0F : ray.since_lobe + static_cast<float>(at.distance);
  ray.share /= static_cast<float>(n * n);
  // A mirror's direction is no lobe: such chains end by their throughput alone.
  ray.lobes = static_cast<std::uint16_t>(ray.lobes + (bsdf.alpha > 0.0 ? 1 : 0));
  for (std::uint32_t cell = 0; cell < work.lobe.size(); ++cell) {
    const bool through = work.lobe[cell].through;
    if (!through && settings.mode == RenderMode::radiosity)
      continue;
    // Light that is not bent keeps its bits.
    const bool bent = bsdf.pane.faces == GlassFaces::one;
    const bool straight = through && bsdf.alpha == 0.0 && !bent;
    ray.medium = through ? media.behind : media.before;
    ray.direction = straight ? at.direction : to_world(normal, work.lobe[cell].in);
    ray.origin = curve && !through ? *curve : at.position;
    ray.leaving = curve && !through ? index(none<PlaneId>) : face.plane_class;
    if (face.curved && !straight && (through || !curve))
      ray.direction = kept_above(ray.direction, through ? -face.normal : face.normal);
    // Directions of lobes are of unit length; the beam is as wide as it was.
    ray.travelled = straight
                        ? at.travelled
                        : at.travelled / static_cast<float>(std::sqrt(glm::length(at.direction)));
    ray.way = through ? way : one_more_mirror(way);
    ray.bounces = bounces + (through ? 0 : 1);
    if (through && bent) {
      // No points on lamps are looked for through solids: rays alone find them.
      ray.world = none<WorldId>;
      ray.density = 0.0F;
    } else if (bsdf.alpha == 0.0) {
      ray.world = through       ? world
                  : face.mapped ? none<WorldId>
                                : child(context.light.worlds, world, face.mirror);
    } else {
      ray.world = real_world;
      ray.density = lamps_sampled && !through
                        ? static_cast<float>(n * n * lobe_density(bsdf, out, work.lobe[cell].in))
                        : 0.0F;
    }
    ray.throughput = throughput * glm::vec3(work.lobe[cell].weight);
    ray.key = hash(key, cell, 1);
    queue_if_visible(context, ray, work);
  }
}

/// Queues what goes on through the openings of a surface as if nothing were there.
void queue_straight(const LandedLane& lane, const Bsdf& bsdf, double cosine, const Meeting& at,
                    SpecularRay ray, TileWorkspace& work) {
  ray.origin = at.position;
  ray.direction = at.direction;
  ray.travelled = at.travelled;
  ray.since_lobe += static_cast<float>(at.distance);
  ray.throughput *= glm::vec3(facet_transmittance(bsdf, cosine));
  ray.key = hash(ray.key, 0x09e4);
  queue_if_visible(lane.context, ray, work);
}

/// The pixel's sum of what a lobe shows of light that has come to it by a mirror world.
glm::vec3& seen_by_lobe(const RenderContext& context, const SpecularRay& ray, WorldId world,
                        TileWorkspace& work) {
  const int mirrors = context.light.worlds.worlds[index(world)].depth;
  return work.sums[more_mirrors(ray.way, 1 + mirrors)][ray.pixel];
}

/// Adds light of punctual lights by the lobe.
void add_highlights(const RenderContext& context, const Scatterer& scatterer,
                    const Receiver& receiver, const SpecularRay& ray, TileWorkspace& work) {
  const auto& [bsdf, normal, out, divisions, media] = scatterer;
  punctual_arrivals(context.light, receiver, work.point.direct, work.highlights);
  for (const PunctualArrival& arrival : work.highlights) {
    // The irradiance has the cosine to the receiver's normal already.
    const Direction in = to_local(normal, arrival.towards);
    // The lobe's rays find the light of mirrors with a width of their own by the lobes of these.
    if (in.z > 0.0 && context.blurred[index(arrival.world)] == 0)
      seen_by_lobe(context, ray, arrival.world, work) +=
          ray.throughput * glm::vec3(reflection_lobe(bsdf, out, in) * arrival.irradiance);
  }
}

/// Adds light of emitters by the lobe, in the share of the points.
void add_lamps_in_lobe(const RenderContext& context, const Scatterer& scatterer,
                       const Receiver& receiver, const SpecularRay& ray, TileWorkspace& work) {
  const auto& [bsdf, normal, out, divisions, media] = scatterer;
  const int points = points_per_lamp(context);
  const EmissionSampling sampling{.per_image = points,
                                  .first = ray.number * static_cast<std::uint32_t>(points),
                                  .seed = pixel_seed(work.area, ray.pixel, context.settings.seed)};
  emission_samples(context.light, receiver, sampling, work.point.direct, work.lamps);
  for (const EmissionSample& lamp : work.lamps) {
    const double distance = glm::length(lamp.towards);
    const Direction in = to_local(normal, lamp.towards / distance);
    if (lamp.radiance == Rgb(0.0) || !(in.z > 0.0) || context.blurred[index(lamp.world)] != 0)
      continue;
    const double p = divisions * divisions * lobe_density(bsdf, out, in);
    const double q = density_of_points(points, distance, lamp.cosine, lamp.emitter_area);
    const double share = in.z * lamp.cosine * lamp.area / (distance * distance) * q / (p + q);
    seen_by_lobe(context, ray, lamp.world, work) +=
        ray.throughput * glm::vec3(reflection_lobe(bsdf, out, in) * lamp.radiance * share);
  }
}

} // namespace

glm::vec3 scattered_radiance(const LandedLane& lane, TileWorkspace& work) {
  const auto& [context, packet, state, face, hits, k] = lane;
  const bool radiosity = context.settings.mode == RenderMode::radiosity;
  const bool has_field = face.side != FaceRecord::nothing;
  Bsdf bsdf = bsdf_at(lane);
  const SpecularRay ray = ray_from(state, k, face.plane_class, context.settings.seed);
  const bool spent = bsdf.alpha > 0.0 && ray.lobes >= max_lobes;
  const Meeting at = meeting_of(context, face, packet, state, k, hits.distance[k]);
  const Direction along = glm::normalize(at.direction);
  const Direction normal = normal_towards(lane, -along);
  const Direction out = local_out(normal, along);
  if (!has_round_facets(bsdf))
    bsdf.axis = facet_axis(context.light.scene, TriangleId{hits.triangle[k]},
                           {hits.b1[k], hits.b2[k]}, bsdf.axis, normal);
  if (is_open(bsdf)) {
    queue_straight(lane, bsdf, out.z, at, ray, work);
    bsdf.glass = 0.0;
  }
  const bool smooth =
      material_of(context.light.scene, TriangleId{hits.triangle[k]}).specular_in_pass_one;
  // The field stands for what is left out, but it knows nothing of what glass,
  // smooth metals and coats that are mirrors reflect: they are ideal from there on.
  const bool goes_on_ideally = smooth || bsdf.glass > 0.0;
  if (smooth && !has_field)
    bsdf.metal = metal_all_in_lobe(bsdf, out);
  if (spent && goes_on_ideally)
    bsdf.roughness = bsdf.alpha = 0.0;
  const int n = ray.lobes == 0 ? lobe_divisions(bsdf, out, context.settings.glossy_samples) : 1;
  const Scatterer scatterer{bsdf, normal, out, n, media_at(context, hits, k, ray.medium)};
  if (goes_on_ideally || !(spent || radiosity))
    queue_lobe(lane, scatterer, at, ray, work);
  if (spent)
    return has_field ? radiance_of_lane(lane, work) : glm::vec3(0.0F);

  const ReflectedPart part = context.visible.part;
  // Pass one alone shows what is even: what the layers seen directly hold.
  const bool shows_lights =
      !radiosity && (part == ReflectedPart::all || part == ReflectedPart::none);
  // Lobes show what is above the coat.
  Receiver receiver = receiver_at(context.light, face, hits, k);
  receiver.coat = none<MaterialId>;
  receiver.normal = normal;
  if (shows_lights && bsdf.alpha > 0.0 && !context.light.punctual.empty())
    add_highlights(context, scatterer, receiver, ray, work);
  if (shows_lights && samples_lamps(context, bsdf, ray))
    add_lamps_in_lobe(context, scatterer, receiver, ray, work);
  if (!has_field)
    return glm::vec3(0.0F);
  glm::vec3 radiance = share_of_rays(context, state, face, hits, k) * shading_at(lane).emitted;
  if (part != ReflectedPart::none &&
      !material_of(context.light.scene, TriangleId{hits.triangle[k]}).unlit)
    radiance += glm::vec3(even_reflectance(bsdf, out) / std::numbers::pi) *
                irradiance_of_lane(context, state, face, hits, k, work);
  if (part != ReflectedPart::none && bsdf.passed != Rgb(0.0))
    radiance += glm::vec3(even_transmittance(bsdf, out) / std::numbers::pi) *
                irradiance_behind(lane, work);
  return radiance;
}

} // namespace meninas
