// What exporters write beyond plain meshes:
// poses, copies, old material models, names of files, and lists with mistakes in them.
#include "tests/scenes/gltf/gltf_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace meninas::test {

using testing::HasSubstr;

static Point3 corner(const Scene& scene, std::size_t vertex) {
  return scene.vertices.at(vertex).position;
}

TEST(GltfExporters, SkinsFollowTheirJointsAndNotTheirNode) {
  auto file = skinned_square();
  const auto scene = load(file);
  EXPECT_EQ(corner(scene, 0), Point3(1, 2, 0)) << "the root's and the arm's translation";
  EXPECT_TRUE(warns(scene, {"skins stand still", "'Quad'"}));

  // x = J B x_0: bound one metre to the right, the mesh hangs one to the left of its joint.
  std::vector<float> matrices(32, 0.0f);
  for (const std::size_t k : {0, 5, 10, 15, 16, 21, 26, 31})
    matrices[k] = 1.0f;
  matrices[28] = -1.0f;
  file.json["skins"][0]["inverseBindMatrices"] = file.add_accessor<float>(matrices, "VEC4");
  auto& accessor = file.json["accessors"].back();
  accessor["type"] = "MAT4";
  accessor["count"] = 2;
  EXPECT_EQ(corner(load(file), 0), Point3(0, 2, 0));
  accessor["count"] = 1;
  EXPECT_THAT(error_of(file), HasSubstr("skins[0]: 1 inverse bind matrices for 2 joints"));
}

TEST(GltfExporters, SkinsBlendTheirJoints) {
  auto file = skinned_square();
  // Half of each joint, in weights that add up to 4: what exporters round is made one.
  auto& attributes = square_primitive(file)["attributes"];
  attributes["JOINTS_0"] =
      file.add_accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  attributes["WEIGHTS_0"] =
      file.add_accessor<float>({2, 2, 0, 0, 2, 2, 0, 0, 2, 2, 0, 0, 2, 2, 0, 0}, "VEC4");
  EXPECT_EQ(corner(load(file), 0), Point3(1, 1, 0));
}

TEST(GltfExporters, SkinsThatPointNowhereAreNamed) {
  auto far = skinned_square();
  far.json["skins"][0]["joints"] = {1};
  EXPECT_THAT(error_of(far), HasSubstr("vertex 0 follows joint 1 of 1"));

  auto elsewhere = skinned_square();
  elsewhere.json["scenes"] = Json::array({{{"nodes", {0}}}});
  const auto scene = load(elsewhere);
  EXPECT_EQ(corner(scene, 0), Point3(100, 100, 100)) << "then the node is all there is";
  EXPECT_TRUE(warns(scene, {"skins without joints", "'Quad'"}));
}

TEST(GltfExporters, MorphTargetsStandByTheirDefaultWeights) {
  auto file = morphed_square();
  file.json["meshes"][0].erase("weights");
  EXPECT_EQ(corner(load(file), 0), Point3(0, 0, 0)) << "weights are zero by default";
  file.json["meshes"][0]["weights"] = {1.0, 0.25};
  EXPECT_EQ(corner(load(file), 0), Point3(0, 0, 1));
  file.json["nodes"][0]["weights"] = {0.0, -0.5};
  const auto scene = load(file);
  EXPECT_EQ(corner(scene, 0), Point3(0, 0, -2)) << "the node's weights before the mesh's";
  EXPECT_TRUE(warns(scene, {"morph targets", "'Quad'"}));
  file.json["accessors"].back()["count"] = 3;
  EXPECT_THAT(error_of(file), HasSubstr("target 1 has 3 elements, POSITION has 4"));
}

