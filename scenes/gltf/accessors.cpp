#include "scenes/gltf/accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace meninas::gltf {

namespace {

enum class Component : std::uint32_t {
  i8 = 5120,
  u8 = 5121,
  i16 = 5122,
  u16 = 5123,
  u32 = 5125,
  f32 = 5126
};

std::size_t size_of(Component component) {
  switch (component) {
  case Component::i8:
  case Component::u8:
    return 1;
  case Component::i16:
  case Component::u16:
    return 2;
  default:
    return 4;
  }
}

template <typename T>
T read_as(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

double read_number(const unsigned char* bytes, Component component) {
  switch (component) {
  case Component::i8:
    return read_as<std::int8_t>(bytes);
  case Component::u8:
    return read_as<std::uint8_t>(bytes);
  case Component::i16:
    return read_as<std::int16_t>(bytes);
  case Component::u16:
    return read_as<std::uint16_t>(bytes);
  case Component::u32:
    return read_as<std::uint32_t>(bytes);
  case Component::f32:
    return read_as<float>(bytes);
  }
  return 0.0;
}

/// glTF 2.0, 3.6.2.2: signed integers stand for [-1, 1], the most negative code for -1 as well.
double normalised(double value, Component component) {
  switch (component) {
  case Component::i8:
    return std::max(value / 127.0, -1.0);
  case Component::u8:
    return value / 255.0;
  case Component::i16:
    return std::max(value / 32767.0, -1.0);
  case Component::u16:
    return value / 65535.0;
  default:
    return value;
  }
}

std::size_t width_of(const std::string& type) {
  if (type == "SCALAR")
    return 1;
  if (type == "VEC2")
    return 2;
  if (type == "VEC3")
    return 3;
  if (type == "VEC4")
    return 4;
  if (type == "MAT4")
    return 16;
  return 0;
}

/// A run of equally spaced elements that lies within its bytes.
struct Run {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

class Reader {
public:
  Reader(const Document& document, std::size_t accessor)
      : document_(document), json_(element(document.root, "accessors", accessor)),
        where_(place(document.root, "accessors", accessor)), type_(text_or(json_, "type", "")),
        width_(width_of(type_)), component_(component(json_)), count_(size_or(json_, "count", 0)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(document_.file, where_, what);
  }

  const std::string& type() const { return type_; }
  std::size_t width() const { return width_; }
  Component component() const { return component_; }
  bool is_normalised() const { return json_.value("normalized", false); }

  /// Calls read(element, bytes) for every stored element,
  /// the dense ones first, then the sparse ones.
  template <typename Read>
  void each(Read read) const {
    if (const auto view = index_at(json_, "bufferView")) {
      const auto run = elements(json_, *view, width_ * size_of(component_), count_);
      for (std::uint64_t k = 0; k < count_; ++k)
        read(k, run.first + k * run.stride);
    }
    if (const auto* sparse = find(json_, "sparse"))
      each_sparse(*sparse, read);
  }

  /// Elements without a stored value are zero, so only the limit on memory bounds their number.
  std::size_t count() const {
    if (count_ >
        document_.settings.memory_limit / (sizeof(double) * std::max<std::size_t>(width_, 1)))
      throw OutputError(document_.file, where_,
                        fmt::format("{} elements are over the memory limit", count_));
    return count_;
  }

private:
  Component component(const Json& object) const {
    const auto code = size_or(object, "componentType", 0);
    for (const auto known : {Component::i8, Component::u8, Component::i16, Component::u16,
                             Component::u32, Component::f32})
      if (code == static_cast<std::uint32_t>(known))
        return known;
    fail(fmt::format("componentType {} does not exist", code));
  }

  Run elements(const Json& object, std::size_t view, std::size_t element_size,
               std::uint64_t count) const {
    const auto bytes = view_bytes(document_, view);
    const auto offset = size_or(object, "byteOffset", 0);
    auto stride = size_or(element_of_view(view), "byteStride", 0);
    if (stride == 0)
      stride = element_size;
    if (stride < element_size)
      fail(fmt::format("bufferViews[{}] has byteStride {}, less than the {} bytes of an element",
                       view, stride, element_size));
    if (count == 0)
      return {};
    // offset + (count - 1) stride + element_size <= bytes,
    // without a sum or product that could wrap.
    const bool fits = offset <= bytes.size() && element_size <= bytes.size() - offset &&
                      count - 1 <= (bytes.size() - offset - element_size) / stride;
    if (!fits)
      fail(fmt::format(
          "{} elements of {} bytes from byte {} do not fit into the {} bytes of bufferViews[{}]",
          count, element_size, offset, bytes.size(), view));
    return {bytes.data() + offset, stride};
  }

  const Json& element_of_view(std::size_t view) const {
    return element(document_.root, "bufferViews", view);
  }

  template <typename Read>
  void each_sparse(const Json& sparse, Read read) const {
    const auto stored = size_or(sparse, "count", 0);
    if (stored > count_)
      fail(fmt::format("{} sparse elements in an accessor of {}", stored, count_));
    const auto& indices = sparse["indices"];
    const auto& values = sparse["values"];
    const auto index_type = component(indices);
    if (index_type != Component::u8 && index_type != Component::u16 && index_type != Component::u32)
      fail("sparse indices must be unsigned integers");
    const auto index_run =
        elements(indices, *index_at(indices, "bufferView"), size_of(index_type), stored);
    const auto value_run =
        elements(values, *index_at(values, "bufferView"), width_ * size_of(component_), stored);
    for (std::uint64_t k = 0; k < stored; ++k) {
      const auto at = static_cast<std::uint64_t>(
          read_number(index_run.first + k * index_run.stride, index_type));
      if (at >= count_)
        fail(fmt::format("sparse index {} in an accessor of {}", at, count_));
      read(at, value_run.first + k * value_run.stride);
    }
  }

  const Document& document_;
  const Json& json_;
  std::string where_;
  std::string type_;
  std::size_t width_;
  Component component_;
  std::uint64_t count_;
};

} // namespace

std::span<const unsigned char> bytes_of(const Document& document, const Json& range,
                                        const std::string& where) {
  const auto buffer = *index_at(range, "buffer");
  const std::span<const unsigned char> bytes = document.buffers[buffer];
  const auto announced = size_or(element(document.root, "buffers", buffer), "byteLength", 0);
  if (bytes.empty() && announced > 0)
    throw InputError(document.file, where, fmt::format("buffers[{}] has no data", buffer));
  const auto offset = size_or(range, "byteOffset", 0);
  const auto length = size_or(range, "byteLength", 0);
  if (offset > bytes.size() || length > bytes.size() - offset)
    throw InputError(
        document.file, where,
        fmt::format("{} bytes from byte {} do not fit into the {} bytes of buffers[{}]", length,
                    offset, bytes.size(), buffer));
  return bytes.subspan(offset, length);
}

std::span<const unsigned char> view_bytes(const Document& document, std::size_t view) {
  return bytes_of(document, element(document.root, "bufferViews", view),
                  place(document.root, "bufferViews", view));
}

std::uint64_t accessor_count(const Document& document, std::size_t accessor) {
  return size_or(element(document.root, "accessors", accessor), "count", 0);
}

Vectors decode_vectors(const Document& document, std::size_t accessor, std::size_t width) {
  const Reader reader(document, accessor);
  if (reader.width() != width)
    reader.fail(fmt::format("type must be {} for this use, it is '{}'",
                            width == 16  ? "MAT4"
                            : width == 1 ? "SCALAR"
                                         : fmt::format("VEC{}", width),
                            one_line(reader.type())));
  const auto component = reader.component();
  if (component == Component::u32)
    reader.fail("componentType 5125 is only for indices");
  const bool normalise = reader.is_normalised();

  Vectors vectors{width, std::vector<double>(reader.count() * width)};
  reader.each([&](std::uint64_t at, const unsigned char* bytes) {
    for (std::size_t c = 0; c < width; ++c) {
      const auto value = read_number(bytes + c * size_of(component), component);
      vectors.values[at * width + c] = normalise ? normalised(value, component) : value;
    }
  });
  return vectors;
}

/// Whether a number of `stored` bits is one of `bits`, of which the highest fill up the rest.
static bool has_repeated_bits(std::uint32_t value, int stored, int bits) {
  const auto high = value >> (stored - bits);
  return value == ((high << (stored - bits)) | (high >> (2 * bits - stored)));
}

double step_of_values(const Document& document, std::size_t accessor) {
  const Reader reader(document, accessor);
  const auto component = reader.component();
  if (const auto step = document.steps.find(accessor); step != document.steps.end())
    return step->second;
  if (component == Component::f32 || component == Component::u32)
    return 0.0;
  const bool has_sign = component == Component::i8 || component == Component::i16;
  const int stored = 8 * static_cast<int>(size_of(component)) - (has_sign ? 1 : 0);
  std::set<std::uint32_t> values;
  reader.each([&](std::uint64_t, const unsigned char* bytes) {
    for (std::size_t c = 0; c < reader.width(); ++c)
      values.insert(static_cast<std::uint32_t>(
          std::abs(read_number(bytes + c * size_of(component), component))));
  });
  constexpr std::size_t few = 16; // of them some fit by chance
  int bits = stored;
  for (int fewer = stored - 1; values.size() >= few && 2 * fewer > stored; --fewer)
    if (std::ranges::all_of(values, [&](auto v) { return has_repeated_bits(v, stored, fewer); }))
      bits = fewer;
  const double step = std::ldexp(1.0, stored - bits);
  return reader.is_normalised() ? normalised(step, component) : step;
}

std::vector<std::uint32_t> decode_indices(const Document& document, std::size_t accessor) {
  const Reader reader(document, accessor);
  const auto component = reader.component();
  if (reader.width() != 1)
    reader.fail(
        fmt::format("type must be SCALAR for indices, it is '{}'", one_line(reader.type())));
  if (component != Component::u8 && component != Component::u16 && component != Component::u32)
    reader.fail("indices must be unsigned integers");
  std::vector<std::uint32_t> indices(reader.count());
  reader.each([&](std::uint64_t at, const unsigned char* bytes) {
    indices[at] = static_cast<std::uint32_t>(read_number(bytes, component));
  });
  return indices;
}

StoredElements stored_elements(const Document& document, std::size_t accessor) {
  const Reader reader(document, accessor);
  if (reader.width() == 0)
    reader.fail(fmt::format("type '{}' is not read", one_line(reader.type())));
  StoredElements stored{.width = reader.width(),
                        .component_size = size_of(reader.component()),
                        .component = static_cast<std::uint32_t>(reader.component()),
                        .bytes = {}};
  stored.bytes.resize(reader.count() * stored.size());
  reader.each([&](std::uint64_t at, const unsigned char* bytes) {
    std::memcpy(stored.bytes.data() + at * stored.size(), bytes, stored.size());
  });
  return stored;
}

double stored_number(const StoredElements& elements, std::size_t element, std::size_t component) {
  return read_number(elements.bytes.data() + element * elements.size() +
                         component * elements.component_size,
                     static_cast<Component>(elements.component));
}

} // namespace meninas::gltf
