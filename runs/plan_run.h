// `plan`: what a scene contains and what will be modelled, as text for people or as JSON.
#pragma once

#include "runs/run_settings.h"

#include <filesystem>
#include <string>

namespace meninas {

enum class PlanFormat { text, json };

struct PlanRequest {
  std::filesystem::path scene;
  PlanFormat format = PlanFormat::text;
  std::optional<std::string> camera; ///< of the picture whose cost is foretold
  std::optional<PictureSize> size;
  RunSettings settings;
};

std::string plan_run(const PlanRequest& request);

/// The plan of a scene that was read already, in `loading` seconds; `request.scene` is not used.
std::string plan_of(Scene scene, double loading, const PlanRequest& request);

} // namespace meninas
