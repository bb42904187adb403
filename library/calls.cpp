#include "library/impl.h"

#include "cli/light/lamp_options.h"
#include "cli/settings.h"
#include "cli/values.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <set>
#include <system_error>

namespace meninas {

Error::Error(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
Error::~Error() = default;

static Error::Kind kind_of(ExitCode code) {
  switch (code) {
  case ExitCode::bad_input:
    return Error::Kind::input;
  case ExitCode::failed_output:
    return Error::Kind::output;
  default:
    return Error::Kind::usage;
  }
}

void throw_error() {
  try {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const UserError& error) {
    std::string_view text = error.what(); // settings have no dashes here
    while (error.code() == ExitCode::usage && text.starts_with('-'))
      text.remove_prefix(1);
    throw Error(kind_of(error.code()), std::string(text));
  } catch (const Cancelled&) {
    throw Error(Error::Kind::cancelled, "cancelled");
  } catch (const std::bad_alloc&) {
    throw Error(Error::Kind::output, "out of memory");
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(Error::Kind::input, error.what());
  }
}

Settings merged(const Settings& before, const Settings& after) {
  Settings all;
  for (const auto& setting : before)
    if (std::ranges::find(after, setting.first, &Settings::value_type::first) == after.end())
      all.push_back(setting);
  all.insert(all.end(), after.begin(), after.end());
  return all;
}

namespace {

using Names = std::set<std::string, std::less<>>;

/// Of pictures, and of nothing else.
const Names of_pictures{"camera", "size", "mode", "lamp", "layers", "samples", "diffuse", "filter", "pixel-error",
                        "glossy-samples", "error", "time", "max-error", "max-seconds", "view", "view-top", "error-map",
                        "exposure", "view-transform", "depth", "float", "png", "projection"};
/// Of what pass one is and how it is solved.
const Names of_pass_one{"element-size", "elements", "form-factors", "rays", "hemicube-resolution", "solver", "tolerance",
                        "steps", "link-error", "interpolation", "adaptive", "no-adaptive", "bends", "mesh", "by-lamp"};
/// Of a choice that only a run from the scene on can make.
const Names of_whole_runs{"error", "time", "max-error", "max-seconds"};
const Names of_solvers{"solver", "tolerance", "steps", "threads"};
/// Of form factors, which know no light.
const Names without_light{"solver", "tolerance", "steps", "link-error", "interpolation", "adaptive", "no-adaptive",
                          "bends", "mesh", "by-lamp"};
const Names of_files{"exposure", "view-transform", "depth", "float"};

bool has_effect(const std::string& name, CallKind kind) {
  switch (kind) {
  case CallKind::room:
    return true;
  case CallKind::plan:
  case CallKind::picture:
    return name != "by-lamp";
  case CallKind::solution:
    return !of_pictures.contains(name);
  case CallKind::picture_of_solution:
    return !of_pass_one.contains(name) && !of_whole_runs.contains(name);
  case CallKind::form_factors:
    return !(of_pictures.contains(name) && name != "lamp") && !without_light.contains(name);
  case CallKind::solve_rows:
    return of_solvers.contains(name);
  }
  return true;
}

const char* name_of(CallKind kind) {
  switch (kind) {
  case CallKind::solution:
    return "a solution";
  case CallKind::picture_of_solution:
    return "the picture of a solution";
  case CallKind::form_factors:
    return "form factors";
  case CallKind::solve_rows:
    return "the solve of rows";
  default:
    return "this call";
  }
}

/// What of the settings has an effect on such a call. What scenes are read with stays: it is checked.
Settings heeded(const Room::Impl& room, const Settings& of_call, CallKind kind) {
  for (const auto& [name, value] : of_call)
    if (!has_effect(name, kind))
      throw UsageError(name, fmt::format("has no effect on {}", name_of(kind)));
  Settings of_room = room.settings;
  if (kind != CallKind::room)
    std::erase_if(of_room, [&](const auto& setting) {
      const std::string& name = setting.first;
      const bool is_of_other_calls = of_pictures.contains(name) || of_pass_one.contains(name);
      // A path tracer has no solution; a quality that the call chooses for itself gives way in goal_of().
      const bool other_mode = name == "mode" && setting.second == "reference" && kind != CallKind::picture;
      return (is_of_other_calls && !has_effect(name, kind)) || other_mode;
    });
  return merged(of_room, of_call);
}

/// The value of a setting that the parser of pictures does not know, taken out; the last word counts.
std::optional<std::string> taken(Settings& settings, const std::string& name) {
  std::optional<std::string> value;
  std::erase_if(settings, [&](const auto& setting) {
    if (setting.first != name)
      return false;
    value = setting.second;
    return true;
  });
  return value;
}

/// What a run that chooses its own settings is to reach. The room's quality gives way to it, the call's does not go with it.
std::optional<Goal> goal_of(const Settings& of_call, Settings& all) {
  std::optional<Goal> goal;
  for (const auto& [name, value] : {std::pair("error", &Goal::error), std::pair("time", &Goal::seconds)})
    if (const auto text = taken(all, name)) {
      goal = goal ? goal : Goal{};
      *goal.*value = parse_number(name, *text, Sign::positive);
      if (std::ranges::find(of_call, "quality", &Settings::value_type::first) != of_call.end())
        throw UsageError("quality", fmt::format("does not go with {}, which chooses for itself", name));
    }
  if (goal)
    taken(all, "quality");
  return goal;
}

std::vector<Setting> as_parsed(const Settings& settings) {
  std::vector<Setting> named;
  for (const auto& [name, value] : settings)
    named.push_back({name, value.empty() ? std::nullopt : std::optional(value)});
  return named;
}

/// Where a call wants the file read in another way than the room has.
void check_reading(const RunSettings& loaded, const RunSettings& settings) {
  if (settings.gltf.scene != loaded.gltf.scene || settings.gltf.state != loaded.gltf.state ||
      settings.gltf.external_files != loaded.gltf.external_files ||
      settings.background != loaded.background || settings.environment != loaded.environment)
    throw UsageError("", "how the scene is read, and what surrounds it, is said where the room is loaded");
}

} // namespace

Call call_of(const Room::Impl& room, const Settings& settings, CallKind kind) {
  Settings all = heeded(room, settings, kind);
  const auto goal = kind == CallKind::room ? std::nullopt : goal_of(settings, all);
  if (kind == CallKind::room)
    for (const char* name : {"error", "time"}) // are of pictures, and checked there
      taken(all, name);
  const auto threads = taken(all, "threads");
  const auto by_lamp = taken(all, "by-lamp");
  const bool as_png = taken(all, "png").has_value();
  Call call{parse_render_settings(room.file, as_parsed(all)), {}};
  RunSettings& chosen = call.request.settings;
  if (kind != CallKind::room)
    check_reading(room.loaded, chosen);
  if (goal && chosen.mode == PictureMode::reference)
    throw UsageError(goal->error ? "error" : "time", "has no effect with mode reference: use max-error or max-seconds");
  if (goal && chosen.lamp_layers)
    throw UsageError("layers", "lamps does not go with error or time, which choose for themselves");
  call.request.goal = goal;
  if (by_lamp)
    call.by_lamp = parse_lamp_grouping("by-lamp", *by_lamp);
  if (threads)
    chosen.threads = static_cast<int>(parse_integer("threads", *threads, 1, 1'024));
  if (as_png)
    chosen.display = DisplayChoice{call.request.picture.exposure, call.request.picture.transform};
  call.request.stats.emplace(); // figures are wanted
  return call;
}

PictureSettings picture_settings(PictureSettings before, const Settings& settings) {
  for (const auto& [name, value] : settings)
    if (!of_files.contains(name))
      throw UsageError(name, "has no effect on how a picture is written");
  const PictureSettings said = parse_render_settings({}, as_parsed(settings)).picture;
  const auto is_said = [&](const char* name) {
    return std::ranges::find(settings, name, &Settings::value_type::first) != settings.end();
  };
  if (is_said("exposure"))
    before.exposure = said.exposure;
  if (is_said("view-transform"))
    before.transform = said.transform;
  if (is_said("depth"))
    before.png_bits = said.png_bits;
  if (is_said("float"))
    before.exr_type = said.exr_type;
  return before;
}

RunEvents events_of(const Listener& listener) {
  RunEvents events;
  events.warning = listener.warning;
  if (listener.progress)
    events.progress = [&listener](std::string_view stage, double done) {
      if (!listener.progress(std::string(stage), done))
        throw Cancelled{};
    };
  return events;
}

void describe_elements(const ElementMesh& mesh, std::vector<std::uint32_t>* corners,
                       std::vector<std::uint32_t>& nodes) {
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    nodes.push_back(index(mesh.sides[index(mesh.side_of_element[e])].node));
    if (corners)
      for (const ElementVertexId v : mesh.corners[e])
        corners->push_back(index(v));
  }
}

} // namespace meninas
