#include "runs/view.h"

#include "image/colour_scale.h"
#include "radiosity/relight.h"
#include "radiosity/solution/solution_file.h"
#include "runs/preparation.h"
#include "runs/reference_run.h"
#include "runs/steering/setting_options.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/photometry.h"
#include "scenes/sky/radiance_map.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

namespace fs = std::filesystem;

static Attributes attributes_of(const Scene& scene, const Camera& camera,
                                const RunSettings& settings) {
  Attributes attributes{{"scene", fs::path(scene.file).filename().string()},
                        {"sceneHash", hex_digits(content_hash(scene))},
                        {"camera", camera.name},
                        {"seed", std::to_string(settings.seed)}};
  if (is_panorama(camera.projection))
    attributes.emplace_back("projection", name_of(camera.projection));
  if (scene.background.map)
    attributes.emplace_back("environment", scene.background.map->name);
  else if (const Rgb& background = scene.background.constant; background != Rgb(0.0))
    attributes.emplace_back("background",
                            fmt::format("{},{},{}", background.r, background.g, background.b));
  return attributes;
}

LitScene solve_lit_scene(Scene scene, const PassOneSettings& settings,
                         const std::optional<fs::path>& kept, const RunEvents& events,
                         RunFigures& figures) {
  const std::uint64_t scene_hash = kept ? content_hash(scene) : 0;
  LitScene lit{.prepared = prepare_run(std::move(scene), settings, events, figures),
               .field = {}};
  RadiositySolution solution = solve_pass_one(lit.prepared->light(), settings, events.progress);
  add_solution(figures, solution);
  warn_of_solution(*lit.prepared, figures.solver, figures.closure, events);
  if (kept) {
    write_solution(*kept, scene_hash, lit.prepared->mesh, solution, settings.mesh);
  }
  lit.field = std::move(solution.field);
  return lit;
}

LitScene read_lit_scene(const fs::path& file, Scene scene, PassOneSettings settings,
                        const RunEvents& events, RunFigures& figures, LampsApart lamps) {
  Stopwatch watch;
  StoredSolution stored = read_solution(file, scene);
  settings.mesh = stored.mesh;
  const bool known = !stored.lamps.empty();
  const bool apart = lamps == LampsApart::yes || (lamps == LampsApart::if_known && known);
  if (!apart)
    stored.field.by_lamp.clear();
  else if (!known)
    throw InputError(file.string(), "",
                     "does not know its lamps apart: solve again with --by-lamp");
  else
    settings.lamps = stored.grouping;
  figures.seconds.load += watch.lap();
  LitScene lit{.prepared = prepare_run(std::move(scene), settings, events, figures),
               .field = {}};
  // Lamps are found once textures and the sky are decoded.
  if (apart && stored.lamps != lit.prepared->light()->lamp_groups->names)
    throw InputError(file.string(), "", "has other lamps than its scene: solve again");
  figures.solver = std::move(stored.solver);
  figures.links = stored.links;
  figures.energy = stored.energy;
  figures.closure = stored.closure;
  lit.field = field_of(file, std::move(stored), lit.prepared->light());
  figures.elements = element_count(lit.field.mesh());
  figures.vertices = lit.field.mesh().vertices.size();
  warn_of_solution(*lit.prepared, figures.solver, figures.closure, events);
  return lit;
}

LitScene under_lamps(const LitScene& lit, const RunSettings& settings) {
  const auto& names = lit.field.scene->lamp_groups->names;
  return {lit.prepared, relit(lit.field, factors_of_lamps(names, settings.lamp_factors))};
}

ViewPicture picture_of(const Scene& scene, const Camera& camera, const RunSettings& settings,
                       Rendering rendering) {
  const RenderSettings used = two_pass_settings(settings).render;
  ViewPicture picture{.image = std::move(rendering.image),
                      .samples = std::move(rendering.samples),
                      .edges = std::move(rendering.edges),
                      .likely_edges = std::move(rendering.likely_edges),
                      .layers = std::move(rendering.layers),
                      .attributes = attributes_of(scene, camera, settings),
                      .unit = settings.view ? unit_of_colours : unit_of_radiance,
                      .finer = std::move(rendering.finer)};
  picture.attributes.emplace_back("mode", used.mode == RenderMode::hybrid ? "hybrid" : "radiosity");
  picture.attributes.emplace_back("samples", std::to_string(used.samples));
  picture.attributes.emplace_back("filter", std::string(name_of(used.filter)));
  return picture;
}

