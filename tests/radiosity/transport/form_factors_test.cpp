#include "radiosity/transport/form_factors.h"
#include "tests/form_factors/known_form_factors.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

constexpr int rays = 512;

double area_of(const std::vector<Point3>& corners) {
  return glm::length(area_vector(std::span(corners)));
}

/// Binomial: each of N rays arrives with probability F.
/// Rays through mirrors of less than 1 weigh less, so this is an upper bound.
double sigma(double form_factor, double samples) {
  return std::sqrt(std::max(form_factor * (1.0 - form_factor), 0.0) / samples);
}

double samples_of(const LitScene& lit, const std::string& node) {
  return double(elements_of(lit, node).size()) * rays;
}

struct Tally {
  double sum_of_squares = 0.0;
  int count = 0;

  void add(double z) {
    sum_of_squares += z * z;
    ++count;
  }
  double rms() const { return std::sqrt(sum_of_squares / count); }
};

// 4 sigma: one of 16,000 honest results is further off.
// Less than one hit is no more than chance either way.
// The net of rays is low-discrepancy, so all results together are nearer than random ones would be:
// rms < 1 sigma.
TEST(FormFactors, PairsOfPolygons) {
  Tally tally;
  for (const auto& c : known_pair_form_factors()) {
    Scene scene;
    add_polygon(scene, "a", c.a, diffuse(0.0));
    add_polygon(scene, "b", c.b, diffuse(0.0));
    // Some 64 elements or more on a, of whatever shape it is, and not too many on b.
    const double longest = std::max(glm::distance(c.a[0], c.a[1]), glm::distance(c.a[1], c.a[2]));
    const double size =
        std::max({std::sqrt(area_of(c.a) / 64.0), longest / 64.0, std::sqrt(area_of(c.b)) / 64.0});
    const auto l = lit(std::move(scene), {.element_size = size});
    const FormFactors factors = assemble_transport(*l->light, {.rays = rays});
    const double n = samples_of(*l, "a");
    const double error = form_factor(*l, factors.transport, "a", "b") - c.form_factor;
    EXPECT_LT(std::abs(error), 4.0 * sigma(c.form_factor, n) + 1.0 / n)
        << c.name << " (" << c.formula << ")";
    if (sigma(c.form_factor, n) * n > 3.0)
      tally.add(error / sigma(c.form_factor, n));
  }
  EXPECT_GT(tally.count, 50);
  EXPECT_LT(tally.rms(), 1.0);
}

Scene scene_of(const std::string& name, double mirror_reflectance) {
  Scene scene;
  for (const auto& polygon : known_scene(name)) {
    const Material material = polygon.role == Role::mirror    ? mirror(mirror_reflectance)
                              : polygon.role == Role::blocker ? double_sided(diffuse(0.0))
                                                              : diffuse(0.0);
    add_polygon(scene, polygon.name, polygon.corners, material);
  }
  return scene;
}

TEST(FormFactors, BlockersMirrorsAndRooms) {
  Tally tally;
  for (const auto& c : known_scene_form_factors()) {
    const auto l = lit(scene_of(c.scene, c.mirror_reflectance),
                       {.element_size = 0.125 * (std::string(c.scene) == "lroom" ? 2.0 : 1.0)});
    const FormFactors factors = assemble_transport(*l->light, {.rays = rays});
    const double n = samples_of(*l, c.from);
    const double error = form_factor(*l, factors.transport, c.from, c.to) - c.form_factor;
    EXPECT_LT(std::abs(error), 4.0 * sigma(c.form_factor, n) + 1e-12)
        << c.name << " (" << c.formula << ")";
    if (c.form_factor > 0.0 && c.form_factor < 1.0)
      tally.add(error / sigma(c.form_factor, n));
  }
  EXPECT_GT(tally.count, 40);
  EXPECT_LT(tally.rms(), 1.0);
}

