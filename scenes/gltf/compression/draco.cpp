// Primitives of KHR_draco_mesh_compression, decoded. (The only user of Draco.)
//
// A few bytes can ask Draco for gigabytes. Its own decoders are used by way of two of their
// overrides, which compute from the headers what is about to be taken and stop before it is.
#include "scenes/gltf/accessors.h"
#include "scenes/gltf/geometry/primitives.h"

#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <new>
#include <stdexcept>

namespace meninas::gltf {

static constexpr std::string_view extension_name = "KHR_draco_mesh_compression";

namespace {

/// What the decoder is about to take, in bytes, and may take.
struct Allowance {
  double limit = 0.0;
  double needed = 0.0;

  bool allows(double bytes) {
    needed = std::max(needed, bytes);
    return needed <= limit;
  }
};

/// Numbers of faces and the like that stand before the connectivity.
class HeaderReader {
public:
  HeaderReader(const draco::DecoderBuffer& buffer, int first_minor_of_varints)
      : ahead_(buffer),
        has_varints_(buffer.bitstream_version() >=
                     DRACO_BITSTREAM_VERSION(2, first_minor_of_varints)) {}

  /// 0 where the bytes end: the decoder then finds that itself.
  std::uint32_t number() {
    std::uint32_t value = 0;
    if (has_varints_)
      draco::DecodeVarint(&value, &ahead_);
    else
      ahead_.Decode(&value);
    return value;
  }
  std::uint8_t byte() {
    std::uint8_t value = 0;
    ahead_.Decode(&value);
    return value;
  }

private:
  draco::DecoderBuffer ahead_; // a copy: the decoder's own stays where it is
  bool has_varints_;
};

/// Bytes of the tables of corners, vertices and faces.
double connectivity_bytes(const draco::MeshSequentialDecoder&, const draco::DecoderBuffer& buffer) {
  constexpr double per_face = 6 * sizeof(std::uint32_t);
  return per_face * HeaderReader(buffer, 2).number();
}

double connectivity_bytes(const draco::MeshEdgebreakerDecoder&,
                          const draco::DecoderBuffer& buffer) {
  // By face: six corners and opposites, faces, points, three vertices at most, symbols;
  // of each kind of seams three corners and as many vertices of three numbers.
  constexpr double per_face = 32 * sizeof(std::uint32_t), per_seamed = 16 * sizeof(std::uint32_t);
  HeaderReader header(buffer, 0);
  if (buffer.bitstream_version() < DRACO_BITSTREAM_VERSION(2, 2))
    header.number(); // vertices that splits add
  header.number();   // vertices
  const double faces = header.number();
  return faces * (per_face + per_seamed * header.byte());
}

/// Values, the integers that they are predicted as, and the map from points to them.
double attribute_bytes(const draco::PointCloud& mesh) {
  double per_point = sizeof(std::uint32_t);
  for (int k = 0; k < mesh.num_attributes(); ++k)
    per_point += static_cast<double>(mesh.attribute(k)->byte_stride()) +
                 sizeof(std::int32_t) * mesh.attribute(k)->num_components() +
                 2 * sizeof(std::uint32_t);
  return per_point * mesh.num_points();
}

template <typename Decoder>
class BoundedDecoder : public Decoder {
public:
  explicit BoundedDecoder(Allowance& allowance) : allowance_(allowance) {}

private:
  bool DecodeGeometryData() override {
    return allowance_.allows(connectivity_bytes(*this, *this->buffer())) &&
           Decoder::DecodeGeometryData();
  }
  bool DecodeAllAttributes() override {
    return allowance_.allows(attribute_bytes(*this->point_cloud())) &&
           Decoder::DecodeAllAttributes();
  }

