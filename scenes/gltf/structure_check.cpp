// A file held against the table of gltf/rules.cpp:
// every property of its type, every index into its array.
#include "scenes/gltf/document.h"
#include "scenes/gltf/rules.h"

#include <fmt/format.h>

#include <cmath>

namespace meninas::gltf {

namespace structure { // where kinds have their short names

using enum Kind;
using enum Presence;

namespace {

/// Where the check stands: a chain from the value back to the root.
struct Place {
  const Place* parent = nullptr;
  std::string_view key;
  std::optional<std::size_t> element;
  const Json* value = nullptr;
};

std::string path_of(const Place& place) {
  auto path = place.parent ? path_of(*place.parent) : std::string();
  if (!path.empty() && !place.key.empty())
    path += ".";
  path += place.key;
  return place.element ? fmt::format("{}[{}]", path, *place.element) : path;
}

std::string where(const Place& place) {
  // The name that helps is that of the outermost named object: the node, mesh or material.
  std::string name;
  for (const auto* at = &place; at; at = at->parent)
    if (at->value && at->element && !name_of(*at->value).empty())
      name = name_of(*at->value);
  const auto path = path_of(place);
  return name.empty() ? path : fmt::format("{} '{}'", path, name);
}

std::string what_it_is(const Json& value) {
  if (value.is_number())
    return value.dump();
  return std::string(value.is_array() || value.is_object() ? "an "
                     : value.is_null()                     ? ""
                                                           : "a ") +
         value.type_name();
}

bool is_size(const Json& value) {
  if (value.is_number_unsigned())
    return true;
  if (!value.is_number_float())
    return false;
  const auto number = value.get<double>();
  return number >= 0.0 && number <= 9007199254740992.0 && number == std::floor(number);
}

class StructureCheck {
public:
  StructureCheck(const std::string& file, const Json& root) : file_(file), root_(root) {}

  void check_object(const Place& place, std::span<const Rule> rules) const {
    for (const auto& rule : rules) {
      const auto* value = find(*place.value, rule.name);
      if (value)
        check_value(place, rule, *value);
      else if (rule.presence == required)
        fail(place, fmt::format("has no '{}'", rule.name));
    }
  }

private:
  [[noreturn]] void fail(const Place& place, const std::string& what) const {
    throw InputError(file_, where(place), what);
  }

  void require(bool condition, const Place& place, const Rule& rule, const Json& value,
               const std::string& expected) const {
    if (!condition)
      fail(place, fmt::format("'{}' must be {}, it is {}", rule.name, expected, what_it_is(value)));
  }

  void check_index(const Place& place, std::string_view name, std::string_view target,
                   const Json& value) const {
    if (!is_size(value))
      fail(place, fmt::format("'{}' must be an index, it is {}", name, what_it_is(value)));
    const auto count = count_of(root_, target);
    if (size_value(value) >= count)
      fail(place,
           fmt::format("'{}' is index {} of {}, there are {}", name, value.dump(), target, count));
  }

  void check_value(const Place& place, const Rule& rule, const Json& value) const {
    switch (rule.kind) {
    case size:
      return require(is_size(value), place, rule, value, "a whole number of at least 0");
    case index:
      return check_index(place, rule.name, rule.target, value);
    case number:
      return require(value.is_number(), place, rule, value, "a number");
    case text:
      return require(value.is_string(), place, rule, value, "text");
    case boolean:
      return require(value.is_boolean(), place, rule, value, "true or false");
    case object:
      require(value.is_object(), place, rule, value, "an object");
      return check_object({&place, rule.name, std::nullopt, &value}, rule.fields);
    case attributes:
      return check_attributes(place, rule, value);
    case sizes:
      require(value.is_object(), place, rule, value, "an object");
      for (const auto& [name, number] : value.items())
        check_value(place, {.name = name, .kind = size}, number);
      return;
    default:
      return check_array(place, rule, value);
    }
  }

  void check_attributes(const Place& place, const Rule& rule, const Json& value) const {
    require(value.is_object(), place, rule, value, "an object");
    for (const auto& [name, accessor_index] : value.items())
      check_index(place, name, rule.target, accessor_index);
  }

  void check_array(const Place& place, const Rule& rule, const Json& value) const {
    require(value.is_array(), place, rule, value, "an array");
    if (rule.length > 0 && value.size() != rule.length)
      fail(place, fmt::format("'{}' must have {} numbers, it has {}", rule.name, rule.length,
                              value.size()));
    for (std::size_t k = 0; k < value.size(); ++k) {
      const auto& item = value[k];
      const Rule item_rule{.name = rule.name, .kind = rule.kind};
      if (rule.kind == numbers)
        require(item.is_number(), place, item_rule, item, "an array of numbers");
      if (rule.kind == texts)
        require(item.is_string(), place, item_rule, item, "an array of text");
      if (rule.kind == indices)
        check_index(place, rule.name, rule.target, item);
      if (rule.kind == attribute_sets)
        check_attributes(place, rule, item);
      if (rule.kind != objects)
        continue;
      require(item.is_object(), place, item_rule, item, "an array of objects");
      check_object({&place, rule.name, k, &item}, rule.fields);
    }
  }

  const std::string& file_;
  const Json& root_;
};

} // namespace
} // namespace structure

void check_structure(const std::string& file, const Json& root) {
  structure::StructureCheck(file, root).check_object({nullptr, "", std::nullopt, &root}, root_rules());
}

} // namespace meninas::gltf
