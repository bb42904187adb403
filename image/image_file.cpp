#include "image/image_file.h"

#include "image/decoder_loader.h"
#include "image/display.h"
#include "image/exr_encoding.h"
#include "image/png_encoding.h"
#include "image/whole_file.h"
#include "scenes/errors.h"
#include "scenes/types.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string_view>

namespace meninas {

namespace fs = std::filesystem;

static constexpr decoder::Limits limits{.side = 1 << 16, .values = std::size_t{1} << 30};

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
  throw OutputError(
      file.string(), "",
      extension.empty()
          ? "a picture's name must end in .exr or .png"
          : fmt::format("cannot write pictures as '{}', only .exr and .png", extension));
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

std::vector<std::byte> encode_png(const Image& picture, double exposure, Compression compression) {
  expect_picture(picture);
  const auto codes = display_codes(picture, exposure);
  return encoded_as("PNG",
                    [&] { return encode_png(picture.width, picture.height, codes, compression); });
}

void write_png(const fs::path& file, const Image& picture, double exposure) {
  if (picture_format(file) != PictureFormat::png)
    throw OutputError(file.string(), "", "a PNG's name must end in .png");
  write_whole_file(file, encode_png(picture, exposure));
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

/// Where a colour's components are among the channels of a file.
using Components = std::array<int, 3>;

/// Reads single values of a decoded picture, taking sRGB code values to linear through a table:
/// a texture has millions of them, but only 256 or 65536 different ones.
class ChannelReader {
public:
  ChannelReader(const decoder::Decoded& decoded, Encoding encoding) : decoded_(decoded) {
    if (encoding == Encoding::linear || decoded.code_values == 0)
      return;
    const int last = decoded.code_values;
    for (int code = 0; code <= last; ++code)
      linear_.push_back(srgb_decode(static_cast<float>(code) / static_cast<float>(last)));
  }
  float value(std::size_t pixel, int channel) const {
    return decoded_.pixels[pixel * static_cast<std::size_t>(decoded_.channels) +
                           static_cast<std::size_t>(channel)];
  }
  float linear(std::size_t pixel, int channel) const {
    const float stored = value(pixel, channel);
    if (linear_.empty())
      return stored;
    return linear_[static_cast<std::size_t>(
        std::lround(stored * static_cast<float>(decoded_.code_values)))];
  }

private:
  const decoder::Decoded& decoded_;
  std::vector<float> linear_;
};

} // namespace

static DecodedPicture decode(std::span<const std::byte> bytes, const std::string& name) {
  DecodedPicture decoded(
      new decoder::Decoded(decoder::module_table().decode(bytes.data(), bytes.size(), limits)));
  if (decoded->owner == nullptr)
    throw InputError(name, "", fmt::format("cannot read the picture: {}", decoded->error));
  return decoded;
}

/// Channel number by name.
/// Some decoders leave grey pictures unnamed, so one or two channels are grey (and alpha).
static std::map<std::string, int, std::less<>> channel_numbers(const decoder::Decoded& decoded) {
  std::map<std::string, int, std::less<>> numbers;
  for (int channel = 0; channel < decoded.channels; ++channel)
    numbers.emplace(decoded.channel_names[channel], channel);
  if (decoded.code_values != 0 && decoded.channels <= 2) {
    numbers.clear();
    numbers.emplace("Y", 0);
    if (decoded.channels == 2)
      numbers.emplace("A", 1);
  }
  return numbers;
}

/// Takes PREFIX R, G and B out of the channels that are left, if all three are there.
static std::optional<Components> take_colour(std::map<std::string, int, std::less<>>& channels,
                                             const std::string& prefix) {
  const auto r = channels.find(prefix + "R"), g = channels.find(prefix + "G"),
             b = channels.find(prefix + "B");
  if (r == channels.end() || g == channels.end() || b == channels.end())
    return std::nullopt;
  const Components components{r->second, g->second, b->second};
  channels.erase(r);
  channels.erase(g);
  channels.erase(b);
  return components;
}

static Components take_picture(std::map<std::string, int, std::less<>>& channels,
                               const std::string& name) {
  if (const auto colour = take_colour(channels, ""))
    return *colour;
  const auto grey = channels.find("Y");
  if (grey == channels.end()) {
    std::vector<std::string> some;
    for (const auto& [channel, number] : channels)
      if (some.size() < 8)
        some.push_back(channel);
    if (some.size() < channels.size())
      some.emplace_back("...");
    throw InputError(name, "",
                     fmt::format("holds no channels R, G and B, only {}", fmt::join(some, ", ")));
  }
  const Components components{grey->second, grey->second, grey->second};
  channels.erase(grey);
  return components;
}

static Image extract(const decoder::Decoded& decoded, const ChannelReader& reader,
                     const Components& components) {
  Image image(decoded.width, decoded.height);
  for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel)
    for (int c = 0; c < 3; ++c)
      image.pixels[pixel][c] = reader.linear(pixel, components[static_cast<std::size_t>(c)]);
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

ImageFile read_image(const fs::path& file) {
  const auto name = file.string();
  const auto decoded = decode(read_bytes(file), name);
  const ChannelReader reader(*decoded, Encoding::srgb);

  // R, G and B are the picture; every other NAME.R with its G and B is a layer.
  auto channels = channel_numbers(*decoded);
  ImageFile result;
  result.encoding = decoded->code_values == 0 ? Encoding::linear : Encoding::srgb;
  result.picture = extract(*decoded, reader, take_picture(channels, name));
  std::vector<std::string> layer_names;
  for (const auto& [channel, number] : channels)
    if (channel.size() > 2 && channel.ends_with(".R"))
      layer_names.push_back(channel.substr(0, channel.size() - 2));
  std::ranges::sort(layer_names);
  for (const auto& layer : layer_names)
    if (const auto components = take_colour(channels, layer + "."))
      result.layers.push_back({layer, extract(*decoded, reader, *components)});
  for (const auto& [channel, number] : channels)
    result.ignored_channels.push_back(channel);

  for (const auto& [key, value] : std::span(decoded->attributes, decoded->attribute_count))
    if (std::string_view(key).starts_with(attribute_prefix))
      result.attributes.emplace_back(key + attribute_prefix.size(), value);
  std::ranges::sort(result.attributes);
  return result;
}

Bitmap decode_image(std::span<const std::byte> encoded, Encoding encoding,
                    const std::string& name) {
  const auto decoded = decode(encoded, name);
  const ChannelReader reader(*decoded, encoding);
  auto channels = channel_numbers(*decoded);
  const auto colour = take_picture(channels, name);
  const auto alpha = channels.find("A");

  Bitmap bitmap{decoded->width, decoded->height, {}};
  bitmap.pixels.resize(static_cast<std::size_t>(bitmap.width) *
                       static_cast<std::size_t>(bitmap.height));
  for (std::size_t pixel = 0; pixel < bitmap.pixels.size(); ++pixel)
    bitmap.pixels[pixel] = {reader.linear(pixel, colour[0]), reader.linear(pixel, colour[1]),
                            reader.linear(pixel, colour[2]),
                            alpha == channels.end() ? 1.0F : reader.value(pixel, alpha->second)};
  return bitmap;
}

} // namespace meninas
