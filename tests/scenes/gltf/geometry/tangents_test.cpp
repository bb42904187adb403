// TANGENT, and the tangents of files without: what normal maps make of them.
#include "scenes/materials/normal_map.h"
#include "tests/scenes/gltf/gltf_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double floats = 1e-6;
const Vec3 to_the_right(0.6, 0.0, 0.8), upwards(0.0, 0.6, 0.8); // of the image

/// Gives all that has the material `grey` a normal map, of one texel when it is decoded.
void add_map(GltfFile& file) {
  const auto image = file.add_view(Bytes(8, 1));
  file.json["images"] = Json::array({{{"bufferView", image}, {"mimeType", "image/png"}}});
  file.json["textures"] = Json::array({{{"source", 0}}});
  file.json["materials"][0]["normalTexture"] = {{"index", 0}};
}

Json& attributes(GltfFile& file) { return square_primitive(file)["attributes"]; }

/// A square with a map, upright on it, and the normals of its plane.
GltfFile mapped(GltfFile file) {
  add_map(file);
  attributes(file)["NORMAL"] =
      file.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  attributes(file)["TEXCOORD_0"] = file.add_accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
  return file;
}
GltfFile mapped_square() { return mapped(square()); }

template <typename T>
GltfFile with_tangents(GltfFile file, const std::vector<T>& values) {
  attributes(file)["TANGENT"] = file.add_accessor<T>(values, "VEC4");
  return file;
}
/// The same at all corners of the square.
GltfFile with_tangent(const GltfFile& file, float x, float y, float z, float w) {
  return with_tangents<float>(file, {x, y, z, w, x, y, z, w, x, y, z, w, x, y, z, w});
}

Direction normal_of(const Scene& scene, const Vec3& lean, std::uint32_t triangle = 0,
                    Vec2 at = Vec2(0.3)) {
  const DecodedTextures textures{{}, {TexturePixels{1, 1, {glm::vec4(0.5 * lean + 0.5, 1.0)}}}};
  return mapped_normal(scene, textures, TriangleId{triangle}, at);
}

void expect_normal(const Scene& scene, const Vec3& lean, const Vec3& expected) {
  EXPECT_LT(glm::distance(normal_of(scene, lean), glm::normalize(expected)), floats);
}

TEST(GltfTangents, TurnTheNormal) {
  const Scene scene = load(with_tangent(mapped_square(), 0, 1, 0, 1));
  ASSERT_EQ(scene.tangents.size(), 4U);
  EXPECT_EQ(scene.tangents[2], glm::vec4(0, 1, 0, 1));
  expect_normal(scene, to_the_right, {0.0, 0.6, 0.8});
  expect_normal(scene, upwards, {-0.6, 0.0, 0.8});
  expect_normal(load(with_tangent(mapped_square(), 0, 1, 0, -1)), upwards, {0.6, 0.0, 0.8});
  EXPECT_TRUE(scene.warnings.empty());
  // Made unit and across the normal.
  EXPECT_EQ(load(with_tangent(mapped_square(), 0, 3, -4, 1)).tangents[1], glm::vec4(0, 1, 0, 1));
}

TEST(GltfTangents, AreMadeWhereThereAreNone) {
  const Scene scene = load(mapped_square());
  EXPECT_EQ(scene.tangents, std::vector<glm::vec4>(4, glm::vec4(1, 0, 0, 1)));
  expect_normal(scene, to_the_right, to_the_right);
  expect_normal(scene, upwards, upwards);
}

TEST(GltfTangents, AreThereForNormalMapsAlone) {
  auto file = with_tangent(mapped_square(), 0, 0, 0, 0);
  file.json["materials"][0].erase("normalTexture");
  EXPECT_TRUE(load(file).tangents.empty());
  EXPECT_TRUE(load(file).warnings.empty());
  EXPECT_TRUE(load(square()).tangents.empty());
}

