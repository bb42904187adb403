#include "runs/live/resting_pictures.h"

#include "runs/report/page.h"
#include "runs/steering/setting_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace meninas {

namespace {

/// Thrown where a picture tells its progress, to end it.
struct MovedOn {};

/// Panoramas are looked at straight ahead.
RunSettings settings_for(const SolvedRoom& room, const RestingView& view) {
  RunSettings settings = room.settings;
  const auto& cameras = room.lit.prepared->scene.cameras;
  const auto named = std::ranges::find_if(cameras, [&](const Camera& camera) { return view.camera == camera.name; });
  if (named != cameras.end() && is_panorama(named->projection))
    settings.projection = Projection::perspective;
  if (!settings.diffuse && room.lit.field.indirect.empty())
    settings.diffuse = DiffuseTerm::interpolated;
  settings.display = DisplayChoice{view.exposure, room.picture.transform};
  return settings;
}

std::string key_of(const RestingView& view) {
  const FreeCamera& at = view.place;
  return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}x{}|{}", view.camera.value_or(""), view.camera.has_value(), at.eye.x,
                     at.eye.y, at.eye.z, fmt::format("{},{},{}", at.target.x, at.target.y, at.target.z),
                     at.angle.value_or(0.0), view.size.width, view.size.height, view.exposure);
}

std::string point_text(const Point3& x) { return fmt::format("{},{},{}", x.x, x.y, x.z); }

} // namespace

Camera camera_of(const SolvedRoom& room, const RestingView& view) {
  const RunSettings settings = settings_for(room, view);
  const Scene& scene = room.lit.prepared->scene;
  const Camera chosen = view.camera ? choose_camera(scene, view.camera, settings, {}) : camera_at(view.place, settings);
  return cut_open(scene, chosen, view.size, {});
}

void RestingPictures::show(std::shared_ptr<const SolvedRoom> room) {
  const std::scoped_lock lock(mutex_);
  room_ = std::move(room);
  kept_ = {};
}

std::shared_ptr<const SolvedRoom> RestingPictures::room() const {
  const std::scoped_lock lock(mutex_);
  return room_;
}

std::shared_ptr<const std::atomic<std::uint64_t>> RestingPictures::newest_of(const std::string& viewer,
                                                                            std::uint64_t number) {
  constexpr std::size_t most_viewers = 32;
  const std::scoped_lock lock(mutex_);
  auto place = std::ranges::find(viewers_, viewer, &Viewer::name);
  if (place == viewers_.end()) {
    if (viewers_.size() == most_viewers)
      viewers_.pop_front();
    viewers_.push_back({viewer, std::make_shared<std::atomic<std::uint64_t>>(number)});
    place = viewers_.end() - 1;
  }
  if (*place->number < number)
    *place->number = number;
  return place->number;
}

void RestingPictures::moved(const std::string& viewer, std::uint64_t number) { newest_of(viewer, number); }

std::optional<std::vector<std::byte>> RestingPictures::picture(const RestingView& view, RestingStep step,
                                                               PictureFormat format) {
  constexpr int coarser = 3, few_samples = 4;
  const auto newest = newest_of(view.viewer, view.number);
  const std::scoped_lock one_at_a_time(rendering_);
  const auto room = this->room();
  if (!room || *newest > view.number)
    return std::nullopt;
  RestingView seen = view;
  RunSettings settings = settings_for(*room, view);
  PictureSettings written = room->picture;
  written.exposure = view.exposure;
  if (step == RestingStep::coarse) {
    seen.size = {std::max(1, view.size.width / coarser), std::max(1, view.size.height / coarser)};
    settings.samples = std::min(few_samples, two_pass_settings(settings).render.samples);
    settings.pixel_error.reset();
  }
  std::shared_ptr<const ViewPicture> picture;
  if (const std::string key = key_of(seen); step == RestingStep::whole) {
    const std::scoped_lock lock(mutex_);
    if (kept_.room == room && kept_.view == key)
      picture = kept_.picture;
  }
  if (!picture) {
    RunFigures figures;
    RunEvents events;
    events.progress = [&](std::string_view, double) {
      if (*newest > view.number)
        throw MovedOn{};
    };
    try {
      picture = std::make_shared<const ViewPicture>(
          render_view(room->lit, camera_of(*room, seen), seen.size, settings, events, figures));
    } catch (const MovedOn&) {
      return std::nullopt;
    }
    if (step == RestingStep::whole) {
      const std::scoped_lock lock(mutex_);
      kept_ = {key_of(seen), room, picture};
    }
  }
  return picture_bytes(format, {picture->image, picture->layers, &picture->edges}, written, picture->attributes);
}

