#include "runs/solve_run.h"

#include "radiosity/transport/factor_file.h"
#include "radiosity/solution/solution_file.h"
#include "radiosity/solvers/solve.h"
#include "raytrace/diffuse_term.h"
#include "runs/points/point_report.h"
#include "runs/steering/memory.h"
#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/resources.h"
#include "runs/run_stages.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace meninas {

/// Beside the solution, unless it is said where.
static std::filesystem::path points_file(const SolveRequest& request) {
  return request.points.out.value_or(
      std::filesystem::path(request.solution).replace_extension(".points.csv"));
}

static std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    files.push_back(entry.path());
  return files;
}

static void check_files(const SolveRequest& request) {
  if (request.shard) {
    make_folder(*request.factors);
    check_outputs({.pictures = {}, .solution = {}, .texts = {part_file(*request.factors, *request.shard)}},
                  {request.scene});
    return;
  }
  OutputFiles outputs{.pictures = {}, .solution = request.solution, .texts = {}};
  for (const auto& text : {request.per_node, request.stats, request.factors}) {
    if (text && !(request.join && text == request.factors)) {
      outputs.texts.push_back(*text);
    }
  }
  std::vector<std::filesystem::path> inputs{request.scene};
  for (const auto& input : {request.reuse, request.points.points}) {
    if (input) {
      inputs.push_back(*input);
    }
  }
  if (request.join) {
    std::ranges::move(files_in(*request.factors), std::back_inserter(inputs));
  }
  if (request.points.asks()) {
    check_points_file(points_file(request));
    outputs.texts.push_back(points_file(request));
  }
  std::ranges::move(files_beside_scene(request.settings), std::back_inserter(inputs));
  check_outputs(outputs, inputs);
}

/// Pass one with form factors that are read or assembled, and kept if asked for.
static RadiositySolution solve_or_relight(const SolveRequest& request,
                                          const std::shared_ptr<const LightScene>& light,
                                          PassOneSettings settings, const RunEvents& events) {
  if (!request.factors && !request.reuse) {
    return solve_pass_one(light, settings, events.progress);
  }
  check_size(settings.solver.method, element_count(light->mesh));
  settings.form_factors.relightable = true;
  const FactorKey key = factor_key(*light, settings.form_factors);
  Stopwatch watch;
  FormFactors factors =
      request.join    ? join_factor_parts(*request.factors, key, element_count(light->mesh))
      : request.reuse ? read_factors(*request.reuse, key, element_count(light->mesh))
                      : assemble_transport(*light, settings.form_factors, events.progress);
  const double seconds = watch.lap();
  if (request.factors && !request.join) {
    write_factors(*request.factors, factors, key);
  }
  RadiositySolution solution = solve_pass_one(light, factors, settings, events.progress);
  solution.seconds.form_factors += seconds;
  return solution;
}

/// Rows of one part, for a run that joins them.
static void write_rows(const SolveRequest& request, const LightScene& light,
                       FormFactorSettings settings, const RunEvents& events) {
  if (settings.method == FormFactorMethod::analytic)
    throw UsageError("--shard", "has no rows by --form-factors analytic: those are of few elements");
  settings.relightable = true;
  FactorPart part = *request.shard;
  part.elements = element_count(light.mesh);
  if (part.count > part.elements)
    throw UsageError("--shard", fmt::format("{} parts are more than the {} elements that there are",
                                            part.count, part.elements));
  const RowRange rows = rows_of_part(part.elements, part.number, part.count);
  write_factor_part(*request.factors, assemble_some_rows(light, rows, settings, events.progress),
                    part, factor_key(light, settings));
  note(events, fmt::format("{}: {} of {} rows", part_file(*request.factors, part).string(),
                           rows.count, part.elements));
}

/// Form factors that are kept or used again are those of a uniform mesh.
static RunSettings with_rows_to_keep(const SolveRequest& request) {
  RunSettings settings = request.settings;
  if (!request.factors && !request.reuse)
    return settings;
  if (settings.mesh == MeshCut::hierarchical)
    throw UsageError("--mesh hierarchical", "has no form factors of elements to keep or reuse");
  settings.mesh = MeshCut::uniform;
  return settings;
}

PointQuerySettings point_query_settings(const PassOneSettings& settings) {
  PointQuerySettings query;
  query.rays = 8 * settings.form_factors.rays;
  query.form_factors = settings.form_factors;
  query.direct.seed = settings.direct.seed;
  return query;
}

static void report_points(const SolveRequest& request, std::vector<PointSet> sets,
                          const RadiositySolution& solution, const PassOneSettings& settings,
                          const RunEvents& events) {
  const SentLight reflected = sent_light(solution.field);
  const auto& lamps = solution.field.scene->lamp_groups;
  std::vector<MeasuredSet> measured;
  for (PointSet& set : sets) {
    auto light = irradiance_at_points(*solution.field.scene, reflected, set.points,
                                      point_query_settings(settings));
    measured.push_back(without_points_inside(
        {std::move(set), std::move(light), request.settings.gltf.state.luminous_efficacy, 0,
         lamps ? lamps->names : std::vector<std::string>{}}));
  }
  measured = without_dark_sides(std::move(measured));
  write_points(points_file(request), measured);
  for (const MeasuredSet& one : measured)
    note(events, summary_line(one));
}

RunFigures solve_run(const SolveRequest& request, const RunEvents& events) {
  if (!request.shard)
    check_files(request);
  std::vector<QueryPoint> points;
  if (request.points.points)
    points = read_points(*request.points.points);
  const ThreadLimit limit(request.settings.threads);
  const RunSettings chosen = with_rows_to_keep(request);
  begin_stages(events, joined(pass_one_stages(chosen), {{"writing", 5.0}}));
  if (events.progress)
    events.progress("scene", 0.0);
  const PassOneSettings settings = two_pass_settings(chosen).pass_one;
  RunFigures figures;
  figures.threads = limit.threads();
  Stopwatch total;
  Stopwatch watch;

  Scene scene = load_scene(request.scene, request.settings);
  if (request.shard)
    check_files(request); // which makes a folder
  check_memory(scene, chosen, std::nullopt, request.shard ? request.shard->count : 1);
  figures.seconds.load = watch.lap();
  const std::uint64_t scene_hash = content_hash(scene);
  const auto prepared = prepare_run(std::move(scene), settings, events, figures);
  if (request.shard) {
    write_rows(request, *prepared->light(), settings.form_factors, events);
    return figures;
  }
  auto sets = point_sets(std::move(points), request.points, prepared->scene, prepared->surfaces);
  const RadiositySolution solution = solve_or_relight(request, prepared->light(), settings, events);
  add_solution(figures, solution);
  warn_of_solution(*prepared, figures.solver, figures.closure, events);

  watch.lap();
  write_solution(request.solution, scene_hash, prepared->mesh, solution, settings.mesh);
  if (request.per_node) {
    const auto nodes = light_by_node(prepared->scene, prepared->mesh, solution);
    write_text_file(*request.per_node,
                    per_node_json(nodes, request.settings.gltf.state.luminous_efficacy));
  }
  if (request.points.asks())
    report_points(request, std::move(sets), solution, settings, events);
  figures.seconds.write = watch.lap();
  figures.seconds.total = total.lap();
  figures.peak_memory_bytes = peak_memory_bytes();
  if (request.stats) {
    write_text_file(*request.stats, stats_json(figures));
  }
  note(events, fmt::format("{}: {} elements in {:.{}f} s", request.solution.string(),
                           figures.elements, figures.seconds.total,
                           figures.seconds.total < 10.0 ? 1 : 0));
  return figures;
}

} // namespace meninas
