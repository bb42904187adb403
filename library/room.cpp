#include "library/impl.h"

#include "runs/plan_run.h"
#include "runs/resources.h"
#include "scenes/errors.h"
#include "scenes/lamps.h"
#include "raytrace/scene_textures.h"
#include "scenes/version.h"

namespace meninas {

void check_reading(const Room::Impl& room, const RunSettings& settings) {
  const RunSettings& loaded = room.loaded;
  if (settings.gltf.scene != loaded.gltf.scene || settings.gltf.state != loaded.gltf.state ||
      settings.gltf.external_files != loaded.gltf.external_files ||
      settings.background != loaded.background || settings.environment != loaded.environment)
    throw UsageError("", "how the scene is read, and what surrounds it, is said where the room is loaded");
}

/// The scene under the lamps of a call, unless they come later.
static Scene scene_of(const Room::Impl& room, const RunSettings& settings) {
  return settings.lamp_layers ? room.scene : under_lamps(room.scene, settings);
}

Room::Room(const std::filesystem::path& file, const Settings& settings, const Listener& listener) {
  guarded([&] {
    auto impl = std::make_shared<Impl>();
    impl->file = file;
    impl->settings = settings;
    impl->loaded = call_of(*impl, {}).request.settings;
    impl->scene = load_scene(file, impl->loaded);
    for (const std::string& warning : impl->scene.warnings)
      if (listener.warning)
        listener.warning(warning);
    impl_ = std::move(impl);
  });
}

std::vector<std::string> Room::cameras() const {
  std::vector<std::string> names;
  for (const Camera& camera : impl_->scene.cameras)
    names.push_back(camera.name);
  return names;
}

std::vector<std::string> Room::nodes() const {
  std::vector<std::string> names;
  for (const Node& node : impl_->scene.nodes)
    names.push_back(node.name);
  return names;
}

std::vector<std::string> Room::lamps() const {
  return guarded([&] {
    Scene scene = impl_->scene;
    std::vector<std::string> warnings;
    settle_sky(scene, warnings);
    return find_lamps(scene, LampGrouping::node).names;
  });
}

std::string Room::plan(const Settings& settings) const {
  return guarded([&] {
    const RenderRequest request = call_of(*impl_, settings).request;
    check_reading(*impl_, request.settings);
    return plan_run({impl_->file, PlanFormat::json, request.camera, request.size, request.settings});
  });
}

RoomPicture Room::render(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    const RenderRequest request = call_of(*impl_, settings).request;
    check_reading(*impl_, request.settings);
    const ThreadLimit limit(request.settings.threads);
    RunFigures figures;
    figures.threads = limit.threads();
    auto impl = std::make_shared<RoomPicture::Impl>();
    impl->picture = requested_picture(request, scene_of(*impl_, request.settings),
                                      events_of(listener), figures)
                        .picture;
    impl->picture.finer.reset();
    impl->shown = request.picture;
    impl->stats = stats_json(figures);
    return RoomPicture(std::move(impl));
  });
}

std::string version() { return std::string(program_version()); }

} // namespace meninas
