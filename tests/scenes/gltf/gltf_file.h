// Small glTF files written by hand for tests:
// JSON and bytes put together, saved in a folder of their own, loaded.
#pragma once

#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace meninas::test {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

/// A new folder that goes away with everything in it.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const Bytes& bytes) const;
  std::filesystem::path write(const std::string& name, std::string_view text) const;

private:
  std::filesystem::path path_;
};

/// A file in the making. One buffer holds all data; `json` may be edited freely before it is saved.
struct GltfFile {
  Json json{{"asset", {{"version", "2.0"}}}};
  Bytes data;

  std::size_t add_view(const Bytes& bytes);
  template <typename T>
  std::size_t add_accessor(const std::vector<T>& values, const std::string& type);
  std::size_t add_mesh(Json primitives);
  std::size_t add_node(Json node);
  std::size_t add_material(Json material);
};

/// One node `Quad` with the unit square in the plane z = 0, front towards +z, one material `grey`.
GltfFile square();

/// The primitive of the square: accessors 0 (POSITION, 4 vertices) and 1 (indices, two triangles).
Json& square_primitive(GltfFile& file);

std::string as_text(const GltfFile& file); ///< with the data in a data URI
Bytes as_glb(const GltfFile& file);
std::string data_uri(const Bytes& bytes);

Scene load(const GltfFile& file, const GltfSettings& settings = {});

/// The line of the UserError that loading ends with, without the folder;
/// `no error` when it does not.
std::string error_of(const GltfFile& file, const GltfSettings& settings = {});
std::string error_of(const std::filesystem::path& file, const GltfSettings& settings = {});

/// True when some warning contains all of these.
bool warns(const Scene& scene, std::initializer_list<std::string_view> parts);

/// Normal (not unit) of triangle k.
Vec3 normal(const Scene& scene, std::size_t triangle);
/// Component type code of glTF.
template <typename T>
constexpr int component_type();

} // namespace meninas::test
