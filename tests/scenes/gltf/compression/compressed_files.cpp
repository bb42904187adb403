#include "tests/scenes/gltf/compression/compressed_files.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace meninas::test {

static std::size_t component_size(const Json& accessor) {
  const int type = accessor["componentType"];
  return type < 5122 ? 1 : type < 5125 ? 2 : 4;
}

static std::size_t width(const Json& accessor) {
  const std::string type = accessor["type"];
  return type == "SCALAR" ? 1u : static_cast<std::size_t>(type.back() - '0');
}

static std::vector<std::uint32_t> sheet_triangles(std::uint32_t n) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const auto at = y * (n + 1) + x;
      for (const auto corner : {at, at + 1, at + n + 1, at + 1, at + n + 2, at + n + 1})
        triangles.push_back(corner);
    }
  return triangles;
}

GltfFile bumpy_sheet(std::uint32_t n) {
  std::vector<float> positions, normals, texcoords;
  std::vector<std::uint8_t> colors;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) {
      const double u = 1.0 * x / n, v = 1.0 * y / n;
      const double height = 0.2 * std::sin(5.0 * u) * std::cos(3.0 * v);
      const double du = std::cos(5.0 * u) * std::cos(3.0 * v);
      const double dv = -0.6 * std::sin(5.0 * u) * std::sin(3.0 * v);
      const double length = std::sqrt(1.0 + du * du + dv * dv);
      for (const double value : {u, v, height})
        positions.push_back(static_cast<float>(value));
      for (const double value : {-du / length, -dv / length, 1.0 / length})
        normals.push_back(static_cast<float>(value));
      for (const double value : {3.0 * u, v * v})
        texcoords.push_back(static_cast<float>(value));
      for (const double value : {255.0 * u, 255.0 * v, 100.0, 255.0})
        colors.push_back(static_cast<std::uint8_t>(value));
    }
  auto file = square();
  auto& primitive = square_primitive(file);
  primitive["attributes"] = {{"POSITION", file.add_accessor(positions, "VEC3")},
                             {"NORMAL", file.add_accessor(normals, "VEC3")},
                             {"TEXCOORD_0", file.add_accessor(texcoords, "VEC2")},
                             {"COLOR_0", file.add_accessor(colors, "VEC4")}};
  file.json["accessors"].back()["normalized"] = true;
  primitive["indices"] = file.add_accessor(sheet_triangles(n), "SCALAR");
  return file;
}

GltfFile quantised_sheet(std::uint32_t n) {
  auto file = bumpy_sheet(n);
  auto& attributes = square_primitive(file)["attributes"];
  const auto bytes = accessor_bytes(file, attributes["POSITION"]);
  std::vector<std::int16_t> integers(bytes.size() / sizeof(float));
  for (std::size_t k = 0; k < integers.size(); ++k) {
    float value;
    std::memcpy(&value, bytes.data() + k * sizeof value, sizeof value);
    integers[k] = static_cast<std::int16_t>(std::lround(32767.0 * value));
  }
  attributes["POSITION"] = file.add_accessor(integers, "VEC3");
  file.json["accessors"].back()["normalized"] = true;
  file.json["nodes"][0]["scale"] = {4.0, 4.0, 4.0};
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return file;
}

Bytes accessor_bytes(const GltfFile& file, std::size_t accessor) {
  const auto& json = file.json["accessors"][accessor];
  const auto& view = file.json["bufferViews"][json["bufferView"].get<std::size_t>()];
  const auto size = component_size(json) * width(json);
  const auto stride = view.value("byteStride", size);
  Bytes bytes;
  for (std::size_t k = 0; k < json["count"]; ++k) {
    const auto at = file.data.begin() + view["byteOffset"].get<std::ptrdiff_t>() +
                    static_cast<std::ptrdiff_t>(k * stride);
    bytes.insert(bytes.end(), at, at + static_cast<std::ptrdiff_t>(size));
  }
  return bytes;
}

static std::vector<std::uint32_t> accessor_indices(const GltfFile& file, std::size_t accessor) {
  const auto bytes = accessor_bytes(file, accessor);
  const auto size = component_size(file.json["accessors"][accessor]);
  std::vector<std::uint32_t> indices(bytes.size() / size);
  for (std::size_t k = 0; k < indices.size(); ++k)
    std::memcpy(&indices[k], bytes.data() + k * size, size);
  return indices;
}

