// KHR_draco_mesh_compression: what the library's encoder packed comes out as it went in,
// or as near as it was told to keep it.
#include "scenes/gltf/accessors.h"
#include "tests/scenes/gltf/compression/compressed_files.h"
#include "tests/scenes/gltf/gltf_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace meninas::test {

using testing::HasSubstr;

static Json& extension_of(GltfFile& file) {
  return square_primitive(file)["extensions"]["KHR_draco_mesh_compression"];
}

static gltf::Document read(const GltfFile& file) {
  const auto text = as_text(file);
  return gltf::read_document({text.begin(), text.end()}, "scene.gltf", {});
}

static std::size_t accessor_of(const gltf::Document& document, const std::string& attribute) {
  return document.root["meshes"][0]["primitives"][0]["attributes"][attribute];
}

TEST(Draco, LosslessDataComesOutToTheBit) {
  const auto plain = bumpy_sheet();
  const auto expected = triangle_corners(load(plain));
  ASSERT_EQ(expected.size(), 2u * 9 * 9);
  for (const bool edgebreaker : {false, true}) {
    const auto file = with_draco(plain, {.edgebreaker = edgebreaker});
    const auto scene = load(file);
    EXPECT_EQ(triangle_corners(scene), expected) << edgebreaker;
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_TRUE(scene.ignored.empty()) << scene.ignored[0];
    const TemporaryFolder folder;
    EXPECT_EQ(triangle_corners(load_gltf(folder.write("scene.glb", as_glb(file)))), expected);
  }
}

TEST(Draco, RequiredOrNotTheDataIsNowhereElse) {
  const auto expected = triangle_corners(load(bumpy_sheet()));
  auto file = with_draco(bumpy_sheet());
  file.json.erase("extensionsRequired");
  EXPECT_EQ(triangle_corners(load(file)), expected);
  file.json.erase("extensionsUsed");
  EXPECT_EQ(triangle_corners(load(file)), expected);
}

TEST(Draco, QuantisedPositionsAreOffByHalfAStep) {
  constexpr int bits = 11;
  const auto plain = bumpy_sheet();
  // Sequential coding keeps the order of vertices, so that they can be compared one by one.
  const auto document = read(with_draco(plain, {.position_bits = bits, .edgebreaker = false}));
  const auto accessor = accessor_of(document, "POSITION");
  const double step = gltf::step_of_values(document, accessor);
  EXPECT_FLOAT_EQ(static_cast<float>(step), 1.0F / ((1 << bits) - 1)) << "the sheet is 1 wide";
  const auto decoded = gltf::decode_vectors(document, accessor, 3);
  const auto before = read(plain);
  const auto original = gltf::decode_vectors(before, accessor_of(before, "POSITION"), 3);
  ASSERT_EQ(decoded.values.size(), original.values.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < decoded.values.size(); ++k)
    largest = std::max(largest, std::abs(decoded.values[k] - original.values[k]));
  EXPECT_LE(largest, 0.5 * step + 1e-7) << "and the rounding of floats";
  EXPECT_GT(largest, 0.25 * step) << "it is quantised";
  EXPECT_EQ(gltf::step_of_values(document, accessor_of(document, "TEXCOORD_0")), 0.0);
  EXPECT_EQ(gltf::step_of_values(before, accessor_of(before, "POSITION")), 0.0);
}

TEST(Draco, NormalsAreUnitVectors) {
  const auto plain = bumpy_sheet();
  const auto document = read(with_draco(plain, {.normal_bits = 10, .edgebreaker = false}));
  const auto decoded = gltf::decode_vectors(document, accessor_of(document, "NORMAL"), 3);
  const auto before = read(plain);
  const auto original = gltf::decode_vectors(before, accessor_of(before, "NORMAL"), 3);
  // A step of the octahedron's square is 2 / 2^10, which it stretches by up to sqrt(3).
  for (std::size_t k = 0; k < decoded.values.size(); ++k)
    EXPECT_NEAR(decoded.values[k], original.values[k], 4.0 / 1024) << k;
}

