#include "runs/batch/output_name.h"

#include "image/image_file.h"
#include "runs/json/json_place.h"
#include "scenes/errors.h"
#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace meninas {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> part_names{"scene", "camera", "mode", "frame", "job"};

std::string as_file_name(std::string text) {
  if (text.find_first_not_of('.') == std::string::npos) {
    return std::string(text.size(), '_'); // '.' and '..' are folders
  }
  std::ranges::replace_if(
      text,
      [](char c) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
        return !plain && static_cast<unsigned char>(c) < 0x80;
      },
      '_');
  return text;
}

/// The template with every {part} replaced; nothing where braces do not match.
std::optional<std::string> filled(std::string_view text,
                                  const std::function<std::string(const std::string&)>& value) {
  std::string result;
  while (!text.empty()) {
    const auto brace = text.find_first_of("{}");
    result += text.substr(0, brace);
    if (brace == std::string_view::npos) {
      break;
    }
    const auto end = text.find_first_of("{}", brace + 1);
    if (text[brace] == '}' || end == std::string_view::npos || text[end] == '{') {
      return std::nullopt;
    }
    result += value(std::string(text.substr(brace + 1, end - brace - 1)));
    text.remove_prefix(end + 1);
  }
  return result;
}

} // namespace

std::optional<std::string> template_problem(const std::string& name_template) {
  std::string unknown;
  const auto example = filled(name_template, [&](const std::string& part) {
    if (std::ranges::find(part_names, part) == part_names.end()) {
      unknown = part;
    }
    return std::string("x");
  });
  if (!example) {
    return "its braces do not match";
  }
  if (!unknown.empty() || name_template.find("{}") != std::string::npos) {
    return with_hint(fmt::format("no part '{{{}}}'", unknown), unknown, part_names);
  }
  const fs::path path(*example);
  if (path.is_absolute() || std::ranges::find(path, "..") != path.end()) {
    return "leaves the output folder";
  }
  try {
    picture_format(path);
  } catch (const OutputError&) {
    return "has to end in .exr, .png or .hdr";
  }
  return std::nullopt;
}

fs::path output_name(const std::string& name_template, const NameParts& parts) {
  const auto name = filled(name_template, [&](const std::string& part) {
    const auto value = part == "scene"    ? parts.scene
                       : part == "camera" ? parts.camera
                       : part == "mode"   ? parts.mode
                       : part == "job"    ? parts.job
                                          : fmt::format("{:04}", parts.frame);
    return as_file_name(value);
  });
  expects(name.has_value(), "a template that is filled in has been checked");
  return fs::path(*name).lexically_normal();
}

} // namespace meninas
