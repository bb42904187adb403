#include "raytrace/tiles.h"

namespace meninas {

Rendering render_layers(const LightScene& light, const DiffuseField& field, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  expects(field.mirrored.size() == field.irradiance.size(), "the field knows its mirrored part");
  Rendering result;
  result.image = Image(settings.width, settings.height);
  const auto gathering = make_gathering(light, field, settings.diffuse);
  const FieldContent content = field_content(field, settings.diffuse);
  for (const LightPart& part : light_parts(light, field, content)) {
    const std::size_t first = result.layers.size();
    for (const char* way : {"", ".mirror", ".mirrors"})
      result.layers.push_back({part.name + way, Image(settings.width, settings.height)});
    const auto store = [&](int x, int y, const SeenRadiance& seen) {
      for (std::size_t way = 0; way < seen_ways; ++way)
        result.layers[first + way].image.at(x, y) = seen[way];
    };
    add(result,
        trace_picture(light, part.light, gathering.get(), camera, settings, progress, store));
  }
  for (std::size_t p = 0; p < result.image.pixels.size(); ++p)
    for (const Layer& layer : result.layers)
      result.image.pixels[p] += layer.image.pixels[p];
  return result;
}

} // namespace meninas
