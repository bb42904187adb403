#include "runs/trade/trade_report.h"

#include "image/display.h"
#include "runs/pages/trade_page.h"
#include "runs/report/csv_field.h"
#include "runs/report/page.h"
#include "runs/report/thumbnail.h"
#include "runs/steering/setting_options.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

using Json = nlohmann::ordered_json;

std::string command_of(const TradeResult& result, const TradePoint& point) {
  std::string command = "meninas render " + shell_quoted(result.scene.string()) + " -o out.exr";
  const Image& picture = result.reference.mean;
  command += fmt::format(" --size {}x{}", picture.width, picture.height);
  if (result.camera)
    command += " --camera " + shell_quoted(*result.camera);
  for (const std::string& option : options_of(point.settings))
    command += ' ' + shell_quoted(option);
  return command;
}

Json stages_json(const RunSeconds& seconds) {
  return {{"plan", seconds.plan},
          {"mesh", seconds.mesh},
          {"form_factors", seconds.form_factors},
          {"solve", seconds.solve},
          {"interpolate", seconds.interpolate},
          {"render", seconds.render}};
}

Json point_json(const TradeResult& result, std::size_t id, bool on_front) {
  const TradePoint& point = result.points[id];
  Json json{{"id", id},
            {"command", command_of(result, point)},
            {"options", options_of(point.settings)},
            {"elements", point.elements},
            {"seconds", mean_of(point.seconds)},
            {"seconds_spread", spread_of(point.seconds)},
            {"processor_seconds", mean_of(point.processor_seconds)},
            {"error", mean_of(point.errors)},
            {"error_spread", spread_of(point.errors)},
            {"runs", point.seconds.size()},
            {"estimate", point.estimate.total},
            {"front", on_front},
            {"stages", stages_json(point.stages)}};
  for (const ParameterChange& turn : point.turns)
    json["turn"] = {
        {"knob", turn.parameter}, {"from", turn.from}, {"to", turn.to}, {"parent", turn.parent}};
  return json;
}

/// How much accuracy a second buys: the fall of log error less its price,
/// half the rise of log seconds, as samples at random would pay.
double worth(const ParameterWorth& parameter) { return -std::log(parameter.error) - 0.5 * std::log(parameter.seconds); }

/// "+10 % time", "-3 % error", "the same time", "4.2 times the time"
std::string readable_change(double ratio, std::string_view what) {
  constexpr double twice = 2.0, half_a_percent = 0.005;
  if (std::abs(ratio - 1.0) <= half_a_percent)
    return fmt::format("the same {}", what);
  return ratio < twice ? fmt::format("{:+.0f} % {}", 100.0 * (ratio - 1.0), what)
                         : fmt::format("{:.2g} times the {}", ratio, what);
}

std::string conclusion_of(const std::vector<ParameterWorth>& parameters) {
  if (parameters.empty())
    return "The budget was too short to change a setting of the draft.";
  const auto say = [](const ParameterWorth& k) {
    return fmt::format("{} from {} to {} ({}, {})", k.turn.parameter, k.turn.from, k.turn.to,
                       readable_change(k.seconds, "time"), readable_change(k.error, "error"));
  };
  if (worth(parameters.front()) <= 0.0)
    return "Draft is already efficient here. The best single change is " + say(parameters.front()) + ".";
  return "From the draft, change first " + say(parameters.front()) +
         (parameters.size() > 1 && worth(parameters[1]) > 0.0 ? ", then " + say(parameters[1]) : "") + ".";
}

Json json_of(const TradeResult& result) {
  const auto front = pareto_front(result.points);
  Json points = Json::array(), parameters = Json::array();
  for (std::size_t k = 0; k < result.points.size(); ++k)
    points.push_back(point_json(result, k, std::ranges::find(front, k) != front.end()));
  const std::vector<ParameterWorth> worths = parameter_worths(result);
  for (const ParameterWorth& parameter : worths)
    parameters.push_back({{"knob", parameter.turn.parameter},
                     {"from", parameter.turn.from},
                     {"to", parameter.turn.to},
                     {"point", parameter.point},
                     {"seconds_ratio", parameter.seconds},
                     {"error_ratio", parameter.error}});
  const TradeReference& reference = result.reference;
  Json units;
  for (const char* key : {"seconds", "processor_seconds", "stages", "budget", "spent"})
    units[key] = "s";
  for (const char* key : {"error", "error_spread", "seconds_spread", "estimate", "noise", "floor", "seconds_ratio", "error_ratio"})
    units[key] = "1";
  return {{"units", std::move(units)},
          {"scene", result.scene.filename().string()},
          {"camera", result.camera ? Json(*result.camera) : Json()},
          {"width", reference.mean.width},
          {"height", reference.mean.height},
          {"threads", result.threads},
          {"budget", result.budget},
          {"spent", result.spent},
          {"reference",
           {{"kind", reference.kind},
            {"name", reference.name},
            {"seconds", reference.seconds},
            {"noise", reference.noise},
            {"floor", reference.floor}}},
          {"front", front},
          {"points", std::move(points)},
          {"knobs", std::move(parameters)},
          {"conclusion", conclusion_of(worths)},
          {"version", program_version()}};
}

} // namespace

std::vector<ParameterWorth> parameter_worths(const TradeResult& result) {
  std::vector<ParameterWorth> parameters;
  const std::size_t draft = std::min<std::size_t>(1, result.points.size() - 1);
  for (std::size_t k = 0; k < result.points.size(); ++k)
    for (const ParameterChange& turn : result.points[k].turns) {
      const TradePoint &before = result.points[turn.parent], &after = result.points[k];
      if (turn.parent != draft || !(mean_of(before.errors) > 0.0) || !(mean_of(after.errors) > 0.0))
        continue;
      parameters.push_back({turn, k, mean_of(after.seconds) / mean_of(before.seconds),
                       mean_of(after.errors) / mean_of(before.errors)});
    }
  std::ranges::stable_sort(
      parameters, [](const ParameterWorth& a, const ParameterWorth& b) { return worth(a) > worth(b); });
  return parameters;
}

std::string trade_json(const TradeResult& result) { return text_of(json_of(result), 2) + '\n'; }

std::string trade_csv(const TradeResult& result) {
  std::string text = "id,front,seconds,processor_seconds,error,estimate,runs,elements,command\n";
  const Json json = json_of(result);
  for (const Json& point : json["points"]) {
    std::string line;
    for (const char* column :
         {"id", "front", "seconds", "processor_seconds", "error", "estimate", "runs", "elements"})
      line += point[column].dump() + ',';
    text += line + csv_field(point["command"].get<std::string>()) + '\n';
  }
  return text;
}

std::string trade_page_of(const TradeResult& result) {
  constexpr int longest_side = 200;
  Json json = json_of(result);
  const double exposure = automatic_exposure(result.reference.mean);
  const auto small = [&](const Image& picture) {
    return png_address(thumbnail(picture, longest_side),
                       {.exposure = exposure, .transform = ViewTransform::neutral});
  };
  Json pictures = Json::array();
  for (const TradePoint& point : result.points)
    pictures.push_back(small(point.picture));
  return fill_page(trade_page, text_of({{"trade", std::move(json)},
                                        {"thumbnails", std::move(pictures)},
                                        {"reference_thumbnail", small(result.reference.mean)}},
                                       -1));
}

} // namespace meninas
