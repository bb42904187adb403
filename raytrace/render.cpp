#include "raytrace/render.h"

#include "raytrace/views/features.h"
#include "raytrace/pixels/bright_edges.h"
#include "raytrace/views/view_light.h"

#include <algorithm>
#include <iterator>

namespace meninas {

static Rendering render_light(const IrradianceField& field,
                              const Camera& camera, const RenderSettings& settings,
                              const Progress& progress) {
  Rendering result;
  result.image = Image(settings.width, settings.height);
  const VisibleLight all = visible_light(field, field_content(field, settings.diffuse));
  const auto gathering = make_gathering(field, settings.diffuse);
  const auto trace = [&](const SampleShare& share, const StorePixel& store) {
    add(result, trace_picture({*field.scene, all, gathering.get(), camera, settings}, share,
                              progress, store));
  };
  const std::vector<SampleRound> rounds = choose_samples(settings, trace, result.image);
  const SampleRound& last = rounds.back();
  trace(last.share(), [&](int x, int y, const SeenRadiance& seen) {
    glm::vec3& pixel = result.image.at(x, y);
    pixel = blended(last.samples, pixel, seen[0] + seen[1] + seen[2]);
  });
  result.samples = counts_of(rounds, result.image.pixels.size());
  return result;
}

/// What a display shows at the edges of bright things.
static void show_edges(const IrradianceField& field, const Camera& camera,
                       const RenderSettings& settings, Rendering& result) {
  const DisplayChoice& display = *settings.display;
  result.edges.exposure = display.exposure.value_or(automatic_exposure(result.image));
  result.edges.transform = display.transform;
  const PixelMask pixels = bright_edges(result.image, result.edges.exposure);
  if (std::ranges::find(pixels, 1) == pixels.end())
    return;
  constexpr int enough = 64;
  RenderSettings straight = settings;
  straight.mode = RenderMode::radiosity;
  straight.diffuse.term = DiffuseTerm::interpolated;
  const VisibleLight all = visible_light(field, FieldContent::all);
  result.edges.pixels = shown_at_edges(
      result.image, pixels, std::min(settings.samples, enough),
      [&](const SampleShare& share, const StorePixel& store) {
        add(result, trace_picture({*field.scene, all, nullptr, camera, straight}, share, {}, store));
      },
      result.edges);
}

Rendering render(const IrradianceField& field, const Camera& camera,
                 const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  const ViewLight light = light_for_view(field, camera, settings);
  const IrradianceField& shown = light.field ? *light.field : field;
  Rendering result = settings.layers == WithLayers::yes
                         ? render_layers(shown, camera, light.settings, progress)
                         : render_light(shown, camera, light.settings, progress);
  if (settings.display)
    show_edges(shown, camera, light.settings, result);
  std::ranges::move(render_features(field, camera, settings),
                    std::back_inserter(result.layers));
  result.finer = light.field;
  result.shadow_rays += light.shadow_rays;
  return result;
}

} // namespace meninas
