#include "radiosity/field/curves/curved_vertices.h"

#include "radiosity/mesh/mesh_cells.h"
#include "radiosity/mesh/vertex_welder.h"
#include "scenes/rays/curved_origin.h"
#include "scenes/shading_normal.h"
#include "scenes/surfaces/curved_patches.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace meninas {

namespace {

struct TrianglePoint {
  TriangleId triangle = none<TriangleId>;
  Vec2 barycentric{0.0};
};

/// Weights of the second and third corner of the point nearest to x, about.
Vec2 barycentric_of(const std::array<Point3, 3>& p, const Point3& x) {
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], normal = glm::cross(e1, e2);
  const double squared = glm::dot(normal, normal);
  return Vec2(glm::dot(glm::cross(x - p[0], e2), normal),
              glm::dot(glm::cross(e1, x - p[0]), normal)) /
         squared;
}

/// The point on the triangle of a patch that holds it, or comes nearest to that.
TrianglePoint point_of_patch(const LightScene& light, PatchId patch, const Point3& x) {
  TrianglePoint best{light.surfaces.patches[index(patch)].triangles[0], Vec2(0.0)};
  double most = -std::numeric_limits<double>::infinity();
  for (const TriangleId triangle : light.surfaces.patches[index(patch)].triangles) {
    if (triangle == none<TriangleId>)
      continue;
    const Vec2 b = barycentric_of(corners(light.scene, triangle), x);
    const double least = std::min({b.x, b.y, 1.0 - b.x - b.y});
    if (least > most) {
      most = least;
      best = {triangle, b};
    }
  }
  const Vec2 inside = glm::max(best.barycentric, Vec2(0.0));
  best.barycentric = inside / std::max(1.0, inside.x + inside.y);
  return best;
}

bool is_curved(const LightScene& light, const MeshSide& side) {
  return is_curved(light.scene, light.surfaces.patches[index(side.patch)]);
}

const MeshSide& side_of_vertex(const ElementMesh& mesh, std::size_t v) {
  return mesh.sides[index(mesh.side_of_element[index(mesh.element_of_vertex[v])])];
}

Direction normal_at(const LightScene& light, const MeshSide& side, const Point3& x) {
  const TrianglePoint at = point_of_patch(light, side.patch, x);
  const Direction n = shading_normal(light.scene, at.triangle, at.barycentric);
  return side.facing == Facing::front ? n : -n;
}

/// Vertices of one place whose values are still apart.
using Places = std::vector<std::vector<std::size_t>>;

Places places_on_curves(const LightScene& light, const VertexSamples& found,
                        std::span<const std::uint8_t> valid) {
  const ElementMesh& mesh = found.mesh;
  VertexWelder welder(vertex_grain(mesh, light.surfaces));
  std::vector<Point3> known;
  Places places;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    // Where a wall stands on the curve its two sides are apart.
    if (valid[v] == 0 || found.states[v] == VertexState::smoothed || is_at_contact(mesh, v) ||
        !is_curved(light, side_of_vertex(mesh, v)))
      continue;
    const std::size_t place = index(welder.vertex_at(0, mesh.vertices[v], known));
    places.resize(known.size());
    places[place].push_back(v);
  }
  return places;
}

} // namespace

std::optional<Direction> given_normal(const LightScene& light, const MeshSide& side,
                                      const Point3& x) {
  const TrianglePoint at = point_of_patch(light, side.patch, x);
  for (const VertexId v : light.scene.triangles[index(at.triangle)].vertices)
    if (light.scene.vertices[index(v)].normal == glm::vec3(0.0F))
      return std::nullopt;
  return normal_at(light, side, x);
}

Receiver received_on_curve(const LightScene& light, const MeshSide& side, const Point3& vertex,
                           Receiver receiver) {
  if (!is_curved(light, side))
    return receiver;
  // Light is gathered a little inside the facet, by the normal at the vertex itself:
  // that of its neighbours.
  const TrianglePoint at = point_of_patch(light, side.patch, receiver.position);
  receiver.position = curved_origin(light.scene, light.surfaces, light.rays, at.triangle,
                                    at.barycentric, side.facing == Facing::front);
  receiver.normal = normal_at(light, side, vertex);
  receiver.plane_class = none<PlaneId>;
  return receiver;
}

bool is_one_curve(const Receiver& a, const Receiver& b) {
  static const double min_cosine = std::cos(same_normal_degrees * std::numbers::pi / 180.0);
  return a.coat == b.coat && !(glm::dot(a.normal, b.normal) < min_cosine);
}

void receive_on_curves(const LightScene& light, VertexSamples& found) {
  if (std::ranges::none_of(light.scene.triangles, &Triangle::curved))
    return;
  const ElementMesh& mesh = found.mesh;
  tbb::parallel_for(std::size_t{0}, mesh.vertices.size(), [&](std::size_t v) {
    found.receivers[v] =
        received_on_curve(light, side_of_vertex(mesh, v), mesh.vertices[v], found.receivers[v]);
  });
}

void join_on_curves(const LightScene& light, const VertexSamples& found,
                    std::span<const std::uint8_t> valid, VertexIrradiance& field) {
  if (std::ranges::none_of(light.scene.triangles, &Triangle::curved))
    return;
  for (const std::vector<std::size_t>& vertices : places_on_curves(light, found, valid)) {
    if (vertices.size() < 2)
      continue;
    const VertexIrradiance& own = found.field;
    for (const std::size_t v : vertices) {
      std::size_t count = 0;
      std::array<glm::vec3, 4> sum{};
      for (const std::size_t other : vertices) {
        if (!is_one_curve(found.receivers[v], found.receivers[other]))
          continue;
        ++count;
        sum[0] += own.irradiance[other];
        sum[1] += own.mirrored[other];
        sum[2] += own.indirect[other];
        sum[3] += own.indirect_mirrored[other];
      }
      const float share = 1.0F / static_cast<float>(count);
      field.irradiance[v] = share * sum[0];
      field.mirrored[v] = share * sum[1];
      field.indirect[v] = share * sum[2];
      field.indirect_mirrored[v] = share * sum[3];
    }
  }
}

} // namespace meninas
