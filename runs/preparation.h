// The beginning every run has in common:
// from the scene's file to a prepared scene, with its warnings said.
#pragma once

#include "runs/run_events.h"
#include "runs/run_settings.h"
#include "runs/report/stats.h"
#include "scenes/content_hash.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace meninas {

/// The scene with the background that was asked for.
Scene under_background(Scene scene, const RunSettings& settings);

/// The same, of a file.
Scene load_scene(const std::filesystem::path& file, const RunSettings& settings);

/// The scene with lamps as bright as the settings say.
Scene under_lamps(Scene scene, const RunSettings& settings);

/// The same, of a file.
Scene load_relit_scene(const std::filesystem::path& file, const RunSettings& settings);

/// The files that are read besides: of the sky and of luminaires.
std::vector<std::filesystem::path> files_beside_scene(const RunSettings& settings);

/// Says the plan's warnings and fills in the figures of these stages.
std::shared_ptr<const PreparedScene> prepare_run(Scene scene, const PassOneSettings& settings,
                                           const RunEvents& events, RunFigures& figures);

/// Says what a user has to know about how well pass one went in a scene.
void warn_of_solution(const PreparedScene& prepared, const SolverResult& solver,
                      const ClosureError& closure, const RunEvents& events);

/// The camera with the projection that the settings ask for.
Camera projected(Camera camera, const RunSettings& settings);

/// The view of a scene without a camera: all of it from outside, or around from its middle.
Camera default_view(const Bounds& bounds, const RunSettings& settings);

/// A place to look from that the file need not know.
struct FreeCamera {
  Point3 eye{0.0}, target{0.0};
  std::optional<double> angle; ///< of view, vertical, degrees; that of Camera otherwise
};

/// Upright at its eye, as projected(). Throws UsageError of coordinates beyond 1e6 m, points 1e-9 m apart, and angles
/// outside 0.01 to 179.9.
Camera camera_at(const FreeCamera& place, const RunSettings& settings);

/// The camera of that name, else the file's first, else a default view, as projected().
Camera choose_camera(const Scene& scene, const std::optional<std::string>& name,
                     const RunSettings& settings, const RunEvents& events);

/// All that a picture depends on of its camera.
void add_camera(ContentHash& hash, const Camera& camera);

/// As asked, else 512 rows, as wide as the camera wants them, else square. Throws UsageError where
/// the six faces of a cube would be no squares.
PictureSize choose_size(const std::optional<PictureSize>& asked, const Camera& camera);

/// The camera; one that cuts what a picture of that size would show starts at its section plane.
/// Says so, and that panoramas do without a lens.
Camera cut_open(const Scene& scene, const Camera& camera, PictureSize size,
                const RunEvents& events);

} // namespace meninas
