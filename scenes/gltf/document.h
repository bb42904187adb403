// A glTF file as checked JSON and its buffers: what all stages of the loader read.
//
// tinygltf is trusted with bytes (files, data URIs) only.
// Structure is read from JSON whose types and indices were checked against a table first,
// because tinygltf 2.7 follows indices, offsets and types of the file unchecked.
#pragma once

#include "scenes/errors.h"
#include "scenes/gltf/settings.h"
#include "scenes/scene.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meninas::gltf {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

/// The two parts of a file: JSON text, and the binary chunk of a .glb.
struct Container {
  Json root;
  std::optional<Bytes> binary;
};

struct Document {
  std::string file; ///< as the user named it
  std::filesystem::path folder;
  GltfSettings settings;
  Json root;
  std::vector<Bytes> buffers; ///< empty for a buffer that only an extension could fill
  std::uint64_t buffer_bytes = 0; ///< of all buffers together
  /// The distance between neighbouring values of accessors whose floats were quantised.
  std::map<std::size_t, double> steps = {};
};

/// Splits a .glb or takes a .gltf, and parses the JSON, unless that would take more
/// memory than the limit. Nothing inside is checked but that it says it is glTF 2.
Container parse_container(const std::string& file, Bytes bytes, std::uint64_t memory_limit);

/// Throws InputError unless every property the loader reads has its type,
/// and every index points into its array.
void check_structure(const std::string& file, const Json& root);

/// Splits and checks the bytes of a file and loads its buffers.
Document read_document(Bytes bytes, const std::filesystem::path& file,
                       const GltfSettings& settings);

/// Bytes of a file, data URI or buffer view, or why there are none.
struct Resource {
  Bytes bytes;
  std::string problem;
  ExitCode kind =
      ExitCode::bad_input; ///< of the problem: more than memory may hold is failed_output
};
Resource read_whole_file(const std::filesystem::path& file, std::uint64_t size_limit);
Resource read_uri(const std::string& uri, const std::filesystem::path& folder,
                  const GltfSettings& settings);
std::vector<Bytes> load_buffers(const Document& document, std::optional<Bytes> binary);

// --- Data that is only there compressed, made plain, so that nothing after it knows of compression

/// Buffer views of EXT_meshopt_compression and KHR_meshopt_compression whose own buffer is empty.
void decode_meshopt(Document& document);
/// Primitives of KHR_draco_mesh_compression whose positions are in no buffer.
void decode_draco(Document& document);

/// Adds a buffer with these bytes and returns its index.
std::size_t add_buffer(Document& document, Bytes bytes);
/// The limit less what the buffers hold, in bytes.
std::uint64_t memory_left(const Document& document);

// --- JSON that check_structure has passed

const Json* find(const Json& object, std::string_view key);
/// Walks down nested objects; null where one is absent.
const Json* find(const Json& object, std::initializer_list<std::string_view> path);
std::uint64_t size_value(const Json& value);
std::uint64_t size_or(const Json& object, std::string_view key, std::uint64_t otherwise);
std::optional<std::size_t> index_at(const Json& object, std::string_view key);
double number_or(const Json& object, std::string_view key, double otherwise);
std::string text_or(const Json& object, std::string_view key, const std::string& otherwise);
/// The numbers of an array of that name; empty when absent.
std::vector<double> numbers_at(const Json& object, std::string_view key);
Vec3 vec3_or(const Json& object, std::string_view key, const Vec3& otherwise);

std::size_t count_of(const Json& root, std::string_view array);
const Json& element(const Json& root, std::string_view array, std::size_t index);

/// Text of the file made fit for a message: control characters become spaces.
std::string one_line(std::string text);

/// Adds the names of the extensions in use anywhere below, declared or not, but for what is in extras.
void collect_extensions(const Json& json, std::set<std::string>& names);
/// As much of it as a line has room for, cut between characters of UTF-8.
std::string excerpt(std::string_view text);
std::string name_of(const Json& object);
/// `nodes[5] 'Lamp'`, or `nodes[5]` for the unnamed.
std::string place(const Json& root, std::string_view array, std::size_t index);

// --- Warnings, gathered so that a thousand materials make one line

class Findings {
public:
  /// One line per text, followed by the names it was said about.
  void about(const std::string& text, const std::string& name);
  void say(const std::string& text);
  std::vector<std::string> lines() const;

private:
  struct Finding {
    std::string text;
    std::vector<std::string> first_names;
    std::set<std::string> names;
  };
  std::vector<Finding> findings_;
};

/// `'A', 'B' and 3 more`
std::string name_list(std::span<const std::string> names, std::size_t total);

} // namespace meninas::gltf
