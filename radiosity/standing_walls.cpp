#include "radiosity/standing_walls.h"

#include "radiosity/mesh_division.h"
#include "scenes/lobes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace meninas {

namespace {

constexpr int most_divisions = 3;
constexpr int lines_a_cell = 8;       ///< of an undivided one; of the smallest there is one
constexpr double narrow = 1.0 / 32.0; ///< of an undivided element
constexpr double lifted = 1.0 / 32.0; ///< lines over their side, in wanted sizes
constexpr double least_size = 0.5;    ///< of root cells, in wanted sizes
constexpr int most_meetings = 256;    ///< of a line
constexpr std::size_t few = 2000;     ///< elements

/// What blocks a line over a side from one place to another: the same for a sheet.
struct Obstacle {
  SideId side = none<SideId>;
  bool along_u = false;
  std::uint32_t line = 0; ///< among those of its side and direction
  Vec2 from{0.0}, to{0.0};
};

/// What a line comes to.
enum class Meeting { nothing, sheet, front, back };

struct Walls {
  const Scene& scene;
  const SurfaceModel& surfaces;
  const RayScene& rays;
  const DarkSides& dark;

  Meeting meeting(const Hit& hit) const {
    const Material& material = material_of(scene, hit.triangle);
    if (is_glass(material))
      return Meeting::nothing;
    if (!material.double_sided)
      return hit.front ? Meeting::front : Meeting::back;
    // The dark side of a sheet is inside of something.
    const auto patch = index(surfaces.patch_of_triangle[index(hit.triangle)]);
    const bool before = dark.empty() || dark[patch][hit.front ? 0 : 1] == 0,
               behind = dark.empty() || dark[patch][hit.front ? 1 : 0] == 0;
    return before && behind ? Meeting::sheet : before ? Meeting::front : Meeting::back;
  }
};

/// Follows the line over a side between two places, through all it meets.
void follow(const Walls& walls, const MeshSide& side, double height, Obstacle line,
            std::vector<Obstacle>& found) {
  const Patch& patch = walls.surfaces.patches[index(side.patch)];
  const Point3 start = point_at(patch, line.from) + height * side.normal;
  const Vec3 way = point_at(patch, line.to) + height * side.normal - start;
  const double length = glm::length(way);
  if (!(length > 0.0))
    return;
  Ray ray{.origin = start, .direction = way / length, .max_distance = length};
  constexpr double nowhere = -1.0;
  double at = 0.0, entered = nowhere;
  const auto place = [&](double distance) {
    return glm::mix(line.from, line.to, std::clamp(distance / length, 0.0, 1.0));
  };
  for (int k = 0; k < most_meetings; ++k) {
    const auto hit = closest_hit(walls.rays, ray);
    if (!hit)
      return;
    at += hit->distance;
    const Meeting meeting = walls.meeting(*hit);
    if (meeting == Meeting::front)
      entered = at;
    const bool left = meeting == Meeting::back && entered != nowhere;
    if (meeting == Meeting::sheet || left)
      found.push_back({line.side, line.along_u, line.line, place(left ? entered : at), place(at)});
    if (meeting == Meeting::back)
      entered = nowhere;
    ray.origin = start + at * ray.direction;
    ray.max_distance = length - at;
    ray.leaving = walls.surfaces.plane_of_triangle[index(hit->triangle)];
  }
}

/// All lines over a side, both ways.
std::vector<Obstacle> obstacles_on(const Walls& walls, const ElementMesh& mesh, SideId id) {
  const MeshSide& side = mesh.sides[index(id)];
  std::vector<Obstacle> found;
  const double cell = walls.surfaces.patches[index(side.patch)].area / side.root_count;
  if (cell < least_size * least_size * side.element_size * side.element_size)
    return found;
  for (const bool along_u : {true, false}) {
    const int count = lines_a_cell * (along_u ? side.nv : side.nu);
    for (int k = 0; k < count; ++k) {
      const double across = (k + 0.5) / count, end = side.triangle ? 1.0 - across : 1.0;
      const auto at = [&](double along) {
        return along_u ? Vec2(along, across) : Vec2(across, along);
      };
      follow(walls, side, lifted * side.element_size,
             {id, along_u, static_cast<std::uint32_t>(k), at(0.0), at(end)}, found);
    }
  }
  return found;
}

/// Whether the obstacle, no thicker than half of it, leaves some of the element on either side.
bool divides(const ElementMesh& mesh, const Obstacle& obstacle, const ElementPoint& from,
             const ElementPoint& to) {
  if (from.element != to.element)
    return false;
  const MeshCell& cell = cell_of(mesh, from.element);
  const bool triangle = mesh.sides[index(cell.side)].triangle;
  const double margin = narrow * static_cast<double>(1U << cell.level);
  const int along = obstacle.along_u ? 0 : 1;
  const double end = triangle ? 1.0 - from.st[1 - along] : 1.0;
  const auto [low, high] = std::minmax(from.st[along], to.st[along]);
  return low > margin && end - high > margin && high - low < 0.5;
}

/// By ElementId, 1 where as many lines are crossed as go one way; empty where there is none.
std::vector<std::uint8_t> crossed_elements(const ElementMesh& mesh,
                                           const std::vector<Obstacle>& obstacles) {
  struct Crossings {
    int count = 0;
    std::uint32_t last_line = std::numeric_limits<std::uint32_t>::max();
  };
  std::vector<std::array<Crossings, 2>> crossings(element_count(mesh));
  for (const Obstacle& o : obstacles) {
    const ElementPoint from = locate(mesh, o.side, o.from), to = locate(mesh, o.side, o.to);
    Crossings& c = crossings[index(from.element)][o.along_u ? 1 : 0];
    if (c.last_line == o.line || !divides(mesh, o, from, to))
      continue;
    c.last_line = o.line;
    ++c.count;
  }
  std::vector<std::uint8_t> crossed(element_count(mesh), 0);
  for (std::size_t e = 0; e < crossed.size(); ++e) {
    const MeshCell& cell = cell_of(mesh, static_cast<ElementId>(e));
    // Of a triangle's lines those through its middle are half as long.
    const int lines =
        lines_a_cell >> (cell.level + (mesh.sides[index(cell.side)].triangle ? 1 : 0));
    crossed[e] =
        cell.level < most_divisions && crossings[e][0].count + crossings[e][1].count >= lines;
  }
  if (std::ranges::find(crossed, 1) == crossed.end())
    crossed.clear();
  return crossed;
}

} // namespace

ElementMesh divide_under_walls(ElementMesh mesh, const Scene& scene, const SurfaceModel& surfaces,
                               const RayScene& rays, const DarkSides& dark,
                               const MeshSettings& settings) {
  const Walls walls{scene, surfaces, rays, dark};
  std::vector<std::vector<Obstacle>> on_side(mesh.sides.size());
  tbb::parallel_for(std::size_t{0}, mesh.sides.size(), [&](std::size_t s) {
    on_side[s] = obstacles_on(walls, mesh, static_cast<SideId>(s));
  });
  std::vector<Obstacle> obstacles;
  for (const auto& some : on_side)
    obstacles.insert(obstacles.end(), some.begin(), some.end());

  const std::size_t most = std::min(2 * element_count(mesh) + few, settings.max_elements);
  for (int level = 0; level < most_divisions; ++level) {
    const std::vector<std::uint8_t> crossed = crossed_elements(mesh, obstacles);
    if (crossed.empty())
      break;
    ElementMesh finer = divide_elements(mesh, surfaces, crossed);
    if (element_count(finer) > most)
      break;
    mesh = std::move(finer);
  }
  return mesh;
}

} // namespace meninas
