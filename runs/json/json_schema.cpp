#include "runs/json/json_schema.h"

#include "scenes/errors.h"
#include "scenes/types.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace meninas {
namespace {

constexpr std::array understood{"$ref",
                                "type",
                                "enum",
                                "anyOf",
                                "required",
                                "properties",
                                "items",
                                "minItems",
                                "maxItems",
                                "minLength",
                                "minimum",
                                "maximum",
                                "title",
                                "default",
                                "description",
                                "$defs",
                                "$schema",
                                "additionalProperties",
                                "exclusiveMinimum",
                                "exclusiveMaximum"};

struct Checker {
  const Json& root;
  void check(const Place& place, const Json& schema) const;

private:
  const Json& followed(const Json& schema) const;
  bool has_type_of(const Json& value, const Json& schema) const;
  void check_alternatives(const Place& place, const Json& alternatives) const;
  void check_members(const Place& place, const Json& schema) const;
  void check_items(const Place& place, const Json& schema) const;
};

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "integer") { // 1.0 is one
    return value.is_number_integer() ||
           (value.is_number() && value.get<double>() == std::floor(value.get<double>()));
  }
  if (type == "number") {
    return value.is_number();
  }
  return value.type_name() == type;
}

std::string with_article(const std::string& type) {
  if (type == "null") {
    return type;
  }
  const std::string word = type == "string" ? "text" : type == "array" ? "list" : type;
  return (word == "object" || word == "integer" ? "an " : "a ") + word;
}

std::vector<std::string> texts_of(const Json& text_or_list) {
  return text_or_list.is_array() ? text_or_list.get<std::vector<std::string>>()
                                 : std::vector{text_or_list.get<std::string>()};
}

void check_type(const Place& place, const Json& type) {
  std::vector<std::string> wanted = texts_of(type);
  const auto holds = [&](const std::string& name) { return is_of_type(place.json, name); };
  if (std::ranges::none_of(wanted, holds)) {
    std::ranges::transform(wanted, wanted.begin(), with_article);
    place.fail(fmt::format("is not {}", fmt::join(wanted, " or ")));
  }
}

void check_choice(const Place& place, const Json& choices) {
  if (std::ranges::find(choices, place.json) != choices.end()) {
    return;
  }
  if (!std::ranges::all_of(choices, [](const Json& choice) { return choice.is_string(); })) {
    place.fail(fmt::format("is none of {}", choices.dump()));
  }
  if (!place.json.is_string()) {
    place.fail("is not a text");
  }
  const auto given = place.json.get<std::string>();
  place.fail(with_hint(fmt::format("no value '{}'", given), given, texts_of(choices)));
}

/// Code points of UTF-8: all bytes but those that go on.
std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

void check_number(const Place& place, const Json& schema) {
  const auto bound = [&](const char* keyword, auto holds, const char* complaint) {
    if (const auto limit = schema.find(keyword); limit != schema.end()) {
      if (!holds(place.json.get<double>(), limit->get<double>())) {
        place.fail(fmt::format("{} {}", complaint, limit->dump()));
      }
    }
  };
  bound("minimum", std::greater_equal<>{}, "is less than");
  bound("maximum", std::less_equal<>{}, "is more than");
  bound("exclusiveMinimum", std::greater<>{}, "is not more than");
  bound("exclusiveMaximum", std::less<>{}, "is not less than");
}

const Json& Checker::followed(const Json& schema) const {
  const auto reference = schema.find("$ref");
  if (reference == schema.end()) {
    return schema;
  }
  const auto target = reference->get<std::string>();
  expects(target.starts_with('#') && target.find('%') == std::string::npos,
          "a schema refers to parts of itself");
  const Json::json_pointer part(target.substr(1));
  expects(root.contains(part), "a schema refers to parts that it has");
  return root.at(part);
}