TEST(GltfTangents, MayBeBytesAndShorts) {
  const auto rounded = [](auto most) {
    using T = decltype(most);
    const T x = static_cast<T>(0.6 * most), y = static_cast<T>(0.8 * most),
            w = static_cast<T>(-most);
    auto file = with_tangents<T>(mapped_square(), {x, y, 0, w, x, y, 0, w, x, y, 0, w, x, y, 0, w});
    file.json["accessors"].back()["normalized"] = true;
    return load(file);
  };
  // Half a step along each of two axes.
  const auto expect_near = [](const Scene& scene, double step) {
    EXPECT_LT(glm::distance(Vec3(scene.tangents.at(0)), Vec3(0.6, 0.8, 0.0)), step);
    EXPECT_EQ(scene.tangents.at(0).w, -1.0F);
  };
  expect_near(rounded(std::int8_t{127}), 1.0 / 127.0);
  expect_near(rounded(std::int16_t{32767}), 1.0 / 32767.0);
}

// T' = A T: stretched along x by 2, and mirrored, where B' = A B turns w round.
TEST(GltfTangents, AreMovedByTheirNode) {
  auto file = with_tangent(mapped_square(), 1, 1, 0, 1);
  file.json["nodes"][0]["scale"] = {2.0, 1.0, 1.0};
  expect_normal(load(file), to_the_right, 0.6 * glm::normalize(Vec3(2, 1, 0)) + Vec3(0, 0, 0.8));
  file = with_tangent(mapped_square(), 1, 0, 0, 1);
  file.json["nodes"][0]["scale"] = {-2.0, 1.0, 1.0};
  expect_normal(load(file), to_the_right, {-0.6, 0.0, 0.8});
  expect_normal(load(file), upwards, upwards);
}

TEST(GltfTangents, FollowJointsAndTargets) {
  const auto turned = [](GltfFile file) {
    file.json["nodes"][2]["rotation"] = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)}; // about z
    return load(file);
  };
  const GltfFile skinned = mapped(skinned_square());
  for (const Scene& scene : {turned(skinned), turned(with_tangent(skinned, 1, 0, 0, 1))}) {
    expect_normal(scene, to_the_right, {0.0, 0.6, 0.8});
    expect_normal(scene, upwards, {-0.6, 0.0, 0.8});
  }
  // The first target, of weight 1, adds y to x.
  auto morphed = with_tangent(mapped(morphed_square()), 1, 0, 0, 1);
  square_primitive(morphed)["targets"][0]["TANGENT"] =
      morphed.add_accessor<float>({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  expect_normal(load(morphed), to_the_right, 0.6 * glm::normalize(Vec3(1, 1, 0)) + Vec3(0, 0, 0.8));
}

// One that cannot be used leaves that corner to the coordinates of its triangle; where none can
// they are made. All of this is the upright image's frame.
TEST(GltfTangents, ThatCannotBeUsedAreNamedAndLeftOut) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const glm::vec4& bad :
       {glm::vec4(0, 0, 0, 1), glm::vec4(nan, 0, 0, 1), glm::vec4(1, 0, 0, nan),
        glm::vec4(1, 0, 0, 0), glm::vec4(0.001, 0, 1, 1), glm::vec4(0, 0, -5, 1)}) {
    const Scene one = load(with_tangents<float>(
        mapped_square(), {bad.x, bad.y, bad.z, bad.w, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}));
    const Scene all = load(with_tangent(mapped_square(), bad.x, bad.y, bad.z, bad.w));
    EXPECT_EQ(Vec3(one.tangents.at(0)), Vec3(0.0));
    for (const Scene& scene : {one, all}) {
      expect_normal(scene, to_the_right, to_the_right);
      expect_normal(scene, upwards, upwards);
      EXPECT_TRUE(warns(scene, {"tangents", "no directions across their normals", "'Quad'"}));
    }
  }
}

TEST(GltfTangents, WithoutNormalsAreLeftOut) {
  auto file = with_tangent(mapped_square(), 0, 1, 0, 1);
  attributes(file).erase("NORMAL");
  const Scene scene = load(file);
  expect_normal(scene, to_the_right, to_the_right);
  EXPECT_TRUE(warns(scene, {"tangents without normals", "'Quad'"}));
}

