// Which elements a view shows, and what pass one makes of it.
#include "raytrace/views/seen_elements.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/metals.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace meninas::test {
namespace {

PassOneSettings room_settings() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.1;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  settings.cut = MeshCut::hierarchical;
  return settings;
}

RenderSettings small_picture() {
  RenderSettings settings;
  settings.width = 40;
  settings.height = 30;
  settings.samples = 4;
  return settings;
}

/// Names of the nodes of which an element is marked.
template <typename Mark>
std::set<std::string> marked_nodes(const Scene& scene, const Camera& camera,
                                   std::vector<Mark> SeenElements::*marks, DiffuseTerm term) {
  const auto prepared = prepare_scene(scene, room_settings());
  const LightScene& light = *prepared->light();
  RenderSettings settings = small_picture();
  settings.diffuse.term = term;
  const std::vector<Mark> seen = seen_elements(light, camera, settings).*marks;
  std::set<std::string> names;
  for (const MeshSide& side : light.mesh.sides) {
    const Patch& patch = light.surfaces.patches[index(side.patch)];
    const TriangleId triangle = patch.triangles[0];
    for (std::uint32_t k = 0; k < side.element_count; ++k)
      if (seen[side.first_element + k] != Mark{})
        names.insert(light.scene.nodes[index(light.scene.triangles[index(triangle)].node)].name);
  }
  return names;
}

/// Of which one is seen, and of which direct light is looked up when pixels find theirs.
std::set<std::string> seen_nodes(const Scene& scene, const Camera& camera) {
  return marked_nodes(scene, camera, &SeenElements::elements, DiffuseTerm::interpolated);
}
std::set<std::string> looked_up_nodes(const Scene& scene, const Camera& camera) {
  return marked_nodes(scene, camera, &SeenElements::direct, DiffuseTerm::direct);
}

/// A room 2 m wide whose walls are named x0 to z1, with a lamp.
Scene room(const Material& floor, const Material& x0) {
  Scene scene;
  const Material wall = diffuse(0.6);
  add_room(scene, Point3(0.0), Point3(2.0), {x0, wall, floor, wall, wall, wall});
  add_polygon(scene, "lamp", {{0.8, 1.9, 0.8}, {1.2, 1.9, 0.8}, {1.2, 1.9, 1.2}, {0.8, 1.9, 1.2}},
              diffuse(0.0, 5.0));
  return scene;
}