// A mirror that leans, of which quantisation makes many facets: they are made flat again, as those
// of integer positions are.
TEST(Draco, LeaningPlanesStayPlanes) {
  auto plain = bumpy_sheet();
  const auto position = square_primitive(plain)["attributes"]["POSITION"].get<std::size_t>();
  const auto view = plain.json["accessors"][position]["bufferView"].get<std::size_t>();
  const auto offset = plain.json["bufferViews"][view]["byteOffset"].get<std::size_t>();
  for (std::size_t k = 0; k < 100; ++k) {
    float xyz[3];
    std::memcpy(xyz, plain.data.data() + offset + 12 * k, sizeof xyz);
    xyz[2] = 0.3F * xyz[0] + 0.21F * xyz[1];
    std::memcpy(plain.data.data() + offset + 12 * k, xyz, sizeof xyz);
  }
  // Half a step is a thousandth of the width: more than is taken for noise of itself.
  const auto scene = load(with_draco(plain, {.position_bits = 9}));
  EXPECT_TRUE(warns(scene, {"flat but for rounding are made flat: 1"}));
  const Vec3 first = glm::normalize(normal(scene, 0));
  for (std::size_t k = 1; k < scene.triangles.size(); ++k)
    EXPECT_NEAR(glm::distance(glm::normalize(normal(scene, k)), first), 0.0, 1e-5) << k;
}

TEST(Draco, IntegerPositionsAreThoseOfThePlainFile) {
  const auto plain = quantised_sheet();
  for (const bool edgebreaker : {false, true}) {
    const auto file = with_draco(plain, {.edgebreaker = edgebreaker});
    EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(plain)));
    const auto document = read(file), before = read(plain);
    EXPECT_EQ(gltf::step_of_values(document, accessor_of(document, "POSITION")),
              gltf::step_of_values(before, accessor_of(before, "POSITION")));
  }
}

TEST(Draco, TypesAreConvertedToThoseOfTheAccessors) {
  auto file = with_draco(bumpy_sheet(), {.edgebreaker = false});
  const auto color = square_primitive(file)["attributes"]["COLOR_0"].get<std::size_t>();
  file.json["accessors"][color]["componentType"] = 5123;
  file.json["accessors"][color].erase("normalized");
  const auto wide = read(file);
  const auto& accessor = wide.root["accessors"][accessor_of(wide, "COLOR_0")];
  EXPECT_EQ(accessor["componentType"], 5123);
  EXPECT_EQ(accessor["type"], "VEC4");
  const auto codes = gltf::decode_vectors(wide, accessor_of(wide, "COLOR_0"), 4);
  EXPECT_EQ(codes.values[2], 100.0);
  EXPECT_EQ(codes.values[3], 255.0);

  file.json["accessors"][color]["componentType"] = 5120;
  EXPECT_THAT(error_of(file), HasSubstr("meshes[0], primitive 0: KHR_draco_mesh_compression: "
                                        "attribute 0 cannot be read as componentType 5120"))
      << "255 does not fit";
  file.json["accessors"][color]["componentType"] = 5124;
  EXPECT_THAT(error_of(file), HasSubstr("cannot be read as componentType 5124"));
}

TEST(Draco, JointsAndWeightsFollowThePlainFile) {
  auto plain = skinned_square();
  EXPECT_EQ(triangle_corners(load(with_draco(plain))), triangle_corners(load(plain)));
}

TEST(Draco, MorphTargetsStayBesideTheCompressedVertices) {
  auto plain = bumpy_sheet();
  std::vector<float> shifts(300);
  for (std::size_t k = 0; k < shifts.size(); ++k)
    shifts[k] = static_cast<float>(k % 7);
  auto file = with_draco(plain, {.edgebreaker = false});
  for (auto* each : {&plain, &file}) {
    square_primitive(*each)["targets"] =
        Json::array({{{"POSITION", each->add_accessor(shifts, "VEC3")}}});
    each->json["meshes"][0]["weights"] = {0.5};
  }
  EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(plain)));
}

