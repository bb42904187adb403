// Inside of closed bodies it is dark, if no lamp is there.
#include "radiosity/mesh/enclosed_sides.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

const Material wood = double_sided(diffuse(0.5));

void remove_node(Scene& scene, const std::string& name) {
  std::erase_if(scene.triangles,
                [&](const Triangle& t) { return scene.nodes[index(t.node)].name == name; });
}

/// How many sides of a node are enclosed: fronts and backs.
std::array<int, 2> enclosed_of(const Scene& scene, const std::string& node) {
  const SurfaceModel surfaces = find_surfaces(scene);
  const EnclosedSides sides = find_enclosed_sides(scene, surfaces);
  std::array<int, 2> count{0, 0};
  for (std::size_t t = 0; t < sides.size(); ++t)
    if (scene.nodes[index(scene.triangles[t].node)].name.starts_with(node))
      for (std::size_t facing = 0; facing < 2; ++facing)
        count[facing] += sides[t][facing];
  return count;
}

constexpr std::array none_of_them{0, 0};

/// A floor of 4 x 4 m and a box of a metre on it, 12 triangles.
Scene box_on_floor() {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, wood);
  add_box(scene, "box", {-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}, wood);
  return scene;
}

Scene box_without_bottom() {
  Scene scene = box_on_floor();
  remove_node(scene, "box.y0");
  return scene;
}

TEST(EnclosedSides, AreTheBacksOfABox) {
  EXPECT_EQ(enclosed_of(box_on_floor(), "box"), (std::array{0, 12}));
  EXPECT_EQ(enclosed_of(box_on_floor(), "floor"), none_of_them);
}

TEST(EnclosedSides, AreNoneOfALantern) {
  Scene scene = box_on_floor();
  for (Material& material : scene.materials)
    material.diffuse_transmission = 0.5;
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them) << "light comes through its walls";
}

TEST(EnclosedSides, AreTheFrontsWhereTheseLookInwards) {
  Scene scene = box_on_floor();
  for (Triangle& t : scene.triangles)
    if (scene.nodes[index(t.node)].name != "floor")
      std::swap(t.vertices[1], t.vertices[2]);
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{12, 0}));
}

TEST(EnclosedSides, FollowTrianglesThatAreTurnedRound) {
  Scene scene = box_on_floor();
  int turned = 0;
  for (Triangle& t : scene.triangles)
    if (scene.nodes[index(t.node)].name != "floor" && turned++ < 5)
      std::swap(t.vertices[1], t.vertices[2]);
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{5, 7}));
}

TEST(EnclosedSides, AreThoseOfABoxWithoutBottomOnAFloor) {
  EXPECT_EQ(enclosed_of(box_without_bottom(), "box"), (std::array{0, 10}));
}

// Between floor and ceiling a column needs neither a bottom nor a top.
TEST(EnclosedSides, AreThoseOfAColumn) {
  Scene scene = box_without_bottom();
  remove_node(scene, "box.y1");
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them);
  add_polygon(scene, "ceiling", {{-2, 1, -2}, {2, 1, -2}, {2, 1, 2}, {-2, 1, 2}}, wood);
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{0, 8}));
}

// A room without a floor of its own stands on one that is full of boxes without bottoms.
TEST(EnclosedSides, AreThoseOfManyBoxesOnOneFloor) {
  Scene scene;
  constexpr int count = 40;
  for (int k = 0; k < count * count; ++k) {
    const Point3 low(k % count, 0.0, k / count);
    add_box(scene, "box", low, low + Vec3(0.5), wood);
  }
  add_box(scene, "room", {-1, 0, -1}, {count + 1, 2, count + 1}, wood);
  remove_node(scene, "box.y0");
  remove_node(scene, "room.y0");
  add_polygon(scene, "floor", {{-99, 0, 99}, {99, 0, 99}, {99, 0, -99}, {-99, 0, -99}}, wood);
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{0, 10 * count * count}));
  EXPECT_EQ(enclosed_of(scene, "room"), (std::array{0, 10}));
  EXPECT_EQ(enclosed_of(scene, "floor"), none_of_them);
}

