// Hierarchies, scenes, names, cameras and lights.
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {

// Products of a few rotations in doubles: 1e-15 of rounding each.
static constexpr double rounding = 1e-14;

static void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = rounding) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.z, expected.z, tolerance);
}

static std::vector<std::string> names_of(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things)
    names.push_back(thing.name);
  return names;
}

TEST(GltfNodes, ComposesTranslationRotationAndScale) {
  auto file = square();
  // Scale 2 along x, a quarter turn about z, then 10 along x:
  // (1, 0, 0) -> (2, 0, 0) -> (0, 2, 0) -> (10, 2, 0).
  file.json["nodes"][0]["translation"] = {10.0, 0.0, 0.0};
  file.json["nodes"][0]["rotation"] = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)};
  file.json["nodes"][0]["scale"] = {2.0, 1.0, 1.0};
  const auto scene = load(file);
  expect_near(scene.vertices[1].position, {10.0, 2.0, 0.0});
  expect_near(scene.vertices[2].position, {9.0, 2.0, 0.0});
}

TEST(GltfNodes, ComposesParentsAndMatrices) {
  auto file = square();
  file.add_node({{"children", {2}}, {"translation", {0.0, 5.0, 0.0}}});
  file.add_node({{"children", {0}}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1}}});
  file.json["scenes"] = Json::array({{{"nodes", {1}}}});
  const auto scene = load(file);
  // (1, 0, 0) turned to (0, 1, 0), moved by (7, 0, 0), then by (0, 5, 0).
  EXPECT_EQ(scene.vertices[1].position, Point3(7, 6, 0));
  EXPECT_EQ(normal(scene, 0), Vec3(0, 0, 1));
}

TEST(GltfNodes, MirroredNodesKeepTheFrontInFront) {
  auto file = square();
  file.json["nodes"][0]["scale"] = {-1.0, 1.0, 1.0};
  EXPECT_EQ(normal(load(file), 0), Vec3(0, 0, 1));
  file.json["nodes"][0]["scale"] = {1.0, 1.0, -1.0};
  EXPECT_EQ(normal(load(file), 0), Vec3(0, 0, -1))
      << "a front towards +z mirrored in z looks to -z";
  file.json["nodes"][0]["scale"] = {-1.0, -1.0, 1.0};
  EXPECT_EQ(normal(load(file), 0), Vec3(0, 0, 1));
  // The sign must survive a determinant that underflows; the square has no extent along z.
  file.json["nodes"][0]["scale"] = {-1e-10, 1e-10, 1e-310};
  EXPECT_GT(normal(load(file), 0).z, 0.0);
}

TEST(GltfNodes, SingularMatricesMakeDegenerateTriangles) {
  auto file = square();
  file.add_node({{"mesh", 0}, {"name", "Flat"}, {"scale", {0.0, 1.0, 1.0}}});
  const auto scene = load(file);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.degenerate_triangles, 2u);
  EXPECT_TRUE(warns(scene, {"without area", "'Flat'"}));
  EXPECT_EQ(names_of(scene.nodes), (std::vector<std::string>{"Quad", "Flat"}));
}

TEST(GltfNodes, InstancesAreSeparateNodes) {
  auto file = square();
  file.add_node({{"mesh", 0}, {"translation", {0, 0, 3}}});
  const auto scene = load(file);
  ASSERT_EQ(scene.triangles.size(), 4u);
  EXPECT_EQ(index(scene.triangles[3].node), 1u);
  EXPECT_EQ(scene.vertices[4].position, Point3(0, 0, 3));
  EXPECT_EQ(scene.nodes[1].name, "node1");
}

TEST(GltfNodes, NamesBecomeUniqueWithoutTakingGivenOnes) {
  auto file = square();
  file.json["nodes"][0]["name"] = "Box";
  for (const auto* name : {"Box", "Box.1", "Box", ""})
    file.add_node({{"mesh", 0}, {"name", name}});
  file.add_node({{"mesh", 0}, {"name", "line\nbreak"}});
  EXPECT_EQ(names_of(load(file).nodes),
            (std::vector<std::string>{"Box", "Box.2", "Box.1", "Box.3", "node4", "line break"}));
}

