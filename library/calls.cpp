#include "library/impl.h"

#include "cli/settings.h"
#include "cli/values.h"
#include "runs/resources.h"
#include "scenes/errors.h"
#include "scenes/lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
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
    throw Error(kind_of(error.code()), error.what());
  } catch (const Cancelled&) {
    throw Error(Error::Kind::cancelled, "cancelled");
  } catch (const std::bad_alloc&) {
    throw Error(Error::Kind::output, "out of memory");
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(Error::Kind::input, error.what());
  }
}

/// The room's settings but those that a call says anew, then the call's.
static Settings merged(const Settings& of_room, const Settings& of_call) {
  Settings all;
  for (const auto& setting : of_room)
    if (std::ranges::find(of_call, setting.first, &Settings::value_type::first) == of_call.end())
      all.push_back(setting);
  all.insert(all.end(), of_call.begin(), of_call.end());
  return all;
}

/// The value of a setting that the parser of pictures does not know, taken out; the last word counts.
static std::optional<std::string> taken(Settings& settings, const std::string& name) {
  std::optional<std::string> value;
  std::erase_if(settings, [&](const auto& setting) {
    if (setting.first != name)
      return false;
    value = setting.second;
    return true;
  });
  return value;
}

static LampGrouping grouping_of(const std::string& text) {
  return parse_choice("by-lamp", text.empty() ? "node" : text,
                      Choices<LampGrouping>{{"node", LampGrouping::node},
                                            {"material", LampGrouping::material}});
}

/// What a run that chooses for itself is to reach. The room's quality gives way to it, the call's does not go with it.
static std::optional<Goal> goal_of(const Settings& of_call, Settings& all) {
  std::optional<Goal> goal;
  for (const auto& [name, value] : {std::pair("error", &Goal::error), std::pair("time", &Goal::seconds)})
    if (const auto text = taken(all, name)) {
      goal = goal ? goal : Goal{};
      *goal.*value = parse_number(name, *text, Sign::positive);
      if (std::ranges::find(of_call, "quality", &Settings::value_type::first) != of_call.end())
        throw UsageError("quality", std::string("does not go with ") + name + ", which chooses for itself");
    }
  if (goal)
    taken(all, "quality");
  return goal;
}

Call call_of(const Room::Impl& room, const Settings& settings) {
  Settings all = merged(room.settings, settings);
  const auto goal = goal_of(settings, all);
  const auto threads = taken(all, "threads");
  const auto by_lamp = taken(all, "by-lamp");
  std::vector<Setting> named;
  for (const auto& [name, value] : all)
    named.push_back({name, value.empty() ? std::nullopt : std::optional(value)});
  Call call{parse_render_settings(room.file, named), {}};
  call.request.goal = goal;
  if (by_lamp)
    call.by_lamp = grouping_of(*by_lamp);
  if (threads)
    call.request.settings.threads = static_cast<int>(parse_integer("threads", *threads, 1, 1'024));
  call.request.stats.emplace(); // figures are wanted
  return call;
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
