// Triangles of every mesh node, in world space.
#include "scenes/gltf/accessors.h"
#include "scenes/gltf/geometry/deformation.h"
#include "scenes/gltf/geometry/file_triangles.h"
#include "scenes/gltf/geometry/instances.h"
#include "scenes/gltf/geometry/part.h"
#include "scenes/shading_normal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace meninas::gltf {

namespace {

/// What is read, and by vertex half the step of rounded positions, in metres.
struct Geometry {
  Scene& scene;
  std::vector<float> half_steps;
  NodeId node = none<NodeId>; ///< whose parts are read
  GeometrySize size;          ///< of all parts
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> attributes_of =
      {}; ///< by mesh and primitive: where in the scene those of its vertices begin
};

// Coordinates whose fourth powers leave the range of doubles cannot be computed with.
constexpr double largest_coordinate = 1e60;

} // namespace

static void decode_texcoords(const PrimitivePlace& at, std::vector<VertexAttributes>& attributes,
                             Findings& findings) {
  for (std::size_t set = 0; set < 2; ++set) {
    const auto accessor = index_at(at.json["attributes"], fmt::format("TEXCOORD_{}", set));
    if (!accessor)
      continue;
    const auto decoded = decode_vectors(at.document, *accessor, 2);
    for (std::size_t k = 0; k < attributes.size(); ++k) {
      const glm::vec2 uv(decoded.values[2 * k], decoded.values[2 * k + 1]);
      if (std::isfinite(uv.x) && std::isfinite(uv.y))
        attributes[k].texcoord[set] = uv;
      else
        findings.about("texture coordinates that are not finite are read as 0 in nodes",
                       at.in.node);
    }
  }
}

/// A material with textures on what has no coordinates for them.
static void check_texcoords(const PrimitivePlace& at, Findings& findings) {
  const auto material = index_at(at.json, "material");
  if (!material)
    return;
  for (const auto set : texcoord_sets(element(at.document.root, "materials", *material)))
    if (!at.json["attributes"].contains(fmt::format("TEXCOORD_{}", set)))
      findings.about("texture coordinates that their materials ask for are missing in nodes",
                     at.in.node);
}

/// COLOR_0, RGB or RGBA, in [0, 1]: linear factors of the base colour.
static void decode_colors(const PrimitivePlace& at, std::vector<VertexAttributes>& attributes,
                          Findings& findings) {
  const auto accessor = index_at(at.json["attributes"], "COLOR_0");
  if (!accessor)
    return;
  const bool with_alpha =
      text_or(element(at.document.root, "accessors", *accessor), "type", "") == "VEC4";
  const auto decoded = decode_vectors(at.document, *accessor, with_alpha ? 4 : 3);
  for (std::size_t k = 0; k < attributes.size(); ++k) {
    for (std::size_t c = 0; c < decoded.width; ++c) {
      const double value = decoded.values[decoded.width * k + c];
      if (!(value >= 0.0 && value <= 1.0))
        findings.about("vertex colours outside [0, 1] are clamped in nodes", at.in.node);
      attributes[k].color[static_cast<glm::length_t>(c)] =
          static_cast<float>(value > 0.0 ? std::min(value, 1.0) : 0.0);
    }
  }
}

static void check_attribute_counts(const PrimitivePlace& at, std::size_t position) {
  const auto expected = accessor_count(at.document, position);
  for (const auto& [name, accessor] : at.json["attributes"].items()) {
    const auto count = accessor_count(at.document, size_value(accessor));
    if (count != expected)
      at.fail(fmt::format("{} has {} elements, POSITION has {}", one_line(name), count, expected));
  }
}

static std::optional<Part> decode_primitive(const PrimitivePlace& at, Findings& findings) {
  const auto mode = mode_of(at);
  if (mode < Mode::triangles) {
    findings.about("points and lines are left out in nodes", at.in.node);
    return std::nullopt;
  }
  const auto accessor = position_accessor(at);
  if (!accessor) {
    findings.about("primitives without positions are left out in nodes", at.in.node);
    return std::nullopt;
  }
  check_attribute_counts(at, *accessor);

  Part part;
  part.positions = decode_positions(at, *accessor);
  part.step = step_of_values(at.document, *accessor);
  part.normals = decode_normals(at, findings);
  part.tangent_map = tangent_map_of(at);
  part.anisotropic = is_anisotropic(at);
  if (part.tangent_map)
    part.tangents = decode_tangents(at);
  if (const auto* targets = find(at.json, "targets"); targets && !targets->empty()) {
    if (!at.document.settings.state.at)
      findings.about("morph targets keep their default weights in nodes", at.in.node);
    const Morph morph{at.document, at.where(), at.json, at.in.morph_weights};
    apply_morph_targets(morph, "POSITION", part.positions);
    apply_morph_targets(morph, "NORMAL", part.normals.values);
    apply_morph_targets(morph, "TANGENT", part.tangents.directions);
  }
  if (part.tangent_map)
    part.tangents = usable_tangents(at, std::move(part.tangents), part.normals.values,
                                    *part.tangent_map, findings);
  part.attributes.resize(part.positions.size());
  decode_texcoords(at, part.attributes, findings);
  check_texcoords(at, findings);
  decode_colors(at, part.attributes, findings);
  const auto corners = decode_corners(at, part.positions.size());
  if (mode == Mode::triangles && corners.size() % 3 != 0)
    findings.about("vertices after the last whole triangle are left out in nodes", at.in.node);
  part.triangles = triangulate(mode, corners);
  if (const auto material = index_at(at.json, "material"))
    part.material = static_cast<MaterialId>(*material);
  return part;
}

