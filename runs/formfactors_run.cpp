#include "runs/formfactors_run.h"

#include "raytrace/scene_textures.h"
#include "runs/report/csv_field.h"
#include "runs/resources.h"
#include "scenes/gltf/tree.h"
#include "scenes/materials/smooth_surfaces.h"
#include "scenes/rays/mixed_scales.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

namespace meninas {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(NodeFactorMethod method) {
  switch (method) {
  case NodeFactorMethod::analytic:
    return "analytic";
  case NodeFactorMethod::rays:
    return "rays";
  case NodeFactorMethod::hemicube:
    return "hemicube";
  }
  return "";
}

/// The mirrors of a chain, each by its node or its nodes.
std::vector<std::string> mirror_names(const Scene& scene, const MirrorSet& mirrors,
                                      const std::vector<MirrorId>& chain) {
  std::vector<std::string> names;
  for (const MirrorId id : chain) {
    std::vector<std::string> parts;
    for (const NodeId node : mirrors.mirrors[index(id)].nodes) {
      parts.push_back(scene.nodes[index(node)].name);
    }
    names.push_back(fmt::format("{}", fmt::join(parts, "+")));
  }
  return names;
}

const char* name_of(NodeSides sides) {
  switch (sides) {
  case NodeSides::facing:
    return "facing";
  case NodeSides::front:
    return "front";
  case NodeSides::back:
    return "back";
  case NodeSides::both:
    return "both";
  }
  return "";
}

void warn_of_error(const NodeFactors& factors, double accuracy, const std::string& from,
                   const RunEvents& events) {
  if (!factors.converged) {
    double error = 0.0;
    for (const ExtendedFactor& factor : factors.to) {
      error = std::max(error, factor.total.error);
    }
    warn(events, fmt::format("from '{}': the accuracy of {:.2g} was not reached, the error may be "
                             "{:.2g}",
                             from, accuracy, error));
  }
}

/// Which sides of A count, where that is not all fronts.
std::string sides_text(const NodeFactors& factors) {
  if (factors.backs == 0.0) {
    return "";
  }
  return factors.fronts == 0.0
             ? " of backs"
             : fmt::format(", {:.6g} m^2 of them backs", factors.backs);
}

/// What does not count, said of one pair or of many: each line once, with the first it is said of.
class NotCounted {
public:
  void add(const std::string& of, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      const auto known = std::ranges::find(lines_, line, &std::pair<std::string, Names>::first);
      Names& names = known != lines_.end() ? known->second : lines_.emplace_back(line, Names{}).second;
      names.first = names.count == 0 ? of : names.first;
      ++names.count;
    }
  }
  void say(const RunEvents& events) const {
    for (const auto& [line, names] : lines_) {
      const std::string more = names.count > 1 ? fmt::format(" and {} more", names.count - 1) : "";
      warn(events, fmt::format("from {}{}: {}", names.first, more, line));
    }
  }

private:
  struct Names {
    std::string first;
    std::size_t count = 0;
  };
  std::vector<std::pair<std::string, Names>> lines_;
};

std::string as_text(const Scene& scene, const FormFactorsRequest& request,
                    const NodeFactors& factors, double seconds) {
  constexpr std::size_t max_worlds = 24;
  const ExtendedFactor& factor = factors.to.front();
  std::string text = fmt::format("{:<18}{}\n", "scene", scene.file);
  text += fmt::format("{:<18}{}, {:.6g} m^2{}\n", "from", request.from, factors.area,
                      sides_text(factors));
  text += fmt::format("{:<18}{}\n", "to", request.to);
  text += fmt::format("{:<18}{:.10g}\n", "form factor", factor.total.value);
  text += fmt::format("{:<18}{:.2g}{}\n", "error estimate", factor.total.error,
                      request.factors.method == NodeFactorMethod::rays ? ", standard error" : "");
  text += fmt::format("{:<18}{}, {:.3f} s\n", "method", name_of(request.factors.method), seconds);
  for (std::size_t k = 0; k < std::min(max_worlds, factor.worlds.size()); ++k) {
    const WorldFactor& world = factor.worlds[k];
    const auto names = mirror_names(scene, factors.mirrors, world.chain);
    const std::string weight =
        world.chain.empty() ? "" : fmt::format(", times {:.6g}", mean_of(world.throughput));
    text += fmt::format("{:<18}{:.10g}, {}{}\n", k == 0 ? "worlds" : "", world.factor.value,
                        names.empty() ? "direct" : fmt::format("by {}", fmt::join(names, ", ")),
                        weight);
  }
  if (factor.worlds.size() > max_worlds) {
    text += fmt::format("{:<18}and {} more\n", "", factor.worlds.size() - max_worlds);
  }
  return text;
}

