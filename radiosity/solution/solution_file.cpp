#include "radiosity/solution/solution_file.h"

#include "image/display.h"
#include "image/whole_file.h"
#include "radiosity/solution/element_triangles.h"
#include "radiosity/solution/lamp_codes.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/solution/solution_format.h"
#include "scenes/content_hash.h"
#include "scenes/glb_file.h"
#include "scenes/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace meninas {
namespace {

using nlohmann::json;

constexpr int gltf_float = 5126;
constexpr int gltf_unsigned_int = 5125;
constexpr int gltf_array_buffer = 34962;
constexpr int gltf_element_array_buffer = 34963;
constexpr const char* unlit = "KHR_materials_unlit";
json as_json(const Rgb& colour) { return json::array({colour.r, colour.g, colour.b}); }

Point3 centre_of(const ElementMesh& mesh) {
  Bounds bounds;
  for (const Point3& vertex : mesh.vertices) {
    bounds.low = glm::min(bounds.low, vertex);
    bounds.high = glm::max(bounds.high, vertex);
  }
  return mesh.vertices.empty() ? Point3(0.0) : 0.5 * (bounds.low + bounds.high);
}

/// B = E + rho H, of translucent surfaces with what comes through, at the vertices, so exposed that
/// the brightest of it is white.
/// Values at the vertices, and after them at the points on outlines of regions.
std::vector<glm::vec3> with_points(const ElementMesh& mesh, const ElementTriangles& triangles,
                                   std::vector<glm::vec3> values) {
  for (const RegionPoint& point : triangles.points) {
    glm::vec3 value(0.0F);
    for (std::size_t c = 0; c < 4; ++c)
      value += point.weights[c] * values[index(mesh.corners[index(point.element)][c])];
    values.push_back(value);
  }
  return values;
}

/// tau H of the other side at a point of an element of a translucent surface, by its weights of the corners.
Rgb passed_at(const ElementMesh& mesh, const VertexIrradiance& field, ElementId element,
              const std::array<float, 4>& weights) {
  const SideId side = mesh.side_of_element[index(element)], behind = side_behind(mesh, side);
  if (behind == none<SideId>)
    return Rgb(0.0);
  const bool triangle = mesh.sides[index(side)].triangle;
  const std::array coordinates{Vec2(0.0), Vec2(1.0, 0.0), triangle ? Vec2(0.0, 1.0) : Vec2(1.0),
                               Vec2(0.0, 1.0)};
  Vec2 st(0.0);
  for (std::size_t c = 0; c < 4; ++c)
    st += double{weights[c]} * coordinates[c];
  return mesh.transmittance[index(element)] *
         Rgb(irradiance_at(mesh, field, behind, patch_uv_of(mesh, cell_of(mesh, element), st)));
}

/// At a vertex.
Rgb passed_at(const ElementMesh& mesh, const VertexIrradiance& field, ElementVertexId vertex) {
  const ElementId of = mesh.element_of_vertex[index(vertex)];
  std::array<float, 4> weights{};
  weights[static_cast<std::size_t>(std::ranges::find(mesh.corners[index(of)], vertex) -
                                   mesh.corners[index(of)].begin())] = 1.0F;
  return passed_at(mesh, field, of, weights);
}

std::vector<glm::vec3> display_colours(const ElementMesh& mesh, const ElementTriangles& triangles,
                                       const VertexIrradiance& field) {
  Image radiosity;
  const std::vector<glm::vec3> irradiance = with_points(mesh, triangles, field.irradiance);
  const auto add = [&](ElementId of, const glm::vec3& received, const Rgb& passed) {
    radiosity.pixels.emplace_back(mesh.emission[index(of)] +
                                  mesh.reflectance[index(of)] * Rgb(received) + passed);
  };
  const std::size_t vertices = mesh.vertices.size();
  for (std::uint32_t v = 0; v < vertices; ++v)
    add(mesh.element_of_vertex[v], irradiance[v], passed_at(mesh, field, ElementVertexId{v}));
  for (std::size_t p = 0; p < triangles.points.size(); ++p) {
    const RegionPoint& point = triangles.points[p];
    add(point.element, irradiance[vertices + p],
        passed_at(mesh, field, point.element, point.weights));
  }
  radiosity.width = static_cast<int>(radiosity.pixels.size());
  radiosity.height = 1;
  const double scale = std::exp2(automatic_exposure(radiosity));
  std::vector<glm::vec3> colours;
  for (const glm::vec3& value : radiosity.pixels) {
    colours.emplace_back(glm::clamp(scale * Rgb(value), Rgb(0.0), Rgb(1.0)));
  }
  return colours;
}

/// The binary chunk, with the accessors and buffer views that describe it.
struct Geometry {
  std::vector<std::byte> binary;
  json views = json::array();
  json accessors = json::array();
};

template <typename Item>
std::size_t add_array(Geometry& geometry, const std::vector<Item>& items, int target,
                      json accessor) {
  const auto bytes = std::as_bytes(std::span(items));
  geometry.views.push_back({{"buffer", 0},
                            {"byteOffset", geometry.binary.size()},
                            {"byteLength", bytes.size()},
                            {"target", target}});
  accessor["bufferView"] = geometry.views.size() - 1;
  accessor["count"] = items.size();
  geometry.accessors.push_back(std::move(accessor));
  geometry.binary.insert(geometry.binary.end(), bytes.begin(), bytes.end());
  return geometry.accessors.size() - 1;
}

/// Bytes without an accessor, which viewers pass over. Returns the number of their view.
std::size_t add_bytes(Geometry& geometry, const std::vector<std::uint8_t>& items) {
  const auto bytes = std::as_bytes(std::span(items));
  geometry.views.push_back(
      {{"buffer", 0}, {"byteOffset", geometry.binary.size()}, {"byteLength", bytes.size()}});
  geometry.binary.insert(geometry.binary.end(), bytes.begin(), bytes.end());
  return geometry.views.size() - 1;
}

/// The light of every lamp.
json lamps_json(Geometry& geometry, const IrradianceField& field) {
  const LampGroups& lamps = *field.scene->lamp_groups;
  json list = json::array();
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
    const LampCodes codes = encoded(field.by_lamp[l]);
    list.push_back(
        {{"name", lamps.names[l]}, {"top", codes.top}, {"view", add_bytes(geometry, codes.bytes)}});
  }
  return {{"grouping", lamps.grouping == LampGrouping::node ? "node" : "material"},
          {"list", std::move(list)}};
}

