#include "runs/compare_run.h"

#include "image/display.h"
#include "image/image_file.h"
#include "image/whole_file.h"
#include "raytrace/pixels/sample_choice.h"
#include "runs/report/compare_report.h"
#include "runs/report/page.h"
#include "runs/report/picture_units.h"
#include "runs/steering/memory.h"
#include "runs/steering/setting_options.h"
#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/reference_run.h"
#include "runs/report/percent.h"
#include "runs/resources.h"
#include "runs/run_stages.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

namespace meninas {
namespace {

namespace fs = std::filesystem;

/// Both modes of the two passes, from one solve.
void compare_passes(const PreparedScene& prepared, const Camera& camera, TwoPassSettings settings,
                    const RunEvents& events, RunFigures& figures, Comparison& comparison) {
  Stopwatch watch;
  const RadiositySolution solution =
      solve_pass_one(prepared.light(), settings.pass_one, events.progress);
  warn_of_solution(prepared, solution.solver, solution.closure, events);
  add_solution(figures, solution);
  const double pass_one = watch.lap();

  const auto picture = [&](RenderMode mode) {
    settings.render.mode = mode;
    return render(solution.field, camera, settings.render, events.progress).image;
  };
  Image radiosity = picture(RenderMode::radiosity);
  const double radiosity_seconds = pass_one + watch.lap();
  Image hybrid = picture(RenderMode::hybrid);
  const double hybrid_seconds = pass_one + watch.lap();
  comparison.modes.push_back({"radiosity", "radiosity only", "mirrors are black",
                              std::move(radiosity), radiosity_seconds});
  comparison.modes.push_back(
      {"hybrid", "hybrid", "both passes", std::move(hybrid), hybrid_seconds});
  comparison.layers =
      render_layers(solution.field, camera, settings.render, events.progress).layers;
}

void write_modes(const fs::path& folder, const Comparison& comparison) {
  for (const ComparedMode& mode : comparison.modes) {
    const Attributes attributes{
        {"scene", comparison.scene}, {"camera", comparison.camera}, {"mode", mode.id}};
    const auto layers = mode.id == "hybrid" ? std::span<const Layer>(comparison.layers) : std::span<const Layer>();
    write_exr(folder / (mode.id + ".exr"), mode.image, layers, PixelType::half,
              with_units(attributes, unit_of_radiance, layers));
    write_png(folder / (mode.id + ".png"), mode.image,
              {.exposure = comparison.exposure, .transform = comparison.transform});
  }
  for (const DifferencePicture& difference : difference_pictures(comparison)) {
    write_png(folder / (difference.name + ".png"), difference.image, 0.0);
  }
}

std::string samples_of(const RenderSettings& render) {
  const int least = first_samples(render).count;
  return least < render.samples ? fmt::format("{} to {}", least, render.samples) : fmt::format("{}", least);
}

std::vector<std::pair<std::string, std::string>> settings_of(const TwoPassSettings& settings,
                                                             const RunFigures& figures) {
  return {{"elements", fmt::format("{}", figures.elements)},
          {"form-factor rays per element", fmt::format("{}", settings.pass_one.form_factors.rays)},
          {"camera rays per pixel", samples_of(settings.render)},
          {"mirrors", fmt::format("{}", figures.mirrors)},
          {"mirror worlds", fmt::format("{}", figures.mirror_worlds)},
          {"energy imbalance", fmt::format("{:.2g}", figures.energy.imbalance)},
          {"threads", fmt::format("{}", figures.threads)}};
}

std::string command_of(const CompareRequest& request) {
  std::string command = "meninas compare " + shell_quoted(request.scene.string()) + " -o " +
                        shell_quoted(request.folder.string());
  const auto add = [&](const char* option, const auto& value) {
    if (value)
      command += fmt::format(" {} {}", option, *value);
  };
  if (request.camera)
    command += " --camera " + shell_quoted(*request.camera);
  if (request.size)
    command += fmt::format(" --size {}x{}", request.size->width, request.size->height);
  add("--exposure", request.exposure);
  if (request.transform != ViewTransform::neutral)
    command += fmt::format(" --view-transform {}", name_of(request.transform));
  if (request.reference == WithReference::yes)
    command += " --reference";
  add("--max-error", request.settings.max_error);
  add("--max-seconds", request.settings.max_seconds);
  for (const std::string& option : options_of(request.settings))
    command += ' ' + shell_quoted(option);
  return command;
}

/// Pass one, three pictures of it, and the path tracer's.
std::vector<RunStage> stages_of(const CompareRequest& request) {
  std::vector<RunStage> pictures(3, {"render", 25.0});
  if (request.reference == WithReference::yes)
    pictures.push_back({"paths", 300.0});
  pictures.push_back({"writing", 5.0});
  return joined(pass_one_stages(request.settings), pictures);
}

} // namespace

void compare_run(const CompareRequest& request, const RunEvents& events) {
  make_folder(request.folder);
  check_writable_file(request.folder / "index.html");
  const ThreadLimit limit(request.settings.threads);
  begin_stages(events, stages_of(request));
  if (events.progress)
    events.progress("scene", 0.0);
  RunFigures figures;
  figures.threads = limit.threads();

  Scene scene = load_scene(request.scene, request.settings);
  const Camera chosen = choose_camera(scene, request.camera, request.settings, events);
  const PictureSize size = choose_size(request.size, chosen);
  const Camera camera = cut_open(scene, chosen, size, events);
  check_memory(scene, request.settings, size);
  Comparison comparison;
  comparison.scene = request.scene.filename().string();
  comparison.camera = camera.name;

  // Mirrors alone are to tell the two modes apart.
  RunSettings of_both = request.settings;
  of_both.diffuse = DiffuseTerm::interpolated;
  TwoPassSettings settings = two_pass_settings(of_both);
  settings.pass_one.interpolation.method = Interpolation::gather; // knows what mirrors brought
  settings.render.width = size.width;
  settings.render.height = size.height;
  std::optional<Scene> for_reference;
  if (request.reference == WithReference::yes) {
    for_reference = scene;
  }
  const auto prepared = prepare_run(std::move(scene), settings.pass_one, events, figures);
  compare_passes(*prepared, camera, settings, events, figures, comparison);

  if (for_reference) {
    reference::ReferenceSettings limits = reference_settings(request.settings);
    limits.width = size.width;
    limits.height = size.height;
    limits.layers = WithLayers::yes;
    RunFigures own;
    auto picture = run_reference(std::move(*for_reference), camera, limits, events, own);
    comparison.modes.push_back(
        {"reference", "reference",
         fmt::format("path tracer, {} noise", readable_percent(picture.standard_error)),
         std::move(picture.mean), own.seconds.render});
    comparison.reference = std::move(picture.batches);
  }

  comparison.transform = request.transform;
  comparison.exposure =
      request.exposure ? *request.exposure : automatic_exposure(comparison.modes.back().image);
  comparison.command = command_of(request);
  comparison.settings = settings_of(settings, figures);
  write_modes(request.folder, comparison);
  write_text_file(request.folder / "figures.json", compare_json(comparison));
  write_text_file(request.folder / "index.html", compare_page_of(comparison));
  note(events, fmt::format("open {}", (request.folder / "index.html").string()));
}

} // namespace meninas
