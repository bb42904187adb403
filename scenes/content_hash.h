// A hash of values, for telling whether things are what they were: not for keeping secrets.
//
// XXH3 of 64 bits (Collet 2019), of each value seeded by the hash of those before;
// their order counts, and so does the division of bytes into texts.
#pragma once

#include "scenes/types.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace meninas {

class ContentHash {
public:
  void add(std::uint64_t word);
  void add(double x); ///< -0.0 is the same number as 0.0
  void add(const Vec2& x);
  void add(const Vec3& x);
  void add(std::span<const std::byte> bytes); ///< with their number
  void add(std::string_view text);
  std::uint64_t value() const { return state_; }

private:
  std::uint64_t state_ = 0;
};

/// XXH3 of the bytes: any changed byte changes it, but for one chance in 2^64.
std::uint64_t hash_of_bytes(std::span<const std::byte> bytes);

/// The hash of a file's bytes. Throws InputError where there is none.
std::uint64_t hash_of_file(const std::filesystem::path& file);

/// Sixteen hexadecimal digits.
std::string hex_digits(std::uint64_t hash);

} // namespace meninas
