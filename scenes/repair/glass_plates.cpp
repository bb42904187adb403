#include "scenes/repair/glass_plates.h"

#include "scenes/surfaces/disjoint_sets.h"
#include "scenes/materials/glass.h"
#include "scenes/surfaces/regions.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace meninas {
namespace {

constexpr double thinnest_share = 0.02;  ///< of the root of a face's area
constexpr double large_faces = 0.8;      ///< of a plate's surface
constexpr double covered = 0.9;          ///< of the face that something is behind
constexpr double faintest = 1.0 / 3.0;   ///< what a way through leaves
constexpr double mean_way = 1.1;         ///< in thicknesses
constexpr double parallel = 0.9999;      ///< cosine
constexpr std::size_t max_faces = 4096; ///< of a plate
constexpr std::uint32_t points_asked = 64;

struct Face {
  TriangleId triangle = none<TriangleId>;
  std::array<Point3, 3> corners{};
  TriangleShape shape;
};

/// Two large faces and the rest.
struct Plate {
  std::array<std::vector<Face>, 2> faces;
  std::array<Plane, 2> planes; ///< normals outwards
  std::vector<TriangleId> triangles;
  double area = 0.0; ///< of one face
  double thickness = 0.0;
};

Face face_of(const Scene& scene, TriangleId triangle) {
  const auto p = corners(scene, triangle);
  return {triangle, p, shape_of(p)};
}

/// The faces that look along a direction, if they lie in one plane.
std::optional<Plane> large_face(std::span<const Face> all, const Direction& normal,
                                double tolerance, std::vector<Face>& found, double& area) {
  for (const Face& face : all)
    if (glm::dot(face.shape.normal, normal) > parallel) {
      found.push_back(face);
      area += face.shape.area;
    }
  if (found.empty())
    return std::nullopt;
  const Plane plane{normal, glm::dot(normal, found.front().corners[0])};
  const bool is_flat = std::ranges::all_of(found, [&](const Face& face) {
    return std::ranges::all_of(face.corners, [&](const Point3& x) {
      return std::abs(signed_distance(plane, x)) <= tolerance;
    });
  });
  return is_flat ? std::optional(plane) : std::nullopt;
}

std::optional<Plate> plate_of(const Scene& scene, std::span<const TriangleId> triangles,
                              double tolerance) {
  if (triangles.size() > max_faces)
    return std::nullopt;
  Plate plate;
  plate.triangles.assign(triangles.begin(), triangles.end());
  std::vector<Face> all;
  double surface = 0.0;
  for (const TriangleId t : triangles) {
    all.push_back(face_of(scene, t));
    surface += all.back().shape.area;
  }
  const Direction normal =
      std::ranges::max_element(all, {}, [](const Face& f) { return f.shape.area; })->shape.normal;
  std::array<double, 2> areas{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto plane =
        large_face(all, k == 0 ? normal : -normal, tolerance, plate.faces[k], areas[k]);
    if (!plane)
      return std::nullopt;
    plate.planes[k] = *plane;
  }
  plate.area = std::min(areas[0], areas[1]);
  plate.thickness = plate.planes[0].offset + plate.planes[1].offset;
  const bool is_thin =
      plate.thickness > tolerance && plate.thickness <= thinnest_share * std::sqrt(plate.area);
  const bool is_plate = areas[0] + areas[1] >= large_faces * surface &&
                        std::abs(areas[0] - areas[1]) <= 0.1 * plate.area;
  return is_thin && is_plate ? std::optional(plate) : std::nullopt;
}

/// Whether a triangle holds the foot of a point.
bool is_over(const std::array<Point3, 3>& p, const Direction& normal, const Point3& x) {
  int left = 0;
  for (std::size_t k = 0; k < 3; ++k)
    left += glm::dot(normal, glm::cross(p[(k + 1) % 3] - p[k], x - p[k])) >= 0.0 ? 1 : 0;
  return left == 3;
}

/// The share of a plate's face that has something other than glass close before it.
double covered_share(std::span<const Face> face, const Plane& plane, double thickness,
                     double tolerance, std::span<const Face> opaque) {
  Bounds bounds;
  for (const Face& part : face)
    for (const Point3& x : part.corners) {
      bounds.low = glm::min(bounds.low, x - (thickness + tolerance));
      bounds.high = glm::max(bounds.high, x + (thickness + tolerance));
    }
  std::vector<const Face*> near;
  for (const Face& other : opaque) {
    const auto is_close = [&](const Point3& x) {
      const double height = signed_distance(plane, x);
      return height >= -tolerance && height <= thickness + tolerance;
    };
    const auto& p = other.corners;
    if (std::abs(glm::dot(other.shape.normal, plane.normal)) > parallel &&
        glm::all(glm::lessThanEqual(glm::min(p[0], glm::min(p[1], p[2])), bounds.high)) &&
        glm::all(glm::lessThanEqual(bounds.low, glm::max(p[0], glm::max(p[1], p[2])))) &&
        std::ranges::all_of(p, is_close))
      near.push_back(&other);
  }
  if (near.empty())
    return 0.0;
  double share = 0.0, area = 0.0;
  for (const Face& part : face) {
    std::uint32_t hits = 0;
    for (std::uint32_t k = 0; k < points_asked; ++k) {
      const glm::vec2 u = sobol2(k, 0, SobolPair::first);
      const double root = std::sqrt(double{u.x});
      const auto& p = part.corners;
      const Point3 x = p[0] + root * (1.0 - u.y) * (p[1] - p[0]) + root * u.y * (p[2] - p[0]);
      hits += std::ranges::any_of(near,
                                  [&](const Face* other) {
                                    return is_over(other->corners, other->shape.normal, x);
                                  })
                  ? 1
                  : 0;
    }
    share += part.shape.area * hits / points_asked;
    area += part.shape.area;
  }
  return area > 0.0 ? share / area : 0.0;
}

Material pane_of(const Material& solid, double thickness) {
  Material pane = solid;
  pane.base_color = solid.base_color * solid.base_color * attenuation(solid, mean_way * thickness);
  pane.thickness = 0.0;
  pane.thickness_texture.reset();
  pane.attenuation_distance = std::numeric_limits<double>::infinity();
  return pane;
}

bool stays_clear(const Material& solid, double thickness) {
  const Rgb left = attenuation(solid, thickness);
  return std::min({left.r, left.g, left.b}) >= faintest;
}

/// Bodies of solid glass: triangles that share corners.
std::map<std::uint32_t, std::vector<TriangleId>> solid_bodies(const Scene& scene) {
  std::map<std::uint32_t, std::vector<TriangleId>> bodies;
  const bool has_solids = std::ranges::any_of(scene.materials, is_solid_glass);
  if (!has_solids)
    return bodies;
  const Topology topology = find_topology(scene, Precision(scene));
  DisjointSets sets(scene.vertices.size());
  const auto welded = [&](VertexId v) { return index(topology.welded[index(v)]); };
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (is_solid_glass(material_of(scene, TriangleId{t})))
      for (const VertexId v : scene.triangles[t].vertices)
        sets.join(welded(v), welded(scene.triangles[t].vertices[0]));
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (is_solid_glass(material_of(scene, TriangleId{t})))
      bodies[sets.root(welded(scene.triangles[t].vertices[0]))].push_back(TriangleId{t});
  return bodies;
}

} // namespace

