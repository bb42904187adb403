#include "radiosity/transport/factor_file.h"

#include "image/whole_file.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/names.h"
#include "scenes/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <type_traits>

namespace meninas {
namespace {

static_assert(std::endian::native == std::endian::little, "factor files are little-endian");

constexpr std::uint64_t magic = 0x3130'4146'4e45'4dULL,      // "MENFA01"
    part_magic = 0x3130'5046'4e45'4dULL; // "MENFP01"

template <typename Item>
void append(std::vector<std::byte>& bytes,
            const Item& item) requires std::is_trivially_copyable_v<Item> {
  const auto raw = std::as_bytes(std::span(&item, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <typename Item>
void append(std::vector<std::byte>& bytes, const std::vector<Item>& items) {
  append(bytes, std::uint64_t{items.size()});
  const auto raw = std::as_bytes(std::span(items));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void append(std::vector<std::byte>& bytes, const Transport& transport) {
  append(bytes, std::uint64_t{transport.size});
  append(bytes, static_cast<std::uint64_t>(transport.bands));
  append(bytes, transport.row_begin);
  append(bytes, transport.columns);
  append(bytes, transport.weights);
}

void append(std::vector<std::byte>& bytes, const FormFactors& factors) {
  append(bytes, factors.transport);
  append(bytes, factors.beyond);
  append(bytes, factors.closure);
  append(bytes, factors.covered);
  append(bytes, factors.exposed);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(file.string(), "", what);
}

/// Takes items off the front of a file; what is not there is damage.
struct Reader {
  const std::filesystem::path& file;
  std::span<const std::byte> rest;

  template <typename Item>
  void take(Item& item) {
    if (rest.size() < sizeof(Item)) {
      refuse(file, "damaged: it ends too early");
    }
    std::memcpy(&item, rest.data(), sizeof(Item));
    rest = rest.subspan(sizeof(Item));
  }
  template <typename Item>
  void take(std::vector<Item>& items) {
    std::uint64_t count = 0;
    take(count);
    if (count > rest.size() / sizeof(Item)) {
      refuse(file, "damaged: it does not hold the data it announces");
    }
    items.resize(count);
    if (count > 0) {
      std::memcpy(items.data(), rest.data(), count * sizeof(Item));
    }
    rest = rest.subspan(count * sizeof(Item));
  }
  void take(Transport& transport) {
    std::uint64_t size = 0, bands = 0;
    take(size);
    take(bands);
    transport.size = size;
    transport.bands = static_cast<int>(std::min<std::uint64_t>(bands, 4));
    take(transport.row_begin);
    take(transport.columns);
    take(transport.weights);
  }
  void take(FormFactors& factors) {
    take(factors.transport);
    take(factors.beyond);
    take(factors.closure);
    take(factors.covered);
    take(factors.exposed);
  }
};

std::vector<std::byte> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0 || std::filesystem::is_directory(file)) {
    refuse(file, "cannot be read");
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), size)) {
    refuse(file, "cannot be read");
  }
  return bytes;
}

/// Rows in order, columns that exist, weights that can be form factors.
bool makes_sense(const Transport& transport, std::size_t elements) {
  const auto& begin = transport.row_begin;
  const auto fits = [&](std::uint32_t column) { return column < elements; };
  const auto possible = [](float weight) { return std::isfinite(weight) && weight >= 0.0F; };
  return (transport.bands == 1 || transport.bands == 3) && !begin.empty() && begin.size() - 1 == transport.size &&
         begin.front() == 0 && std::ranges::is_sorted(begin) &&
         begin.back() == transport.columns.size() &&
         transport.weights.size() ==
             transport.columns.size() * static_cast<std::size_t>(transport.bands) &&
         std::ranges::all_of(transport.columns, fits) &&
         std::ranges::all_of(transport.weights, possible);
}

bool is_finite(const RowClosure& row) {
  const glm::vec3 light = row.mirror_absorbed + row.escaped_light + row.black_light + row.cut_light + row.sky +
                          row.owned_light + row.by_portals;
  return std::isfinite(row.landed + row.escaped + row.black + row.cut + light.r + light.g + light.b);
}

void check_sense(const std::filesystem::path& file, const FormFactors& factors,
                 std::size_t elements) {
  const std::size_t size = factors.transport.size;
  const bool sound = makes_sense(factors.transport, elements) &&
                     makes_sense(factors.beyond, elements) &&
                     factors.beyond.size == size && factors.closure.size() == size &&
                     factors.covered.size() == size && factors.exposed.size() == size &&
                     std::ranges::all_of(factors.closure, is_finite) &&
                     std::ranges::all_of(factors.exposed, [](float share) { return std::isfinite(share) && share >= 0.0F; });
  if (!sound) {
    refuse(file, "damaged: its form factors make no sense");
  }
}

void check_key(const std::filesystem::path& file, const FactorKey& found, const FactorKey& key) {
  const auto check = [&](std::uint64_t a, std::uint64_t b, const char* what) {
    if (a != b) {
      refuse(file, fmt::format("cannot be reused: {} since it was written", what));
    }
  };
  check(found.geometry, key.geometry, "the geometry has changed");
  check(found.mirrors, key.mirrors, "the mirrors or how far they are followed have changed");
  check(found.mesh, key.mesh,
        "the elements (size, number, or which surfaces have any) have changed");
  check(found.sky, key.sky, "the sky has changed");
  check(found.sampling, key.sampling, "the settings of the form factors have changed");
}

std::vector<std::byte> header_bytes(std::uint64_t kind, const FactorKey& key) {
  std::vector<std::byte> bytes(sizeof(kind));
  std::memcpy(bytes.data(), &kind, sizeof(kind));
  const std::string version(program_version());
  append(bytes, std::vector<char>(version.begin(), version.end()));
  append(bytes, key);
  return bytes;
}

/// The content after the header of a file of that kind, undamaged and made from `key`.
Reader checked(const std::filesystem::path& file, std::span<const std::byte> bytes,
               std::uint64_t kind, const FactorKey& key) {
  Reader reader{file, bytes};
  std::uint64_t word = 0;
  if (bytes.size() >= 2 * sizeof(word)) {
    reader.take(word);
  }
  if (word != kind) {
    refuse(file, "not a factor file written by 'meninas solve --factors'");
  }
  std::vector<char> version;
  reader.take(version);
  if (std::string(version.begin(), version.end()) != program_version()) {
    refuse(file,
           fmt::format("was written by another version than {}: solve again", program_version()));
  }

  // The hash comes first: nothing damaged is looked at any closer.
  std::uint64_t announced = 0;
  const auto hashed = bytes.first(bytes.size() - sizeof(announced));
  std::memcpy(&announced, hashed.data() + hashed.size(), sizeof(announced));
  if (hash_of_bytes(hashed) != announced) {
    refuse(file, "damaged: its data do not have the hash it announces");
  }
  FactorKey found;
  reader.take(found);
  check_key(file, found, key);
  return reader;
}

} // namespace

void write_factors(const std::filesystem::path& file, const FormFactors& factors,
                   const FactorKey& key) {
  std::vector<std::byte> bytes = header_bytes(magic, key);
  append(bytes, factors);
  append(bytes, hash_of_bytes(bytes));
  write_whole_file(file, bytes);
}

FormFactors read_factors(const std::filesystem::path& file, const FactorKey& key, std::size_t elements) {
  const std::vector<std::byte> bytes = bytes_of(file);
  Reader reader = checked(file, bytes, magic, key);
  FormFactors factors;
  reader.take(factors);
  check_sense(file, factors, elements);
  if (factors.transport.size != elements)
    refuse(file, "damaged: it has other rows than there are elements");
  return factors;
}

std::filesystem::path part_file(const std::filesystem::path& folder, const FactorPart& part) {
  return folder / fmt::format("rows-{}-of-{}.factors", part.number + 1, part.count);
}

void write_factor_part(const std::filesystem::path& folder, const FormFactors& rows,
                       const FactorPart& part, const FactorKey& key) {
  std::vector<std::byte> bytes = header_bytes(part_magic, key);
  append(bytes, part);
  append(bytes, rows);
  append(bytes, hash_of_bytes(bytes));
  write_whole_file(part_file(folder, part), bytes);
}

/// As many as a command line may ask for.
constexpr std::uint64_t max_parts = 1'000'000;

/// Into how many parts rows are divided, by the names of the files.
static std::uint64_t division_of(const std::filesystem::path& folder) {
  std::map<std::uint64_t, std::filesystem::path> divisions;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    unsigned long long number = 0, count = 0;
    const std::string name = entry.path().filename().string();
    if (std::sscanf(name.c_str(), "rows-%llu-of-%llu.factors", &number, &count) == 2 &&
        number > 0 && number <= count && count <= max_parts && entry.path() == part_file(folder, {number - 1, count}))
      divisions.emplace(count, part_file(folder, {0, count}));
  }
  if (divisions.empty())
    refuse(folder, "holds no rows written by 'meninas solve --factors DIR --shard K/N'");
  if (divisions.size() > 1)
    refuse(divisions.rbegin()->second,
           fmt::format("is of another division than {}: one of them has to go",
                       divisions.begin()->second.string()));
  return divisions.begin()->first;
}

