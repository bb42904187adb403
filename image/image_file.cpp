#include "image/image_file.h"

#include "image/codecs/decoder_loader.h"
#include "image/display.h"
#include "image/codecs/exr_encoding.h"
#include "image/picture_channels.h"
#include "image/codecs/png_encoding.h"
#include "image/whole_file.h"
#include "scenes/errors.h"
#include "scenes/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <set>
#include <string_view>

namespace meninas {

namespace fs = std::filesystem;

void preload_picture_reader() { decoder::preload(); }

// --- Writing

PictureFormat picture_format(const fs::path& file) {
  auto extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  if (extension == ".exr")
    return PictureFormat::exr;
  if (extension == ".png")
    return PictureFormat::png;
  if (extension == ".hdr")
    return PictureFormat::hdr;
  throw OutputError(
      file.string(), "",
      extension.empty()
          ? "a picture's name must end in .exr, .png or .hdr"
          : fmt::format("cannot write pictures as '{}', only .exr, .png and .hdr", extension));
}

static void expect_picture(const Image& picture) {
  expects(picture.width > 0 && picture.height > 0, "a picture that is written has pixels");
  expects(picture.pixels.size() ==
              static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
          "a picture has width * height pixels");
  const bool no_nan = std::ranges::none_of(picture.pixels, [](const glm::vec3& pixel) {
    return std::isnan(pixel.r) || std::isnan(pixel.g) || std::isnan(pixel.b);
  });
  expects(no_nan, "no pixel that is written is NaN");
}

static void expect_layers(const Image& picture, std::span<const Layer> layers) {
  std::set<std::string_view> names;
  for (const auto& layer : layers) {
    expect_picture(layer.image);
    expects(layer.image.width == picture.width && layer.image.height == picture.height,
            "a layer has the picture's size");
    // EXR allows names of 255 bytes, of which ".R" takes two.
    expects(!layer.name.empty() && layer.name.size() <= 253 &&
                layer.name.find('\0') == std::string::npos,
            "a layer has a name that fits an EXR channel");
    expects(names.insert(layer.name).second, "layers have different names");
  }
}

static void expect_attributes(const Attributes& attributes) {
  std::set<std::string_view> keys;
  for (const auto& [key, value] : attributes) {
    expects(!key.empty() && key.size() + attribute_prefix.size() <= 255,
            "an attribute has a key that fits an EXR header");
    expects((key + value).find('\0') == std::string::npos, "an attribute is text");
    expects(keys.insert(key).second, "attributes have different keys");
  }
}

/// Runs an encoder; the reason it gives when it cannot is the user's to read.
template <typename Encode>
static std::vector<std::byte> encoded_as(const std::string& file, Encode encode) {
  try {
    return encode();
  } catch (const std::bad_alloc&) {
    throw OutputError(file, "", "cannot write: not enough memory");
  } catch (const std::exception& error) {
    throw OutputError(file, "", fmt::format("cannot write: {}", error.what()));
  }
}

void write_exr(const fs::path& file, const Image& picture, std::span<const Layer> layers,
               PixelType type, const Attributes& attributes) {
  expect_picture(picture);
  expect_layers(picture, layers);
  expect_attributes(attributes);
  if (picture_format(file) != PictureFormat::exr)
    throw OutputError(file.string(), "", "an EXR's name must end in .exr");

  write_whole_file(file, encoded_as(file.string(),
                                    [&] { return encode_exr(picture, layers, type, attributes); }));
}

void write_exr_window(const fs::path& file, const Image& pixels, std::span<const Layer> layers,
                      const DataWindow& window, const Attributes& attributes) {
  expect_picture(pixels);
  expect_layers(pixels, layers);
  expect_attributes(attributes);
  expects(window.width == pixels.width && window.height == pixels.height, "a window has its pixels");
  write_whole_file(file, encoded_as(file.string(), [&] {
                     return encode_exr_window(pixels, layers, window, attributes);
                   }));
}

static std::vector<std::byte> encode_hdr(const Image& picture) {
  const decoder::Table& table = decoder::module_table();
  decoder::Encoded encoded =
      table.encode_hdr(&picture.pixels.front().r, picture.width, picture.height);
  if (encoded.owner == nullptr)
    throw std::runtime_error(encoded.error);
  const auto* bytes = reinterpret_cast<const std::byte*>(encoded.bytes);
  std::vector<std::byte> copy(bytes, bytes + encoded.size);
  table.release_encoded(&encoded);
  return copy;
}

void write_hdr(const fs::path& file, const Image& picture) {
  expect_picture(picture);
  if (picture_format(file) != PictureFormat::hdr)
    throw OutputError(file.string(), "", "a Radiance picture's name must end in .hdr");
  write_whole_file(file, encoded_as(file.string(), [&] { return encode_hdr(picture); }));
}

std::vector<std::byte> encode_png(const Image& picture, const DisplaySettings& settings) {
  expect_picture(picture);
  expects(settings.bits == 8 || settings.bits == 16, "a PNG has 8 or 16 bits a channel");
  PngText text;
  if (settings.transform != ViewTransform::srgb)
    text = {"View transform", title_of(settings.transform)};
  std::span<const ShownPixel> edges;
  if (settings.edges && settings.edges->exposure == settings.exposure &&
      settings.edges->transform == settings.transform)
    edges = settings.edges->pixels;
  const auto encoded = [&](const auto& codes) {
    return encoded_as("PNG", [&] {
      return encode_png(picture.width, picture.height, codes, settings.compression, text);
    });
  };
  return settings.bits == 16
             ? encoded(display_codes_16(picture, settings.exposure, settings.transform, edges))
             : encoded(display_codes(picture, settings.exposure, settings.transform, edges));
}

std::vector<std::byte> encode_png(const Image& picture, double exposure, Compression compression) {
  return encode_png(picture, {.exposure = exposure, .compression = compression});
}

void write_png(const fs::path& file, const Image& picture, const DisplaySettings& settings) {
  if (picture_format(file) != PictureFormat::png)
    throw OutputError(file.string(), "", "a PNG's name must end in .png");
  write_whole_file(file, encode_png(picture, settings));
}

void write_png(const fs::path& file, const Image& picture, double exposure) {
  write_png(file, picture, {.exposure = exposure});
}

void check_writable_image(const fs::path& file) {
  picture_format(file);
  check_writable_file(file);
}

// --- Reading

namespace {

struct ReleaseDecoded {
  void operator()(decoder::Decoded* decoded) const {
    decoder::module_table().release_decoded(decoded);
    delete decoded;
  }
};
using DecodedPicture = std::unique_ptr<decoder::Decoded, ReleaseDecoded>;

/// Reads single values of a decoded picture, taking sRGB code values to linear through a table:
/// a texture has millions of them, but only 256 or 65536 different ones.
class ChannelReader {
public:
  ChannelReader(const decoder::Decoded& decoded, const decoder::DecodedPart& part,
                Encoding encoding)
      : part_(part), last_(decoded.code_values) {
    if (encoding == Encoding::linear || last_ == 0)
      return;
    for (int code = 0; code <= last_; ++code)
      linear_.push_back(srgb_decode(static_cast<float>(code) / static_cast<float>(last_)));
  }
  float value(std::size_t pixel, int channel) const {
    return part_.pixels[pixel * static_cast<std::size_t>(part_.channels) +
                        static_cast<std::size_t>(channel)];
  }
  float linear(std::size_t pixel, int channel) const {
    const float stored = value(pixel, channel);
    if (linear_.empty())
      return stored;
    // Signed integers may be negative.
    const long code = std::lround(stored * static_cast<float>(last_));
    return linear_[static_cast<std::size_t>(std::clamp(code, 0L, long{last_}))];
  }

private:
  const decoder::DecodedPart& part_;
  int last_; ///< code value
  std::vector<float> linear_;
};

} // namespace

static DecodedPicture decode(std::span<const std::byte> bytes, const std::string& name,
                             decoder::Use use) {
  const decoder::Limits limits{.use = use, .side = 1 << 16, .values = std::size_t{1} << 30};
  DecodedPicture decoded(
      new decoder::Decoded(decoder::module_table().decode(bytes.data(), bytes.size(), limits)));
  if (decoded->owner == nullptr)
    throw InputError(name, "", fmt::format("cannot read the picture: {}", decoded->error));
  return decoded;
}

/// The display window of a part, with what is stored of it; the rest is 0.
static Image extract(const decoder::DecodedPart& part, const ChannelReader& reader,
                     const Components& components) {
  Image image(part.full_width, part.full_height);
  const int first_x = std::max(0, -part.x), first_y = std::max(0, -part.y);
  const int end_x = std::min(part.width, part.full_width - part.x);
  const int end_y = std::min(part.height, part.full_height - part.y);
  for (int y = first_y; y < end_y; ++y)
    for (int x = first_x; x < end_x; ++x) {
      const auto stored =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width) + static_cast<std::size_t>(x);
      for (int c = 0; c < 3; ++c)
        image.at(part.x + x, part.y + y)[c] =
            reader.linear(stored, components[static_cast<std::size_t>(c)]);
    }
  return image;
}

