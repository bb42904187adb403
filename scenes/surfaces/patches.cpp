#include "scenes/surfaces/patches.h"

#include "scenes/surfaces/patch_pairs.h"
#include "scenes/surfaces/precision.h"
#include "scenes/surfaces/regions.h"
#include "scenes/surfaces/topology.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

constexpr std::array<Vec2, 4> quad_uv{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0),
                                      Vec2(0.0, 1.0)};
constexpr std::array<Vec2, 3> triangle_uv{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0)};

/// A parallelogram to 1e-9 of its size, or to the tolerance where that is still far below its size.
bool is_parallelogram(const std::array<Point3, 4>& p, double tolerance) {
  const double size = std::min(glm::distance(p[0], p[1]) + glm::distance(p[2], p[3]),
                               glm::distance(p[1], p[2]) + glm::distance(p[3], p[0]));
  const double allowed = std::max(1e-9 * size, std::min(tolerance, 1e-5 * size));
  return glm::length((p[0] - p[1]) + (p[2] - p[3])) <= allowed;
}

class PatchMaker {
public:
  PatchMaker(const Scene& scene, const std::vector<TriangleShape>& shapes, SurfaceModel& model)
      : scene_(scene), shapes_(shapes), model_(model) {}

  void add_quad(const QuadPair& pair) {
    Patch patch;
    patch.corner_count = 4;
    patch.vertices = pair.vertices;
    patch.triangles = {pair.first, pair.second};
    for (std::size_t k = 0; k < 4; ++k) {
      patch.corners[k] = position(scene_, pair.vertices[k]);
    }
    patch.affine = is_parallelogram(patch.corners, model_.tolerance);
    for (const TriangleId triangle : patch.triangles) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        model_.corner_uv[index(triangle)][corner] = quad_uv[quad_corner(patch, triangle, corner)];
      }
    }
    add(patch, pair.first);
  }

  void add_triangle(TriangleId triangle) {
    Patch patch;
    const auto& vertices = scene_.triangles[index(triangle)].vertices;
    const auto points = corners(scene_, triangle);
    std::copy(points.begin(), points.end(), patch.corners.begin());
    std::copy(vertices.begin(), vertices.end(), patch.vertices.begin());
    patch.vertices[3] = none<VertexId>;
    patch.triangles[0] = triangle;
    model_.corner_uv[index(triangle)] = triangle_uv;
    add(patch, triangle);
  }

private:
  /// The corner of the quad that stands where a corner of one of its triangles stands: the nearest
  /// one.
  std::size_t quad_corner(const Patch& patch, TriangleId triangle, std::size_t corner) const {
    const Point3& here = position(scene_, scene_.triangles[index(triangle)].vertices[corner]);
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < 4; ++k) {
      if (glm::distance(here, patch.corners[k]) < glm::distance(here, patch.corners[nearest])) {
        nearest = k;
      }
    }
    return nearest;
  }

  void add(Patch& patch, TriangleId first) {
    const auto id = static_cast<PatchId>(model_.patches.size());
    patch.node = scene_.triangles[index(first)].node;
    patch.material = scene_.triangles[index(first)].material;
    for (const TriangleId triangle : patch.triangles) {
      if (triangle != none<TriangleId>) {
        patch.area += shapes_[index(triangle)].area;
        model_.patch_of_triangle[index(triangle)] = id;
      }
    }
    model_.patches.push_back(patch);
  }

  const Scene& scene_;
  const std::vector<TriangleShape>& shapes_;
  SurfaceModel& model_;
};

/// Patches in the order of their first triangles.
void add_patches(const Scene& scene, const std::vector<TriangleShape>& shapes,
                 const std::vector<QuadPair>& pairs, SurfaceModel& model) {
  PatchMaker maker(scene, shapes, model);
  model.patches.reserve(scene.triangles.size() - pairs.size());
  std::size_t next_pair = 0;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto triangle = static_cast<TriangleId>(t);
    if (next_pair < pairs.size() && pairs[next_pair].first == triangle) {
      maker.add_quad(pairs[next_pair++]);
    } else if (model.patch_of_triangle[t] == none<PatchId>) {
      maker.add_triangle(triangle);
    }
  }
}

void add_surfaces(const Scene& scene, const Regions& regions, SurfaceModel& model) {
  model.surfaces.resize(regions.regions.size());
  tbb::parallel_for(std::size_t{0}, model.surfaces.size(), [&](std::size_t r) {
    const Region& region = regions.regions[r];
    const auto triangles = triangles_of(regions, region);
    Surface& surface = model.surfaces[r];
    surface.plane = region.plane;
    surface.tolerance = region.tolerance;
    surface.material = scene.triangles[index(triangles.front())].material;
    surface.area = region.area;
    for (const TriangleId triangle : triangles) {
      const PatchId id = model.patch_of_triangle[index(triangle)];
      Patch& patch = model.patches[index(id)];
      if (patch.triangles[0] == triangle) {
        patch.surface = static_cast<SurfaceId>(r);
        surface.patches.push_back(id);
      }
    }
  });
}

} // namespace

SurfaceModel find_patches(const Scene& scene) {
  SurfaceModel model;
  const std::size_t count = scene.triangles.size();
  if (count == 0) {
    return model;
  }
  const Precision precision(scene);
  model.detail = precision.detail();
  model.tolerance = precision.in_detail();
  model.patch_of_triangle.assign(count, none<PatchId>);
  model.plane_of_triangle.assign(count, none<PlaneId>);
  model.corner_uv.resize(count);

  std::vector<TriangleShape> shapes(count);
  std::vector<double> tolerances(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    shapes[t] = shape_of(corners(scene, static_cast<TriangleId>(t)));
    tolerances[t] = precision.of(static_cast<TriangleId>(t));
  });
  const Topology topology = find_topology(scene, precision);
  const Regions regions = grow_regions(scene, shapes, topology, tolerances);
  add_patches(scene, shapes, pair_triangles(scene, regions, topology), model);
  add_surfaces(scene, regions, model);
  return model;
}

} // namespace meninas