TEST(Draco, PrimitivesOfOneViewAreDecodedOnce) {
  const auto plain = bumpy_sheet();
  auto file = with_draco(plain);
  for (int k = 0; k < 3; ++k) {
    auto primitive = square_primitive(file);
    primitive["material"] = file.add_material({{"name", "other"}});
    file.json["meshes"][0]["primitives"].push_back(primitive);
  }
  EXPECT_EQ(load(file).triangles.size(), 4 * load(plain).triangles.size());
  // The compressed buffer, the indices and the four attributes.
  EXPECT_EQ(read(file).buffers.size(), 6u);
}

TEST(Draco, FacesAreTrianglesWhateverTheModeSays) {
  const auto plain = bumpy_sheet();
  auto file = with_draco(plain);
  square_primitive(file)["mode"] = 5;
  EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(plain)));
  square_primitive(file)["mode"] = 9;
  EXPECT_THAT(error_of(file), HasSubstr("mode 9 does not exist"));
  square_primitive(file)["mode"] = 1;
  EXPECT_THAT(error_of(file), HasSubstr("nothing to render"));
}

TEST(Draco, DataThatIsThereIsNotDecoded) {
  auto file = bumpy_sheet();
  const auto garbage = file.add_view(Bytes(20, 7));
  square_primitive(file)["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", garbage}, {"attributes", {{"POSITION", 0}}}};
  EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(bumpy_sheet())));
}

TEST(Draco, AttributesWithoutUseAreDroppedAndOthersStay) {
  auto plain = bumpy_sheet();
  auto& attributes = square_primitive(plain)["attributes"];
  attributes["_FEATURE"] = attributes["TEXCOORD_0"];
  auto file = with_draco(plain);
  ASSERT_TRUE(extension_of(file)["attributes"].contains("_FEATURE"));
  EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(plain)));
  EXPECT_FALSE(read(file).root["meshes"][0]["primitives"][0]["attributes"].contains("_FEATURE"));

  // Colours that are not in the compressed data, in the order of its vertices.
  auto sequential = with_draco(plain, {.edgebreaker = false});
  extension_of(sequential)["attributes"].erase("COLOR_0");
  square_primitive(sequential)["attributes"]["COLOR_0"] =
      sequential.add_accessor(std::vector<float>(300, 0.25F), "VEC3");
  const Scene loaded = load(sequential);
  EXPECT_EQ(attributes_of(loaded, loaded.vertices[0]).color, glm::vec4(0.25F, 0.25F, 0.25F, 1.0F));
}

// --- Errors

struct BadDraco {
  const char* pointer; ///< into the extension
  Json value;
  const char* what;
};

class DracoErrors : public testing::TestWithParam<BadDraco> {};

TEST_P(DracoErrors, AreOneLineAboutThePrimitive) {
  auto file = with_draco(bumpy_sheet());
  file.json["meshes"][0]["name"] = "Chair";
  const Json::json_pointer at(GetParam().pointer);
  if (GetParam().value.is_null())
    extension_of(file)[at.parent_pointer()].erase(at.back());
  else
    extension_of(file)[at] = GetParam().value;
  EXPECT_THAT(error_of(file), HasSubstr(GetParam().what));
  EXPECT_THROW(load(file), InputError);
}

static const BadDraco bad_extensions[] = {
    {"/bufferView", 9, "'bufferView' is index 9 of bufferViews"},
    {"/bufferView", nullptr, "has no 'bufferView'"},
    {"/attributes", nullptr, "has no 'attributes'"},
    {"/attributes", 3, "'attributes' must be an object"},
    {"/attributes/POSITION", "0", "'POSITION' must be a whole number"},
    {"/attributes/POSITION", nullptr,
     "meshes[0] 'Chair', primitive 0: KHR_draco_mesh_compression: has no POSITION"},
    {"/attributes/POSITION", 17, "primitive 0: KHR_draco_mesh_compression: has no attribute 17"},
    {"/attributes/POSITION", 4294967296, "has no attribute 4294967296"},
    {"/attributes/POSITION", 3, "type must be VEC3 for this use, it is 'VEC2'"},
};
INSTANTIATE_TEST_SUITE_P(Extensions, DracoErrors, testing::ValuesIn(bad_extensions));

