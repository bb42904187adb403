#include "raytrace/tiles.h"

namespace meninas {

Rendering render(const LightScene& light, const DiffuseField& field, const Camera& camera,
                 const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  if (settings.layers == WithLayers::yes)
    return render_layers(light, field, camera, settings, progress);
  Rendering result;
  result.image = Image(settings.width, settings.height);
  const VisibleLight all = visible_light(light, field, field_content(field, settings.diffuse));
  const auto gathering = make_gathering(light, field, settings.diffuse);
  const RayTotals rays = trace_picture(light, all, gathering.get(), camera, settings, progress,
                                       [&](int x, int y, const SeenRadiance& seen) {
                                         result.image.at(x, y) = seen[0] + seen[1] + seen[2];
                                       });
  add(result, rays);
  return result;
}
} // namespace meninas