std::vector<NodeId> plates_to_panes(Scene& scene) {
  constexpr double close = 1e-5; // of the radius of the detail: as of things that touch
  const auto bodies = solid_bodies(scene);
  if (bodies.empty())
    return {};
  const Precision precision(scene);
  const double tolerance = std::max(close * precision.detail().radius, 8.0 * precision.in_detail());
  std::vector<Face> opaque;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (!is_glass(material_of(scene, TriangleId{t})))
      opaque.push_back(face_of(scene, TriangleId{t}));

  constexpr std::size_t max_plates = 256; // of which each looks at all faces
  std::size_t looked_at = 0;
  std::set<NodeId> nodes;
  std::set<TriangleId> gone;
  std::map<std::pair<MaterialId, double>, MaterialId> panes;
  for (const auto& [root, triangles] : bodies) {
    const auto plate = plate_of(scene, triangles, tolerance);
    if (!plate || ++looked_at > max_plates)
      continue;
    const Triangle& first = scene.triangles[index(triangles.front())];
    if (!stays_clear(scene.materials[index(first.material)], plate->thickness))
      continue;
    std::array<bool, 2> lies{};
    for (std::size_t k = 0; k < 2; ++k)
      lies[k] = covered_share(plate->faces[k], plate->planes[k], plate->thickness, tolerance,
                              opaque) >= covered;
    if (lies[0] == lies[1])
      continue;
    // One pane for all plates of one thickness, whatever rounding has made of it.
    const double steps = std::round(std::log(plate->thickness) * 1e3);
    const auto [pane, is_new] = panes.try_emplace({first.material, steps}, none<MaterialId>);
    if (is_new) {
      pane->second = static_cast<MaterialId>(scene.materials.size());
      scene.materials.push_back(pane_of(scene.materials[index(first.material)], plate->thickness));
    }
    gone.insert(plate->triangles.begin(), plate->triangles.end());
    for (const Face& face : plate->faces[lies[0] ? 1 : 0]) {
      gone.erase(face.triangle);
      scene.triangles[index(face.triangle)].material = pane->second;
    }
    nodes.insert(first.node);
  }
  std::uint32_t t = 0;
  std::erase_if(scene.triangles, [&](const Triangle&) { return gone.contains(TriangleId{t++}); });
  return {nodes.begin(), nodes.end()};
}

} // namespace meninas
