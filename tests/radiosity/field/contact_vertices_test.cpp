// The field where something stands on a surface:
// as bright at the foot of a bright wall as it is there, on either side of its lines.
#include "radiosity/field/contact_vertices.h"
#include "radiosity/mesh/subdivision.h"
#include "form_factors/point_form_factor.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// `direct` of direct light, and 1 of indirect light, by way of mirrors.
ContactLight light_of(double place, double direct) {
  return {place,
          {.irradiance = {Rgb(direct + 1.0), Rgb(1.0)},
           .indirect = {Rgb(1.0), Rgb(1.0)},
           .clearance = Clearance::open}};
}

TEST(ContactVertices, FollowTheLineThroughWhatIsSeen) {
  VertexIrradiance field;
  field.irradiance.assign(6, glm::vec3(3.0F)); // 1 direct, 2 by way of mirrors
  field.indirect = field.mirrored = field.indirect_mirrored = {6, glm::vec3(2.0F)};
  std::vector<std::uint8_t> valid(6, 0);
  valid[0] = 1;
  const std::vector<ContactEdge> edges{{1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 0}, {5, 0}};
  const std::vector<ContactLight> lights{light_of(0.5, 1.5), light_of(0.1, 1.1),
                                         light_of(0.5, 0.4), light_of(0.8, 2.0),
                                         light_of(0.5, 1.0), light_of(0.0, 7.0)};
  extend_to_contacts(edges, lights, valid, field);
  const auto direct = [&](std::size_t v) { return field.irradiance[v].g - field.indirect[v].g; };
  const float tolerance = 1e-6F;           // of floats
  EXPECT_NEAR(direct(1), 2.0F, tolerance); // 1 at 0 and 1.5 at 1/2
  EXPECT_NEAR(direct(2), 1.3F, tolerance); // no further than twice as far as is seen
  EXPECT_EQ(direct(3), 0.0F);              // and not below darkness
  EXPECT_NEAR(direct(4), (0.64F * 2.25F + 0.25F * 1.0F) / 0.89F,
              tolerance); // the mean of two lines
  // 2 at 0 and 1 at 1/2: no part is less than nothing, nor more than the whole.
  EXPECT_EQ(field.indirect[1].g, 0.0F);
  EXPECT_NEAR(field.indirect_mirrored[4].g, 0.64F * 0.75F / 0.89F, tolerance);
  for (std::size_t v = 0; v < 5; ++v) {
    EXPECT_LE(field.mirrored[v].g, field.irradiance[v].g);
    EXPECT_LE(field.indirect_mirrored[v].g, field.mirrored[v].g);
  }
  EXPECT_EQ(valid, (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 0}));
}

// Light by way of mirrors is to be what it is in the room that they show.
TEST(ContactVertices, TheWholeDoesNotDependOnItsParts) {
  std::array<VertexIrradiance, 2> fields;
  for (const bool mirrors : {false, true}) {
    VertexIrradiance& field = fields[mirrors ? 1 : 0];
    field.irradiance = {glm::vec3(5.0F), glm::vec3(0.0F)};
    field.mirrored = {glm::vec3(mirrors ? 1.0F : 0.0F), glm::vec3(0.0F)};
    field.indirect = field.indirect_mirrored = {2, glm::vec3(0.0F)};
    // By way of mirrors from 1 to 3, straight from 4 to 1.
    const ArrivingLight arrived{Rgb(4.0), Rgb(mirrors ? 3.0 : 0.0)};
    std::vector<std::uint8_t> valid{1, 0};
    extend_to_contacts(std::vector<ContactEdge>{{1, 0}},
                       std::vector<ContactLight>{{0.4, {arrived, {}}}}, valid, field);
  }
  EXPECT_EQ(fields[0].irradiance[1].g, fields[1].irradiance[1].g);
}

TEST(ContactVertices, EdgesAreFoundOnce) {
  Scene scene;
  add_polygon(scene, "wall", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  const auto l = lit(std::move(scene), {.element_size = 0.25});
  std::vector<std::uint8_t> valid(l->mesh.vertices.size(), 1);
  for (std::size_t v = 0; v < valid.size(); ++v)
    valid[v] = l->mesh.vertices[v] == Point3(0.5, 0.5, 0.0) ? 0 : 1;
  const auto edges = contact_edges(l->mesh, valid);
  ASSERT_EQ(edges.size(), 4U);
  for (const auto& [covered, exposed] : edges)
    EXPECT_NEAR(glm::distance(l->mesh.vertices[covered], l->mesh.vertices[exposed]), 0.25, 1e-12);
}

TEST(ContactVertices, HangingVerticesAreExposedWhereTheirEndsAreAndNeverCovered) {
  Scene scene;
  add_polygon(scene, "wall", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  const auto l = lit(std::move(scene), {.element_size = 0.25});
  std::vector<std::uint8_t> marked(element_count(l->mesh), 0);
  for (std::size_t e = 0; e < marked.size(); ++e)
    marked[e] =
        glm::distance(centre_of(l->mesh, static_cast<ElementId>(e)), Point3(0.375, 0.375, 0)) < 0.01
            ? 1
            : 0;
  const ElementMesh mesh = divide_elements(l->mesh, l->surfaces, marked);
  ASSERT_EQ(mesh.hanging.size(), 4U);
  // All four edges from the middle of the divided element end at hanging vertices;
  // two of these lose an end.
  std::vector<std::uint8_t> valid(mesh.vertices.size(), 1);
  const auto cover = [&](const Point3& x) {
    for (std::size_t v = 0; v < valid.size(); ++v)
      if (glm::distance(mesh.vertices[v], x) < 0.01)
        valid[v] = 0;
  };
  cover({0.375, 0.375, 0});
  EXPECT_EQ(contact_edges(mesh, valid).size(), 4U);
  for (const HangingVertex& hanging : mesh.hanging)
    valid[index(hanging.vertex)] = 0; // what they hold themselves does not matter
  EXPECT_EQ(contact_edges(mesh, valid).size(), 4U);
  cover({0.25, 0.25, 0});
  std::size_t from_the_middle = 0;
  for (const auto& [covered, exposed] : contact_edges(mesh, valid))
    from_the_middle +=
        glm::distance(mesh.vertices[covered], Point3(0.375, 0.375, 0)) < 0.01 ? 1 : 0;
  EXPECT_EQ(from_the_middle, 2U);
}

constexpr double height = 0.4;

/// A black box that glows stands on a floor; one of its sides is the plane x = `side`.
Scene glowing_box(double side) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0}}, diffuse(0.5));
  add_box(scene, "box", {side, 0.0, 0.83}, {side + 1.3, height, 2.17}, diffuse(0.0, 1.0));
  return scene;
}

