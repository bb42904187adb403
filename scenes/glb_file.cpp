#include "scenes/glb_file.h"

#include "scenes/errors.h"
#include "scenes/gltf/document.h"

#include <cstring>
#include <string>

namespace meninas {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67;    // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;   // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942; // "BIN"
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

void append_word(std::vector<std::byte>& bytes, std::size_t word) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::byte>(word >> shift & 0xFF));
  }
}

void append_chunk(std::vector<std::byte>& bytes, std::uint32_t type,
                  std::span<const std::byte> content, std::byte padding) {
  append_word(bytes, padded(content.size()));
  append_word(bytes, type);
  bytes.insert(bytes.end(), content.begin(), content.end());
  bytes.insert(bytes.end(), padded(content.size()) - content.size(), padding);
}

} // namespace

std::vector<std::byte> glb_bytes(const nlohmann::json& root, std::span<const std::byte> binary,
                                 const std::filesystem::path& file) {
  const std::string text = root.dump();
  const std::size_t size =
      header_size + 2 * chunk_header_size + padded(text.size()) + padded(binary.size());
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw OutputError(file.string(), "", "cannot write: a GLB holds no more than 4 GiB");
  }
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  append_word(bytes, glb_magic);
  append_word(bytes, 2);
  append_word(bytes, size);
  append_chunk(bytes, json_chunk, std::as_bytes(std::span(text)), std::byte{' '});
  append_chunk(bytes, binary_chunk, binary, std::byte{0});
  return bytes;
}

GlbContent read_glb(const std::filesystem::path& file, std::uint64_t size_limit) {
  gltf::Resource resource = gltf::read_whole_file(file, size_limit);
  if (!resource.problem.empty()) {
    throw UserError(resource.kind, file.string(), "", resource.problem);
  }
  const bool is_glb =
      resource.bytes.size() >= 4 && std::memcmp(resource.bytes.data(), "glTF", 4) == 0;
  if (!is_glb) {
    throw InputError(file.string(), "", "not a GLB file");
  }
  gltf::Container container =
      gltf::parse_container(file.string(), std::move(resource.bytes), size_limit);
  return {std::move(container.root), std::move(container.binary).value_or(gltf::Bytes{})};
}

} // namespace meninas
