#include "radiosity/scene/surface_colour.h"

#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// Points of an element, and of a triangle at least. Where there are very many, so that a scene
/// would take more than `all_points`, they have fewer, down to `min_points`: each is a small part
/// of what others see of them together.
constexpr double points_per_element = 64.0, points_per_triangle = 256.0, min_points = 16.0;
constexpr double all_points = 1 << 21, max_points = 1 << 26;

double points_for_each_of(std::size_t count, double wanted) {
  return std::clamp(all_points / double(std::max<std::size_t>(1, count)), min_points, wanted);
}

struct ColourSum {
  SurfaceColour colour;
  double solid = 0.0, points = 0.0;

  void add(const SurfaceColour& point) {
    points += 1.0;
    if (point.hole)
      return;
    solid += 1.0;
    colour.reflectance += point.reflectance;
    colour.emission += point.emission;
    colour.transmittance += point.transmittance;
  }
};

/// The glass of points of one material: its shares of the surface, and tints by these.
struct GlassSum {
  Rgb metal{0.0}, tint{0.0};
  double glass = 0.0, points = 0.0;

  void add(const Bsdf& clear) {
    points += 1.0;
    metal += clear.metal;
    glass += clear.glass;
    tint += clear.glass * clear.pane.tint;
  }
  /// The share of light from everywhere that it passes on.
  Rgb passed_on(Bsdf like) const {
    like.metal = metal / points;
    like.glass = glass / points;
    like.pane.tint = glass > 0.0 ? tint / glass : Rgb(0.0);
    const GlassShares mean = mean_shares(like);
    return mean.reflected + mean.passed;
  }
};

/// Points spread evenly over the triangles of a side,
/// as many as its share of the side's elements asks for;
/// `at(k, triangle, barycentric)` with the place k of their element among those of the side.
template <typename At>
void for_points_of(const Scene& scene, const SurfaceModel& surfaces, const ElementMesh& mesh,
                   SideId id, At&& at) {
  const MeshSide& side = mesh.sides[index(id)];
  const Patch& patch = surfaces.patches[index(side.patch)];
  const double per_element = points_for_each_of(element_count(mesh), points_per_element);
  const double fewest = points_for_each_of(scene.triangles.size(), points_per_triangle);
  for (const TriangleId triangle : patch.triangles) {
    if (triangle == none<TriangleId>)
      continue;
    const double share = glm::length(area_vector(corners(scene, triangle))) / patch.area;
    const auto count = static_cast<std::uint32_t>(
        std::clamp(per_element * share * side.element_count, fewest, max_points));
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto sample = sobol4(k, hash(index(triangle), 0x7e47));
      const double root = std::sqrt(double{sample[0]});
      const Vec2 barycentric(root * (1.0 - double{sample[1]}), root * double{sample[1]});
      const ElementId element = locate(mesh, id, patch_uv(surfaces, triangle, barycentric)).element;
      at(index(element) - side.first_element, triangle, barycentric);
    }
  }
}

void average_side(const Scene& scene, const SurfaceModel& surfaces, const DecodedTextures& textures,
                  SideId id, ElementMesh& mesh) {
  const MeshSide& side = mesh.sides[index(id)];
  std::vector<ColourSum> of_element(side.element_count);
  ColourSum all;
  for_points_of(
      scene, surfaces, mesh, id, [&](std::size_t k, TriangleId triangle, Vec2 barycentric) {
        const SurfaceColour colour = surface_colour(scene, textures, triangle, barycentric);
        of_element[k].add(colour);
        all.add(colour);
      });

  // An element too thin for any point takes the mean of its side;
  // what is cut out all over has no colour.
  for (std::size_t k = 0; k < side.element_count; ++k) {
    const ColourSum& sum = of_element[k].points > 0.0 ? of_element[k] : all;
    const std::size_t e = side.first_element + k;
    const double solid = std::max(sum.solid, 1.0);
    mesh.reflectance[e] = sum.colour.reflectance / solid;
    mesh.emission[e] = sum.colour.emission / solid;
    if (!mesh.transmittance.empty())
      mesh.transmittance[e] = sum.colour.transmittance / solid;
    mesh.solid[e] = static_cast<float>(sum.solid / sum.points);
  }
}

} // namespace

SurfaceColour surface_colour(const Scene& scene, const DecodedTextures& textures,
                             TriangleId triangle, Vec2 barycentric, const Footprint& footprint) {
  const MaterialPoint point = material_at(scene, textures, triangle, barycentric, footprint);
  const Material& material = material_of(scene, triangle);
  return {diffuse_reflectance(material, point), std::numbers::pi * point.emission,
          is_translucent(material) ? diffuse_transmittance(material, point) : Rgb(0.0),
          is_cut_out(material, point)};
}

Bsdf glass_at(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
              Vec2 barycentric) {
  return clear_glass(material_of(scene, triangle),
                     material_at(scene, textures, triangle, barycentric));
}

std::vector<Rgb> passed_on_by_glass(const Scene& scene, const SurfaceModel& surfaces,
                                    const DecodedTextures& textures, const ElementMesh& mesh,
                                    SideId side) {
  const Material& material = scene.materials[index(mesh.sides[index(side)].material)];
  std::vector<GlassSum> of_element(mesh.sides[index(side)].element_count);
  GlassSum all;
  for_points_of(scene, surfaces, mesh, side,
                [&](std::size_t k, TriangleId triangle, Vec2 barycentric) {
                  const Bsdf clear = glass_at(scene, textures, triangle, barycentric);
                  of_element[k].add(clear);
                  all.add(clear);
                });
  const Bsdf like = clear_glass(material, untextured(material));
  std::vector<Rgb> means;
  for (const GlassSum& sum : of_element)
    means.push_back((sum.points > 0.0 ? sum : all).passed_on(like));
  return means;
}

Holes holes_of(const Scene& scene, const DecodedTextures& textures) {
  return [&](TriangleId triangle, Vec2 barycentric) {
    return is_cut_out(material_of(scene, triangle),
                      material_at(scene, textures, triangle, barycentric));
  };
}

void average_textures(const Scene& scene, const SurfaceModel& surfaces,
                      const DecodedTextures& textures, ElementMesh& mesh) {
  tbb::parallel_for(std::size_t{0}, mesh.sides.size(), [&](std::size_t s) {
    if (mesh.sides[s].textured)
      average_side(scene, surfaces, textures, static_cast<SideId>(s), mesh);
  });
}

} // namespace meninas
