#include "runs/preparation.h"

#include "scenes/names.h"

#include "image/image_file.h"
#include "raytrace/pixels/section_plane.h"
#include "raytrace/scene_textures.h"
#include "runs/batch/camera_path.h"
#include "runs/report/percent.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meninas {

Scene under_background(Scene scene, const RunSettings& settings) {
  if (settings.environment.sky && settings.gltf.state.luminous_efficacy != lux_per_watt)
    throw UsageError("--luminous-efficacy",
                     fmt::format("does not go with --sky, whose light is that of {:g} lm/W", lux_per_watt));
  surround(scene, settings.background, settings.environment);
  return scene;
}

std::vector<std::filesystem::path> files_beside_scene(const RunSettings& settings) {
  std::vector<std::filesystem::path> files;
  if (settings.environment.file)
    files.emplace_back(*settings.environment.file);
  for (const auto& [light, file] : settings.gltf.state.luminaires)
    files.emplace_back(file);
  return files;
}

Scene load_scene(const std::filesystem::path& file, const RunSettings& settings) {
  Scene scene = load_gltf(file, settings.gltf);
  if (!scene.textures.empty()) {
    preload_picture_reader();
  }
  return under_background(std::move(scene), settings);
}

Scene load_relit_scene(const std::filesystem::path& file, const RunSettings& settings) {
  return under_lamps(load_scene(file, settings), settings);
}

Scene under_lamps(Scene scene, const RunSettings& settings) {
  if (settings.lamp_factors.empty())
    return scene;
  settle_sky(scene, scene.warnings);
  const LampGroups lamps = find_lamps(scene, settings.lamps.value_or(LampGrouping::node));
  const std::vector<Rgb> factors = factors_of_lamps(lamps.names, settings.lamp_factors);
  return relit(std::move(scene), lamps, factors);
}

/// Throws UsageError where the methods do not tell the light of lamps apart.
static void check_lamps(const PassOneSettings& settings) {
  if (!settings.lamps)
    return;
  if (settings.cut == MeshCut::uniform && settings.solver.method == SolverMethod::progressive)
    throw UsageError("--solver progressive", "keeps no transport by which lamps are told apart");
  if (settings.interpolation.method == Interpolation::average)
    throw UsageError("--interpolation average", "does not tell lamps apart: they need gather");
}

std::shared_ptr<const PreparedScene> prepare_run(Scene scene, const PassOneSettings& settings,
                                           const RunEvents& events, RunFigures& figures) {
  check_lamps(settings);
  auto prepared = prepare_scene(std::move(scene), settings);
  for (const std::string& warning : prepared->plan.warnings) {
    warn(events, warning);
  }
  add_preparation(figures, *prepared);
  return prepared;
}

/// Names of the nodes that these elements are of.
static std::vector<std::string> nodes_of(const PreparedScene& prepared,
                                         std::span<const std::uint32_t> elements) {
  const LightScene& light = *prepared.light();
  std::vector<std::string> names;
  for (const std::uint32_t e : elements) {
    const MeshSide& side = light.mesh.sides[index(light.mesh.side_of_element[e])];
    const TriangleId triangle = light.surfaces.patches[index(side.patch)].triangles[0];
    names.push_back(light.scene.nodes[index(light.scene.triangles[index(triangle)].node)].name);
  }
  return names;
}

