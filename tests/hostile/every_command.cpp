#include "tests/hostile/every_command.h"

#include "radiosity/queries/gltf_node_factors.h"
#include "raytrace/error/picture_error.h"
#include "raytrace/views/debug_view.h"
#include "raytrace/views/features.h"
#include "raytrace/views/seen_elements.h"
#include "reference/reference_picture.h"
#include "reference/scene_setup.h"
#include "runs/steering/expected_cost.h"
#include "scenes/errors.h"
#include "scenes/materials/lobes.h"
#include "scenes/report/scene_report.h"
#include "tests/hostile/findings.h"
#include "tests/hostile/hostile_lights.h"
#include "tests/hostile/hostile_shapes.h"
#include "tests/hostile/solution_commands.h"

#include <fmt/format.h>

#include <array>

namespace meninas::test {

namespace {

template <typename Value, std::size_t N>
Value one_of(Random& random, const std::array<Value, N>& values) {
  return values[static_cast<std::size_t>(random.between(0.0, N))];
}

/// Draft, with fewer of everything.
RunSettings drawn_settings(Random& random) {
  RunSettings settings;
  settings.quality = one_of(random, std::array{Quality::draft, Quality::draft, Quality::normal});
  settings.elements = static_cast<int>(random.between(20.0, 150.0));
  settings.rays = one_of(random, std::array{16, 32, 64});
  settings.solver = one_of(random, solver_methods);
  settings.mesh = happens(random, 0.5) ? MeshCut::hierarchical : MeshCut::uniform;
  if (settings.mesh == MeshCut::uniform) {
    settings.form_factors =
        one_of(random, std::array{FormFactorMethod::rays, FormFactorMethod::rays,
                                  FormFactorMethod::hemicube});
    settings.hemicube_resolution = 8;
    if (happens(random, 0.15))
      settings.interpolation = Interpolation::average;
  }
  const bool gathers = settings.interpolation != Interpolation::average;
  if (gathers && happens(random, 0.2))
    settings.bends = 0.02;
  if (happens(random, 0.2))
    settings.mirror_depth = static_cast<int>(random.between(0.0, 4.0));
  settings.samples = one_of(random, std::array{1, 4, 16});
  settings.mode = happens(random, 0.15) ? PictureMode::radiosity : PictureMode::hybrid;
  settings.diffuse = one_of(random, std::array{DiffuseTerm::interpolated, DiffuseTerm::direct,
                                               DiffuseTerm::gather});
  if (gathers && happens(random, 0.2))
    settings.layers = WithLayers::yes;
  if (happens(random, 0.2))
    settings.pixel_error = 0.05;
  if (happens(random, 0.2))
    settings.filter = PixelFilter::gaussian;
  settings.glossy_samples = 4;
  settings.seed = static_cast<std::uint32_t>(random.between(0.0, 1e6));
  if (happens(random, 0.5))
    settings.background = Rgb(1.0);
  if (happens(random, 0.3))
    settings.lamps = one_of(random, std::array{LampGrouping::node, LampGrouping::material});
  return settings;
}

std::string in_words(const RunSettings& settings) {
  return fmt::format("{} solver {} form factors {} mesh {} bends {} mode {} diffuse {} layers {} "
                     "samples {} sky {} lamps {}",
                     static_cast<int>(settings.quality), name_of(settings.solver),
                     static_cast<int>(settings.form_factors), static_cast<int>(mesh_cut(settings)),
                     settings.bends.has_value(), static_cast<int>(settings.mode),
                     static_cast<int>(diffuse_term(settings)), static_cast<int>(settings.layers),
                     *settings.samples, settings.background.has_value(), settings.lamps.has_value());
}

/// The light beyond which nothing can be where the sky is all there is, else infinity.
/// An unlit surface shows its base colour, at most that of its factor, whatever the sky.
/// Glass and lobes are drawn by chance, with weights whose mean alone is bounded.
double brightest(const Scene& scene) {
  const bool sky_alone = scene.lights.empty() && scene.area_lights.empty() &&
                         !scene.background.map && std::ranges::none_of(scene.materials, is_emitter);
  const bool by_chance =
      std::ranges::any_of(scene.materials, [](const Material& m) { return is_glass(m); }) ||
      std::ranges::any_of(scene.materials, has_lobes);
  if (!sky_alone || by_chance)
    return std::numeric_limits<double>::infinity();
  double most = glm::compMax(scene.background.constant);
  for (const Material& material : scene.materials)
    if (material.unlit)
      most = std::max(most, glm::compMax(material.base_color));
  return most;
}

void check(const RadiositySolution& solution) {
  require_light(solution.radiosity, "radiosity");
  require_light(solution.irradiance, "irradiance");
  require_light(solution.field.irradiance, "irradiance of vertex");
  require_light(solution.field.indirect, "indirect irradiance of vertex");
  const EnergyBalance& energy = solution.energy;
  const Rgb sum = energy.emitted + energy.absorbed + energy.escaped + energy.mirror_absorbed;
  const auto require_energy = [&](const Rgb& part, const char* name, double least) {
    require(is_light(part, least),
            fmt::format("energy {} is {} {} {}", name, part.r, part.g, part.b));
  };
  const double least = -1e-6 * glm::compMax(sum);
  require_energy(energy.emitted, "emitted", least);
  require_energy(energy.absorbed, "absorbed", least);
  require_energy(energy.escaped, "escaped", least);
  // Coats let in more than their mean from some angles: by chance mirrors may seem to have given.
  require_energy(energy.mirror_absorbed, "absorbed by mirrors",
                 -std::numeric_limits<double>::max());
  require(std::isfinite(energy.imbalance), "the imbalance of energy is not finite");
  require(std::isfinite(solution.closure.max_error) && std::isfinite(solution.solver.residual),
          "closure or residual is not finite");
}

void check(const Rendering& rendering, double most) {
  require_light(rendering.image.pixels, "pixel");
  // Roundings of floats in sums of a few hundred terms.
  for (const glm::vec3& pixel : rendering.image.pixels)
    require(glm::compMax(pixel) <= most * 1.001,
            fmt::format("a pixel of {} where the brightest is {}", glm::compMax(pixel), most));
  for (const Layer& layer : rendering.layers)
    for (const glm::vec3& pixel : layer.image.pixels)
      require(std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b),
              "layer " + layer.name + " is not finite");
}

Camera camera_of(const Scene& scene) {
  return scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
}

void draw_reference(const Scene& scene, const Camera& camera) {
  const auto traced = reference::make_traced_scene(scene);
  const auto picture = reference::reference_picture(
      traced, camera, {.width = 8, .height = 8, .max_samples = 2 * reference::batch_samples});
  require_light(picture.mean.pixels, "pixel of the reference");
  // Squares of what is brighter than 1e19 are infinite as floats.
  for (const glm::vec3& variance : picture.variance.pixels)
    require(glm::compMin(variance) >= 0.0F, "a variance of the reference is no number");
}

void find_form_factors(const Scene& scene, const SurfaceModel& surfaces, Random& random) {
  NodeFactorSettings settings;
  settings.method = one_of(random, std::array{NodeFactorMethod::analytic, NodeFactorMethod::rays,
                                              NodeFactorMethod::hemicube});
  settings.accuracy = 0.05;
  settings.rays = 1 << 10;
  settings.resolution = 16;
  settings.points = 4;
  settings.max_depth = 2;
  std::vector<NodeSet> nodes;
  for (std::uint32_t n = 0; n < std::min<std::size_t>(scene.nodes.size(), 4); ++n)
    nodes.push_back({static_cast<NodeId>(n)});
  const NodeFactors factors = node_form_factors(
      scene, surfaces, one_of(random, std::array{nodes.front(), nodes.back()}), nodes, settings);
  double sum = 0.0;
  for (const ExtendedFactor& factor : factors.to) {
    const double value = factor.total.value, error = factor.total.error;
    require(std::isfinite(value) && value >= 0.0 && std::isfinite(error) && error >= 0.0,
            fmt::format("a form factor of {} +- {} by method {}", value, error, static_cast<int>(settings.method)));
    sum += value - 3.0 * error;
  }
  // What a face of glass receives goes on in part, and is received again.
  const bool passes = std::ranges::any_of(scene.materials, [](const Material& m) { return is_glass(m); });
  require(passes || sum <= 1.01, fmt::format("form factors of {} in all", sum));
}

/// `plan`, and what goes on from there.
void run(Scene scene, const RunSettings& settings, Random& random, const Effort& effort) {
  TwoPassSettings chosen = two_pass_settings(settings);
  chosen.render.width = chosen.render.height = 16;
  // Between mirrors of reflectance 0.99 a ray is followed a thousand times.
  chosen.render.diffuse.points.rays = 16;
  chosen.render.diffuse.direct.penumbra_rays = 16;
  // Exact rows of some hundred elements take minutes, by design: here they need no more digits than a test of laws.
  chosen.pass_one.form_factors.accuracy = 0.05;
  const auto prepared = prepare_scene(std::move(scene), chosen.pass_one);
  const Scene& there = prepared->scene;
  const Camera camera = camera_of(there);
  report_scene(there, prepared->surfaces, *prepared->rays);
  const ExpectedCost cost = expect_cost(*prepared, camera, {16, 16}, settings, 0.0, 1);
  require(std::isfinite(cost.total) && cost.total >= 0.0, "the cost that is foretold is no number");
  if (there.triangles.size() > effort.max_triangles)
    return;

  // Of large scenes what a view does not show is less exact; here of small ones too.
  const RadiositySolution solution =
      happens(random, 0.3) ? solve_for_view(prepared->light(), chosen.pass_one,
                                            seen_elements(*prepared->light(), camera, chosen.render))
                           : solve_pass_one(prepared->light(), chosen.pass_one);
  check(solution);
  const Rendering rendering = render(solution.field, camera, chosen.render);
  check(rendering, brightest(there));
  render_features(solution.field, camera, chosen.render);
  use_solution(*prepared, solution, chosen, random);
  if (happens(random, 0.3)) {
    const PictureError error =
        estimate_error(solution.field, camera, chosen, solution.solver,
                       {rendering.image, rendering.samples}, {.gathered_pixels = 16, .pixels = 64});
    require(!std::isnan(error.total) && error.total >= 0.0,
            fmt::format("the error estimate is no number: mesh {} form factors {} tail {} pixels "
                        "{} solver {} of {}",
                        error.mesh, error.form_factors, error.mirror_tail, error.pixels,
                        error.solver, error.mean_radiance));
  }
  if (there.triangles.size() > effort.max_drawn_triangles)
    return;
  if (happens(random, 0.3))
    draw_reference(there, camera);
  if (happens(random, 0.3)) {
    try {
      find_form_factors(there, prepared->surfaces, random);
    } catch (const UsageError&) {
      // A node of mirrors alone sends nothing.
    }
  }
}

} // namespace

void run_every_command(Scene scene, Random& random, const Effort& effort) {
  RunSettings settings = drawn_settings(random);
  // Exact form factors by way of many mirrors take minutes, by design.
  const bool exact = happens(random, 0.1) && std::ranges::none_of(scene.materials, is_mirror);
  if (exact && scene.triangles.size() <= effort.max_drawn_triangles / 4 &&
      settings.mesh == MeshCut::uniform) {
    settings.form_factors = FormFactorMethod::analytic;
    settings.elements = 20; // its time grows with their square, and a row takes up to some seconds
  }
  // `render` refuses direct light beside a field that does not tell it apart.
  if (settings.diffuse == DiffuseTerm::direct && !tells_light_apart(settings))
    settings.diffuse = DiffuseTerm::interpolated;
  scene.background = happens(random, 0.2)
                         ? hostile_sky(random)
                         : Environment(settings.background.value_or(scene.background.constant));
  try {
    run(std::move(scene), settings, random, effort);
  } catch (const Finding& finding) {
    throw Finding(fmt::format("{} ({})", finding.what(), in_words(settings)));
  }
}

} // namespace meninas::test