std::string as_json(const Scene& scene, const FormFactorsRequest& request,
                    const NodeFactors& factors, double seconds) {
  const ExtendedFactor& factor = factors.to.front();
  Json worlds = Json::array();
  for (const WorldFactor& world : factor.worlds) {
    const Rgb& tau = world.throughput;
    worlds.push_back({{"mirrors", mirror_names(scene, factors.mirrors, world.chain)},
                      {"form_factor", world.factor.value},
                      {"throughput", Json::array({tau.r, tau.g, tau.b})}});
  }
  const Json units{{"area", "m^2"},
                   {"form_factor", "1"},
                   {"error_estimate", "1"},
                   {"throughput", "1"},
                   {"seconds", "s"}};
  const Json json{{"units", units},
                  {"from", request.from},
                  {"to", request.to},
                  {"sides", name_of(request.factors.sides)},
                  {"area", factors.area},
                  {"form_factor", factor.total.value},
                  {"error_estimate", factor.total.error},
                  {"worlds", worlds},
                  {"method", name_of(request.factors.method)},
                  {"seconds", seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// The nodes that scatter light; those of one name are one.
std::vector<NodeSet> scattering_nodes(const Scene& scene, const SurfaceModel& surfaces) {
  std::vector<std::uint8_t> scatters(scene.nodes.size(), 0);
  for (const Patch& patch : surfaces.patches) {
    if (!is_mirror(scene.materials[index(patch.material)])) {
      scatters[index(patch.node)] = 1;
    }
  }
  std::map<std::string, std::size_t> known;
  std::vector<NodeSet> sets;
  for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
    if (scatters[n] == 0) {
      continue;
    }
    const auto [place, is_new] = known.try_emplace(scene.nodes[n].name, sets.size());
    if (is_new) {
      sets.emplace_back();
    }
    sets[place->second].push_back(NodeId{n});
  }
  return sets;
}

std::string matrix(const Scene& scene, const SurfaceModel& surfaces,
                   const FormFactorsRequest& request, const RunEvents& events) {
  const std::vector<NodeSet> nodes = scattering_nodes(scene, surfaces);
  NotCounted not_counted;
  std::string text = "from";
  for (const NodeSet& set : nodes) {
    text += ',' + csv_field(scene.nodes[index(set.front())].name);
  }
  text += ",sum\n";
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const std::string& name = scene.nodes[index(nodes[n].front())].name;
    const NodeFactors factors =
        node_form_factors(scene, surfaces, nodes[n], nodes, request.factors);
    warn_of_error(factors, request.factors.accuracy, name, events);
    not_counted.add(fmt::format("'{}'", name), factors.not_counted);
    text += csv_field(name);
    double sum = 0.0;
    for (const ExtendedFactor& factor : factors.to) {
      sum += factor.total.value;
      text += fmt::format(",{:.10g}", factor.total.value);
    }
    text += fmt::format(",{:.10g}\n", sum);
    if (events.progress) {
      events.progress("form factors",
                      static_cast<double>(n + 1) / static_cast<double>(nodes.size()));
    }
  }
  not_counted.say(events);
  return text;
}

NodeSet nodes_of(const Scene& scene, std::span<const FileNode> tree, const std::string& name,
                 const RunEvents& events) {
  NamedNodes named = nodes_called(scene, tree, name);
  if (named.below > 0) {
    warn(events, fmt::format("'{}' stands for its own mesh; {} below it do not count", name,
                             named.below == 1 ? "that of the node"
                                              : fmt::format("those of the {} nodes", named.below)));
  }
  return std::move(named.nodes);
}

} // namespace

std::string formfactors_run(const FormFactorsRequest& request, const RunEvents& events) {
  const ThreadLimit limit(request.threads);
  Scene scene = load_gltf(request.scene, request.gltf);
  settle_textures(scene, scene.warnings);
  // Between surfaces; what a coat throws is their own reflectance's affair.
  spread_coats(scene);
  for (const std::string& warning : scene.warnings) {
    warn(events, warning);
  }
  for (const Material& material : scene.materials) {
    if (material.alpha_mode == AlphaMode::mask) {
      warn(events, fmt::format("cut-outs count as opaque, material '{}'", material.name));
    }
  }
  const SurfaceModel surfaces = find_surfaces(scene);
  const auto mixed =
      request.factors.method == NodeFactorMethod::analytic
          ? warnings_of_merged_planes(scene, surfaces)
          : warnings_of_mixed_scales(scene, surfaces, make_ray_scene(scene, surfaces));
  for (const std::string& warning : mixed) {
    warn(events, warning);
  }
  if (request.format == FormFactorsFormat::matrix) {
    return matrix(scene, surfaces, request, events);
  }
  const auto tree = read_node_tree(request.scene, request.gltf);
  const NodeSet from = nodes_of(scene, tree, request.from, events);
  const std::array to{nodes_of(scene, tree, request.to, events)};
  Stopwatch watch;
  const NodeFactors factors = node_form_factors(scene, surfaces, from, to, request.factors);
  const double seconds = watch.lap();
  warn_of_error(factors, request.factors.accuracy, request.from, events);
  NotCounted not_counted;
  not_counted.add(fmt::format("'{}' to '{}'", request.from, request.to), factors.not_counted);
  not_counted.say(events);
  return request.format == FormFactorsFormat::json ? as_json(scene, request, factors, seconds)
                                                   : as_text(scene, request, factors, seconds);
}

} // namespace meninas