TEST(GltfTangents, TooFewOrOfAnotherKindEndTheReading) {
  EXPECT_THAT(error_of(with_tangents<float>(mapped_square(), {1, 0, 0, 1})),
              testing::HasSubstr("TANGENT has 1 elements, POSITION has 4"));
  auto file = mapped_square();
  attributes(file)["TANGENT"] = attributes(file)["NORMAL"];
  EXPECT_THAT(error_of(file), testing::HasSubstr("type must be VEC4"));
}

// A transform turns the image on its coordinates, along which TANGENT is. With
// u' = m u cos r + v sin r and v' = -m u sin r + v cos r, u to the right and v down, u' grows along
// (m cos r, -sin r) and v' against (m sin r, cos r).
TEST(GltfTangents, TurnWithTheTransformOfTheTexture) {
  const double r = 0.3;
  for (const double m : {1.0, -1.0}) {
    auto made = mapped_square();
    made.json["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {
        {"rotation", r}, {"scale", {5.0 * m, 5.0}}, {"offset", {0.1, 0.2}}};
    const Vec3 right(m * std::cos(r), -std::sin(r), 0.0), up(m * std::sin(r), std::cos(r), 0.0);
    for (const Scene& scene : {load(made), load(with_tangent(made, 1, 0, 0, 1))}) {
      expect_normal(scene, to_the_right, 0.6 * right + Vec3(0, 0, 0.8));
      expect_normal(scene, upwards, 0.6 * up + Vec3(0, 0, 0.8));
    }
  }
}

TEST(GltfTangents, AreThoseOfTheMapsSetOfCoordinates) {
  auto file = mapped_square();
  attributes(file)["TEXCOORD_1"] = // right is up, down is right
      file.add_accessor<float>({0, 0, 0, 1, 1, 1, 1, 0}, "VEC2");
  expect_normal(load(file), to_the_right, to_the_right);
  file.json["materials"][0]["normalTexture"]["texCoord"] = 1;
  expect_normal(load(file), to_the_right, {0.0, 0.6, 0.8});
  expect_normal(load(file), upwards, {-0.6, 0.0, 0.8});
}

struct Mesh {
  std::vector<float> positions, normals, texcoords, tangents;
  std::vector<std::uint32_t> indices;

  void add(const Vec3& position, const Vec3& normal, const Vec2& texcoord) {
    for (int k = 0; k < 3; ++k) {
      positions.push_back(static_cast<float>(position[k]));
      normals.push_back(static_cast<float>(normal[k]));
    }
    for (int k = 0; k < 2; ++k)
      texcoords.push_back(static_cast<float>(texcoord[k]));
  }
  /// Of two rows of vertices, side by side: the lower left triangle first.
  void add_strip(std::uint32_t columns) {
    for (std::uint32_t k = 0; k < columns; ++k) {
      const std::uint32_t a = 2 * k, b = a + 2;
      for (const std::uint32_t v : {a, b, b + 1, a, b + 1, a + 1})
        indices.push_back(v);
    }
  }
  GltfFile file() const {
    GltfFile file = square();
    add_map(file);
    attributes(file) = {{"POSITION", file.add_accessor<float>(positions, "VEC3")},
                        {"NORMAL", file.add_accessor<float>(normals, "VEC3")},
                        {"TEXCOORD_0", file.add_accessor<float>(texcoords, "VEC2")}};
    if (!tangents.empty())
      attributes(file)["TANGENT"] = file.add_accessor<float>(tangents, "VEC4");
    square_primitive(file)["indices"] = file.add_accessor<std::uint32_t>(indices, "SCALAR");
    return file;
  }
};

