#include "image/codecs/png_pixels.h"

#include "image/codecs/png_rows.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace meninas::decoder {

/// What of the chunks beside the pixels means something for them;
/// of the rest libpng would speak on stderr.
static bool belongs(const PngHeader& header, std::string_view type, std::size_t length,
                    std::size_t colours) {
  constexpr std::size_t max_colours = 256;
  if (type == "PLTE")
    return header.colour_type == palette_png && colours == 0 && length > 0 && length % 3 == 0 &&
           length / 3 <= std::min(max_colours, std::size_t{1} << header.depth);
  if (type == "tRNS") // of a palette an alpha for each colour, else one colour that is clear
    return header.colour_type == palette_png ? length > 0 && length <= colours
           : header.colour_type == grey_png  ? length == 2
                                             : header.colour_type == rgb_png && length == 6;
  return true;
}

std::vector<std::uint8_t> png_pixel_chunks(std::string_view png) {
  constexpr std::array<std::string_view, 5> kept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::vector<std::uint8_t> pixels(png.begin(), png.begin() + png_signature);
  std::string_view rest = png.substr(png_signature);
  PngHeader header;
  std::size_t colours = 0;
  bool any_data = false, any_alpha = false;
  for (std::string_view type; type != "IEND";) {
    if (rest.size() < png_length_and_type + png_checksum)
      throw std::runtime_error("the PNG ends too early");
    const std::size_t length = big_endian(rest);
    if (rest.size() - png_length_and_type - png_checksum < length)
      throw std::runtime_error("the PNG ends too early");
    type = rest.substr(4, 4);
    if (pixels.size() == png_signature && (type != "IHDR" || length != 13))
      throw std::runtime_error("the PNG has no header");
    const bool repeated = (type == "IHDR" && pixels.size() > png_signature) ||
                          (type == "tRNS" && any_alpha) ||
                          (type != "IEND" && type != "IDAT" && any_data);

    const auto chunk = rest.substr(0, png_length_and_type + length + png_checksum);
    rest.remove_prefix(chunk.size());
    if (std::ranges::find(kept, type) == kept.end() || repeated ||
        !belongs(header, type, length, colours))
      continue;
    if (checksum_of(chunk.substr(4, 4 + length)) !=
        big_endian(chunk.substr(png_length_and_type + length)))
      throw std::runtime_error("the PNG is damaged: wrong checksum of its chunk " +
                               std::string(type));
    if (type == "IHDR")
      header = png_header(chunk.substr(png_length_and_type));
    if (type == "PLTE")
      colours = length / 3;
    any_alpha = any_alpha || type == "tRNS";
    any_data = any_data || type == "IDAT";
    pixels.insert(pixels.end(), chunk.begin(), chunk.end());
  }
  if (!any_data)
    throw std::runtime_error("the PNG holds no pixels");
  if (header.colour_type == palette_png && colours == 0)
    throw std::runtime_error("the PNG has no palette");
  return pixels;
}

} // namespace meninas::decoder