// Boxes with bottoms cover so much of a floor that asking whether they cover all of it would not
// end: a sheet has no inside, and is not asked.
TEST(EnclosedSides, AreThoseOfManyClosedBoxesOnOneFloor) {
  Scene scene;
  constexpr int count = 65;
  for (int k = 0; k < count * count; ++k) {
    const Point3 low(k % count, 0.0, k / count);
    add_box(scene, "box", low, low + Vec3(0.5), wood);
  }
  add_polygon(scene, "floor", {{-9, 0, 99}, {99, 0, 99}, {99, 0, -9}, {-9, 0, -9}}, wood);
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{0, 12 * count * count}));
  EXPECT_EQ(enclosed_of(scene, "floor"), none_of_them);
}

// What stands on a box closes it, and the other way round: four triangles share every edge between.
TEST(EnclosedSides, AreThoseOfBoxesOnBoxes) {
  Scene scene = box_on_floor();
  add_box(scene, "upper", {-0.5, 1.0, -0.5}, {0.5, 2.0, 0.5}, wood);
  const auto lower = enclosed_of(scene, "box"), upper = enclosed_of(scene, "upper");
  EXPECT_EQ(lower[0] + upper[0], 0);
  EXPECT_GE(lower[1], 10);
  EXPECT_GE(upper[1], 10);
}

TEST(EnclosedSides, AreNoneWhereLightComesIn) {
  Scene hovering = box_without_bottom();
  for (Vertex& vertex : hovering.vertices)
    if (vertex.position.y < 1e-9 && std::abs(vertex.position.x) < 1.0)
      vertex.position.y = 0.02;
  EXPECT_EQ(enclosed_of(hovering, "box"), none_of_them);

  Scene over_the_edge = box_without_bottom();
  for (Vertex& vertex : over_the_edge.vertices)
    if (std::abs(vertex.position.x) < 1.0)
      vertex.position.x += 1.6;
  EXPECT_EQ(enclosed_of(over_the_edge, "box"), none_of_them);

  Scene open = box_on_floor();
  remove_node(open, "box.z1");
  EXPECT_EQ(enclosed_of(open, "box"), none_of_them);

  for (const auto& change : std::vector<void (*)(Material&)>{
           [](Material& m) { m.transmission = 1.0; },
           [](Material& m) { m.alpha_mode = AlphaMode::blend, m.alpha = 0.5; },
           [](Material& m) { m.alpha_mode = AlphaMode::mask; }}) {
    Scene window = box_on_floor();
    Material& material = window.materials.emplace_back(wood);
    change(material);
    for (Triangle& t : window.triangles)
      if (window.nodes[index(t.node)].name == "box.x1")
        t.material = static_cast<MaterialId>(window.materials.size() - 1);
    EXPECT_EQ(enclosed_of(window, "box"), none_of_them);
  }
}

// However small a hole in the floor is, what is over it is seen from there.
TEST(EnclosedSides, AreNoneOverAHole) {
  Scene scene = box_without_bottom();
  remove_node(scene, "floor");
  const auto strip = [&](double x0, double x1, double z0, double z1) {
    add_polygon(scene, "floor", {{x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0}}, wood);
  };
  const auto floor_but = [&](double hole) {
    remove_node(scene, "floor");
    strip(-2, 0, -2, 2);
    strip(hole, 2, -2, 2);
    strip(0, hole, -2, 0);
    strip(0, hole, hole, 2);
  };
  floor_but(0.01);
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them);
  strip(0, 0.01, 0, 0.01); // a lid
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{0, 10}));
  floor_but(0.7); // it reaches beyond the box
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them);
}

