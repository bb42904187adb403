// The module behind decoder_seam.h, and the only user of OpenImageIO, which reads all but PNG.
#include "image/codecs/decoder_seam.h"
#include "image/codecs/exr_header.h"
#include "image/codecs/png_decoding.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meninas::decoder {
namespace {

struct StoredPart {
  std::unique_ptr<float[]> pixels;
  std::string name, left_out;
  std::vector<std::string> channel_names;
  std::vector<const char*> channel_pointers;
};

struct DecodedStorage {
  std::vector<std::unique_ptr<StoredPart>> parts;
  std::vector<DecodedPart> seen; ///< the same, as they cross the seam
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<TextPair> attribute_pointers;
  std::size_t values = 0;
};

/// What OpenImageIO is told the file is called.
/// Its messages repeat it; whoever reports them knows the right name.
constexpr const char* file_name = "memory";

/// OpenImageIO collects messages of several lines; a user reads one.
std::string one_line(std::string text) {
  const auto quoted = '"' + std::string(file_name) + '"';
  for (const auto& mention : {" (" + quoted + ")", " " + quoted, quoted + " "})
    for (auto place = text.find(mention); place != std::string::npos; place = text.find(mention))
      text.erase(place, mention.size());
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
    text.pop_back();
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "; ";
    else if (static_cast<unsigned char>(c) >= 0x20)
      line += c;
  }
  return line;
}

template <typename Result>
void set_error(Result& result, const std::string& reason) {
  const auto length = std::min(reason.size(), sizeof result.error - 1);
  std::memcpy(result.error, reason.data(), length);
  result.error[length] = '\0';
}

/// Runs `work` and turns any exception into the text that may cross the seam.
template <typename Result, typename Work>
Result guarded(Work work) {
  Result result{};
  try {
    work(result);
  } catch (const std::bad_alloc&) {
    set_error(result, "not enough memory");
  } catch (const std::exception& error) {
    set_error(result, one_line(error.what()));
  } catch (...) {
    set_error(result, "unknown failure inside the picture library");
  }
  return result;
}

[[noreturn]] void fail(const std::string& reason, const std::string& fallback) {
  throw std::runtime_error(reason.empty() ? fallback : reason);
}

/// The format by its first bytes; a name says nothing about an image held in memory.
const char* format_of(std::string_view bytes) {
  using namespace std::literals;
  constexpr std::pair<std::string_view, const char*> signatures[] = {
      {"\x76\x2f\x31\x01"sv, "openexr"},
      {"\xff\xd8\xff"sv, "jpeg"},
      {"#?RADIANCE"sv, "hdr"},
      {"#?RGBE"sv, "hdr"},
      {"II*\0"sv, "tiff"},
      {"MM\0*"sv, "tiff"},
      {"II+\0"sv, "tiff"},
      {"MM\0+"sv, "tiff"},
  };
  for (const auto& [signature, format] : signatures)
    if (bytes.starts_with(signature))
      return format;
  if (bytes.starts_with("RIFF"sv) &&
      bytes.substr(std::min<std::size_t>(8, bytes.size())).starts_with("WEBP"sv))
    return "webp";
  return nullptr;
}

/// A display window may be larger than what is stored: a crop of a large picture.
/// Beyond 8K a quarter of it is to be there, or a small file would ask for gigabytes.
void check_display_window(const OIIO::ImageSpec& spec, const Limits& limits) {
  constexpr std::size_t of_8k = std::size_t{1} << 25;
  const auto pixels =
      static_cast<std::size_t>(spec.full_width) * static_cast<std::size_t>(spec.full_height);
  if (spec.full_width <= 0 || spec.full_height <= 0 || spec.full_width > limits.side ||
      spec.full_height > limits.side || (pixels > of_8k && pixels / 4 > spec.image_pixels()))
    throw std::runtime_error("its display window, " + std::to_string(spec.full_width) + " x " +
                             std::to_string(spec.full_height) + " pixels, is too large for its " +
                             std::to_string(spec.width) + " x " + std::to_string(spec.height));
}

/// `used` are the values of the parts before.
void check_size(int width, int height, int channels, std::size_t used, const Limits& limits) {
  if (width <= 0 || height <= 0 || channels <= 0)
    throw std::runtime_error("holds no flat picture");
  const auto size = std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                    std::to_string(channels) + " channels";
  if (width > limits.side || height > limits.side)
    throw std::runtime_error(size + " are too many; a side may have " +
                             std::to_string(limits.side));
  const auto values = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                      static_cast<std::size_t>(channels);
  if (values > limits.values - used)
    throw std::runtime_error(size + " are too many; all together may be " +
                             std::to_string(limits.values) + " values");
}

