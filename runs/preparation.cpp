#include "runs/preparation.h"

#include "image/image_file.h"
#include "raytrace/pixels/section_plane.h"
#include "runs/report/percent.h"
#include "scenes/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {

Scene under_background(Scene scene, const RunSettings& settings) {
  surround(scene, settings.background, settings.environment);
  return scene;
}

Scene load_scene(const std::filesystem::path& file, const RunSettings& settings) {
  Scene scene = load_gltf(file, settings.gltf);
  if (!scene.textures.empty()) {
    preload_picture_reader();
  }
  return under_background(std::move(scene), settings);
}

std::unique_ptr<PreparedScene> prepare_run(Scene scene, const PassOneSettings& settings,
                                           const RunEvents& events, RunFigures& figures) {
  auto prepared = prepare_scene(std::move(scene), settings);
  for (const std::string& warning : prepared->plan.warnings) {
    warn(events, warning);
  }
  add_preparation(figures, *prepared);
  return prepared;
}

void warn_of_solution(const SolverResult& solver, const ClosureError& closure,
                      const RunEvents& events) {
  if (solver.end == SolverEnd::unsolvable) {
    warn(events,
         "pass one has no solution: light enters a closed part of the scene that absorbs nothing; "
         "only light that has not been reflected is shown");
  } else if (!solver.converged) {
    warn(events,
         fmt::format("pass one has not converged: residual {:.2g} after {} {}, error bound {:.2g}",
                     solver.residual, solver.iterations,
                     solver.method == SolverMethod::progressive ? "shots" : "iterations",
                     solver.error_bound));
  }
  // A thousandth of the light is where a cut begins to show in a picture.
  constexpr double visible = 1e-3;
  if (closure.cut > visible) {
    warn(events, fmt::format("{} of the gathered light was lost at the limit of mirrors in a row",
                             readable_percent(closure.cut)));
  }
}

Camera choose_camera(const Scene& scene, const std::optional<std::string>& name,
                     const RunEvents& events) {
  if (name) {
    return find_camera(scene, *name);
  }
  if (scene.cameras.empty()) {
    return default_camera(bounds_of(scene));
  }
  if (scene.cameras.size() > 1) {
    note(events, fmt::format("camera '{}', the first of {}", scene.cameras.front().name,
                             scene.cameras.size()));
  }
  return scene.cameras.front();
}

PictureSize choose_size(const std::optional<PictureSize>& asked, const Camera& camera) {
  if (asked) {
    return *asked;
  }
  PictureSize size;
  if (camera.aspect > 0.0) {
    // An absurd aspect still makes a picture.
    const double width = std::clamp(camera.aspect * size.height, 1.0, 16.0 * size.height);
    size.width = static_cast<int>(std::lround(width));
  }
  return size;
}

Camera cut_open(const Scene& scene, const Camera& camera, PictureSize size,
                const RunEvents& events) {
  Camera cutting = with_section(scene, camera, double(size.width) / size.height);
  if (cutting.section > 0.0) {
    warn(events, fmt::format("camera '{}' cuts the scene open: what is nearer than its znear of "
                             "{:.4g} m is not shown",
                             camera.name, camera.znear));
  }
  return cutting;
}

} // namespace meninas
