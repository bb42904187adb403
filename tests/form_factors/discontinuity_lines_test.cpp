// Blockers close to the face that sends: the band in which their shadow begins is as narrow as the
// gap, and points of the face may miss it. Seen from the other side nothing is narrow.
#include "form_factors/point_form_factor.h"
#include "form_factors/discontinuity_lines.h"
#include "tests/form_factors/asked_factors.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// [x0, x1] x [y0, y1]
struct Rectangle {
  double x0, x1, y0, y1;
};

std::vector<Point3> at_height(const Rectangle& r, double z) {
  return {{r.x0, r.y0, z}, {r.x1, r.y0, z}, {r.x1, r.y1, z}, {r.x0, r.y1, z}};
}

std::vector<Point3> facing_down(const Rectangle& r, double z) {
  std::vector<Point3> corners = at_height(r, z);
  std::swap(corners[1], corners[3]);
  return corners;
}

constexpr Rectangle unit{0.0, 1.0, 0.0, 1.0};

Scene blocked_pair(const std::vector<Point3>& a, const std::vector<Point3>& b,
                   const std::vector<Point3>& blocker) {
  Scene scene;
  add_polygon(scene, "a", a, diffuse(0.5));
  add_polygon(scene, "b", b, diffuse(0.5));
  add_polygon(scene, "blocker", blocker, double_sided(diffuse(0.0)));
  return scene;
}

/// A_A F_AB of the unit square at height 0 and a rectangle at height 1, past a parallel rectangle
/// between: for a point of B it throws a shadow on A that is a rectangle, so the point sees A
/// without that, in closed form. Over B that is smooth but where the shadow comes to A's edges.
double exchange(const Rectangle& b, const Rectangle& blocker, double gap) {
  const double stretch = 1.0 / (1.0 - gap);
  const auto on_a = [&](double corner, double eye) {
    return std::clamp(eye + stretch * (corner - eye), 0.0, 1.0);
  };
  const auto seen = [&](double x, double y) {
    const Rectangle shadow{on_a(blocker.x0, x), on_a(blocker.x1, x), on_a(blocker.y0, y),
                           on_a(blocker.y1, y)};
    const Point3 eye(x, y, 1.0);
    const Direction down(0.0, 0.0, -1.0);
    return point_form_factor(eye, down, at_height(unit, 0.0)) -
           point_form_factor(eye, down, at_height(shadow, 0.0));
  };
  const auto panels = [&](double low, double high, double c0, double c1) {
    std::vector<double> at{low, high};
    for (const double corner : {c0, c1})
      for (const double edge : {0.0, 1.0})
        at.push_back(std::clamp((edge - stretch * corner) / (1.0 - stretch), low, high));
    std::ranges::sort(at);
    return at;
  };
  const auto over = [](const std::vector<double>& at, const auto& f) {
    double sum = 0.0;
    for (std::size_t k = 1; k < at.size(); ++k)
      if (at[k] > at[k - 1])
        sum += integrate(f, at[k - 1], at[k], 1e-10).value;
    return sum;
  };
  const auto xs = panels(b.x0, b.x1, blocker.x0, blocker.x1),
             ys = panels(b.y0, b.y1, blocker.y0, blocker.y1);
  return over(xs, [&](double x) { return over(ys, [&](double y) { return seen(x, y); }); });
}

// The blocker's edges along the lines by which A is divided, off them, and beyond A;
// blockers smaller than the spacing of the first points, and a bar thinner than the gap.
// The error is within what is stated, and that within the accuracy: of either way.
// 1e-9 is the accuracy of the integration over B and A's edges.
TEST(ShadowLines, ParallelBlockersInClosedForm) {
  const std::vector<Rectangle> blockers{{0.25, 0.75, 0.25, 0.75}, {0.2, 0.7, 0.3, 0.65},
                                        {0.0, 1.0, 0.25, 0.5},    {-0.5, 0.5, -0.5, 1.5},
                                        {0.5, 0.51, 0.5, 0.51},   {0.1, 0.9, 0.5, 0.501}};
  for (const Rectangle& b : {unit, Rectangle{0.3, 0.31, 0.4, 0.41}})
    for (const Rectangle& blocker : blockers)
      for (const double gap : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const Scene scene =
            blocked_pair(at_height(unit, 0.0), facing_down(b, 1.0), at_height(blocker, gap));
        const double expected = exchange(b, blocker, gap);
        for (const bool back : {false, true}) {
          const Asked asked = back ? ask(scene, "b", "a") : ask(scene, "a", "b");
          const Estimate& total = asked.factor.total;
          EXPECT_LE(std::abs(asked.area * total.value - expected), asked.area * total.error + 1e-9)
              << blocker.x0 << ' ' << blocker.y0 << " gap " << gap << (back ? " from b" : " from a")
              << " b " << b.x0;
          EXPECT_LE(total.error, 1e-4 * total.value);
        }
      }
}