/// A pipe of facets, of radius and height 1. u goes round it, and down it v, which by column is put
/// off by `offset`.
constexpr std::uint32_t facets = 12;
double offset(std::uint32_t column) { return 0.2 * std::sin(1.7 * column); }
double angle_of(std::uint32_t column) { return 2.0 * std::numbers::pi * column / facets; }
Mesh pipe() {
  Mesh mesh;
  for (std::uint32_t c = 0; c <= facets; ++c)
    for (const double y : {0.0, 1.0}) {
      const Vec3 n(std::sin(angle_of(c)), 0.0, std::cos(angle_of(c)));
      mesh.add(n + Vec3(0, y, 0), n, {double(c) / facets, 1.0 - y + offset(c)});
    }
  mesh.add_strip(facets);
  return mesh;
}

// At constant v, u grows along c t + d y, with c the side of a facet seen along the normal, t round
// the pipe and d the difference of the offsets. Both facets have right angles at a vertex, so T is
// halfway between theirs; and over an edge the normal is the same on both sides.
TEST(GltfTangents, MapsGoSmoothlyOverTheEdgesOfCurves) {
  const Scene scene = load(pipe().file());
  const double side = std::sin(2.0 * std::numbers::pi / facets);
  for (std::uint32_t c = 1; c < facets; ++c) {
    const Vec3 n(std::sin(angle_of(c)), 0.0, std::cos(angle_of(c))), round(n.z, 0.0, -n.x);
    const auto along = [&](std::uint32_t column) {
      return glm::normalize(side * round + Vec3(0, offset(column + 1) - offset(column), 0));
    };
    const Vec3 t = glm::normalize(along(c - 1) + along(c)), b = glm::cross(n, t);
    for (const Vec3& lean : {to_the_right, upwards})
      for (const double height : {0.0, 0.3, 1.0}) {
        const Direction before = normal_of(scene, lean, 2 * (c - 1), {1.0 - height, height}),
                        after = normal_of(scene, lean, 2 * c + 1, {0.0, height});
        EXPECT_LT(glm::distance(before, after), floats) << c;
        EXPECT_LT(glm::distance(before, lean.x * t + lean.y * b + lean.z * n), floats) << c;
      }
  }
}

// Between the corners T and N are linear. Halfway between x and y T is shorter than 1, and the
// slope is less. In the middle of a facet of a pipe without offsets T and N are shorter alike, and
// the normal is that of the curve.
TEST(GltfTangents, AreLinearBetweenCorners) {
  const Scene turning =
      load(with_tangents<float>(mapped_square(), {1, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1}));
  EXPECT_LT(glm::distance(normal_of(turning, to_the_right, 0, {0.5, 0.0}),
                          glm::normalize(Vec3(0.3, 0.3, 0.8))),
            floats);
  EXPECT_LT(glm::distance(normal_of(turning, upwards, 0, {0.5, 0.0}),
                          glm::normalize(Vec3(-0.3, 0.3, 0.8))),
            floats);
  Mesh mesh = pipe();
  for (std::uint32_t v = 0; v < mesh.texcoords.size() / 2; ++v)
    mesh.texcoords[2 * v + 1] -= static_cast<float>(offset(v / 2));
  const Scene scene = load(mesh.file());
  for (std::uint32_t c = 0; c < facets; ++c) {
    const double angle = 0.5 * (angle_of(c) + angle_of(c + 1));
    const Vec3 n(std::sin(angle), 0.0, std::cos(angle)), round(n.z, 0.0, -n.x);
    EXPECT_LT(
        glm::distance(normal_of(scene, to_the_right, 2 * c, {0.5, 0.0}), 0.6 * round + 0.8 * n),
        floats);
  }
}

