#include "cli/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace meninas {
namespace {

template <typename Number>
std::optional<Number> whole_number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) {
    text.remove_prefix(1);
  }
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

} // namespace

std::int64_t parse_integer(const std::string& option, const std::string& text, std::int64_t low,
                           std::int64_t high) {
  const auto value = whole_number_in<std::int64_t>(text);
  if (!value || *value < low || *value > high) {
    throw UsageError(option,
                     fmt::format("'{}' is not a whole number from {} to {}", text, low, high));
  }
  return *value;
}

int parse_resolution(const std::string& option, const std::string& text) {
  constexpr int finest = 1024;
  const auto value = whole_number_in<int>(text);
  if (!value || *value < 2 || *value > finest || *value % 2 != 0) {
    throw UsageError(option, fmt::format("'{}' is not an even number from 2 to {}", text, finest));
  }
  return *value;
}

double parse_number(const std::string& option, const std::string& text, Sign sign) {
  const auto value = whole_number_in<double>(text);
  if (!value || !std::isfinite(*value)) {
    throw UsageError(option, fmt::format("'{}' is not a number", text));
  }
  if (sign == Sign::positive && *value <= 0.0) {
    throw UsageError(option, fmt::format("'{}' is not positive", text));
  }
  return *value;
}

std::uint64_t parse_bytes(const std::string& option, const std::string& text) {
  constexpr std::string_view units = "KMGT";
  const auto unit_begin = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = whole_number_in<double>(std::string_view(text).substr(0, unit_begin));
  std::string_view unit = std::string_view(text).substr(unit_begin);
  double factor = 1.0;
  if (const auto power = unit.empty() ? units.npos : units.find(unit.front());
      power != units.npos) {
    factor = std::exp2(10.0 * static_cast<double>(power + 1));
    unit.remove_prefix(1);
  }
  const bool known = unit.empty() || unit == "B" || (factor > 1.0 && unit == "iB");
  // Beyond that it is no limit.
  if (!number || !known || !(*number * factor >= 1.0) || *number * factor > 0x1p60) {
    throw UsageError(option, fmt::format("'{}' is no size such as 800M or 1.5G", text));
  }
  return static_cast<std::uint64_t>(*number * factor);
}

Rgb parse_colour(const std::string& option, const std::string& text) {
  const auto refuse = [&] {
    throw UsageError(option, fmt::format("'{}' is not a number, nor three as 0.2,0.3,0.5", text));
  };
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto value = whole_number_in<double>(std::string_view(text).substr(begin, end - begin));
    if (!value || !std::isfinite(*value) || *value < 0.0) {
      refuse();
    }
    values.push_back(*value);
    begin = end + 1;
  }
  if (values.size() != 1 && values.size() != 3) {
    refuse();
  }
  return values.size() == 1 ? Rgb(values[0]) : Rgb(values[0], values[1], values[2]);
}

PicturePart parse_part(const std::string& option, const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos)
    throw UsageError(option, fmt::format("'{}' is no part such as 1/4", text));
  const auto count = parse_integer(option, text.substr(slash + 1), 1, 1'000'000);
  const auto number = parse_integer(option, text.substr(0, slash), 0, count);
  return {static_cast<int>((number + count - 1) % count), static_cast<int>(count)};
}

Point3 parse_point(const std::string& option, const std::string& text) {
  Point3 point(0.0);
  std::size_t begin = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? text.find(',', begin) : text.size();
    const auto value = end == std::string::npos
                           ? std::nullopt
                           : whole_number_in<double>(std::string_view(text).substr(begin, end - begin));
    if (!value || !std::isfinite(*value))
      throw UsageError(option, fmt::format("'{}' is no point such as 1.5,1.6,-2", text));
    point[k] = *value;
    begin = end + 1;
  }
  return point;
}

PictureSize parse_size(const std::string& option, const std::string& text) {
  constexpr int longest_side = 65'536;
  constexpr std::int64_t max_pixels = std::int64_t{1} << 27;
  const auto cross = text.find('x');
  const auto width = whole_number_in<int>(std::string_view(text).substr(0, cross));
  const auto height = cross == std::string::npos
                          ? std::nullopt
                          : whole_number_in<int>(std::string_view(text).substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1) {
    throw UsageError(option, fmt::format("'{}' is not a size such as 640x480", text));
  }
  if (*width > longest_side || *height > longest_side ||
      std::int64_t{*width} * *height > max_pixels) {
    throw UsageError(option, fmt::format("'{}' is larger than {} pixels on a side or {} in all",
                                         text, longest_side, max_pixels));
  }
  return {*width, *height};
}

std::string hint_for(const std::string& name, const std::vector<std::string>& known) {
  const auto nearest = nearest_name(name, known);
  return nearest ? fmt::format(", did you mean '{}'?", *nearest) : "";
}

void refuse_choice(const std::string& option, const std::string& text,
                   const std::vector<std::string>& known) {
  const std::string hint = hint_for(text, known);
  throw UsageError(
      option,
      fmt::format("no value '{}'{}", text,
                  hint.empty() ? fmt::format(", there is {}", fmt::join(known, ", ")) : hint));
}

} // namespace meninas
