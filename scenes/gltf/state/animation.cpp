#include "scenes/gltf/state/animation.h"

#include "scenes/gltf/accessors.h"
#include "scenes/gltf/state/key_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace meninas::gltf {

namespace {

/// A channel that moves something, and how to speak of it.
struct Channel {
  std::size_t animation = 0, number = 0;
  std::size_t node = 0;
  std::string path; ///< of the node: translation, rotation, scale, weights
};

/// By what they move.
using Channels = std::map<std::pair<std::size_t, std::string>, Channel>;

/// What a channel's numbers are.
struct Quantity {
  std::size_t width = 3;  ///< numbers of an element of its accessor
  std::size_t values = 1; ///< elements that make one value: of weights as many as targets
};

struct DecodedKeys {
  std::vector<double> times, values;
};

std::string where_of(const Json& root, const Channel& channel) {
  return fmt::format("{}, channel {}", place(root, "animations", channel.animation),
                     channel.number);
}

/// How many morph targets the node's mesh has.
std::size_t target_count(const Json& root, const Json& node) {
  const auto mesh = index_at(node, "mesh");
  if (!mesh)
    return 0;
  for (const auto& primitive : element(root, "meshes", *mesh)["primitives"])
    if (const auto* targets = find(primitive, "targets"))
      return targets->size();
  return 0;
}

/// Whether there is something for the channel to move; says why not.
bool moves_something(const Json& root, const Channel& channel, Findings& findings) {
  const auto& node = element(root, "nodes", channel.node);
  const auto name = place(root, "nodes", channel.node);
  if (channel.path == "weights") {
    if (target_count(root, node) > 0)
      return true;
    findings.about("animated weights of nodes without morph targets are left out", name);
    return false;
  }
  if (channel.path != "translation" && channel.path != "rotation" && channel.path != "scale") {
    findings.about("animated properties are left out", one_line(channel.path));
    return false;
  }
  if (!node.contains("matrix"))
    return true;
  findings.about("animated nodes that have a matrix stay where it puts them", name);
  return false;
}

Channels find_channels(const Document& document, Findings& findings) {
  const Json& root = document.root;
  Channels channels;
  for (std::size_t a = 0; a < count_of(root, "animations"); ++a) {
    const auto* list = find(element(root, "animations", a), "channels");
    for (std::size_t k = 0; list && k < list->size(); ++k) {
      const auto* target = find((*list)[k], "target");
      const auto node = target ? index_at(*target, "node") : std::nullopt;
      if (!node)
        continue; // glTF 2.0, 3.11: of an extension, which is named
      const Channel channel{a, k, *node, text_or(*target, "path", "")};
      if (!moves_something(root, channel, findings))
        continue;
      if (!channels.insert_or_assign({*node, channel.path}, channel).second)
        findings.about("several animations move nodes, the last in the file does",
                       place(root, "nodes", *node));
    }
  }
  return channels;
}

Quantity quantity_of(const Json& root, const Channel& channel) {
  if (channel.path == "weights")
    return {1, target_count(root, element(root, "nodes", channel.node))};
  return {channel.path == "rotation" ? std::size_t{4} : std::size_t{3}, 1};
}

const Json& sampler_of(const Document& document, const Channel& channel) {
  const auto& animation = element(document.root, "animations", channel.animation);
  const auto number = index_at(animation["channels"][channel.number], "sampler");
  const auto* samplers = find(animation, "samplers");
  const auto count = samplers ? samplers->size() : 0;
  const auto where = where_of(document.root, channel);
  if (!number || *number >= count)
    throw InputError(document.file, where,
                     number ? fmt::format("'sampler' is index {} of samplers, there are {}",
                                          *number, count)
                            : std::string("has no 'sampler'"));
  const auto& sampler = (*samplers)[*number];
  for (const char* name : {"input", "output"})
    if (!sampler.contains(name))
      throw InputError(document.file, where, fmt::format("its sampler has no '{}'", name));
  return sampler;
}

KeyInterpolation interpolation_of(const Document& document, const Channel& channel) {
  const auto name = text_or(sampler_of(document, channel), "interpolation", "LINEAR");
  if (name == "LINEAR")
    return KeyInterpolation::linear;
  if (name == "STEP")
    return KeyInterpolation::step;
  if (name == "CUBICSPLINE")
    return KeyInterpolation::cubic_spline;
  throw InputError(document.file, where_of(document.root, channel),
                   fmt::format("interpolation '{}' does not exist", one_line(name)));
}

void check_times(const Document& document, const Channel& channel,
                 std::span<const double> times) {
  const auto fail = [&](const std::string& what) {
    throw InputError(document.file, where_of(document.root, channel), what);
  };
  if (times.empty())
    fail("has no keys");
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k]))
      fail(fmt::format("the time of key {} is not finite", k));
    if (k > 0 && times[k] < times[k - 1])
      fail(fmt::format("key {}, at {:g} s, is after that at {:g} s", k, times[k], times[k - 1]));
  }
}

