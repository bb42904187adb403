// Where walls stand on surfaces no light passes: elements and vertices of the two sides share nothing.
#include "radiosity/mesh/contact_segments.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/transport/hemisphere_samples.h"
#include "radiosity/field/vertex_places.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

// --- Light

constexpr double wall_x = 2.2;
constexpr Point3 room_size{4.0, 2.4, 3.0};

std::vector<Point3> turned(const std::vector<Point3>& corners) {
  return {corners.rbegin(), corners.rend()};
}

const Material plaster = diffuse(0.7);

/// A room with a lamp at its left.
Scene lit_room() {
  Scene scene;
  add_room(scene, Point3(0.0), room_size, {plaster, plaster, plaster, plaster, plaster, plaster});
  add_polygon(scene, "lamp", {{0.3, 2.3, 1}, {1.0, 2.3, 1}, {1.0, 2.3, 2}, {0.3, 2.3, 2}},
              diffuse(0.0, 10.0));
  return scene;
}

/// That room, which a wall divides that long in x below, and leans by `lean`
/// from bottom to top: no light comes to its right. No thickness: a sheet.
Scene two_rooms(double x, double thickness, double lean, double hover) {
  Scene scene = lit_room();
  const double top = room_size.y - hover;
  const auto across = [&](double at) {
    return std::vector<Point3>{{at, 0, 0}, {at, 0, 3}, {at + lean, top, 3}, {at + lean, top, 0}};
  };
  if (thickness == 0.0) {
    add_polygon(scene, "wall", across(x), double_sided(plaster));
  } else {
    if (hover > 0.0) {
      const double left = x + lean - 0.5 * thickness, right = left + thickness;
      add_polygon(scene, "top", {{left, top, 0}, {left, top, 3}, {right, top, 3}, {right, top, 0}},
                  plaster);
    }
    add_polygon(scene, "wall", across(x - 0.5 * thickness), plaster);
    add_polygon(scene, "wall", turned(across(x + 0.5 * thickness)), plaster);
  }
  return scene;
}

PassOneSettings settings_of(MeshCut cut) {
  PassOneSettings settings;
  settings.form_factors.rays = 128;
  settings.interpolation.rays = 128;
  settings.cut = cut;
  return settings;
}

/// The largest irradiance, of elements and of vertices, on either side of the wall.
struct BothSides {
  double dark = 0.0, dark_field = 0.0, lit = 0.0;
};
BothSides light_of(const Scene& scene, double size, MeshCut cut) {
  const auto l = lit(scene, {.element_size = size});
  const RadiositySolution solution = solve_pass_one(l->light, settings_of(cut));
  const LightScene& light = *solution.field.scene;
  const auto is_dark = [&](const Point3& x, const MeshSide& side) {
    const bool in_wall = std::abs(side.normal.x) > 0.5 && x.x > 0.5 && x.x < 3.5;
    return in_wall ? side.normal.x > 0.0 : x.x > wall_x + 0.5;
  };
  BothSides found;
  for (std::size_t e = 0; e < element_count(l->mesh); ++e) {
    const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[e])];
    const Point3 x = centre_of(l->mesh, static_cast<ElementId>(e));
    double& value = is_dark(x, side) ? found.dark : found.lit;
    value = std::max(value, solution.irradiance[e].g);
  }
  // All along what leads to the wall, as near as a ten-thousandth of an element.
  for (std::size_t s = 0; s < light.mesh.sides.size(); ++s) {
    const MeshSide& side = light.mesh.sides[s];
    const Patch& patch = light.surfaces.patches[index(side.patch)];
    for (std::uint32_t k = 0; k < 4096; ++k) {
      const auto sample = sobol4(k, 7);
      Vec2 uv(sample[0], sample[1]);
      if (side.triangle && uv.x + uv.y > 1.0)
        uv = 1.0 - uv;
      if (is_dark(point_at(patch, uv), side))
        found.dark_field = std::max(
            found.dark_field,
            double{irradiance_at(light.mesh, solution.field, SideId{std::uint32_t(s)}, uv).g});
    }
  }
  return found;
}

