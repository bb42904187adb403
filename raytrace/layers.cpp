#include "raytrace/sample_choice.h"

#include <optional>

namespace meninas {

/// The pixels that all layers take all samples of, by the first samples of all light.
static std::optional<PixelMask> worthwhile(const LightScene& light, const DiffuseField& field,
                                           const PointGathering* gathering, const Camera& camera,
                                           const RenderSettings& settings, Rendering& totals) {
  if (rest_samples(settings).count == 0)
    return std::nullopt;
  Image first(settings.width, settings.height);
  const VisibleLight all = visible_light(light, field, field_content(field, settings.diffuse));
  add(totals, trace_picture(light, all, gathering, camera, settings, {first_samples(settings)}, {},
                            [&](int x, int y, const SeenRadiance& seen) {
                              first.at(x, y) = seen[0] + seen[1] + seen[2];
                            }));
  return differing_pixels(first, settings.pixel_error);
}

Rendering render_layers(const LightScene& light, const DiffuseField& field, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  expects(field.mirrored.size() == field.irradiance.size(), "the field knows its mirrored part");
  Rendering result;
  result.image = Image(settings.width, settings.height);
  const auto gathering = make_gathering(light, field, settings.diffuse);
  const auto worth = worthwhile(light, field, gathering.get(), camera, settings, result);
  const FieldContent content = field_content(field, settings.diffuse);
  for (const LightPart& part : light_parts(light, field, content)) {
    const std::size_t first = result.layers.size();
    for (const char* way : {"", ".mirror", ".mirrors"})
      result.layers.push_back({part.name + way, Image(settings.width, settings.height)});
    const auto trace = [&](const SampleShare& share, const StorePixel& store) {
      add(result, trace_picture(light, part.light, gathering.get(), camera, settings, share,
                                progress, store));
    };
    trace({first_samples(settings)}, [&](int x, int y, const SeenRadiance& seen) {
      for (std::size_t way = 0; way < seen_ways; ++way)
        result.layers[first + way].image.at(x, y) = seen[way];
    });
    if (!worth)
      continue;
    trace({rest_samples(settings), &*worth}, [&](int x, int y, const SeenRadiance& seen) {
      for (std::size_t way = 0; way < seen_ways; ++way) {
        glm::vec3& pixel = result.layers[first + way].image.at(x, y);
        pixel = blended(settings, pixel, seen[way]);
      }
    });
  }
  for (std::size_t p = 0; p < result.image.pixels.size(); ++p)
    for (const Layer& layer : result.layers)
      result.image.pixels[p] += layer.image.pixels[p];
  return result;
}

} // namespace meninas
