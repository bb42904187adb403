// The method of images, element by element:
// a room with mirrors is the room and its images, and the analytic method finds both.
#include "radiosity/transport/analytic_rows.h"
#include "scenes/errors.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace meninas::test {
namespace {

struct RoomPart {
  std::string name;
  std::vector<Point3> corners;
  Material material;
};
using Room = std::vector<RoomPart>;

Scene scene_of(const Room& room) {
  Scene scene;
  for (const RoomPart& part : room)
    add_polygon(scene, part.name, part.corners, part.material);
  return scene;
}

/// Reflections in planes through the origin, one after the other.
Point3 image_of(Point3 x, const std::vector<Direction>& normals) {
  for (const Direction& n : normals)
    x -= 2.0 * glm::dot(n, x) * n;
  return x;
}

/// The room without its mirrors, and all of its images.
Scene with_images(const Room& room, const std::vector<std::vector<Direction>>& images) {
  Room whole;
  for (std::size_t k = 0; k <= images.size(); ++k)
    for (RoomPart part : room) {
      if (is_mirror(part.material))
        continue;
      if (k > 0) {
        part.name += ".image" + std::to_string(k);
        for (Point3& corner : part.corners)
          corner = image_of(corner, images[k - 1]);
        if (images[k - 1].size() % 2 == 1)
          std::reverse(part.corners.begin(), part.corners.end());
      }
      whole.push_back(std::move(part));
    }
  return scene_of(whole);
}

/// Irradiance by where an element is and how it faces.
using Field = std::map<std::array<long, 6>, Rgb>;

PassOneSettings analytic(double element_size) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.method = FormFactorMethod::analytic;
  settings.form_factors.accuracy = 1e-4;
  settings.solver.tolerance = 1e-7;
  settings.interpolation.method = Interpolation::average;
  return settings;
}

Field field_of(const Scene& scene, const PassOneSettings& settings) {
  const auto l = lit(scene, settings.mesh, settings.plan);
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  EXPECT_TRUE(solution.solver.converged);
  Field field;
  for (std::size_t e = 0; e < element_count(l->mesh); ++e) {
    const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[e])];
    Point3 sum(0.0);
    const int corners = side.triangle ? 3 : 4;
    for (int k = 0; k < corners; ++k)
      sum += l->mesh.vertices[index(l->mesh.corners[e][static_cast<std::size_t>(k)])];
    const Point3 centre = sum / double(corners);
    const Direction n = side.normal;
    field[{std::lround(centre.x * 1e4), std::lround(centre.y * 1e4), std::lround(centre.z * 1e4),
           std::lround(n.x * 1e2), std::lround(n.y * 1e2), std::lround(n.z * 1e2)}] =
        solution.irradiance[e];
  }
  return field;
}

/// Every element of the mirrored room receives what it receives among the images.
void expect_same(const Room& room, const std::vector<std::vector<Direction>>& images,
                 double element_size) {
  const PassOneSettings settings = analytic(element_size);
  const Field mirrored = field_of(scene_of(room), settings),
              whole = field_of(with_images(room, images), settings);
  ASSERT_GE(whole.size(), mirrored.size() * (images.size() + 1));
  for (const auto& [place, irradiance] : mirrored) {
    const auto found = whole.find(place);
    ASSERT_NE(found, whole.end());
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(irradiance[band], found->second[band], 1e-4 * found->second[band])
          << place[0] << ' ' << place[1] << ' ' << place[2] << ", facing " << place[3] << ' '
          << place[4] << ' ' << place[5];
  }
}

const Direction x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

/// A room 1.5 x 1.4 x 1 m, part of whose ceiling is a lamp. Walls x = 0 and y = 0 are given.
Room box_room(const Material& x0, const Material& y0) {
  constexpr double a = 1.5, b = 1.4, c = 1.0;
  Room room{{"x0", {{0, 0, 0}, {0, b, 0}, {0, b, c}, {0, 0, c}}, x0},
            {"x1", {{a, 0, 0}, {a, 0, c}, {a, b, c}, {a, b, 0}}, diffuse(Rgb(0.7, 0.3, 0.2))},
            {"y0", {{0, 0, 0}, {0, 0, c}, {a, 0, c}, {a, 0, 0}}, y0},
            {"y1", {{0, b, 0}, {a, b, 0}, {a, b, c}, {0, b, c}}, diffuse(Rgb(0.2, 0.4, 0.7))},
            {"z0", {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}}, diffuse(0.5)},
            {"z1", {{0.6, 0, c}, {0.6, b, c}, {a, b, c}, {a, 0, c}}, diffuse(0.8)},
            {"lamp", {{0, 0, c}, {0, b, c}, {0.6, b, c}, {0.6, 0, c}}, diffuse(0.3, 10.0)}};
  return room;
}

