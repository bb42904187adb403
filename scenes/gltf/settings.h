// Which scene of a file is read, and what the file may ask for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace meninas {

/// Which files a glTF file may name:
/// a stranger's file must not make the program read the user's others.
enum class ExternalFiles { inside_folder, anywhere };

struct GltfSettings {
  /// Name or index of the scene in the file; the file's default otherwise.
  std::optional<std::string> scene = std::nullopt;
  ExternalFiles external_files = ExternalFiles::inside_folder;
  /// Bytes; files and geometry that need more are refused before they are read or decoded.
  std::uint64_t memory_limit = std::uint64_t{1} << 32;
};

} // namespace meninas
