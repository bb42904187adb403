// The report of a picture's error: as a line, in the run's figures, as a layer of the picture.
#pragma once

#include "raytrace/error/picture_error.h"
#include "runs/run_events.h"
#include "runs/report/stats.h"

#include <optional>
#include <string>

namespace meninas {

enum class WithErrorMap { no, yes };

/// The wanted report.
enum class ErrorReport {
  none,
  figures, ///< and the line
  map      ///< these, and the layer `error`
};

/// The field, camera and settings that a picture was made of.
struct PictureSource {
  const IrradianceField& field;
  const Camera& camera;
  const TwoPassSettings& settings;
  const SolverResult& solver;
};

/// "about 1.3 % off (mesh 1.2 %, camera rays 0.5 %)", relative to the mean radiance, the larger parts
/// first, no part that does not matter.
std::string describe_error(const PictureError& error);

/// The option that reduces the largest part of the error most, as "--diffuse direct would help most", if the error
/// is visible (from 2 % on); otherwise nothing.
std::optional<std::string> suggest_option(const PictureError& error, const TwoPassSettings& settings);

/// Fills in the figures, and for the run's closing line the error with the option that would help
/// most; warns of an error above 10 %. The map is appended to the layers.
void report_error(const PictureSource& source, ErrorReport wanted, const SampledPicture& picture,
                  std::vector<Layer>& layers, const RunEvents& events, RunFigures& figures);

} // namespace meninas