TEST(GltfNodes, ChoosesTheScene) {
  auto file = square();
  file.add_node({{"mesh", 0}, {"name", "Other"}});
  file.add_node({{"mesh", 0}, {"name", "Third"}});
  EXPECT_EQ(load(file).nodes.size(), 3u) << "without scenes, all roots";

  file.json["scenes"] = Json::array({{{"nodes", {1}}}, {{"name", "Hall"}, {"nodes", {2, 0}}}});
  EXPECT_EQ(names_of(load(file).nodes), (std::vector<std::string>{"Other"}))
      << "without a default, the first";
  file.json["scene"] = 1;
  EXPECT_EQ(names_of(load(file).nodes), (std::vector<std::string>{"Third", "Quad"}));
  EXPECT_EQ(names_of(load(file, {.scene = "0"}).nodes), (std::vector<std::string>{"Other"}));
  EXPECT_EQ(names_of(load(file, {.scene = "Hall"}).nodes),
            (std::vector<std::string>{"Third", "Quad"}));
  EXPECT_THAT(error_of(file, {.scene = "Hal"}),
              testing::HasSubstr("scene 'Hal': the file has '0', 'Hall'"));
}

// Reading takes a time that is linear in their number.
TEST(GltfNodes, AHundredThousandNodesInOneList) {
  auto file = square();
  std::string nodes = file.json["nodes"].dump();
  nodes.pop_back();
  for (int k = 1; k < 100'000; ++k)
    nodes += ",{}";
  file.json["nodes"] = "@";
  std::string text = as_text(file);
  text.replace(text.find("\"@\""), 3, nodes + "]");
  const TemporaryFolder folder;
  EXPECT_EQ(load_gltf(folder.write("many.gltf", text)).triangles.size(), 2u);
}

TEST(GltfNodes, DeepChainsDoNotRecurse) {
  auto file = square();
  constexpr std::size_t depth = 50'000;
  for (std::size_t k = 1; k <= depth; ++k)
    file.add_node({{"children", {k == depth ? 0 : k + 1}}, {"translation", {0, 0, 1}}});
  file.json["scenes"] = Json::array({{{"nodes", {1}}}});
  EXPECT_EQ(load(file).vertices[0].position, Point3(0, 0, depth));
}

TEST(GltfNodes, UnnormalisedRotationsAreRotations) {
  auto file = square();
  file.json["nodes"][0]["rotation"] = {0.0, 0.0, 3e200, 3e200};
  const auto scene = load(file);
  expect_near(scene.vertices[1].position, {0, 1, 0});
  EXPECT_TRUE(warns(scene, {"no unit quaternions", "'Quad'"}));
}

static GltfFile with_camera(Json camera, Json node = Json::object()) {
  auto file = square();
  file.json["cameras"] = Json::array({std::move(camera)});
  node["camera"] = 0;
  file.add_node(std::move(node));
  return file;
}

TEST(GltfCameras, ReadsAPerspectiveCameraUnderScaleAndShear) {
  // A quarter turn about y looks along -x; scales and a mirrored axis must not bend the frame.
  auto file = with_camera({{"type", "perspective"},
                           {"perspective", {{"yfov", 0.7}, {"aspectRatio", 1.5}, {"znear", 0.1}}}},
                          {{"name", "Eye"},
                           {"translation", {1, 2, 3}},
                           {"rotation", {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)}},
                           {"scale", {-3.0, 5.0, 0.5}}});
  const auto scene = load(file);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const auto& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "Eye");
  EXPECT_EQ(camera.projection, Projection::perspective);
  EXPECT_EQ(camera.vertical_fov, 0.7);
  EXPECT_EQ(camera.aspect, 1.5);
  EXPECT_EQ(camera.position, Point3(1, 2, 3));
  expect_near(camera.forward, {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  expect_near(camera.right, {0, 0, -1});
}

TEST(GltfCameras, ReadsAnOrthographicCamera) {
  const auto scene = load(with_camera({{"name", "Plan"},
                                       {"type", "orthographic"},
                                       {"orthographic", {{"xmag", 6.0}, {"ymag", 2.0}}}}));
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "Plan");
  EXPECT_EQ(scene.cameras[0].projection, Projection::orthographic);
  EXPECT_EQ(scene.cameras[0].half_height, 2.0);
  EXPECT_EQ(scene.cameras[0].aspect, 3.0);
}

static Camera first_camera(const Json& extras, const Json& of_node = Json::object()) {
  const auto scene = load(with_camera({{"type", "perspective"},
                                       {"perspective", {{"yfov", 0.7}, {"aspectRatio", 1.5}}},
                                       {"extras", extras}},
                                      of_node));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  return scene.cameras.at(0);
}

