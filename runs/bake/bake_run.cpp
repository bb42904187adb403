#include "runs/bake/bake_run.h"

#include "image/whole_file.h"
#include "runs/bake/baked_document.h"
#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/report/percent.h"
#include "runs/resources.h"
#include "runs/run_stages.h"
#include "runs/steering/memory.h"
#include "runs/view.h"
#include "scenes/errors.h"
#include "scenes/glb_file.h"
#include "scenes/gltf/state/animation.h"
#include "scenes/gltf/state/visibility.h"
#include "scenes/gltf/stages.h"
#include "scenes/names.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace meninas {

namespace {

namespace fs = std::filesystem;

struct BakedFiles {
  fs::path baked, exr, png;
};

BakedFiles files_of(const BakeRequest& request) {
  BakedFiles files{request.baked, request.baked, request.baked};
  files.exr.replace_extension(".lightmap.exr");
  files.png.replace_extension(".lightmap.png");
  return files;
}

BakedFiles check_files(const BakeRequest& request) {
  if (request.baked.extension() != ".glb")
    throw OutputError(request.baked.string(), "", "cannot write: a baked scene is a .glb file");
  const BakedFiles files = files_of(request);
  std::vector<fs::path> inputs{request.scene};
  if (request.solution)
    inputs.push_back(*request.solution);
  for (const fs::path& file : files_beside_scene(request.settings))
    inputs.push_back(file);
  check_outputs({.pictures = {files.exr, files.png}, .solution = files.baked, .texts = {}}, inputs);
  return files;
}

/// The file at rest, and where its triangles are in the state that is asked for.
struct SceneFile {
  gltf::Document document;
  std::vector<gltf::PlacedPrimitive> primitives;
  double light_unit = 1.0; ///< the file's numbers for 1 W/m^2
};

SceneFile read_scene_file(const BakeRequest& request) {
  const GltfSettings& settings = request.settings.gltf;
  auto content = gltf::read_whole_file(request.scene, settings.memory_limit);
  if (!content.problem.empty())
    throw UserError(content.kind, request.scene.string(), "", content.problem);
  SceneFile file{gltf::read_document(std::move(content.bytes), request.scene, settings), {}};
  gltf::Findings said_before;
  gltf::Document posed = file.document;
  if (settings.state.at)
    gltf::pose_at(posed, *settings.state.at, said_before);
  gltf::hide_nodes(posed.root, said_before);
  posed.settings.state.units = gltf::light_units_of(posed, said_before);
  file.light_unit = gltf::light_unit(posed);
  file.primitives = gltf::placed_primitives(posed, gltf::place_nodes(posed, said_before));
  return file;
}

LitScene lit_scene(const BakeRequest& request, Scene scene, const RunEvents& events, RunFigures& figures) {
  const PassOneSettings settings = two_pass_settings(request.settings).pass_one;
  return request.solution
             ? read_lit_scene(*request.solution, std::move(scene), settings, events, figures)
             : solve_lit_scene(std::move(scene), settings, std::nullopt, events, figures);
}

/// The part of the light that is baked.
VertexIrradiance wanted_light(const BakeRequest& request, const IrradianceField& field) {
  if (!request.direct && field.indirect.empty())
    throw UsageError("--direct off", "the solution does not know direct light apart (--interpolation average "
                                     "with --form-factors analytic)");
  return {.irradiance = request.direct ? field.irradiance : field.indirect,
          .mirrored = {},
          .indirect = {},
          .indirect_mirrored = {}};
}

void warn_of_layout(const BakeRequest& request, const LightmapLayout& layout, double root_size,
                    const RunEvents& events) {
  if (layout.detail < layout.full_detail)
    warn(events, fmt::format("--lightmap-size {}: the finest texels are {:.2g} m wide, coarser than the mesh "
                             "({:.2g} m): use a larger --lightmap-size",
                             request.lightmap_size, std::ldexp(root_size, -layout.detail),
                             std::ldexp(root_size, -layout.full_detail)));
  if (layout.single > 0)
    warn(events, fmt::format("faces shorter than half a texel are evenly lit: {} of {}", layout.single,
                             layout.charts.size()));
}

void warn_of_scene(const BakeRequest& request, const Scene& scene, const FileCharts& charts,
                   const RunEvents& events) {
  if (!charts.two_lit.empty())
    warn(events, fmt::format("double-sided faces show the light of their brighter side on both, in nodes: {}",
                             quoted_names(charts.two_lit)));
  if (request.direct && (!scene.lights.empty() || !scene.area_lights.empty()))
    warn(events, "the lights of the file are in the lightmap: a viewer in which they shine counts them twice "
                 "(--direct off leaves them out)");
}

nlohmann::json extras_of(const BakeRequest& request, const Lightmap& map, double unit) {
  nlohmann::json extras{{"quantity", request.direct ? "irradiance" : "irradiance without direct light"},
                        {"encoding", "sRGB"},
                        {"unit", unit == 1.0 ? "W/m^2" : "lux"},
                        {"factor", map.factor * unit}};
  if (!map.shown.pixels.empty())
    extras["baked_exposure"] = map.exposure;
  return extras;
}

struct Written {
  LightmapLayout layout;
  std::uintmax_t bytes = 0;
};

Written write_files(const BakeRequest& request, const BakedFiles& files, const SceneFile& file,
                    const LitScene& lit, const RunEvents& events) {
  const IrradianceField& field = lit.field;
  const VertexIrradiance light = wanted_light(request, field);
  const FileCharts charts = find_charts(field, file.primitives);
  const double root_size = field.mesh().element_size;
  const LightmapLayout layout = lay_out(charts.charts, root_size, request.lightmap_size);
  warn_of_layout(request, layout, root_size, events);
  warn_of_scene(request, field.scene->scene, charts, events);
  const Lightmap map = fill_lightmap(field, light, charts.charts, layout,
                                     request.direct ? WithShown::yes : WithShown::no);
  if (map.brightest > map.factor)
    note(events, fmt::format("{}: irradiance above {:.3g} W/m^2 is clipped in 8 bits, up to {:.3g} W/m^2 in {}",
                             files.png.string(), map.factor, map.brightest, files.exr.string()));
  BakedImages images{.irradiance = irradiance_png(map),
                     .intensity = map.factor * file.light_unit,
                     .shown = {},
                     .extras = extras_of(request, map, file.light_unit)};
  if (request.direct)
    images.shown = shown_png(map);
  const BakedDocument baked = baked_document({file.document, file.primitives, charts, layout, field}, images);
  for (const std::string& warning : baked.warnings)
    warn(events, warning);
  const auto glb = glb_bytes(baked.root, baked.binary, files.baked);
  write_exr(files.exr, map.irradiance, {}, PixelType::float32, {{"unit", "W/m^2"}});
  write_whole_file(files.png, images.irradiance);
  write_whole_file(files.baked, glb);
  if (!baked.variant.empty())
    note(events, fmt::format("{}: variant '{}' is unlit, at an exposure of {:.4g} EV", files.baked.string(),
                             baked.variant, map.exposure));
  return {layout, glb.size()};
}

} // namespace

RunFigures bake_run(const BakeRequest& request, const RunEvents& events) {
  const BakedFiles files = check_files(request);
  const ThreadLimit limit(request.settings.threads);
  begin_stages(events, joined(pass_one_stages(request.settings), {{"writing", 5.0}}));
  if (events.progress)
    events.progress("scene", 0.0);
  RunFigures figures;
  figures.threads = limit.threads();
  Stopwatch total, watch;
  Scene scene = load_relit_scene(request.scene, request.settings);
  check_memory(scene, request.settings, std::nullopt);
  const SceneFile file = read_scene_file(request);
  figures.seconds.load = watch.lap();
  const LitScene lit = lit_scene(request, std::move(scene), events, figures);

  watch.lap();
  const Written written = write_files(request, files, file, lit, events);
  figures.seconds.write = watch.lap();
  figures.seconds.total = total.lap();
  figures.peak_memory_bytes = peak_memory_bytes();
  note(events, fmt::format("{}: {} charts in {} x {} texels, {:.1f} MB in {:.1f} s", request.baked.string(),
                           written.layout.charts.size(), written.layout.width, written.layout.height,
                           double(written.bytes) * 1e-6, figures.seconds.total));
  return figures;
}

} // namespace meninas