/// Narrow looks at the middles of the wall x = 0 and of the floor.
const Camera at_wall = look_at({1.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, 0.2);
const Camera at_floor = look_at({1.0, 1.0, 0.4}, {1.0, 0.0, 1.0}, 0.1);

TEST(SeenElements, AreThoseThatTheEyeMeets) {
  EXPECT_EQ(seen_nodes(room(diffuse(0.5), diffuse(0.5)), at_wall), std::set<std::string>{"x0"});
}

TEST(SeenElements, AreThoseInAMirrorAsWell) {
  EXPECT_EQ(seen_nodes(room(diffuse(0.5), mirror(0.9)), at_wall), std::set<std::string>{"x1"});
}

TEST(SeenElements, AreThoseBehindGlassAndInItsReflection) {
  Scene scene = room(diffuse(0.5), diffuse(0.5));
  add_polygon(scene, "pane", {{0.5, 0.1, 1.9}, {0.5, 0.1, 0.1}, {0.5, 1.9, 0.1}, {0.5, 1.9, 1.9}},
              glass(Rgb(1.0)));
  EXPECT_EQ(seen_nodes(scene, at_wall), (std::set<std::string>{"x0", "x1"}));
}

// The eye looks through the backs of walls, before a pane and behind it, whatever is left of bounces.
TEST(SeenElements, AreThoseBehindAPaneAndTheBackOfAWall) {
  Scene scene = room(diffuse(0.5), diffuse(0.5));
  add_polygon(scene, "pane", {{2.5, 0.1, 1.9}, {2.5, 0.1, 0.1}, {2.5, 1.9, 0.1}, {2.5, 1.9, 1.9}},
              glass(Rgb(1.0)));
  const auto prepared = prepare_scene(scene, room_settings());
  RenderSettings settings = small_picture();
  settings.max_bounces = 0;
  const SeenElements seen =
      seen_elements(*prepared->light(), look_at({4.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, 0.1), settings);
  EXPECT_GT(std::ranges::count(seen.elements, 1), 0) << "the wall x = 0, through that at x = 2";
}

// Pixels find the direct light of what sights end at, in mirrors and behind panes too;
// of what lobes and the reflections of panes show it is looked up.
TEST(SeenElements, HaveTheirDirectLightLookedUpWhereNoSightEnds) {
  const Scene matt = room(diffuse(0.5), diffuse(0.5)), satin = room(metal(Rgb(0.8), 0.4), diffuse(0.5));
  EXPECT_TRUE(looked_up_nodes(matt, at_wall).empty());
  EXPECT_TRUE(looked_up_nodes(room(diffuse(0.5), mirror(0.9)), at_wall).empty());
  EXPECT_EQ(marked_nodes(matt, at_wall, &SeenElements::direct, DiffuseTerm::interpolated),
            std::set<std::string>{"x0"});
  EXPECT_TRUE(looked_up_nodes(satin, at_floor).contains("y1"));
  Scene glazed = matt;
  add_polygon(glazed, "pane", {{0.5, 0.1, 1.9}, {0.5, 0.1, 0.1}, {0.5, 1.9, 0.1}, {0.5, 1.9, 1.9}},
              glass(Rgb(1.0)));
  EXPECT_EQ(looked_up_nodes(glazed, at_wall), std::set<std::string>{"x1"});
  Scene block = matt; // a sight goes straight through it, the light is bent
  add_box(block, "block", {0.3, 0.1, 0.1}, {0.6, 1.9, 1.9}, solid_glass(Rgb(1.0)));
  const Camera aslant = look_at({1.0, 1.0, 1.0}, {0.0, 1.0, 0.7}, 0.1);
  EXPECT_TRUE(looked_up_nodes(block, aslant).contains("x0"));
}

// A wall behind a mirror of 0.3 weighs 0.3, one that is seen straight 1.
TEST(SeenElements, WeighByTheThroughputOfThePathsThatShowThem) {
  const auto heaviest = [](const Scene& scene) {
    const auto prepared = prepare_scene(scene, room_settings());
    const auto weights = seen_elements(*prepared->light(), at_wall, small_picture()).direct;
    return double{*std::ranges::max_element(weights)};
  };
  EXPECT_EQ(heaviest(room(diffuse(0.5), diffuse(0.5))), 1.0);
  EXPECT_NEAR(heaviest(room(diffuse(0.5), mirror(0.3))), 0.3, 1e-6); // floats
}

// By a lobe a ceiling above a floor of satin metal; by a matt floor nothing else.
TEST(SeenElements, AreThoseThatLobesShow) {
  const auto seen = seen_nodes(room(metal(Rgb(0.8), 0.4), diffuse(0.5)), at_floor);
  EXPECT_TRUE(seen.contains("y1") && seen.contains("z1"));
  EXPECT_EQ(seen_nodes(room(diffuse(0.5), diffuse(0.5)), at_floor), std::set<std::string>{"y0"});
}

// The field of the view is that of the whole solution where it is seen, and of the first gathering elsewhere.
TEST(SolutionForAView, IsTheWholeOneWhereItIsSeen) {
  const PassOneSettings settings = room_settings();
  const auto prepared = prepare_scene(room(diffuse(0.5), mirror(0.9)), settings);
  const LightScene& light = *prepared->light();
  const Camera camera = look_at({1.6, 1.0, 1.0}, {0.0, 0.6, 0.8}, 0.5);
  const SeenElements seen = seen_elements(light, camera, small_picture());
  const RadiositySolution all = solve_pass_one(prepared->light(), settings),
                          view = solve_for_view(prepared->light(), settings, seen);
  const auto share = double(std::ranges::count(seen.elements, 1)) / double(seen.elements.size());
  ASSERT_LT(share, 0.6);
  EXPECT_LT(view.form_factor_rays, all.form_factor_rays);

  // Both show one picture: vertices that are gathered have the same bits.
  const Image whole = render(all.field, camera, small_picture()).image,
              part = render(view.field, camera, small_picture()).image;
  double squares = 0.0, light_of_all = 0.0;
  for (std::size_t p = 0; p < whole.pixels.size(); ++p) {
    squares += std::pow(double{part.pixels[p].g} - double{whole.pixels[p].g}, 2);
    light_of_all += double{whole.pixels[p].g};
  }
  const double n = double(whole.pixels.size());
  EXPECT_LT(std::sqrt(squares / n), 2e-3 * light_of_all / n); // beside the border of what is seen
  // Elsewhere light is off by what the first gathering allows, four times the bound.
  Rgb sum_view(0.0), sum_all(0.0);
  for (std::size_t e = 0; e < seen.elements.size(); ++e) {
    sum_view += light.mesh.area[e] * view.irradiance[e];
    sum_all += light.mesh.area[e] * all.irradiance[e];
  }
  EXPECT_NEAR(sum_view.g, sum_all.g, 0.01 * sum_all.g);
}

// Nodes that are seen in part have values at all of their vertices, seen or not.
TEST(SolutionForAView, LeavesNoVertexWithoutLight) {
  const PassOneSettings settings = room_settings();
  const auto prepared = prepare_scene(room(diffuse(0.5), mirror(0.9)), settings);
  std::vector<std::uint8_t> one(element_count(prepared->light()->mesh), 0);
  const RadiositySolution all = solve_pass_one(prepared->light(), settings);
  for (std::size_t e = 0; e < one.size(); e += one.size() / 7) {
    std::ranges::fill(one, 0);
    one[e] = 1;
    const std::vector<float> direct(one.begin(), one.end());
    const RadiositySolution view = solve_for_view(prepared->light(), settings, {one, direct});
    double worst = 0.0, mean = 0.0;
    for (std::size_t v = 0; v < all.field.indirect.size() && v < view.field.indirect.size(); ++v) {
      worst = std::max(worst, std::abs(double{view.field.indirect[v].g} -
                                       double{all.field.indirect[v].g}));
      mean += double{all.field.indirect[v].g} / double(all.field.indirect.size());
    }
    // Of 256 rays four standard deviations, where light varies by about its mean.
    EXPECT_LT(worst, 4.0 / std::sqrt(256.0) * 2.0 * mean) << e;
  }
}

// Elements are divided at edges of shadows where their direct light is looked up, and nowhere else;
// less where it is seen by way of dark mirrors.
TEST(SolutionForAView, HasEdgesOfShadowsWhereTheyAreLookedUp) {
  PassOneSettings settings = room_settings();
  settings.interpolation.shadow_bend = 0.01;
  Scene scene = room(diffuse(0.5), diffuse(0.5));
  add_polygon(scene, "shade", {{0.6, 1.0, 0.6}, {0.6, 1.0, 1.4}, {1.4, 1.0, 1.4}, {1.4, 1.0, 0.6}}, diffuse(0.5));
  const auto prepared = prepare_scene(std::move(scene), settings);
  const std::size_t solved = element_count(prepared->light()->mesh);
  const std::vector<std::uint8_t> all(solved, 1);
  const auto elements = [&](const std::vector<float>& direct) {
    return element_count(solve_for_view(prepared->light(), settings, {all, direct}).field.mesh());
  };
  const auto weighing = [&](float weight) { return std::vector<float>(solved, weight); };
  std::vector<float> half = weighing(0.0F);
  std::fill_n(half.begin(), solved / 2, 1.0F);
  EXPECT_EQ(elements(weighing(0.0F)), solved);
  EXPECT_GT(elements(half), solved);
  EXPECT_GT(elements(weighing(1.0F)), elements(half));
  EXPECT_GT(elements(weighing(1.0F)), elements(weighing(0.5F)));
  EXPECT_GT(elements(weighing(0.5F)), solved);
  EXPECT_EQ(elements(weighing(1e-4F)), solved);
}

TEST(SolutionForAView, ThatShowsEverythingIsTheWholeOneToTheBit) {
  const PassOneSettings settings = room_settings();
  const auto prepared = prepare_scene(room(diffuse(0.5), mirror(0.9)), settings);
  const std::vector<std::uint8_t> everything(element_count(prepared->light()->mesh), 1);
  const RadiositySolution all = solve_pass_one(prepared->light(), settings),
                          view = solve_for_view(prepared->light(), settings,
                                                {everything, std::vector<float>(everything.size(), 1.0F)});
  EXPECT_EQ(all.field.irradiance, view.field.irradiance);
  EXPECT_EQ(all.field.indirect, view.field.indirect);
}

} // namespace
} // namespace meninas::test
