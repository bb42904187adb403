#include "runs/plan_run.h"

#include "runs/steering/expected_cost.h"
#include "runs/steering/memory.h"
#include "runs/preparation.h"
#include "runs/resources.h"
#include "runs/report/percent.h"
#include "runs/report/stats.h"
#include "scenes/report/scene_report.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace meninas {
namespace {

std::string list(const std::string& title, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text +=
        text.empty() ? fmt::format("{:<18}{}\n", title, line) : fmt::format("{:<18}{}\n", "", line);
  }
  return text;
}

std::string fact(const std::string& title, const std::string& value) {
  return fmt::format("{:<18}{}\n", title, value);
}

std::vector<std::string> describe_mirrors(const TransportPlan& plan) {
  std::vector<std::string> lines;
  for (const PlannedMirror& mirror : plan.mirror_list) {
    const Rgb& rho = mirror.reflectance;
    lines.push_back(fmt::format("{}, {:.4g} m^2, reflectance {:.3g} {:.3g} {:.3g}", mirror.name,
                                mirror.area, rho.r, rho.g, rho.b));
  }
  if (lines.empty()) {
    lines.emplace_back("none");
  }
  return lines;
}

std::vector<std::string> describe_worlds(const TransportPlan& plan) {
  const WorldTree& worlds = plan.worlds;
  std::vector<std::string> lines{fmt::format("{}", worlds.worlds.size() - 1)};
  if (worlds.considered == 0) {
    return lines;
  }
  lines.front() += fmt::format(" of {} considered", worlds.considered);
  const auto leave_out = [&](std::size_t count, const char* why) {
    if (count > 0)
      lines.front() += fmt::format("; {} {}", count, why);
  };
  leave_out(worlds.pruned_unseen, "that no surface sees");
  leave_out(worlds.pruned_throughput, "too faint to matter");
  leave_out(worlds.pruned_limit, "with more mirrors in a row than are followed");
  if (plan.mirror_depth_bound > 0.0) {
    lines.push_back(fmt::format("longer rows of mirrors bring at most {} of the light; rays follow them",
                                readable_percent(plan.mirror_depth_bound)));
  }
  return lines;
}

/// A sentence each; of every kind the first few.
std::vector<std::string> describe_oddities(std::span<const Oddity> odd) {
  constexpr std::size_t few = 6;
  std::map<std::string, std::size_t> told;
  std::vector<std::string> lines;
  for (const Oddity& one : odd) {
    if (++told[one.kind] <= few) {
      lines.push_back(one.text);
    }
  }
  for (const auto& [kind, count] : told) {
    if (count > few) {
      lines.push_back(fmt::format("{} more of {}: --json lists all", count - few, kind));
    }
  }
  return lines;
}

std::string describe_cost(const ExpectedCost& cost, int threads) {
  return fmt::format(
      "a picture takes about {:.2g} s with {} threads ({:.2g} s of it pass one) and {}", cost.total,
      threads, cost.form_factors + cost.solve + cost.interpolate, readable_bytes(cost.bytes));
}

/// Their names, and what telling them apart takes beyond a picture; empty where there are none.
std::string describe_lamps(const Scene& scene, const ExpectedCost& expected, PictureSize size,
                           RunSettings settings) {
  const std::vector<std::string> names = find_lamps(scene, LampGrouping::node).names;
  if (names.empty())
    return "";
  settings.lamps = LampGrouping::node;
  const std::uint64_t apart = expected_memory(sizes_of(scene, settings.lamps), settings, size);
  return fmt::format("'{}': --lamp NAME=FACTOR dims one; --by-lamp tells them apart in {} more",
                     fmt::join(names, "', '"), readable_bytes(apart - std::min(apart, expected.bytes)));
}

std::string plan_text(const PreparedScene& prepared, const TransportPlan& plan,
                      const ExpectedCost& expected, int threads, std::span<const Oddity> odd,
                      const std::string& lamps) {
  std::string text = fact("scene", prepared.scene.file);
  text += list("mirrors", describe_mirrors(plan));
  text += list("mirror worlds", describe_worlds(plan));
  text += fact("emitters", fmt::format("{} {}", plan.emitters,
                                    plan.emitters == 1 ? "face glows" : "faces glow"));
  text += fact("punctual lights", std::to_string(plan.punctual_lights));
  if (plan.area_lights > 0)
    text += fact("area lights", std::to_string(plan.area_lights));
  if (!lamps.empty())
    text += fact("lamps", lamps);
  if (const std::size_t openings = prepared.light()->portals.size(); openings > 0)
    text += fact("openings", fmt::format("{} to the sky", openings));
  text += fact("materials", fmt::format("{} glossy, {} transmissive, {} textured", plan.glossy,
                                        plan.transmissive, plan.textured));
  if (const auto& variants = prepared.scene.variants; !variants.empty())
    text += fact("variants", fmt::format("'{}': --variant NAME chooses one", fmt::join(variants, "', '")));
  text += fact("colours", plan.bands == 1 ? "one channel: everything is grey" : "three channels");
  text += fact("closed", plan.closed ? "yes, no light can escape" : "no, light can escape");
  text += fact("mesh", fmt::format("{} faces divided into {} elements",
                                   prepared.surfaces.patches.size(), element_count(prepared.mesh)));
  text += fact("expected", describe_cost(expected, threads));
  text += list("stages", plan.stages);
  text += list("ignored", plan.ignored);
  text += list("warnings", plan.warnings);
  text += list("odd", describe_oddities(odd));
  return text;
}

} // namespace

std::string plan_run(const PlanRequest& request) {
  const ThreadLimit limit(request.settings.threads);
  Stopwatch watch;
  Scene scene = load_scene(request.scene, request.settings);
  const double loading = watch.lap();
  return plan_of(std::move(scene), loading, request);
}

std::string plan_of(Scene scene, double loading, const PlanRequest& request) {
  const ThreadLimit limit(request.settings.threads);
  const PassOneSettings settings = two_pass_settings(request.settings).pass_one;
  const Camera chosen = choose_camera(scene, request.camera, request.settings, {});
  const PictureSize size = choose_size(request.size, chosen);
  std::vector<std::string> of_camera;
  const Camera camera = cut_open(
      scene, chosen, size,
      {.warning = [&](const std::string& text) { of_camera.push_back(text); }, .note = {},
       .progress = {}, .stages = {}});
  const auto prepared = prepare_scene(std::move(scene), settings);
  const ExpectedCost expected =
      expect_cost(*prepared, camera, size, request.settings, loading, limit.threads());
  TransportPlan plan = prepared->plan;
  std::ranges::copy(of_camera, std::back_inserter(plan.warnings));
  if (expected.bytes > memory_limit(request.settings)) {
    plan.warnings.push_back(fmt::format(
        "a run needs about {}, more than the memory limit of {}, and would be refused",
        readable_bytes(expected.bytes), readable_bytes(memory_limit(request.settings))));
  }
  const std::size_t elements = element_count(prepared->mesh);
  const std::size_t patches = prepared->surfaces.patches.size();
  const auto odd = report_scene(prepared->scene, prepared->surfaces, *prepared->rays);
  return request.format == PlanFormat::json
             ? plan_json(plan, prepared->scene.variants, patches, elements, expected, odd)
             : plan_text(*prepared, plan, expected, limit.threads(), odd,
                         describe_lamps(prepared->scene, expected, size, request.settings));
}

} // namespace meninas
