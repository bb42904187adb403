#include "raytrace/views/view_light.h"

#include "radiosity/field/view/view_field.h"
#include "raytrace/views/sight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meninas {

namespace {

/// The distance between the rays through two points of the picture, t along both.
double apart_at(const CameraRay& a, const CameraRay& b, double t) {
  return glm::length((b.origin - a.origin) + t * (b.direction - a.direction));
}

/// What a sight ends at, and how wide a pixel is there.
struct SeenEnd {
  std::uint32_t side = FaceRecord::nothing; ///< index of a SideId
  glm::vec2 uv{0.0F};
  Point3 position{0.0};
  double width = 0.0; ///< metres
};

/// Where a sight ends; on a translucent surface the same place on its other side, too, whose light comes through.
struct SeenEnds {
  SeenEnd front, behind;
};

SeenEnds ends_of(const LightScene& light, const Sight& sight, double width) {
  SeenEnds ends{{sight.side, sight.uv, sight.position, width}, {}};
  if (const auto behind = place_behind(light, SideId{sight.side}, sight.triangle, sight.barycentric))
    ends.behind = {behind->side, behind->uv, sight.position, width};
  return ends;
}

/// How finely a patch is divided at a place, elements to its edge.
glm::vec2 elements_to_edge(const LightScene& light, const SeenEnd& at) {
  const MeshSide& side = light.mesh.sides[at.side];
  const std::uint32_t element = field_point(light.landing.elements, at.side, at.uv).element;
  return std::ldexp(1.0F, cell_of(light.mesh, ElementId{element}).level) * glm::vec2(side.nu, side.nv);
}

/// The steps from one end to the next on the same patch: of an element at most, and of about as much as points are apart.
int steps_between(const SeenEnd& from, const SeenEnd& to, const glm::vec2& to_edge, double apart) {
  constexpr double max_steps = 16.0;
  const glm::dvec2 elements(glm::abs(to.uv - from.uv) * to_edge);
  const double widths = glm::distance(from.position, to.position) / (apart * from.width);
  const double steps = std::max(std::ceil(std::max(elements.x, elements.y)), std::round(widths));
  return steps > 1.0 ? static_cast<int>(std::min(steps, max_steps)) : 1; // one where it is not a number
}

/// The end and places on the way to the next ones, where these are far from each other on the same patch: of a surface
/// that is seen at a grazing angle a pixel shows a long strip.
void add_points(const LightScene& light, const SeenEnd& at, const SeenEnd& right, const SeenEnd& below, double apart,
                std::vector<SeenPoint>& points) {
  if (at.side == FaceRecord::nothing)
    return;
  const glm::vec2 to_edge = elements_to_edge(light, at);
  const bool goes_right = right.side == at.side, goes_down = below.side == at.side;
  const int columns = goes_right ? steps_between(at, right, to_edge, apart) : 1,
            rows = goes_down ? steps_between(at, below, to_edge, apart) : 1;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      glm::vec2 uv = at.uv;
      if (goes_right)
        uv += static_cast<float>(column) / static_cast<float>(columns) * (right.uv - at.uv);
      if (goes_down)
        uv += static_cast<float>(row) / static_cast<float>(rows) * (below.uv - at.uv);
      const FieldPoint point = field_point(light.landing.elements, at.side, uv);
      points.push_back({point.element, {point.place.s, point.place.t}, static_cast<float>(at.width)});
    }
}

/// The ends of the sights through a row of points of the picture, `apart` pixels from each other.
std::vector<SeenEnds> row_of_ends(const LightScene& light, const Camera& camera, const RenderSettings& settings,
                                  double apart, std::size_t row) {
  const int width = settings.width, height = settings.height;
  const double aspect = double(width) / height, y = std::min(double(row) * apart / height, 1.0);
  std::vector<SeenEnds> ends(static_cast<std::size_t>(std::ceil(width / apart)) + 1);
  for (std::size_t column = 0; column < ends.size(); ++column) {
    const Vec2 at(std::min(double(column) * apart / width, 1.0), y);
    const Sight sight = look(light, camera, aspect, at, settings.max_bounces);
    if (sight.side == FaceRecord::nothing)
      continue;
    const auto ray = [&](const Vec2& to) { return camera_ray(camera, aspect, to.x, to.y); };
    const CameraRay middle = ray(at);
    const Vec2 inward(at.x < 0.5 ? 1.0 : -1.0, at.y < 0.5 ? 1.0 : -1.0);
    const double w = std::max(apart_at(middle, ray(at + Vec2(inward.x / width, 0.0)), sight.distance),
                              apart_at(middle, ray(at + Vec2(0.0, inward.y / height)), sight.distance));
    if (w > 0.0)
      ends[column] = ends_of(light, sight, w);
  }
  return ends;
}

/// The points at the corners of each pixel and, where they are less than a pixel apart, between these.
std::vector<SeenPoint> seen_points(const LightScene& light, const Camera& camera,
                                   const RenderSettings& settings, double apart, const Progress& progress) {
  constexpr std::size_t together = 32; // rows, of which one is looked for twice
  std::vector<std::vector<SeenPoint>> rows(static_cast<std::size_t>(std::ceil(settings.height / apart)) + 1);
  const auto ends_of_row = [&](std::size_t row) {
    if (progress)
      progress("render", 0.0);
    return row < rows.size() ? row_of_ends(light, camera, settings, apart, row) : std::vector<SeenEnds>{};
  };
  tbb::parallel_for(std::size_t{0}, (rows.size() + together - 1) / together, [&](std::size_t block) {
    const std::size_t first = block * together, end = std::min(first + together, rows.size());
    std::vector<SeenEnds> ends = ends_of_row(first);
    for (std::size_t row = first; row < end; ++row) {
      std::vector<SeenEnds> next = ends_of_row(row + 1);
      for (std::size_t column = 0; column < ends.size(); ++column) {
        const SeenEnds none, &at = ends[column], &right = column + 1 < ends.size() ? ends[column + 1] : none,
                             &below = column < next.size() ? next[column] : none;
        add_points(light, at.front, right.front, below.front, apart, rows[row]);
        add_points(light, at.behind, right.behind, below.behind, apart, rows[row]);
      }
      ends = std::move(next);
    }
  });
  std::size_t count = 0;
  for (const std::vector<SeenPoint>& row : rows)
    count += row.size();
  std::vector<SeenPoint> points;
  points.reserve(count);
  for (std::vector<SeenPoint>& row : rows) {
    points.insert(points.end(), row.begin(), row.end());
    std::vector<SeenPoint>().swap(row); // there may be many megabytes of them
  }
  return points;
}

} // namespace

ViewLight light_for_view(const IrradianceField& field, const Camera& camera,
                         const RenderSettings& settings, const Progress& progress) {
  constexpr double max_points = 1 << 22;
  if (settings.diffuse.term != DiffuseTerm::direct)
    return {nullptr, settings, 0};
  // Shadows of punctual lights are found by the points that ask for them.
  const double wanted = field.scene->punctual.empty() ? 1.0 : 0.5;
  const double pixels = double(settings.width) * settings.height;
  const double apart = std::max(wanted, std::sqrt(pixels / max_points));
  ViewField finer = view_field(field, seen_points(*field.scene, camera, settings, apart, progress), apart,
                               settings.diffuse.refinement, progress);
  ViewLight light{std::make_shared<const IrradianceField>(std::move(finer.field)), settings,
                  finer.shadow_rays};
  light.settings.diffuse.term = DiffuseTerm::interpolated;
  return light;
}

} // namespace meninas