TEST(GltfCameras, ReadTheirLensFromExtras) {
  EXPECT_EQ(first_camera(Json::object()).lens_radius, 0.0);
  const auto given = first_camera({{"fstop", 2.0}, {"focus_distance", 3.0}, {"focal_length", 50}});
  EXPECT_NEAR(given.lens_radius, 0.0125, 1e-15);
  EXPECT_EQ(given.focus_distance, 3.0);
  // 36 mm across the width of the frame: f = 18 mm / (1.5 tan 0.35).
  const auto assumed = first_camera({{"fstop", 2.0}, {"focus_distance", 3.0}});
  EXPECT_NEAR(assumed.lens_radius, 0.25 * 0.018 / (1.5 * std::tan(0.35)) , 1e-15);
  const auto by_node =
      first_camera(Json::object(), {{"extras", {{"fstop", 4}, {"focus_distance", 1}}}});
  EXPECT_NEAR(by_node.lens_radius, 0.5 * assumed.lens_radius, 1e-15);
  EXPECT_EQ(first_camera({{"sensor_fit", "AUTO"}}).sensor_fit, SensorFit::longer);
  EXPECT_EQ(first_camera({{"sensor_fit", "HORIZONTAL"}}).sensor_fit, SensorFit::horizontal);
  EXPECT_EQ(first_camera({{"sensor_fit", "VERTICAL"}}).sensor_fit, SensorFit::vertical);
  EXPECT_EQ(first_camera("anything").lens_radius, 0.0);
}

TEST(GltfCameras, SayWhichLensIsLeftOut) {
  for (const Json& extras : {Json{{"fstop", 2.0}}, Json{{"fstop", 0.0}, {"focus_distance", 1.0}},
                             Json{{"fstop", "wide"}, {"focus_distance", 1.0}},
                             Json{{"fstop", 1e-320}, {"focus_distance", 1.0}}}) {
    const auto scene = load(with_camera({{"type", "perspective"},
                                         {"perspective", {{"yfov", 0.7}}},
                                         {"extras", extras}}));
    EXPECT_EQ(scene.cameras.at(0).lens_radius, 0.0);
    EXPECT_TRUE(warns(scene, {"depth of field is left out"})) << extras;
  }
  const auto plan = load(with_camera({{"type", "orthographic"},
                                      {"orthographic", {{"xmag", 6.0}, {"ymag", 2.0}}},
                                      {"extras", {{"fstop", 2.0}, {"focus_distance", 1.0}}}}));
  EXPECT_TRUE(warns(plan, {"depth of field is left out", "orthographic"}));
  EXPECT_TRUE(warns(load(with_camera({{"type", "perspective"},
                                      {"perspective", {{"yfov", 0.7}}},
                                      {"extras", {{"sensor_fit", "FILL"}}}})),
                    {"sensor_fit that is not"}));
}

TEST(GltfCameras, NamesAreUnique) {
  auto file =
      with_camera({{"type", "perspective"}, {"perspective", {{"yfov", 0.7}}}}, {{"name", "Eye"}});
  file.add_node({{"name", "Eye"}, {"camera", 0}});
  file.add_node({{"camera", 0}});
  file.add_node({{"name", "Gone"}, {"camera", 0}, {"scale", {1, 1, 0}}});
  const auto scene = load(file);
  EXPECT_EQ(names_of(scene.cameras), (std::vector<std::string>{"Eye", "Eye.1", "camera0"}));
  EXPECT_EQ(scene.cameras[0].aspect, 0.0) << "left to the picture";
  EXPECT_TRUE(warns(scene, {"scaled to nothing", "'Gone'"}));
}

TEST(GltfCameras, AreNotFartherAwayThanRaysReach) {
  auto file = square();
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}},
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 1e300}, {"ymag", 1e300}, {"znear", 0}, {"zfar", 1}}}}};
  for (const double far : {1e9, 1e30, 1e300})
    file.add_node({{"camera", 0}, {"translation", {far, 1, 2}}});
  file.add_node({{"camera", 1}});
  const Scene scene = load(file);
  ASSERT_EQ(scene.cameras.size(), 4U);
  EXPECT_EQ(scene.cameras[0].position, Point3(1e9, 1, 2));
  for (const auto& camera : scene.cameras) {
    EXPECT_LE(glm::length(camera.position), 1e13) << camera.name;
    EXPECT_LE(camera.half_height, 1e13) << camera.name;
  }
  EXPECT_GT(scene.cameras[2].position.x, 1e11) << "still on its side";
  EXPECT_TRUE(warns(scene, {"too far away", "'camera0.1', 'camera0.2', 'camera1'"}))
      << scene.warnings.front();
}