void warn_of_solution(const PreparedScene& prepared, const SolverResult& solver,
                      const ClosureError& closure, const RunEvents& events) {
  if (solver.end == SolverEnd::unsolvable) {
    warn(events,
         "pass one has no solution: light is in closed parts of the scene that absorb nothing; "
         "only light that has not been reflected is shown");
  } else if (!solver.trapped.empty()) {
    warn(events,
         fmt::format("light enters closed parts of the scene that absorb nothing; what would be "
                     "reflected there, without end, is left out: {}",
                     quoted_names(nodes_of(prepared, solver.trapped))));
  }
  if (solver.end != SolverEnd::unsolvable && !solver.converged) {
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

Camera projected(Camera camera, const RunSettings& settings) {
  camera.projection = settings.projection.value_or(camera.projection);
  return camera;
}

Camera default_view(const Bounds& bounds, const RunSettings& settings) {
  Camera camera = projected(default_camera(bounds), settings);
  const Point3 centre = 0.5 * bounds.low + 0.5 * bounds.high;
  if (is_panorama(camera.projection) && glm::all(glm::lessThan(glm::abs(centre), Vec3(1e300)))) {
    camera.position = centre;
    camera.up = {0.0, 1.0, 0.0};
    camera.forward = glm::cross(camera.up, camera.right);
  }
  return camera;
}

Camera camera_at(const FreeCamera& place, const RunSettings& settings) {
  // Rays are traced in single precision: from farther away they meet nothing, or no finite point.
  constexpr double farthest = 1e6, nearest = 1e-9, narrowest = 0.01, widest = 179.9;
  for (const auto& [option, point] : {std::pair{"--eye", place.eye}, {"--target", place.target}})
    if (!glm::all(glm::lessThanEqual(glm::abs(point), Vec3(farthest))))
      throw UsageError(option, fmt::format("has a coordinate beyond {:g} m", farthest));
  if (!(glm::length(place.target - place.eye) > nearest))
    throw UsageError("--target", "is where --eye is: there is no direction to look in");
  if (place.angle && !(*place.angle >= narrowest && *place.angle <= widest))
    throw UsageError("--angle", fmt::format("is not from {} to {} degrees", narrowest, widest));
  const double fov = place.angle ? glm::radians(*place.angle) : Camera{}.vertical_fov;
  Camera camera = projected(looking_at(place.eye, place.target, fov), settings);
  camera.name = "free";
  return camera;
}

Camera choose_camera(const Scene& scene, const std::optional<std::string>& name,
                     const RunSettings& settings, const RunEvents& events) {
  if (name) {
    return projected(find_camera(scene, *name), settings);
  }
  if (scene.cameras.empty()) {
    return default_view(bounds_of(scene), settings);
  }
  if (scene.cameras.size() > 1) {
    note(events, fmt::format("camera '{}', the first of {}", scene.cameras.front().name,
                             scene.cameras.size()));
  }
  return projected(scene.cameras.front(), settings);
}

void add_camera(ContentHash& hash, const Camera& camera) {
  hash.add(camera.name);
  hash.add(static_cast<std::uint64_t>(camera.projection));
  for (const Vec3& vector : {camera.position, camera.right, camera.up, camera.forward}) {
    hash.add(vector);
  }
  for (const double number :
       {camera.vertical_fov, camera.half_height, camera.aspect, camera.znear, camera.lens_radius,
        camera.focus_distance}) {
    hash.add(number);
  }
  hash.add(static_cast<std::uint64_t>(camera.sensor_fit));
}

PictureSize choose_size(const std::optional<PictureSize>& asked, const Camera& camera) {
  if (asked) {
    if (camera.projection == Projection::cube && asked->width != cube_faces * asked->height) {
      throw UsageError("--size", fmt::format("{}x{} is no row of six squares, such as {}x{}",
                                             asked->width, asked->height,
                                             cube_faces * asked->height, asked->height));
    }
    return *asked;
  }
  PictureSize size;
  if (const double aspect = natural_aspect(camera); aspect > 0.0) {
    // An absurd aspect still makes a picture.
    const double width = std::clamp(aspect * size.height, 1.0, 16.0 * size.height);
    size.width = static_cast<int>(std::lround(width));
  }
  return size;
}

Camera cut_open(const Scene& scene, const Camera& camera, PictureSize size,
                const RunEvents& events) {
  if (is_panorama(camera.projection) && camera.lens_radius > 0.0) {
    warn(events, fmt::format("camera '{}' has a lens, which panoramas do without: all is sharp",
                             camera.name));
  }
  Camera cutting = with_section(scene, camera, double(size.width) / size.height);
  if (cutting.section > 0.0) {
    warn(events, fmt::format("camera '{}' cuts the scene open: what is nearer than its znear of "
                             "{:.4g} m is not shown",
                             camera.name, camera.znear));
  }
  return cutting;
}

} // namespace meninas
