#include "tests/support/globes.h"

#include "scenes/shading_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {

static Point3 point_of(const Globe& globe, int meridian, int parallel) {
  const double longitude = 2.0 * std::numbers::pi * (meridian % globe.meridians) / globe.meridians,
               colatitude = std::numbers::pi * parallel / globe.parallels;
  const double across = parallel % globe.parallels == 0 ? 0.0 : std::sin(colatitude);
  return globe.centre + globe.radius * Vec3(across * std::cos(longitude), std::cos(colatitude),
                                            across * std::sin(longitude));
}

/// Gives the triangles from the first on their normals.
static void add_normals(Scene& scene, std::size_t first_triangle, const Globe& globe,
                        GivenNormals normals) {
  for (std::size_t t = first_triangle; t < scene.triangles.size(); ++t) {
    const TriangleId triangle{static_cast<std::uint32_t>(t)};
    const Vec3 face = glm::normalize(area_vector(corners(scene, triangle)));
    for (const VertexId v : scene.triangles[t].vertices) {
      Vertex& vertex = scene.vertices[index(v)];
      const Vec3 out = glm::normalize(vertex.position - globe.centre);
      vertex.normal =
          glm::vec3(normals == GivenNormals::flat ? face : (globe.hollow ? -out : out));
    }
  }
  for (std::size_t t = first_triangle; t < scene.triangles.size(); ++t)
    mark_curved(scene, TriangleId{static_cast<std::uint32_t>(t)});
}

void add_globe(Scene& scene, const std::string& name, const Globe& globe, const Material& material,
               GivenNormals normals) {
  const std::size_t first = scene.triangles.size();
  for (int m = 0; m < globe.meridians; ++m)
    for (int p = 0; p < globe.parallels; ++p) {
      std::vector<Point3> facet{point_of(globe, m, p), point_of(globe, m + 1, p),
                                point_of(globe, m + 1, p + 1), point_of(globe, m, p + 1)};
      if (p == 0)
        facet.erase(facet.begin());
      if (p + 1 == globe.parallels)
        facet.erase(facet.begin() + 2);
      if (globe.hollow)
        std::ranges::reverse(facet);
      add_polygon(scene, name, facet, material);
    }
  if (normals != GivenNormals::none)
    add_normals(scene, first, globe, normals);
}

} // namespace meninas::test
