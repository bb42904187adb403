#include "scenes/surfaces/solid_bodies.h"

#include "scenes/surfaces/disjoint_sets.h"
#include "scenes/rays/frame_geometry.h"
#include "scenes/materials/lobes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>

namespace meninas {

namespace {

/// The triangles of each body, by their corners' places.
std::vector<std::vector<TriangleId>> bodies_of(const Scene& scene) {
  DisjointSets joined(scene.triangles.size());
  std::map<std::array<double, 3>, std::uint32_t> first_at;
  std::vector<TriangleId> solid;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (!is_solid_glass(material_of(scene, TriangleId{t})))
      continue;
    solid.push_back(TriangleId{t});
    for (const VertexId vertex : scene.triangles[t].vertices) {
      const Point3 p = position(scene, vertex);
      joined.join(first_at.try_emplace({p.x, p.y, p.z}, t).first->second, t);
    }
  }
  std::map<std::uint32_t, std::vector<TriangleId>> by_root;
  for (const TriangleId t : solid)
    by_root[joined.root(index(t))].push_back(t);
  std::vector<std::vector<TriangleId>> bodies;
  for (auto& [root, triangles] : by_root)
    bodies.push_back(std::move(triangles));
  return bodies;
}

SolidBody sphere_around(const Scene& scene, const RayFrame& frame,
                        const std::vector<TriangleId>& triangles) {
  const auto for_corners = [&](const auto& visit) {
    for (const TriangleId t : triangles)
      for (const VertexId vertex : scene.triangles[index(t)].vertices)
        visit(to_frame(frame, position(scene, vertex)));
  };
  Point3 low(std::numeric_limits<double>::infinity()), high = -low;
  for_corners([&](const Point3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  });
  SolidBody body{0.5 * (low + high), 0.0};
  for_corners(
      [&](const Point3& p) { body.radius = std::max(body.radius, glm::length(p - body.centre)); });
  return body;
}

struct Group {
  std::vector<TriangleId> triangles;
  SolidBody sphere;
};

/// Makes few of many: halves along the axis along which their middles lie furthest apart,
/// each of which becomes its share of `most`.
void unite(std::span<Group> groups, std::size_t most,
           std::vector<std::vector<TriangleId>>& united) {
  if (most == 1 || groups.size() <= 1) {
    united.emplace_back();
    for (const Group& group : groups)
      united.back().insert(united.back().end(), group.triangles.begin(), group.triangles.end());
    return;
  }
  Point3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Group& group : groups) {
    low = glm::min(low, group.sphere.centre);
    high = glm::max(high, group.sphere.centre);
  }
  const Vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::ranges::stable_sort(groups, {}, [&](const Group& g) { return g.sphere.centre[axis]; });
  const std::size_t half = groups.size() / 2;
  unite(groups.first(half), most / 2, united);
  unite(groups.subspan(half), most - most / 2, united);
}

} // namespace

SolidBodies find_solid_bodies(const Scene& scene, const RayFrame& frame) {
  SolidBodies solids;
  if (std::ranges::none_of(scene.materials, is_solid_glass))
    return solids;
  for (const Material& material : scene.materials) {
    MaterialPoint face = untextured(material);
    face.thickness = 0.0; // what it absorbs goes by the metres
    solids.faces.push_back(clear_glass(material, face));
  }
  std::vector<std::vector<TriangleId>> bodies = bodies_of(scene);
  if (bodies.size() > max_bodies) {
    std::vector<Group> groups;
    for (auto& triangles : bodies) {
      const SolidBody sphere = sphere_around(scene, frame, triangles);
      groups.push_back({std::move(triangles), sphere});
    }
    bodies.clear();
    unite(groups, max_bodies, bodies);
  }
  solids.body_of_triangle.assign(scene.triangles.size(), SolidBodies::no_body);
  for (const auto& triangles : bodies) {
    for (const TriangleId t : triangles)
      solids.body_of_triangle[index(t)] = static_cast<std::uint32_t>(solids.bodies.size());
    solids.bodies.push_back(sphere_around(scene, frame, triangles));
  }
  return solids;
}

} // namespace meninas
