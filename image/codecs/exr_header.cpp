#include "image/codecs/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace meninas::decoder {

namespace {

/// Takes the parts of the header off the front of what is left of the file.
class HeaderReader {
public:
  explicit HeaderReader(std::string_view bytes) : rest_(bytes) {}

  std::string_view bytes(std::size_t count) {
    if (count > rest_.size())
      throw std::runtime_error("the EXR ends within its header");
    const auto taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::string_view text() {
    const auto end = rest_.find('\0');
    if (end == std::string_view::npos)
      throw std::runtime_error("the EXR ends within its header");
    return bytes(end + 1).substr(0, end);
  }
  std::int32_t integer() { return integer_of(bytes(4)); }
  char peek() const {
    if (rest_.empty())
      throw std::runtime_error("the EXR ends within its header");
    return rest_.front();
  }

  static std::int32_t integer_of(std::string_view four) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k)
      value |= std::uint32_t{static_cast<std::uint8_t>(four[k])} << 8U * k;
    return static_cast<std::int32_t>(value);
  }

private:
  std::string_view rest_;
};

struct Promised {
  std::int64_t width = 0, height = 0;
  std::int64_t tile_width = 0, tile_height = 0; ///< 0 for a picture stored in rows
  std::int64_t chunks = 0;                      ///< 0 where the header leaves it to be computed
};

} // namespace

/// Every channel has a name, a type of sample, two sizes of its grid and four bytes of flags.
static void check_channels(std::string_view list) {
  HeaderReader reader(list);
  for (auto name = reader.text(); !name.empty(); name = reader.text()) {
    const auto type = reader.integer();
    reader.bytes(4);
    const auto x_sampling = reader.integer(), y_sampling = reader.integer();
    if (type < 0 || type > 2 || x_sampling < 1 || y_sampling < 1)
      throw std::runtime_error("the EXR has a damaged list of channels");
  }
}

/// The attributes up to the empty name that ends the header.
static Promised read_header(HeaderReader& reader) {
  Promised promised;
  for (auto name = reader.text(); !name.empty(); name = reader.text()) {
    const auto type = reader.text();
    const auto size = reader.integer();
    if (size < 0)
      throw std::runtime_error("the EXR has a damaged header");
    const auto value = reader.bytes(static_cast<std::size_t>(size));
    const auto number = [&](std::size_t k) {
      return std::int64_t{HeaderReader::integer_of(value.substr(4 * k, 4))};
    };
    if (name == "dataWindow" && type == "box2i" && value.size() == 16) {
      promised.width = number(2) - number(0) + 1;
      promised.height = number(3) - number(1) + 1;
    } else if (name == "tiles" && type == "tiledesc" && value.size() == 9) {
      promised.tile_width = number(0);
      promised.tile_height = number(1);
      if (promised.tile_width < 1 || promised.tile_height < 1)
        throw std::runtime_error("the EXR has a damaged header");
    } else if (name == "chunkCount" && type == "int" && value.size() == 4) {
      promised.chunks = number(0);
    } else if (name == "channels" && type == "chlist") {
      check_channels(value);
    }
  }
  return promised;
}

static void check_size(const Promised& promised, std::size_t file_size, const Limits& limits) {
  if (promised.width <= 0 || promised.height <= 0)
    throw std::runtime_error("the EXR has a damaged header");
  if (std::max(promised.width, promised.height) > limits.side)
    throw std::runtime_error(
        std::to_string(promised.width) + " x " + std::to_string(promised.height) +
        " pixels are too many; a side may have " + std::to_string(limits.side));

  // A tile may be larger than the picture,
  // but no writer makes it larger than both the picture and this.
  constexpr std::int64_t usual_tile = 1024;
  if (promised.tile_width > std::max(promised.width, usual_tile) ||
      promised.tile_height > std::max(promised.height, usual_tile))
    throw std::runtime_error("the EXR has tiles of an impossible size");

  // Every chunk has an entry of eight bytes in the table that follows the headers.
  std::int64_t chunks = std::max<std::int64_t>(promised.chunks, 0);
  if (promised.tile_width > 0)
    chunks = std::max(chunks, ((promised.width - 1) / promised.tile_width + 1) *
                                  ((promised.height - 1) / promised.tile_height + 1));
  if (static_cast<std::uint64_t>(chunks) > file_size / 8)
    throw std::runtime_error("the EXR ends too early");
}

void check_exr_header(std::string_view exr, const Limits& limits) {
  HeaderReader reader(exr);
  reader.bytes(4);
  constexpr std::uint32_t deep = 0x800U, several_parts = 0x1000U;
  const auto version = static_cast<std::uint32_t>(reader.integer());
  if ((version & several_parts) == 0) {
    if ((version & deep) != 0)
      throw std::runtime_error("the EXR holds deep data, not a flat picture");
    check_size(read_header(reader), exr.size(), limits);
    return;
  }
  // The headers of several parts follow each other; an empty one, a single zero, ends them.
  while (reader.peek() != '\0')
    check_size(read_header(reader), exr.size(), limits);
}

} // namespace meninas::decoder
