#include "runs/render_run.h"

#include "runs/parts/tile_file.h"
#include "runs/steering/memory.h"
#include "runs/preparation.h"
#include "runs/resources.h"
#include "runs/run_stages.h"
#include "runs/view.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace meninas {
namespace {

void check_files(const RenderRequest& request) {
  OutputFiles outputs{.pictures = request.pictures, .solution = {}, .texts = {}};
  std::vector<std::filesystem::path> inputs{request.scene};
  if (request.stats) {
    outputs.texts.push_back(*request.stats);
  }
  if (request.solution) {
    inputs.push_back(*request.solution);
  }
  std::ranges::move(files_beside_scene(request.settings), std::back_inserter(inputs));
  check_outputs(outputs, inputs);
  if (request.snapshots) {
    prepare_snapshots(*request.snapshots);
  }
}

/// What nobody reads is not found out. A further view of a solution takes less time than its error.
ErrorReport wanted_report(const RenderRequest& request, const RunEvents& events) {
  if (request.settings.part)
    return ErrorReport::none; // of whole pictures
  if (request.error_map == WithErrorMap::yes)
    return ErrorReport::map;
  const bool is_read = events.note && !request.solution;
  return request.stats || is_read ? ErrorReport::figures : ErrorReport::none;
}

/// Both passes, timed.
Rendering run_two_pass(const PreparedScene& prepared, const Camera& camera,
                       const TwoPassSettings& settings, const RenderRequest& request,
                       const RunEvents& events, RunFigures& figures) {
  Stopwatch watch;
  PassOneWatch along_the_way;
  if (request.snapshots) {
    along_the_way = snapshot_watch(*request.snapshots, prepared, camera, settings.render,
                                   request.pictures, request.picture);
  }
  TwoPassResult result = two_pass(prepared, camera, settings, events.progress, along_the_way);
  add_solution(figures, result.solution);
  add_rendering(figures, result.rendering);
  const PassOneSeconds& pass_one = result.solution.seconds;
  figures.seconds.render =
      watch.lap() - pass_one.form_factors - pass_one.solve - pass_one.interpolate;
  report_error({result.solution.field, camera, settings, result.solution.solver},
               wanted_report(request, events),
               {result.rendering.image, result.rendering.samples, result.rendering.finer.get()},
               result.rendering.layers, events, figures);
  result.rendering.finer.reset();
  return std::move(result.rendering);
}

/// Throws InputError where the field does not know what the picture builds on.
void check_field(const std::filesystem::path& solution, const IrradianceField& field,
                 const RenderSettings& settings) {
  if (settings.layers == WithLayers::yes && field.mirrored.empty()) {
    throw InputError(solution.string(), "",
                     "does not know what mirrors brought: solve again with --interpolation gather");
  }
  if (settings.diffuse.term == DiffuseTerm::direct && field.indirect.empty()) {
    throw InputError(solution.string(), "",
                     "does not know its light without that of emitters, which --diffuse direct "
                     "builds on: solve again with --interpolation gather");
  }
}

/// That nothing emits light is said by the plan.
bool has_light(const Scene& scene) {
  return !scene.lights.empty() || !scene.area_lights.empty() || !is_dark(scene.background) ||
         std::ranges::any_of(scene.materials, is_emitter);
}

/// Nobody should have to guess why there is nothing to see.
void warn_of_darkness(const Image& image, const Camera& camera, const RunEvents& events) {
  if (std::ranges::all_of(image.pixels, [](const glm::vec3& p) { return p == glm::vec3(0.0F); })) {
    warn(events,
         fmt::format("the picture is black: no light reaches what camera '{}' sees; `meninas "
                     "plan` says what is odd about the scene",
                     camera.name));
  }
}

/// The stored solution, with lamps as bright as is asked for.
LitScene read_shown_scene(const RenderRequest& request, Scene scene, const PassOneSettings& settings,
                          const RunEvents& events, RunFigures& figures) {
  const auto& given = request.settings.lamp_factors;
  const bool apart = !given.empty() || request.settings.lamp_layers;
  const LitScene lit = read_lit_scene(*request.solution, std::move(scene), settings, events, figures,
                                apart ? LampsApart::yes : LampsApart::no);
  return given.empty() || request.settings.lamp_layers ? lit : under_lamps(lit, request.settings);
}

} // namespace

ViewPicture picture_of_solution(const RenderRequest& request, const LitScene& lit,
                                const Camera& camera, PictureSize size, const RunEvents& events,
                                RunFigures& figures) {
  const RunSettings known = settled(request.settings, lit.field);
  TwoPassSettings settings = two_pass_settings(known);
  settings.render = render_settings(known, size);
  const auto report = [&](const IrradianceField& field, ViewPicture& picture) {
    report_error({field, camera, settings, figures.solver}, wanted_report(request, events),
                 {picture.image, picture.samples, picture.finer.get()}, picture.layers, events,
                 figures);
  };
  if (known.lamp_layers) {
    ViewPicture picture = render_lamp_layers(lit, camera, size, known, events, figures);
    report(under_lamps(lit, known).field, picture);
    return picture;
  }
  if (known.view)
    return render_view(lit, camera, size, known, events, figures);
  check_field(request.solution.value_or("the solution"), lit.field, settings.render);
  ViewPicture picture = render_view(lit, camera, size, known, events, figures);
  report(lit.field, picture);
  picture.finer.reset();
  return picture;
}