  Allowance& allowance_;
};

/// One compressed view, decoded, and the accessors that were made of it,
/// which all primitives that name the view share.
class DecodedView {
public:
  DecodedView(Document& document, std::size_t view, std::string where)
      : document_(document), where_(std::move(where)) {
    const auto bytes = view_bytes(document, view);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Allowance allowance{.limit = static_cast<double>(memory_left(document))};
    try {
      const auto status = decode(buffer, allowance);
      if (allowance.needed > allowance.limit)
        throw OutputError(document.file, where_,
                          fmt::format("decoding {} needs about {:.0f} MiB, more than the memory "
                                      "limit leaves",
                                      extension_name, allowance.needed / (1 << 20)));
      if (!status.ok())
        fail(status.code() == draco::Status::UNKNOWN_VERSION
                 ? "is of a version of Draco that is not read"
                 : "the data is truncated or corrupt");
    } catch (const std::bad_alloc&) {
      throw OutputError(document.file, where_,
                        fmt::format("decoding {} needs more memory than there is", extension_name));
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(document_.file, where_, fmt::format("{}: {}", extension_name, what));
  }

  /// The accessor of three indices for each face.
  std::size_t indices() {
    if (indices_)
      return *indices_;
    Bytes bytes = new_bytes(mesh_.num_faces(), sizeof(draco::Mesh::Face));
    for (std::uint32_t k = 0; k < mesh_.num_faces(); ++k)
      std::memcpy(bytes.data() + k * sizeof(draco::Mesh::Face),
                  mesh_.face(draco::FaceIndex(k)).data(), sizeof(draco::Mesh::Face));
    indices_ = add_accessor({{"componentType", 5125}, {"type", "SCALAR"}}, 3 * mesh_.num_faces(),
                            std::move(bytes));
    return *indices_;
  }

  /// The accessor that holds attribute `id` as the file's accessor describes it.
  std::size_t attribute(std::uint64_t id, std::size_t described) {
    const auto [found, is_new] = attributes_.try_emplace({id, described});
    if (is_new)
      found->second = add_attribute(id, described);
    return found->second;
  }

private:
  template <typename Decoder>
  draco::Status decode_by(draco::DecoderBuffer& buffer, Allowance& allowance) {
    auto decoder = std::make_unique<BoundedDecoder<Decoder>>(allowance);
    const auto status = decoder->Decode(draco::DecoderOptions(), &buffer, &mesh_);
    decoder_ = std::move(decoder);
    return status;
  }

  draco::Status decode(draco::DecoderBuffer& buffer, Allowance& allowance) {
    draco::DecoderBuffer ahead(buffer);
    draco::DracoHeader header;
    const auto status = draco::PointCloudDecoder::DecodeHeader(&ahead, &header);
    if (!status.ok())
      return status;
    if (header.encoder_type != draco::TRIANGULAR_MESH)
      fail("holds points without triangles");
    return header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING
               ? decode_by<draco::MeshSequentialDecoder>(buffer, allowance)
               : decode_by<draco::MeshEdgebreakerDecoder>(buffer, allowance);
  }

  Bytes new_bytes(std::uint64_t count, std::uint64_t size) const {
    if (count > memory_left(document_) / size)
      throw OutputError(
          document_.file, where_,
          fmt::format("{}: {} elements of {} bytes are over the memory limit", extension_name,
                      count, size));
    return Bytes(count * size);
  }

  std::size_t add_accessor(Json accessor, std::uint64_t count, Bytes bytes) {
    const auto size = bytes.size();
    const auto buffer = add_buffer(document_, std::move(bytes));
    auto& views = document_.root["bufferViews"];
    views.push_back({{"buffer", buffer}, {"byteLength", size}});
    accessor["bufferView"] = views.size() - 1;
    accessor["count"] = count;
    document_.root["accessors"].push_back(std::move(accessor));
    return document_.root["accessors"].size() - 1;
  }

  std::size_t add_attribute(std::uint64_t id, std::size_t described) {
    static constexpr std::string_view types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const int at = id <= 0xFFFFFFFF
                       ? mesh_.GetAttributeIdByUniqueId(static_cast<std::uint32_t>(id))
                       : -1;
    if (at < 0)
      fail(fmt::format("has no attribute {}", id));
    const auto& attribute = *mesh_.attribute(at);
    const auto width = attribute.num_components();
    if (width == 0 || width > std::size(types))
      fail(fmt::format("attribute {} has {} components", id, width));

    Json accessor = element(document_.root, "accessors", described);
    accessor.erase("byteOffset");
    accessor.erase("sparse");
    accessor["type"] = types[width - 1];
    const auto type = size_or(accessor, "componentType", 0);
    Bytes values;
    if (!convert(attribute, type, values))
      fail(fmt::format("attribute {} cannot be read as componentType {}", id, type));
    const auto made = add_accessor(std::move(accessor), mesh_.num_points(), std::move(values));
    if (const double step = step_of(at); type == 5126 && step > 0.0)
      document_.steps[made] = step;
    return made;
  }

  bool convert(const draco::PointAttribute& attribute, std::uint64_t type, Bytes& values) const {
    switch (type) {
    case 5120:
      return convert_to<std::int8_t>(attribute, values);
    case 5121:
      return convert_to<std::uint8_t>(attribute, values);
    case 5122:
      return convert_to<std::int16_t>(attribute, values);
    case 5123:
      return convert_to<std::uint16_t>(attribute, values);
    case 5125:
      return convert_to<std::uint32_t>(attribute, values);
    case 5126:
      return convert_to<float>(attribute, values);
    default:
      return false;
    }
  }

  /// Draco converts nothing where its type is T; false where a number does not fit.
  template <typename T>
  bool convert_to(const draco::PointAttribute& attribute, Bytes& values) const {
    const std::uint32_t points = mesh_.num_points();
    const auto width = attribute.num_components();
    const auto stored = attribute.buffer()->data_size() / static_cast<std::size_t>(attribute.byte_stride());
    const bool has_map = attribute.is_mapping_identity() || attribute.indices_map_size() >= points;
    if (!has_map || attribute.data_type() == draco::DT_BOOL)
      return false;
    values = new_bytes(points, width * sizeof(T));
    std::array<T, 4> value{};
    for (std::uint32_t k = 0; k < points; ++k) {
      const auto at = attribute.mapped_index(draco::PointIndex(k));
      if (at.value() >= stored ||
          !attribute.ConvertValue<T>(at, static_cast<std::int8_t>(width), value.data()))
        return false;
      std::memcpy(values.data() + k * width * sizeof(T), value.data(), width * sizeof(T));
    }
    return true;
  }

  /// The distance between neighbouring values of what was quantised; 0 otherwise.
  double step_of(int attribute) const {
    const auto* integers = decoder_->GetPortableAttribute(attribute);
    if (!integers || !integers->GetAttributeTransformData())
      return 0.0;
    double step = 0.0;
    draco::AttributeQuantizationTransform of_values;
    draco::AttributeOctahedronTransform of_normals; // by two numbers from -1 to 1
    if (of_values.InitFromAttribute(*integers))
      step = of_values.range() / (std::exp2(of_values.quantization_bits()) - 1.0);
    else if (of_normals.InitFromAttribute(*integers))
      step = 2.0 / (std::exp2(of_normals.quantization_bits()) - 1.0);
    return std::isfinite(step) ? step : 0.0;
  }

  Document& document_;
  std::string where_;
  draco::Mesh mesh_;
  std::unique_ptr<draco::MeshDecoder> decoder_;
  std::optional<std::size_t> indices_;
  std::map<std::pair<std::uint64_t, std::size_t>, std::size_t> attributes_;
};

struct Primitive {
  std::size_t mesh = 0;
  std::size_t number = 0;
};

} // namespace

/// Whose vertices are nowhere else, by compressed view. Points and lines are not shown.
static std::map<std::size_t, std::vector<Primitive>> compressed_primitives(const Json& root) {
  std::map<std::size_t, std::vector<Primitive>> found;
  for (std::size_t m = 0; m < count_of(root, "meshes"); ++m) {
    const auto& primitives = element(root, "meshes", m)["primitives"];
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const auto* extension = find(primitives[k], {"extensions", extension_name});
      const auto position = index_at(primitives[k]["attributes"], "POSITION");
      const auto mode = static_cast<Mode>(size_or(primitives[k], "mode", 4));
      if (extension && position && mode >= Mode::triangles && mode <= Mode::fan &&
          !element(root, "accessors", *position).contains("bufferView"))
        found[*index_at(*extension, "bufferView")].push_back({m, k});
    }
  }
  return found;
}

/// Whether an attribute of that name is of use to this program.
static bool is_read(std::string_view name) {
  return name == "POSITION" || name == "NORMAL" || name == "TANGENT" ||
         std::ranges::any_of(std::array{"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"},
                             [&](const char* set) { return name.starts_with(set); });
}

void decode_draco(Document& document) {
  for (const auto& [view, primitives] : compressed_primitives(document.root)) {
    DecodedView decoded(
        document, view,
        primitive_place(document.root, primitives.front().mesh, primitives.front().number));
    for (const auto& at : primitives) {
      auto& json = document.root["meshes"][at.mesh]["primitives"][at.number];
      const auto& ids = (*find(json, {"extensions", extension_name}))["attributes"];
      if (!ids.contains("POSITION"))
        decoded.fail("has no POSITION");
      auto& attributes = json["attributes"];
      for (const auto& [name, id] : ids.items()) {
        const auto described = index_at(attributes, name);
        if (described && is_read(name))
          attributes[name] = decoded.attribute(size_value(id), *described);
        else
          attributes.erase(name);
      }
      json["indices"] = decoded.indices();
      json["mode"] = Mode::triangles;
    }
  }
}

} // namespace meninas::gltf
