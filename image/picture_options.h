// Options for storing pictures in files.
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

/// Where the pixels of a file are in a picture: an EXR's data window in its display window, which begins at (0, 0).
struct DataWindow {
  int x = 0, y = 0;                       ///< of the first of them
  int width = 0, height = 0;              ///< theirs
  int picture_width = 0, picture_height = 0;
};

/// The effort of compression; the pixels are the same.
enum class Compression { small, quick };

} // namespace meninas