/// What the floor receives within 0.1 of the foot, where it is 1/2 and falls to 0.38,
/// beside what it receives from the one side of the box that it sees.
struct AtFoot {
  double found = 0.0, exact = 0.0; ///< means
  double largest_error = 0.0;
};
AtFoot at_foot(const LitScene& l, const RadiositySolution& solution, double side) {
  const ElementMesh& mesh = solution.field.mesh();
  const SideId floor = l.mesh.side_of_element[elements_of(l, "floor")[0]];
  const Patch& patch = l.surfaces.patches[index(mesh.sides[index(floor)].patch)];
  const std::vector<Point3> wall{
      {side, 0, 0.83}, {side, 0, 2.17}, {side, height, 2.17}, {side, height, 0.83}};
  AtFoot foot;
  for (int k = 0; k < 20; ++k) {
    const Point3 x{side - 0.1 * (k + 0.5) / 20.0, 0.0, 1.52};
    const double here = double{irradiance_at(mesh, solution.field, floor, uv_at(patch, x)).g};
    const double truth = point_form_factor(x, {0.0, 1.0, 0.0}, wall);
    foot.found += here / 20.0;
    foot.exact += truth / 20.0;
    foot.largest_error = std::max(foot.largest_error, std::abs(here - truth));
  }
  return foot;
}

TEST(ContactVertices, TheFootOfABrightWallIsLit) {
  // The wall on a line of vertices, close to either side of one, and between two.
  for (const double side : {0.8, 0.801, 0.799, 0.75, 0.78}) {
    const auto l = lit(glowing_box(side), {.element_size = 0.1});
    const AtFoot foot = at_foot(*l, solve_pass_one(l->light, {}), side);
    // Over one cell the factor is straight to (0.1 / 0.4)^3 / 4 of itself;
    // vertices beside each other may share a line.
    EXPECT_NEAR(foot.found, foot.exact, 0.01 * foot.exact) << side;
    EXPECT_LT(foot.largest_error, 0.02) << side;
  }
}

/// What the floor receives half way between two glowing boxes,
/// this far apart, from the two sides that it sees.
struct InGap {
  double found = 0.0, exact = 0.0;
};
InGap in_gap(double gap, double element_size) {
  const double low = 1.41, high = low + gap;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0}}, diffuse(0.5));
  add_box(scene, "left", {0.5, 0.0, 0.5}, {low, height, 2.5}, diffuse(0.0, 1.0));
  add_box(scene, "right", {high, 0.0, 0.5}, {2.5, height, 2.5}, diffuse(0.0, 1.0));
  const auto l = lit(scene, {.element_size = element_size});
  const RadiositySolution solution = solve_pass_one(l->light, {});
  const ElementMesh& mesh = solution.field.mesh();
  const SideId floor = l->mesh.side_of_element[elements_of(*l, "floor")[0]];
  const Patch& patch = l->surfaces.patches[index(mesh.sides[index(floor)].patch)];
  const Point3 x{0.5 * (low + high), 0.0, 1.5};
  const auto wall = [](double at) {
    return std::vector<Point3>{{at, 0, 0.5}, {at, 0, 2.5}, {at, height, 2.5}, {at, height, 0.5}};
  };
  return {double{irradiance_at(mesh, solution.field, floor, uv_at(patch, x)).g},
          2.0 * point_form_factor(x, {0.0, 1.0, 0.0}, wall(low))};
}

TEST(GapVertices, TheGroundOfANarrowGapIsLit) {
  for (const double gap : {0.15, 0.05}) {
    const InGap gap_light = in_gap(gap, 0.5);
    EXPECT_GT(gap_light.exact, 0.8) << "what is not seen is the sky above";
    // A few points across stand for all:
    // the share of the sky, 1/5 and less, differs across the gap by a third of itself.
    EXPECT_NEAR(gap_light.found, gap_light.exact, 0.07 * gap_light.exact) << gap;
  }
}

} // namespace
} // namespace meninas::test