/// Nothing at all: beside rays that start within rounding of the wall's foot, on its other side.
void expect_dark(const BothSides& found) {
  constexpr double none_but_rounding = 1e-4;
  EXPECT_LT(found.dark, none_but_rounding * found.lit);
  EXPECT_LT(found.dark_field, none_but_rounding * found.lit);
}

/// Upright sheets on a floor of one metre, each from one point to another of it.
struct Sheet {
  Vec2 from, to;
};
std::size_t elements_of_floor_under(const std::vector<Sheet>& sheets) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(0.5));
  add_polygon(scene, "lamp", {{0, 2, 0}, {1, 2, 0}, {1, 2, 1}, {0, 2, 1}}, diffuse(0.0, 1.0));
  for (const auto& [a, b] : sheets)
    add_polygon(scene, "sheet", {{a.x, 0, a.y}, {b.x, 0, b.y}, {b.x, 0.2, b.y}, {a.x, 0.2, a.y}},
                double_sided(diffuse(0.5)));
  const auto l = lit(scene, {.element_size = 1.0});
  return static_cast<std::size_t>(
      std::ranges::count_if(l->mesh.side_of_element, [&](SideId side) {
        const MeshSide& at = l->mesh.sides[index(side)];
        return at.normal.y > 0.9;
      }));
}

// Regions are no smaller than light needs: a quarter of an element's edge. Cut all along, a grid of nine sheets either way makes 37.
TEST(ContactSegments, ManyThingsThatStandTogetherMakeFewRegions) {
  std::vector<Sheet> grid;
  for (int k = 1; k < 10; ++k) {
    grid.push_back({{0.1 * k, 0.0}, {0.1 * k, 1.0}});
    grid.push_back({{0.0, 0.1 * k}, {1.0, 0.1 * k}});
  }
  EXPECT_LE(elements_of_floor_under(grid), 16);
  EXPECT_EQ(elements_of_floor_under({{{0.5, 0.0}, {0.5, 1.0}}, {{0.0, 0.5}, {1.0, 0.5}}}), 4)
      << "two walls that cross part all four corners";
}

// A wall goes on parting what is beside it where small things stand around it.
TEST(ContactSegments, AWallAmongManySmallThingsCutsTheFloor) {
  std::vector<Sheet> sheets;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)
      sheets.push_back({{0.06 + 0.12 * i, 0.02 + 0.33 * k}, {0.06 + 0.12 * i, 0.3 + 0.33 * k}});
  const std::size_t small = elements_of_floor_under(sheets);
  EXPECT_LE(small, 16);
  sheets.push_back({{0.48, 0.0}, {0.48, 1.0}});
  const std::size_t with_wall = elements_of_floor_under(sheets);
  EXPECT_GE(with_wall, 2);
  EXPECT_LE(with_wall, 16);
}

TEST(ContactLeaks, NoLightPassesUnderWallsOfAnyThickness) {
  for (const MeshCut cut : mesh_cuts)
    for (const double thickness : {0.0, 0.01, 0.1, 0.2})
      for (const double size : {0.6, 0.25}) {
        SCOPED_TRACE(testing::Message() << "thickness " << thickness << " size " << size);
        const BothSides found = light_of(two_rooms(wall_x, thickness, 0.0, 0.0), size, cut);
        EXPECT_GT(found.lit, 0.1);
        expect_dark(found);
      }
}

TEST(ContactLeaks, NorWhereTheyStandBetweenElements) {
  // Elements of a quarter of a metre have their edges at whole quarters.
  for (const double x : {2.0, 2.25})
    expect_dark(light_of(two_rooms(x, 0.0, 0.0, 0.0), 0.25, MeshCut::hierarchical));
}

TEST(ContactLeaks, NorWhereTheyLean) {
  for (const double lean : {0.3, -0.4})
    expect_dark(light_of(two_rooms(wall_x, 0.0, lean, 0.0), 0.3, MeshCut::hierarchical));
}

