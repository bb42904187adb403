#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/field/curves/smooth_vertices.h"
#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/field/vertex_places.h"
#include "radiosity/transport/face_clusters.h"
#include "radiosity/light/point_irradiance.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/globes.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace meninas::test {
namespace {

Scene room_with_globe(GivenNormals normals = GivenNormals::none) {
  Scene scene = half_room();
  add_globe(scene, "globe", {.centre = {1.2, 1.1, 1.3}, .radius = 0.25}, diffuse(0.6), normals);
  return scene;
}

std::vector<std::size_t> vertices_of(const LitScene& l, const std::string& node) {
  std::vector<std::size_t> found;
  const auto elements = elements_of(l, node);
  for (std::size_t v = 0; v < l.mesh.vertices.size(); ++v)
    if (std::ranges::binary_search(elements, index(l.mesh.element_of_vertex[v])))
      found.push_back(v);
  return found;
}

// A globe turns by 15 degrees from facet to facet; a room's walls and its box turn by 90.
TEST(Facets, AreFoundOnAGlobeAndNotOnABox) {
  const auto l = lit(room_with_globe(), {.element_size = 0.4});
  const VertexElements facets = facets_around(*l->light);
  const auto of_globe = vertices_of(*l, "globe");
  ASSERT_GT(of_globe.size(), 1000U);
  std::size_t averaged = 0;
  for (std::size_t v = 0; v < l->mesh.vertices.size(); ++v)
    averaged += around(facets, v).empty() ? 0 : 1;
  EXPECT_EQ(averaged, of_globe.size());
  for (const std::size_t v : of_globe)
    EXPECT_GE(around(facets, v).size(), 3U);
}

// What the file gives as normals tells what is smooth, whatever the angle between the facets is.
TEST(Facets, MeetSmoothlyWhereTheFileGivesOneNormal) {
  const auto smooth = lit(room_with_globe(GivenNormals::smooth), {.element_size = 0.4}),
             sharp = lit(room_with_globe(GivenNormals::flat), {.element_size = 0.4});
  const VertexElements on_curve = facets_around(*smooth->light);
  for (const std::size_t v : vertices_of(*smooth, "globe"))
    EXPECT_GE(around(on_curve, v).size(), 3U);
  const VertexElements apart = facets_around(*sharp->light);
  for (const std::size_t v : vertices_of(*sharp, "globe"))
    for (const ElementId element : around(apart, v)) {
      // Only around the poles do neighbours turn by less than what counts as one normal.
      const auto normal_of = [&](ElementId e) {
        return sharp->mesh.sides[index(sharp->mesh.side_of_element[index(e)])].normal;
      };
      EXPECT_GT(glm::dot(normal_of(element), normal_of(sharp->mesh.element_of_vertex[v])),
                std::cos(same_normal_degrees * std::numbers::pi / 180.0));
    }
}

// Facets that were divided are no facets: their light is not that of one element.
TEST(Facets, LargerThanAnElementGatherForThemselves) {
  const auto l = lit(room_with_globe(), {.element_size = 0.02});
  EXPECT_TRUE(facets_around(*l->light).elements.empty());
}

TEST(Facets, LightIsContinuousOverTheCurve) {
  const auto l = lit(room_with_globe(), {.element_size = 0.4});
  const RadiositySolution solution = solve_pass_one(l->light, {});
  std::map<std::array<long, 3>, glm::vec3> value_at;
  for (const std::size_t v : vertices_of(*l, "globe")) {
    const Point3 x = l->mesh.vertices[v];
    const std::array<long, 3> place{std::lround(1e5 * x.x), std::lround(1e5 * x.y),
                                    std::lround(1e5 * x.z)};
    const glm::vec3 value = solution.field.irradiance[v];
    EXPECT_GT(value.g, 0.0F);
    EXPECT_EQ(value_at.try_emplace(place, value).first->second, value);
  }
  EXPECT_EQ(value_at.size(), 24U * 11U + 2U);
}

// Two routes: the globe's mean irradiance from its vertices, and from its elements.
// Corners weigh areas a little differently: 2 %.
TEST(Facets, KeepTheMeanOfTheElements) {
  const auto l = lit(room_with_globe(), {.element_size = 0.4});
  const RadiositySolution solution = solve_pass_one(l->light, {});
  const auto means = corner_means(l->mesh, solution.field.irradiance);
  const double from_vertices = mean_over(*l, means, "globe").g,
               from_elements = mean_over(*l, solution.irradiance, "globe").g;
  EXPECT_NEAR(from_vertices, from_elements, 0.02 * from_elements);
}

// The part that comes by way of the mirror, in the share that 16 rays find at each of 288 facets,
// against 512 rays there. A share is off by at most 0.5 / sqrt(16) in the mean square,
// that of all by a 17th of it: four sigma are 3 %.
TEST(Facets, KnowWhatComesByWayOfMirrors) {
  const auto l = lit(room_with_globe(), {.element_size = 0.4});
  const RadiositySolution solution = solve_pass_one(l->light, {});
  std::vector<Rgb> reflected = solution.radiosity;
  for (std::size_t e = 0; e < reflected.size(); ++e)
    reflected[e] -= l->mesh.emission[e];
  const PointGathering gathering(*l->light, reflected, {}, {}, {});
  PointWorkspace work;
  std::vector<Rgb> mirrored(element_count(l->mesh), Rgb(0.0)), all = mirrored;
  for (const std::size_t e : elements_of(*l, "globe")) {
    const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[e])];
    const ArrivingLight found = light_at(gathering,
                                         {centre_of(l->mesh, static_cast<ElementId>(e)),
                                          side.normal, side.plane_class, side.tangent},
                                         static_cast<std::uint32_t>(e), work)
                                    .all();
    mirrored[e] = found.mirrored;
    all[e] = found.total;
  }
  const auto means = corner_means(l->mesh, solution.field.mirrored);
  const double share = mean_over(*l, means, "globe").g /
                       mean_over(*l, corner_means(l->mesh, solution.field.irradiance), "globe").g;
  const double wanted = mean_over(*l, mirrored, "globe").g / mean_over(*l, all, "globe").g;
  EXPECT_GT(wanted, 0.05);
  EXPECT_NEAR(share, wanted, 0.03);
  for (std::size_t v = 0; v < solution.field.mirrored.size(); ++v)
    EXPECT_LE(solution.field.mirrored[v].g, solution.field.irradiance[v].g * 1.0001F);
}

