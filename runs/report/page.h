// Self-contained HTML pages: a template with one place for data,
// and pictures inside it, so that a page is one file that needs nothing else.
#pragma once

#include "image/image_file.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace meninas {

/// The template with JSON in place of `@DATA@`,
/// written so that no text in it can end the script element it stands in.
/// Precondition: the template has that place.
std::string fill_page(std::string_view page, std::string_view json);

/// JSON with what is not UTF-8 replaced, on one line for an indent of -1.
std::string text_of(const nlohmann::ordered_json& json, int indent);

/// A word of a command, in single quotes where a shell would take it apart.
std::string shell_quoted(const std::string& text);

/// RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes);

/// The picture as it is shown: a PNG as a `data:` address.
std::string png_address(const Image& picture, const DisplaySettings& settings);
std::string png_address(const Image& picture, double exposure,
                        Compression compression = Compression::small);

} // namespace meninas
