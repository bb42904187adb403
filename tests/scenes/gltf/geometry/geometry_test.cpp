// Accessors and primitives: which numbers come out of which bytes, and which way triangles face.
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace meninas::test {

// The square's corners are small integers, exact in every format: they are compared for equality.
static std::vector<Point3> positions(const Scene& scene) {
  std::vector<Point3> points;
  for (const auto& vertex : scene.vertices)
    points.push_back(vertex.position);
  return points;
}

static const std::vector<Point3> square_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

static double area(const Scene& scene) {
  double sum = 0.0;
  for (std::size_t k = 0; k < scene.triangles.size(); ++k)
    sum += 0.5 * glm::length(normal(scene, k));
  return sum;
}

TEST(GltfGeometry, ReadsAnIndexedSquare) {
  const auto scene = load(square());
  EXPECT_EQ(positions(scene), square_corners);
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(normal(scene, 0), Vec3(0, 0, 1));
  EXPECT_EQ(normal(scene, 1), Vec3(0, 0, 1));
  ASSERT_EQ(scene.nodes.size(), 1u);
  EXPECT_EQ(scene.nodes[0].name, "Quad");
  EXPECT_EQ(scene.materials.at(0).name, "grey");
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  EXPECT_TRUE(scene.ignored.empty());
  EXPECT_EQ(scene.degenerate_triangles, 0u);
}

TEST(GltfGeometry, ReadsEveryIndexType) {
  for (int type = 0; type < 3; ++type) {
    auto file = square();
    square_primitive(file)["indices"] =
        type == 0   ? file.add_accessor<std::uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR")
        : type == 1 ? file.add_accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR")
                    : file.add_accessor<std::uint32_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    const auto scene = load(file);
    EXPECT_EQ(positions(scene), square_corners);
    EXPECT_EQ(area(scene), 1.0);
  }
}

TEST(GltfGeometry, ReadsTrianglesWithoutIndices) {
  auto file = square();
  square_primitive(file).erase("indices");
  square_primitive(file)["attributes"]["POSITION"] =
      file.add_accessor<float>({0, 0, 0, 2, 0, 0, 0, 3, 0}, "VEC3");
  const auto scene = load(file);
  ASSERT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(normal(scene, 0), Vec3(0, 0, 6));
}

TEST(GltfGeometry, StripsAndFansFaceOneWay) {
  auto strip = square();
  square_primitive(strip)["mode"] = 5;
  // 0-1-3-2 zigzags over the square, then goes on upwards.
  square_primitive(strip)["attributes"]["POSITION"] =
      strip.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, "VEC3");
  square_primitive(strip).erase("indices");
  const auto strip_scene = load(strip);
  ASSERT_EQ(strip_scene.triangles.size(), 4u);

  auto fan = square();
  square_primitive(fan)["mode"] = 6;
  square_primitive(fan)["indices"] = fan.add_accessor<std::uint8_t>({0, 1, 2, 3}, "SCALAR");
  const auto fan_scene = load(fan);
  ASSERT_EQ(fan_scene.triangles.size(), 2u);
  EXPECT_EQ(area(fan_scene), 1.0);

  for (const auto& scene : {strip_scene, fan_scene})
    for (std::size_t k = 0; k < scene.triangles.size(); ++k)
      EXPECT_EQ(normal(scene, k), Vec3(0, 0, 1)) << k;
}

TEST(GltfGeometry, PointsAndLinesAreSkippedWithAWarning) {
  for (int mode = 0; mode < 4; ++mode) {
    auto file = square();
    auto lines = square_primitive(file);
    lines["mode"] = mode;
    file.json["meshes"][0]["primitives"].push_back(lines);
    const auto scene = load(file);
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_TRUE(warns(scene, {"points and lines", "'Quad'"}));
  }
}

TEST(GltfGeometry, ReadsInterleavedVertices) {
  GltfFile file = square();
  std::vector<float> interleaved;
  for (const auto& p : square_corners)
    for (const auto number : {p.x, p.y, p.z, 10.0 + p.x, 20.0 + p.y})
      interleaved.push_back(static_cast<float>(number));
  Bytes bytes(interleaved.size() * 4);
  std::memcpy(bytes.data(), interleaved.data(), bytes.size());
  const auto view = file.add_view(bytes);
  file.json["bufferViews"][view]["byteStride"] = 20;
  file.json["accessors"][0]["bufferView"] = view;
  file.json["accessors"].push_back({{"bufferView", view},
                                    {"byteOffset", 12},
                                    {"componentType", 5126},
                                    {"count", 4},
                                    {"type", "VEC2"}});
  square_primitive(file)["attributes"]["TEXCOORD_0"] = 2;
  const auto scene = load(file);
  EXPECT_EQ(positions(scene), square_corners);
  EXPECT_EQ(attributes_of(scene, scene.vertices[2]).texcoord[0], glm::vec2(11.0f, 21.0f));
}

