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

constexpr const char* another_room = "The scene has changed meanwhile.";

/// Panoramas are looked at straight ahead.
RunSettings settings_for(const SolvedRoom& room, const RestingView& view) {
  RunSettings settings = room.settings;
  const auto& cameras = room.lit.prepared->scene.cameras;
  const auto named = std::ranges::find_if(cameras, [&](const Camera& camera) { return view.camera == camera.name; });
  if (named != cameras.end() && is_panorama(named->projection))
    settings.projection = Projection::perspective;
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
  if (room != room_)
    kept_ = {};
  room_ = std::move(room);
  ++rooms_;
}

std::shared_ptr<const SolvedRoom> RestingPictures::room() const {
  const std::scoped_lock lock(mutex_);
  return room_;
}

RestingPictures::Newest RestingPictures::newest_of(const std::string& viewer, std::uint64_t number) {
  constexpr std::size_t max_viewers = 32;
  const std::scoped_lock lock(mutex_);
  auto place = std::ranges::find(viewers_, viewer, &Viewer::name);
  if (place == viewers_.end()) {
    if (viewers_.size() == max_viewers)
      viewers_.pop_front();
    viewers_.push_back({viewer, std::make_shared<std::atomic<std::uint64_t>>(number)});
  } else
    std::rotate(place, place + 1, viewers_.end());
  const auto& newest = viewers_.back().number;
  if (*newest < number)
    *newest = number;
  turns_.notify_all();
  return newest;
}

void RestingPictures::moved(const std::string& viewer, std::uint64_t number) { newest_of(viewer, number); }

bool RestingPictures::wait_for_turn(const RestingView& view, const Newest& newest) {
  constexpr std::size_t max_waiting = 4;
  std::unique_lock lock(mutex_);
  if (is_rendering_) {
    // Those that its viewer has moved on from leave in any case.
    std::erase_if(waiting_, [&](const auto& one) { return one.first == view.viewer && one.second < view.number; });
    if (std::ranges::find(waiting_, view.viewer, [](const auto& one) { return one.first; }) != waiting_.end())
      throw NoPictureNow{"A picture of this page is waited for already."};
    if (waiting_.size() >= max_waiting)
      throw NoPictureNow{"Other pages wait for pictures: try again later."};
    const std::pair mine{view.viewer, view.number};
    waiting_.push_back(mine);
    turns_.wait(lock, [&] { return !is_rendering_ || *newest > view.number; });
    std::erase(waiting_, mine);
  }
  if (*newest > view.number)
    return false;
  is_rendering_ = true;
  return true;
}

void RestingPictures::done() {
  const std::scoped_lock lock(mutex_);
  is_rendering_ = false;
  turns_.notify_all();
}

std::shared_ptr<const ViewPicture> RestingPictures::rendered(const std::shared_ptr<const SolvedRoom>& room, const RestingView& seen,
                                                             const RunSettings& settings, const Newest& newest) {
  const std::uint64_t rooms = rooms_;
  if (this->room() != room)
    throw NoPictureNow{another_room};
  RunFigures figures;
  RunEvents events;
  events.progress = [&](std::string_view, double) {
    if (*newest > seen.number || rooms_ != rooms)
      throw MovedOn{};
  };
  try {
    return std::make_shared<const ViewPicture>(
        render_view(room->lit, camera_of(*room, seen), seen.size, settings, events, figures));
  } catch (const MovedOn&) {
    if (rooms_ != rooms)
      throw NoPictureNow{another_room};
    return nullptr;
  }
}

std::optional<std::vector<std::byte>> RestingPictures::picture(const RestingView& view, RestingStep step,
                                                               PictureFormat format) {
  constexpr int coarser = 3, max_samples = 4;
  const auto newest = newest_of(view.viewer, view.number);
  if (!wait_for_turn(view, newest))
    return std::nullopt;
  const auto turn = std::shared_ptr<void>(nullptr, [this](void*) { done(); });
  const auto room = this->room();
  if (!room)
    throw NoPictureNow{not_solved_yet};
  RestingView seen = view;
  RunSettings settings = settings_for(*room, view);
  PictureSettings written = room->picture;
  written.exposure = view.exposure;
  if (step == RestingStep::coarse) {
    seen.size = {std::max(1, view.size.width / coarser), std::max(1, view.size.height / coarser)};
    settings.samples = std::min(max_samples, two_pass_settings(settings).render.samples);
    settings.pixel_error.reset();
  }
  std::shared_ptr<const ViewPicture> picture;
  const std::string key = key_of(seen);
  if (const std::scoped_lock lock(mutex_); step == RestingStep::whole && kept_.room == room && kept_.view == key)
    picture = kept_.picture;
  if (!picture)
    picture = rendered(room, seen, settings, newest);
  if (!picture)
    return std::nullopt;
  if (const std::scoped_lock lock(mutex_); room_ != room)
    throw NoPictureNow{another_room};
  else if (step == RestingStep::whole)
    kept_ = {key, room, picture};
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
  const std::string solution = name + "-solved.glb"; // NAME.glb may be the scene itself
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
    render.insert(render.end(), {"--solution", solution});
  render.insert(render.end(), {"-o", name + ".exr", "-o", name + ".png"});
  solve.insert(solve.end(), {"-o", solution});
  return from_solution ? line_of(solve) + " && " + line_of(render) : line_of(render);
}

} // namespace meninas
