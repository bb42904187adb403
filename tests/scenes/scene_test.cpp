#include "scenes/errors.h"
#include "scenes/names.h"
#include "scenes/scene.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

Scene rich_scene() {
  Scene scene;
  scene.file = "rich.gltf";
  add_room(scene, Point3(0.0), {1.0, 2.0, 3.0},
           {diffuse(0.5), diffuse(0.5, 2.0), mirror(0.9), {}, {}, {}});
  scene.textures.push_back(
      {.name = "wood.png", .encoded = std::vector<std::byte>(19, std::byte{7})});
  scene.materials[0].base_color_texture = TextureUse{TextureId{0}};
  scene.lights.push_back({});
  scene.cameras.push_back(look_at({0.5, 1.0, 2.5}, Point3(0.5, 1.0, 0.0), 0.9));
  scene.cameras.back().name = "eye";
  return scene;
}

TEST(Scene, AreaVectorPointsToTheFront) {
  EXPECT_EQ(area_vector({Point3(0, 0, 0), {2, 0, 0}, {0, 3, 0}}), Vec3(0, 0, 3));
}

TEST(Scene, BoundsOfTheTriangles) {
  Scene scene;
  add_polygon(scene, "p", {{-1, 2, 3}, {4, 2, 3}, {4, 7, 9}}, {});
  // A vertex that no triangle uses is not there.
  scene.vertices.push_back({.position = Point3(100.0)});
  const Bounds bounds = bounds_of(scene);
  EXPECT_EQ(bounds.low, Point3(-1, 2, 3));
  EXPECT_EQ(bounds.high, Point3(4, 7, 9));
  EXPECT_EQ(bounds_of({}).low.x, std::numeric_limits<double>::infinity());
}

TEST(ContentHash, IgnoresWhatLightDoesNotSee) {
  const std::uint64_t hash = content_hash(rich_scene());
  Scene scene = rich_scene();
  scene.file = "other.glb";
  scene.nodes[0].name = "renamed";
  scene.materials[0].name = "renamed";
  scene.textures[0].name = "renamed";
  scene.lights[0].name = "renamed";
  scene.cameras.clear();
  scene.warnings.push_back("x");
  scene.ignored.push_back("x");
  EXPECT_EQ(content_hash(scene), hash);
  scene.vertices[0].position.x = -0.0;
  ASSERT_EQ(rich_scene().vertices[0].position.x, 0.0);
  EXPECT_EQ(content_hash(scene), hash);
}