TEST(GltfExporters, InstancesAreCopies) {
  auto file = instanced_square();
  const auto scene = load(file);
  ASSERT_EQ(scene.triangles.size(), 4u);
  EXPECT_EQ(scene.nodes.size(), 1u) << "all copies are one node";
  EXPECT_NEAR(normal(scene, 0).z, 1.0, 1e-12);
  EXPECT_NEAR(normal(scene, 2).z, -4.0, 1e-12) << "turned about y by 180 degrees, twice as large";
  EXPECT_NEAR(corner(scene, 4).z, 5.0, 1e-12);

  file.json["accessors"].back()["count"] = 1;
  EXPECT_THAT(error_of(file), HasSubstr("nodes[0] 'Quad', EXT_mesh_gpu_instancing"));

  auto none = square();
  none.add_node({{"name", "Nowhere"},
                 {"mesh", 0},
                 {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", Json::object()}}}}}});
  EXPECT_TRUE(warns(load(none), {"without an instance", "'Nowhere'"}));
}

/// Two instances and a node of its own: texture coordinates and colours are in memory once, and each copy has its own.
TEST(GltfExporters, CopiesShareWhatTheFileTellsOnce) {
  auto file = instanced_square();
  EXPECT_TRUE(load(file).attributes.empty()) << "nothing is told of its vertices";
  square_primitive(file)["attributes"]["TEXCOORD_0"] =
      file.add_accessor<float>({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  file.add_node({{"name", "Another"}, {"mesh", 0}, {"translation", {0, 0, 50}}});
  const Scene scene = load(file);
  ASSERT_EQ(scene.vertices.size(), 12U);
  EXPECT_EQ(scene.attributes.size(), 4U);
  for (std::size_t v = 0; v < 12; ++v)
    EXPECT_EQ(attributes_of(scene, scene.vertices[v]).texcoord[0],
              attributes_of(scene, scene.vertices[v % 4]).texcoord[0])
        << v;
  EXPECT_NE(attributes_of(scene, scene.vertices[0]).texcoord[0],
            attributes_of(scene, scene.vertices[2]).texcoord[0]);

  // One that is changed afterwards changes alone.
  Scene changed = scene;
  own_attributes(changed, changed.vertices[5]).color = glm::vec4(0.5F);
  EXPECT_EQ(attributes_of(changed, changed.vertices[1]).color, glm::vec4(1.0F));
  EXPECT_EQ(attributes_of(changed, changed.vertices[5]).texcoord[0],
            attributes_of(changed, changed.vertices[1]).texcoord[0]);
  EXPECT_EQ(content_hash(load(file)), content_hash(scene));
  EXPECT_NE(content_hash(changed), content_hash(scene));
}

// A file as an exporter of buildings writes it:
// thousands of nodes and materials, some without names, many with the same.
TEST(GltfExporters, ThousandsOfNodesAndMaterials) {
  constexpr int nodes = 5000, materials = 2000;
  auto file = square();
  const auto mesh_of = [&](int k) {
    auto primitive = square_primitive(file);
    primitive["material"] = k;
    return primitive;
  };
  file.json["materials"] = Json::array();
  file.json["nodes"] = Json::array();
  file.json["scenes"][0]["nodes"] = Json::array();
  std::vector<Json> primitives;
  for (int k = 0; k < materials; ++k) {
    file.add_material(
        {{"name", "Paint"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {k / double(materials), 0.5, 0.5, 1}}, {"metallicFactor", 0}}}});
    primitives.push_back(mesh_of(k));
  }
  file.json["meshes"] = Json::array();
  for (Json& primitive : primitives)
    file.add_mesh(Json::array({std::move(primitive)}));
  for (int k = 0; k < nodes; ++k) {
    Json node{{"mesh", k % materials}, {"translation", {0, 0, k}}};
    if (k % 2 == 0)
      node["name"] = "Chair";
    file.json["scenes"][0]["nodes"].push_back(file.add_node(std::move(node)));
  }
  const auto scene = load(file);
  ASSERT_EQ(scene.nodes.size(), std::size_t{nodes});
  ASSERT_EQ(scene.triangles.size(), 2u * nodes);
  std::set<std::string> names;
  for (const Node& node : scene.nodes)
    names.insert(node.name);
  EXPECT_EQ(names.size(), std::size_t{nodes}) << "every node can be named";
  for (const std::size_t k : {0, 1, 1999, 2000, 4999}) {
    const Triangle& triangle = scene.triangles[2 * k];
    EXPECT_EQ(index(triangle.node), k);
    EXPECT_NEAR(material_of(scene, static_cast<TriangleId>(2 * k)).base_color.r,
                double(k % materials) / materials, 1e-12);
  }
}

TEST(GltfExporters, InstancesAndTargetsCountAgainstTheMemoryLimit) {
  auto file = square();
  const auto moves = file.add_accessor<float>({0, 0, 0}, "VEC3");
  file.json["accessors"][moves].erase("bufferView");
  file.json["accessors"][moves]["count"] = 100'000'000;
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", moves}};
  EXPECT_THAT(error_of(file), HasSubstr("the memory limit is 4096 MiB"));

  auto morphed = square();
  for (int k = 0; k < 1000; ++k)
    square_primitive(morphed)["targets"].push_back({{"POSITION", 0}});
  EXPECT_EQ(error_of(morphed, {.memory_limit = 1 << 20}), "no error");
  EXPECT_THAT(error_of(morphed, {.memory_limit = 1 << 16}), HasSubstr("memory limit"));
}

TEST(GltfExporters, SpecularGlossinessBecomesMetallicRoughness) {
  auto file = square();
  const auto read = [&](Json model) {
    file.json["materials"][0] = {
        {"name", "Old"},
        {"extensions", {{"KHR_materials_pbrSpecularGlossiness", std::move(model)}}}};
    return load(file).materials.at(0);
  };
  const auto paint = read({{"diffuseFactor", {0.5, 0.25, 0.125, 1}},
                           {"specularFactor", {0.04, 0.04, 0.04}},
                           {"glossinessFactor", 0.25}});
  EXPECT_EQ(paint.metallic, 0.0);
  EXPECT_NEAR(paint.base_color.r, 0.5, 1e-12);
  EXPECT_NEAR(paint.base_color.b, 0.125, 1e-12);
  EXPECT_EQ(paint.roughness, 0.75);

  const auto gold = read({{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1.0, 0.75, 0.25}}});
  EXPECT_NEAR(gold.metallic, 1.0, 1e-12);
  EXPECT_NEAR(gold.base_color.g, 0.75, 1e-12);
  EXPECT_TRUE(is_mirror(gold)) << "glossiness is 1 by default";

  file.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  const auto textured = read({{"specularGlossinessTexture", {{"index", 0}}}});
  EXPECT_EQ(diffuse_reflectance(textured), Rgb(1.0)) << "never black for want of a texture";
}

TEST(GltfExporters, RequiredLooksAreLeftOutAndRequiredGeometryIsNot) {
  auto file = square();
  file.json["extensionsRequired"] = {"KHR_texture_basisu", "KHR_materials_later",
                                     "KHR_techniques_webgl"};
  const auto scene = load(file);
  EXPECT_TRUE(warns(scene, {"calls required", "'KHR_texture_basisu'", "'KHR_materials_later'",
                            "'KHR_techniques_webgl'"}));
  file.json["extensionsRequired"] = {"ACME_shape"};
  EXPECT_THAT(error_of(file), HasSubstr("needs ACME_shape, which is not read"));
}

TEST(GltfExporters, ScenesThatListNodesTooOftenShowThemOnce) {
  auto file = square();
  file.add_node({{"name", "Parent"}, {"children", {0}}, {"translation", {0, 0, 3}}});
  file.json["scenes"] = Json::array({{{"nodes", {1, 0, 1}}}});
  const auto scene = load(file);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(corner(scene, 0).z, 3.0);
  EXPECT_TRUE(warns(scene, {"lists nodes that are also children", "'Quad'"}));
  EXPECT_TRUE(warns(scene, {"lists nodes twice", "'Parent'"}));
}

TEST(GltfExporters, ScenesMayBeginBelowTheRoot) {
  auto file = square();
  file.add_node({{"name", "Left out"}, {"children", {0}}, {"translation", {0, 0, 3}}});
  file.json["scenes"] = Json::array({{{"nodes", {0}}}});
  const auto scene = load(file);
  EXPECT_EQ(corner(scene, 0).z, 0.0) << "what is not in the scene does not move it";
  EXPECT_TRUE(warns(scene, {"begins at nodes whose parents", "'Quad'"}));
}

TEST(GltfExporters, ImagesTooLargeForTheMemoryAreLeftOutBeforeTheyAreDecoded) {
  // The header of a PNG of 60,000 x 60,000 pixels; there is nothing behind it.
  const Bytes png{0x89, 'P', 'N', 'G',  '\r', '\n', 0x1a, '\n', 0,    0, 0, 13, 'I', 'H', 'D',
                  'R',  0,   0,   0xEA, 0x60, 0,    0,    0xEA, 0x60, 8, 2, 0,  0,   0};
  auto file = square();
  file.json["images"] = Json::array({{{"bufferView", file.add_view(png)}}});
  file.json["textures"] = Json::array({{{"source", 0}}});
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const auto scene = load(file);
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_TRUE(warns(scene, {"images[0]: 60000 x 60000 pixels", "over the memory limit"}));
  EXPECT_EQ(load(file, {.memory_limit = std::uint64_t{1} << 40}).textures.size(), 1u);
}

TEST(GltfExporters, PrimitivesWithoutPositionsAreLeftOut) {
  auto file = square();
  file.json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}});
  const auto scene = load(file);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_TRUE(warns(scene, {"primitives without positions", "'Quad'"}));
}

