#include "scenes/content_hash.h"

#include "scenes/errors.h"

#include <fmt/format.h>

#include <bit>
#include <fstream>
#include <iterator>

namespace meninas {

void ContentHash::add(std::uint64_t word) {
  // Multiplying spreads low bits upwards, the shifts bring high bits down again.
  state_ = (state_ ^ word) * 0xbf58476d1ce4e5b9ULL;
  state_ ^= state_ >> 29;
  state_ *= 0x94d049bb133111ebULL;
  state_ ^= state_ >> 32;
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
  std::uint64_t packed = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    packed = packed << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    if (i % 8 == 7 || i + 1 == bytes.size()) {
      add(packed);
      packed = 0;
    }
  }
}

void ContentHash::add(std::string_view text) { add(std::as_bytes(std::span(text))); }

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