/// What a view shows, by pixel.
struct ValuesSeen {
  std::string name, unit;
  Channel values, known;
};

/// Numbers for the eye: colours with a scale, and the numbers as a layer.
static Rendering in_false_colours(const ValuesSeen& seen, std::optional<double> wanted_top,
                                  const RunEvents& events) {
  const auto& [name, unit, values, known] = seen;
  const double top = wanted_top.value_or(readable_top(values));
  note(events, fmt::format("view {}: from 0 (black) to {:g} {} (pale yellow), a line for each {:g}",
                           name, top, unit, top / 10.0));
  Rendering rendering;
  rendering.image = false_colours(values, known, {.title = fmt::format("{} {}", name, unit), .top = top});
  Image numbers(values.width, values.height);
  std::ranges::transform(values.values, numbers.pixels.begin(),
                         [](float value) { return glm::vec3(value); });
  rendering.layers.push_back({name, std::move(numbers)});
  return rendering;
}

static Rendering painted_illuminance(const LitScene& lit, const Camera& camera,
                                     const RenderSettings& used, const RunSettings& settings,
                                     const RunEvents& events) {
  PaintedView view = paint_view(DebugView::illuminance, lit.field, {}, camera, used);
  const double efficacy = settings.gltf.state.luminous_efficacy;
  for (float& value : view.values.values)
    value = static_cast<float>(efficacy * value);
  return in_false_colours({"illuminance", "lx", std::move(view.values), std::move(view.known)},
                          settings.view_top, events);
}

/// Of the picture, lamps and mirrors too.
static Rendering painted_luminance(const LitScene& lit, const Camera& camera,
                                   const RenderSettings& used, const RunSettings& settings,
                                   const RunEvents& events) {
  Rendering picture = render(lit.field, camera, used, events.progress);
  Channel values(used.width, used.height), known(used.width, used.height);
  const double efficacy = settings.gltf.state.luminous_efficacy;
  std::ranges::transform(picture.image.pixels, values.values.begin(), [&](const glm::vec3& pixel) {
    return static_cast<float>(luminous(efficacy, Rgb(pixel)));
  });
  std::ranges::fill(known.values, 1.0F);
  Rendering rendering = in_false_colours(
      {"luminance", "cd/m2", std::move(values), std::move(known)}, settings.view_top, events);
  picture.image = std::move(rendering.image);
  picture.layers = std::move(rendering.layers);
  picture.edges = {};
  return picture;
}

/// The colours, and the values they stand for as a layer.
static Rendering painted(const LitScene& lit, const Camera& camera, const RenderSettings& used,
                         const RunSettings& settings, const RunEvents& events) {
  if (settings.view == DebugView::illuminance)
    return painted_illuminance(lit, camera, used, settings, events);
  if (settings.view == DebugView::luminance)
    return painted_luminance(lit, camera, used, settings, events);
  const bool closure = settings.view == DebugView::closure;
  // Rows belong to the elements that were solved, not to those of a refined field.
  const IrradianceField on_elements{{}, lit.prepared->light()};
  const IrradianceField& field = closure ? on_elements : lit.field;
  std::vector<RowClosure> rows;
  if (closure) {
    const auto& form_factors = two_pass_settings(settings).pass_one.form_factors;
    rows = assemble_transport(*field.scene, form_factors, events.progress).closure;
  }
  PaintedView view = paint_view(*settings.view, field, rows, camera, used);
  const std::string name(name_of(*settings.view));
  note(events, *settings.view == DebugView::elements
                   ? fmt::format("view elements: {} of them, each in a colour of its own", view.top)
                   : fmt::format("view {}: from 0 (black) to {:g} {} (pale yellow)", name, view.top,
                                 *settings.view == DebugView::irradiance ? "W/m^2"
                                 : closure                               ? "of a row"
                                                                         : "mirrors in a row"));
  Rendering rendering;
  rendering.image = std::move(view.colours);
  Image values(used.width, used.height);
  std::ranges::transform(view.values.values, values.pixels.begin(),
                         [](float value) { return glm::vec3(value); });
  rendering.layers.push_back({name, std::move(values)});
  return rendering;
}