static std::vector<std::byte> read_bytes(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found)
    throw InputError(file.string(), "", "no such file");
  if (fs::is_directory(status))
    throw InputError(file.string(), "", "is a folder, not a picture");
  if (!fs::is_regular_file(status))
    throw InputError(file.string(), "", "cannot be read as a picture: it is not an ordinary file");

  std::ifstream stream(file, std::ios::binary);
  const auto size = fs::file_size(file, error);
  if (!stream || error)
    throw InputError(file.string(), "", "cannot be opened for reading");
  std::vector<std::byte> bytes(size);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw InputError(file.string(), "", "cannot be read to its end");
  return bytes;
}

/// What somebody who compares the picture may not expect of it.
static std::vector<std::string> remarks_on(const decoder::Decoded& decoded,
                                           const PictureChannels& channels) {
  std::vector<std::string> remarks;
  if (channels.picture && !channels.picture->name.empty())
    remarks.push_back(fmt::format("the picture is its '{}'", channels.picture->name));
  for (const auto& part : std::span(decoded.parts, decoded.part_count))
    if (part.left_out != nullptr)
      remarks.push_back(fmt::format("part '{}' is left out: {}", part.name, part.left_out));
  if (channels.picture) {
    const auto& part = decoded.parts[channels.picture->part];
    if (part.width != part.full_width || part.height != part.full_height || part.x != 0 ||
        part.y != 0)
      remarks.push_back(fmt::format("{}x{} pixels from ({}, {}) on are stored of its {}x{}: "
                                    "the others are 0, and what lies beyond is left out",
                                    part.width, part.height, part.x, part.y, part.full_width,
                                    part.full_height));
  }
  return remarks;
}