static ViewPicture render_two_pass(const RenderRequest& request, Scene scene, const Camera& camera,
                                   PictureSize size, const RunEvents& events, RunFigures& figures) {
  TwoPassSettings settings = two_pass_settings(request.settings);
  settings.render = render_settings(request.settings, size);
  if (request.settings.lamp_layers)
    settings.pass_one.lamps = LampGrouping::node;
  if (request.solution || request.settings.lamp_layers || request.settings.view) {
    const LitScene lit = request.solution ? read_shown_scene(request, std::move(scene),
                                                             settings.pass_one, events, figures)
                                          : solve_lit_scene(std::move(scene), settings.pass_one,
                                                            std::nullopt, events, figures);
    return picture_of_solution(request, lit, camera, size, events, figures);
  }
  const auto prepared = prepare_run(std::move(scene), settings.pass_one, events, figures);
  const RunSettings known = settled(request.settings, *prepared->light());
  settings.render = render_settings(known, size);
  Rendering rendering = run_two_pass(*prepared, camera, settings, request, events, figures);
  warn_of_solution(*prepared, figures.solver, figures.closure, events);
  return picture_of(prepared->scene, camera, known, std::move(rendering));
}

namespace {

/// What is left to do once there is a picture.
double seconds_to_write(PictureSize size) {
  constexpr double at_least = 0.01, a_pixel = 2e-7; // of EXR and PNG
  return at_least + a_pixel * size.width * size.height;
}

/// "room.exr, room.png: 640x480 in 1.2 s, about 0.9 % off (mesh 0.8 %)".
std::string closing_line(const std::vector<std::filesystem::path>& pictures, PictureSize size,
                         const RunFigures& figures) {
  std::string names;
  for (const auto& picture : pictures)
    names += (names.empty() ? "" : ", ") + picture.string();
  return fmt::format("{}: {}x{} in {:.{}f} s{}{}", names, size.width, size.height,
                     figures.seconds.total, figures.seconds.total < 10.0 ? 1 : 0,
                     figures.closing.empty() ? "" : ", ", figures.closing);
}

} // namespace

RequestedPicture requested_picture(const RenderRequest& request, Scene scene, const RunEvents& events,
                                   RunFigures& figures) {
  const bool is_lit = has_light(scene);
  const Camera chosen = request.place ? camera_at(*request.place, request.settings)
                                      : choose_camera(scene, request.camera, request.settings, events);
  const PictureSize size = choose_size(request.size, chosen);
  const Camera camera = cut_open(scene, chosen, size, events);
  check_memory(scene, request.settings, size);
  const auto render_picture = [&] {
    if (request.settings.mode == PictureMode::reference)
      return render_reference_view(std::move(scene), camera, size, request.settings, events,
                                   figures);
    if (request.goal)
      return steer({scene, camera, size, request.settings, *request.goal, figures.seconds.load,
                    seconds_to_write(size)},
                   events, figures);
    return render_two_pass(request, std::move(scene), camera, size, events, figures);
  };
  RequestedPicture result{render_picture(), size, camera};
  if (is_lit && !request.settings.part)
    warn_of_darkness(result.picture.image, camera, events);
  return result;
}

RunFigures render_run(const RenderRequest& request, const RunEvents& events) {
  check_files(request);
  const ThreadLimit limit(request.settings.threads);
  begin_stages(events, picture_stages(request.settings,
                                      request.solution ? WithPassOne::no : WithPassOne::yes));
  if (events.progress)
    events.progress("scene", 0.0);
  RunFigures figures;
  figures.threads = limit.threads();
  Stopwatch total;
  Stopwatch watch;

  const bool lamps_later = request.solution || request.settings.lamp_layers;
  Scene scene = lamps_later ? load_scene(request.scene, request.settings)
                            : load_relit_scene(request.scene, request.settings);
  figures.seconds.load = watch.lap();
  const auto [picture, size, camera] = requested_picture(request, std::move(scene), events, figures);
  watch.lap();
  if (request.settings.part)
    write_tile(request.pictures.front(), picture,
               {camera, request.settings, request.solution, request.picture});
  else
    write_pictures(request.pictures, {picture.image, picture.layers, &picture.edges, picture.unit}, request.picture,
                   picture.attributes, events);
  figures.seconds.write = watch.lap();
  figures.seconds.total = total.lap();
  figures.peak_memory_bytes = peak_memory_bytes();
  if (request.stats) {
    write_text_file(*request.stats, stats_json(figures));
  }
  note(events, closing_line(request.pictures, size, figures));
  return figures;
}

} // namespace meninas
