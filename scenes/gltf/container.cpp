// .glb chunks and JSON text, from bytes that may be anything.
#include "scenes/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas::gltf {

// Deeper nesting has no use in glTF; it would let a small file exhaust the stack.
static constexpr int deepest_nesting = 200;

static constexpr std::uint32_t glb_magic = 0x46546C67; // "glTF"
static constexpr std::uint32_t json_chunk = 0x4E4F534A;
static constexpr std::uint32_t binary_chunk = 0x004E4942;

static std::uint32_t little_endian(std::span<const unsigned char> bytes, std::size_t at) {
  return bytes[at] | (bytes[at + 1] << 8) | (bytes[at + 2] << 16) |
         (static_cast<std::uint32_t>(bytes[at + 3]) << 24);
}

static std::string line_and_column(std::span<const unsigned char> text, std::size_t byte) {
  const auto before = text.first(std::min(byte == 0 ? 0 : byte - 1, text.size()));
  const auto line = 1 + std::ranges::count(before, '\n');
  const auto last_break = std::find(before.rbegin(), before.rend(), '\n');
  return fmt::format("line {}, column {}", line, 1 + (last_break - before.rbegin()));
}

namespace {

/// What a text will be once it is parsed.
struct Survey {
  int nesting = 0;    ///< the most brackets that are open at once; those in strings are text
  double bytes = 0.0; ///< of the parsed values, about, beside the text
};

} // namespace

static Survey survey_of(std::span<const unsigned char> text) {
  // A value in a list; a list, an object or a string by itself;
  // a member of an object with its key. Strings also keep their text.
  constexpr double per_value = 2 * sizeof(Json), per_block = 64.0, per_member = 128.0;
  Survey survey;
  int depth = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const unsigned char c = text[k];
    if (in_string && c == '\\')
      ++k;
    else if (c == '"') {
      in_string = !in_string;
      survey.bytes += 0.5 * per_block;
    } else if (in_string)
      survey.bytes += 1.0;
    else if (c == '{' || c == '[') {
      survey.nesting = std::max(survey.nesting, ++depth);
      survey.bytes += per_block;
    } else if (c == '}' || c == ']')
      --depth;
    else if (c == ',')
      survey.bytes += per_value;
    else if (c == ':')
      survey.bytes += per_member;
  }
  return survey;
}

static Json parse_json(const std::string& file, std::span<const unsigned char> text,
                       std::uint64_t memory_limit) {
  // Beforehand: with a callback the parser takes a time that is quadratic in the length of lists.
  const Survey survey = survey_of(text);
  if (survey.nesting > deepest_nesting)
    throw InputError(file, "JSON",
                     fmt::format("is nested more than {} levels deep", deepest_nesting));
  if (survey.bytes > static_cast<double>(memory_limit))
    throw OutputError(file, "JSON",
                      fmt::format("needs about {:.0f} MiB, the memory limit is {} MiB",
                                  survey.bytes / (1 << 20), memory_limit >> 20));
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    throw InputError(file, line_and_column(text, error.byte), "the JSON text is not valid here");
  } catch (const Json::out_of_range&) {
    throw InputError(file, "JSON", "a number is too large for a double");
  }
}

static std::string looks_like(std::span<const unsigned char> bytes) {
  const auto begins = [&](std::initializer_list<int> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  };
  if (begins({0x89, 'P', 'N', 'G'}))
    return "it is a PNG image";
  if (begins({0xFF, 0xD8, 0xFF}))
    return "it is a JPEG image";
  if (begins({0x76, 0x2F, 0x31, 0x01}))
    return "it is an OpenEXR image";
  if (begins({0xFF, 0xFE}) || begins({0xFE, 0xFF}))
    return "it is text in UTF-16; save it as UTF-8";
  if (begins({'P', 'K', 3, 4}))
    return "it is a ZIP archive";
  if (begins({'B', 'L', 'E', 'N', 'D', 'E', 'R'}))
    return "it is a Blender file; export it as glTF first";
  return "it begins with neither '{' nor 'glTF'";
}

