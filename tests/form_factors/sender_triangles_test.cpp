// Senders are cut into no more triangles than there is time for, and what that leaves out is said.
#include "form_factors/extended_form_factor.h"
#include "form_factors/sender_triangles.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {

namespace {

void add_tooth(Scene& scene, double x, double y) {
  const double z = 0.05;
  add_polygon(scene, "comb", {{x + 0.2, y, z}, {x + 0.8, y, z}, {x + 0.8, y + 0.1, z}, {x + 0.2, y + 0.1, z}},
              double_sided(diffuse(0.0)));
}

/// A floor of tiles under a comb, close below a ceiling: each tile is to be cut into some hundred parts.
struct TilesUnderAComb {
  static constexpr std::size_t tiles = 12;
  MirrorSet mirrors;
  std::vector<Face> blockers, senders;
  WorldView view{mirrors, blockers, {}, {}, 1e-9};

  TilesUnderAComb() {
    Scene scene;
    for (std::size_t k = 0; k < tiles; ++k) {
      // Neighbours are tilted by turns, so that they stay faces of their own.
      const double low = double(k), high = low + 1.0, rise = k % 2 == 0 ? 0.02 : -0.02;
      add_polygon(scene, "tile", {{low, 0, 0}, {high, 0, rise}, {high, 1, rise}, {low, 1, 0}}, diffuse(0.5));
      for (int tooth = 0; tooth < 4; ++tooth)
        add_tooth(scene, low, 0.2 * tooth + 0.1);
    }
    add_polygon(scene, "ceiling", {{0, 0, 1}, {0, 1, 1}, {12, 1, 1}, {12, 0, 1}}, diffuse(0.5));
    blockers = joined_faces(find_surfaces(scene));
    for (const Face& face : blockers) {
      const std::string& name = scene.nodes[index(face.node)].name;
      if (name == "tile")
        senders.push_back(face);
      else if (name == "ceiling")
        view.targets.push_back(face);
    }
    view.groups.assign(view.targets.size(), 0);
  }
};

} // namespace

TEST(SenderTriangles, ManySendersShareThem) {
  const TilesUnderAComb scene;
  const std::vector<std::uint8_t> known(scene.view.targets.size(), 0);
  std::vector<Sender> senders;
  double area = 0.0;
  for (std::uint32_t f = 0; f < scene.senders.size(); ++f) {
    senders.push_back({scene.senders[f], f, known});
    area += scene.senders[f].area;
  }
  ASSERT_EQ(senders.size(), scene.tiles);
  const auto cut = [&](std::size_t max_triangles) {
    return cut_senders(senders, scene.view, {false, 1'000'000, max_triangles});
  };
  const CutSenders all = cut(1'000'000), few = cut(120), whole = cut(0);
  EXPECT_FALSE(all.cut_short);
  EXPECT_GT(all.triangles.size(), 300U);
  EXPECT_TRUE(few.cut_short);
  EXPECT_GT(few.triangles.size(), 60U);
  // A cut splits several parts of a face at once, and a part may have a corner more than four.
  EXPECT_LE(few.triangles.size(), 240U);
  EXPECT_TRUE(whole.cut_short);
  EXPECT_EQ(whole.triangles.size(), triangles_of(senders).size());
  // Whatever the cuts, the triangles cover the faces.
  for (const CutSenders* senders_cut : {&all, &few, &whole}) {
    double sum = 0.0;
    for (const SenderTriangle& triangle : senders_cut->triangles)
      sum += triangle.area;
    EXPECT_NEAR(sum, area, 1e-12 * area);
  }
}

TEST(SenderTriangles, WorkIsBounded) {
  const TilesUnderAComb scene;
  ExtendedSettings settings;
  settings.accuracy = 0.01;
  const ExtendedFactors exact = extended_form_factors(scene.view, scene.senders, 1, settings);
  EXPECT_TRUE(exact.converged);
  settings.max_work = 300'000;
  const ExtendedFactors rough = extended_form_factors(scene.view, scene.senders, 1, settings);
  EXPECT_FALSE(rough.converged);
  EXPECT_LT(rough.points, exact.points / 4);
  const Estimate factor = rough.to.front().total, expected = exact.to.front().total;
  EXPECT_GT(factor.error, 0.0);
  EXPECT_NEAR(factor.value, expected.value, 0.05 * expected.value);
}

} // namespace meninas::test
