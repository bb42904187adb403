#include "tests/scenes/gltf/gltf_file.h"

#include <stdlib.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

namespace meninas::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  auto name = (fs::temp_directory_path() / "meninas-gltf-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw std::runtime_error("cannot make " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const std::string& name, const Bytes& bytes) const {
  const auto file = path_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return file;
}

fs::path TemporaryFolder::write(const std::string& name, std::string_view text) const {
  return write(name, Bytes(text.begin(), text.end()));
}

template <>
constexpr int component_type<std::int8_t>() {
  return 5120;
}
template <>
constexpr int component_type<std::uint8_t>() {
  return 5121;
}
template <>
constexpr int component_type<std::int16_t>() {
  return 5122;
}
template <>
constexpr int component_type<std::uint16_t>() {
  return 5123;
}
template <>
constexpr int component_type<std::uint32_t>() {
  return 5125;
}
template <>
constexpr int component_type<float>() {
  return 5126;
}

static std::size_t push(Json& array, Json value) {
  array.push_back(std::move(value));
  return array.size() - 1;
}

std::size_t GltfFile::add_view(const Bytes& bytes) {
  while (data.size() % 4 != 0)
    data.push_back(0);
  const auto offset = data.size();
  data.insert(data.end(), bytes.begin(), bytes.end());
  return push(json["bufferViews"],
              {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

template <typename T>
std::size_t GltfFile::add_accessor(const std::vector<T>& values, const std::string& type) {
  const auto width = type == "SCALAR" ? 1u : static_cast<unsigned>(type.back() - '0');
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  const auto view = add_view(bytes);
  return push(json["accessors"], {{"bufferView", view},
                                  {"componentType", component_type<T>()},
                                  {"count", values.size() / width},
                                  {"type", type}});
}
template std::size_t GltfFile::add_accessor(const std::vector<std::int8_t>&, const std::string&);
template std::size_t GltfFile::add_accessor(const std::vector<std::uint8_t>&, const std::string&);
template std::size_t GltfFile::add_accessor(const std::vector<std::int16_t>&, const std::string&);
template std::size_t GltfFile::add_accessor(const std::vector<std::uint16_t>&, const std::string&);
template std::size_t GltfFile::add_accessor(const std::vector<std::uint32_t>&, const std::string&);
template std::size_t GltfFile::add_accessor(const std::vector<float>&, const std::string&);

std::size_t GltfFile::add_mesh(Json primitives) {
  return push(json["meshes"], {{"primitives", std::move(primitives)}});
}
std::size_t GltfFile::add_node(Json node) { return push(json["nodes"], std::move(node)); }
std::size_t GltfFile::add_material(Json material) {
  return push(json["materials"], std::move(material));
}

GltfFile square() {
  GltfFile file;
  const auto positions = file.add_accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  const auto indices = file.add_accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  const auto grey =
      file.add_material({{"name", "grey"},
                         {"pbrMetallicRoughness",
                          {{"baseColorFactor", {0.5, 0.5, 0.5, 1.0}}, {"metallicFactor", 0.0}}}});
  const auto mesh = file.add_mesh(Json::array(
      {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", grey}}}));
  file.add_node({{"name", "Quad"}, {"mesh", mesh}});
  return file;
}

Json& square_primitive(GltfFile& file) { return file.json["meshes"][0]["primitives"][0]; }

std::string data_uri(const Bytes& bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:application/octet-stream;base64,";
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto left = std::min<std::size_t>(3, bytes.size() - k);
    unsigned group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (b < left ? bytes[k + b] : 0u);
    for (std::size_t d = 0; d < 4; ++d)
      text += d <= left ? digits[group >> (18 - 6 * d) & 63] : '=';
  }
  return text;
}

std::string as_text(const GltfFile& file) {
  auto json = file.json;
  if (!json.contains("buffers") && !file.data.empty())
    json["buffers"] =
        Json::array({{{"byteLength", file.data.size()}, {"uri", data_uri(file.data)}}});
  return json.dump();
}

static void append(Bytes& bytes, std::uint32_t number) {
  for (int k = 0; k < 4; ++k)
    bytes.push_back(static_cast<unsigned char>(number >> (8 * k)));
}

Bytes as_glb(const GltfFile& file) {
  auto json = file.json;
  if (!json.contains("buffers"))
    json["buffers"] = Json::array({{{"byteLength", file.data.size()}}});
  // The data is in the binary chunk; it need not be in the text as well.
  if (auto& first = json["buffers"][0]; first.value("uri", "") == data_uri(file.data))
    first.erase("uri");
  auto text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  auto data = file.data;
  data.resize((data.size() + 3) / 4 * 4);
  Bytes glb;
  append(glb, 0x46546C67);
  append(glb, 2);
  append(glb, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + data.size()));
  append(glb, static_cast<std::uint32_t>(text.size()));
  append(glb, 0x4E4F534A);
  glb.insert(glb.end(), text.begin(), text.end());
  append(glb, static_cast<std::uint32_t>(data.size()));
  append(glb, 0x004E4942);
  glb.insert(glb.end(), data.begin(), data.end());
  return glb;
}

Scene load(const GltfFile& file, const GltfSettings& settings) {
  const TemporaryFolder folder;
  return load_gltf(folder.write("scene.gltf", as_text(file)), settings);
}

std::string error_of(const fs::path& file, const GltfSettings& settings) {
  try {
    load_gltf(file, settings);
  } catch (const UserError& error) {
    std::string line = error.what();
    const auto folder = file.parent_path().string() + "/";
    return line.starts_with(folder) ? line.substr(folder.size()) : line;
  }
  return "no error";
}

std::string error_of(const GltfFile& file, const GltfSettings& settings) {
  const TemporaryFolder folder;
  return error_of(folder.write("scene.gltf", as_text(file)), settings);
}

bool warns(const Scene& scene, std::initializer_list<std::string_view> parts) {
  for (const auto& warning : scene.warnings) {
    bool all = true;
    for (const auto part : parts)
      all = all && warning.find(part) != std::string::npos;
    if (all)
      return true;
  }
  return false;
}

Vec3 normal(const Scene& scene, std::size_t triangle) {
  const auto& corners = scene.triangles[triangle].vertices;
  const auto& a = position(scene, corners[0]);
  return glm::cross(position(scene, corners[1]) - a, position(scene, corners[2]) - a);
}

} // namespace meninas::test