RunSettings settled(const RunSettings& settings, const IrradianceField& field) {
  return settled(settings, *field.scene, !field.indirect.empty());
}

ViewPicture render_view(const LitScene& lit, const Camera& camera, PictureSize size,
                        const RunSettings& asked, const RunEvents& events, RunFigures& figures) {
  const RunSettings settings = settled(asked, lit.field);
  Stopwatch watch;
  const RenderSettings used = render_settings(settings, size);
  Rendering rendering = settings.view
                            ? painted(lit, camera, used, settings, events)
                            : render(lit.field, camera, used, events.progress);
  add_rendering(figures, rendering);
  figures.seconds.render = watch.lap();
  return picture_of(lit.prepared->scene, camera, settings, std::move(rendering));
}

/// Of two pictures that add up, an error is at most that of the fewer samples.
static void take_fewer(SampleCounts& samples, const SampleCounts& others) {
  for (std::size_t k = 0; k < samples.size() && k < others.size(); ++k)
    samples[k] = std::min(samples[k], others[k]);
}

ViewPicture render_lamp_layers(const LitScene& lit, const Camera& camera, PictureSize size,
                               const RunSettings& settings, const RunEvents& events,
                               RunFigures& figures) {
  if (std::ranges::any_of(lit.prepared->scene.materials, &Material::unlit))
    throw InputError(lit.prepared->scene.file, "", "has unlit surfaces, which are of no lamp: their "
                                                   "light is in no layer of --layers lamps");
  const auto& names = lit.field.scene->lamp_groups->names;
  const std::vector<Rgb> factors = factors_of_lamps(names, settings.lamp_factors);
  std::optional<ViewPicture> sum;
  for (std::size_t l = 0; l < names.size(); ++l) {
    std::vector<Rgb> own(factors.size(), Rgb(0.0));
    own[l] = factors[l];
    const LitScene alone{lit.prepared, relit(lit.field, own)};
    ViewPicture picture = render_view(alone, camera, size, settings, events, figures);
    Layer layer{"lamp." + names[l], picture.image};
    if (!sum) {
      sum = std::move(picture);
    } else {
      take_fewer(sum->samples, picture.samples);
      for (std::size_t k = 0; k < sum->image.pixels.size(); ++k)
        sum->image.pixels[k] += layer.image.pixels[k];
    }
    sum->layers.push_back(std::move(layer));
    sum->finer.reset();
  }
  if (!sum)
    throw InputError(lit.prepared->scene.file, "", "has no lamps for --layers lamps");
  sum->edges = {};
  sum->likely_edges.clear();
  return *std::move(sum);
}

ViewPicture render_reference_view(Scene scene, const Camera& camera, PictureSize size,
                                  const RunSettings& settings, const RunEvents& events,
                                  RunFigures& figures) {
  ViewPicture result{.image = {},
                     .samples = {},
                     .edges = {},
                     .likely_edges = {},
                     .layers = {},
                     .attributes = attributes_of(scene, camera, settings)};
  reference::ReferenceSettings limits = reference_settings(settings);
  limits.width = size.width;
  limits.height = size.height;
  auto picture = run_reference(std::move(scene), camera, limits, events, figures);
  result.image = std::move(picture.mean);
  result.layers = std::move(picture.layers);
  result.layers.push_back({"variance", std::move(picture.variance)});
  result.attributes.emplace_back("mode", "reference");
  result.attributes.emplace_back("samples", std::to_string(picture.samples));
  result.attributes.emplace_back("standardError", fmt::format("{:.4g}", picture.standard_error));
  return result;
}

} // namespace meninas
