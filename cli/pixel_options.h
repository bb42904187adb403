// Options of `render` about what pixels are:
// layers, views for those who debug, the filter, adaptive sampling.
#pragma once

#include "cli/options.h"
#include "image/view_transform.h"
#include "runs/run_settings.h"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace meninas {

/// Throws UsageError for the first of the options that was given, if the command has it.
void refuse(const Options& command, std::initializer_list<const char*> options,
            const std::string& reason);

void add_pixel_options(Options& command, RunSettings& settings, const std::string& group);

/// `--projection`, of panoramas.
void add_projection(Options& command, RunSettings& settings, const std::string& group);

/// `--view-transform`, of a picture or of several.
void add_view_transform(Options& command, const std::string& description, ViewTransform& transform,
                        const std::string& group);

/// Throws UsageError when one of them was given that has no effect with the others,
/// or on these pictures.
void check_pixel_options(const Options& command, const RunSettings& settings,
                         const std::vector<std::filesystem::path>& pictures);

} // namespace meninas
