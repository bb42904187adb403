#include "runs/reference_run.h"

#include "reference/scene_setup.h"
#include "runs/report/percent.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

namespace meninas {

static void warn_of_scene(const reference::TracedScene& traced, const RunEvents& events) {
  for (const std::string& warning : traced.scene.warnings) {
    warn(events, warning);
  }
  const bool unlit = traced.lights.lights.empty() && traced.light_images.empty() &&
                     is_dark(traced.scene.background);
  if (unlit) {
    warn(events, "nothing emits light: the picture will be black; --background 1 lights it from "
                 "all around");
  }
  if (traced.scene.cameras.empty()) {
    warn(events, "no camera: a default view of the whole scene is used");
  }
}

reference::ReferencePicture run_reference(Scene scene, const Camera& camera,
                                          const reference::ReferenceSettings& settings,
                                          const RunEvents& events, RunFigures& figures) {
  Stopwatch watch;
  const reference::TracedScene traced = reference::make_traced_scene(std::move(scene));
  warn_of_scene(traced, events);
  figures.seconds.plan = watch.lap();
  auto picture = reference::reference_picture(traced, camera, settings, events.progress);
  figures.seconds.render = watch.lap();
  add_reference(figures, picture);
  note(events,
       fmt::format("{} samples per pixel, standard error {}, stopped by {}", picture.samples,
                   readable_percent(picture.standard_error), stop_name(picture.stopped_by)));
  return picture;
}

} // namespace meninas