json bounds_json(const std::vector<glm::vec3>& points) {
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (const glm::vec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  return {{"componentType", gltf_float},
          {"type", "VEC3"},
          {"min", {low.x, low.y, low.z}},
          {"max", {high.x, high.y, high.z}}};
}

json colours_json(const std::vector<Rgb>& colours) {
  json list = json::array();
  for (const Rgb& colour : colours) {
    list.push_back(as_json(colour));
  }
  return list;
}

json figures_json(const RadiositySolution& solution) {
  const SolverResult& solver = solution.solver;
  const EnergyBalance& energy = solution.energy;
  const ClosureError& closure = solution.closure;
  json links = json::object();
  if (solution.links)
    links = {{"receivers", solution.links->receivers},
             {"links", solution.links->links},
             {"bytes", solution.links->bytes}};
  return {{"links", links},
          {"solve",
           {{"solver", name_of(solver.method)},
            {"end", static_cast<int>(solver.end)},
            {"bands", solver.bands},
            {"iterations", solver.iterations},
            {"residual", solver.residual},
            {"error_bound", solver.error_bound},
            {"converged", solver.converged},
            {"residuals", solver.residuals},
            {"channel_residuals", colours_json(solver.channel_residuals)},
            {"channel_error_bounds", colours_json(solver.channel_error_bounds)}}},
          {"energy",
           {{"emitted", as_json(energy.emitted)},
            {"absorbed", as_json(energy.absorbed)},
            {"escaped", as_json(energy.escaped)},
            {"mirror_absorbed", as_json(energy.mirror_absorbed)},
            {"imbalance", energy.imbalance}}},
          {"closure",
           {{"mean_error", closure.mean_error},
            {"max_error", closure.max_error},
            {"cut", closure.cut}}}};
}

json extras_json(std::uint64_t scene_hash, const ElementMesh& mesh, const MeshSettings& settings,
                 std::span<const std::byte> binary) {
  return {{"format", solution_format},
          {"version", program_version()},
          {"scene_hash", hex(scene_hash)},
          {"data_hash", hex(hash_of_bytes(binary))},
          {"mesh",
           {{"element_size", settings.element_size},
            {"target_elements", settings.target_elements},
            {"max_elements", settings.max_elements}}},
          {"elements", element_count(mesh)},
          {"vertices", mesh.vertices.size()}};
}

/// The parts of the file a viewer needs; positions are relative to `centre`.
json viewer_json(Geometry& geometry, const ElementMesh& mesh, const VertexIrradiance& field) {
  const Point3 centre = centre_of(mesh);
  std::vector<glm::vec3> positions;
  for (const Point3& vertex : mesh.vertices) {
    positions.emplace_back(vertex - centre);
  }
  const ElementTriangles triangles = element_triangles(mesh);
  for (const RegionPoint& point : triangles.points) {
    positions.emplace_back(point.position - centre);
  }
  const json vec3{{"componentType", gltf_float}, {"type", "VEC3"}};
  const json scalar{{"componentType", gltf_unsigned_int}, {"type", "SCALAR"}};
  json attributes;
  attributes["POSITION"] =
      add_array(geometry, positions, gltf_array_buffer, bounds_json(positions));
  attributes["COLOR_0"] =
      add_array(geometry, display_colours(mesh, triangles, field), gltf_array_buffer, vec3);
  for (const FieldPart& part : field_parts) {
    if (!(field.*part.values).empty()) {
      attributes[part.attribute] = add_array(
          geometry, with_points(mesh, triangles, field.*part.values), gltf_array_buffer, vec3);
    }
  }
  const std::size_t indices =
      add_array(geometry, triangles.indices, gltf_element_array_buffer, scalar);
  const json primitive{
      {"attributes", attributes}, {"indices", indices}, {"material", 0}, {"mode", 4}};
  return {
      {"scene", 0},
      {"scenes", json::array({{{"nodes", json::array({0})}}})},
      {"nodes",
       json::array({{{"mesh", 0}, {"name", "radiosity"}, {"translation", as_json(centre)}}})},
      {"meshes", json::array({{{"name", "radiosity"}, {"primitives", json::array({primitive})}}})},
      {"materials",
       json::array({{{"name", "radiosity"}, {"extensions", {{unlit, json::object()}}}}})},
      {"extensionsUsed", json::array({unlit})}};
}

} // namespace

void write_solution(const std::filesystem::path& file, std::uint64_t scene_hash,
                    const ElementMesh& solved, const RadiositySolution& solution,
                    const MeshSettings& settings) {
  const ElementMesh& mesh = solution.field.mesh();
  const bool divided = &mesh != &solved;
  Geometry geometry;
  json root = viewer_json(geometry, mesh, solution.field);
  json own_mesh = json::object();
  if (divided) {
    own_mesh["division"] = add_bytes(geometry, division_of(mesh));
  }
  if (!solution.field.by_lamp.empty()) {
    own_mesh["lamps"] = lamps_json(geometry, solution.field);
  }
  json extras = extras_json(scene_hash, mesh, settings, geometry.binary);
  extras.update(own_mesh);
  extras["figures"] = figures_json(solution);
  root["asset"] = {{"version", "2.0"},
                   {"generator", fmt::format("Meninas {}", program_version())},
                   {"extras", {{"meninas", std::move(extras)}}}};
  root["buffers"] = json::array({{{"byteLength", geometry.binary.size()}}});
  root["bufferViews"] = std::move(geometry.views);
  root["accessors"] = std::move(geometry.accessors);
  write_whole_file(file, glb_bytes(root, geometry.binary, file));
}

} // namespace meninas
