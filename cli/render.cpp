#include "cli/camera_options.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/light/lamp_options.h"
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

void add_outputs(Options& command, RenderOptions& options) {
  RenderRequest& request = options.request;
  command.add_repeatable("-o,--output", "FILE",
                         "picture, .exr or .hdr (linear) or .png; may be given several times [SCENE.png]",
                         [&](const std::string& text) { request.pictures.emplace_back(text); });
  add_file(command, "--solution", request.solution,
           "render a solution written by `meninas solve` instead of solving");
  add_file(command, "--stats", request.stats, "write the figures of the run as JSON");
  command.add("--tile", "K/N",
              "render only part K of N, such as 1/4, to an EXR for `meninas merge`",
              [&](const std::string& text) {
                options.common.settings.part = parse_part("--tile", text);
              });
  command.add_flag("--error-map",
                   "add the layer `error` to an EXR: the estimated error of each pixel",
                   [&] { request.error_map = WithErrorMap::yes; });
  const auto add_goal = [&](const char* option, const char* shown,
                            std::optional<double> Goal::*goal, const char* description) {
    command.add(option, shown, description, [&request, option, goal](const std::string& text) {
      if (!request.goal) {
        request.goal.emplace();
      }
      *request.goal.*goal = parse_number(option, text, Sign::positive);
    });
  };
  add_goal(
      "--error", "X", &Goal::error,
      "choose settings until the picture's relative error is about X, such as 0.02");
  add_goal("--time", "SECONDS", &Goal::seconds,
           "choose the settings of the best picture within this time");
  command
      .add("--snapshots", "DIR",
           "folder for pictures along the way of --solver progressive, without and with its "
           "ambient term",
           [&](const std::string& text) { options.snapshots = text; })
      .group(study_group);
  command
      .add("--every", "N", fmt::format("shots between --snapshots [{}]", SnapshotRequest{}.every),
           [&](const std::string& text) {
             options.every = static_cast<int>(parse_integer("--every", text, 1, 1'000'000'000));
           })
      .group(study_group);
}

void add_depth_options(Options& command, PictureSettings& picture) {
  command
      .add("--depth", "8|16", "bits of a PNG's channel [8]",
           [&](const std::string& text) {
             picture.png_bits = parse_choice("--depth", text, Choices<int>{{"8", 8}, {"16", 16}});
           })
      .group(picture_group);
  command
      .add_flag("--float", "write an EXR of 32 bits a channel [16]",
                [&] { picture.exr_type = PixelType::float32; })
      .group(picture_group);
}

void add_picture_options(Options& command, RenderOptions& options) {
  RenderRequest& request = options.request;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description, const TakeText& take) {
    command.add(option, shown, description, take).group(picture_group);
  };
  add("--mode", "radiosity|hybrid|reference",
      "diffuse light only, with black mirrors; both passes; or path tracing [hybrid]",
      [&](const std::string& text) {
        options.common.settings.mode = parse_choice("--mode", text, modes);
      });
  add("--diffuse", "interpolated|direct|gather",
      "light on diffuse surfaces: interpolated between vertices, direct light computed as fine as "
      "pixels, or all light gathered at each hit [direct; interpolated with --quality draft, but "
      "in scenes of many small triangles]",
      [&](const std::string& text) { options.common.settings.diffuse = parse_diffuse(text); });
  add("--camera", "NAME", "camera to render [the first]",
      [&](const std::string& text) { request.camera = text; });
  add_projection(command, options.common.settings, picture_group);
  const PictureSize standard;
  add("--size", "WxH",
      fmt::format("size in pixels [{}x{}, or as wide as the camera asks]", standard.width, standard.height),
      [&](const std::string& text) { request.size = parse_size("--size", text); });
  add_lamp_factors(command,
                   "make a lamp so many times as bright, or of another colour; with --solution by "
                   "`solve --by-lamp` without solving; `all` is every lamp, the last word counts; "
                   "may be given several times [1]",
                   options.common.settings.lamp_factors);
  add("--samples", "N",
      fmt::format("camera rays per pixel, a power of two; with --mode reference an upper limit "
                  "[draft {}, normal {} to {}, fine {} to {}; no limit]",
                  preset_of(Quality::draft).samples, preset_of(Quality::normal).min_samples,
                  preset_of(Quality::normal).samples, preset_of(Quality::fine).min_samples,
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
  add_view_transform(command, "how a PNG shows what is brighter than a display",
                     request.picture.transform, picture_group);
  add_pixel_options(command, options.common.settings, picture_group);
  add_depth_options(command, request.picture);
}

/// What makes a picture what it is, wherever it is written.
void add_settings(Options& command, RenderOptions& options) {
  add_quality(command, options.common);
  add_state_options(command, options.common);
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

bool has_format(const RenderOptions& options, PictureFormat format) {
  return std::ranges::any_of(options.request.pictures, [&](const std::filesystem::path& file) {
    return picture_format(file) == format;
  });
}

void check_error_map(const RenderOptions& options) {
  if (options.request.error_map == WithErrorMap::no) {
    return;
  }
  if (options.common.settings.mode == PictureMode::reference) {
    throw UsageError("--error-map", "has no effect with --mode reference, which has the layer "
                                    "'variance'");
  }
  if (!has_format(options, PictureFormat::exr)) {
    throw UsageError("--error-map", "needs an EXR to write it to");
  }
}

/// What a run that chooses its own settings does not go with.
void check_goal(const Options& command, const RenderOptions& options) {
  if (!options.request.goal) {
    return;
  }
  const char* const goal = options.request.goal->error ? "--error" : "--time";
  if (options.common.settings.mode == PictureMode::reference) {
    throw UsageError(goal, "has no effect with --mode reference: use --max-error or --max-seconds");
  }
  refuse(command, {"--quality", "--solution", "--snapshots", "--error-map"},
         std::string("does not go with ") + goal + ", which chooses for itself");
  if (options.common.settings.lamp_layers)
    throw UsageError("--layers", std::string("lamps does not go with ") + goal +
                                     ": render once more, with the options that --stats says it has chosen");
}

/// A part is an EXR of floats, of what is known pixel by pixel.
void check_tile(const Options& command, const RenderOptions& options) {
  if (!options.common.settings.part)
    return;
  if (options.common.settings.mode == PictureMode::reference)
    throw UsageError("--tile", "does not go with --mode reference, which samples the whole picture "
                               "until its mean is known");
  refuse(command, {"--error-map", "--error", "--time", "--view", "--snapshots"},
         "needs the whole picture: it does not go with --tile");
  refuse(command, {"--depth", "--float"}, "does not go with --tile: give it to `meninas merge`");
  if (options.request.pictures.size() != 1 || !has_format(options, PictureFormat::exr))
    throw UsageError("--tile", "needs one output, an EXR: `meninas merge` makes the others");
}

/// What the mode does not heed is refused, not ignored.
void check_mode(const Options& command, const RenderOptions& options) {
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
RenderRequest& completed_request(const Options& command, RenderOptions& options) {
  check_mode(command, options);
  check_error_map(options);
  check_goal(command, options);
  check_tile(command, options);
  check_pixel_options(command, options.common.settings, options.request.pictures);
  if (options.common.settings.view && has_format(options, PictureFormat::hdr))
    throw UsageError("--view", "has no light for a .hdr: an .exr holds its numbers");
  check_diffuse(options.common.settings);
  if (options.request.solution && !options.common.settings.lamp_factors.empty())
    if (options.common.settings.layers == WithLayers::yes)
      throw UsageError("--layers", "what mirrors bring is not known of lamps: `light` does not go "
                                   "with --solution and --lamp");
  check_pass_one_options(command, options.common.settings);
  take_snapshots(options);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  const RunSettings& settings = options.common.settings;
  options.request.settings.display = display_of(options.request.pictures, options.request.picture);
  if (options.common.settings.part) // PNGs may come of it
    options.request.settings.display = {options.request.picture.exposure, options.request.picture.transform};
  if (settings.layers == WithLayers::yes || settings.lamp_layers || !settings.features.empty() || settings.view) {
    // In halves parts would not add up, and indices would be rounded.
    options.request.picture.exr_type = PixelType::float32;
  }
  if (settings.view) {
    options.request.picture.exposure = 0.0; // colours are what they are
    options.request.picture.transform = ViewTransform::srgb;
  }
  return options.request;
}

void run(const Options& command, RenderOptions& options) {
  if (options.request.pictures.empty()) {
    options.request.pictures = {options.common.scene.filename().replace_extension(".png")};
  }
  completed_request(command, options);
  check_free_camera(command, options.request.place, options.request.settings);
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  render_run(options.request, console.events());
}

} // namespace

Command add_render_command(Options& program) {
  Options& command = program.add_command("render", "Render a scene into pictures");
  const auto options = std::make_shared<RenderOptions>();
  add_scene(command, options->common);
  add_outputs(command, *options);
  add_settings(command, *options);
  // Not among the settings of a batch, which has paths of cameras.
  add_free_camera(command, options->request.place);
  return {&command, [=, &command] { run(command, *options); }};
}

/// Options that are not what a picture is made of.
static bool is_setting(const OptionInfo& option) {
  const std::string& name = option.long_names.front();
  return name != "help" && name != "threads" && name != "quiet";
}

/// The options that may be settings.
static std::vector<OptionInfo> settings_of(const Options& command) {
  std::vector<OptionInfo> options = command.list();
  std::erase_if(options, [](const OptionInfo& option) { return !is_setting(option); });
  return options;
}

/// Throws UsageError with a hint when there is none of this name.
static const OptionInfo& known_option(const std::string& name,
                                      const std::vector<OptionInfo>& known) {
  std::vector<std::string> names;
  for (const OptionInfo& option : known) {
    if (option.long_names.front() == name) {
      return option;
    }
    names.push_back(option.long_names.front());
  }
  throw UsageError(name, "unknown setting" + hint_for(name, names));
}

RenderRequest parse_render_settings(const std::filesystem::path& scene,
                                    const std::vector<Setting>& settings) {
  Options command("", "");
  RenderOptions options;
  add_settings(command, options);
  const std::vector<OptionInfo> known = settings_of(command);
  std::vector<std::string> arguments;
  for (const Setting& setting : settings) {
    const OptionInfo& option = known_option(setting.name, known);
    const bool flag = option.takes_value == TakesValue::no;
    const bool bare = option.takes_value == TakesValue::if_given && !setting.value;
    if (!bare && flag == setting.value.has_value()) {
      throw UsageError(setting.name, flag ? "takes true or false" : "takes a value");
    }
    const std::string value = bare ? preset_value : setting.value.value_or("");
    arguments.insert(arguments.begin(), "--" + setting.name + (value.empty() ? "" : '=' + value));
  }
  options.common.scene = scene;
  Parsed parsed;
  try {
    parsed = command.parse(arguments);
    if (parsed.outcome == Parsed::Outcome::complete) {
      return completed_request(command, options);
    }
  } catch (const UsageError& error) {
    const std::string text = error.what();
    throw UsageError("", text.starts_with("--") ? text.substr(2) : text);
  }
  throw UsageError("", parsed.problem);
}

std::vector<SettingHelp> render_settings_help() {
  Options command("", "");
  RenderOptions options;
  add_settings(command, options);
  std::vector<SettingHelp> help;
  for (const OptionInfo& option : settings_of(command)) {
    const bool flag = option.takes_value == TakesValue::no;
    help.push_back({option.long_names.front(), option.description, flag ? "" : option.value,
                    option.repeatable});
  }
  return help;
}

} // namespace meninas
