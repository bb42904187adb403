#include "raytrace/render.h"

#include "raytrace/views/features.h"
#include "raytrace/pixels/bright_edges.h"
#include "raytrace/pixels/picture_window.h"
#include "raytrace/views/view_light.h"

#include <algorithm>
#include <cmath>
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
  trace_round(settings, last, trace, [&](int x, int y, const SeenRadiance& seen) {
    glm::vec3& pixel = result.image.at(x, y);
    pixel = blended(last.samples, pixel, seen[0] + seen[1] + seen[2]);
  });
  result.samples = counts_of(rounds, result.image.pixels.size());
  return result;
}

/// Where a display would show it.
struct EdgesShown {
  const IrradianceField& field;
  const Camera& camera;
  const RenderSettings& settings;
  Progress progress; ///< told that the picture is done but for them
};

/// The pixels that a display shows at the edges of bright things, at an exposure.
static ShownPixels edges_at(double exposure, const EdgesShown& shown, Rendering& result) {
  const auto& [field, camera, settings, progress] = shown;
  ShownPixels edges{exposure, settings.display->transform, {}};
  PixelMask pixels = bright_edges(result.image, exposure);
  const PictureWindow* window = settings.window ? &*settings.window : nullptr;
  if (window)
    pixels = within(*window, settings.width, std::move(pixels));
  if (std::ranges::find(pixels, 1) == pixels.end())
    return edges;
  constexpr int enough = 64;
  RenderSettings straight = settings;
  straight.mode = RenderMode::radiosity;
  straight.diffuse.term = DiffuseTerm::interpolated;
  const VisibleLight all = visible_light(field, FieldContent::all);
  edges.pixels = shown_at_edges(
      result.image, pixels, std::min(settings.samples, enough),
      [&](const SampleShare& share, const StorePixel& store) {
        add(result, trace_picture({*field.scene, all, nullptr, camera, straight},
                                  {share.samples, share.pixels, window}, shown.progress, store));
      },
      edges);
  return edges;
}

/// About the automatic exposure of the whole picture: by few samples of so many pixels.
static double expected_exposure(const IrradianceField& field, const Camera& camera,
                                const RenderSettings& settings, Rendering& totals) {
  constexpr double enough_pixels = 1 << 14;
  constexpr int max_samples = 4;
  const auto step = static_cast<std::size_t>(
      std::max(1.0, std::sqrt(double(settings.width) * settings.height / enough_pixels)));
  const auto width = static_cast<std::size_t>(settings.width);
  Image image(settings.width, settings.height);
  PixelMask some(image.pixels.size(), 0);
  for (std::size_t y = step / 2; y < static_cast<std::size_t>(settings.height); y += step)
    for (std::size_t x = step / 2; x < width; x += step)
      some[y * width + x] = 1;
  const VisibleLight all = visible_light(field, field_content(field, settings.diffuse));
  const auto gathering = make_gathering(field, settings.diffuse);
  add(totals, trace_picture({*field.scene, all, gathering.get(), camera, settings},
                            {{0, std::min(settings.samples, max_samples)}, &some}, {},
                            [&](int x, int y, const SeenRadiance& seen) {
                              image.at(x, y) = seen[0] + seen[1] + seen[2];
                            }));
  return automatic_exposure(image); // black pixels do not count
}

/// Shows the edges of the whole picture; of a window for exposures around that which the whole may have.
static void show_edges(const EdgesShown& shown, Rendering& result) {
  const auto& [field, camera, settings, progress] = shown;
  const std::optional<double> given = settings.display->exposure;
  if (!settings.window) {
    result.edges = edges_at(given.value_or(automatic_exposure(result.image)), shown, result);
    return;
  }
  constexpr int steps_around = 6;
  constexpr double step = 1.0 / 16.0; // of automatic_exposure
  const double middle = given ? *given : expected_exposure(field, camera, settings, result);
  for (int k = given ? 0 : -steps_around; k <= (given ? 0 : steps_around); ++k)
    result.likely_edges.push_back(edges_at(middle + k * step, shown, result));
}

Rendering render(const IrradianceField& field, const Camera& camera,
                 const RenderSettings& settings, const Progress& progress) {
  expects(settings.width > 0 && settings.height > 0, "a picture has at least one pixel");
  const ViewLight light = light_for_view(field, camera, settings, progress);
  const IrradianceField& shown = light.field ? *light.field : field;
  Rendering result = settings.layers == WithLayers::yes
                         ? render_layers(shown, camera, light.settings, progress)
                         : render_light(shown, camera, light.settings, progress);
  Progress but_for_edges;
  if (progress)
    but_for_edges = [&](std::string_view stage, double) { progress(stage, 1.0); };
  if (settings.display)
    show_edges({shown, camera, light.settings, but_for_edges}, result);
  std::ranges::move(render_features(field, camera, settings),
                    std::back_inserter(result.layers));
  result.finer = light.field;
  result.shadow_rays += light.shadow_rays;
  return result;
}

} // namespace meninas