TEST(GltfGeometry, ReadsSparseAccessors) {
  auto file = square();
  const auto indices = file.add_view({2, 0});
  Bytes values(24);
  const float moved[]{5, 6, 7, -1, -2, 0};
  std::memcpy(values.data(), moved, 24);
  file.json["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", file.add_view(values)}}}};
  const auto over_dense = load(file);
  EXPECT_EQ(positions(over_dense),
            (std::vector<Point3>{{-1, -2, 0}, {1, 0, 0}, {5, 6, 7}, {0, 1, 0}}));

  // Without a buffer view the other elements are zero.
  file.json["accessors"][0].erase("bufferView");
  square_primitive(file)["indices"] = file.add_accessor<std::uint8_t>({0, 1, 2}, "SCALAR");
  const auto over_zero = load(file);
  EXPECT_EQ(positions(over_zero), (std::vector<Point3>{{-1, -2, 0}, {0, 0, 0}, {5, 6, 7}}));
}

TEST(GltfGeometry, ReadsNormalisedTextureCoordinates) {
  auto file = square();
  square_primitive(file)["attributes"]["TEXCOORD_0"] =
      file.add_accessor<std::uint8_t>({0, 51, 255, 255, 102, 0, 0, 0}, "VEC2");
  square_primitive(file)["attributes"]["TEXCOORD_1"] =
      file.add_accessor<std::uint16_t>({0, 0, 65535, 13107, 0, 0, 0, 0}, "VEC2");
  file.json["accessors"][2]["normalized"] = true;
  file.json["accessors"][3]["normalized"] = true;
  const auto scene = load(file);
  // 51 / 255 and 13107 / 65535 are 0.2, rounded to float.
  EXPECT_EQ(attributes_of(scene, scene.vertices[0]).texcoord[0], glm::vec2(0.0f, 0.2f));
  EXPECT_EQ(attributes_of(scene, scene.vertices[1]).texcoord[0], glm::vec2(1.0f, 1.0f));
  EXPECT_EQ(attributes_of(scene, scene.vertices[1]).texcoord[1], glm::vec2(1.0f, 0.2f));
}

TEST(GltfGeometry, ReadsQuantizedPositions) {
  auto file = square();
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  square_primitive(file)["attributes"]["POSITION"] = file.add_accessor<std::int16_t>(
      {-32768, -32767, 0, 32767, -32767, 0, 32767, 32767, 0, -32767, 32767, 0}, "VEC3");
  file.json["accessors"][2]["normalized"] = true;
  EXPECT_EQ(positions(load(file)),
            (std::vector<Point3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}));

  file.json["accessors"][2]["normalized"] = false;
  EXPECT_EQ(positions(load(file))[0], Point3(-32768, -32767, 0));

  square_primitive(file)["attributes"]["POSITION"] = file.add_accessor<std::int8_t>(
      {-128, -127, 0, 127, -127, 0, 127, 127, 0, -127, 127, 0}, "VEC3");
  file.json["accessors"][3]["normalized"] = true;
  EXPECT_EQ(positions(load(file)),
            (std::vector<Point3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}));
}

TEST(GltfGeometry, SaysTheSameFromAGlbAndFromFiles) {
  const auto file = square();
  const TemporaryFolder folder;
  const auto from_glb = load_gltf(folder.write("scene.glb", as_glb(file)));
  EXPECT_EQ(positions(from_glb), square_corners);
  EXPECT_EQ(from_glb.file, (folder.path() / "scene.glb").string());

  auto external = file;
  external.json["buffers"] =
      Json::array({{{"byteLength", file.data.size()}, {"uri", "some%20data/b%C3%BCffer.bin"}}});
  folder.write("some data/b\xC3\xBC"
               "ffer.bin",
               file.data);
  EXPECT_EQ(positions(load_gltf(folder.write("a room.gltf", as_text(external)))), square_corners);
}

TEST(GltfGeometry, DropsAndCountsDegenerateTriangles) {
  auto file = square();
  // Two good ones, a repeated vertex, three points in a line,
  // and a sliver lower than half a float step at 1.
  square_primitive(file)["attributes"]["POSITION"] = file.add_accessor<float>(
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5f, 0.5f, 0, 0.5f, 2e-8f, 0}, "VEC3");
  square_primitive(file)["indices"] =
      file.add_accessor<std::uint8_t>({0, 1, 2, 0, 2, 3, 0, 0, 1, 0, 4, 2, 0, 1, 5}, "SCALAR");
  const auto scene = load(file);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.vertices.size(), 4u) << "vertices of dropped triangles stay out";
  EXPECT_EQ(scene.degenerate_triangles, 3u);
  EXPECT_TRUE(warns(scene, {"without area", "'Quad'"}));
  EXPECT_TRUE(warns(scene, {"triangles without area", ": 3"}));
}

