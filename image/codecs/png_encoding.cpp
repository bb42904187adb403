#include "image/codecs/png_encoding.h"

#include <png.h>

#include <memory>
#include <stdexcept>

namespace meninas {

std::vector<std::byte> encode_png(int width, int height, std::span<const std::uint8_t> codes,
                                  Compression compression) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  image.flags = compression == Compression::quick ? PNG_IMAGE_FLAG_FAST : 0;

  // Room for the worst case, where nothing can be compressed; what stays untouched costs nothing.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  const auto bytes = std::make_unique_for_overwrite<std::byte[]>(size);
  constexpr int as_it_is = 0, packed_rows = 0;
  if (png_image_write_to_memory(&image, bytes.get(), &size, as_it_is, codes.data(), packed_rows,
                                nullptr) == 0)
    throw std::runtime_error(image.message);
  return {bytes.get(), bytes.get() + size};
}

} // namespace meninas
