#include "runs/error_report.h"

#include "raytrace/error_map.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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
  std::string text = fmt::format("error about {:.2g} % of the mean radiance", 100.0 * error.total);
  constexpr double matters = 0.2; // of the total: less adds a fiftieth to it
  const char* between = ": ";
  for (const Part& part : parts)
    if (part.error > matters * error.total) {
      text += fmt::format("{}{} {:.2g} %", between, part.name, 100.0 * part.error);
      between = ", ";
    }
  return text;
}

void report_error(const PictureSource& source, ErrorReport wanted, const SampledPicture& picture,
                  std::vector<Layer>& layers, const RunEvents& events, RunFigures& figures) {
  if (wanted == ErrorReport::none)
    return;
  Stopwatch watch;
  const auto& [light, field, camera, settings, solver] = source;
  const PictureError error = estimate_error(light, field, camera, settings, solver, picture,
                                            error_settings(settings, element_count(light.mesh)));
  figures.error_estimate = error;
  note(events, describe_error(error));
  if (wanted == ErrorReport::map)
    layers.push_back({"error", error_map(light, field, camera, settings, picture.image, error)});
  figures.seconds.estimate = watch.lap();
}

} // namespace meninas
