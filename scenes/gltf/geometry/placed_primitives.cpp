#include "scenes/gltf/geometry/placed_primitives.h"

#include "scenes/gltf/geometry/deformation.h"
#include "scenes/gltf/geometry/instances.h"

#include <glm/gtc/matrix_inverse.hpp>

namespace meninas::gltf {

namespace {

/// A primitive of a node, before it is put into the world.
std::optional<PlacedPrimitive> read_primitive(const PrimitivePlace& at) {
  const Mode mode = mode_of(at);
  const auto accessor = position_accessor(at);
  if (mode < Mode::triangles || !accessor)
    return std::nullopt;
  PlacedPrimitive read{.mesh = at.in.mesh, .number = at.number, .copy = {}, .positions = {}, .triangles = {}};
  read.positions = decode_positions(at, *accessor);
  if (const auto* targets = find(at.json, "targets"); targets && !targets->empty())
    apply_morph_targets({at.document, at.where(), at.json, at.in.morph_weights}, "POSITION",
                        read.positions);
  read.triangles = triangulate(mode, decode_corners(at, read.positions.size()));
  return read;
}

bool follow_joints(const PrimitivePlace& at, std::size_t node, Skins& skins, PlacedPrimitive& part) {
  const auto skin = index_at(element(at.document.root, "nodes", node), "skin");
  std::vector<Vec3> no_normals;
  Tangents no_tangents;
  return skin && apply_skin({at.document, at.where(), at.json, skins.joints(*skin)}, part.positions,
                            no_normals, no_tangents);
}

void add_placed(const PlacedNode& node, const Document& document, const PlacedPrimitive& part,
           std::vector<PlacedPrimitive>& all) {
  const bool instanced = find(element(document.root, "nodes", node.index),
                              {"extensions", "EXT_mesh_gpu_instancing"}) != nullptr;
  const auto matrices = instance_matrices(document, node);
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    PlacedPrimitive& placed = all.emplace_back(part);
    if (instanced) {
      placed.copy = k;
      placed.local = glm::inverse(node.world) * matrices[k];
    }
    placed.mirrored = is_mirrored(matrices[k]);
    for (Point3& x : placed.positions)
      x = Point3(matrices[k] * glm::dvec4(x, 1.0));
  }
}

} // namespace

std::vector<PlacedPrimitive> placed_primitives(const Document& document,
                                               std::span<const PlacedNode> nodes) {
  geometry_size(document, nodes);
  Skins skins(document, nodes);
  std::vector<PlacedPrimitive> all;
  std::uint32_t next = 0;
  for (const PlacedNode& node : nodes) {
    const auto mesh = index_at(element(document.root, "nodes", node.index), "mesh");
    if (!mesh)
      continue;
    const NodeId id{next++};
    each_primitive(mesh_place(document, node.index, *mesh), [&](const PrimitivePlace& at) {
      auto part = read_primitive(at);
      if (!part)
        return;
      part->file_node = node.index;
      part->node = id;
      if (follow_joints(at, node.index, skins, *part))
        all.push_back(std::move(*part));
      else
        add_placed(node, document, *part, all);
    });
  }
  return all;
}

} // namespace meninas::gltf