TEST(GltfExporters, FileNamesAreFoundAsTheyAreMeant) {
  const TemporaryFolder folder;
  auto file = square();
  const auto& spellings =
      std::array<std::pair<const char*, const char*>, 5>{{{"my%20data.bin", "my data.bin"},
                                                          {"sub\\data.bin", "sub/data.bin"},
                                                          {"50%25.bin", "50%.bin"},
                                                          {"raw%41.bin", "raw%41.bin"},
                                                          {"Wall:2.bin", "Wall:2.bin"}}};
  for (const auto& [uri, name] : spellings) {
    folder.write(name, file.data);
    file.json["buffers"] = Json::array({{{"uri", uri}, {"byteLength", file.data.size()}}});
    EXPECT_EQ(error_of(folder.write("scene.gltf", file.json.dump())), "no error") << uri;
  }
}

TEST(GltfExporters, WebpTexturesAreTakenWhereThereIsNoOther) {
  auto file = square();
  file.json["images"] = Json::array(
      {{{"bufferView", 0}, {"name", "first"}}, {{"bufferView", 0}, {"name", "second"}}});
  file.json["textures"] =
      Json::array({{{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}},
                   {{"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}}});
  auto& texture = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"];
  texture = 0;
  EXPECT_EQ(load(file).textures.at(0).name, "second");
  texture = 1;
  const auto scene = load(file);
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_TRUE(warns(scene, {"there is only KHR_texture_basisu", "'grey'"}));
}

} // namespace meninas::test
