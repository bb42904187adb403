#include "image/codecs/exr_encoding.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace meninas {

namespace {

/// A file in memory.
class ByteStream : public Imf::OStream {
public:
  explicit ByteStream(std::vector<std::byte>& bytes) : OStream("memory"), bytes_(bytes) {}

  void write(const char* from, int count) override {
    const auto size = static_cast<std::size_t>(count);
    // The library comes back to fill in where the rows are.
    bytes_.resize(std::max(bytes_.size(), place_ + size));
    std::memcpy(bytes_.data() + place_, from, size);
    place_ += size;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }

private:
  std::vector<std::byte>& bytes_;
  std::size_t place_ = 0;
};

/// Some channels of the file, stored under `prefix` ("" or "NAME.").
struct Planes {
  std::string prefix;
  const Image* image;
  std::span<const char* const> components;
};

constexpr std::array colour = {"R", "G", "B"};
constexpr std::array vector = {"X", "Y", "Z"};
constexpr std::array depth = {"Z"};
constexpr std::array alpha = {"A"};

/// What compositors know a layer's channels by. Of depth and alpha R is written.
std::span<const char* const> components_of(std::string_view layer) {
  if (layer == "depth")
    return depth;
  if (layer == "alpha")
    return alpha;
  if (layer == "normal")
    return vector;
  return colour;
}

template <typename Value>
constexpr Imf::PixelType stored_type = std::is_same_v<Value, half> ? Imf::HALF : Imf::FLOAT;

} // namespace

/// As compositors know layers, or all as colours.
enum class LayerChannels { known, colours };

static std::vector<Planes> planes_of(const Image& picture, std::span<const Layer> layers,
                                     LayerChannels channels) {
  std::vector<Planes> planes{{"", &picture, colour}};
  for (const Layer& layer : layers)
    if (channels == LayerChannels::known) // the alpha is that of the picture itself: A
      planes.push_back({layer.name == "alpha" ? "" : layer.name + ".", &layer.image,
                        components_of(layer.name)});
    else
      planes.push_back({layer.name + ".", &layer.image, colour});
  return planes;
}

static std::size_t channel_count(std::span<const Planes> planes) {
  std::size_t count = 0;
  for (const Planes& one : planes)
    count += one.components.size();
  return count;
}

/// No date among the attributes: the same picture would become two different files.
static Imf::Header header_of(const DataWindow& window, std::span<const Planes> planes,
                             Imf::PixelType type, const Attributes& attributes) {
  const Imath::V2i first(window.x, window.y), size(window.width, window.height), one(1, 1);
  const Imath::V2i all(window.picture_width, window.picture_height);
  Imf::Header header(Imath::Box2i(Imath::V2i(0, 0), all - one),
                     Imath::Box2i(first, first + size - one));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [prefix, image, components] : planes)
    for (const char* component : components)
      header.channels().insert(prefix + component, Imf::Channel(type));
  header.insert("Software", Imf::StringAttribute("Meninas " MENINAS_VERSION));
  for (const auto& [key, value] : attributes)
    if (!value.empty())
      header.insert(std::string(attribute_prefix) + key, Imf::StringAttribute(value));
  return header;
}

/// Some rows of all planes, interleaved, clipped to what the type can hold:
/// an infinity would poison every filter that touches it later.
template <typename Value>
static std::vector<Value> gather_rows(std::span<const Planes> planes, int first, int last) {
  const auto largest = static_cast<float>(std::numeric_limits<Value>::max());
  const auto width = static_cast<std::size_t>(planes.front().image->width);
  const auto begin = static_cast<std::size_t>(first) * width;
  const auto count = static_cast<std::size_t>(last - first) * width;
  const auto stride = channel_count(planes);
  std::vector<Value> rows(count * stride);
  std::size_t place = 0;
  for (const Planes& one : planes) {
    for (std::size_t pixel = 0; pixel < count; ++pixel)
      for (std::size_t c = 0; c < one.components.size(); ++c)
        rows[pixel * stride + place + c] =
            Value(std::clamp(one.image->pixels[begin + pixel][static_cast<glm::length_t>(c)],
                             -largest, largest));
    place += one.components.size();
  }
  return rows;
}

/// Tells where the values of each channel are, for rows of the window from `first` on.
template <typename Value>
static Imf::FrameBuffer frame_of(std::vector<Value>& rows, std::span<const Planes> planes,
                                 const DataWindow& window, int first) {
  const auto width = static_cast<std::size_t>(planes.front().image->width);
  const auto stride = channel_count(planes) * sizeof(Value);
  Imf::FrameBuffer frame;
  std::size_t place = 0;
  for (const Planes& one : planes)
    for (const char* component : one.components) {
      // The library counts rows from the top of the picture, and columns from its left.
      const auto before = static_cast<std::size_t>(window.y + first) * width +
                          static_cast<std::size_t>(window.x);
      auto* top = reinterpret_cast<char*>(rows.data() + place++) -
                  static_cast<std::ptrdiff_t>(before * stride);
      frame.insert(one.prefix + component,
                   Imf::Slice(stored_type<Value>, top, stride, width * stride));
    }
  return frame;
}

/// A band of rows at a time keeps the interleaved copy small,
/// and is enough for parallel compression.
template <typename Value>
static void write_rows(Imf::OutputFile& file, std::span<const Planes> planes,
                       const DataWindow& window) {
  constexpr int band = 256;
  const int height = window.height;
  for (int first = 0; first < height; first += band) {
    const int last = std::min(first + band, height);
    auto rows = gather_rows<Value>(planes, first, last);
    file.setFrameBuffer(frame_of(rows, planes, window, first));
    file.writePixels(last - first);
  }
}

/// The library compresses by threads of its own, none unless told otherwise.
static int use_threads() {
  const auto allowed =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const int threads = allowed > 1 ? static_cast<int>(allowed) : 0;
  if (Imf::globalThreadCount() != threads)
    Imf::setGlobalThreadCount(threads);
  return threads;
}

static std::vector<std::byte> encode_planes(std::span<const Planes> planes, PixelType type,
                                            const DataWindow& window,
                                            const Attributes& attributes) {
  const auto stored = type == PixelType::half ? Imf::HALF : Imf::FLOAT;
  std::vector<std::byte> bytes;
  ByteStream stream(bytes);
  {
    Imf::OutputFile file(stream, header_of(window, planes, stored, attributes), use_threads());
    type == PixelType::half ? write_rows<half>(file, planes, window)
                            : write_rows<float>(file, planes, window);
  }
  return bytes;
}

std::vector<std::byte> encode_exr(const Image& picture, std::span<const Layer> layers,
                                  PixelType type, const Attributes& attributes) {
  const int width = picture.width, height = picture.height;
  return encode_planes(planes_of(picture, layers, LayerChannels::known), type,
                       {0, 0, width, height, width, height}, attributes);
}

std::vector<std::byte> encode_exr_window(const Image& picture, std::span<const Layer> layers,
                                         const DataWindow& window, const Attributes& attributes) {
  return encode_planes(planes_of(picture, layers, LayerChannels::colours), PixelType::float32,
                       window, attributes);
}

} // namespace meninas
