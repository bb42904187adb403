// Bytes that a glTF file names: files beside it and data URIs. (The only user of tinygltf.)
#include "scenes/gltf/document.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <system_error>

namespace meninas::gltf {

namespace fs = std::filesystem;

static std::string megabytes(std::uint64_t bytes) { return fmt::format("{} MiB", bytes >> 20); }

/// What stands in a checkout where `git lfs` has not fetched the content.
static bool is_lfs_pointer(const Bytes& bytes) {
  constexpr std::string_view start = "version https://git-lfs.github.com/spec/";
  return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

Resource read_whole_file(const fs::path& file, std::uint64_t size_limit) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found)
    return {{}, "no such file"};
  if (fs::is_directory(status))
    return {{}, "not a file but a folder"};
  if (error)
    return {{}, fmt::format("cannot be read: {}", error.message())};
  // A pipe or device would keep us waiting for ever.
  if (!fs::is_regular_file(status))
    return {{}, "not a regular file"};

  const auto size = fs::file_size(file, error);
  if (error)
    return {{}, fmt::format("cannot be read: {}", error.message())};
  if (size > size_limit)
    return {
        {},
        fmt::format("has {}, over the memory limit of {}", megabytes(size), megabytes(size_limit)),
        ExitCode::failed_output};
  if (size == 0)
    return {};

  Resource resource;
  std::string problem;
  if (!tinygltf::ReadWholeFile(&resource.bytes, &problem, file.string(), nullptr))
    return {{}, "cannot be read"};
  if (is_lfs_pointer(resource.bytes))
    return {{}, "is a Git LFS pointer, not the data: run git lfs pull"};
  return resource;
}

static Resource decode_data_uri(const std::string& uri) {
  const std::string_view marker = ";base64,";
  const auto at = uri.find(marker);
  const auto comma = uri.find(',');
  if (at == std::string::npos || comma != at + marker.size() - 1)
    return {{}, "the data URI is not base64"};
  const auto payload = std::string_view(uri).substr(comma + 1);
  const auto last = payload.find_last_not_of('=');
  const auto digits = payload.substr(0, last == std::string_view::npos ? 0 : last + 1);
  const auto is_digit = [](unsigned char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '/';
  };
  if (!std::ranges::all_of(digits, is_digit) || digits.size() % 4 == 1 ||
      payload.size() - digits.size() > 2)
    return {{}, "the data URI is not valid base64"};
  if (digits.empty())
    return {};

  // tinygltf knows a handful of media types; which one is announced does not matter here.
  Resource resource;
  std::string media_type;
  const auto known = fmt::format("data:application/octet-stream;base64,{}", payload);
  if (!tinygltf::DecodeDataURI(&resource.bytes, media_type, known, 0, false))
    return {{}, "the data URI cannot be decoded"};
  return resource;
}

static std::optional<std::string> percent_decoded(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9')
      return c - '0';
    if (c >= 'a' && c <= 'f')
      return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
      return c - 'A' + 10;
    return -1;
  };
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    auto c = uri[k];
    // An escape that is none is taken as it stands: exporters also write bare percent signs.
    if (c == '%' && k + 2 < uri.size() && digit(uri[k + 1]) >= 0 && digit(uri[k + 2]) >= 0) {
      c = static_cast<char>(16 * digit(uri[k + 1]) + digit(uri[k + 2]));
      k += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20)
      return std::nullopt;
    path += c;
  }
  return path;
}

static bool has_scheme(const std::string& uri) {
  const auto colon = uri.find(':');
  return colon != std::string::npos && colon < uri.find('/');
}

static bool is_inside(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const auto root = fs::weakly_canonical(folder, error);
  if (error)
    return false;
  const auto target = fs::weakly_canonical(path, error);
  if (error)
    return false;
  return std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first == root.end();
}

/// Exporters also write names with bare percent signs, and backslashes;
/// the spelling that is there is meant.
static fs::path existing_spelling(const fs::path& folder, const std::string& uri,
                                  const std::string& decoded) {
  auto slashes = decoded;
  std::ranges::replace(slashes, '\\', '/');
  for (const auto& spelling : {decoded, slashes, uri}) {
    std::error_code error;
    if (fs::exists(folder / spelling, error))
      return spelling;
  }
  return decoded;
}

Resource read_uri(const std::string& uri, const fs::path& folder, const GltfSettings& settings) {
  if (uri.starts_with("data:"))
    return decode_data_uri(uri);
  const auto shown = excerpt(uri);
  // Exporters also make file names of names with colons.
  std::error_code error;
  if (has_scheme(uri) && !fs::exists(folder / uri, error))
    return {{}, fmt::format("'{}' is not a file beside the glTF file", shown)};
  const auto path = percent_decoded(uri);
  if (!path || path->empty())
    return {{}, fmt::format("'{}' is not a file name", shown)};

  const auto target = folder / existing_spelling(folder, uri, *path);
  if (settings.external_files == ExternalFiles::inside_folder && !is_inside(target, folder))
    return {{}, fmt::format("'{}' is outside the folder of the glTF file", shown)};
  auto resource = read_whole_file(target, settings.memory_limit);
  if (!resource.problem.empty())
    resource.problem = fmt::format("'{}': {}", shown, resource.problem);
  return resource;
}

/// A buffer for readers that cannot decode its compressed twin.
static bool is_fallback(const Json& buffer) {
  return std::ranges::any_of(
      std::array{"EXT_meshopt_compression", "KHR_meshopt_compression"}, [&](const char* extension) {
        const auto* marked = find(buffer, {"extensions", extension, "fallback"});
        return marked && marked->get<bool>();
      });
}

std::vector<Bytes> load_buffers(const Document& document, std::optional<Bytes> binary) {
  std::vector<Bytes> buffers;
  std::uint64_t total = 0;
  for (std::size_t k = 0; k < count_of(document.root, "buffers"); ++k) {
    const auto where = place(document.root, "buffers", k);
    const auto& buffer = element(document.root, "buffers", k);
    const auto* uri = find(buffer, "uri");
    Resource resource;
    if (uri)
      resource = read_uri(uri->get<std::string>(), document.folder, document.settings);
    else if (k == 0 && binary)
      resource.bytes = std::move(*binary);
    if (!resource.problem.empty() && is_fallback(buffer))
      resource = {};
    if (!resource.problem.empty())
      throw UserError(resource.kind, document.file, where, resource.problem);

    const auto announced = size_or(buffer, "byteLength", 0);
    const bool has_data = !resource.bytes.empty() || (uri && !is_fallback(buffer));
    if (has_data && resource.bytes.size() < announced)
      throw InputError(document.file, where,
                       fmt::format("truncated: byteLength is {}, its data has {} bytes", announced,
                                   resource.bytes.size()));
    total += resource.bytes.size();
    if (total > document.settings.memory_limit)
      throw OutputError(
          document.file, where,
          fmt::format("the buffers need more than {}", megabytes(document.settings.memory_limit)));
    buffers.push_back(std::move(resource.bytes));
  }
  return buffers;
}

} // namespace meninas::gltf
