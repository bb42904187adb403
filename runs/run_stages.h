// The stages that a run goes through, as its progress counts them.
#pragma once

#include "runs/run_events.h"
#include "runs/run_settings.h"

#include <vector>

namespace meninas {

/// Pass one, from the file on. Shares are those of a furnished room at normal quality.
std::vector<RunStage> pass_one_stages(const RunSettings& settings);

/// All of a picture: with pass one, or from a stored solution, or by path tracing.
enum class WithPassOne { no, yes };
std::vector<RunStage> picture_stages(const RunSettings& settings, WithPassOne pass_one);

/// `more` after `stages`.
std::vector<RunStage> joined(std::vector<RunStage> stages, const std::vector<RunStage>& more);

} // namespace meninas