namespace {

/// Options with their values.
using OptionWords = std::vector<std::vector<std::string>>;

OptionWords in_options(const std::vector<std::string>& words) {
  OptionWords options;
  for (const std::string& word : words) {
    if (word.starts_with("--") || options.empty())
      options.emplace_back();
    options.back().push_back(word);
  }
  return options;
}

/// Of one pass alone: the other refuses them.
bool is_of_pass_one(const std::string& option) {
  static const std::set<std::string> options{"--element-size", "--elements", "--form-factors", "--rays",
                                             "--hemicube-resolution", "--solver", "--tolerance", "--steps",
                                             "--link-error", "--interpolation", "--bends", "--mesh"};
  return options.contains(option);
}
bool is_of_pass_two(const std::string& option) {
  static const std::set<std::string> options{"--projection", "--mode", "--diffuse", "--samples",
                                             "--filter", "--pixel-error", "--glossy-samples"};
  return options.contains(option);
}

std::string line_of(std::vector<std::string> words) {
  for (std::string& word : words)
    word = shell_quoted(word);
  return fmt::format("{}", fmt::join(words, " "));
}

void add_place(const RestingView& view, std::vector<std::string>& words) {
  if (view.camera) {
    words.insert(words.end(), {"--camera", *view.camera});
    return;
  }
  // Numbers may begin with a minus.
  words.push_back("--eye=" + point_text(view.place.eye));
  words.push_back("--target=" + point_text(view.place.target));
  if (view.place.angle)
    words.push_back(fmt::format("--angle={}", *view.place.angle));
}

} // namespace

std::string command_of(const SolvedRoom& room, const RestingView& view, const std::string& name) {
  const RunSettings settings = settings_for(room, view);
  const bool from_solution = solves_for_view(*room.lit.prepared, two_pass_settings(settings));
  std::vector<std::string> solve{"meninas", "solve", room.scene.string()}, render{"meninas", "render", room.scene.string()};
  if (settings.gltf.external_files == ExternalFiles::anywhere)
    for (auto* words : {&solve, &render})
      words->emplace_back("--allow-external");
  for (const auto& option : in_options(options_of(settings))) {
    if (!is_of_pass_two(option.front()))
      solve.insert(solve.end(), option.begin(), option.end());
    if (!from_solution || !is_of_pass_one(option.front()))
      render.insert(render.end(), option.begin(), option.end());
  }
  add_place(view, render);
  render.insert(render.end(), {"--size", fmt::format("{}x{}", view.size.width, view.size.height),
                               fmt::format("--exposure={}", view.exposure)});
  if (room.picture.transform != ViewTransform::neutral)
    render.insert(render.end(), {"--view-transform", std::string(name_of(room.picture.transform))});
  if (from_solution)
    render.insert(render.end(), {"--solution", name + ".glb"});
  render.insert(render.end(), {"-o", name + ".exr", "-o", name + ".png"});
  solve.insert(solve.end(), {"-o", name + ".glb"});
  return from_solution ? line_of(solve) + " && " + line_of(render) : line_of(render);
}

} // namespace meninas
