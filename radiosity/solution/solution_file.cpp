#include "radiosity/solution/solution_file.h"

#include "image/whole_file.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/solution/lamp_codes.h"
#include "radiosity/solution/solution_format.h"
#include "radiosity/solution/viewer_scene.h"
#include "scenes/content_hash.h"
#include "scenes/glb_file.h"
#include "scenes/version.h"

#include <fmt/format.h>

namespace meninas {
namespace {

using nlohmann::json;

json as_json(const Rgb& colour) { return json::array({colour.r, colour.g, colour.b}); }

/// The light of every lamp.
json lamps_json(GlbArrays& glb, const IrradianceField& field) {
  const LampGroups& lamps = *field.scene->lamp_groups;
  json list = json::array();
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
    const LampCodes codes = encoded(field.by_lamp[l]);
    list.push_back({{"name", lamps.names[l]},
                    {"top", codes.top},
                    {"view", add_bytes(glb, std::as_bytes(std::span(codes.bytes)))}});
  }
  return {{"grouping", lamps.grouping == LampGrouping::node ? "node" : "material"},
          {"list", std::move(list)}};
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
            {"relative_error", solver.relative_error},
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

} // namespace

void write_solution(const std::filesystem::path& file, std::uint64_t scene_hash,
                    const ElementMesh& solved, const RadiositySolution& solution,
                    const MeshSettings& settings) {
  write_whole_file(file, solution_bytes(scene_hash, solved, solution, settings, file.string()));
}

std::vector<std::byte> solution_bytes(std::uint64_t scene_hash, const ElementMesh& solved,
                                      const RadiositySolution& solution,
                                      const MeshSettings& settings, const std::string& name) {
  const ElementMesh& mesh = solution.field.mesh();
  GlbArrays glb;
  auto [root, field, scale] = viewer_scene(glb, solution.field);
  json division = nullptr;
  if (&mesh != &solved) {
    const std::vector<std::uint8_t> divided = division_of(mesh);
    division = add_bytes(glb, std::as_bytes(std::span(divided)));
  }
  json lamps = nullptr;
  if (!solution.field.by_lamp.empty())
    lamps = lamps_json(glb, solution.field);
  json extras = extras_json(scene_hash, mesh, settings, glb.binary);
  extras["field"] = std::move(field);
  extras["display_scale"] = scale;
  if (!division.is_null())
    extras["division"] = std::move(division);
  if (!lamps.is_null())
    extras["lamps"] = std::move(lamps);
  extras["figures"] = figures_json(solution);
  root["asset"] = {{"version", "2.0"},
                   {"generator", fmt::format("Meninas {}", program_version())},
                   {"extras", {{"meninas", std::move(extras)}}}};
  if (!glb.binary.empty()) {
    root["buffers"] = json::array({{{"byteLength", glb.binary.size()}}});
    root["bufferViews"] = std::move(glb.views);
    root["accessors"] = std::move(glb.accessors);
  }
  return glb_bytes(root, glb.binary, name);
}

} // namespace meninas
