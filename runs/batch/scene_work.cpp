#include "runs/batch/scene_work.h"

#include "image/display.h"
#include "runs/outputs.h"
#include "runs/report/page.h"
#include "runs/preparation.h"
#include "runs/report/thumbnail.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

namespace meninas {
namespace {

namespace fs = std::filesystem;

Scene load_planned(const BatchPicture& picture) {
  Scene scene = load_gltf(picture.scene, picture.request.settings.gltf);
  if (content_hash(scene) != picture.facts->hash) {
    throw InputError(picture.scene.string(), "",
                     "has changed since the batch began: run it again with --resume");
  }
  scene = under_background(std::move(scene), picture.request.settings);
  const RunSettings& settings = picture.request.settings;
  return settings.mode == PictureMode::reference ? under_lamps(std::move(scene), settings) : scene;
}

LampsApart lamps_wanted(const BatchPicture& picture) {
  const RunSettings& settings = picture.request.settings;
  return settings.lamp_factors.empty() && !settings.lamp_layers ? LampsApart::no : LampsApart::yes;
}

/// The cached solution, if there is one that can be used.
std::optional<SceneLight> read_light(const fs::path& file, const BatchPicture& picture,
                                     const RunEvents& events) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    return std::nullopt;
  }
  try {
    SceneLight light;
    const PassOneSettings settings = two_pass_settings(picture.request.settings).pass_one;
    light.lit = read_lit_scene(file, load_planned(picture), settings, events, light.figures,
                               lamps_wanted(picture));
    return light;
  } catch (const InputError& problem) {
    if (!std::string(problem.what()).starts_with(file.string())) {
      throw;
    }
    warn(events, fmt::format("{}: solving again", problem.what()));
    return std::nullopt;
  }
}

std::uint64_t rays_of(const RunFigures& figures) {
  const RayCounts& rays = figures.rays;
  return rays.form_factor + rays.shadow + rays.camera + rays.specular + rays.path;
}

ViewPicture view_of(const BatchPicture& picture, const LitScene* light, const RunEvents& events,
                    RunFigures& figures) {
  const RunSettings& settings = picture.request.settings;
  if (light == nullptr) {
    Scene scene = load_planned(picture);
    const Camera camera = cut_open(scene, picture.camera, picture.size, events);
    return render_reference_view(std::move(scene), camera, picture.size, settings, events, figures);
  }
  const Camera camera = cut_open(light->prepared->scene, picture.camera, picture.size, events);
  if (settings.lamp_layers)
    return render_lamp_layers(*light, camera, picture.size, settings, events, figures);
  ViewPicture view =
      lamps_wanted(picture) == LampsApart::no
          ? render_view(*light, camera, picture.size, settings, events, figures)
          : render_view(under_lamps(*light, settings), camera, picture.size, settings, events, figures);
  view.finer.reset();
  return view;
}

void write_outputs(const BatchFolder& folder, const BatchPicture& picture,
                   const ViewPicture& view) {
  std::vector<fs::path> files;
  for (const fs::path& output : picture.outputs) {
    files.push_back(folder.path() / output);
    std::error_code error;
    fs::create_directories(files.back().parent_path(), error);
    if (error) {
      throw OutputError(files.back().parent_path().string(), "",
                        "cannot be made a folder: " + error.message());
    }
  }
  write_pictures(files, {view.image, view.layers, &view.edges, view.unit}, picture.request.picture,
                 view.attributes, {});
}

std::string thumbnail_of(const BatchPicture& picture, const Image& image) {
  constexpr int longest_side = 192;
  const PictureSettings& shown = picture.request.picture;
  return png_address(thumbnail(image, longest_side),
                     {.exposure = shown.exposure ? *shown.exposure : automatic_exposure(image),
                      .transform = shown.transform,
                      .compression = Compression::quick});
}

} // namespace

std::optional<SceneLight> find_light(const BatchFolder& folder, const BatchPicture& picture,
                                     const RunEvents& events) {
  const fs::path file = folder.solution(picture.solution_key);
  if (auto light = read_light(file, picture, events)) {
    return light;
  }
  const auto lock = folder.try_lock_solution(picture.solution_key);
  if (!lock) {
    return std::nullopt;
  }
  // Whoever held the lock before may have just finished.
  if (auto light = read_light(file, picture, {})) {
    return light;
  }
  SceneLight light;
  light.solved = true;
  PassOneSettings settings = two_pass_settings(picture.request.settings).pass_one;
  if (lamps_wanted(picture) == LampsApart::yes)
    settings.lamps = LampGrouping::node;
  light.lit = solve_lit_scene(load_planned(picture), settings, file, events, light.figures);
  return light;
}

PictureResult make_picture(const BatchFolder& folder, const BatchPicture& picture,
                           const LitScene* light, std::shared_timed_mutex& writing,
                           const RunEvents& events) {
  const auto lock = folder.try_lock_picture(picture);
  if (!lock) {
    return {PictureStatus::held, {}};
  }
  if (auto record = folder.done(picture)) {
    return {PictureStatus::found, std::move(*record)};
  }
  Stopwatch watch;
  RunFigures figures;
  const ViewPicture view = view_of(picture, light, events, figures);
  PictureRecord record;
  record.width = view.image.width;
  record.height = view.image.height;
  record.rays = rays_of(figures);
  record.thumbnail = thumbnail_of(picture, view.image);
  const std::shared_lock gate(writing);
  write_outputs(folder, picture, view);
  record.file_hashes = hashes_of(folder.path(), picture.outputs);
  record.seconds = watch.lap();
  folder.keep(picture, record);
  return {PictureStatus::made, std::move(record)};
}

} // namespace meninas
