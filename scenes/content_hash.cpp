#include "scenes/content_hash.h"

#include "scenes/errors.h"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <fstream>
#include <iterator>

namespace meninas {

void ContentHash::add(std::uint64_t word) {
  state_ = XXH3_64bits_withSeed(&word, sizeof(word), state_);
}

void ContentHash::add(double x) {
  // Adding zero turns -0.0 into 0.0.
  add(std::bit_cast<std::uint64_t>(x + 0.0));
}

void ContentHash::add(const Vec2& x) {
  add(x.x);
  add(x.y);
}

void ContentHash::add(const Vec3& x) {
  add(x.x);
  add(x.y);
  add(x.z);
}

void ContentHash::add(std::span<const std::byte> bytes) {
  add(std::uint64_t{bytes.size()});
  state_ = XXH3_64bits_withSeed(bytes.data(), bytes.size(), state_);
}

void ContentHash::add(std::string_view text) { add(std::as_bytes(std::span(text))); }

std::uint64_t hash_of_bytes(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t hash_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(file.string(), "", "no such file");
  std::ifstream stream(file, std::ios::binary);
  ContentHash hash;
  hash.add(std::string(std::istreambuf_iterator<char>(stream), {}));
  return hash.value();
}

std::string hex_digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace meninas
