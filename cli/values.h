// Option values from text.
// All of them throw UsageError naming the option, what it was given and what it takes.
#pragma once

#include "runs/preparation.h"
#include "scenes/errors.h"
#include "scenes/names.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace meninas {

/// A decimal integer from low to high.
std::int64_t parse_integer(const std::string& option, const std::string& text, std::int64_t low,
                           std::int64_t high);

/// Cells along the edge of a hemicube: even, for its sides are half as high.
int parse_resolution(const std::string& option, const std::string& text);

/// Bytes: a number, with a unit of 1024 bytes and its powers behind it or none: 800M, 1.5G, 2GiB.
std::uint64_t parse_bytes(const std::string& option, const std::string& text);

enum class Sign { any, positive };

/// A finite decimal number.
double parse_number(const std::string& option, const std::string& text, Sign sign);

/// One number for a grey, or three: linear red, green and blue; none negative.
Rgb parse_colour(const std::string& option, const std::string& text);

/// K/N. Whether K counts from 0 or from 1 does not matter: 0/N and N/N are the same part, the last.
PicturePart parse_part(const std::string& option, const std::string& text);

/// X,Y,Z: three finite numbers.
Point3 parse_point(const std::string& option, const std::string& text);

/// WIDTHxHEIGHT
PictureSize parse_size(const std::string& option, const std::string& text);

[[noreturn]] void refuse_choice(const std::string& option, const std::string& text,
                                const std::vector<std::string>& known);

/// The names an option takes, in the order in which help shows them.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

template <typename Value>
std::vector<std::string> names_of(const Choices<Value>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    names.push_back(name);
  }
  return names;
}

template <typename Value>
std::string name_of(Value value, const Choices<Value>& choices) {
  for (const auto& [name, known] : choices) {
    if (known == value) {
      return name;
    }
  }
  return "";
}

template <typename Value>
Value parse_choice(const std::string& option, const std::string& text,
                   const Choices<Value>& choices) {
  for (const auto& [name, value] : choices) {
    if (name == text) {
      return value;
    }
  }
  refuse_choice(option, text, names_of(choices));
}

/// ", did you mean 'x'?", or nothing when no known name is near.
std::string hint_for(const std::string& name, const std::vector<std::string>& known);

} // namespace meninas