TEST(AnalyticMethodOfImages, OneMirror) {
  expect_same(box_room(mirror(1.0), diffuse(0.4)), {{x_axis}}, 1.0);
}

TEST(AnalyticMethodOfImages, ACornerOfTwo) {
  expect_same(box_room(mirror(1.0), mirror(1.0)), {{x_axis}, {y_axis}, {x_axis, y_axis}}, 1.0);
}

// Two mirrors that enclose 60 degrees:
// five images, and the one behind both is met once, not once for either order.
TEST(AnalyticMethodOfImages, AWedgeOfSixtyDegrees) {
  const double s = std::sqrt(0.75), h = 0.8;
  const Point3 p{0, 0, 0}, q{1, 0, 0}, r{0.5, s, 0}, up{0, 0, h};
  const Room room{{"m0", {p, p + up, q + up, q}, mirror(1.0)},
                  {"m1", {p, r, r + up, p + up}, mirror(1.0)},
                  {"wall", {q, q + up, r + up, r}, diffuse(Rgb(0.7, 0.5, 0.3))},
                  {"floor", {p, q, r}, diffuse(0.5)},
                  {"ceiling", {p + up, r + up, 0.5 * (p + q) + up}, diffuse(0.8)},
                  {"lamp", {0.5 * (p + q) + up, r + up, q + up}, diffuse(0.3, 10.0)}};
  const Direction n0{0, 1, 0}, n1{s, -0.5, 0};
  expect_same(room, {{n0}, {n1}, {n0, n1}, {n1, n0}, {n0, n1, n0}}, 1.1);
}

/// The wall x = 0 around a rectangle in its middle, and that rectangle.
Room framed_room(const Material& frame, const Material& middle) {
  Room room = box_room(diffuse(0.5), diffuse(0.4));
  room.erase(room.begin());
  const auto piece = [](double y0, double z0, double y1, double z1) -> std::vector<Point3> {
    return {{0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}};
  };
  room.push_back({"below", piece(0, 0, 1.4, 0.3), frame});
  room.push_back({"above", piece(0, 0.7, 1.4, 1), frame});
  room.push_back({"left", piece(0, 0.3, 0.4, 0.7), frame});
  room.push_back({"right", piece(1.0, 0.3, 1.4, 0.7), frame});
  room.push_back({"middle", piece(0.4, 0.3, 1.0, 0.7), middle});
  return room;
}

TEST(AnalyticMethodOfImages, AMirrorWithAHole) {
  expect_same(framed_room(mirror(1.0), diffuse(0.6)), {{x_axis}}, 1.0);
}

TEST(AnalyticMethodOfImages, AMirrorInAFrame) {
  expect_same(framed_room(diffuse(0.6), mirror(1.0)), {{x_axis}}, 1.0);
}

TEST(AnalyticMethodOfImages, ABlockerBeforeTheMirror) {
  Room room = box_room(mirror(1.0), diffuse(0.4));
  room.push_back({"plate",
                  {{0.3, 0.4, 0.3}, {0.3, 0.9, 0.3}, {0.4, 0.9, 0.7}, {0.4, 0.4, 0.7}},
                  double_sided(diffuse(0.6))});
  expect_same(room, {{x_axis}}, 2.0);
}

