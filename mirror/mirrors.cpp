#include "mirror/mirrors.h"

#include "mirror/window.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/smooth_surfaces.h"
#include "scenes/surfaces/curved_patches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace meninas {

namespace {

/// Surfaces of one plane, one facing and one reflectance are one mirror, of glass those
/// of one material, of coats those of one reflectance by the angle, ideal ones by themselves.
/// A curved surface is a mirror by itself, and none that is enumerated.
using MirrorKey = std::tuple<std::uint32_t, bool, double, double, double, MaterialId, bool, bool>;

/// The mean reflectance of a material, over all angles.
Rgb reflectance_of(const Material& material) {
  if (has_mirror_coat(material))
    return mean_shares(mirror_coat(material)).reflected;
  return is_glass(material) ? mean_shares(clear_glass(material, untextured(material))).reflected
                            : mirror_reflectance(material);
}

/// The first material whose coat is like that of this one.
MaterialId first_with_coat_of(const Scene& scene, const Material& material) {
  const auto alike = std::ranges::find_if(scene.materials, [&](const Material& other) {
    return has_mirror_coat(other) && other.ior == material.ior &&
           other.specular == material.specular && other.specular_color == material.specular_color &&
           film_of(other) == film_of(material);
  });
  return static_cast<MaterialId>(alike - scene.materials.begin());
}

struct Candidate {
  Mirror mirror;
  std::set<NodeId> known_nodes; ///< those of the mirror: one of many tiles has as many
  std::vector<std::pair<SurfaceId, int>> faces; ///< surface, and 0 for its front, 1 for its back
  bool curved = false; ///< some of it reflects by a normal that turns: it has no one image
};

Plane flipped(const Plane& plane) { return {-plane.normal, -plane.offset}; }

void add_face(Candidate& candidate, const SurfaceModel& model, SurfaceId id, int face) {
  const Surface& surface = model.surfaces[index(id)];
  candidate.faces.emplace_back(id, face);
  candidate.mirror.area += surface.area;
  for (const PatchId patch_id : surface.patches) {
    const Patch& patch = model.patches[index(patch_id)];
    ConvexPolygon polygon(polygon_of(patch));
    if (face == 1)
      std::reverse(polygon.vertices.begin(),
                   polygon.vertices.begin() + static_cast<std::ptrdiff_t>(polygon.size));
    candidate.mirror.window.push_back(polygon);
    if (candidate.known_nodes.insert(patch.node).second)
      candidate.mirror.nodes.push_back(patch.node);
  }
}

/// Every mirror plane of the scene, in the order of its first surface.
std::vector<Candidate> mirror_planes(const Scene& scene, const SurfaceModel& model) {
  std::vector<Candidate> candidates;
  std::map<MirrorKey, std::size_t> known;
  std::vector<std::optional<Rgb>> reflectances(scene.materials.size());
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    const Material& material = scene.materials[index(surface.material)];
    const bool is_pane = is_glass(material) && !is_solid_glass(material);
    if (!is_mirror(material) && !is_pane && !has_mirror_coat(material))
      continue;
    std::optional<Rgb>& of_material = reflectances[index(surface.material)];
    if (!of_material)
      of_material = reflectance_of(material);
    const Rgb reflectance = *of_material;
    if (reflectance == Rgb(0.0))
      continue;
    const bool is_coat = has_mirror_coat(material);
    const MaterialId by_angle = is_coat              ? first_with_coat_of(scene, material)
                                : is_glass(material) ? surface.material
                                                     : none<MaterialId>;
    const bool has_width =
        widest_roughness(material) > ideal_mirror_roughness || material.normal_texture;
    const bool curved = std::ranges::any_of(surface.patches, [&](PatchId patch) {
      return is_curved(scene, model.patches[index(patch)]);
    });
    for (int face = 0; face < (material.double_sided ? 2 : 1); ++face) {
      const Plane plane = face == 0 ? surface.plane : flipped(surface.plane);
      const bool along =
          glm::dot(plane.normal, model.planes[index(surface.plane_class)].normal) > 0.0;
      const MirrorKey key{index(surface.plane_class),
                          along,
                          reflectance.r,
                          reflectance.g,
                          reflectance.b,
                          by_angle,
                          has_width,
                          curved};
      const auto [place, is_new] = known.emplace(key, candidates.size());
      if (is_new) {
        candidates.emplace_back();
        candidates.back().mirror.plane = plane;
        candidates.back().mirror.plane_class = surface.plane_class;
        candidates.back().mirror.reflectance = reflectance;
        candidates.back().mirror.by_angle = by_angle;
        candidates.back().mirror.is_coat = is_coat;
        candidates.back().mirror.has_width = has_width;
        candidates.back().curved = curved;
      }
      add_face(candidates[place->second], model, static_cast<SurfaceId>(s), face);
    }
  }
  return candidates;
}

} // namespace

MirrorSet find_mirrors(const Scene& scene, const SurfaceModel& surfaces,
                       const MirrorSettings& settings) {
  MirrorSet set;
  set.mirror_of_surface.assign(surfaces.surfaces.size(), {none<MirrorId>, none<MirrorId>});
  auto candidates = mirror_planes(scene, surfaces);

  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     return std::pair(b.mirror.is_coat, a.mirror.area) >
                            std::pair(a.mirror.is_coat, b.mirror.area);
                   });
  const double smallest_coat =
      min_coat_share *
      std::accumulate(surfaces.surfaces.begin(), surfaces.surfaces.end(), 0.0,
                      [](double sum, const Surface& surface) { return sum + surface.area; });
  double total_area = 0.0;
  std::size_t counted = 0;
  for (const auto& candidate : candidates)
    if (!candidate.mirror.is_coat && !candidate.curved) {
      total_area += candidate.mirror.area;
      ++counted;
    }
  const auto limit = static_cast<std::size_t>(settings.max_mirrors);
  const double least = counted > limit ? settings.smallest_share * total_area : 0.0;

  for (auto& candidate : candidates) {
    const bool is_facet = candidate.mirror.is_coat
                              ? candidate.mirror.area < smallest_coat
                              : set.mirrors.size() >= limit || candidate.mirror.area < least;
    if (is_facet || candidate.curved) {
      set.facets += candidate.faces.size();
      continue;
    }
    const auto id = static_cast<MirrorId>(set.mirrors.size());
    double tolerance = 0.0;
    for (const auto& [surface, face] : candidate.faces) {
      set.mirror_of_surface[index(surface)][static_cast<std::size_t>(face)] = id;
      tolerance = std::max(tolerance, surfaces.surfaces[index(surface)].tolerance);
    }
    // An outline that is off by so much moves no shadow that can be seen.
    constexpr double unseen = 3e-4; // of the root of the area
    candidate.mirror.window = merge_convex(std::move(candidate.mirror.window), tolerance,
                                           unseen * std::sqrt(candidate.mirror.area));
    set.mirrors.push_back(std::move(candidate.mirror));
  }
  return set;
}

} // namespace meninas
