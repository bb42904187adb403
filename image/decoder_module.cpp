// The module behind decoder_seam.h, and the only user of OpenImageIO.
#include "image/decoder_seam.h"
#include "image/exr_header.h"
#include "image/png_pixels.h"
#include "image/png_rows.h"

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

struct DecodedStorage {
  std::unique_ptr<float[]> pixels;
  std::vector<std::string> names;
  std::vector<const char*> name_pointers;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<TextPair> attribute_pointers;
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

void set_error(Decoded& result, const std::string& reason) {
  const auto length = std::min(reason.size(), sizeof result.error - 1);
  std::memcpy(result.error, reason.data(), length);
  result.error[length] = '\0';
}

/// Runs `work` and turns any exception into the text that may cross the seam.
template <typename Work>
Decoded guarded(Work work) {
  Decoded result{};
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
      {"\x89PNG\r\n\x1a\n"sv, "png"},
      {"\xff\xd8\xff"sv, "jpeg"},
      {"#?RADIANCE"sv, "hdr"},
      {"#?RGBE"sv, "hdr"},
  };
  for (const auto& [signature, format] : signatures)
    if (bytes.starts_with(signature))
      return format;
  if (bytes.starts_with("RIFF"sv) &&
      bytes.substr(std::min<std::size_t>(8, bytes.size())).starts_with("WEBP"sv))
    return "webp";
  return nullptr;
}

void check_limits(const OIIO::ImageSpec& spec, const Limits& limits) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1)
    throw std::runtime_error("holds no flat picture");
  const auto size = std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                    " pixels of " + std::to_string(spec.nchannels) + " channels";
  if (spec.width > limits.side || spec.height > limits.side)
    throw std::runtime_error(size + " are too many; a side may have " +
                             std::to_string(limits.side));
  const auto values = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      static_cast<std::size_t>(spec.nchannels);
  if (values > limits.values)
    throw std::runtime_error(size + " are too many; all together may be " +
                             std::to_string(limits.values) + " values");
}

/// Code values are what an 8 or 16 bit file stores, to be read as sRGB; float files are linear.
int code_values_of(const OIIO::ImageSpec& spec) {
  if (spec.format.is_floating_point())
    return 0;
  return spec.format.basesize() == 1 ? 255 : 65535;
}

void copy_header(const OIIO::ImageSpec& spec, DecodedStorage& storage) {
  for (const auto& name : spec.channelnames)
    storage.names.push_back(name);
  storage.names.resize(static_cast<std::size_t>(spec.nchannels));
  for (const auto& name : storage.names)
    storage.name_pointers.push_back(name.c_str());
  for (const auto& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeString)
      storage.attributes.emplace_back(attribute.name().string(), attribute.get_string());
  for (const auto& [key, value] : storage.attributes)
    storage.attribute_pointers.push_back({key.c_str(), value.c_str()});
}

void decode_into(Decoded& result, std::string_view bytes, const Limits& limits) {
  const char* format = format_of(bytes);
  if (format == nullptr)
    throw std::runtime_error("not a picture: neither EXR, PNG, JPEG, WebP nor HDR");
  auto input = OIIO::ImageInput::create(format);
  if (!input || !input->supports("ioproxy"))
    fail(OIIO::geterror(), std::string("cannot decode ") + format);

  if (std::string_view(format) == "openexr")
    check_exr_header(bytes, limits);
  std::vector<std::uint8_t> png;
  if (std::string_view(format) == "png") {
    png = png_pixel_chunks(bytes);
    bytes = {reinterpret_cast<const char*>(png.data()), png.size()};
  }

  // Straight alpha, as glTF wants it:
  // colours must not be multiplied where a texture is transparent.
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageSpec spec;
  input->set_ioproxy(&reader);
  if (!input->open(file_name, spec, config))
    fail(input->geterror(), "cannot be opened");
  check_limits(spec, limits);
  if (!png.empty())
    check_png_rows(bytes);

  // The buffer is not cleared,
  // so a header that promises more than the file holds costs address space only.
  auto storage = std::make_unique<DecodedStorage>();
  const auto values =
      static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(spec.nchannels);
  storage->pixels = std::make_unique_for_overwrite<float[]>(values);
  const bool complete =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, storage->pixels.get());
  // A truncated JPEG counts as read, with the missing part grey and a message left behind.
  if (!complete || input->has_error())
    fail(input->geterror(), "cannot be decoded");

  copy_header(spec, *storage);
  result = {.owner = nullptr,
            .width = spec.width,
            .height = spec.height,
            .channels = spec.nchannels,
            .code_values = code_values_of(spec),
            .pixels = storage->pixels.get(),
            .channel_names = storage->name_pointers.data(),
            .attributes = storage->attribute_pointers.data(),
            .attribute_count = storage->attribute_pointers.size(),
            .error = {}};
  result.owner = storage.release();
}

/// OpenEXR decompresses by threads of its own,
/// as many as the machine has unless told otherwise; -1 is none.
void use_threads(int count) {
  static std::atomic<int> used{0};
  if (used.exchange(count) != count)
    OIIO::attribute("exr_threads", count > 1 ? count : -1);
}

Decoded decode(const void* bytes, std::size_t size, Limits limits) {
  return guarded([&](Decoded& result) {
    decode_into(result, {static_cast<const char*>(bytes), size}, limits);
  });
}

void release_decoded(Decoded* decoded) { delete static_cast<DecodedStorage*>(decoded->owner); }

constexpr Table table{seam_version, use_threads, decode, release_decoded};

} // namespace
} // namespace meninas::decoder

extern "C" __attribute__((visibility("default"))) const meninas::decoder::Table* meninas_decoder() {
  return &meninas::decoder::table;
}
