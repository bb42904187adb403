#include "cli/pixel_options.h"

#include "cli/common_options.h"
#include "cli/values.h"
#include "image/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace meninas {
namespace {

/// Names of enumerators in lists that know them by name_of().
template <typename Value, std::size_t n>
Choices<Value> choices_of(const std::array<Value, n>& values) {
  Choices<Value> choices;
  for (const Value value : values) {
    choices.emplace_back(std::string(name_of(value)), value);
  }
  return choices;
}
template <typename Value, std::size_t n>
std::string join_names(const std::array<Value, n>& values) {
  return fmt::format("{}", fmt::join(names_of(choices_of(values)), "|"));
}

/// The parts that light has, which `--layers` alone asks for.
constexpr const char* light_layers = "light";

/// The light of each lamp, which makes up the picture.
constexpr const char* lamp_layers = "lamps";

/// A list of layers, without doubles, in the order they are written.
void parse_layers(const std::string& text, RunSettings& settings) {
  const Choices<Feature> known = choices_of(all_features);
  std::vector<std::string> names = names_of(known);
  names.insert(names.begin(), {light_layers, lamp_layers});
  std::istringstream list(text);
  std::set<Feature> asked;
  settings.layers = WithLayers::no;
  for (std::string name; std::getline(list, name, ',');) {
    if (name == light_layers) {
      settings.layers = WithLayers::yes;
    } else if (name == lamp_layers) {
      settings.lamp_layers = true;
    } else if (std::ranges::find(names, name) != names.end()) {
      asked.insert(parse_choice("--layers", name, known));
    } else {
      refuse_choice("--layers", name, names);
    }
  }
  if (text.empty() || text.back() == ',') {
    refuse_choice("--layers", "", names);
  }
  settings.features.assign(asked.begin(), asked.end());
}

/// `--layers [LIST]`: without LIST those of light.
void add_layers(Options& command, RunSettings& settings, const std::string& group) {
  command
      .add("--layers", "[LIST]",
           fmt::format("layers of an EXR besides the picture, joined by commas: light (nine layers "
                       "that add up to the picture), lamps (one of each, likewise), {} [none; light without LIST]",
                       fmt::join(names_of(choices_of(all_features)), ", ")),
           [&](const std::string& text) {
             parse_layers(text == preset_value ? light_layers : text, settings);
           })
      .value_if_given(preset_value)
      .group(group);
}

void check_layers(const RunSettings& settings, const std::vector<std::filesystem::path>& pictures) {
  const bool light = settings.layers == WithLayers::yes;
  if (!light && settings.features.empty() && !settings.lamp_layers) {
    return;
  }
  if (settings.lamp_layers && (light || !settings.features.empty() ||
                               settings.mode == PictureMode::reference || settings.view)) {
    throw UsageError("--layers", "lamps stands alone, without --mode reference and --view");
  }
  if (!settings.features.empty() && settings.mode == PictureMode::reference) {
    throw UsageError("--layers", "has but those of light with --mode reference");
  }
  if (light && settings.mode == PictureMode::radiosity) {
    throw UsageError("--layers", "has no effect with --mode radiosity: its mirrors are black");
  }
  if (light && settings.interpolation == Interpolation::average) {
    throw UsageError("--layers", "needs --interpolation gather");
  }
  const auto is_exr = [](const std::filesystem::path& file) {
    return picture_format(file) == PictureFormat::exr;
  };
  if (!pictures.empty() && std::ranges::none_of(pictures, is_exr)) {
    throw UsageError("--layers", "needs an EXR to write them to");
  }
}

/// A view is no picture of light.
void check_view(const Options& command, const RunSettings& settings) {
  if (settings.view_top && settings.view != DebugView::illuminance &&
      settings.view != DebugView::luminance)
    throw UsageError("--view-top", "has no effect without --view illuminance or luminance");
  if (!settings.view) {
    return;
  }
  const char* const reason = "has no effect with --view";
  refuse(command,
         {"--layers", "--exposure", "--view-transform", "--snapshots", "--error-map", "--error", "--time"},
         reason);
  if (settings.view != DebugView::luminance)
    refuse(command, {"--diffuse", "--samples", "--filter", "--pixel-error", "--glossy-samples"}, reason);
  if (settings.view == DebugView::mirror_depth && settings.mode == PictureMode::radiosity) {
    throw UsageError("--view", "mirror-depth has no effect with --mode radiosity: its mirrors are "
                               "black");
  }
}

} // namespace

void refuse(const Options& command, std::initializer_list<const char*> options,
            const std::string& reason) {
  for (const char* option : options) {
    if (command.given(option)) {
      throw UsageError(option, reason);
    }
  }
}

void add_projection(Options& command, RunSettings& settings, const std::string& group) {
  const Choices<Projection> panoramas{{"equirectangular", Projection::equirectangular},
                                      {"cube", Projection::cube}};
  command
      .add("--projection", fmt::format("{}", fmt::join(names_of(panoramas), "|")),
           "all around the camera's place, in one picture [the camera's own projection]",
           [&settings, panoramas](const std::string& text) {
             settings.projection = parse_choice("--projection", text, panoramas);
           })
      .group(group);
}

void add_view_transform(Options& command, const std::string& description, ViewTransform& transform,
                        const std::string& group) {
  command
      .add("--view-transform", join_names(view_transforms),
           fmt::format("{} [{}]", description, name_of(transform)),
           [&](const std::string& text) {
             transform =
                 parse_choice("--view-transform", text, choices_of(view_transforms));
           })
      .group(group);
}

void add_pixel_options(Options& command, RunSettings& settings, const std::string& group) {
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description, const TakeText& take) {
    command.add(option, shown, description, take).group(group);
  };
  add_layers(command, settings, group);
  add("--view", join_names(debug_views),
      "paint this in false colours instead of light",
      [&](const std::string& text) {
        settings.view = parse_choice("--view", text, choices_of(debug_views));
      });
  add("--view-top", "X", "the brightest colour of --view illuminance|luminance, lx or cd/m^2 [for the picture]",
      [&](const std::string& text) {
        settings.view_top = parse_number("--view-top", text, Sign::positive);
      });
  add("--filter", join_names(pixel_filters),
      fmt::format("pixel filter [{}]", name_of(RenderSettings{}.filter)),
      [&](const std::string& text) {
        settings.filter = parse_choice("--filter", text, choices_of(pixel_filters));
      });
  add("--pixel-error", "X",
      fmt::format("adaptive sampling: up to --samples where a pixel's error exceeds X of the pixel or of the "
                  "picture's mean [normal {}, fine {}; draft, or with --samples alone: --samples everywhere]",
                  preset_of(Quality::normal).pixel_error, preset_of(Quality::fine).pixel_error),
      [&](const std::string& text) {
        settings.pixel_error = parse_number("--pixel-error", text, Sign::positive);
      });
  add("--glossy-samples", "N",
      fmt::format(
          "rays into the widest and brightest glossy lobes; others get fewer [{}]",
          RenderSettings{}.glossy_samples),
      [&](const std::string& text) {
        settings.glossy_samples =
            static_cast<int>(parse_integer("--glossy-samples", text, 1, 4096));
      });
}

void check_pixel_options(const Options& command, const RunSettings& settings,
                         const std::vector<std::filesystem::path>& pictures) {
  check_layers(settings, pictures);
  check_view(command, settings);
}

} // namespace meninas
