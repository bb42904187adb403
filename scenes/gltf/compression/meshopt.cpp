// Buffer views of EXT_meshopt_compression and KHR_meshopt_compression, decoded.
// (The only user of meshoptimizer.)
//
// The decoders are safe for any data, but they only assert what counts, strides and filters must be.
#include "scenes/gltf/accessors.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>

namespace meninas::gltf {

namespace {

/// A compressed view, as its extension describes it.
class CompressedView {
public:
  CompressedView(const Document& document, std::size_t view, std::string_view extension)
      : document_(document),
        json_(*find(element(document.root, "bufferViews", view), {"extensions", extension})),
        where_(fmt::format("{}: {}", place(document.root, "bufferViews", view), extension)),
        mode_(text_or(json_, "mode", "")), filter_(text_or(json_, "filter", "NONE")),
        stride_(size_or(json_, "byteStride", 0)), count_(size_or(json_, "count", 0)) {}

  Bytes decode() const {
    check_description();
    if (count_ > memory_left(document_) / stride_)
      throw OutputError(
          document_.file, where_,
          fmt::format("{} elements of {} bytes are over the memory limit", count_, stride_));
    const auto source = bytes_of(document_, json_, where_);
    if (is_of_next_codec(source))
      fail("the data is of version 1 of the codec, only 0 is read");
    // The shortest codes: two bits for 16 equal bytes of vertices, one byte for three indices.
    constexpr std::uint64_t max_per_byte = 64;
    Bytes decoded(count_ * stride_ / max_per_byte <= source.size() ? count_ * stride_ : 0);
    if (decoded.empty() && count_ == 0)
      return decoded;
    if (decoded.empty() || decode_into(decoded, source) != 0)
      fail("the data is truncated or corrupt");
    apply_filter(decoded);
    return decoded;
  }

private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(document_.file, where_, what);
  }

  bool is_of_attributes() const { return mode_ == "ATTRIBUTES"; }

  void check_description() const {
    if (!is_of_attributes() && mode_ != "TRIANGLES" && mode_ != "INDICES")
      fail(fmt::format("mode '{}' does not exist", one_line(mode_)));
    if (is_of_attributes() ? stride_ == 0 || stride_ > 256 || stride_ % 4 != 0
                           : stride_ != 2 && stride_ != 4)
      fail(fmt::format("byteStride must be {} for mode {}, it is {}",
                       is_of_attributes() ? "a multiple of 4 up to 256" : "2 or 4", mode_,
                       stride_));
    if (mode_ == "TRIANGLES" && count_ % 3 != 0)
      fail(fmt::format("count must be a multiple of 3 for mode TRIANGLES, it is {}", count_));
    if (filter_ == "NONE")
      return;
    if (filter_ != "OCTAHEDRAL" && filter_ != "QUATERNION" && filter_ != "EXPONENTIAL")
      fail(fmt::format("filter '{}' is not read", one_line(filter_)));
    if (!is_of_attributes())
      fail(fmt::format("filter {} is only for mode ATTRIBUTES", filter_));
    const bool fits = filter_ == "EXPONENTIAL" || stride_ == 8 ||
                      (filter_ == "OCTAHEDRAL" && stride_ == 4);
    if (!fits)
      fail(fmt::format("byteStride {} is not for filter {}", stride_, filter_));
  }

  int decode_into(Bytes& decoded, std::span<const unsigned char> source) const {
    void* const to = decoded.data();
    if (is_of_attributes())
      return meshopt_decodeVertexBuffer(to, count_, stride_, source.data(), source.size());
    if (mode_ == "TRIANGLES")
      return meshopt_decodeIndexBuffer(to, count_, stride_, source.data(), source.size());
    return meshopt_decodeIndexSequence(to, count_, stride_, source.data(), source.size());
  }

  /// The first byte of vertices is 0xA0 and the version.
  bool is_of_next_codec(std::span<const unsigned char> source) const {
    return is_of_attributes() && !source.empty() && source[0] == 0xA1;
  }

  void apply_filter(Bytes& decoded) const {
    if (filter_ == "OCTAHEDRAL")
      meshopt_decodeFilterOct(decoded.data(), count_, stride_);
    else if (filter_ == "QUATERNION")
      meshopt_decodeFilterQuat(decoded.data(), count_, stride_);
    else if (filter_ == "EXPONENTIAL")
      meshopt_decodeFilterExp(decoded.data(), count_, stride_);
  }

  const Document& document_;
  const Json& json_;
  std::string where_;
  std::string mode_, filter_;
  std::uint64_t stride_, count_;
};

} // namespace

void decode_meshopt(Document& document) {
  for (std::size_t k = 0; k < count_of(document.root, "bufferViews"); ++k) {
    auto& view = document.root["bufferViews"][k];
    for (const std::string_view extension :
         {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      if (!find(view, {"extensions", extension}) ||
          !document.buffers[*index_at(view, "buffer")].empty())
        continue;
      auto decoded = CompressedView(document, k, extension).decode();
      view["byteLength"] = decoded.size();
      view["byteOffset"] = 0;
      view["buffer"] = add_buffer(document, std::move(decoded));
      break;
    }
  }
}

} // namespace meninas::gltf