void check_limits(const OIIO::ImageSpec& spec, std::size_t used, const Limits& limits) {
  if (spec.deep)
    throw std::runtime_error("holds deep data, not a flat picture");
  if (spec.depth > 1)
    throw std::runtime_error("holds no flat picture");
  check_size(spec.width, spec.height, spec.nchannels, used, limits);
}

/// libtiff makes room for a strip before it reads it. No compression of a picture with anything
/// in it does better than deflate, a thousand to one: what promises more is not there.
void check_tiff_size(const OIIO::ImageSpec& spec, std::size_t file_size) {
  constexpr std::size_t best_compression = 1100;
  if (spec.image_bytes(true) / best_compression > file_size)
    throw std::runtime_error("the TIFF promises more than it holds");
}

/// Code values are what a file of integers stores, to be read as sRGB; float files are linear,
/// and so is every EXR.
int code_values_of(const OIIO::ImageSpec& spec, std::string_view format) {
  if (spec.format.is_floating_point() || format == "openexr")
    return 0;
  return spec.format.basesize() == 1 ? 255 : 65535;
}

void copy_attributes(const OIIO::ImageSpec& spec, DecodedStorage& storage) {
  for (const auto& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeString)
      storage.attributes.emplace_back(attribute.name().string(), attribute.get_string());
  for (const auto& [key, value] : storage.attributes)
    storage.attribute_pointers.push_back({key.c_str(), value.c_str()});
}

/// OpenImageIO takes integers to fractions of their largest. In an EXR they are numbers.
void restore_integers(const OIIO::ImageSpec& spec, float* pixels) {
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  for (std::size_t c = 0; c < channels; ++c)
    if (spec.channelformat(static_cast<int>(c)) == OIIO::TypeDesc::UINT32)
      for (std::size_t k = 0; k < spec.image_pixels(); ++k)
        pixels[k * channels + c] *= 4294967295.0F;
}

struct EncodedPicture {
  std::string_view bytes;
  std::string_view format;
  Limits limits;
};

void read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int number,
                 const EncodedPicture& picture, StoredPart& part) {
  // The buffer is not cleared,
  // so a header that promises more than the file holds costs address space only.
  const auto values =
      static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(spec.nchannels);
  part.pixels = std::make_unique_for_overwrite<float[]>(values);
  const bool complete =
      input.read_image(number, 0, 0, spec.nchannels, OIIO::TypeFloat, part.pixels.get());
  // A truncated JPEG counts as read, with the missing part grey and a message left behind.
  if (!complete || input.has_error())
    fail(input.geterror(), "cannot be decoded");
  if (picture.format == "openexr")
    restore_integers(spec, part.pixels.get());
}

/// Appends a part. What makes one of several parts unreadable is said of it;
/// damage is damage of the whole file.
void add_part(OIIO::ImageInput& input, int number, const EncodedPicture& picture,
              DecodedStorage& storage) {
  const OIIO::ImageSpec spec = input.spec(number);
  auto part = std::make_unique<StoredPart>();
  part->name = spec.get_string_attribute("oiio:subimagename");
  try {
    check_limits(spec, storage.values, picture.limits);
    if (picture.format == "openexr" && picture.limits.use != Use::window)
      check_display_window(spec, picture.limits);
    if (picture.format == "tiff")
      check_tiff_size(spec, picture.bytes.size());
  } catch (const std::runtime_error& reason) {
    part->left_out = reason.what();
  }
  for (const auto& name : spec.channelnames)
    part->channel_names.push_back(name);
  part->channel_names.resize(static_cast<std::size_t>(std::max(spec.nchannels, 0)));
  for (const auto& name : part->channel_names)
    part->channel_pointers.push_back(name.c_str());
  const bool windows = picture.format == "openexr";
  DecodedPart seen{};
  seen.name = part->name.c_str();
  seen.width = spec.width;
  seen.height = spec.height;
  seen.channels = spec.nchannels;
  seen.x = windows ? spec.x - spec.full_x : 0;
  seen.y = windows ? spec.y - spec.full_y : 0;
  seen.full_width = windows ? spec.full_width : spec.width;
  seen.full_height = windows ? spec.full_height : spec.height;
  seen.channel_names = part->channel_pointers.data();
  if (part->left_out.empty()) {
    read_pixels(input, spec, number, picture, *part);
    storage.values +=
        static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(spec.nchannels);
    seen.pixels = part->pixels.get();
  } else {
    seen.left_out = part->left_out.c_str();
  }
  storage.parts.push_back(std::move(part));
  storage.seen.push_back(seen);
}

void hand_out(std::unique_ptr<DecodedStorage> storage, int code_values, Decoded& result) {
  result = {.owner = nullptr,
            .parts = storage->seen.data(),
            .part_count = storage->seen.size(),
            .code_values = code_values,
            .attributes = storage->attribute_pointers.data(),
            .attribute_count = storage->attribute_pointers.size(),
            .error = {}};
  result.owner = storage.release();
}

