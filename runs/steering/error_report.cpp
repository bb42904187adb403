#include "runs/steering/error_report.h"

#include "radiosity/scene/small_elements.h"
#include "raytrace/error/error_map.h"
#include "runs/report/percent.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {

std::string describe_error(const PictureError& error) {
  struct Part {
    const char* name;
    double error;
  };
  std::array parts{Part{"mesh", error.mesh}, Part{"form factors", error.form_factors},
                   Part{"mirror depth", error.mirror_tail}, Part{"camera rays", error.pixels},
                   Part{"solver", error.solver}};
  std::ranges::stable_sort(parts, std::greater{}, &Part::error);
  std::string text = fmt::format("{} off", about_percent(error.total));
  constexpr double matters = 0.2; // of the total: less adds a fiftieth to it
  const char* between = " (";
  for (const Part& part : parts)
    if (part.error > matters * error.total) {
      text += fmt::format("{}{} {}", between, part.name, readable_percent(part.error));
      between = ", ";
    }
  return *between == ',' ? text + ")" : text;
}

std::optional<std::string> suggest_option(const PictureError& error, const TwoPassSettings& settings) {
  constexpr double visible = 0.02;
  if (error.total < visible)
    return std::nullopt;
  // Light from emitters at every hit leaves what the rest of the field hides between vertices.
  const double without_edges =
      std::sqrt(std::max(0.0, error.mesh * error.mesh - error.mesh_direct * error.mesh_direct));
  const bool edges =
      settings.render.diffuse.term == DiffuseTerm::interpolated && without_edges < 0.7 * error.mesh;
  const char* mesh = edges                                       ? "--diffuse direct"
                     : settings.pass_one.mesh.element_size > 0.0 ? "a smaller --element-size"
                                                                 : "more --elements";
  const bool cells = settings.pass_one.form_factors.method == FormFactorMethod::hemicube;
  struct Turn {
    const char* option;
    double error;
  };
  const std::array turns{
      Turn{mesh, error.mesh},
      Turn{cells ? "a greater --hemicube-resolution" : "more --rays", error.form_factors},
      Turn{"a greater --mirror-depth", error.mirror_tail}, Turn{"more --samples", error.pixels},
      Turn{"a smaller --tolerance", error.solver}};
  return fmt::format("{} would help most", std::ranges::max(turns, {}, &Turn::error).option);
}

void report_error(const PictureSource& source, ErrorReport wanted, const SampledPicture& picture,
                  std::vector<Layer>& layers, const RunEvents& events, RunFigures& figures) {
  if (wanted == ErrorReport::none)
    return;
  Stopwatch watch;
  const auto& [field, camera, settings, solver] = source;
  const PictureError error = estimate_error(field, camera, settings, solver, picture,
                                            error_settings(settings, sampled_elements(*field.scene)));
  figures.error_estimate = error;
  // A black picture has a warning of its own, and nothing that an error could be relative to.
  if (error.mean_radiance > 0.0 && !std::isfinite(error.total)) {
    warn(events, "no error is estimated: this much light is beyond floats");
  } else if (error.mean_radiance > 0.0) {
    figures.closing = describe_error(error);
    if (const auto option = suggest_option(error, settings))
      figures.closing += "; " + *option;
    constexpr double large = 0.1;
    if (error.total > large)
      warn(events, "the picture is " + describe_error(error));
  }
  if (wanted == ErrorReport::map)
    layers.push_back({"error", error_map(field, camera, settings, picture.image, error)});
  figures.seconds.estimate = watch.lap();
}

} // namespace meninas
