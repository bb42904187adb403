#include "tests/scenes/soup.h"

#include <gtest/gtest.h>

#include <set>

namespace meninas::test {
namespace {

/// Sums of n areas in another order differ by n roundings at most.
double sum_tolerance(double sum, std::size_t terms) {
  return sum * double(terms + 4) * std::numeric_limits<double>::epsilon();
}

void expect_patches_of_surfaces(const Scene& scene, const SurfaceModel& model) {
  std::set<PatchId> seen;
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    EXPECT_NEAR(glm::length(surface.plane.normal), 1.0, 1e-12);
    double area = 0.0;
    for (const PatchId id : surface.patches) {
      const Patch& patch = model.patches[index(id)];
      EXPECT_TRUE(seen.insert(id).second);
      EXPECT_EQ(patch.surface, static_cast<SurfaceId>(s));
      EXPECT_EQ(patch.material, surface.material);
      area += patch.area;
      for (const TriangleId triangle : patch.triangles) {
        if (triangle == none<TriangleId>)
          continue;
        EXPECT_EQ(model.plane_of_triangle[index(triangle)], surface.plane_class);
        EXPECT_GT(glm::dot(area_vector(corners(scene, triangle)), surface.plane.normal), 0.0);
      }
      for (const Point3& corner : polygon_of(patch)) {
        // Rounding of the distance itself is part of the tolerance.
        EXPECT_LE(std::abs(signed_distance(surface.plane, corner)), model.tolerance);
        EXPECT_LE(std::abs(signed_distance(model.planes[index(surface.plane_class)], corner)),
                  model.tolerance);
      }
    }
    EXPECT_NEAR(area, surface.area, sum_tolerance(area, scene.triangles.size()));
  }
  EXPECT_EQ(seen.size(), model.patches.size());
}

} // namespace

void expect_consistent(const Scene& scene, const SurfaceModel& model) {
  ASSERT_EQ(model.patch_of_triangle.size(), scene.triangles.size());
  ASSERT_EQ(model.plane_of_triangle.size(), scene.triangles.size());
  ASSERT_EQ(model.corner_uv.size(), scene.triangles.size());
  double triangle_area = 0.0;
  std::vector<int> uses(scene.triangles.size(), 0);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto points = corners(scene, static_cast<TriangleId>(t));
    triangle_area += glm::length(area_vector(points));
    ASSERT_LT(index(model.patch_of_triangle[t]), model.patches.size());
    ASSERT_LT(index(model.plane_of_triangle[t]), model.planes.size());
    const Patch& patch = model.patches[index(model.patch_of_triangle[t])];
    EXPECT_EQ(patch.node, scene.triangles[t].node);
    for (std::size_t k = 0; k < 3; ++k) {
      // A vertex the exporter split may be the other copy of the patch's corner.
      EXPECT_LE(glm::distance(point_at(patch, model.corner_uv[t][k]), points[k]), model.tolerance);
    }
  }
  double patch_area = 0.0;
  for (const Patch& patch : model.patches) {
    patch_area += patch.area;
    for (const TriangleId triangle : patch.triangles) {
      if (triangle != none<TriangleId>)
        ++uses[index(triangle)];
    }
    EXPECT_EQ(patch.triangles[1] != none<TriangleId>, patch.corner_count == 4);
  }
  EXPECT_NEAR(patch_area, triangle_area, sum_tolerance(triangle_area, scene.triangles.size()));
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), std::ptrdiff_t(uses.size()));
  expect_patches_of_surfaces(scene, model);
}

} // namespace meninas::test
