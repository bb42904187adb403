#include "radiosity/mesh/subdivision.h"
#include "radiosity/relight.h"
#include "radiosity/solution/lamp_codes.h"
#include "radiosity/solution/solution_file.h"
#include "radiosity/solution/solution_format.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/glb_file.h"
#include "scenes/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace meninas {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(file.string(), "", what);
}

/// JSON has no infinity: an error bound that does not exist is null.
double number_or_infinity(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

/// A number of things. A file with a number that is none, such as 1.5 or 1e308, is no solution of ours.
std::size_t count_in(const json& value) {
  if (!value.is_number_unsigned())
    throw json::type_error::create(302, "no number of things", &value);
  return value.get<std::size_t>();
}

int whole_in(const json& value) {
  if (!value.is_number_integer())
    throw json::type_error::create(302, "no whole number", &value);
  return value.get<int>();
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
  solver.end = static_cast<SolverEnd>(whole_in(solve.at("end")));
  solver.bands = whole_in(solve.at("bands"));
  solver.iterations = whole_in(solve.at("iterations"));
  solver.residual = number_or_infinity(solve.at("residual"));
  solver.error_bound = number_or_infinity(solve.at("error_bound"));
  if (const auto error = solve.find("relative_error"); error != solve.end()) // earlier files have none
    solver.relative_error = number_or_infinity(*error);
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
  if (const json& links = figures.at("links"); !links.empty())
    stored.links = {count_in(links.at("receivers")), count_in(links.at("links")), count_in(links.at("bytes"))};
  const json& energy = figures.at("energy");
  stored.energy.emitted = colour_of(energy.at("emitted"));
  stored.energy.absorbed = colour_of(energy.at("absorbed"));
  stored.energy.escaped = colour_of(energy.at("escaped"));
  stored.energy.mirror_absorbed = colour_of(energy.at("mirror_absorbed"));
  stored.energy.imbalance = number_or_infinity(energy.at("imbalance"));
  const json& closure = figures.at("closure");
  stored.closure = {closure.at("mean_error"), closure.at("max_error"), closure.at("cut")};
}

std::vector<glm::vec3> read_irradiance(const std::filesystem::path& file, const GlbContent& glb,
                                       std::size_t accessor_index, std::size_t vertices) {
  const json& root = glb.root;
  const json& accessor = root.at("accessors").at(accessor_index);
  const json& view = root.at("bufferViews").at(count_in(accessor.at("bufferView")));
  const std::size_t offset = count_in(view.at("byteOffset"));
  // Points that viewers alone show come after the vertices.
  const bool fits = count_in(accessor.at("count")) >= vertices &&
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

/// The bytes of a view.
std::span<const std::uint8_t> bytes_of(const std::filesystem::path& file, const GlbContent& glb,
                                       const json& number, const char* what) {
  const json& view = glb.root.at("bufferViews").at(count_in(number));
  const std::size_t offset = count_in(view.at("byteOffset")), size = count_in(view.at("byteLength"));
  if (offset > glb.binary.size() || size > glb.binary.size() - offset) {
    refuse(file, fmt::format("damaged: it does not hold the {} it announces", what));
  }
  return std::span(glb.binary).subspan(offset, size);
}

/// The forest of the field's mesh, where it has one of its own.
std::vector<std::uint8_t> read_division(const std::filesystem::path& file, const GlbContent& glb,
                                        const json& extras) {
  if (!extras.contains("division")) {
    return {};
  }
  const std::span<const std::uint8_t> bytes = bytes_of(file, glb, extras.at("division"), "mesh");
  return {bytes.begin(), bytes.end()};
}

/// The light of its lamps, of so many vertices, where it is told apart.
void read_lamps(const std::filesystem::path& file, const GlbContent& glb, const json& extras,
                std::size_t vertices, StoredSolution& stored) {
  if (!extras.contains("lamps")) {
    return;
  }
  const json& lamps = extras.at("lamps");
  if (stored.field.indirect.size() != vertices) {
    refuse(file, "damaged: it holds the light of lamps and not all light without that of emitters");
  }
  stored.grouping =
      lamps.at("grouping") == "material" ? LampGrouping::material : LampGrouping::node;
  std::set<std::size_t> views;
  for (const json& lamp : lamps.at("list")) {
    const auto bytes = bytes_of(file, glb, lamp.at("view"), "light of lamps");
    if (bytes.size() != vertices * vec3_size) {
      refuse(file, "damaged: it does not hold the light of lamps it announces");
    }
    // Exponents of floats; each lamp has bytes of its own.
    const json& top = lamp.at("top");
    const bool is_exponent = top.is_number_integer() && top >= -200 && top <= 128;
    if (!is_exponent || !views.insert(count_in(lamp.at("view"))).second) {
      refuse(file, "damaged: the light of its lamps makes no sense");
    }
    stored.lamps.push_back(lamp.at("name"));
    stored.field.by_lamp.push_back(decoded(top.get<int>(), bytes));
    for (const auto* values : {&stored.field.by_lamp.back().direct, &stored.field.by_lamp.back().indirect})
      if (!std::ranges::all_of(*values, [](const glm::vec3& v) { return std::isfinite(v.r + v.g + v.b); }))
        refuse(file, "damaged: the light of its lamps is no number");
  }
  add_up_by_vertex(stored.field);
}

/// The bytes the hash was made of: the binary chunk without its padding.
std::span<const std::byte> data_of(const std::filesystem::path& file, const GlbContent& glb) {
  const std::size_t size = count_in(glb.root.at("buffers").at(0).at("byteLength"));
  if (size > glb.binary.size()) {
    refuse(file, "damaged: it does not hold the data it announces");
  }
  return std::as_bytes(std::span(glb.binary)).first(size);
}

MeshSettings read_mesh_settings(const std::filesystem::path& file, const json& mesh) {
  const MeshSettings settings{.element_size = mesh.at("element_size"),
                              .target_elements = mesh.at("target_elements"),
                              .max_elements = count_in(mesh.at("max_elements"))};
  // More than the program makes would take all memory before anything else is found wrong.
  if (!(settings.element_size >= 0.0) || !(settings.target_elements > 0.0) ||
      settings.max_elements == 0 || settings.max_elements > MeshSettings{}.max_elements) {
    refuse(file, "damaged: the settings of its mesh make no sense");
  }
  return settings;
}

StoredSolution read_checked(const std::filesystem::path& file, const GlbContent& glb,
                            const Scene& scene) {
  const json& extras = glb.root.at("asset").at("extras").at("meninas");
  const int format = extras.contains("format") ? whole_in(extras.at("format")) : 1;
  if (format != solution_format) {
    refuse(file, fmt::format("has format {} of solution files, this program reads {}: solve again",
                             format, solution_format));
  }
  if (extras.at("version") != program_version()) {
    refuse(file,
           fmt::format("was written by version {}, this is {}: solve again",
                       extras.at("version").get<std::string>().substr(0, 32), program_version()));
  }
  if (extras.at("scene_hash") != hex(content_hash(scene))) {
    refuse(file, fmt::format("is not a solution of {}: solve again", scene.file));
  }
  if (extras.at("data_hash") != hex(hash_of_bytes(data_of(file, glb)))) {
    refuse(file, "damaged: its data do not have the hash it announces");
  }
  StoredSolution stored;
  stored.mesh = read_mesh_settings(file, extras.at("mesh"));
  stored.elements = count_in(extras.at("elements"));
  stored.division = read_division(file, glb, extras);
  const json& attributes = extras.at("field");
  const std::size_t vertices = count_in(extras.at("vertices"));
  // Where all surfaces are mirrors there are no vertices, and no attributes of them.
  for (const FieldPart& part : field_parts) {
    if (vertices > 0 &&
        (part.values == &VertexIrradiance::irradiance || attributes.contains(part.attribute))) {
      stored.field.*part.values =
          read_irradiance(file, glb, count_in(attributes.at(part.attribute)), vertices);
    }
  }
  read_lamps(file, glb, extras, vertices, stored);
  read_figures(file, extras.at("figures"), stored);
  return stored;
}

} // namespace

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

IrradianceField field_of(const std::filesystem::path& file, StoredSolution solution,
                         std::shared_ptr<const LightScene> light) {
  if (!solution.division.empty()) {
    if (!is_division_of(light->mesh, solution.division)) {
      refuse(file, "damaged: its elements are no division of its mesh");
    }
    light = light_scene_on(light, divided_mesh(light->mesh, light->surfaces, solution.division));
  }
  check_belongs(file, solution, light->mesh);
  return {std::move(solution.field), std::move(light)};
}

} // namespace meninas
