// EXT_meshopt_compression: what the library's encoders packed comes out as it went in.
#include "scenes/gltf/accessors.h"
#include "tests/scenes/gltf/compression/compressed_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

namespace meninas::test {

using testing::HasSubstr;

static Json& first_extension(GltfFile& file) {
  const auto position = square_primitive(file)["attributes"]["POSITION"].get<std::size_t>();
  const auto view = file.json["accessors"][position]["bufferView"].get<std::size_t>();
  return file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

static Json& index_extension(GltfFile& file) {
  const auto indices = square_primitive(file)["indices"].get<std::size_t>();
  const auto view = file.json["accessors"][indices]["bufferView"].get<std::size_t>();
  return file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

/// With the compressed data as the binary chunk, as optimisers write it.
static Scene load_binary(const GltfFile& file) {
  const TemporaryFolder folder;
  return load_gltf(folder.write("scene.glb", as_glb(file)));
}

TEST(Meshopt, LosslessDataComesOutToTheBit) {
  const auto plain = bumpy_sheet();
  const auto expected = triangle_corners(load(plain));
  ASSERT_EQ(expected.size(), 2u * 9 * 9);
  for (const auto* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const auto file = with_meshopt(plain, name);
    const auto scene = load(file);
    EXPECT_EQ(triangle_corners(scene), expected) << name;
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_TRUE(scene.ignored.empty()) << scene.ignored[0];
    EXPECT_EQ(triangle_corners(load_binary(file)), expected) << name;
  }
}

TEST(Meshopt, RequiredOrNotTheDataIsNowhereElse) {
  const auto expected = triangle_corners(load(bumpy_sheet()));
  auto file = with_meshopt(bumpy_sheet());
  file.json.erase("extensionsRequired");
  EXPECT_EQ(triangle_corners(load(file)), expected);
  file.json.erase("extensionsUsed");
  EXPECT_EQ(triangle_corners(load(file)), expected);
  file.json["buffers"][1].erase("extensions");
  EXPECT_EQ(triangle_corners(load(file)), expected);
}

TEST(Meshopt, QuantisedPositionsKeepTheirPadding) {
  const auto plain = quantised_sheet();
  auto file = with_meshopt(plain);
  EXPECT_EQ(first_extension(file)["byteStride"], 8) << "6 bytes and 2";
  EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(plain)));
}

TEST(Meshopt, StripsAndShortIndicesAreSequences) {
  auto plain = bumpy_sheet();
  auto& primitive = square_primitive(plain);
  primitive["mode"] = 5;
  for (const bool is_short : {true, false}) {
    primitive["indices"] =
        is_short ? plain.add_accessor<std::uint16_t>({0, 1, 10, 11, 20, 21, 30}, "SCALAR")
                 : plain.add_accessor<std::uint32_t>({0, 1, 10, 11, 20, 21, 30}, "SCALAR");
    auto file = with_meshopt(plain);
    ASSERT_EQ(index_extension(file)["mode"], "INDICES");
    const auto found = triangle_corners(load(file));
    EXPECT_EQ(found.size(), 5u);
    EXPECT_EQ(found, triangle_corners(load(plain)));
  }
  primitive["mode"] = 4;
  primitive["indices"] = plain.add_accessor<std::uint16_t>({0, 1, 10, 1, 11, 10}, "SCALAR");
  EXPECT_EQ(triangle_corners(load(with_meshopt(plain))), triangle_corners(load(plain)));
}

// --- Filters: what of four floats each comes out of the accessor

/// One accessor whose view is compressed with a filter; its bytes are what the encoder made.
static gltf::Vectors decode_filtered(const Bytes& filtered, std::size_t count,
                                     const std::string& filter, const Json& accessor) {
  const auto stride = filtered.size() / count;
  GltfFile file = square();
  const auto packed = encode_vertices(filtered.data(), count, stride);
  const auto view = file.add_view(packed);
  auto description = file.json["bufferViews"][view];
  description.update({{"byteStride", stride},
                      {"count", count},
                      {"mode", "ATTRIBUTES"},
                      {"filter", filter}});
  file.json["bufferViews"][view] = {{"buffer", 1},
                                    {"byteLength", filtered.size()},
                                    {"byteStride", stride},
                                    {"extensions", {{"EXT_meshopt_compression", description}}}};
  file.json["accessors"].push_back(accessor);
  file.json["accessors"].back().update({{"bufferView", view}, {"count", count}});
  file.json["buffers"] =
      Json::array({{{"byteLength", file.data.size()}, {"uri", data_uri(file.data)}},
                   {{"byteLength", filtered.size()}}});
  const auto text = as_text(file);
  const auto document = gltf::read_document({text.begin(), text.end()}, "scene.gltf", {});
  return gltf::decode_vectors(document, file.json["accessors"].size() - 1,
                              accessor["type"] == "VEC3" ? 3 : 4);
}

/// Unit vectors of four components all over the sphere.
static std::vector<float> unit_vectors(std::size_t count, std::size_t width) {
  std::vector<float> values;
  for (std::size_t k = 0; k < count; ++k) {
    const auto x = static_cast<double>(k);
    const double v[4] = {std::sin(1.0 + x), std::cos(2.0 * x), std::sin(3.0 * x + 0.5),
                         width == 4 ? std::cos(0.7 * x) : 0.0};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    for (const double part : v)
      values.push_back(static_cast<float>(part / length));
  }
  return values;
}

TEST(Meshopt, OctahedralFilterGivesUnitVectors) {
  constexpr std::size_t count = 37; // more than whole registers of vectors
  const auto normals = unit_vectors(count, 3);
  for (const int bits : {8, 16}) {
    const std::size_t stride = bits == 8 ? 4 : 8;
    Bytes filtered(count * stride);
    meshopt_encodeFilterOct(filtered.data(), count, stride, bits, normals.data());
    const auto decoded =
        decode_filtered(filtered, count, "OCTAHEDRAL",
                        {{"type", "VEC3"}, {"normalized", true}, {"componentType", bits == 8 ? 5120 : 5122}});
    // A step of the octahedron's square at each of two coordinates, which it stretches by up to
    // sqrt(3), and the rounding of the unit vector.
    const double step = 1.0 / ((1 << (bits - 1)) - 1);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(decoded.values[3 * k + c], normals[4 * k + c], 2.0 * step) << k;
  }
}

TEST(Meshopt, QuaternionFilterGivesRotations) {
  constexpr std::size_t count = 37;
  const auto rotations = unit_vectors(count, 4);
  Bytes filtered(count * 8);
  meshopt_encodeFilterQuat(filtered.data(), count, 8, 16, rotations.data());
  const auto decoded =
      decode_filtered(filtered, count, "QUATERNION",
                      {{"type", "VEC4"}, {"normalized", true}, {"componentType", 5122}});
  // A quaternion and its negative are one rotation, 1 - |p q| tells how near.
  // 14 bits of sqrt(1/2) each: the three rounded components are off by 5e-5 at most.
  for (std::size_t k = 0; k < count; ++k) {
    double product = 0.0;
    for (std::size_t c = 0; c < 4; ++c)
      product += decoded.values[4 * k + c] * rotations[4 * k + c];
    EXPECT_NEAR(std::abs(product), 1.0, 1e-4) << k;
  }
}

TEST(Meshopt, ExponentialFilterGivesFloats) {
  constexpr std::size_t count = 37;
  std::vector<float> values;
  for (int k = 0; k < 3 * static_cast<int>(count); ++k)
    values.push_back(static_cast<float>(std::sin(1.0 + k) * std::pow(10.0, k % 7)));
  constexpr int bits = 15;
  Bytes filtered(count * 12);
#if MESHOPTIMIZER_VERSION >= 190 // since then there is a choice of who shares exponents
  meshopt_encodeFilterExp(filtered.data(), count, 12, bits, values.data(), meshopt_EncodeExpSharedVector);
#else
  meshopt_encodeFilterExp(filtered.data(), count, 12, bits, values.data());
#endif
  const auto decoded = decode_filtered(filtered, count, "EXPONENTIAL",
                                       {{"type", "VEC3"}, {"componentType", 5126}});
  // The components of a vector share the exponent of the largest; a bit is the sign.
  for (std::size_t k = 0; k < count; ++k) {
    const double largest = std::max({std::abs(values[3 * k]), std::abs(values[3 * k + 1]),
                                     std::abs(values[3 * k + 2])});
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(decoded.values[3 * k + c], values[3 * k + c], std::ldexp(largest, 2 - bits));
  }
}

// --- Fallback data

TEST(Meshopt, DataThatIsThereIsNotDecoded) {
  const auto plain = bumpy_sheet();
  auto file = with_meshopt(plain);
  // The second buffer as the compressed views leave it, filled.
  Bytes fallback;
  for (auto& view : file.json["bufferViews"]) {
    if (view["buffer"] != 1)
      continue;
    auto& description = view["extensions"]["EXT_meshopt_compression"];
    const std::size_t count = description["count"], stride = description["byteStride"];
    Bytes decoded(count * stride);
    const auto* source = file.data.data() + description["byteOffset"].get<std::size_t>();
    const std::size_t size = description["byteLength"];
    if (description["mode"] == "TRIANGLES")
      ASSERT_EQ(meshopt_decodeIndexBuffer(decoded.data(), count, stride, source, size), 0);
    else
      ASSERT_EQ(meshopt_decodeVertexBuffer(decoded.data(), count, stride, source, size), 0);
    const std::size_t offset = view["byteOffset"];
    fallback.resize(std::max(fallback.size(), offset + decoded.size()));
    std::ranges::copy(decoded, fallback.begin() + static_cast<std::ptrdiff_t>(offset));
    description["mode"] = "UNKNOWN"; // not looked at
  }
  auto& buffer = file.json["buffers"][1];
  buffer["uri"] = data_uri(fallback);
  EXPECT_EQ(triangle_corners(load(file)), triangle_corners(load(plain)));

  // A fallback that was left behind is none.
  auto alone = with_meshopt(plain);
  alone.json["buffers"][1]["uri"] = "fallback.bin";
  EXPECT_EQ(triangle_corners(load(alone)), triangle_corners(load(plain)));
  alone.json["buffers"][1].erase("extensions");
  EXPECT_THAT(error_of(alone), HasSubstr("buffers[1]: 'fallback.bin': no such file"));
}

// --- Errors

struct BadMeshopt {
  const char* key;
  Json value;
  const char* what;
  bool of_indices = false;
};

class MeshoptErrors : public testing::TestWithParam<BadMeshopt> {};

TEST_P(MeshoptErrors, AreOneLineAboutTheView) {
  auto file = with_meshopt(bumpy_sheet());
  auto& extension = GetParam().of_indices ? index_extension(file) : first_extension(file);
  if (GetParam().value.is_null())
    extension.erase(GetParam().key);
  else
    extension[GetParam().key] = GetParam().value;
  EXPECT_THAT(error_of(file), HasSubstr(GetParam().what));
  EXPECT_THROW(load(file), InputError);
}

static const BadMeshopt bad_descriptions[] = {
    {"mode", "POINTS", "bufferViews[2]: EXT_meshopt_compression: mode 'POINTS' does not exist"},
    {"mode", nullptr, "has no 'mode'"},
    {"byteStride", 0, "byteStride must be a multiple of 4 up to 256 for mode ATTRIBUTES, it is 0"},
    {"byteStride", 10, "byteStride must be a multiple of 4"},
    {"byteStride", 260, "byteStride must be a multiple of 4"},
    {"byteStride", 3, "byteStride must be 2 or 4 for mode TRIANGLES, it is 3", true},
    {"count", 200, "count must be a multiple of 3 for mode TRIANGLES, it is 200", true},
    {"count", 486 * 100, "the data is truncated or corrupt", true},
    {"count", 100 * 100, "the data is truncated or corrupt"},
    {"mode", "INDICES", "the data is truncated or corrupt", true},
    {"filter", "COLOR", "filter 'COLOR' is not read"},
    {"filter", "OCTAHEDRAL", "byteStride 12 is not for filter OCTAHEDRAL"},
    {"filter", "QUATERNION", "byteStride 12 is not for filter QUATERNION"},
    {"filter", "EXPONENTIAL", "filter EXPONENTIAL is only for mode ATTRIBUTES", true},
    {"filter", 1, "'filter' must be text"},
    {"byteLength", 20, "the data is truncated or corrupt"},
    {"byteLength", 0, "the data is truncated or corrupt"},
    {"byteLength", 1 << 20, "do not fit into"},
    {"byteOffset", 18446744073709551615u, "do not fit into"},
    {"buffer", 1, "buffers[1] has no data"},
    {"buffer", 2, "'buffer' is index 2 of buffers"},
};
INSTANTIATE_TEST_SUITE_P(Descriptions, MeshoptErrors, testing::ValuesIn(bad_descriptions));

TEST(Meshopt, CorruptDataAndOtherVersionsAreNamed) {
  auto file = with_meshopt(bumpy_sheet());
  const std::size_t first = first_extension(file)["byteOffset"];
  ASSERT_EQ(file.data[first], 0xA0);
  file.data[first] = 0xA1;
  file.json["buffers"][0]["uri"] = data_uri(file.data);
  EXPECT_THAT(error_of(file), HasSubstr("bufferViews[2]: EXT_meshopt_compression: the data is of "
                                        "version 1 of the codec, only 0 is read"));
  file.data[first] = 0x55;
  file.json["buffers"][0]["uri"] = data_uri(file.data);
  EXPECT_THAT(error_of(file), HasSubstr("the data is truncated or corrupt"));
}

TEST(Meshopt, MemoryIsCountedBeforeItIsTaken) {
  // Room for the file and its JSON, but not for the 220 kB that are packed in it.
  const auto large = with_meshopt(bumpy_sheet(60));
  const std::uint64_t limit = as_text(large).size() + 40'000;
  EXPECT_THAT(error_of(large, {.memory_limit = limit}),
              testing::AllOf(HasSubstr("bufferViews["), HasSubstr("over the memory limit")));
  EXPECT_THROW(load(large, {.memory_limit = limit}), OutputError);

  auto huge = with_meshopt(bumpy_sheet());
  first_extension(huge)["count"] = 1'000'000'000'000;
  EXPECT_THAT(error_of(huge), HasSubstr("bufferViews[2]: EXT_meshopt_compression: 1000000000000 "
                                        "elements of 12 bytes are over the memory limit"));
  EXPECT_THROW(load(huge), OutputError);
}

} // namespace meninas::test
