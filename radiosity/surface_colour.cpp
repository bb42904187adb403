#include "radiosity/surface_colour.h"

#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double points_per_element = 64.0;
constexpr double fewest_points = 256.0, most_points = 1 << 26;

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
  }
};

/// Over points by the elements of one side, which stand in a row, and over all of them.
struct ColourSums {
  std::vector<ColourSum> of_element;
  ColourSum all;
};

/// Points spread evenly over a triangle of the side, as many as its share of the side's elements asks for.
void add_triangle(const Scene& scene, const SurfaceModel& surfaces, const DecodedTextures& textures,
                  const ElementMesh& mesh, SideId id, TriangleId triangle, ColourSums& sums) {
  const MeshSide& side = mesh.sides[index(id)];
  const double share =
      glm::length(area_vector(corners(scene, triangle))) / surfaces.patches[index(side.patch)].area;
  const auto count = static_cast<std::uint32_t>(
      std::clamp(points_per_element * share * side.element_count, fewest_points, most_points));
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto sample = sobol4(k, hash(index(triangle), 0x7e47));
    const double root = std::sqrt(double{sample[0]});
    const Vec2 barycentric(root * (1.0 - double{sample[1]}), root * double{sample[1]});
    const ElementId element = locate(mesh, id, patch_uv(surfaces, triangle, barycentric)).element;
    const SurfaceColour colour = surface_colour(scene, textures, triangle, barycentric);
    sums.of_element[index(element) - side.first_element].add(colour);
    sums.all.add(colour);
  }
}

void average_side(const Scene& scene, const SurfaceModel& surfaces, const DecodedTextures& textures,
                  SideId id, ElementMesh& mesh) {
  const MeshSide& side = mesh.sides[index(id)];
  ColourSums sums{std::vector<ColourSum>(side.element_count), {}};
  for (const TriangleId triangle : surfaces.patches[index(side.patch)].triangles)
    if (triangle != none<TriangleId>)
      add_triangle(scene, surfaces, textures, mesh, id, triangle, sums);

  // An element too thin for any point takes the mean of its side; what is cut out all over has no colour.
  for (std::size_t k = 0; k < side.element_count; ++k) {
    const ColourSum& sum = sums.of_element[k].points > 0.0 ? sums.of_element[k] : sums.all;
    const std::size_t e = side.first_element + k;
    const double solid = std::max(sum.solid, 1.0);
    mesh.reflectance[e] = sum.colour.reflectance / solid;
    mesh.emission[e] = sum.colour.emission / solid;
    mesh.solid[e] = static_cast<float>(sum.solid / sum.points);
  }
}

} // namespace

SurfaceColour surface_colour(const Scene& scene, const DecodedTextures& textures,
                             TriangleId triangle, Vec2 barycentric, const Footprint& footprint) {
  const MaterialPoint point = material_at(scene, textures, triangle, barycentric, footprint);
  const Material& material = material_of(scene, triangle);
  return {diffuse_reflectance(material, point), std::numbers::pi * point.emission,
          is_cut_out(material, point)};
}

Bsdf glass_at(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
              Vec2 barycentric) {
  return clear_glass(material_of(scene, triangle),
                     material_at(scene, textures, triangle, barycentric));
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
