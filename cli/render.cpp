#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/pixel_options.h"
#include "cli/settings.h"
#include "cli/values.h"
#include "runs/render_run.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {
namespace {

constexpr const char* picture_group = "Picture";

const Choices<PictureMode> modes{{"radiosity", PictureMode::radiosity},
                                 {"hybrid", PictureMode::hybrid},
                                 {"reference", PictureMode::reference}};

struct RenderOptions {
  CommonOptions common;
  RenderRequest request;
  std::optional<std::filesystem::path> snapshots;
  std::optional<int> every;
};

void add_outputs(CLI::App& command, RenderOptions& options) {
  RenderRequest& request = options.request;
  command
      .add_option("-o,--output", request.pictures,
                  "picture, .exr (linear) or .png; may be given several times [SCENE.png]")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_file(command, "--solution", request.solution,
           "render a solution written by `meninas solve` instead of solving");
  add_file(command, "--stats", request.stats, "write the figures of the run as JSON");
  command.add_flag_callback(
      "--error-map", [&] { request.error_map = WithErrorMap::yes; },
      "add the layer `error` to an EXR: the estimated error of each pixel");
  const auto add_goal = [&](const char* option, const char* shown,
                            std::optional<double> Goal::*goal, const char* description) {
    command
        .add_option_function<std::string>(
            option,
            [&request, option, goal](const std::string& text) {
              if (!request.goal) {
                request.goal.emplace();
              }
              *request.goal.*goal = parse_number(option, text, Sign::positive);
            },
            description)
        ->type_name(shown);
  };
  add_goal(
      "--error", "X", &Goal::error,
      "choose settings until the picture's relative error is about X, such as 0.02");
  add_goal("--time", "SECONDS", &Goal::seconds,
           "choose the settings of the best picture within this time");
  add_file(command, "--snapshots", options.snapshots,
           "folder for pictures along the way of --solver progressive, without and with its "
           "ambient term")
      ->type_name("DIR")
      ->group(study_group);
  command
      .add_option_function<std::string>(
          "--every",
          [&](const std::string& text) {
            options.every = static_cast<int>(parse_integer("--every", text, 1, 1'000'000'000));
          },
          fmt::format(
              "shots between --snapshots [{}]",
              SnapshotRequest{}.every))
      ->type_name("N")
      ->group(study_group);
}

void add_picture_options(CLI::App& command, RenderOptions& options) {
  RenderRequest& request = options.request;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description,
                       std::function<void(const std::string&)> take) {
    command.add_option_function<std::string>(option, take, description)
        ->type_name(shown)
        ->group(picture_group);
  };
  add("--mode", "radiosity|hybrid|reference",
      "diffuse light only, with black mirrors; both passes; or path tracing [hybrid]",
      [&](const std::string& text) {
        options.common.settings.mode = parse_choice("--mode", text, modes);
      });
  add("--diffuse", "interpolated|direct|gather",
      "light on diffuse surfaces: interpolated between vertices, direct light computed at each "
      "hit, or all light gathered there [interpolated; direct with --quality fine]",
      [&](const std::string& text) { options.common.settings.diffuse = parse_diffuse(text); });
  add("--camera", "NAME", "camera to render [the first]",
      [&](const std::string& text) { request.camera = text; });
  const PictureSize standard;
  add("--size", "WxH",
      fmt::format("size in pixels [{}x{}, or as wide as the camera asks]", standard.width, standard.height),
      [&](const std::string& text) { request.size = parse_size("--size", text); });
  add("--samples", "N",
      fmt::format("camera rays per pixel, a power of two; with --mode reference an upper limit "
                  "[draft {}, normal {}, fine {}; no limit]",
                  preset_of(Quality::draft).samples, preset_of(Quality::normal).samples,
                  preset_of(Quality::fine).samples),
      [&](const std::string& text) {
        options.common.settings.samples =
            static_cast<int>(parse_integer("--samples", text, 1, 1 << 24));
      });
  add("--max-error", "X",
      fmt::format(
          "--mode reference: stop at this standard error of the mean radiance [draft {}, "
          "normal {}, fine {}, unless there is another limit]",
          preset_of(Quality::draft).max_error, preset_of(Quality::normal).max_error,
          preset_of(Quality::fine).max_error),
      [&](const std::string& text) {
        options.common.settings.max_error = parse_number("--max-error", text, Sign::positive);
      });
  add("--max-seconds", "S", "--mode reference: stop after about so long [no limit]",
      [&](const std::string& text) {
        options.common.settings.max_seconds = parse_number("--max-seconds", text, Sign::positive);
      });
  add("--exposure", "EV", "brighten a PNG by so many stops [automatic]",
      [&](const std::string& text) {
        request.picture.exposure = parse_number("--exposure", text, Sign::any);
      });
  add_pixel_options(command, options.common.settings, picture_group);
  command
      .add_flag_callback(
          "--float", [&] { request.picture.exr_type = PixelType::float32; },
          "write an EXR of 32 bits a channel [16]")
      ->group(picture_group);
}

/// What makes a picture what it is, wherever it is written.
void add_settings(CLI::App& command, RenderOptions& options) {
  add_quality(command, options.common);
  add_light_options(command, options.common);
  add_picture_options(command, options);
  add_mesh_options(command, options.common);
  add_pass_one_options(command, options.common);
  add_run_options(command, options.common);
}

/// `direct` builds on the light without that of emitters,
/// which means of elements by the analytic method do not tell apart.
void check_diffuse(const RunSettings& settings) {
  if (settings.diffuse == DiffuseTerm::direct &&
      settings.form_factors == FormFactorMethod::analytic &&
      settings.interpolation == Interpolation::average) {
    throw UsageError("--diffuse direct", "needs --interpolation gather with --form-factors "
                                         "analytic");
  }
}

bool has_exr(const RenderOptions& options) {
  const auto is_exr = [](const std::filesystem::path& file) {
    return picture_format(file) == PictureFormat::exr;
  };
  return std::ranges::any_of(options.request.pictures, is_exr);
}

void check_error_map(const RenderOptions& options) {
  if (options.request.error_map == WithErrorMap::no) {
    return;
  }
  if (options.common.settings.mode == PictureMode::reference) {
    throw UsageError("--error-map", "has no effect with --mode reference, which has the layer "
                                    "'variance'");
  }
  if (!has_exr(options)) {
    throw UsageError("--error-map", "needs an EXR to write it to");
  }
}

/// What a run that chooses its own settings does not go with.
void check_goal(const CLI::App& command, const RenderOptions& options) {
  if (!options.request.goal) {
    return;
  }
  const char* const goal = options.request.goal->error ? "--error" : "--time";
  if (options.common.settings.mode == PictureMode::reference) {
    throw UsageError(goal, "is of the two passes: choose --max-error or --max-seconds with --mode "
                           "reference");
  }
  refuse(command, {"--quality", "--solution", "--snapshots", "--error-map"},
         std::string("does not go with ") + goal + ", which chooses for itself");
}

/// What the mode does not heed is refused, not ignored.
void check_mode(const CLI::App& command, const RenderOptions& options) {
  if (options.common.settings.mode == PictureMode::reference) {
    const std::string reason = "has no effect with --mode reference: there is no pass one";
    refuse_pass_one_options(command, reason);
    refuse(command, {"--solution", "--mirror-depth", "--diffuse", "--view"}, reason);
    refuse(command, {"--filter", "--pixel-error"},
           "has no effect with --mode reference: its pixels are boxes of as many samples each");
    refuse(command, {"--glossy-samples"},
           "has no effect with --mode reference: its paths go one way at a time");
    return;
  }
  if (options.common.settings.mode == PictureMode::radiosity) {
    refuse(command, {"--diffuse", "--glossy-samples"},
           "has no effect with --mode radiosity: it shows pass one");
  }
  refuse(command, {"--max-error", "--max-seconds"}, "has no effect without --mode reference");
  if (options.request.solution) {
    refuse_pass_one_options(command, "has no effect with --solution: pass one is not run");
  }
}

void take_snapshots(RenderOptions& options) {
  if (options.every && !options.snapshots) {
    throw UsageError("--every", "has no effect without --snapshots");
  }
  if (!options.snapshots) {
    return;
  }
  const RunSettings& settings = options.common.settings;
  if (settings.solver != SolverMethod::progressive ||
      mesh_cut(settings) == MeshCut::hierarchical || options.request.solution ||
      settings.mode == PictureMode::reference) {
    throw UsageError("--snapshots", "has no effect without --solver progressive and --mesh uniform");
  }
  SnapshotRequest& request = options.request.snapshots.emplace();
  request.folder = *options.snapshots;
  request.every = options.every.value_or(request.every);
}

/// The request, after a check that all options given have an effect together.
RenderRequest& completed_request(const CLI::App& command, RenderOptions& options) {
  check_mode(command, options);
  check_error_map(options);
  check_goal(command, options);
  check_pixel_options(command, options.common.settings, options.request.pictures);
  check_diffuse(options.common.settings);
  check_pass_one_options(command, options.common.settings);
  take_snapshots(options);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  const RunSettings& settings = options.common.settings;
  if (settings.layers == WithLayers::yes || !settings.features.empty() || settings.view) {
    // In halves parts would not add up, and indices would be rounded.
    options.request.picture.exr_type = PixelType::float32;
  }
  if (settings.view) {
    options.request.picture.exposure = 0.0; // colours are what they are
  }
  return options.request;
}

void run(const CLI::App& command, RenderOptions& options) {
  if (options.request.pictures.empty()) {
    options.request.pictures = {options.common.scene.filename().replace_extension(".png")};
  }
  completed_request(command, options);
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  render_run(options.request, console.events());
}

} // namespace

Command add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene into pictures");
  const auto options = std::make_shared<RenderOptions>();
  add_scene(*command, options->common);
  add_outputs(*command, *options);
  add_settings(*command, *options);
  return {command, [=] { run(*command, *options); }};
}