static double largest_of(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Half the distance between neighbouring floats at x.
static double half_ulp(double x) {
  return x > 0.0 ? std::ldexp(1.0, std::max(std::ilogb(x), -126) - 24) : 0.0;
}

/// Rounding of local coordinates to floats, stretched by the matrix,
/// and of the product with the matrix in doubles, by the largest of the coordinates.
class PositionError {
public:
  explicit PositionError(const glm::dmat4& world) : away_(largest_of(Vec3(world[3]))) {
    const auto rows = glm::transpose(glm::dmat3(world));
    // The largest sum of a row bounds the change of any coordinate.
    for (int row = 0; row < 3; ++row)
      stretch_ =
          std::max(stretch_, std::abs(rows[row].x) + std::abs(rows[row].y) + std::abs(rows[row].z));
  }

  /// Of coordinates that are rounded to multiples of a step.
  double of_step(double step) const { return 0.5 * step * stretch_; }
  double of(double local) const {
    return half_ulp(local) * stretch_ + 4e-16 * (stretch_ * local + away_);
  }
  double of(const Part& part) const {
    double local = 0.0;
    for (const auto& p : part.positions)
      local = std::max(local, largest_of(p));
    return of(local);
  }

private:
  double stretch_ = 0.0, away_ = 0.0;
};

/// Its shortest height is below the error of the corners: neither a plane nor a front can be told.
static bool is_degenerate(const std::array<Point3, 3>& p, double error) {
  const auto longest =
      std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
  return !(2.0 * glm::length(area_vector(p)) > error * longest);
}

static void set_last_tangent(Scene& scene, const glm::dmat4& world, const Tangents& tangents,
                             std::size_t vertex) {
  Vec3 direction = tangents.directions[vertex];
  double sign = tangents.signs[vertex];
  move_tangent(world, direction, sign);
  scene.tangents.resize(scene.vertices.size(), glm::vec4(0.0F));
  scene.tangents.back() = glm::vec4(direction, sign);
}

/// By vertex of a part, where in the scene its attributes are; empty where nothing is told of any.
/// Copies of a mesh share them; those whose vertices were divided otherwise have their own.
static std::vector<AttributesId> shared_attributes(const PrimitivePlace& at, const Part& part,
                                                   Geometry& into) {
  const auto is_silent = [](const VertexAttributes& told) { return told == VertexAttributes{}; };
  if (std::ranges::all_of(part.attributes, is_silent))
    return {};
  std::vector<AttributesId> ids(part.attributes.size(), none<AttributesId>);
  std::vector<VertexAttributes> told; // of vertices that triangles have
  for (const auto& corners : part.triangles)
    for (const auto v : corners)
      if (ids[v] == none<AttributesId>) {
        ids[v] = static_cast<AttributesId>(told.size());
        told.push_back(part.attributes[v]);
      }
  auto& all = into.scene.attributes;
  std::size_t& first =
      into.attributes_of.try_emplace({at.in.mesh, at.number}, all.size()).first->second;
  const auto known = std::span(all).subspan(first);
  if (known.size() < told.size() || !std::ranges::equal(told, known.first(told.size()))) {
    first = all.size();
    all.insert(all.end(), told.begin(), told.end());
  }
  for (AttributesId& id : ids)
    if (id != none<AttributesId>)
      id = static_cast<AttributesId>(index(id) + first);
  return ids;
}

static void add_part(const PrimitivePlace& at, const Part& part,
                     std::span<const AttributesId> attributes, const glm::dmat4& world,
                     Geometry& into, Findings& findings) {
  Scene& scene = into.scene;
  const PositionError position_error(world);
  const auto error = position_error.of(part);
  const bool mirrored = is_mirrored(world);
  std::vector<Point3> placed(part.positions.size());
  for (std::size_t k = 0; k < placed.size(); ++k) {
    placed[k] = Point3(world * glm::dvec4(part.positions[k], 1.0));
    if (!(largest_of(placed[k]) < largest_coordinate))
      at.fail(fmt::format("vertex {} is over {:g} m away in node {}", k, largest_coordinate,
                          at.in.node));
  }

  // Vertices join the scene when the first triangle that stays needs them.
  std::vector<VertexId> ids(placed.size(), none<VertexId>);
  std::size_t kept = 0;
  for (auto corners : part.triangles) {
    if (mirrored)
      std::swap(corners[1], corners[2]);
    if (is_degenerate({placed[corners[0]], placed[corners[1]], placed[corners[2]]}, error))
      continue;
    Triangle triangle{.material = part.material, .node = into.node};
    for (std::size_t c = 0; c < 3; ++c) {
      auto& id = ids[corners[c]];
      if (id == none<VertexId>) {
        id = static_cast<VertexId>(scene.vertices.size());
        scene.vertices.push_back({.position = placed[corners[c]]});
        scene.position_errors.push_back(
            static_cast<float>(position_error.of(largest_of(part.positions[corners[c]]))));
        into.half_steps.push_back(static_cast<float>(position_error.of_step(part.step)));
        if (!attributes.empty())
          scene.vertices.back().attributes = attributes[corners[c]];
        if (!part.normals.values.empty())
          scene.vertices.back().normal =
              glm::vec3(moved_normal(world, part.normals.values[corners[c]]));
        if (!part.tangents.directions.empty())
          set_last_tangent(scene, world, part.tangents, corners[c]);
      }
      triangle.vertices[c] = id;
    }
    scene.triangles.push_back(triangle);
    if (!part.normals.values.empty())
      mark_curved(scene, TriangleId{static_cast<std::uint32_t>(scene.triangles.size() - 1)},
                  part.normals.error);
    ++kept;
  }
  if (kept > 0)
    scene.position_error = std::max(scene.position_error, error);
  const auto dropped = part.triangles.size() - kept;
  scene.degenerate_triangles += dropped;
  if (dropped > 0)
    findings.about("triangles without area are in nodes", at.in.node);
}

/// Tangents that the file does not give, and room for the vertices that they make.
static void complete(const PrimitivePlace& at, Part& part, double copies, Geometry& into,
                     Findings& findings) {
  const auto given = static_cast<double>(part.positions.size());
  if (settle_tangents(part))
    findings.about("anisotropic surfaces without texture coordinates are brushed level, around the y "
                   "axis of their meshes, in nodes",
                   at.in.node);
  const auto [bytes, vertices] =
      size_of_vertices(copies, static_cast<double>(part.positions.size()) - given);
  into.size.bytes += bytes;
  into.size.vertices += vertices;
  check_size(at.document, into.size);
}

/// A primitive where its node puts it: moved by the joints, or by the matrix of each instance.
static void place_part(const PrimitivePlace& at, Part part, const PlacedNode& node, Skins& skins,
                       Geometry& into, Findings& findings) {
  if (const auto skin = index_at(element(at.document.root, "nodes", node.index), "skin")) {
    if (apply_skin({at.document, at.where(), at.json, skins.joints(*skin)}, part.positions,
                   part.normals.values, part.tangents)) {
      if (!at.document.settings.state.at)
        findings.about("skins stand still, as the joints are in the file, in nodes", at.in.node);
      complete(at, part, 1.0, into, findings);
      return add_part(at, part, shared_attributes(at, part, into), glm::dmat4(1.0), into, findings);
    }
    findings.about("skins without joints in the scene are left out in nodes", at.in.node);
  }
  const auto copies = instance_matrices(at.document, node);
  complete(at, part, static_cast<double>(copies.size()), into, findings);
  if (copies.empty())
    findings.about("instanced nodes without an instance are left out", at.in.node);
  const auto attributes = shared_attributes(at, part, into);
  for (const auto& world : copies)
    add_part(at, part, attributes, world, into, findings);
}

std::vector<float> read_geometry(const Document& document, std::span<const PlacedNode> nodes,
                                 Scene& scene, Findings& findings) {
  Geometry geometry{scene, {}, none<NodeId>, geometry_size(document, nodes)};
  Skins skins(document, nodes);
  std::vector<std::string> names, lamps;
  for (const auto& node : nodes) {
    const auto mesh = index_at(element(document.root, "nodes", node.index), "mesh");
    if (!mesh)
      continue;
    geometry.node = static_cast<NodeId>(names.size());
    const auto place = mesh_place(document, node.index, *mesh);
    names.push_back(place.node);
    lamps.push_back(lamp_of_node(document, node.index));
    each_primitive(place, [&](const PrimitivePlace& at) {
      if (auto part = decode_primitive(at, findings))
        place_part(at, std::move(*part), node, skins, geometry, findings);
    });
  }
  auto unique = unique_names(names);
  for (std::size_t n = 0; n < unique.size(); ++n)
    scene.nodes.push_back({std::move(unique[n]), std::move(lamps[n])});
  return std::move(geometry.half_steps);
}

} // namespace meninas::gltf