static void check_parts_are_there(const std::filesystem::path& folder, std::uint64_t count) {
  std::vector<std::string> missing;
  for (std::uint64_t k = 0; k < count; ++k)
    if (!std::filesystem::exists(part_file(folder, {k, count})))
      missing.push_back(part_file({}, {k, count}).string());
  if (!missing.empty())
    refuse(folder, "rows are missing: " + quoted_names(missing));
}

static FormFactors read_part(const std::filesystem::path& folder, const FactorPart& wanted,
                             const FactorKey& key) {
  const std::filesystem::path file = part_file(folder, wanted);
  const std::vector<std::byte> bytes = bytes_of(file);
  Reader reader = checked(file, bytes, part_magic, key);
  FactorPart part;
  FormFactors rows;
  reader.take(part);
  reader.take(rows);
  if (part.number != wanted.number || part.count != wanted.count ||
      part.elements != wanted.elements)
    refuse(file, fmt::format("is not what its name says, but part {}/{}", part.number + 1, part.count));
  check_sense(file, rows, part.elements);
  if (rows.transport.size != rows_of_part(part.elements, part.number, part.count).count)
    refuse(file, "damaged: it has other rows than its part");
  return rows;
}

static void append_rows(Transport& all, const Transport& rows) {
  const std::uint64_t before = all.columns.size();
  for (std::size_t row = 0; row < rows.size; ++row)
    all.row_begin.push_back(before + rows.row_begin[row + 1]);
  all.columns.insert(all.columns.end(), rows.columns.begin(), rows.columns.end());
  all.weights.insert(all.weights.end(), rows.weights.begin(), rows.weights.end());
  all.size += rows.size;
  all.bands = rows.bands;
}

FormFactors join_factor_parts(const std::filesystem::path& folder, const FactorKey& key,
                              std::size_t elements) {
  const std::uint64_t count = division_of(folder);
  check_parts_are_there(folder, count);
  FormFactors all;
  all.transport.row_begin = all.beyond.row_begin = {0};
  for (std::uint64_t k = 0; k < count; ++k) {
    const FactorPart part{k, count, elements};
    const FormFactors rows = read_part(folder, part, key);
    if (k > 0 && (rows.transport.bands != all.transport.bands || rows.beyond.bands != all.beyond.bands))
      refuse(part_file(folder, part), "damaged: it has other bands of colour than the parts before it");
    append_rows(all.transport, rows.transport);
    append_rows(all.beyond, rows.beyond);
    all.closure.insert(all.closure.end(), rows.closure.begin(), rows.closure.end());
    all.covered.insert(all.covered.end(), rows.covered.begin(), rows.covered.end());
    all.exposed.insert(all.exposed.end(), rows.exposed.begin(), rows.exposed.end());
  }
  return all;
}

} // namespace meninas
