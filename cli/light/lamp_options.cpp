#include "cli/light/lamp_options.h"

#include "cli/common_options.h"
#include "cli/values.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

namespace {

/// Times what a lamp is: light of more is no float in bright scenes.
constexpr double brightest_lamp = 1e6;

/// NAME=FACTOR or NAME=R,G,B; names may hold an equals sign.
LampFactor parse_lamp(const std::string& text) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0)
    throw UsageError("--lamp", fmt::format("'{}' is not NAME=FACTOR or NAME=R,G,B", text));
  const Rgb factor = parse_colour("--lamp", text.substr(at + 1));
  if (largest(factor) > brightest_lamp)
    throw UsageError("--lamp", fmt::format("'{}' is more than {:g} times as bright", text, brightest_lamp));
  return {text.substr(0, at), factor};
}

/// A semicolon parts two lamps where a factor stands before it; any other is of a name.
bool is_between(const std::string& text, std::size_t begin, std::size_t semicolon) {
  const std::size_t equals = text.rfind('=', semicolon);
  return equals != std::string::npos && equals >= begin &&
         text.find_first_not_of("0123456789.,+-eE ", equals + 1) == semicolon;
}

void add_lamps(const std::string& text, std::vector<LampFactor>& lamps) {
  for (std::size_t begin = 0; begin <= text.size();) {
    std::size_t end = text.find(';', begin);
    while (end != std::string::npos && !is_between(text, begin, end))
      end = text.find(';', end + 1);
    end = std::min(end, text.size());
    lamps.push_back(parse_lamp(text.substr(begin, end - begin)));
    begin = end + 1;
  }
}

const Choices<LampGrouping> lamp_groupings{{"node", LampGrouping::node},
                                           {"material", LampGrouping::material}};

} // namespace

LampGrouping parse_lamp_grouping(const std::string& option, const std::string& text) {
  return parse_choice(option, text.empty() || text == preset_value ? "node" : text, lamp_groupings);
}

void add_lamp_factors(Options& command, const std::string& description,
                      std::vector<LampFactor>& lamps) {
  command
      .add_repeatable("--lamp", "NAME=FACTOR|R,G,B", description,
                      [&lamps](const std::string& text) { add_lamps(text, lamps); })
      .group(light_group);
}

void add_by_lamp(Options& command, const std::string& description,
                 std::optional<LampGrouping>& grouping) {
  command
      .add("--by-lamp", "[node|material]", description,
           [&grouping](const std::string& text) {
             grouping = parse_lamp_grouping("--by-lamp", text);
           })
      .value_if_given(preset_value)
      .group(light_group);
}

} // namespace meninas
