#include "runs/report/stats.h"

#include "image/whole_file.h"
#include "runs/steering/expected_cost.h"
#include "runs/steering/setting_options.h"
#include "scenes/photometry.h"

#include <nlohmann/json.hpp>

namespace meninas {
namespace {

/// Keys stay in the order in which they are documented.
using Json = nlohmann::ordered_json;

Json as_json(const Rgb& colour) { return Json::array({colour.r, colour.g, colour.b}); }

/// A name may hold bytes that are no UTF-8: they are replaced, not refused.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

SolverResult without_radiosity(const SolverResult& solver) {
  SolverResult figures = solver;
  figures.radiosity.clear();
  return figures;
}

Json solve_json(const SolverResult& solver, const std::optional<LinkFigures>& links) {
  Json channel_residuals = Json::array(), channel_error_bounds = Json::array();
  for (const Rgb& residual : solver.channel_residuals) {
    channel_residuals.push_back(as_json(residual));
  }
  for (const Rgb& bound : solver.channel_error_bounds) {
    channel_error_bounds.push_back(as_json(bound));
  }
  Json json{{"solver", name_of(solver.method)},
            {"iterations", solver.iterations},
            {"residual", solver.residual},
            {"error_bound", solver.error_bound},
            {"converged", solver.converged},
            {"residuals", solver.residuals},
            {"bands", solver.bands},
            {"channel_residuals", std::move(channel_residuals)},
            {"channel_error_bounds", std::move(channel_error_bounds)}};
  if (links) {
    json["receivers"] = links->receivers;
    json["links"] = links->links;
    json["link_bytes"] = links->bytes;
  }
  return json;
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

WorldFigures world_figures(const TransportPlan& plan) {
  const WorldTree& worlds = plan.worlds;
  return {worlds.considered,        worlds.worlds.size() - 1, worlds.pruned_unseen,
          worlds.pruned_throughput, worlds.pruned_limit,      plan.mirror_depth_bound};
}

Json worlds_json(const WorldFigures& worlds) {
  return {{"considered", worlds.considered},       {"kept", worlds.kept},
          {"pruned_unseen", worlds.pruned_unseen}, {"pruned_throughput", worlds.pruned_throughput},
          {"pruned_limit", worlds.pruned_limit},   {"tail_bound", worlds.tail_bound}};
}

Json energy_json(const EnergyBalance& energy) {
  return {{"emitted", as_json(energy.emitted)},
          {"absorbed", as_json(energy.absorbed)},
          {"escaped", as_json(energy.escaped)},
          {"mirror_absorbed", as_json(energy.mirror_absorbed)},
          {"imbalance", energy.imbalance}};
}

Json seconds_json(const RunSeconds& seconds) {
  return {{"load", seconds.load},     {"plan", seconds.plan},
          {"mesh", seconds.mesh},     {"form_factors", seconds.form_factors},
          {"solve", seconds.solve},   {"interpolate", seconds.interpolate},
          {"render", seconds.render}, {"write", seconds.write},
          {"total", seconds.total}};
}

Json error_json(const PictureError& error) {
  return {{"total", error.total},
          {"mesh", error.mesh},
          {"mesh_direct", error.mesh_direct},
          {"form_factors", error.form_factors},
          {"mirror_tail", error.mirror_tail},
          {"pixels", error.pixels},
          {"solver", error.solver},
          {"mean_radiance", error.mean_radiance},
          {"rays", error.rays},
          {"seconds", error.seconds}};
}

Json choice_json(const SteeredChoice& choice) {
  Json steps = Json::array();
  for (const SteeredStep& step : choice.steps)
    steps.push_back({{"elements", step.elements},
                     {"rays", step.rays},
                     {"samples", step.samples},
                     {"diffuse", name_of(step.term)},
                     {"seconds", step.seconds},
                     {"error", step.error},
                     {"foretold_error", step.foretold > 0.0 ? Json(step.foretold) : Json()},
                     {"why", step.why}});
  return {{"wanted_error", optional_json(choice.wanted_error)},
          {"wanted_seconds", optional_json(choice.wanted_seconds)},
          {"reached", choice.reached},
          {"kept", choice.kept},
          {"options", choice.options},
          {"steps", std::move(steps)}};
}

Json expected_json(const ExpectedCost& cost) {
  return {{"seconds",
           {{"prepare", cost.prepare},
            {"form_factors", cost.form_factors},
            {"solve", cost.solve},
            {"interpolate", cost.interpolate},
            {"render", cost.render},
            {"write", cost.write},
            {"total", cost.total}}},
          {"memory_bytes", cost.bytes}};
}

/// What figures are in, by key or by the nearest key they are below that is here; 1: a share or a ratio.
/// Counts have no entry.
Json units_of_stats() {
  return {{"energy", "W"},
          {"imbalance", "1"},
          {"residual", "1"},
          {"residuals", "1"},
          {"error_bound", "1"},
          {"channel_residuals", "1"},
          {"channel_error_bounds", "1"},
          {"closure", "1"},
          {"tail_bound", "1"},
          {"error_estimate", "1"},
          {"mean_radiance", "W/m^2/sr"},
          {"standard_error", "1"},
          {"wanted_error", "1"},
          {"error", "1"},
          {"foretold_error", "1"},
          {"wanted_seconds", "s"},
          {"seconds", "s"},
          {"peak_memory_bytes", "B"},
          {"link_bytes", "B"}};
}

Json reference_json(const RunFigures& figures) {
  return {{"units", units_of_stats()},
          {"reference",
           {{"samples", figures.reference->samples},
            {"standard_error", figures.reference->standard_error},
            {"stopped_by", stop_name(figures.reference->stopped_by)}}},
          {"rays",
           {{"shadow", figures.rays.shadow},
            {"camera", figures.rays.camera},
            {"path", figures.rays.path}}},
          {"seconds",
           {{"load", figures.seconds.load},
            {"plan", figures.seconds.plan},
            {"render", figures.seconds.render},
            {"write", figures.seconds.write},
            {"total", figures.seconds.total}}},
          {"peak_memory_bytes", figures.peak_memory_bytes},
          {"threads", figures.threads}};
}

} // namespace

const char* stop_name(reference::StoppedBy limit) {
  switch (limit) {
  case reference::StoppedBy::samples:
    return "samples";
  case reference::StoppedBy::error:
    return "error";
  case reference::StoppedBy::time:
    return "time";
  }
  return "";
}

void add_preparation(RunFigures& figures, const PreparedScene& prepared) {
  figures.mirrors = prepared.plan.mirror_list.size();
  figures.mirror_worlds = prepared.plan.worlds.worlds.size() - 1;
  figures.worlds = world_figures(prepared.plan);
  figures.emitters = prepared.plan.emitters;
  figures.bands = prepared.plan.bands;
  figures.surfaces = prepared.surfaces.surfaces.size();
  figures.patches = prepared.surfaces.patches.size();
  figures.elements = figures.solved_elements = element_count(prepared.mesh);
  figures.vertices = prepared.mesh.vertices.size();
  figures.seconds.plan = prepared.seconds.plan;
  figures.seconds.mesh = prepared.seconds.mesh;
}

void add_solution(RunFigures& figures, const RadiositySolution& solution) {
  figures.solver = without_radiosity(solution.solver);
  figures.links = solution.links;
  figures.energy = solution.energy;
  figures.closure = solution.closure;
  figures.elements = element_count(solution.field.mesh());
  figures.vertices = solution.field.mesh().vertices.size();
  figures.rays.form_factor = solution.form_factor_rays;
  figures.rays.shadow = solution.shadow_rays;
  figures.seconds.form_factors = solution.seconds.form_factors;
  figures.seconds.solve = solution.seconds.solve;
  figures.seconds.interpolate = solution.seconds.interpolate;
}

void add_rendering(RunFigures& figures, const Rendering& rendering) {
  figures.rays.camera = rendering.camera_rays;
  figures.rays.specular = rendering.specular_rays;
  figures.rays.shadow += rendering.shadow_rays;
  figures.rays.form_factor += rendering.gather_rays;
}

void add_reference(RunFigures& figures, const reference::ReferencePicture& picture) {
  figures.reference = {picture.samples, picture.standard_error, picture.stopped_by};
  figures.rays.camera = picture.rays.camera_rays;
  figures.rays.shadow = picture.rays.shadow_rays;
  figures.rays.path = picture.rays.path_rays;
}

std::string stats_json(const RunFigures& figures) {
  if (figures.reference) {
    return text_of(reference_json(figures));
  }
  Json json{{"units", units_of_stats()},
            {"plan",
             {{"mirrors", figures.mirrors},
              {"mirror_worlds", figures.mirror_worlds},
              {"worlds", worlds_json(figures.worlds)},
              {"emitters", figures.emitters},
              {"bands", figures.bands}}},
            {"mesh",
             {{"surfaces", figures.surfaces},
              {"patches", figures.patches},
              {"elements", figures.elements},
              {"vertices", figures.vertices},
              {"solved_elements", figures.solved_elements},
              {"cut", name_of(figures.links ? MeshCut::hierarchical : MeshCut::uniform)}}},
            {"solve", solve_json(figures.solver, figures.links)},
            {"energy", energy_json(figures.energy)},
            {"closure",
             {{"mean_error", figures.closure.mean_error},
              {"max_error", figures.closure.max_error},
              {"cut", figures.closure.cut}}},
            {"rays",
             {{"form_factor", figures.rays.form_factor},
              {"shadow", figures.rays.shadow},
              {"camera", figures.rays.camera},
              {"specular", figures.rays.specular}}},
            {"seconds", seconds_json(figures.seconds)},
            {"peak_memory_bytes", figures.peak_memory_bytes},
            {"threads", figures.threads}};
  if (figures.error_estimate)
    json["error_estimate"] = error_json(*figures.error_estimate);
  if (figures.choice)
    json["choice"] = choice_json(*figures.choice);
  return text_of(json);
}

std::string per_node_json(const std::vector<NodeLight>& nodes, double luminous_efficacy) {
  Json list = Json::array();
  for (const NodeLight& node : nodes) {
    list.push_back({{"name", node.name},
                    {"area", node.area},
                    {"emitted", as_json(node.emitted)},
                    {"radiosity", as_json(node.radiosity)},
                    {"irradiance", as_json(node.irradiance)},
                    {"illuminance", luminous(luminous_efficacy, node.irradiance)}});
  }
  const Json units{{"area", "m^2"},
                   {"emitted", "W/m^2"},
                   {"radiosity", "W/m^2"},
                   {"irradiance", "W/m^2"},
                   {"illuminance", "lx"}};
  return text_of(Json{{"units", units}, {"nodes", std::move(list)}});
}

std::string plan_json(const TransportPlan& plan, const std::vector<std::string>& variants,
                      std::size_t patches, std::size_t elements, const ExpectedCost& expected, std::span<const Oddity> odd) {
  Json oddities = Json::array();
  for (const Oddity& one : odd) {
    oddities.push_back({{"kind", one.kind},
                        {"node", one.node},
                        {"other", one.other},
                        {"count", one.count},
                        {"text", one.text}});
  }
  Json mirrors = Json::array();
  for (const PlannedMirror& mirror : plan.mirror_list) {
    mirrors.push_back({{"name", mirror.name},
                       {"area", mirror.area},
                       {"reflectance", as_json(mirror.reflectance)}});
  }
  const Json units{{"area", "m^2"},
                   {"reflectance", "1"},
                   {"tail_bound", "1"},
                   {"seconds", "s"},
                   {"memory_bytes", "B"}};
  const Json json{{"units", units},
                  {"mirrors", std::move(mirrors)},
                  {"mirror_worlds", plan.worlds.worlds.size() - 1},
                  {"worlds", worlds_json(world_figures(plan))},
                  {"emitters", plan.emitters},
                  {"punctual_lights", plan.punctual_lights},
                  {"area_lights", plan.area_lights},
                  {"glossy", plan.glossy},
                  {"transmissive", plan.transmissive},
                  {"textured", plan.textured},
                  {"variants", variants},
                  {"bands", plan.bands},
                  {"closed", plan.closed},
                  {"patches", patches},
                  {"elements", elements},
                  {"expected", expected_json(expected)},
                  {"stages", plan.stages},
                  {"ignored", plan.ignored},
                  {"warnings", plan.warnings},
                  {"odd", std::move(oddities)}};
  return text_of(json);
}

void write_text_file(const std::filesystem::path& file, const std::string& text) {
  write_whole_file(file, std::as_bytes(std::span(text)));
}

} // namespace meninas