TEST(ContactLeaks, AWallThatEndsAHairBelowTheCeilingLetsPassNoMoreThanItsGap) {
  // What passes a gap of g leaves the lit room through g of 2.4 m of the wall's height, and no more
  // than the lit side's largest irradiance times that area may arrive in the dark.
  constexpr double gap = 0.001;
  for (const MeshCut cut : mesh_cuts)
    for (const double thickness : {0.0, 0.1}) {
      SCOPED_TRACE(testing::Message() << "thickness " << thickness);
      const BothSides found = light_of(two_rooms(wall_x, thickness, 0.0, gap), 0.3, cut);
      EXPECT_LT(found.dark, 4.0 * gap / room_size.y * found.lit);
    }
}

// As the integers of a file round it: one end of the foot in the floor, the other a hair above it.
TEST(ContactLeaks, NorUnderABoxOfWhichOneEndIsSunkIntoTheFloor) {
  for (const double hair : {2e-5, 1e-4})
    for (const double thickness : {0.01, 0.2}) {
      SCOPED_TRACE(testing::Message() << "thickness " << thickness << " hair " << hair);
      Scene scene = lit_room();
      const auto others = static_cast<std::ptrdiff_t>(scene.vertices.size());
      add_box(scene, "box", {wall_x, 0, 0}, {wall_x + thickness, room_size.y, room_size.z}, plaster);
      for (auto vertex = scene.vertices.begin() + others; vertex != scene.vertices.end(); ++vertex)
        vertex->position.y += vertex->position.z > 1.5 ? hair : -hair;
      // A slit that is a hair high lets pass what meets it.
      const BothSides found = light_of(scene, 0.3, MeshCut::hierarchical);
      EXPECT_LT(found.dark, 4.0 * hair / room_size.y * found.lit);
      EXPECT_LT(found.dark_field, 4.0 * hair / room_size.y * found.lit);
    }
}

// --- Elements

constexpr Point3 foot(0.017, 0.0, 0.023); ///< of the sheet
Vec3 along(double angle) { return {std::cos(angle), 0.0, std::sin(angle)}; }
Vec3 across(double angle) { return {-std::sin(angle), 0.0, std::cos(angle)}; }

enum class Floor { square, triangle, trapezoid };

/// A floor of about 2 x 2 m, and a sheet through its middle, turned about the vertical.
Scene floor_and_sheet(Floor shape, double angle, double height = 1.0) {
  Scene scene;
  std::vector<Point3> floor{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  if (shape == Floor::triangle)
    floor = {{-1.6, 0, 1}, {1.6, 0, 1}, {0.2, 0, -1.2}};
  if (shape == Floor::trapezoid)
    floor = {{-1.4, 0, 1}, {1.4, 0, 1}, {0.5, 0, -1}, {-0.7, 0, -0.8}};
  add_polygon(scene, "floor", floor, double_sided(diffuse(0.5)));
  const Point3 from = foot - 4.0 * along(angle), to = foot + 4.0 * along(angle),
               up(0.0, height, 0.0);
  add_polygon(scene, "sheet", {from, to, to + up, from + up}, double_sided(diffuse(0.5)));
  return scene;
}

bool is_upper_floor(const ElementMesh& mesh, ElementId element) {
  return mesh.sides[index(mesh.side_of_element[index(element)])].normal.y > 0.5;
}

/// Whether every element of the floor lies on one side of the sheet, and every vertex as well.
void expect_parted(const ElementMesh& mesh, double angle) {
  std::vector<int> of_vertex(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    const auto element = static_cast<ElementId>(e);
    if (!is_upper_floor(mesh, element))
      continue;
    const int side = glm::dot(centre_of(mesh, element) - foot, across(angle)) > 0.0 ? 1 : -1;
    if (const RegionElement* region = region_of(mesh, element))
      for (const auto& triangle : region->triangles)
        for (const Point3& x : triangle)
          EXPECT_GT(side * glm::dot(x - foot, across(angle)), -1e-9);
    else
      for (const ElementVertexId v : mesh.corners[e])
        EXPECT_GT(side * glm::dot(mesh.vertices[index(v)] - foot, across(angle)), -1e-4);
    for (const ElementVertexId v : mesh.corners[e]) {
      EXPECT_NE(of_vertex[index(v)], -side) << "shared by both sides";
      of_vertex[index(v)] = side;
    }
  }
}

TEST(ContactLeaks, ElementsAndVerticesAreOfOneSide) {
  for (const Floor shape : {Floor::square, Floor::triangle, Floor::trapezoid})
    for (const double angle : {0.0, 0.3, 0.785, 1.2, 1.571}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(shape) << " at " << angle);
      const auto l = lit(floor_and_sheet(shape, angle), {.element_size = 0.25});
      ASSERT_FALSE(l->mesh.regions.empty());
      expect_parted(l->mesh, angle);
      // So are those of meshes that are divided, which are the same made anew.
      std::vector<std::uint8_t> marked(element_count(l->mesh), 0);
      for (std::size_t e = 0; e < marked.size(); e += 3)
        marked[e] = 1;
      const ElementMesh divided = divide_elements(l->mesh, l->surfaces, marked);
      expect_parted(divided, angle);
      const ElementMesh again = divided_mesh(l->mesh, l->surfaces, division_of(divided));
      EXPECT_EQ(divided.corners, again.corners);
      EXPECT_EQ(divided.area, again.area);
    }
}

