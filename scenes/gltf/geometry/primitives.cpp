#include "scenes/gltf/geometry/primitives.h"

#include "scenes/gltf/accessors.h"
#include "scenes/gltf/geometry/instances.h"

#include <fmt/format.h>

#include <set>

namespace meninas::gltf {

std::string primitive_place(const Json& root, std::size_t mesh, std::size_t number) {
  return fmt::format("{}, primitive {}", place(root, "meshes", mesh), number);
}

std::string PrimitivePlace::where() const {
  return primitive_place(document.root, in.mesh, number);
}

void PrimitivePlace::fail(const std::string& what) const {
  throw InputError(document.file, where(), what);
}

MeshPlace mesh_place(const Document& document, std::size_t node, std::size_t mesh) {
  const auto& json = element(document.root, "nodes", node);
  const auto name = name_of(json);
  auto weights = numbers_at(json, "weights");
  if (weights.empty())
    weights = numbers_at(element(document.root, "meshes", mesh), "weights");
  return {document, mesh, name.empty() ? fmt::format("node{}", node) : name, std::move(weights)};
}

Mode mode_of(const PrimitivePlace& at) {
  const auto mode = size_or(at.json, "mode", 4);
  if (mode > 6)
    at.fail(fmt::format("mode {} does not exist", mode));
  return static_cast<Mode>(mode);
}

std::optional<std::size_t> position_accessor(const PrimitivePlace& at) {
  return index_at(at.json["attributes"], "POSITION");
}

/// Of what reflects at all.
static const Json* lit_material(const PrimitivePlace& at) {
  const auto material = index_at(at.json, "material");
  if (!material)
    return nullptr;
  const Json& json = element(at.document.root, "materials", *material);
  return find(json, {"extensions", "KHR_materials_unlit"}) ? nullptr : &json;
}

static const Json* anisotropy_of(const Json& material) {
  const auto* extension = find(material, {"extensions", "KHR_materials_anisotropy"});
  return extension && number_or(*extension, "anisotropyStrength", 0.0) > 0.0 ? extension : nullptr;
}

bool is_anisotropic(const PrimitivePlace& at) {
  const Json* material = lit_material(at);
  return material && anisotropy_of(*material);
}

std::optional<TextureUse> tangent_map_of(const PrimitivePlace& at) {
  const Json* material = lit_material(at);
  if (!material)
    return std::nullopt;
  Findings said_with_the_material;
  const auto read = [&](const Json& owner, std::string_view key) {
    return read_texture_use(at.document, owner, key, "", said_with_the_material);
  };
  if (auto map = read(*material, "normalTexture"))
    return map;
  const Json* anisotropy = anisotropy_of(*material);
  if (!anisotropy)
    return std::nullopt;
  TextureUse plain;
  if (const auto directions = read(*anisotropy, "anisotropyTexture"))
    plain.texcoord_set = directions->texcoord_set;
  return plain;
}

std::size_t triangles_in(Mode mode, std::uint64_t corners) {
  if (corners < 3)
    return 0;
  return mode == Mode::triangles ? corners / 3 : corners - 2;
}

/// Bytes a vertex takes while its targets and joints are decoded.
static double deformation_bytes(const PrimitivePlace& at, bool is_skinned) {
  const auto* targets = find(at.json, "targets");
  return sizeof(double) *
         (3.0 * static_cast<double>(targets ? targets->size() : 0) + (is_skinned ? 8.0 : 0.0));
}

namespace {

/// Bytes that tangents take: by vertex, and while they are made, by triangle.
struct TangentNeeds {
  double per_vertex = 0.0, per_triangle = 0.0;
};
TangentNeeds tangent_needs(const PrimitivePlace& at) {
  if (!tangent_map_of(at))
    return {};
  const bool are_made = !at.json["attributes"].contains("TANGENT");
  return {sizeof(glm::vec4) + 4.0 * sizeof(double), are_made ? 256.0 : 0.0};
}

} // namespace

// Of each copy of a mesh, and of what its copies share.
constexpr double bytes_per_vertex =
    sizeof(Vertex) + 2 * sizeof(Point3) + 4 * sizeof(double) + sizeof(VertexId);
constexpr double shared_bytes = 2 * sizeof(VertexAttributes) + 2 * sizeof(AttributesId);

static GeometrySize size_of(const PrimitivePlace& at, double copies, bool is_skinned) {
  constexpr double per_corner = sizeof(std::uint32_t);
  constexpr double per_triangle = sizeof(Triangle) + 3 * sizeof(std::uint32_t);
  const auto mode = mode_of(at);
  const auto accessor = mode < Mode::triangles ? std::nullopt : position_accessor(at);
  if (!accessor)
    return {};
  const auto count = accessor_count(at.document, *accessor);
  const auto indices = index_at(at.json, "indices");
  const auto corners = indices ? accessor_count(at.document, *indices) : count;
  const auto triangles = static_cast<double>(triangles_in(mode, corners));
  const TangentNeeds tangents = tangent_needs(at);
  return {(copies * (bytes_per_vertex + tangents.per_vertex) + shared_bytes +
           deformation_bytes(at, is_skinned)) *
                  static_cast<double>(count) +
              per_corner * static_cast<double>(corners) +
              (copies * per_triangle + tangents.per_triangle) * triangles,
          copies * static_cast<double>(count)};
}

GeometrySize geometry_size(const Document& document, std::span<const PlacedNode> nodes) {
  // Primitives with their attributes;
  // each takes a fraction of a microsecond to look at, also where nothing of it is seen.
  constexpr std::size_t max_looks = 50000000;
  std::size_t looks = 0;
  GeometrySize all;
  std::set<std::size_t> skins;
  for (const auto& node : nodes) {
    const auto& json = element(document.root, "nodes", node.index);
    const auto mesh = index_at(json, "mesh");
    if (!mesh)
      continue;
    const auto skin = index_at(json, "skin");
    if (skin && skins.insert(*skin).second)
      all.bytes += sizeof(glm::dmat4) *
                   static_cast<double>(element(document.root, "skins", *skin)["joints"].size());
    const auto copies = static_cast<double>(instance_count(document, node.index));
    all.bytes += sizeof(glm::dmat4) * copies;
    each_primitive(mesh_place(document, node.index, *mesh), [&](const PrimitivePlace& at) {
      looks += 1 + at.json["attributes"].size();
      if (looks > max_looks)
        throw OutputError(document.file, place(document.root, "nodes", node.index),
                          fmt::format("up to here the nodes' meshes have over {} primitives and "
                                      "attributes, more than are read",
                                      max_looks));
      const auto needs = size_of(at, copies, skin.has_value());
      all.bytes += needs.bytes;
      all.vertices += needs.vertices;
    });
  }
  check_size(document, all);
  return all;
}

void check_size(const Document& document, const GeometrySize& size) {
  const auto limit = static_cast<double>(document.settings.memory_limit);
  if (size.bytes > limit || size.vertices >= static_cast<double>(index(none<VertexId>)))
    throw OutputError(document.file, "geometry",
                      fmt::format("needs about {:.0f} MiB, the memory limit is {:.0f} MiB",
                                  size.bytes / (1 << 20), limit / (1 << 20)));
}

GeometrySize size_of_vertices(double copies, double vertices) {
  return {(copies * (bytes_per_vertex + sizeof(glm::vec4)) + shared_bytes) * vertices,
          copies * vertices};
}

} // namespace meninas::gltf
