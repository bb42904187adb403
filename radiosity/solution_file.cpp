#include "radiosity/solution_file.h"

#include "image/display.h"
#include "image/whole_file.h"
#include "scenes/errors.h"
#include "scenes/glb_file.h"
#include "scenes/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace meninas {
namespace {

using nlohmann::json;

constexpr int gltf_float = 5126;
constexpr int gltf_unsigned_int = 5125;
constexpr int gltf_array_buffer = 34962;
constexpr int gltf_element_array_buffer = 34963;
constexpr const char* unlit = "KHR_materials_unlit";
constexpr std::size_t vec3_size = sizeof(glm::vec3);
static_assert(vec3_size == 12);

/// The attributes that keep a field; all but the first may be missing.
struct FieldPart {
  const char* attribute;
  std::vector<glm::vec3> DiffuseField::*values;
};
constexpr FieldPart field_parts[] = {
    {"_IRRADIANCE", &DiffuseField::irradiance},
    {"_IRRADIANCE_MIRRORED", &DiffuseField::mirrored},
    {"_IRRADIANCE_INDIRECT", &DiffuseField::indirect},
    {"_IRRADIANCE_INDIRECT_MIRRORED", &DiffuseField::indirect_mirrored}};

/// FNV-1a: any changed byte changes it.
std::uint64_t data_hash(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::byte byte : bytes) {
    hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ULL;
  }
  return hash;
}

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

json as_json(const Rgb& colour) { return json::array({colour.r, colour.g, colour.b}); }

// --- Writing

Point3 centre_of(const ElementMesh& mesh) {
  Bounds bounds;
  for (const Point3& vertex : mesh.vertices) {
    bounds.low = glm::min(bounds.low, vertex);
    bounds.high = glm::max(bounds.high, vertex);
  }
  return mesh.vertices.empty() ? Point3(0.0) : 0.5 * (bounds.low + bounds.high);
}

/// B = E + rho H at the vertices, so exposed that the brightest of it is white.
std::vector<glm::vec3> display_colours(const ElementMesh& mesh, const DiffuseField& field) {
  Image radiosity;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const ElementId element = mesh.element_of_vertex[v];
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[index(element)])];
    radiosity.pixels.emplace_back(side.emission + side.reflectance * Rgb(field.irradiance[v]));
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

