// Files that appear whole or not at all.
//
// The bytes go to a new file of a temporary name in the same folder,
// which is renamed when all of them are there.
// A reader sees the old file or the new one, never a part;
// after a failure only the old one is left.
// Throws OutputError with the reason: no such folder, no permission, the disk is full, ...
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace meninas {

/// The new file has the permissions of any newly created file.
/// A symbolic link stays and its target is replaced.
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// Throws what `write_whole_file` would throw before the first byte; leaves nothing behind.
void check_writable_file(const std::filesystem::path& file);

} // namespace meninas