// A ridge with the image on one side and its mirror image on the other; they share their vertices.
TEST(GltfTangents, MirroredImagesMeetWithoutAStep) {
  Mesh mesh;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {0.0, 1.0})
      mesh.add({x, y, -0.5 * std::abs(x)}, glm::normalize(Vec3(0.4 * x, 0.0, 1.0)),
               {std::abs(x), 1.0 - y});
  mesh.add_strip(2);
  const Scene scene = load(mesh.file());
  for (const double y : {0.0, 0.4, 1.0}) {
    const Direction left = normal_of(scene, upwards, 0, {1.0 - y, y}),
                    right = normal_of(scene, upwards, 3, {0.0, y});
    EXPECT_LT(glm::distance(left, upwards), floats);
    EXPECT_LT(glm::distance(right, upwards), floats);
  }
  // Each side has its own tangents there.
  EXPECT_EQ(scene.vertices.size(), 8U);
  EXPECT_LT(glm::distance(normal_of(scene, to_the_right, 0, {1.0, 0.0}), Vec3(-0.6, 0.0, 0.8)),
            floats);
  EXPECT_LT(glm::distance(normal_of(scene, to_the_right, 3, {0.0, 0.0}), Vec3(0.6, 0.0, 0.8)),
            floats);
}

/// The mesh of a scene that was loaded, with its tangents.
Mesh given(const Scene& scene) {
  Mesh mesh;
  for (std::size_t v = 0; v < scene.vertices.size(); ++v) {
    const Vertex& vertex = scene.vertices[v];
    mesh.add(vertex.position, Vec3(vertex.normal), Vec2(attributes_of(scene, vertex).texcoord[0]));
    for (int k = 0; k < 4; ++k)
      mesh.tangents.push_back(scene.tangents.at(v)[k]);
  }
  for (const Triangle& triangle : scene.triangles)
    for (const VertexId v : triangle.vertices)
      mesh.indices.push_back(index(v));
  return mesh;
}

// Wherever the node puts it, also where it is stretched or mirrored.
TEST(GltfTangents, GivenAsTheyWouldBeMadeChangeNothing) {
  GltfFile without = pipe().file(), with = given(load(without)).file();
  for (const Json& scale : {Json{1.0, 1.0, 1.0}, Json{3.0, 0.5, 1.0}, Json{-1.0, 2.0, 1.0}}) {
    without.json["nodes"][0]["scale"] = with.json["nodes"][0]["scale"] = scale;
    const Scene made = load(without), told = load(with);
    ASSERT_EQ(made.triangles.size(), told.triangles.size());
    for (std::uint32_t t = 0; t < made.triangles.size(); ++t)
      for (const Vec3& lean : {to_the_right, upwards})
        EXPECT_LT(glm::distance(normal_of(made, lean, t), normal_of(told, lean, t)), floats);
  }
}

/// The square, of brushed metal, with its normals.
GltfFile brushed_square() {
  auto file = square();
  file.json["materials"][0]["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.5}};
  attributes(file)["NORMAL"] =
      file.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  return file;
}

TEST(GltfTangents, OfAnisotropyAreThoseOfTheFile) {
  EXPECT_EQ(load(with_tangent(brushed_square(), 0, 1, 0, 1)).tangents,
            std::vector<glm::vec4>(4, glm::vec4(0, 1, 0, 1)));
}

TEST(GltfTangents, OfAnisotropyAreMadeFromTextureCoordinates) {
  auto file = brushed_square();
  // u grows upwards.
  attributes(file)["TEXCOORD_0"] = file.add_accessor<float>({0, 0, 0, 1, 1, 1, 1, 0}, "VEC2");
  const Scene scene = load(file);
  EXPECT_EQ(scene.tangents, std::vector<glm::vec4>(4, glm::vec4(0, 1, 0, 1)));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfTangents, OfAnisotropyWithoutCoordinatesAreLevelInTheMesh) {
  auto file = brushed_square();
  const Scene upright = load(file);
  EXPECT_EQ(upright.tangents, std::vector<glm::vec4>(4, glm::vec4(1, 0, 0, 1)));
  EXPECT_TRUE(warns(upright, {"without texture coordinates are brushed level", "'Quad'"}));
  // What turns the mesh turns them.
  file.json["nodes"][0]["rotation"] = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)}; // about z
  EXPECT_LT(glm::distance(Vec3(load(file).tangents.at(0)), Vec3(0, 1, 0)), floats);
}

} // namespace
} // namespace meninas::test
