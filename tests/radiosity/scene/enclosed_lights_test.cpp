// Lights that an opaque body shuts in are named; those of rooms are not.
#include "radiosity/scene/enclosed_lights.h"
#include "radiosity/scene/plan.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>

namespace meninas::test {
namespace {

Scene room_with_light(const Material& walls) {
  Scene scene;
  add_room(scene, Point3(-2.0), Point3(2.0), {walls, walls, walls, walls, walls, walls});
  PunctualLight light;
  light.name = "bulb's light";
  light.position = {0.0, 1.5, 0.0};
  scene.lights.push_back(light);
  return scene;
}

std::vector<EnclosedLight> enclosed(const Scene& scene) {
  return enclosed_lights(scene, find_surfaces(scene));
}

TEST(EnclosedLights, AreInsideOfBulbsOfOneSideOrTwo) {
  for (const Material& shell : {diffuse(0.9), double_sided(diffuse(0.9))}) {
    Scene scene = room_with_light(diffuse(0.7));
    add_box(scene, "bulb", {-0.1, 1.4, -0.1}, {0.1, 1.6, 0.1}, shell);
    const auto found = enclosed(scene);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].first, "bulb's light");
    EXPECT_TRUE(found[0].second.starts_with("bulb"));
    const TransportPlan plan = plan_transport(scene, find_surfaces(scene));
    EXPECT_THAT(plan.warnings,
                testing::Contains(testing::HasSubstr(
                    "the light 'bulb's light' is inside the closed opaque body 'bulb")));
  }
}

TEST(EnclosedLights, AreNotThoseOfRoomsNorOutsideOrInGlass) {
  EXPECT_TRUE(enclosed(room_with_light(diffuse(0.7))).empty());
  EXPECT_TRUE(enclosed(room_with_light(double_sided(diffuse(0.7)))).empty());
  Scene beside = room_with_light(diffuse(0.7));
  add_box(beside, "crate", {0.2, 1.4, -0.1}, {0.4, 1.6, 0.1}, diffuse(0.5));
  EXPECT_TRUE(enclosed(beside).empty());
  Material clear = double_sided(diffuse(0.0));
  clear.transmission = 1.0;
  Scene globe = room_with_light(diffuse(0.7));
  add_box(globe, "globe", {-0.1, 1.4, -0.1}, {0.1, 1.6, 0.1}, clear);
  EXPECT_TRUE(enclosed(globe).empty());
}

TEST(EnclosedLights, AreNotBesideACameraNorBelowAnOpenShade) {
  Scene cell = room_with_light(diffuse(0.7));
  add_box(cell, "cell", {-0.3, 1.2, -0.3}, {0.3, 1.8, 0.3}, double_sided(diffuse(0.5)));
  cell.cameras.push_back(look_at({0.1, 1.4, 0.1}, {0.0, 1.5, 0.0}, 1.0));
  EXPECT_TRUE(enclosed(cell).empty());
  Scene shade = room_with_light(diffuse(0.7));
  add_box(shade, "shade", {-0.1, 1.4, -0.1}, {0.1, 1.6, 0.1}, double_sided(diffuse(0.5)));
  std::erase_if(shade.triangles,
                [&](const Triangle& t) { return shade.nodes[index(t.node)].name == "shade.y0"; });
  EXPECT_TRUE(enclosed(shade).empty());
}

} // namespace
} // namespace meninas::test
