#include "radiosity/queries/gltf_node_factors.h"
#include "radiosity/queries/node_tally.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// A hemicube and the part of A's area it stands for.
struct CubePlace {
  ReceiverArea point;
  double share = 0.0;
};

ReceiverArea point_on(const Face& face, const Point3& x) {
  ReceiverArea point;
  point.corner = x;
  point.normal = face.plane.normal;
  point.plane_class = face.plane_class;
  point.tangent = face.polygon.vertices[1] - face.polygon.vertices[0];
  return point;
}

/// Cells of a quad's (u, v), about square and about `count`: a strip has no more, however long.
/// Their parts of the area are those of their quads, half the diagonals' cross product.
void add_quad(const Face& face, double count, int split, double total_area,
              std::vector<CubePlace>& places) {
  const auto& p = face.polygon.vertices;
  const double along = glm::distance(p[0], p[1]) + glm::distance(p[3], p[2]),
               across = glm::distance(p[0], p[3]) + glm::distance(p[1], p[2]);
  const int columns = std::max(1, static_cast<int>(std::lround(std::min(count, std::sqrt(count * along / across)))));
  const int rows = std::max(1, static_cast<int>(std::lround(count / columns)));
  const int nu = columns * split, nv = rows * split;
  const auto at = [&](double i, double j) {
    const double u = i / nu, v = j / nv;
    return (1.0 - v) * ((1.0 - u) * p[0] + u * p[1]) + v * ((1.0 - u) * p[3] + u * p[2]);
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const Vec3 diagonals = glm::cross(at(i + 1, j + 1) - at(i, j), at(i, j + 1) - at(i + 1, j));
      places.push_back(
          {point_on(face, at(i + 0.5, j + 0.5)), 0.5 * glm::length(diagonals) / total_area});
    }
}

/// The n^2 equal triangles of each triangle of the polygon's fan.
void add_fan(const Face& face, double count, int split, double total_area,
             std::vector<CubePlace>& places) {
  const auto& p = face.polygon.vertices;
  for (std::size_t k = 2; k < face.polygon.size; ++k) {
    const Vec3 a = p[k - 1] - p[0], b = p[k] - p[0];
    const double area = 0.5 * glm::length(glm::cross(a, b));
    const int n =
        split * std::max(1, static_cast<int>(std::lround(std::sqrt(count * area / face.area))));
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i)
        for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
          // The triangle at (i, j) and the one between it and the next row
          if (third > 0.5 && i + j + 1 >= n)
            continue;
          const Point3 centre = p[0] + (i + third) / n * a + (j + third) / n * b;
          places.push_back({point_on(face, centre), area / (n * n * total_area)});
        }
  }
}

/// About `count` pieces of all faces, each split once more along both of its edges into `split`.
std::vector<CubePlace> places_of(const std::vector<Face>& faces, double count, int split) {
  double total = 0.0;
  for (const Face& face : faces)
    total += face.area;
  std::vector<CubePlace> places;
  for (const Face& face : faces) {
    const double part = std::max(1.0, count * face.area / total);
    if (face.polygon.size == 4)
      add_quad(face, part, split, total, places);
    else
      add_fan(face, part, split, total, places);
  }
  return places;
}

/// In a fixed number of parts, so that sums do not depend on the number of threads.
NodeTally tally_of(const NodeScene& scene, const Hemicube& cube,
                   const std::vector<CubePlace>& places) {
  constexpr std::size_t part_count = 32;
  std::vector<NodeTally> parts(part_count);
  tbb::parallel_for(std::size_t{0}, part_count, [&](std::size_t part) {
    GatherWorkspace work;
    for (std::size_t k = part; k < places.size(); k += part_count) {
      gather_rays(scene.light, cube, places[k].point, scene.settings, work);
      add(scene, work.result, places[k].share, parts[part]);
    }
  });
  NodeTally sum;
  for (const NodeTally& part : parts)
    add(part, sum);
  return sum;
}

/// Half a resolution to compare with:
/// twice an odd number, so that cells fall in step neither with those of the whole nor with pieces
/// that divide an edge by powers of two, whose rays would all graze the same outlines.
int about_half(int resolution) { return resolution / 8 * 4 + 2; }

/// Values with the cubes asked for; with half the resolution;
/// and with four times as many of these. The error of the cells is of order one or more:
/// with half the resolution it at least doubles, unless it changes its sign.
/// The error of the pieces is at worst, at kinks, of order 1/2: halving them takes 0.3 of it away.
Estimate cube_estimate(std::span<const double> values, double unseen) {
  const double cells = std::abs(values[0] - values[1]), pieces = std::abs(values[2] - values[1]);
  return {values[0], 2.0 * cells + 4.0 * pieces + unseen};
}

} // namespace

std::vector<ExtendedFactor> hemicube_form_factors(const Scene& scene, const SurfaceModel& surfaces,
                                                  const MirrorSet& mirrors,
                                                  const std::vector<Face>& from,
                                                  std::span<const NodeSet> to,
                                                  const NodeFactorSettings& settings) {
  const NodeScene node_scene(scene, surfaces, mirrors, {to, settings.sides}, settings.max_depth);
  require_landings(node_scene, {to, settings.sides});
  const std::vector<CubePlace> places = places_of(from, settings.points, 1);
  const Hemicube cube = make_hemicube(settings.resolution);
  const Hemicube coarse = make_hemicube(about_half(settings.resolution));
  const std::array tallies{tally_of(node_scene, cube, places), tally_of(node_scene, coarse, places),
                           tally_of(node_scene, coarse, places_of(from, settings.points, 2))};
  // A target that no cell has met in n independent cubes may still be as large as 3 / n of the largest cell,
  // at a confidence of 95 % (the rule of three).
  // Cubes in a row see alike, so only one in a row counts.
  const double largest_cell = 4.0 / (std::numbers::pi * settings.resolution * settings.resolution);
  const double unseen = 3.0 * largest_cell / std::sqrt(static_cast<double>(places.size()));
  return node_factors_of(node_scene, tallies, [unseen](std::span<const double> values) {
    return cube_estimate(values, unseen);
  });
}

} // namespace meninas
