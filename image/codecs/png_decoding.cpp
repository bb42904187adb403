#include "image/codecs/png_decoding.h"

#include <png.h>

#include <bit>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace meninas::decoder {
namespace {

/// What libpng's callbacks see. The reason is an array, so that nothing is lost when libpng jumps.
struct Source {
  std::string_view rest;
  char reason[256] = {};
};

void set_reason(Source& source, const char* before, const char* text) {
  std::snprintf(source.reason, sizeof source.reason, "%s%s", before, text);
}

[[noreturn]] void fail(png_structp png, png_const_charp text) {
  auto& source = *static_cast<Source*>(png_get_error_ptr(png));
  if (source.reason[0] == '\0')
    set_reason(source, "the PNG is damaged: ", text);
  png_longjmp(png, 1);
}

void pass_over(png_structp, png_const_charp) {}

void take(png_structp png, png_bytep to, std::size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (source.rest.size() < count) {
    set_reason(source, "the PNG ends too early", "");
    png_error(png, "");
  }
  std::memcpy(to, source.rest.data(), count);
  source.rest.remove_prefix(count);
}

/// libpng's structures. Its errors jump, so what calls it has no destructors of its own
/// and returns false after a jump.
class Reader {
public:
  explicit Reader(std::string_view bytes) : source_{.rest = bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, fail, pass_over);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source_, take);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Until the pixels; they will be grey or RGB, with or without alpha, of 8 or 16 bits.
  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0)
      return false;
    constexpr int all = -1; // every chunk but IHDR, PLTE, tRNS, IDAT and IEND
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, all);
    png_set_benign_errors(png_, 1);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // `check` has a say, with its reason
    png_read_info(png_, info_);
    png_set_expand(png_);
    if constexpr (std::endian::native == std::endian::little)
      png_set_swap(png_);
    passes_ = png_set_interlace_handling(png_);
    return true;
  }

  PngShape shape() const {
    const bool alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                       png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
    const bool colour = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0;
    return {.width = static_cast<int>(png_get_image_width(png_, info_)),
            .height = static_cast<int>(png_get_image_height(png_, info_)),
            .channels = (colour ? 3 : 1) + (alpha ? 1 : 0),
            .bits = png_get_bit_depth(png_, info_) == 16 ? 16 : 8};
  }

  /// All rows, each of `row` bytes, and all that is behind them.
  bool read_rows(png_byte* bytes, std::size_t row, int height) {
    if (setjmp(png_jmpbuf(png_)) != 0)
      return false;
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != row)
      png_error(png_, "rows of another size");
    for (int pass = 0; pass < passes_; ++pass)
      for (int y = 0; y < height; ++y)
        png_read_row(png_, bytes + static_cast<std::size_t>(y) * row, nullptr);
    png_read_end(png_, nullptr);
    return true;
  }

  [[noreturn]] void refuse() const { throw std::runtime_error(source_.reason); }

private:
  Source source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

} // namespace

DecodedPng decode_png(std::string_view bytes, const std::function<void(const PngShape&)>& check) {
  Reader reader(bytes);
  if (!reader.read_header())
    reader.refuse();
  const PngShape shape = reader.shape();
  check(shape);

  // Neither buffer is cleared: a header that promises more than the file holds costs address space.
  const auto row_values = static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.channels);
  const auto values = row_values * static_cast<std::size_t>(shape.height);
  const std::size_t of_value = shape.bits == 16 ? 2 : 1;
  const auto codes = std::make_unique_for_overwrite<png_byte[]>(values * of_value);
  if (!reader.read_rows(codes.get(), row_values * of_value, shape.height))
    reader.refuse();

  DecodedPng decoded{shape, std::make_unique_for_overwrite<float[]>(values)};
  for (std::size_t k = 0; k < values; ++k) {
    std::uint16_t wide = 0;
    if (shape.bits == 16)
      std::memcpy(&wide, codes.get() + 2 * k, 2);
    decoded.pixels[k] = shape.bits == 16 ? static_cast<float>(wide) / 65535.0F
                                         : static_cast<float>(codes[k]) / 255.0F;
  }
  return decoded;
}

} // namespace meninas::decoder
