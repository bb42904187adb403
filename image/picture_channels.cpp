#include "image/picture_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <span>
#include <tuple>

namespace meninas {

namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= name.size();) {
    const auto end = std::min(name.find('.', begin), name.size());
    words.push_back(lower(name.substr(begin, end - begin)));
    begin = end + 1;
  }
  return words;
}

/// `luminance` is the y of a vector, too.
enum class Component { red, green, blue, alpha, luminance, x, z, other };

Component component_of(const std::string& word) {
  const auto name = lower(word);
  if (name == "r" || name == "red")
    return Component::red;
  if (name == "g" || name == "green")
    return Component::green;
  if (name == "b" || name == "blue")
    return Component::blue;
  if (name == "a" || name == "alpha")
    return Component::alpha;
  if (name == "x")
    return Component::x;
  if (name == "z")
    return Component::z;
  return name == "y" ? Component::luminance : Component::other;
}

/// Channels of one part with one prefix.
struct Group {
  std::string name;
  std::size_t part = 0;
  bool plain = false; ///< no prefix within the part
  std::map<Component, int> channels;

  bool has(Component component) const { return channels.contains(component); }
  bool is_colour() const {
    return has(Component::red) && has(Component::green) && has(Component::blue);
  }
  bool is_grey() const { return has(Component::luminance) && !has(Component::x); }
  /// Layers that no picture is: of a normal, say, or of a depth.
  bool is_vector() const {
    return !plain && has(Component::x) && has(Component::luminance) && has(Component::z);
  }
  bool is_depth() const {
    return !plain && has(Component::z) && !has(Component::x) && !has(Component::luminance);
  }
};

/// Some decoders leave grey pictures unnamed; what is no EXR has its channels in one order.
std::string channel_name(const decoder::Decoded& decoded, const decoder::DecodedPart& part, int c) {
  if (decoded.code_values != 0 && part.channels <= 2)
    return c == 0 ? "Y" : "A";
  return part.channel_names[c];
}

std::string part_name(const decoder::Decoded& decoded, std::size_t number) {
  const std::string name = decoded.parts[number].name;
  if (decoded.part_count == 1)
    return "";
  return name.empty() ? fmt::format("part{}", number) : name;
}

/// The prefix by which a group of a part is asked for.
std::string full_prefix(const std::string& part, const std::string& prefix) {
  if (part.empty() || prefix == part || prefix.starts_with(part + "."))
    return prefix;
  return prefix.empty() ? part : part + "." + prefix;
}

struct Found {
  std::vector<Group> groups;
  std::vector<std::pair<std::string, Component>> names; ///< of all channels
  std::vector<std::size_t> group_of;                    ///< the same, the numbers of their groups
};

Found find_groups(const decoder::Decoded& decoded) {
  Found found;
  for (std::size_t p = 0; p < decoded.part_count; ++p) {
    const auto& part = decoded.parts[p];
    if (part.pixels == nullptr)
      continue;
    std::map<std::string, std::size_t> numbers;
    for (int c = 0; c < part.channels; ++c) {
      const std::string channel = channel_name(decoded, part, c);
      const auto dot = channel.rfind('.');
      const auto prefix = dot == std::string::npos ? "" : channel.substr(0, dot);
      const auto component =
          component_of(dot == std::string::npos ? channel : channel.substr(dot + 1));
      const auto [place, is_new] = numbers.try_emplace(prefix, found.groups.size());
      if (is_new)
        found.groups.push_back(
            {full_prefix(part_name(decoded, p), prefix), p, prefix.empty(), {}});
      const bool first = component != Component::other &&
                         found.groups[place->second].channels.emplace(component, c).second;
      found.names.emplace_back(full_prefix(part_name(decoded, p), channel),
                               first ? component : Component::other);
      found.group_of.push_back(place->second);
    }
  }
  return found;
}