void decode_png_into(Decoded& result, std::string_view bytes, const Limits& limits) {
  DecodedPng png = decode_png(bytes, [&](const PngShape& shape) {
    check_size(shape.width, shape.height, shape.channels, 0, limits);
  });
  const PngShape& shape = png.shape;
  auto part = std::make_unique<StoredPart>();
  part->pixels = std::move(png.pixels);
  if (shape.channels < 3)
    part->channel_pointers = {"Y", "A"};
  else
    part->channel_pointers = {"R", "G", "B", "A"};
  auto storage = std::make_unique<DecodedStorage>();
  storage->seen.push_back({.name = part->name.c_str(),
                           .left_out = nullptr,
                           .width = shape.width,
                           .height = shape.height,
                           .channels = shape.channels,
                           .x = 0,
                           .y = 0,
                           .full_width = shape.width,
                           .full_height = shape.height,
                           .pixels = part->pixels.get(),
                           .channel_names = part->channel_pointers.data()});
  storage->parts.push_back(std::move(part));
  hand_out(std::move(storage), shape.bits == 16 ? 65535 : 255, result);
}

void decode_into(Decoded& result, std::string_view bytes, const Limits& limits) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"))
    return decode_png_into(result, bytes, limits);
  const char* format = format_of(bytes);
  if (format == nullptr)
    throw std::runtime_error("not a picture: neither EXR, PNG, JPEG, WebP, TIFF nor HDR");
  auto input = OIIO::ImageInput::create(format);
  if (!input || !input->supports("ioproxy"))
    fail(OIIO::geterror(), std::string("cannot decode ") + format);

  const std::string_view name(format);
  if (name == "tiff" && limits.use == Use::texture)
    throw std::runtime_error("a TIFF cannot be a texture");
  if (name == "openexr")
    check_exr_header(bytes, limits);

  // Straight alpha, as glTF wants it:
  // colours must not be multiplied where a texture is transparent.
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageSpec spec;
  input->set_ioproxy(&reader);
  if (!input->open(file_name, spec, config))
    fail(input->geterror(), "cannot be opened");

  // Pages of a TIFF are pictures of their own: the first is meant.
  constexpr int max_parts = 256;
  auto storage = std::make_unique<DecodedStorage>();
  for (int part = 0; part < max_parts && input->seek_subimage(part, 0); ++part) {
    add_part(*input, part, {bytes, name, limits}, *storage);
    if (name != "openexr" || limits.use == Use::texture)
      break;
  }
  if (std::ranges::all_of(storage->seen, [](const DecodedPart& p) { return p.pixels == nullptr; }))
    fail(storage->parts.empty() ? input->geterror() : storage->parts.front()->left_out,
         "holds no flat picture");
  copy_attributes(spec, *storage);
  hand_out(std::move(storage), code_values_of(spec, name), result);
}

/// OpenEXR decompresses by threads of its own,
/// as many as the machine has unless told otherwise; -1 is none.
void use_threads(int count) {
  static std::atomic<int> used{0};
  if (used.exchange(count) != count)
    OIIO::attribute("exr_threads", count > 1 ? count : -1);
}

Decoded decode(const void* bytes, std::size_t size, Limits limits) {
  return guarded<Decoded>([&](Decoded& result) {
    decode_into(result, {static_cast<const char*>(bytes), size}, limits);
  });
}

void release_decoded(Decoded* decoded) { delete static_cast<DecodedStorage*>(decoded->owner); }

void encode_hdr_into(Encoded& result, const float* pixels, int width, int height) {
  auto output = OIIO::ImageOutput::create("hdr");
  if (!output || !output->supports("ioproxy"))
    fail(OIIO::geterror(), "cannot encode hdr");
  auto bytes = std::make_unique<std::vector<unsigned char>>();
  OIIO::Filesystem::IOVecOutput writer(*bytes);
  output->set_ioproxy(&writer);
  const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeFloat);
  if (!output->open(file_name, spec) || !output->write_image(OIIO::TypeFloat, pixels) || !output->close())
    fail(output->geterror(), "cannot be encoded");
  result.bytes = bytes->data();
  result.size = bytes->size();
  result.owner = bytes.release();
}

Encoded encode_hdr(const float* pixels, int width, int height) {
  return guarded<Encoded>([&](Encoded& result) { encode_hdr_into(result, pixels, width, height); });
}

void release_encoded(Encoded* encoded) {
  delete static_cast<std::vector<unsigned char>*>(encoded->owner);
}

constexpr Table table{seam_version, use_threads, decode, release_decoded, encode_hdr, release_encoded};

} // namespace
} // namespace meninas::decoder

extern "C" __attribute__((visibility("default"))) const meninas::decoder::Table* meninas_decoder() {
  return &meninas::decoder::table;
}
