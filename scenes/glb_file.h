// GLB containers: JSON and one binary chunk in one file, as glTF 2.0 lays them out.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace meninas {

/// The bytes of the file: header, JSON chunk padded with blanks, binary chunk padded with zeros.
/// Throws OutputError when they exceed the 4 GiB a GLB can hold; `file` is for that message.
std::vector<std::byte> glb_bytes(const nlohmann::json& root, std::span<const std::byte> binary,
                                 const std::filesystem::path& file);

struct GlbContent {
  nlohmann::json root;
  std::vector<unsigned char> binary; ///< with up to three bytes of padding at its end
};

/// Throws InputError unless the file is a whole GLB with the JSON of a glTF 2.0 asset.
GlbContent read_glb(const std::filesystem::path& file,
                    std::uint64_t size_limit = std::uint64_t{1} << 32);

} // namespace meninas