DecodedKeys decode_keys(const Document& document, const Channel& channel,
                        KeyInterpolation interpolation) {
  const Json& sampler = sampler_of(document, channel);
  const auto where = where_of(document.root, channel);
  DecodedKeys keys;
  keys.times = decode_vectors(document, *index_at(sampler, "input"), 1).values;
  check_times(document, channel, keys.times);
  const Quantity quantity = quantity_of(document.root, channel);
  const auto output = *index_at(sampler, "output");
  const auto needed = keys.times.size() * elements_per_key(interpolation) * quantity.values;
  if (const auto count = accessor_count(document, output); count != needed)
    throw InputError(document.file, where,
                     fmt::format("{} keys of '{}' need {} values, there are {}", keys.times.size(),
                                 channel.path, needed, count));
  keys.values = decode_vectors(document, output, quantity.width).values;
  if (!std::ranges::all_of(keys.values, [](double x) { return std::isfinite(x); }))
    throw InputError(document.file, where, "a value is not finite");
  return keys;
}

/// Many channels may name one accessor, so that a small file can ask for any amount of work.
void check_amount(const Document& document, const Channels& channels) {
  constexpr std::uint64_t most = 50'000'000;
  std::uint64_t numbers = 0;
  for (const auto& [target, channel] : channels) {
    const Json& sampler = sampler_of(document, channel);
    const auto width = quantity_of(document.root, channel).width;
    for (const auto& [name, size] : {std::pair("input", std::size_t{1}), std::pair("output", width)}) {
      const auto count = accessor_count(document, *index_at(sampler, name));
      if (count > most || (numbers += count * size) > most)
        throw OutputError(document.file, where_of(document.root, channel),
                          fmt::format("up to here animations have over {} numbers, more than are "
                                      "read",
                                      most));
    }
  }
}

void write_pose(Document& document, const Channel& channel, double seconds, double& end,
                Findings& findings) {
  const KeyInterpolation interpolation = interpolation_of(document, channel);
  const DecodedKeys decoded = decode_keys(document, channel, interpolation);
  const Quantity quantity = quantity_of(document.root, channel);
  const KeyFrames keys{interpolation, quantity.width * quantity.values, decoded.times,
                       decoded.values};
  Json& property = document.root["nodes"][channel.node][channel.path];
  end = std::max(end, decoded.times.back());
  if (channel.path != "rotation") {
    property = value_at(keys, seconds);
    return;
  }
  const auto rotation = rotation_at(keys, seconds);
  if (rotation == std::array<double, 4>{}) {
    findings.about("animated rotations that are zero turn nothing, of nodes",
                   place(document.root, "nodes", channel.node));
    property = {0.0, 0.0, 0.0, 1.0};
    return;
  }
  property = rotation;
}

} // namespace

void pose_at(Document& document, double seconds, Findings& findings) {
  const Channels channels = find_channels(document, findings);
  if (channels.empty()) {
    findings.say("the file has no animation for --at: the rest pose is shown");
    return;
  }
  check_amount(document, channels);
  double end = -std::numeric_limits<double>::infinity();
  for (const auto& [target, channel] : channels)
    write_pose(document, channel, seconds, end, findings);
  if (seconds > end)
    findings.say(fmt::format("--at {:g} is after the end of the animations, at {:g} s: that is shown",
                             seconds, end));
}

} // namespace meninas::gltf