TEST(ContactLeaks, RegionsMakeUpTheirLeavesAndAreWherePointsLand) {
  for (const Floor shape : {Floor::square, Floor::triangle, Floor::trapezoid}) {
    const auto l = lit(floor_and_sheet(shape, 0.3), {.element_size = 0.25});
    const ElementMesh& mesh = l->mesh;
    std::vector<double> of_side(mesh.sides.size(), 0.0);
    for (std::size_t e = 0; e < element_count(mesh); ++e) {
      const auto element = static_cast<ElementId>(e);
      of_side[index(mesh.side_of_element[e])] += mesh.area[e];
      if (region_of(mesh, element) == nullptr)
        continue;
      const MeshCell& cell = cell_of(mesh, element);
      const Patch& patch = l->surfaces.patches[index(mesh.sides[index(cell.side)].patch)];
      const ReceiverArea area = receiver_of(*l->light, element);
      Point3 sum(0.0);
      constexpr std::uint32_t points = 4096;
      for (std::uint32_t k = 0; k < points; ++k) {
        const auto sample = sobol4(k, 3);
        const Point3 x = point_in(area, Vec2(sample[0], sample[1]));
        const Vec2 uv = uv_at(patch, x);
        const RegionElement& region = *region_of(mesh, element);
        if (mesh.area[e] > 1e-3 * cell.area && k % 64 == 0) {
          // Rounding may put points of the rim beyond it.
          const Vec2 within = uv_at(patch, glm::mix(x, region.centroid, 1e-4));
          EXPECT_EQ(locate(mesh, cell.side, within).element, element);
          EXPECT_EQ(land(l->light->landing.elements, index(cell.side), glm::vec2(within)).element, e);
        }
        EXPECT_GE(uv.x, 0.0);
        sum += x / double(points);
      }
      // Sobol points have the mean of a uniform density to a hundredth of the leaf's size.
      EXPECT_LT(glm::distance(sum, region_of(mesh, element)->centroid),
                0.01 * std::sqrt(cell.area));
    }
    for (std::size_t s = 0; s < of_side.size(); ++s) {
      const Patch& patch = l->surfaces.patches[index(mesh.sides[s].patch)];
      EXPECT_NEAR(of_side[s], patch.area, 1e-9 * patch.area);
    }
  }
}