/// Counter-clockwise seen from the side's own light.
std::vector<std::uint32_t> triangles_of(const ElementMesh& mesh) {
  std::vector<std::uint32_t> indices;
  for (std::size_t e = 0; e < mesh.corners.size(); ++e) {
    const ElementCorners& corners = mesh.corners[e];
    const bool back = mesh.sides[index(mesh.side_of_element[e])].facing == Facing::back;
    const auto add = [&](ElementVertexId a, ElementVertexId b, ElementVertexId c) {
      indices.insert(indices.end(), {index(a), index(back ? c : b), index(back ? b : c)});
    };
    add(corners[0], corners[1], corners[2]);
    if (corners[3] != corners[2]) {
      add(corners[0], corners[2], corners[3]);
    }
  }
  return indices;
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
  return {{"solve",
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

json extras_json(const Scene& scene, const ElementMesh& mesh, const MeshSettings& settings,
                 std::span<const std::byte> binary) {
  return {{"version", program_version()},
          {"scene_hash", hex(content_hash(scene))},
          {"data_hash", hex(data_hash(binary))},
          {"mesh",
           {{"element_size", settings.element_size},
            {"target_elements", settings.target_elements},
            {"max_elements", settings.max_elements}}},
          {"elements", element_count(mesh)},
          {"vertices", mesh.vertices.size()}};
}

/// The parts of the file a viewer needs; positions are relative to `centre`.
json viewer_json(Geometry& geometry, const ElementMesh& mesh, const DiffuseField& field) {
  const Point3 centre = centre_of(mesh);
  std::vector<glm::vec3> positions;
  for (const Point3& vertex : mesh.vertices) {
    positions.emplace_back(vertex - centre);
  }
  const json vec3{{"componentType", gltf_float}, {"type", "VEC3"}};
  const json scalar{{"componentType", gltf_unsigned_int}, {"type", "SCALAR"}};
  json attributes;
  attributes["POSITION"] =
      add_array(geometry, positions, gltf_array_buffer, bounds_json(positions));
  attributes["COLOR_0"] =
      add_array(geometry, display_colours(mesh, field), gltf_array_buffer, vec3);
  for (const FieldPart& part : field_parts) {
    if (!(field.*part.values).empty()) {
      attributes[part.attribute] =
          add_array(geometry, field.*part.values, gltf_array_buffer, vec3);
    }
  }
  const std::size_t indices =
      add_array(geometry, triangles_of(mesh), gltf_element_array_buffer, scalar);
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

// --- Reading

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(file.string(), "", what);
}

/// JSON has no infinity: an error bound that does not exist is null.
double number_or_infinity(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

Rgb colour_of(const json& value) {
  const auto numbers = value.get<std::array<double, 3>>();
  return {numbers[0], numbers[1], numbers[2]};
}

SolverMethod method_of(const std::filesystem::path& file, const std::string& name) {
  for (const SolverMethod method : solver_methods) {
    if (name == name_of(method)) {
      return method;
    }
  }
  refuse(file, "damaged: it names no solver");
}

std::vector<Rgb> colours_of(const json& list) {
  std::vector<Rgb> colours;
  for (const json& value : list) {
    colours.emplace_back(number_or_infinity(value.at(0)), number_or_infinity(value.at(1)),
                         number_or_infinity(value.at(2)));
  }
  return colours;
}

SolverResult read_solver(const std::filesystem::path& file, const json& solve) {
  SolverResult solver;
  solver.method = method_of(file, solve.at("solver"));
  solver.end = static_cast<SolverEnd>(solve.at("end").get<int>());
  solver.bands = solve.at("bands");
  solver.iterations = solve.at("iterations");
  solver.residual = number_or_infinity(solve.at("residual"));
  solver.error_bound = number_or_infinity(solve.at("error_bound"));
  solver.converged = solve.at("converged");
  for (const json& residual : solve.at("residuals")) {
    solver.residuals.push_back(number_or_infinity(residual));
  }
  solver.channel_residuals = colours_of(solve.at("channel_residuals"));
  solver.channel_error_bounds = colours_of(solve.at("channel_error_bounds"));
  return solver;
}

void read_figures(const std::filesystem::path& file, const json& figures, StoredSolution& stored) {
  stored.solver = read_solver(file, figures.at("solve"));
  const json& energy = figures.at("energy");
  stored.energy.emitted = colour_of(energy.at("emitted"));
  stored.energy.absorbed = colour_of(energy.at("absorbed"));
  stored.energy.escaped = colour_of(energy.at("escaped"));
  stored.energy.mirror_absorbed = colour_of(energy.at("mirror_absorbed"));
  stored.energy.imbalance = number_or_infinity(energy.at("imbalance"));
  const json& closure = figures.at("closure");
  stored.closure = {closure.at("mean_error"), closure.at("max_error"), closure.at("cut")};
}

const json& attributes_of(const GlbContent& glb) {
  return glb.root.at("meshes").at(0).at("primitives").at(0).at("attributes");
}

std::vector<glm::vec3> read_irradiance(const std::filesystem::path& file, const GlbContent& glb,
                                       std::size_t accessor_index, std::size_t vertices) {
  const json& root = glb.root;
  const json& accessor = root.at("accessors").at(accessor_index);
  const json& view = root.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const std::size_t offset = view.at("byteOffset");
  const bool fits = accessor.at("count").get<std::size_t>() == vertices &&
                    offset <= glb.binary.size() &&
                    vertices <= (glb.binary.size() - offset) / vec3_size;
  if (!fits) {
    refuse(file, "damaged: it does not hold the irradiance it announces");
  }
  std::vector<glm::vec3> irradiance(vertices);
  if (vertices > 0) {
    std::memcpy(irradiance.data(), glb.binary.data() + offset, vertices * vec3_size);
  }
  for (const glm::vec3& value : irradiance) {
    if (!std::isfinite(value.x + value.y + value.z)) {
      refuse(file, "damaged: an irradiance is not finite");
    }
  }
  return irradiance;
}

/// The bytes the hash was made of: the binary chunk without its padding.
std::span<const std::byte> data_of(const std::filesystem::path& file, const GlbContent& glb) {
  const std::size_t size = glb.root.at("buffers").at(0).at("byteLength");
  if (size > glb.binary.size()) {
    refuse(file, "damaged: it does not hold the data it announces");
  }
  return std::as_bytes(std::span(glb.binary)).first(size);
}

MeshSettings read_mesh_settings(const std::filesystem::path& file, const json& mesh) {
  const MeshSettings settings{.element_size = mesh.at("element_size"),
                              .target_elements = mesh.at("target_elements"),
                              .max_elements = mesh.at("max_elements")};
  if (!(settings.element_size >= 0.0) || !(settings.target_elements > 0.0) ||
      settings.max_elements == 0) {
    refuse(file, "damaged: the settings of its mesh make no sense");
  }
  return settings;
}

StoredSolution read_checked(const std::filesystem::path& file, const GlbContent& glb,
                            const Scene& scene) {
  const json& extras = glb.root.at("asset").at("extras").at("meninas");
  if (extras.at("version") != program_version()) {
    refuse(file,
           fmt::format("was written by version {}, this is {}: solve again",
                       extras.at("version").get<std::string>().substr(0, 32), program_version()));
  }
  if (extras.at("scene_hash") != hex(content_hash(scene))) {
    refuse(file, fmt::format("is not a solution of {}: solve again", scene.file));
  }
  if (extras.at("data_hash") != hex(data_hash(data_of(file, glb)))) {
    refuse(file, "damaged: its data do not have the hash it announces");
  }
  StoredSolution stored;
  stored.mesh = read_mesh_settings(file, extras.at("mesh"));
  stored.elements = extras.at("elements");
  const json& attributes = attributes_of(glb);
  const std::size_t vertices = extras.at("vertices");
  for (const FieldPart& part : field_parts) {
    if (part.values == &DiffuseField::irradiance || attributes.contains(part.attribute)) {
      stored.field.*part.values =
          read_irradiance(file, glb, attributes.at(part.attribute), vertices);
    }
  }
  read_figures(file, extras.at("figures"), stored);
  return stored;
}

} // namespace

void write_solution(const std::filesystem::path& file, const Scene& scene, const ElementMesh& mesh,
                    const RadiositySolution& solution, const MeshSettings& settings) {
  Geometry geometry;
  json root = viewer_json(geometry, mesh, solution.field);
  json extras = extras_json(scene, mesh, settings, geometry.binary);
  extras["figures"] = figures_json(solution);
  root["asset"] = {{"version", "2.0"},
                   {"generator", fmt::format("Meninas {}", program_version())},
                   {"extras", {{"meninas", std::move(extras)}}}};
  root["buffers"] = json::array({{{"byteLength", geometry.binary.size()}}});
  root["bufferViews"] = std::move(geometry.views);
  root["accessors"] = std::move(geometry.accessors);
  write_whole_file(file, glb_bytes(root, geometry.binary, file));
}

StoredSolution read_solution(const std::filesystem::path& file, const Scene& scene) {
  const GlbContent glb = read_glb(file);
  try {
    return read_checked(file, glb, scene);
  } catch (const json::exception&) {
    refuse(file, "not a solution written by 'meninas solve'");
  }
}

void check_belongs(const std::filesystem::path& file, const StoredSolution& solution,
                   const ElementMesh& mesh) {
  if (solution.field.irradiance.size() != mesh.vertices.size() ||
      solution.elements != element_count(mesh)) {
    refuse(file, fmt::format("damaged: it has {} vertices and {} elements, its mesh has {} and {}",
                             solution.field.irradiance.size(), solution.elements,
                             mesh.vertices.size(), element_count(mesh)));
  }
}

} // namespace meninas
