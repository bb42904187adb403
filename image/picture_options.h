// How pictures are stored in files.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meninas {

enum class PixelType { half, float32 };

/// Key and value written into the file's header (program version,
/// settings, samples, ...), as `meninas:KEY`.
/// Keys are not empty and different from each other;
/// neither part holds a zero byte. Empty values are not written.
using Attributes = std::vector<std::pair<std::string, std::string>>;
inline constexpr std::string_view attribute_prefix = "meninas:";

/// How hard compression tries; the pixels are the same.
enum class Compression { small, quick };

} // namespace meninas