TEST(ContentHash, SeesEveryPropertyLightDependsOn) {
  using Change = void (*)(Scene&);
  const std::vector<Change> changes{
      [](Scene& s) { s.vertices[3].position.y = std::nextafter(s.vertices[3].position.y, 9.0); },
      [](Scene& s) { own_attributes(s, s.vertices[3]).texcoord[0].x += 0.5F; },
      [](Scene& s) { own_attributes(s, s.vertices[3]).texcoord[1].y += 0.5F; },
      [](Scene& s) { s.vertices.push_back({}); },
      [](Scene& s) { std::swap(s.triangles[0], s.triangles[1]); },
      [](Scene& s) { std::swap(s.triangles[0].vertices[0], s.triangles[0].vertices[1]); },
      [](Scene& s) { s.triangles[0].material = MaterialId{2}; },
      [](Scene& s) { s.triangles.pop_back(); },
      [](Scene& s) { s.materials[1].base_color.g += 0.01; },
      [](Scene& s) { s.materials[1].metallic = 0.3; },
      [](Scene& s) { s.materials[1].roughness = 0.3; },
      [](Scene& s) { s.materials[1].emission.b += 1e-12; },
      [](Scene& s) { s.materials[1].double_sided = true; },
      [](Scene& s) { s.materials[1].ior = 1.4; },
      [](Scene& s) { s.materials[1].specular = 0.5; },
      [](Scene& s) { s.materials[1].specular_color.r = 0.5; },
      [](Scene& s) { s.materials[1].transmission = 0.5; },
      [](Scene& s) { s.materials[1].alpha_mode = AlphaMode::blend; },
      [](Scene& s) { s.materials[1].alpha_cutoff = 0.4; },
      [](Scene& s) { s.materials[0].base_color_texture.reset(); },
      [](Scene& s) { s.materials[0].emissive_texture = s.materials[0].base_color_texture; },
      [](Scene& s) { s.materials[0].metallic_roughness_texture = TextureUse{}; },
      [](Scene& s) { s.materials[0].transmission_texture = TextureUse{}; },
      [](Scene& s) { s.materials[0].thickness_texture = TextureUse{}; },
      [](Scene& s) { s.materials[0].specular_texture = TextureUse{}; },
      [](Scene& s) { s.materials[0].specular_color_texture = TextureUse{}; },
      [](Scene& s) { s.materials[0].clear_coat = 0.5; },
      [](Scene& s) { s.materials[0].base_color_texture->texcoord_set = 1; },
      [](Scene& s) { s.materials[0].base_color_texture->offset.y = 0.1; },
      [](Scene& s) { s.materials[0].base_color_texture->rotation = 0.1; },
      [](Scene& s) { s.materials[0].base_color_texture->scale.x = 2.0; },
      [](Scene& s) { s.textures[0].encoded[17] = std::byte{8}; },
      [](Scene& s) { s.textures[0].encoded.push_back(std::byte{0}); },
      [](Scene& s) { s.textures[0].wrap_v = Wrap::clamp; },
      [](Scene& s) { s.textures[0].wrap_u = Wrap::mirrored; },
      [](Scene& s) { s.textures[0].magnified = TexelFilter::nearest; },
      [](Scene& s) { own_attributes(s, s.vertices[3]).color.g = 0.5F; },
      [](Scene& s) { own_attributes(s, s.vertices[3]).color.a = 0.5F; },
      [](Scene& s) { s.lights[0].kind = PunctualKind::spot; },
      [](Scene& s) { s.lights[0].intensity.r = 2.0; },
      [](Scene& s) { s.lights[0].position.x = 2.0; },
      [](Scene& s) {
        s.lights[0].direction = {1, 0, 0};
      },
      [](Scene& s) { s.lights[0].outer_cone = 0.5; },
      [](Scene& s) { s.lights[0].inner_cone = 0.5; },
  };
  std::vector<std::uint64_t> hashes{content_hash(rich_scene())};
  for (const Change change : changes) {
    Scene scene = rich_scene();
    change(scene);
    hashes.push_back(content_hash(scene));
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no UsageError";
}

TEST(Names, NodesAndCamerasAreFound) {
  const Scene scene = rich_scene();
  EXPECT_EQ(find_node(scene, "y0"), NodeId{2});
  EXPECT_EQ(&find_camera(scene, "eye"), &scene.cameras[0]);
}

TEST(Names, TheNearestOneIsSuggested) {
  Scene scene;
  scene.file = "room.gltf";
  scene.nodes = {{"floor"}, {"mirror"}, {"mirror frame"}};
  EXPECT_EQ(message_of([&] { find_node(scene, "mirorr"); }),
            "room.gltf: no node 'mirorr', did you mean 'mirror'?");
  EXPECT_EQ(message_of([&] { find_node(scene, "chandelier"); }),
            "room.gltf: no node 'chandelier' among 3 nodes such as 'floor'");
  EXPECT_EQ(message_of([&] { find_camera(scene, "eye"); }),
            "room.gltf: no camera 'eye', the scene has no cameras");
  scene.cameras.push_back({.name = "front"});
  EXPECT_EQ(message_of([&] { find_camera(scene, "eye"); }),
            "room.gltf: no camera 'eye', there is only 'front'");
}

TEST(Names, NearestName) {
  const std::vector<std::string> known{"render", "solve", "plan", "formfactors", "compare"};
  EXPECT_EQ(nearest_name("rendre", known), "render");
  EXPECT_EQ(nearest_name("PLAN", known), "plan");
  EXPECT_EQ(nearest_name("formfactor", known), "formfactors");
  EXPECT_EQ(nearest_name("slove", known), "solve");
  EXPECT_EQ(nearest_name("teapot", known), std::nullopt);
  EXPECT_EQ(nearest_name("", known), std::nullopt);
  EXPECT_EQ(nearest_name("render", {}), std::nullopt);
  const std::vector<std::string> long_names{std::string(1000000, 'x')};
  EXPECT_EQ(nearest_name(std::string(1000000, 'y'), long_names), std::nullopt);
}

} // namespace
} // namespace meninas::test