/// The view transform that a PNG of this program says, or nothing.
static std::string view_transform_of(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 256));
  const auto said = [&](ViewTransform transform) {
    std::string chunk = "tEXtView transform";
    chunk.append(1, '\0').append(title_of(transform));
    return text.find(chunk) != std::string_view::npos;
  };
  const auto found = std::ranges::find_if(view_transforms, said);
  return found == view_transforms.end() ? "" : std::string(title_of(*found));
}

static Attributes attributes_of(const decoder::Decoded& decoded) {
  Attributes attributes;
  for (const auto& [key, value] : std::span(decoded.attributes, decoded.attribute_count))
    if (std::string_view(key).starts_with(attribute_prefix))
      attributes.emplace_back(key + attribute_prefix.size(), value);
  std::ranges::sort(attributes);
  return attributes;
}

/// All that is stored of a part.
static Image stored_pixels(const decoder::DecodedPart& part, const Components& components) {
  Image image(part.width, part.height);
  const auto stride = static_cast<std::size_t>(part.channels);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (int c = 0; c < 3; ++c)
      image.pixels[p][c] = part.pixels[p * stride + static_cast<std::size_t>(components[static_cast<std::size_t>(c)])];
  return image;
}

WindowFile read_exr_window(const fs::path& file) {
  const auto decoded = decode(read_bytes(file), file.string(), decoder::Use::window);
  const PictureChannels channels = picture_channels(*decoded);
  const decoder::DecodedPart& part = decoded->parts[0];
  if (!channels.picture || decoded->part_count != 1 || part.left_out || decoded->code_values != 0)
    throw InputError(file.string(), "", "is no part of a picture");
  WindowFile result{.window = {part.x, part.y, part.width, part.height, part.full_width,
                               part.full_height},
                    .pixels = stored_pixels(part, channels.picture->components),
                    .layers = {},
                    .attributes = attributes_of(*decoded)};
  for (const ColourChannels& layer : channels.layers)
    result.layers.push_back({layer.name, stored_pixels(part, layer.components)});
  return result;
}

ImageFile read_image(const fs::path& file, Picture picture) {
  const auto name = file.string();
  const auto bytes = read_bytes(file);
  const auto transform = view_transform_of(bytes);
  const auto decoded = decode(bytes, name, decoder::Use::picture);
  PictureChannels channels = picture_channels(*decoded);
  if (!channels.picture && (picture == Picture::needed || channels.layers.empty()))
    throw InputError(name, "", channels.problem);

  ImageFile result;
  result.encoding = decoded->code_values == 0 ? Encoding::linear : Encoding::srgb;
  result.remarks = remarks_on(*decoded, channels);
  if (!transform.empty())
    result.remarks.push_back(
        fmt::format("its colours are those of the view transform {}", transform));
  result.ignored_channels = std::move(channels.others);
  const auto image_of = [&](const ColourChannels& colour) {
    const auto& part = decoded->parts[colour.part];
    return extract(part, ChannelReader(*decoded, part, Encoding::srgb), colour.components);
  };
  if (channels.picture) {
    result.picture = image_of(*channels.picture);
    result.picture_name = channels.picture->name;
  }
  for (const ColourChannels& layer : channels.layers)
    result.layers.push_back({layer.name, image_of(layer)});

  result.attributes = attributes_of(*decoded);
  return result;
}

Bitmap decode_image(std::span<const std::byte> encoded, Encoding encoding,
                    const std::string& name) {
  const auto decoded = decode(encoded, name, decoder::Use::texture);
  const PictureChannels channels = picture_channels(*decoded);
  if (!channels.picture)
    throw InputError(name, "", channels.problem);
  const auto& part = decoded->parts[channels.picture->part];
  const ChannelReader reader(*decoded, part, encoding);
  const auto& colour = channels.picture->components;
  const auto& alpha = channels.picture->alpha;

  Bitmap bitmap{part.width, part.height, {}};
  bitmap.pixels.resize(static_cast<std::size_t>(bitmap.width) *
                       static_cast<std::size_t>(bitmap.height));
  for (std::size_t pixel = 0; pixel < bitmap.pixels.size(); ++pixel)
    bitmap.pixels[pixel] = {reader.linear(pixel, colour[0]), reader.linear(pixel, colour[1]),
                            reader.linear(pixel, colour[2]),
                            alpha ? reader.value(pixel, *alpha) : 1.0F};
  return bitmap;
}

} // namespace meninas