ColourChannels colour_of(const Group& group) {
  ColourChannels colour{group.name, group.part, {}, std::nullopt};
  if (group.is_colour())
    colour.components = {group.channels.at(Component::red), group.channels.at(Component::green),
                         group.channels.at(Component::blue)};
  else if (group.is_vector())
    colour.components = {group.channels.at(Component::x), group.channels.at(Component::luminance),
                         group.channels.at(Component::z)};
  else if (group.is_depth())
    colour.components.fill(group.channels.at(Component::z));
  else
    colour.components.fill(group.channels.at(Component::luminance));
  if (group.has(Component::alpha))
    colour.alpha = group.channels.at(Component::alpha);
  return colour;
}

/// How surely a colour is the picture, by its name: the smaller the surer.
constexpr int unknown = 9;
int rank_of(const Group& group) {
  if (group.plain)
    return 0;
  const auto words = words_of(group.name);
  const auto combined = std::ranges::find(words, "combined");
  if (combined != words.end())
    return words.front() == "composite" ? 1 : 2;
  constexpr std::array pictures{"beauty", "rgba", "rgb", "color", "colour", "image", "final", "main"};
  return std::ranges::find(pictures, words.back()) != pictures.end() ? 3 : unknown;
}

std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t most = 8;
  if (names.size() > most) {
    names.resize(most);
    names.emplace_back("...");
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The number of the group that is the picture, or why none is.
std::optional<std::size_t> choose_picture(const Found& found, std::string& problem) {
  std::vector<std::size_t> colours, greys;
  for (std::size_t g = 0; g < found.groups.size(); ++g) {
    if (found.groups[g].is_colour())
      colours.push_back(g);
    else if (found.groups[g].is_grey())
      greys.push_back(g);
  }
  if (!colours.empty()) {
    const auto best = *std::ranges::min_element(
        colours, {}, [&](std::size_t g) { return std::pair(rank_of(found.groups[g]), g); });
    if (rank_of(found.groups[best]) < unknown || colours.size() == 1)
      return best;
    std::vector<std::string> names;
    for (const std::size_t g : colours)
      names.push_back(found.groups[g].name);
    problem = fmt::format("which of its layers is the picture? There is {}", some_of(names));
    return std::nullopt;
  }
  const auto plain =
      std::ranges::find_if(greys, [&](std::size_t g) { return found.groups[g].plain; });
  if (plain != greys.end())
    return *plain;
  if (greys.size() == 1)
    return greys.front();
  std::vector<std::string> names;
  for (const auto& [name, component] : found.names)
    names.push_back(name);
  std::ranges::sort(names);
  problem = fmt::format("holds no channels R, G and B, only {}", some_of(names));
  return std::nullopt;
}

} // namespace

PictureChannels picture_channels(const decoder::Decoded& decoded) {
  const Found found = find_groups(decoded);
  PictureChannels result;
  const auto picture = choose_picture(found, result.problem);
  std::vector<std::uint8_t> used(found.groups.size(), 0);
  for (std::size_t g = 0; g < found.groups.size(); ++g) {
    const Group& group = found.groups[g];
    if (g == picture) {
      result.picture = colour_of(group);
      if (group.plain && (decoded.part_count == 1 || group.part == 0))
        result.picture->name.clear();
    } else if (group.is_colour() || group.is_vector() || group.is_depth()) {
      result.layers.push_back(colour_of(group));
    } else {
      continue;
    }
    used[g] = 1;
  }
  std::ranges::sort(result.layers, {}, &ColourChannels::name);
  for (std::size_t k = 0; k < found.names.size(); ++k) {
    const auto& [name, component] = found.names[k];
    const Group& group = found.groups[found.group_of[k]];
    const bool taken = group.is_colour() ? component < Component::alpha
                       : group.is_vector()
                           ? component >= Component::luminance && component < Component::other
                       : group.is_depth() ? component == Component::z
                                          : component == Component::luminance;
    if (used[found.group_of[k]] == 0 || !taken)
      result.others.push_back(name);
  }
  std::ranges::sort(result.others);
  return result;
}

} // namespace meninas
