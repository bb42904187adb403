// What a solution shows to viewers: by the document of the GLB, read as one.
#include "radiosity/mesh/make_mesh.h"
#include "radiosity/scene/plan.h"
#include "radiosity/solution/viewer_scene.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace meninas::test {
namespace {

using nlohmann::json;

std::vector<Point3> square_at(double x) {
  return {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
}

/// One square to each material, with the same light everywhere.
class ViewerSceneTest : public testing::Test {
protected:
  void add(const std::string& name, const Material& material) {
    Material named = material;
    named.name = name + "-stuff";
    add_polygon(scene_, name, square_at(2.0 * double(scene_.nodes.size())), named);
  }

  void write() {
    surfaces_ = find_surfaces(scene_);
    settings_.element_size = 0.5;
    mesh_ = make_element_mesh(scene_, surfaces_, settings_);
    plan_ = plan_transport(scene_, surfaces_);
    rays_.emplace(make_ray_scene(scene_, surfaces_));
    field_.scene = std::make_shared<const LightScene>(make_light_scene(
        scene_, surfaces_, *rays_, {plan_.mirrors, plan_.worlds}, mesh_));
    field_.irradiance.assign(mesh_.vertices.size(), glm::vec3(1.0F, 0.5F, 0.25F));
    shown_ = viewer_scene(glb_, field_);
  }

  json node(const std::string& name) const {
    for (const json& node : shown_.document.at("nodes"))
      if (node.at("name") == name)
        return node;
    return nullptr;
  }
  json primitive(const std::string& name) const {
    return shown_.document.at("meshes")
        .at(node(name).at("mesh").get<std::size_t>())
        .at("primitives")
        .at(0);
  }
  json material(const std::string& name) const {
    return shown_.document.at("materials").at(primitive(name).at("material").get<std::size_t>());
  }

  template <typename Item>
  std::vector<Item> values(const std::string& name, const std::string& attribute) const {
    const json& accessor =
        glb_.accessors.at(primitive(name).at("attributes").at(attribute).get<std::size_t>());
    const json& view = glb_.views.at(accessor.at("bufferView").get<std::size_t>());
    std::vector<Item> items(accessor.at("count").get<std::size_t>());
    std::memcpy(items.data(),
                glb_.binary.data() + view.at("byteOffset").get<std::size_t>() +
                    accessor.at("byteOffset").get<std::size_t>(),
                items.size() * sizeof(Item));
    return items;
  }

  Scene scene_;
  SurfaceModel surfaces_;
  MeshSettings settings_;
  ElementMesh mesh_;
  TransportPlan plan_;
  std::optional<RayScene> rays_;
  IrradianceField field_;
  GlbArrays glb_;
  ViewerScene shown_;
};

// COLOR_0 = s (E + rho H), in floats.
TEST_F(ViewerSceneTest, LitFacesHaveTheRadiosityAsTheirColour) {
  add("wall", diffuse(0.5));
  add("lamp", diffuse(0.25, 0.125));
  write();
  const auto wall = values<glm::vec4>("wall", "COLOR_0"), lamp = values<glm::vec4>("lamp", "COLOR_0");
  EXPECT_EQ(wall.size(), 9U) << "each piece names its own range alone";
  for (const glm::vec4& colour : wall)
    EXPECT_NEAR(colour.b, shown_.scale * 0.5 * 0.25, 1e-6);
  for (const glm::vec4& colour : lamp)
    EXPECT_NEAR(colour.b, shown_.scale * (0.125 + 0.25 * 0.25), 1e-6);
  EXPECT_TRUE(material("wall").at("extensions").contains("KHR_materials_unlit"));
  EXPECT_EQ(material("wall").at("name"), "wall-stuff");
  EXPECT_EQ(values<glm::vec3>("wall", "_IRRADIANCE").at(0), glm::vec3(1.0F, 0.5F, 0.25F));
}

TEST_F(ViewerSceneTest, MirrorsAreMetalOfNoRoughness) {
  add("wall", diffuse(0.5));
  add("glass", mirror(0.9));
  write();
  const json metal = material("glass").at("pbrMetallicRoughness");
  EXPECT_EQ(metal.at("metallicFactor"), 1.0);
  EXPECT_EQ(metal.at("roughnessFactor"), 0.0);
  EXPECT_EQ(metal.at("baseColorFactor"), json({0.9, 0.9, 0.9, 1.0}));
  EXPECT_FALSE(material("glass").contains("extensions"));
  EXPECT_EQ(values<glm::vec3>("glass", "NORMAL").at(0), glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST_F(ViewerSceneTest, PanesAndSolidsPassLight) {
  add("wall", diffuse(0.5));
  Material pane = double_sided(diffuse(0.9));
  pane.transmission = 1.0;
  pane.roughness = 0.0;
  pane.ior = 1.6;
  add("pane", pane);
  pane.thickness = 0.25;
  pane.attenuation_color = {0.5, 0.25, 0.125};
  pane.attenuation_distance = 2.0;
  add("solid", pane);
  write();
  const json glass = material("pane").at("extensions"), solid = material("solid").at("extensions");
  EXPECT_EQ(glass.at("KHR_materials_transmission").at("transmissionFactor"), 1.0);
  EXPECT_EQ(glass.at("KHR_materials_ior").at("ior"), 1.6);
  EXPECT_FALSE(glass.contains("KHR_materials_volume"));
  EXPECT_EQ(material("pane").at("doubleSided"), true);
  EXPECT_EQ(values<glm::vec3>("pane", "POSITION").size(), 6U) << "once, though it has two sides";
  EXPECT_EQ(solid.at("KHR_materials_volume").at("thicknessFactor"), 0.25);
  EXPECT_EQ(solid.at("KHR_materials_volume").at("attenuationDistance"), 2.0);
  EXPECT_EQ(material("solid").at("doubleSided"), false);
}

// A viewer weighs with alpha: the colour is that of the share that is there.
TEST_F(ViewerSceneTest, AlphaIsTheViewersToWeighWith) {
  add("wall", diffuse(0.5));
  Material veil = double_sided(diffuse(0.5));
  veil.alpha = 0.25;
  veil.alpha_mode = AlphaMode::blend;
  veil.transmission = 0.75; // as the loader has it
  add("veil", veil);
  Material leaf = diffuse(0.5);
  leaf.alpha_mode = AlphaMode::mask;
  leaf.alpha_cutoff = 0.375;
  add("leaf", leaf);
  write();
  EXPECT_EQ(material("veil").at("alphaMode"), "BLEND");
  EXPECT_EQ(material("veil").at("pbrMetallicRoughness").at("baseColorFactor").at(3), 0.25);
  for (const glm::vec4& colour : values<glm::vec4>("veil", "COLOR_0"))
    EXPECT_NEAR(colour.b, shown_.scale * 0.5 * 0.25, 1e-6);
  EXPECT_EQ(material("leaf").at("alphaMode"), "MASK");
  EXPECT_EQ(material("leaf").at("alphaCutoff"), 0.375);
}

// B = pi L of what shows its colour whatever light it receives.
TEST_F(ViewerSceneTest, UnlitSurfacesShowTheirColour) {
  add("wall", diffuse(0.5));
  Material sign = diffuse(0.0625);
  sign.unlit = true;
  add("sign", sign);
  write();
  for (const glm::vec4& colour : values<glm::vec4>("sign", "COLOR_0"))
    EXPECT_NEAR(colour.b, std::min(1.0, shown_.scale * std::numbers::pi * 0.0625), 1e-6);
}

TEST_F(ViewerSceneTest, TexturesAreThereWithTheirPlaces) {
  add("wall", diffuse(0.5));
  Material picture = diffuse(Rgb(0.5));
  picture.base_color_texture = TextureUse{.texture = TextureId{0}, .scale = Vec2(2.0)};
  add("picture", picture);
  Texture texture;
  texture.name = "image";
  for (const char c : {'\x89', 'P', 'N', 'G'})
    texture.encoded.push_back(static_cast<std::byte>(c));
  texture.wrap_u = Wrap::clamp;
  scene_.textures.push_back(texture);
  const auto corners = scene_.triangles.back().vertices;
  own_attributes(scene_, scene_.vertices[index(corners[1])]).texcoord[0] = {1.0F, 1.0F};
  write();
  const json colour = material("picture").at("pbrMetallicRoughness");
  EXPECT_EQ(colour.at("baseColorTexture").at("index"), 0);
  EXPECT_EQ(shown_.document.at("images").at(0).at("mimeType"), "image/png");
  EXPECT_EQ(shown_.document.at("samplers").at(0).at("wrapS"), 33071);
  const auto places = values<glm::vec2>("picture", "TEXCOORD_0");
  EXPECT_THAT(places, testing::Contains(glm::vec2(2.0F, 2.0F))) << "after its transform";
  EXPECT_EQ(places.size(), values<glm::vec3>("picture", "POSITION").size());
  EXPECT_FALSE(primitive("wall").at("attributes").contains("TEXCOORD_0"));
}

TEST_F(ViewerSceneTest, CamerasStandWhereTheyStood) {
  add("wall", diffuse(0.5));
  Camera camera = look_at({0.5, 0.25, 4.0}, {0.5, 0.25, 0.0}, 0.75);
  camera.name = "main";
  camera.aspect = 1.5;
  scene_.cameras.push_back(camera);
  write();
  EXPECT_EQ(node("main").at("camera"), 0);
  const json matrix = node("main").at("matrix");
  EXPECT_NEAR(matrix.at(12).get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(matrix.at(14).get<double>(), 4.0, 1e-12);
  EXPECT_NEAR(matrix.at(10).get<double>(), 1.0, 1e-12) << "along -z";
  const json lens = shown_.document.at("cameras").at(0).at("perspective");
  EXPECT_EQ(lens.at("yfov"), 0.75);
  EXPECT_EQ(lens.at("aspectRatio"), 1.5);
}

// The room lies far from the origin: that says nothing about what the camera sees.
TEST_F(ViewerSceneTest, OrthographicCamerasReachTheFarEndOfTheScene) {
  add_polygon(scene_, "wall", {{1000, 0, 0}, {1001, 0, 0}, {1001, 1, 0}, {1000, 1, 0}}, diffuse(0.5));
  Camera camera = look_at({1000.5, 0.5, 4.0}, {1000.5, 0.5, 0.0}, 0.75);
  camera.projection = Projection::orthographic;
  scene_.cameras.push_back(camera);
  write();
  const json lens = shown_.document.at("cameras").at(0).at("orthographic");
  EXPECT_NEAR(lens.at("zfar").get<double>(), 4.0 + std::numbers::sqrt2, 1e-9);
}

} // namespace
} // namespace meninas::test
