// Pictures in PNG files, read by libpng alone. Its errors become one line; nothing goes to stderr.
//
// Gamma, profiles and texts are passed over, as glTF tells its readers to.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

namespace meninas::decoder {

/// The content of a header; palettes are RGB and transparent colours a channel of alpha.
struct PngShape {
  int width = 0, height = 0;
  int channels = 0; ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int bits = 8;     ///< of a code value: 8, also for less, or 16
};

struct DecodedPng {
  PngShape shape;
  /// Code values over the largest one, interleaved, rows from the top, alpha not multiplied in.
  std::unique_ptr<float[]> pixels;
};

/// `check` sees the header before there is memory for pixels, and throws where it is too large.
/// Throws std::runtime_error where the file is damaged or ends too early.
DecodedPng decode_png(std::string_view bytes, const std::function<void(const PngShape&)>& check);

} // namespace meninas::decoder