// Where nobody asks, rays that only tell the two parts apart are not sent, and all else stays to the bit.
TEST(Facets, AskNothingOfMirrorsForAPictureWithoutLayers) {
  const auto l = lit(room_with_globe(), {.element_size = 0.4});
  for (const MeshCut cut : {MeshCut::uniform, MeshCut::hierarchical}) {
    PassOneSettings settings;
    settings.cut = cut;
    const RadiositySolution asked = solve_pass_one(l->light, settings);
    settings.interpolation.mirrored = false;
    const RadiositySolution plain = solve_pass_one(l->light, settings);
    EXPECT_EQ(plain.field.irradiance, asked.field.irradiance);
    EXPECT_EQ(plain.field.indirect, asked.field.indirect);
    EXPECT_FALSE(asked.field.mirrored.empty());
    EXPECT_TRUE(plain.field.mirrored.empty());
    EXPECT_TRUE(plain.field.indirect_mirrored.empty());
    EXPECT_LT(plain.form_factor_rays, asked.form_factor_rays);
  }
}

// Light that is linear in space, as clusters have it: their means. Spread from one to the next it is nearer to what it
// stands for, and stays within what there was.
TEST(Facets, OfClustersShareTheirLightOut) {
  Scene scene = half_room();
  add_globe(scene, "globe", {{1.2, 1.1, 1.3}, 0.15, 100, 50}, diffuse(0.6));
  const auto l = lit(std::move(scene), {.element_size = 0.5});
  const std::size_t size = element_count(l->mesh);
  const auto light_at = [](const Point3& x) { return 1.0 + 4.0 * (x.y - 1.1); };
  const FaceClusters clusters = face_clusters(*l->light);
  ASSERT_GT(clusters.size(), 100U);
  ElementLight elements{std::vector<Rgb>(size, Rgb(0.0)), std::vector<Rgb>(size, Rgb(1.0)),
                        std::vector<Rgb>(size, Rgb(0.0))};
  std::vector<std::uint8_t> clustered(size, 0);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    double mean = 0.0, area = 0.0;
    for (const SideId side : clusters.of(c)) {
      const std::uint32_t e = l->mesh.sides[index(side)].first_element;
      mean += l->mesh.area[e] * light_at(centre_of(l->mesh, ElementId{e}));
      area += l->mesh.area[e];
    }
    for (const SideId side : clusters.of(c)) {
      const std::uint32_t e = l->mesh.sides[index(side)].first_element;
      elements.irradiance[e] = Rgb(mean / area);
      clustered[e] = 1;
    }
  }
  const VertexElements facets = facets_around(*l->light);
  const FormFactorSettings rays;
  PointWorkspaces workspaces;
  const auto squared_error = [&](std::span<const std::uint8_t> spread) {
    VertexSamples found = make_samples(*l->light, facets);
    average_facets(*l->light, elements, facets, {rays, spread, false}, workspaces, found.field);
    double sum = 0.0;
    for (const std::size_t v : vertices_of(*l, "globe")) {
      EXPECT_GE(found.field.indirect[v].g, 0.4F);
      EXPECT_LE(found.field.indirect[v].g, 1.6F);
      const double error = double{found.field.indirect[v].g} - light_at(l->mesh.vertices[v]);
      sum += error * error;
    }
    return sum;
  };
  // Half the error of steps between means is what one ring leaves; four leave less.
  EXPECT_LT(squared_error(clustered), 0.5 * squared_error({}));
}

} // namespace
} // namespace meninas::test
