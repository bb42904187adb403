// The scene: what is there, in world space, as plain values. Filled by load_gltf or by hand.
//
// Triangles are counter-clockwise seen from the front.
// Degenerate triangles (no area at the precision of their vertices) are not in the list,
// only counted. References between objects are indices, never pointers.
#pragma once

#include "scenes/camera.h"
#include "scenes/material.h"
#include "scenes/sky/environment.h"
#include "scenes/types.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace meninas {

/// Attributes of a vertex that do not depend on where its node puts it: copies of a mesh share them.
struct VertexAttributes {
  std::array<glm::vec2, 2> texcoord{}; ///< TEXCOORD_0 and TEXCOORD_1
  glm::vec4 color{1.0F};               ///< COLOR_0: a factor of base colour and alpha, linear

  bool operator==(const VertexAttributes&) const = default;
};

struct Vertex {
  Point3 position{0.0};
  glm::vec3 normal{0.0F};                       ///< NORMAL, of unit length; zero: that of the face
  AttributesId attributes = none<AttributesId>; ///< in Scene::attributes; none: VertexAttributes{}
};

struct Triangle {
  std::array<VertexId, 3> vertices{};
  MaterialId material = none<MaterialId>;
  NodeId node = none<NodeId>;
  bool curved = false; ///< its vertices' normals are not that of its plane (shading_normal.h)
};

/// A glTF node that carries a mesh; its name is how a user asks for it. Unnamed nodes are `node12`.
struct Node {
  std::string name;
  std::string lamp = {}; ///< its `extras.lamp`: the lamp that it is part of (lamps.h)
};

/// What an image is beyond its edge:
/// its last texel, itself again, or its mirror image and then itself.
enum class Wrap { clamp, repeat, mirrored };

/// What is between the texels of an image that is magnified.
enum class TexelFilter { linear, nearest };

/// An encoded image, kept as the bytes of its file; decoded where it is used.
struct Texture {
  std::string name; ///< of the image or its file, for messages
  std::vector<std::byte> encoded;
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  TexelFilter magnified = TexelFilter::linear;
};

enum class PunctualKind { point, spot, directional };

struct IntensityDistribution;

/// KHR_lights_punctual and EXT_lights_ies.
/// Intensity is W/sr for point and spot, irradiance W/m^2 for directional lights.
struct PunctualLight {
  std::string name;
  PunctualKind kind = PunctualKind::point;
  Rgb intensity{1.0};
  Point3 position{0.0};
  Direction direction{0.0, 0.0, -1.0};
  double inner_cone = 0.0; ///< radians
  double outer_cone = 0.785398163397448;
  /// Of a point light: I(d) = intensity g(d) (ies/intensity_distribution.h); null: the same everywhere.
  std::shared_ptr<const IntensityDistribution> distribution = nullptr;
  glm::dmat3 frame{1.0}; ///< columns: the axes, of unit length, that the distribution is told in
  std::string lamp = {}; ///< as of Node
  Rgb foot_reflectance{0.0}; ///< rho of the diffuse face in whose plane a point light was (repair/touching.h)
};

/// EXT_lights_area (area_light.h).
struct AreaLight {
  std::string name;
  std::vector<Point3> corners; ///< of a convex polygon, counter-clockwise seen from where it shines
  Direction axis{0.0, 0.0, -1.0}; ///< of its plane, the way that it shines
  Rgb radiance{0.0};
  std::string lamp = {}; ///< as of Node
};

struct Scene {
  std::string file; ///< as the user named it, for messages
  std::vector<Vertex> vertices;
  std::vector<VertexAttributes> attributes;
  std::vector<Triangle> triangles;
  std::vector<Material> materials;
  std::vector<Node> nodes;
  std::vector<Camera> cameras;
  std::vector<PunctualLight> lights;
  std::vector<Texture> textures;
  Environment background; ///< radiance of everything beyond the scene, by direction
  std::vector<std::string>
      warnings; ///< what was read in a way the user may not expect, one line each
  std::vector<std::string> variants; ///< names of KHR_materials_variants that the file has
  std::vector<std::string> ignored; ///< names of extensions and features that were left out
  std::size_t degenerate_triangles = 0;

  /// Bound on the rounding error of the positions, in metres:
  /// floats in the file, moved by the node matrices.
  /// Geometry is only distinguished above it (coplanar, coincident, degenerate).
  double position_error = 0.0;
  std::vector<float> position_errors; ///< the same by vertex; what has none has that of all

  /// T and the sign of B (materials/normal_map.h), by vertex of what is anisotropic or has a normal
  /// map; what has none, or zero, has those of its triangle.
  std::vector<glm::vec4> tangents;

  std::vector<AreaLight> area_lights;
};

inline const Point3& position(const Scene& scene, VertexId vertex) {
  return scene.vertices[index(vertex)].position;
}

inline const VertexAttributes no_attributes{};

inline const VertexAttributes& attributes_of(const Scene& scene, const Vertex& vertex) {
  return vertex.attributes == none<AttributesId> ? no_attributes
                                                 : scene.attributes[index(vertex.attributes)];
}
inline const VertexAttributes& attributes_of(const Scene& scene, VertexId vertex) {
  return attributes_of(scene, scene.vertices[index(vertex)]);
}

/// Gives a vertex of the scene attributes that it shares with no other, equal to those that it had.
VertexAttributes& own_attributes(Scene& scene, Vertex& vertex);

inline const Material& material_of(const Scene& scene, TriangleId triangle) {
  return scene.materials[index(scene.triangles[index(triangle)].material)];
}

std::array<Point3, 3> corners(const Scene& scene, TriangleId triangle);

/// Half the cross product of two edges: its length is the area, its direction the front.
Vec3 area_vector(const std::array<Point3, 3>& corners);

Bounds bounds_of(const Scene& scene);

/// A hash of all that light depends on (geometry,
/// materials, textures, lights), not of cameras and names.
/// A solution carries it, so that it can be refused when it belongs to another scene.
std::uint64_t content_hash(const Scene& scene);

/// The node of that name; throws UsageError with the nearest known name as a hint.
NodeId find_node(const Scene& scene, const std::string& name);
const Camera& find_camera(const Scene& scene, const std::string& name);

} // namespace meninas
