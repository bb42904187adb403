#include "library/impl.h"

#include "runs/plan_run.h"
#include "runs/resources.h"
#include "scenes/errors.h"
#include "scenes/lamps.h"
#include "raytrace/scene_textures.h"
#include "scenes/stopwatch.h"
#include "scenes/version.h"

#include <fmt/format.h>

#include <map>
#include <numbers>
#include <utility>

namespace meninas {

Scene scene_under_lamps(const Room::Impl& room, const RunSettings& settings) {
  // Of layers by lamp they come later.
  return settings.lamp_layers ? room.scene : under_lamps(room.scene, settings);
}

std::vector<std::filesystem::path> files_of(const Room::Impl& room) {
  std::vector<std::filesystem::path> files = files_beside_scene(room.loaded);
  files.push_back(room.file);
  return files;
}

Room::Room(const std::filesystem::path& file, const Settings& settings, const Listener& listener) {
  guarded([&] {
    auto impl = std::make_shared<Impl>();
    impl->file = file;
    impl->settings = settings;
    impl->loaded = call_of(*impl, {}, CallKind::room).request.settings;
    const ThreadLimit limit(impl->loaded.threads);
    Stopwatch watch;
    impl->scene = load_scene(file, impl->loaded);
    impl->seconds = watch.lap();
    impl->file = std::filesystem::absolute(file);
    if (listener.warning) { // once
      for (const std::string& warning : impl->scene.warnings)
        listener.warning(warning);
      impl->told = std::exchange(impl->scene.warnings, {});
    }
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
    const RenderRequest request = call_of(*impl_, settings, CallKind::plan).request;
    const ThreadLimit limit(request.settings.threads);
    Scene scene = impl_->scene; // a plan says all warnings of the file
    scene.warnings.insert(scene.warnings.begin(), impl_->told.begin(), impl_->told.end());
    return plan_of(scene, impl_->seconds,
                   {impl_->file, PlanFormat::json, request.camera, request.size, request.settings});
  });
}

/// Faces of a node that has an emission of its own have materials of their own.
static void emit(Scene& scene, NodeId node, const Rgb& radiosity) {
  std::map<MaterialId, MaterialId> own;
  for (Triangle& triangle : scene.triangles) {
    if (triangle.node != node)
      continue;
    const auto [found, is_new] =
        own.try_emplace(triangle.material, static_cast<MaterialId>(scene.materials.size()));
    if (is_new) {
      Material material = scene.materials[index(triangle.material)];
      material.emission = radiosity / std::numbers::pi;
      material.emissive_texture.reset();
      scene.materials.push_back(std::move(material));
    }
    triangle.material = found->second;
  }
}

Room Room::emitting(const std::vector<std::pair<std::string, Colour>>& nodes) const {
  return guarded([&] {
    constexpr double brightest = 1e30; // of which sums are finite
    auto impl = std::make_shared<Impl>(*impl_);
    for (const auto& [name, colour] : nodes) {
      for (const double channel : colour)
        if (!(channel >= 0.0) || channel > brightest)
          throw UsageError("emission", fmt::format("{} of node '{}' is no light", channel, name));
      emit(impl->scene, find_node(impl->scene, name), Rgb(colour[0], colour[1], colour[2]));
    }
    return Room(std::shared_ptr<const Impl>(std::move(impl)));
  });
}

RoomPicture Room::render(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    const RenderRequest request = call_of(*impl_, settings, CallKind::picture).request;
    const ThreadLimit limit(request.settings.threads);
    Stopwatch total;
    RunFigures figures;
    figures.threads = limit.threads();
    auto impl = std::make_shared<RoomPicture::Impl>();
    impl->picture = requested_picture(request, scene_under_lamps(*impl_, request.settings),
                                      events_of(listener), figures)
                        .picture;
    impl->picture.finer.reset();
    impl->shown = request.picture;
    impl->inputs = files_of(*impl_);
    figures.seconds.total = total.lap();
    figures.peak_memory_bytes = peak_memory_bytes();
    impl->stats = stats_json(figures);
    return RoomPicture(std::move(impl));
  });
}

std::string version() { return std::string(program_version()); }

} // namespace meninas