/// The compressed bytes stand alone in the file's data.
static std::string error_with(GltfFile file, const Bytes& data) {
  file.data = data;
  file.json["bufferViews"][0]["byteLength"] = data.size();
  return error_of(file);
}

TEST(Draco, CorruptDataIsNamed) {
  const auto file = with_draco(bumpy_sheet());
  auto data = file.data;
  const auto* broken =
      "meshes[0], primitive 0: KHR_draco_mesh_compression: the data is truncated or corrupt";
  EXPECT_THAT(error_with(file, {data.begin(), data.begin() + 200}), HasSubstr(broken));
  EXPECT_THAT(error_with(file, {data.begin(), data.begin() + 7}), HasSubstr(broken));
  data[0] = 'X';
  EXPECT_THAT(error_with(file, data), HasSubstr(broken));
  data[0] = 'D';
  data[5] = 9; // major version
  EXPECT_THAT(error_with(file, data), HasSubstr("is of a version of Draco that is not read"));
  data[5] = 2;
  data[7] = 0; // the kind of geometry
  EXPECT_THAT(error_with(file, data), HasSubstr("holds points without triangles"));
}

/// The number as Draco writes it: seven bits a byte, the lowest first.
static void append_varint(Bytes& bytes, std::uint32_t value) {
  for (; value >= 128; value >>= 7)
    bytes.push_back(static_cast<unsigned char>(value | 128));
  bytes.push_back(static_cast<unsigned char>(value));
}

TEST(Draco, MemoryIsCountedBeforeItIsTaken) {
  const auto large = with_draco(bumpy_sheet(60));
  EXPECT_THAT(error_of(large, {.memory_limit = 1 << 20}),
              HasSubstr("meshes[0], primitive 0: decoding KHR_draco_mesh_compression needs about"));
  EXPECT_THROW(load(large, {.memory_limit = 1 << 20}), OutputError);
  const auto file = with_draco(bumpy_sheet());

  // A header alone: Edgebreaker, a billion vertices and faces.
  Bytes huge{'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 0};
  append_varint(huge, 1'000'000'000);
  append_varint(huge, 1'000'000'000);
  huge.push_back(1);
  EXPECT_THAT(error_with(file, huge),
              HasSubstr("meshes[0], primitive 0: decoding KHR_draco_mesh_compression needs about"));

  // The same of sequential coding.
  Bytes points{'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0};
  append_varint(points, 1'000'000'000); // faces
  append_varint(points, 3);
  points.resize(points.size() + 40);
  EXPECT_THAT(error_with(file, points), HasSubstr("decoding KHR_draco_mesh_compression needs about"));
}

TEST(Draco, ManyAttributesAreCountedBeforeTheyAreDecoded) {
  // 32 bytes for each of 100 points and of 40 attributes that nobody asks for.
  auto plain = bumpy_sheet();
  const auto small = with_draco(plain, {.edgebreaker = false});
  auto& attributes = square_primitive(plain)["attributes"];
  for (int k = 0; k < 40; ++k)
    attributes["_N" + std::to_string(k)] = attributes["NORMAL"];
  const auto wide = with_draco(plain, {.edgebreaker = false});
  EXPECT_EQ(triangle_corners(load(wide)), triangle_corners(load(small)));
  constexpr std::uint64_t limit = 150'000;
  EXPECT_EQ(load(small, {.memory_limit = limit}).triangles.size(), 162u);
  EXPECT_THAT(error_of(wide, {.memory_limit = limit}),
              HasSubstr("decoding KHR_draco_mesh_compression needs about"));
}

} // namespace meninas::test