std::vector<Corners> triangle_corners(const Scene& scene) {
  std::vector<Corners> triangles;
  for (const auto& triangle : scene.triangles) {
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& vertex = scene.vertices[index(triangle.vertices[c])];
      const auto& [texcoord, color] = attributes_of(scene, vertex);
      corners[c] = {vertex.position.x, vertex.position.y, vertex.position.z,
                    texcoord[0].x,     texcoord[0].y,     color.r,
                    color.g,           color.b,           color.a};
    }
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    triangles.push_back(corners);
  }
  std::ranges::sort(triangles);
  return triangles;
}

Bytes encode_vertices(const void* data, std::size_t count, std::size_t stride) {
  Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, count, stride));
  return bytes;
}

Bytes encode_triangles(const std::vector<std::uint32_t>& indices) {
  Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), 1 << 16));
  bytes.resize(
      meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

Bytes encode_sequence(const std::vector<std::uint32_t>& indices) {
  Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), 1 << 16));
  bytes.resize(
      meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

namespace {

/// A view in the making: its bytes, and how its extension describes them.
struct Compressed {
  Bytes bytes;
  Json description;
};

} // namespace

static Compressed compress_indices(const GltfFile& plain, std::size_t accessor, bool of_triangles) {
  const auto indices = accessor_indices(plain, accessor);
  return {of_triangles ? encode_triangles(indices) : encode_sequence(indices),
          {{"byteStride", component_size(plain.json["accessors"][accessor])},
           {"count", indices.size()},
           {"mode", of_triangles ? "TRIANGLES" : "INDICES"}}};
}

/// Elements are padded to whole words, as the codec asks for.
static Compressed compress_vertices(const GltfFile& plain, std::size_t accessor) {
  const auto bytes = accessor_bytes(plain, accessor);
  const std::size_t count = plain.json["accessors"][accessor]["count"];
  const auto size = bytes.size() / count;
  const auto stride = (size + 3) / 4 * 4;
  Bytes padded(count * stride);
  for (std::size_t k = 0; k < count; ++k)
    std::memcpy(padded.data() + k * stride, bytes.data() + k * size, size);
  return {encode_vertices(padded.data(), count, stride),
          {{"byteStride", stride}, {"count", count}, {"mode", "ATTRIBUTES"}}};
}

GltfFile with_meshopt(const GltfFile& plain, const std::string& name) {
  GltfFile file{plain.json, {}};
  std::size_t decoded = 0;
  const auto replace = [&](std::size_t accessor, const Compressed& by) {
    auto& view = file.json["bufferViews"][file.json["accessors"][accessor]["bufferView"]
                                              .get<std::size_t>()];
    auto description = by.description;
    const std::size_t stride = description["byteStride"];
    const auto size = stride * description["count"].get<std::size_t>();
    description["buffer"] = 0;
    description["byteOffset"] = file.data.size();
    description["byteLength"] = by.bytes.size();
    file.data.insert(file.data.end(), by.bytes.begin(), by.bytes.end());
    view = {{"buffer", 1}, {"byteOffset", decoded}, {"byteLength", size}};
    if (description["mode"] == "ATTRIBUTES")
      view["byteStride"] = stride;
    view["extensions"][name] = description;
    decoded += size;
  };
  for (const auto& mesh : plain.json["meshes"])
    for (const auto& primitive : mesh["primitives"]) {
      for (const auto& accessor : primitive["attributes"])
        replace(accessor, compress_vertices(plain, accessor));
      if (primitive.contains("indices"))
        replace(primitive["indices"], compress_indices(plain, primitive["indices"],
                                                       primitive.value("mode", 4) == 4));
    }
  file.json["buffers"] = Json::array(
      {{{"byteLength", file.data.size()}, {"uri", data_uri(file.data)}},
       {{"byteLength", decoded}, {"extensions", {{name, {{"fallback", true}}}}}}});
  file.json["extensionsUsed"].push_back(name);
  file.json["extensionsRequired"].push_back(name);
  return file;
}

static draco::DataType draco_type(int component_type) {
  switch (component_type) {
  case 5120:
    return draco::DT_INT8;
  case 5121:
    return draco::DT_UINT8;
  case 5122:
    return draco::DT_INT16;
  case 5123:
    return draco::DT_UINT16;
  default:
    return draco::DT_FLOAT32;
  }
}

static draco::GeometryAttribute::Type draco_kind(const std::string& name) {
  if (name == "POSITION")
    return draco::GeometryAttribute::POSITION;
  if (name == "NORMAL")
    return draco::GeometryAttribute::NORMAL;
  if (name.starts_with("TEXCOORD"))
    return draco::GeometryAttribute::TEX_COORD;
  return name.starts_with("COLOR") ? draco::GeometryAttribute::COLOR
                                   : draco::GeometryAttribute::GENERIC;
}

static void add_attribute(draco::Mesh& mesh, const GltfFile& plain, const std::string& name,
                          std::size_t accessor) {
  const auto& json = plain.json["accessors"][accessor];
  const auto bytes = accessor_bytes(plain, accessor);
  const auto size = component_size(json) * width(json);
  draco::GeometryAttribute described;
  described.Init(draco_kind(name), nullptr, static_cast<std::uint8_t>(width(json)),
                 draco_type(json["componentType"]), json.value("normalized", false),
                 static_cast<std::int64_t>(size), 0);
  auto& attribute = *mesh.attribute(mesh.AddAttribute(described, true, mesh.num_points()));
  for (std::uint32_t k = 0; k < mesh.num_points(); ++k)
    attribute.SetAttributeValue(draco::AttributeValueIndex(k), bytes.data() + k * size);
}

Bytes encode_draco(const GltfFile& plain, const Json& primitive, const DracoChoice& choice) {
  draco::Mesh mesh;
  const std::size_t position = primitive["attributes"]["POSITION"];
  mesh.set_num_points(plain.json["accessors"][position]["count"]);
  const auto corners = accessor_indices(plain, primitive["indices"]);
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
    mesh.AddFace({draco::PointIndex(corners[k]), draco::PointIndex(corners[k + 1]),
                  draco::PointIndex(corners[k + 2])});
  for (const auto& [name, accessor] : primitive["attributes"].items())
    add_attribute(mesh, plain, name, accessor);

  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(choice.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                               : draco::MESH_SEQUENTIAL_ENCODING);
  for (int k = 0; k < mesh.num_attributes(); ++k) {
    const auto kind = mesh.attribute(k)->attribute_type();
    if (kind == draco::GeometryAttribute::POSITION && choice.position_bits > 0)
      encoder.SetAttributeQuantization(k, choice.position_bits);
    if (kind == draco::GeometryAttribute::NORMAL && choice.normal_bits > 0)
      encoder.SetAttributeQuantization(k, choice.normal_bits);
  }
  draco::EncoderBuffer buffer;
  if (const auto status = encoder.EncodeToBuffer(&buffer); !status.ok())
    throw std::runtime_error(status.error_msg_string());
  return {buffer.data(), buffer.data() + buffer.size()};
}

GltfFile with_draco(const GltfFile& plain, const DracoChoice& choice) {
  GltfFile file{plain.json, {}};
  file.json["bufferViews"] = Json::array();
  for (auto& mesh : file.json["meshes"])
    for (auto& primitive : mesh["primitives"]) {
      const auto view = file.add_view(encode_draco(plain, primitive, choice));
      Json ids = Json::object();
      for (const auto& [name, accessor] : primitive["attributes"].items()) {
        ids[name] = ids.size();
        file.json["accessors"][accessor.get<std::size_t>()].erase("bufferView");
      }
      file.json["accessors"][primitive["indices"].get<std::size_t>()].erase("bufferView");
      primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                               {"attributes", ids}};
    }
  // What no primitive uses would point into views that are gone.
  for (auto& accessor : file.json["accessors"])
    accessor.erase("bufferView");
  file.json["extensionsUsed"].push_back("KHR_draco_mesh_compression");
  file.json["extensionsRequired"].push_back("KHR_draco_mesh_compression");
  return file;
}

} // namespace meninas::test
