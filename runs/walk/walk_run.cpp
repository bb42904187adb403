#include "runs/walk/walk_run.h"

#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/report/stats.h"
#include "runs/resources.h"
#include "runs/run_stages.h"
#include "runs/steering/memory.h"
#include "runs/view.h"
#include "runs/walk/walk_cameras.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace meninas {

namespace {

void check_files(const WalkRequest& request) {
  OutputFiles outputs{.pictures = {}, .solution = {}, .texts = {request.page}};
  std::vector<std::filesystem::path> inputs{request.scene};
  if (request.solution)
    inputs.push_back(*request.solution);
  std::ranges::move(files_beside_scene(request.settings), std::back_inserter(inputs));
  check_outputs(outputs, inputs);
  const std::string extension = request.page.extension().string();
  if (extension != ".html" && extension != ".htm")
    throw OutputError(request.page.string(), "", "cannot write: a page is an .html file");
}

/// Without lamps apart the scene is solved with lamps as bright as they are asked for.
Scene scene_of(const WalkRequest& request) {
  if (!request.settings.lamps && !request.solution)
    return load_relit_scene(request.scene, request.settings);
  Scene scene = load_scene(request.scene, request.settings);
  // Before the work, which finds the suns of the sky as well.
  if (request.settings.lamps) {
    const LampGroups groups = find_lamps(scene, *request.settings.lamps);
    check_walk_lamps(scene.file, groups.size(), 0);
    // The suns of a file's sky are not known yet.
    if (!scene.background.encoded)
      factors_of_lamps(groups.names, request.settings.lamp_factors);
  }
  return scene;
}

/// Lamps are told apart where they are asked for, or where the solution knows them.
LitScene lit_scene(const WalkRequest& request, Scene scene, const RunEvents& events,
                   RunFigures& figures) {
  const PassOneSettings settings = two_pass_settings(request.settings).pass_one;
  const auto wanted = request.settings.lamp_factors.empty() ? LampsApart::if_known : LampsApart::yes;
  return request.solution
             ? read_lit_scene(*request.solution, std::move(scene), settings, events, figures, wanted)
             : solve_lit_scene(std::move(scene), settings, std::nullopt, events, figures);
}

/// A solution's lamps that nobody has asked for are left out where a page would have too many.
void leave_out_unasked_lamps(const WalkRequest& request, const RunEvents& events, LitScene& lit) {
  const std::size_t lamps = lit.field.by_lamp.size(), vertices = lit.field.mesh().vertices.size();
  const bool asked = !request.solution || !request.settings.lamp_factors.empty();
  if (asked || (lamps <= max_walk_lamps && lamps * vertices <= max_lamp_vertices))
    return;
  warn(events, fmt::format("the page has no dimmers: the solution has {} lamps at {} vertices", lamps, vertices));
  lit.field.by_lamp.clear();
}

/// As bright as they are asked for before anybody dims them.
std::vector<WalkLamp> lamps_of(const LitScene& lit, const WalkRequest& request) {
  std::vector<WalkLamp> lamps;
  if (lit.field.by_lamp.empty())
    return lamps;
  const auto& names = lit.field.scene->lamp_groups->names;
  const std::vector<Rgb> factors = factors_of_lamps(names, request.settings.lamp_factors);
  for (std::size_t l = 0; l < names.size(); ++l)
    lamps.push_back({names[l], factors[l]});
  return lamps;
}

} // namespace

RunFigures walk_run(const WalkRequest& request, const RunEvents& events) {
  check_files(request);
  const ThreadLimit limit(request.settings.threads);
  begin_stages(events, joined(pass_one_stages(request.settings), {{"writing", 5.0}}));
  if (events.progress)
    events.progress("scene", 0.0);
  RunFigures figures;
  figures.threads = limit.threads();
  Stopwatch total, watch;

  Scene scene = scene_of(request);
  check_memory(scene, request.settings, std::nullopt);
  figures.seconds.load = watch.lap();
  LitScene lit = lit_scene(request, std::move(scene), events, figures);
  leave_out_unasked_lamps(request, events, lit);

  watch.lap();
  const WalkRoom room = walk_room(lit.field);
  const std::vector<WalkLamp> lamps = lamps_of(lit, request);
  std::vector<std::string> warnings;
  const std::string html =
      walk_page_html({.field = lit.field,
                      .room = room,
                      .title = request.scene.filename().string(),
                      .cameras = walk_cameras(lamps.empty() ? lit.field : under_lamps(lit, request.settings).field,
                                              request.settings, request.exposure),
                      .transform = request.transform,
                      .luminous_efficacy = request.settings.gltf.state.luminous_efficacy,
                      .lamps = lamps},
                     warnings);
  for (const std::string& warning : warnings)
    warn(events, warning);
  write_text_file(request.page, html);
  figures.seconds.write = watch.lap();
  figures.seconds.total = total.lap();
  figures.peak_memory_bytes = peak_memory_bytes();
  const std::string dimmers = lamps.empty() ? "" : fmt::format("dimmers for {} lamps, ", lamps.size());
  note(events, fmt::format("{}: {} triangles, {}{:.1f} MB in {:.1f} s", request.page.string(),
                           room.indices.size() / 3, dimmers, double(html.size()) * 1e-6,
                           figures.seconds.total));
  return figures;
}

} // namespace meninas