// A_A F_AB = A_B F_BA, to the errors stated, which are within the accuracy.
void expect_reciprocity(const Scene& scene, const std::string& name) {
  const Asked ab = ask(scene, "a", "b"), ba = ask(scene, "b", "a");
  EXPECT_GT(ab.factor.total.value, 0.0) << name;
  EXPECT_NEAR(ab.area * ab.factor.total.value, ba.area * ba.factor.total.value,
              ab.area * ab.factor.total.error + ba.area * ba.factor.total.error)
      << name;
  EXPECT_LE(ab.factor.total.error, 1e-4 * ab.factor.total.value) << name;
}

// One edge of the blocker is a gap above A, or one corner, or it lies parallel to a tilted A;
// B stands on A's plane, where shadows have no end, or across.
TEST(ShadowLines, TiltedBlockers) {
  for (const double gap : {1e-2, 1e-3, 1e-4}) {
    const std::vector<Point3> across = facing_down(unit, 1.0),
                              upright{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}};
    const std::vector<Point3> edge{
        {0.25, 0.25, gap}, {0.75, 0.25, gap}, {0.75, 0.7, 0.2}, {0.25, 0.7, 0.2}};
    const std::vector<Point3> corner{{0.25, 0.25, gap}, {0.75, 0.3, 0.1}, {0.5, 0.75, 0.2}};
    const std::vector<Point3> flat = at_height({0.25, 0.75, 0.25, 0.75}, gap);
    for (const auto& blocker : {edge, corner, flat}) {
      const std::string name = " gap " + std::to_string(gap);
      expect_reciprocity(blocked_pair(at_height(unit, 0.0), across, blocker), "across" + name);
      expect_reciprocity(blocked_pair(at_height(unit, 0.0), upright, blocker), "upright" + name);
    }
  }
}

// A and B side by side under a mirror, the blocker before A: all light goes by way of the mirror.
TEST(ShadowLines, ThroughAMirror) {
  for (const double gap : {1e-2, 1e-3}) {
    Scene scene = blocked_pair(at_height(unit, 0.0), at_height({1.0, 2.0, 0.0, 1.0}, 0.0),
                               at_height({0.25, 0.75, 0.25, 0.75}, gap));
    add_polygon(scene, "mirror", facing_down({-0.5, 2.5, -0.5, 1.5}, 1.0), mirror(0.9));
    expect_reciprocity(scene, "gap " + std::to_string(gap));
  }
}

// A sees B by way of a mirror a gap before it, from where it sees past the mirror's rim alone.
TEST(ShadowLines, PastTheRimOfAMirror) {
  for (const double gap : {1e-1, 1e-2, 1e-3, 1e-4}) {
    Scene scene = blocked_pair(at_height(unit, 0.0), at_height({1.0, 2.0, 0.0, 1.0}, -0.3),
                               at_height({0.2, 0.8, -0.1, 0.5}, 0.5));
    add_polygon(scene, "mirror", facing_down({0.25, 1.75, 0.25, 0.75}, gap), mirror(1.0));
    expect_reciprocity(scene, "gap " + std::to_string(gap));
  }
}

// Two faces of a sheet have one edge between them, which is no outline where the sheet goes on.
TEST(ShadowLines, EdgesOfASheetAreShared) {
  Scene scene;
  add_polygon(scene, "one", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  add_polygon(scene, "two", {{1, 0, 0}, {2, 0, 0.1}, {2, 1, 0.1}, {1, 1, 0}}, diffuse(0.5));
  const std::vector<BlockerEdge> edges = edges_of(joined_faces(find_surfaces(scene)));
  EXPECT_EQ(edges.size(), 7U);
  EXPECT_EQ(std::ranges::count_if(edges, [](const auto& e) { return e.beside.size() == 2; }), 1);
}

} // namespace
} // namespace meninas::test