TEST(ContactLeaks, AreTheSameWhereverTheSceneLiesHoweverLarge) {
  const auto l = lit(floor_and_sheet(Floor::triangle, 0.3), {.element_size = 0.25});
  const glm::dmat3 turn(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
  const auto moved =
      lit(transformed(l->scene, turn, 1e-3, Vec3(2.0, -1.0, 0.5)), {.element_size = 0.25e-3});
  EXPECT_EQ(l->mesh.corners, moved->mesh.corners);
}

TEST(ContactLeaks, LightIsOneFieldRoundTheEndOfAWall) {
  // A screen that ends in the middle of the floor: beyond its end vertices are shared as ever, so
  // the mesh is in one piece, and vertices apart are those that the screen stands at or cuts off.
  Scene scene;
  add_polygon(scene, "floor", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, diffuse(0.5));
  add_polygon(scene, "screen", {{-1.0, 0, 0.1}, {0.05, 0, 0.1}, {0.05, 1, 0.1}, {-1.0, 1, 0.1}},
              double_sided(diffuse(0.5)));
  const auto l = lit(scene, {.element_size = 0.25});
  const ElementMesh& mesh = l->mesh;
  const auto is_on_floor = [&](std::size_t e) {
    return index(mesh.sides[index(mesh.side_of_element[e])].node) == 0;
  };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (is_at_contact(mesh, v) && is_on_floor(index(mesh.element_of_vertex[v]))) {
      EXPECT_LT(mesh.vertices[v].x, 0.05 + 0.25);
    }
  }
  // From any element of the floor every other is reached by shared vertices.
  const VertexElements all = elements_around(mesh);
  std::vector<std::uint8_t> seen(element_count(mesh), 0);
  std::vector<ElementId> open{ElementId{0}};
  seen[0] = 1;
  while (!open.empty()) {
    const ElementId element = open.back();
    open.pop_back();
    for (const ElementVertexId v : mesh.corners[index(element)])
      for (const ElementId other : around(all, index(v)))
        if (seen[index(other)] == 0) {
          seen[index(other)] = 1;
          open.push_back(other);
        }
  }
  for (std::size_t e = 0; e < seen.size(); ++e) {
    EXPECT_TRUE(seen[e] == 1 || !is_on_floor(e)) << e;
  }
}

// --- What cuts elements

std::size_t regions_on_floor(const std::vector<Point3>& corners, const Material& material) {
  Scene scene;
  add_polygon(scene, "floor", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, diffuse(0.5));
  if (!corners.empty())
    add_polygon(scene, "thing", corners, material);
  return lit(scene, {.element_size = 0.25})->mesh.regions.size();
}
std::vector<Point3> upright(double x, double low, double high) {
  return {{x, low, -1}, {x, low, 1}, {x, high, 1}, {x, high, -1}};
}

TEST(ContactLeaks, WhatStandsThereCutsAndNothingElse) {
  const Material paper = double_sided(diffuse(0.5));
  Material pane;
  pane.transmission = 1.0;
  EXPECT_EQ(regions_on_floor(upright(0.1, 0.0, 1.0), paper), 16U) << "two of eight elements";
  EXPECT_EQ(regions_on_floor(upright(0.1, -1.0, 1.0), paper), 16U) << "through the floor";
  EXPECT_EQ(regions_on_floor(upright(0.1, 0.005, 1.0), paper), 16U) << "a hair above it";
  EXPECT_EQ(regions_on_floor(upright(0.1, 0.0, 1.0), double_sided(mirror(0.9))), 16U);
  EXPECT_EQ(regions_on_floor(upright(0.1, 0.0, 1.0), diffuse(0.5)), 16U) << "one side of it black";

  EXPECT_EQ(regions_on_floor({}, paper), 0U);
  EXPECT_EQ(regions_on_floor(upright(0.25, 0.0, 1.0), paper), 0U) << "between elements";
  EXPECT_EQ(regions_on_floor(upright(0.1, 0.1, 1.0), paper), 0U) << "hangs over it";
  EXPECT_EQ(regions_on_floor(upright(0.1, -1.0, 0.0), paper), 0U) << "below";
  EXPECT_EQ(regions_on_floor(upright(0.1, 0.0, 1.0), double_sided(pane)), 0U);
  EXPECT_EQ(regions_on_floor({{-1, 0.1, 1}, {1, 0.1, 1}, {1, 0.1, -1}, {-1, 0.1, -1}}, paper), 0U)
      << "along it";
  const double low = 0.01;
  EXPECT_GT(regions_on_floor({{-1, low, 0.4}, {0.1, low, 0.4}, {0.1, low, -0.7}, {-1, low, -0.7}},
                             diffuse(0.5)),
            0U)
      << "the outline of a rug";
}

} // namespace
} // namespace meninas::test
