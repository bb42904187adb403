#include "raytrace/pixels/sample_choice.h"
#include "raytrace/views/view_light.h"

namespace meninas {

/// The samples that all layers are of, chosen by all light.
static std::vector<SampleRound> chosen_samples(const IrradianceField& field,
                                               const PointGathering* gathering,
                                               const Camera& camera, const RenderSettings& settings,
                                               Rendering& totals) {
  Image picture(settings.width, settings.height);
  const VisibleLight all = visible_light(field, field_content(field, settings.diffuse));
  return choose_samples(
      settings,
      [&](const SampleShare& share, const StorePixel& store) {
        add(totals,
            trace_picture({*field.scene, all, gathering, camera, settings}, share, {}, store));
      },
      picture);
}

Rendering render_layers(const IrradianceField& coarse, const Camera& camera,
                        const RenderSettings& asked, const Progress& progress) {
  expects(asked.width > 0 && asked.height > 0, "a picture has at least one pixel");
  const ViewLight light = light_for_view(coarse, camera, asked, progress);
  const IrradianceField& field = light.field ? *light.field : coarse;
  const RenderSettings& settings = light.settings;
  expects(field.mirrored.size() == field.irradiance.size(), "the field knows its mirrored part");
  Rendering result;
  result.image = Image(settings.width, settings.height);
  result.finer = light.field;
  result.shadow_rays = light.shadow_rays;
  const auto gathering = make_gathering(field, settings.diffuse);
  const auto rounds = chosen_samples(field, gathering.get(), camera, settings, result);
  result.samples = counts_of(rounds, result.image.pixels.size());
  const FieldContent content = field_content(field, settings.diffuse);
  for (const LightPart& part : light_parts(field, content)) {
    const std::size_t first = result.layers.size();
    for (const char* way : {"", ".mirror", ".mirrors"})
      result.layers.push_back({part.name + way, Image(settings.width, settings.height)});
    const auto trace = [&](const SampleShare& share, const StorePixel& store) {
      add(result, trace_picture({*field.scene, part.light, gathering.get(), camera, settings}, share,
                                progress, store));
    };
    for (const SampleRound& round : rounds)
      trace_round(settings, round, trace, [&](int x, int y, const SeenRadiance& seen) {
        for (std::size_t way = 0; way < seen_ways; ++way) {
          glm::vec3& pixel = result.layers[first + way].image.at(x, y);
          pixel = blended(round.samples, pixel, seen[way]);
        }
      });
  }
  for (std::size_t p = 0; p < result.image.pixels.size(); ++p)
    for (const Layer& layer : result.layers)
      result.image.pixels[p] += layer.image.pixels[p];
  return result;
}

} // namespace meninas