/// Rooms of every kind: closed, open, with mirrors, with blockers.
std::vector<Scene> sample_rooms() {
  std::vector<Scene> scenes{half_room(), half_room_with_small_mirror(), doubled(half_room()),
                            facing_mirrors(Rgb(0.9, 0.7, 0.5)),
                            furnace(0.5, {true, true, true, true, false, true})};
  scenes.push_back(half_room());
  scenes.back().triangles.resize(scenes.back().triangles.size() -
                                 6); // open at the bottom of the box
  scenes.push_back(half_room());
  scenes.back().triangles.erase(scenes.back().triangles.begin() + 2,
                                scenes.back().triangles.begin() + 4); // without a wall
  return scenes;
}

void expect_closed_rows(const FormFactors& factors) {
  const Transport& t = factors.transport;
  for (std::size_t i = 0; i < t.size; ++i) {
    // Every ray ends in one place:
    // fractions of at most 256 rays, or delta form factors of 768 cells, added in floats.
    const RowClosure& row = factors.closure[i];
    EXPECT_NEAR(row.landed + row.escaped + row.black + row.cut, 1.0F, 1e-6F);
    // And so does the light of all rays; the light of cut rays is shared out among the rest.
    for (int band = 0; band < 3; ++band) {
      double landed = 0.0;
      for (auto k = t.row_begin[i]; k < t.row_begin[i + 1]; ++k)
        landed += t.weights[k * static_cast<std::size_t>(t.bands) +
                            static_cast<std::size_t>(t.bands == 1 ? 0 : band)];
      const double lost =
          row.escaped_light[band] + row.black_light[band] + row.mirror_absorbed[band];
      EXPECT_NEAR(landed + lost / (1.0 - row.cut_light[band]), 1.0, 1e-5);
    }
  }
}

TEST(FormFactors, RowsClose) {
  for (const auto& scene : sample_rooms()) {
    const auto l = lit(scene, {.target_elements = 300});
    expect_closed_rows(assemble_transport(*l->light, {.rays = 256}));
    expect_closed_rows(assemble_transport(
        *l->light, {.method = FormFactorMethod::hemicube, .hemicube_resolution = 16}));
  }
}

// A lamp whose black back hides most of the ceiling from every point of a cell:
// light comes in under its edge, so nothing is covered.
TEST(FormFactors, WhatHangsAboveDoesNotCover) {
  for (const int net : {16, 64, 128, 512}) {
    const auto l = lit(half_room(), {.element_size = 0.05});
    const FormFactors factors = assemble_transport(*l->light, {.rays = net});
    for (const auto e : elements_of(*l, "y1"))
      EXPECT_EQ(factors.exposed[e], 1.0F);
    // Under the box, 0.6 m x 0.7 m on the floor, nothing is exposed.
    // Cells of an eighth of an element that its edges divide count as exposed,
    // and what is too little for a ray to start there.
    double covered = 0.0;
    for (const auto e : elements_of(*l, "y0"))
      covered += l->mesh.area[e] * (1.0 - double{factors.exposed[e]});
    EXPECT_NEAR(covered, 0.42, 2.6 * 0.05 / 8.0 + 52 * 0.05 * 0.05 / net) << net << " rays";
  }
}

TEST(FormFactors, ReciprocityOfSums) {
  const auto l = lit(half_room_with_small_mirror(), {.target_elements = 1500});
  const FormFactors factors = assemble_transport(*l->light, {.rays = 512});
  const std::vector<std::string> nodes{"x1",   "y0",    "y1",     "z0",    "z1",
                                       "left", "below", "box.y1", "box.x0"};
  for (const auto& a : nodes)
    for (const auto& b : nodes) {
      const auto area = [&](const std::string& node) {
        double sum = 0.0;
        for (const auto e : elements_of(*l, node))
          sum += l->mesh.area[e];
        return sum;
      };
      const auto samples = [&](const std::string& node) {
        return double(elements_of(*l, node).size()) * 512.0;
      };
      const double ab = form_factor(*l, factors.transport, a, b),
                   ba = form_factor(*l, factors.transport, b, a);
      const double noise = area(a) * sigma(ab, samples(a)) + area(b) * sigma(ba, samples(b));
      EXPECT_NEAR(area(a) * ab, area(b) * ba, 4.0 * noise + 1e-12) << a << ' ' << b;
    }
}

} // namespace
} // namespace meninas::test