bool Checker::has_type_of(const Json& value, const Json& schema) const {
  const Json& direct = followed(schema);
  if (direct.is_boolean()) {
    return direct.get<bool>();
  }
  if (const auto alternatives = direct.find("anyOf"); alternatives != direct.end()) {
    return std::ranges::any_of(
        *alternatives, [&](const Json& alternative) { return has_type_of(value, alternative); });
  }
  if (const auto choices = direct.find("enum"); choices != direct.end()) {
    return std::ranges::any_of(*choices, [&](const Json& choice) {
      return std::string_view(choice.type_name()) == value.type_name();
    });
  }
  if (!direct.contains("type")) {
    return true;
  }
  const auto types = texts_of(direct.at("type"));
  return std::ranges::any_of(types,
                             [&](const std::string& type) { return is_of_type(value, type); });
}

void Checker::check_alternatives(const Place& place, const Json& alternatives) const {
  std::optional<InputError> nearest;
  for (const Json& alternative : alternatives) {
    if (!has_type_of(place.json, alternative)) {
      continue;
    }
    try {
      check(place, alternative);
      return;
    } catch (const InputError& error) {
      // Of several objects the one that shares a required key is meant.
      const Json& direct = followed(alternative);
      const Json keys = direct.is_object() ? direct.value("required", Json::array()) : Json::array();
      const bool meant = std::ranges::any_of(
          keys, [&](const Json& key) { return place.json.contains(key.get<std::string>()); });
      if (!nearest || meant) {
        nearest = error;
      }
    }
  }
  if (nearest) {
    throw InputError(*nearest);
  }
  place.fail("is of a type that is not taken here");
}

void Checker::check_members(const Place& place, const Json& schema) const {
  const Json known = schema.value("properties", Json::object());
  std::vector<std::string> names;
  for (const auto& [name, member] : known.items()) {
    names.push_back(name);
  }
  const Json others = schema.value("additionalProperties", Json(true));
  for (const auto& [name, value] : place.json.items()) {
    if (known.contains(name)) {
      check(place.at(name), known.at(name));
    } else if (others == false) {
      place.at(name).fail(with_hint("unknown key", name, names));
    } else if (others.is_object()) {
      check(place.at(name), others);
    }
  }
  for (const Json& name : schema.value("required", Json::array())) {
    if (!place.json.contains(name.get<std::string>())) {
      place.fail(fmt::format("'{}' is missing", name.get<std::string>()));
    }
  }
}

void Checker::check_items(const Place& place, const Json& schema) const {
  const std::size_t least = schema.value("minItems", std::size_t{0}), size = place.json.size();
  if (size < least || size > schema.value("maxItems", size)) {
    place.fail(least == schema.value("maxItems", std::size_t{0})
                   ? fmt::format("has {} values, not {}", size, least)
               : size < least ? "is empty"
                              : "is too long");
  }
  const auto items = schema.find("items");
  for (std::size_t k = 0; k < size && items != schema.end(); ++k) {
    check(place.at(k), *items);
  }
}

void Checker::check(const Place& place, const Json& schema) const {
  if (schema.is_boolean()) {
    if (!schema.get<bool>()) {
      place.fail("is not taken here");
    }
    return;
  }
  for (const auto& [keyword, value] : schema.items()) {
    expects(std::ranges::find(understood, keyword) != understood.end(),
            "a schema keeps to the keywords that are checked");
  }
  if (schema.contains("$ref")) {
    check(place, followed(schema));
  }
  if (const auto alternatives = schema.find("anyOf"); alternatives != schema.end()) {
    check_alternatives(place, *alternatives);
  }
  if (const auto choices = schema.find("enum"); choices != schema.end()) {
    check_choice(place, *choices);
  }
  if (const auto type = schema.find("type"); type != schema.end()) {
    check_type(place, *type);
  }
  if (place.json.is_object()) {
    check_members(place, schema);
  } else if (place.json.is_array()) {
    check_items(place, schema);
  } else if (place.json.is_number()) {
    check_number(place, schema);
  } else if (place.json.is_string() && length_of(place.json.get_ref<const std::string&>()) <
                                           schema.value("minLength", std::size_t{0})) {
    place.fail("is empty");
  }
}

} // namespace

void check_schema(const Place& place, const Json& schema) { Checker{schema}.check(place, schema); }

} // namespace meninas