/// Options that are not what a picture is made of.
static bool is_setting(const CLI::Option& option) {
  const std::string name = option.get_lnames().front();
  return name != "help" && name != "threads" && name != "quiet";
}

RenderRequest parse_render_settings(const std::filesystem::path& scene,
                                    const std::vector<Setting>& settings) {
  CLI::App command;
  RenderOptions options;
  add_settings(command, options);
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    if (is_setting(*option)) {
      known.push_back(option->get_lnames().front());
    }
  }
  // CLI11 takes what is left to parse from the back of the list.
  std::vector<std::string> arguments;
  for (const Setting& setting : settings) {
    if (std::ranges::find(known, setting.name) == known.end()) {
      throw UsageError(setting.name, "unknown setting" + hint_for(setting.name, known));
    }
    const CLI::Option* option = command.get_option("--" + setting.name);
    const bool flag = option->get_expected_max() == 0;
    const bool bare = option->get_expected_min() == 0 && !flag && !setting.value;
    if (!bare && flag == setting.value.has_value()) {
      throw UsageError(setting.name, flag ? "takes true or false" : "takes a value");
    }
    const std::string value = bare ? preset_value : setting.value.value_or("");
    arguments.insert(arguments.begin(), "--" + setting.name + (value.empty() ? "" : '=' + value));
  }
  options.common.scene = scene;
  try {
    command.parse(arguments);
    return completed_request(command, options);
  } catch (const CLI::ParseError& error) {
    throw UsageError("", error.what());
  } catch (const UsageError& error) {
    const std::string text = error.what();
    throw UsageError("", text.starts_with("--") ? text.substr(2) : text);
  }
}

std::vector<SettingHelp> render_settings_help() {
  CLI::App command;
  RenderOptions options;
  add_settings(command, options);
  std::vector<SettingHelp> help;
  for (const CLI::Option* option : command.get_options()) {
    if (is_setting(*option)) {
      const bool flag = option->get_expected_max() == 0;
      help.push_back({option->get_lnames().front(), option->get_description(),
                      flag ? "" : option->get_type_name()});
    }
  }
  return help;
}

} // namespace meninas
