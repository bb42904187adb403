#include "runs/report/page.h"

#include "image/image_file.h"
#include "scenes/types.h"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace meninas {

std::string fill_page(std::string_view page, std::string_view json) {
  constexpr std::string_view place = "@DATA@";
  const auto at = page.find(place);
  expects(at != std::string_view::npos, "a page has a place for its data");
  std::string filled(page.substr(0, at));
  for (const char c : json) {
    // In JSON this sign occurs in texts alone, where its code stands for it.
    if (c == '<') {
      filled += "\\u003c";
    } else {
      filled += c;
    }
  }
  filled += page.substr(at + place.size());
  return filled;
}

std::string text_of(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string shell_quoted(const std::string& text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:%@";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos)
    return text;
  std::string result = "'";
  for (const char c : text)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + '\'';
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - first);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? std::to_integer<std::uint32_t>(bytes[first + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? digits[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

std::string png_address(const Image& picture, const DisplaySettings& settings) {
  return "data:image/png;base64," + base64(encode_png(picture, settings));
}

std::string png_address(const Image& picture, double exposure, Compression compression) {
  return "data:image/png;base64," + base64(encode_png(picture, exposure, compression));
}

} // namespace meninas