static void check_asset(const std::string& file, const Json& root) {
  const auto* asset = root.is_object() ? find(root, "asset") : nullptr;
  const auto* version = asset && asset->is_object() ? find(*asset, "version") : nullptr;
  if (!version || !version->is_string())
    throw InputError(file, "asset", "not a glTF file: it is JSON without an asset.version");
  if (!version->get_ref<const std::string&>().starts_with("2."))
    throw InputError(file, "asset",
                     fmt::format("glTF version '{}' is not read, only 2.x",
                                 one_line(version->get<std::string>())));
  const auto* minimum = find(*asset, "minVersion");
  if (minimum && *minimum != "2.0")
    throw InputError(file, "asset",
                     "the file asks for a reader of a newer glTF than 2.0 (minVersion)");
}

static Container split_glb(const std::string& file, std::span<const unsigned char> bytes,
                           std::uint64_t memory_limit) {
  if (bytes.size() < 12)
    throw InputError(file, "GLB header", fmt::format("truncated: {} of 12 bytes", bytes.size()));
  const auto version = little_endian(bytes, 4);
  if (version != 2)
    throw InputError(file, "GLB header", fmt::format("version {} is not read, only 2", version));
  const std::size_t length = little_endian(bytes, 8);
  if (length > bytes.size())
    throw InputError(
        file, "GLB header",
        fmt::format("truncated: it announces {} bytes, the file has {}", length, bytes.size()));
  if (length < bytes.size())
    throw InputError(file, "GLB header",
                     fmt::format("it announces {} bytes, the file has {}", length, bytes.size()));

  std::optional<Json> root;
  std::optional<Bytes> binary;
  std::size_t at = 12;
  for (int chunk = 0; at < length; ++chunk) {
    const auto where = fmt::format("GLB chunk {}", chunk);
    if (length - at < 8)
      throw InputError(file, where, fmt::format("truncated: {} of 8 header bytes", length - at));
    const std::size_t size = little_endian(bytes, at);
    const auto type = little_endian(bytes, at + 4);
    at += 8;
    if (size > length - at)
      throw InputError(
          file, where,
          fmt::format("truncated: it announces {} bytes, {} are left", size, length - at));
    if (chunk == 0 && type != json_chunk)
      throw InputError(file, where, "the first chunk is not JSON");
    const auto content = bytes.subspan(at, size);
    if (chunk == 0)
      root = parse_json(file, content, memory_limit);
    if (type == binary_chunk && !binary)
      binary = Bytes(content.begin(), content.end());
    at += size;
  }
  if (!root)
    throw InputError(file, "GLB", "has no JSON chunk");
  return {std::move(*root), std::move(binary)};
}

Container parse_container(const std::string& file, Bytes bytes, std::uint64_t memory_limit) {
  if (bytes.empty())
    throw InputError(file, "", "not a glTF file: it is empty");
  Container container;
  if (bytes.size() >= 4 && little_endian(bytes, 0) == glb_magic) {
    container = split_glb(file, bytes, memory_limit);
  } else {
    std::span<const unsigned char> text = bytes;
    if (text.size() >= 3 && text[0] == 0xEF && text[1] == 0xBB && text[2] == 0xBF)
      text = text.subspan(3);
    const auto is_blank = [](unsigned char c) {
      return c == ' ' || c == '\t' || c == '\r' || c == '\n';
    };
    const auto first = std::ranges::find_if_not(text, is_blank);
    if (first == text.end() || *first != '{')
      throw InputError(file, "", fmt::format("not a glTF file: {}", looks_like(bytes)));
    container.root = parse_json(file, text, memory_limit);
  }
  check_asset(file, container.root);
  return container;
}

} // namespace meninas::gltf