// The loop of a sheet lies on another sheet, but there is nothing between them:
// which side would be the inner one is a matter of rounding.
TEST(EnclosedSides, AreNoneOfSheets) {
  const glm::dmat3 turned(glm::dvec3(0.36, 0.48, -0.8), glm::dvec3(-0.8, 0.6, 0.0),
                          glm::dvec3(0.48, 0.64, 0.6));
  for (const double gap : {0.0, 1e-7, 1e-3}) {
    Scene scene;
    add_polygon(scene, "wall", {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, wood);
    add_polygon(scene, "poster", {{-1, -1, gap}, {1, -1, gap}, {1, 1, gap}, {-1, 1, gap}}, wood);
    add_polygon(scene, "poster", {{1, -1, gap}, {1, 1, gap}, {-1, 1, gap}, {-1, -1, gap}}, wood);
    EXPECT_EQ(enclosed_of(scene, ""), none_of_them) << gap;
    EXPECT_EQ(enclosed_of(transformed(scene, turned, 1.0, Vec3(0.3)), ""), none_of_them) << gap;
  }
}

// A lamp may pass through a body and have both of its ends, and its middle, outside.
TEST(EnclosedSides, AreNoneWhereALampPassesThrough) {
  Scene scene = box_on_floor();
  add_polygon(scene, "lamp", {{-9, 0.4, 0.1}, {0.7, 0.4, 0.1}, {0.7, 0.4, -0.1}, {-9, 0.4, -0.1}},
              diffuse(0.0, 1.0));
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them);
  remove_node(scene, "lamp");
  add_polygon(scene, "lamp", {{-9, 1.4, 0.1}, {0.7, 1.4, 0.1}, {0.7, 1.4, -0.1}, {-9, 1.4, -0.1}},
              diffuse(0.0, 1.0));
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{0, 12}));
  // A lamp that stands on it is outside, as far as it does not shine on what it stands on.
  add_box(scene, "lamp", {-0.2, 1.0, -0.2}, {0.2, 1.2, 0.2}, diffuse(0.5, 1.0));
  remove_node(scene, "lamp.y0");
  EXPECT_EQ(enclosed_of(scene, "box"), (std::array{0, 12}));
}

// A box whose upper half is turned inside out by a twist winds around it the other way.
TEST(EnclosedSides, AreNoneWhereABodyCrossesItself) {
  Scene scene;
  add_box(scene, "box", {-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}, wood);
  for (Vertex& vertex : scene.vertices)
    if (vertex.position.y > 0.5)
      vertex.position.x *= -0.8;
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them);
}

TEST(EnclosedSides, AreNoneWhereALampIsInside) {
  const std::vector<Point3> quad{
      {-0.1, 0.5, 0.1}, {0.1, 0.5, 0.1}, {0.1, 0.5, -0.1}, {-0.1, 0.5, -0.1}};
  Scene scene = box_on_floor();
  add_polygon(scene, "lamp", quad, diffuse(0.0, 1.0));
  EXPECT_EQ(enclosed_of(scene, "box"), none_of_them);

  Scene with_bulb = box_on_floor();
  with_bulb.lights.emplace_back().position = {0.3, 0.1, 0.2};
  EXPECT_EQ(enclosed_of(with_bulb, "box"), none_of_them);
  with_bulb.lights.back().position.y = 1.5;
  EXPECT_EQ(enclosed_of(with_bulb, "box"), (std::array{0, 12}));
}

// A box that glows outwards is dark inside, a double-sided one is not.
TEST(EnclosedSides, AreNoneWhereTheBodyShinesInwards) {
  Scene scene;
  add_box(scene, "lamp", {0, 0, 0}, {1, 1, 1}, wood);
  const auto glow = [&](const Material& material) {
    scene.materials.push_back(material);
    scene.triangles.front().material = static_cast<MaterialId>(scene.materials.size() - 1);
  };
  glow(diffuse(0.5, 1.0));
  EXPECT_EQ(enclosed_of(scene, "lamp"), (std::array{0, 12}));
  glow(double_sided(diffuse(0.5, 1.0)));
  EXPECT_EQ(enclosed_of(scene, "lamp"), none_of_them);
}

// A room that is lit is closed, too.
TEST(EnclosedSides, AreNoneOfALitRoom) {
  Scene scene;
  add_room(scene, {0, 0, 0}, {4, 3, 5}, {wood, wood, wood, wood, wood, wood});
  EXPECT_EQ(enclosed_of(scene, ""), (std::array{12, 0}));
  add_polygon(scene, "lamp", {{1, 3, 1}, {2, 3, 1}, {2, 3, 2}, {1, 3, 2}}, diffuse(0.0, 1.0));
  EXPECT_EQ(enclosed_of(scene, ""), none_of_them);
}

TEST(EnclosedSides, AreTheSameWhereverASceneLies) {
  const glm::dmat3 rotation(glm::dvec3(0.36, 0.48, -0.8), glm::dvec3(-0.8, 0.6, 0.0),
                            glm::dvec3(0.48, 0.64, 0.6));
  for (const double scale : {1e-3, 1.0, 1e3})
    EXPECT_EQ(
        enclosed_of(transformed(box_without_bottom(), rotation, scale, Vec3(3.0 * scale)), "box"),
        (std::array{0, 10}))
        << scale;
}

} // namespace
} // namespace meninas::test