TEST(GltfGeometry, BoundsTheErrorOfPositions) {
  // Half the distance between floats at 1 is 2^-24 (at numbers in [1, 2));
  // doubles add 4e-16 of the size.
  const auto plain = load(square());
  EXPECT_DOUBLE_EQ(plain.position_error, std::ldexp(1.0, -24) + 4e-16);

  auto scaled = square();
  scaled.json["nodes"][0]["scale"] = {3.0, 1.0, 1.0};
  scaled.json["nodes"][0]["translation"] = {0.0, 1e4, 0.0};
  EXPECT_DOUBLE_EQ(load(scaled).position_error, 3.0 * std::ldexp(1.0, -24) + 4e-16 * (3.0 + 1e4));
}

/// The colour of the second vertex, of four.
template <typename Number>
static glm::vec4 second_color(const std::vector<Number>& values, const std::string& type) {
  auto file = square();
  const auto accessor = file.add_accessor(values, type);
  file.json["accessors"][accessor]["normalized"] = !std::is_floating_point_v<Number>;
  square_primitive(file)["attributes"]["COLOR_0"] = accessor;
  const Scene scene = load(file);
  EXPECT_TRUE(scene.ignored.empty());
  return attributes_of(scene, scene.vertices.at(1)).color;
}

TEST(GltfGeometry, ReadsVertexColoursOfEveryType) {
  using U8 = std::uint8_t;
  using U16 = std::uint16_t;
  const glm::vec4 seen(0.2F, 0.4F, 0.6F, 0.8F);
  const std::vector<U8> bytes{1, 2, 3, 4, 51, 102, 153, 204, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<U8> opaque{1, 2, 3, 51, 102, 153, 5, 6, 7, 9, 10, 11};
  const std::vector<U16> shorts{1, 2, 3, 4, 13107, 26214, 39321, 52428, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<float> floats{1, 1, 1, 1, 0.2F, 0.4F, 0.6F, 0.8F, 1, 1, 1, 1, 1, 1, 1, 1};
  const auto expect_near = [](const glm::vec4& a, const glm::vec4& b) {
    for (int c = 0; c < 4; ++c)
      EXPECT_FLOAT_EQ(a[c], b[c]) << c;
  };
  expect_near(second_color(bytes, "VEC4"), seen);
  expect_near(second_color(shorts, "VEC4"), seen);
  expect_near(second_color(floats, "VEC4"), seen);
  expect_near(second_color(opaque, "VEC3"), glm::vec4(glm::vec3(seen), 1.0F));
  const Scene plain = load(square());
  EXPECT_EQ(attributes_of(plain, plain.vertices.at(1)).color, glm::vec4(1.0F));
}

TEST(GltfGeometry, ClampsVertexColours) {
  auto file = square();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  square_primitive(file)["attributes"]["COLOR_0"] =
      file.add_accessor(std::vector<float>{1, 1, 1, 1.5F, -1, nan, 1, 1, 1, 1, 1, 1}, "VEC3");
  const Scene scene = load(file);
  EXPECT_EQ(attributes_of(scene, scene.vertices.at(1)).color, glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
  EXPECT_TRUE(warns(scene, {"vertex colours outside [0, 1]", "'Quad'"}));
}

TEST(GltfGeometry, LeavesOutWhatItDoesNotRead) {
  auto file = square();
  file.json["animations"] = Json::array({{{"name", "Walk"}}, Json::object()});
  file.json["extensionsUsed"] = {"KHR_materials_subsurface"};
  file.json["materials"][0]["extensions"]["VENDOR_undeclared"] = Json::object();
  const auto scene = load(file);
  EXPECT_TRUE(warns(scene, {"animations", "'Walk'", "'animation1'"}));
  EXPECT_TRUE(warns(scene, {"extensions", "'KHR_materials_subsurface'", "'VENDOR_undeclared'"}));
  EXPECT_THAT(scene.ignored, testing::UnorderedElementsAre("KHR_materials_subsurface",
                                                           "VENDOR_undeclared", "animations"));
}

TEST(GltfGeometry, LoadsTheSameBitsTwice) {
  const auto a = load(square());
  const auto b = load(square());
  EXPECT_EQ(positions(a), positions(b));
  EXPECT_EQ(content_hash(a), content_hash(b));
}

} // namespace meninas::test
