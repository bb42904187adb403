#include "raytrace/views/view_light.h"

#include "radiosity/field/view/view_field.h"
#include "raytrace/views/sight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meninas {

namespace {

/// The distance between the rays through two points of the picture, t along both.
double apart_at(const CameraRay& a, const CameraRay& b, double t) {
  return glm::length((b.origin - a.origin) + t * (b.direction - a.direction));
}

/// The end of a sight; of a translucent surface the same place on its other side, whose light comes through.
void add_seen(const LightScene& light, const Sight& sight, float width,
              std::vector<SeenPoint>& points) {
  const auto add = [&](const FieldPoint& at) {
    points.push_back({at.element, {at.place.s, at.place.t}, width});
  };
  add(sight.place);
  if (const auto behind =
          place_behind(light, SideId{sight.side}, sight.triangle, sight.barycentric))
    add(*behind);
}

/// The points at the corners of each pixel and, where they are less than a pixel apart, between these.
std::vector<SeenPoint> seen_points(const LightScene& light, const Camera& camera,
                                   const RenderSettings& settings, double apart, const Progress& progress) {
  const int width = settings.width, height = settings.height;
  const double aspect = double(width) / height;
  const auto columns = static_cast<std::size_t>(std::ceil(width / apart)) + 1;
  std::vector<std::vector<SeenPoint>> rows(static_cast<std::size_t>(std::ceil(height / apart)) + 1);
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
    if (progress)
      progress("render", 0.0);
    const double y = std::min(double(row) * apart / height, 1.0);
    for (std::size_t column = 0; column < columns; ++column) {
      const Vec2 at(std::min(double(column) * apart / width, 1.0), y);
      const Sight sight = look(light, camera, aspect, at, settings.max_bounces);
      if (sight.side == FaceRecord::nothing)
        continue;
      const auto ray = [&](const Vec2& to) { return camera_ray(camera, aspect, to.x, to.y); };
      const CameraRay middle = ray(at);
      const Vec2 inward(at.x < 0.5 ? 1.0 : -1.0, at.y < 0.5 ? 1.0 : -1.0);
      const double w =
          std::max(apart_at(middle, ray(at + Vec2(inward.x / width, 0.0)), sight.distance),
                   apart_at(middle, ray(at + Vec2(0.0, inward.y / height)), sight.distance));
      if (w > 0.0)
        add_seen(light, sight, static_cast<float>(w), rows[row]);
    }
  });
  std::vector<SeenPoint> points;
  for (const std::vector<SeenPoint>& row : rows)
    points.insert(points.end(), row.begin(), row.end());
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