TEST(GltfCameras, RefusesImpossibleProjections) {
  EXPECT_THAT(error_of(with_camera(
                  {{"name", "C"}, {"type", "perspective"}, {"perspective", {{"yfov", 4.0}}}})),
              testing::HasSubstr("cameras[0] 'C': yfov 4"));
  EXPECT_THAT(error_of(with_camera({{"type", "perspective"}, {"perspective", {{"yfov", -0.5}}}})),
              testing::HasSubstr("cameras[0]: yfov"));
  EXPECT_THAT(error_of(with_camera(
                  {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 0}}}})),
              testing::HasSubstr("cameras[0]: xmag 1 and ymag 0"));
  EXPECT_THAT(error_of(with_camera({{"type", "fisheye"}})),
              testing::HasSubstr("cameras[0]: no projection of its type 'fisheye'"));
  EXPECT_THAT(error_of(with_camera({{"type", "perspective"}})),
              testing::HasSubstr("cameras[0]: no projection"));
}

static GltfFile with_light(Json light, Json node = Json::object()) {
  auto file = square();
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({std::move(light)});
  node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.add_node(std::move(node));
  return file;
}

TEST(GltfLights, ReadsASpotUndeclared) {
  const auto scene = load(with_light({{"type", "spot"},
                                      {"color", {1.0, 0.5, 0.0}},
                                      {"intensity", 40.0},
                                      {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.4}}}},
                                     {{"name", "Spot"},
                                      {"translation", {0, 3, 0}},
                                      {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}}}));
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto& light = scene.lights[0];
  EXPECT_EQ(light.name, "Spot");
  EXPECT_EQ(light.kind, PunctualKind::spot);
  EXPECT_EQ(light.intensity, Rgb(40, 20, 0));
  EXPECT_EQ(light.position, Point3(0, 3, 0));
  expect_near(light.direction, {0, -1, 0});
  EXPECT_EQ(light.inner_cone, 0.1);
  EXPECT_EQ(light.outer_cone, 0.4);
  EXPECT_TRUE(scene.ignored.empty());
}

TEST(GltfLights, DefaultsAndClamps) {
  const auto point =
      load(with_light({{"type", "point"}, {"range", 4.0}}, {{"translation", {0, 0, 1}}}));
  EXPECT_EQ(point.lights[0].kind, PunctualKind::point);
  EXPECT_EQ(point.lights[0].intensity, Rgb(1.0));
  EXPECT_EQ(point.lights[0].name, "light0");
  EXPECT_TRUE(warns(point, {"range", "'light0'"}));

  const auto sun = load(with_light({{"type", "directional"}, {"intensity", -3.0}}));
  EXPECT_EQ(sun.lights[0].kind, PunctualKind::directional);
  EXPECT_EQ(sun.lights[0].intensity, Rgb(0.0));
  EXPECT_TRUE(warns(sun, {"negative intensity"}));

  const auto wide = load(
      with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 3.0}, {"outerConeAngle", 9.0}}}}));
  EXPECT_EQ(wide.lights[0].outer_cone, std::numbers::pi / 2.0);
  EXPECT_EQ(wide.lights[0].inner_cone, wide.lights[0].outer_cone);
  EXPECT_TRUE(warns(wide, {"cone angles"}));
  EXPECT_THAT(error_of(with_light({{"type", "laser"}})),
              testing::HasSubstr("lights[0]: type 'laser' does not exist"));
}

TEST(GltfLights, FromFarAwayAreAsBrightFromNearer) {
  auto file = square();
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 1e29}}};
  const Json use = {{"KHR_lights_punctual", {{"light", 0}}}};
  for (const double far : {1e9, 1e20, 1e300})
    file.add_node({{"extensions", use}, {"translation", {0.5, 0.5, far}}});
  const Scene scene = load(file);
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].position.z, 1e9);
  EXPECT_EQ(scene.lights[0].intensity.g, 1e29);
  for (std::size_t k = 1; k < 3; ++k) {
    const auto& light = scene.lights[k];
    EXPECT_LE(light.position.z, 1e13);
    EXPECT_GT(light.position.z, 1e11) << "from where it was";
    const double before = k == 1 ? 1e29 / 1e20 / 1e20 : 0.0; // 1e29 / 1e600
    EXPECT_NEAR(light.intensity.g / light.position.z / light.position.z, before, 1e-9 * before);
  }
}

} // namespace meninas::test