// Between facing mirrors over black walls:
// the sum over |k| <= n of rho^|k| times the light of lamp k, with open ends instead of mirrors.
TEST(AnalyticMethodOfImages, FacingMirrorsToADepth) {
  constexpr int depth = 3;
  const double rho = 0.8;
  const Material black = diffuse(0.0);
  const auto room = [&](bool mirrors) {
    Room parts{{"y0", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, black},
               {"y1", {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, black},
               {"z0", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, black},
               {"z1.left", {{0, 0, 1}, {0, 1, 1}, {0.2, 1, 1}, {0.2, 0, 1}}, black},
               {"z1.right", {{0.5, 0, 1}, {0.5, 1, 1}, {1, 1, 1}, {1, 0, 1}}, black}};
    if (mirrors) {
      parts.push_back({"x0", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, mirror(rho)});
      parts.push_back({"x1", {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, mirror(rho)});
    }
    for (int k = mirrors ? 0 : -depth; k <= (mirrors ? 0 : depth); ++k) {
      // The lamp, a strip of the ceiling, is off the middle:
      // odd images lie on the other side of theirs.
      const double low = k % 2 == 0 ? 0.2 : 0.5, high = low + 0.3;
      parts.push_back({"lamp" + std::to_string(k),
                       {{k + low, 0, 1}, {k + low, 1, 1}, {k + high, 1, 1}, {k + high, 0, 1}},
                       diffuse(0.0, 10.0 * std::pow(rho, std::abs(k)))});
    }
    return scene_of(parts);
  };
  PassOneSettings settings = analytic(0.5);
  settings.form_factors.max_bounces = depth;
  const Field mirrored = field_of(room(true), settings), unrolled = field_of(room(false), settings);
  ASSERT_EQ(mirrored.size(), 18U);
  for (const auto& [place, irradiance] : mirrored) {
    const auto found = unrolled.find(place);
    ASSERT_NE(found, unrolled.end());
    EXPECT_NEAR(irradiance.r, found->second.r, 1e-4 * found->second.r + 1e-12);
  }
}

// Whatever stands in a closed room, all light ends: on elements, on black backs, in the mirror.
// An element under the box counts with the part beside it.
TEST(AnalyticTransport, RowsClose) {
  Scene scene = scene_of(framed_room(diffuse(0.6), mirror(0.9)));
  add_box(scene, "box", {0.5, 0.4, 0.0}, {0.9, 1.0, 0.5}, diffuse(0.5));
  const auto l = lit(std::move(scene), {.element_size = 2.0});
  FormFactorSettings settings;
  settings.method = FormFactorMethod::analytic;
  settings.accuracy = 1e-3;
  const FormFactors factors = assemble_transport(*l->light, settings);
  double covered = 0.0;
  for (std::size_t i = 0; i < factors.closure.size(); ++i) {
    const RowClosure& row = factors.closure[i];
    EXPECT_NEAR(row.landed + row.black + row.escaped + row.cut, 1.0, settings.accuracy);
    EXPECT_EQ(row.escaped, 0.0F);
    EXPECT_LE(row.cut, 0.2 * settings.accuracy);
    covered += (1.0 - double{factors.exposed[i]}) * l->mesh.area[i];
  }
  constexpr double underside = 0.4 * 0.6;
  EXPECT_NEAR(covered, 2.0 * underside, 1e-6); // of the floor, and the underside itself
}

// A_i T_ij = A_j T_ji: the chains of grey mirrors reversed bring back the same.
TEST(AnalyticTransport, IsReciprocal) {
  const auto l = lit(scene_of(framed_room(diffuse(0.6), mirror(0.9))), {.element_size = 1.0});
  FormFactorSettings settings;
  settings.method = FormFactorMethod::analytic;
  const Transport t = assemble_transport(*l->light, settings).transport;
  std::map<std::pair<std::size_t, std::size_t>, double> flow;
  for (std::size_t i = 0; i < t.size; ++i)
    for (auto k = t.row_begin[i]; k < t.row_begin[i + 1]; ++k)
      flow[{i, t.columns[k]}] = l->mesh.area[i] * double{t.weights[k]};
  for (const auto& [pair, there] : flow) {
    const double area = std::max(l->mesh.area[pair.first], l->mesh.area[pair.second]);
    EXPECT_NEAR(there, (flow[{pair.second, pair.first}]), 1e-4 * area);
  }
}

TEST(AnalyticTransport, RefusesWhatWouldTakeTooLong) {
  const auto l = lit(furnace(0.5, {}), {.element_size = 0.02});
  FormFactorSettings settings;
  settings.method = FormFactorMethod::analytic;
  EXPECT_THROW(assemble_transport(*l->light, settings), UsageError);
}

} // namespace
} // namespace meninas::test
