#include "radiosity/pass_one_settings.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

const char* name_of(MeshCut cut) { return cut == MeshCut::uniform ? "uniform" : "hierarchical"; }

MeshCut mesh_cut(const PassOneChoice& choice) {
  const bool wants_rows = choice.form_factors != FormFactorMethod::rays ||
                          choice.solver == SolverMethod::progressive ||
                          choice.interpolation == Interpolation::average;
  return choice.mesh.value_or(wants_rows ? MeshCut::uniform : MeshCut::hierarchical);
}

bool gathers_by_nodes(const PassOneSettings& settings) {
  return settings.cut == MeshCut::hierarchical &&
         settings.interpolation.method == Interpolation::gather;
}

bool shoots_rays(const PassOneSettings& settings, std::size_t elements) {
  return settings.cut == MeshCut::uniform &&
         settings.solver.method == SolverMethod::progressive &&
         settings.form_factors.method == FormFactorMethod::rays && elements > max_direct_unknowns;
}

int power_of_two(int at_least) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(at_least)));
}

PassOneQuality pass_one_quality(Quality quality) {
  switch (quality) {
  case Quality::draft:
    return {.target_elements = 4'500,
            .rays = 128,
            .hemicube_resolution = 32,
            .link_error = 0.02,
            .penumbra_rays = 32,
            .images = 96,
            .images_in_element = 8,
            .faintest_world = 0.03};
  case Quality::normal:
    return {.target_elements = 16'000,
            .rays = 512,
            .hemicube_resolution = 64,
            .link_error = 0.01,
            .penumbra_rays = 128,
            .images = 256,
            .images_in_element = 32,
            .faintest_world = 0.01};
  case Quality::fine:
    return {.target_elements = 64'000,
            .rays = 2'048,
            .hemicube_resolution = 128,
            .link_error = 0.005,
            .penumbra_rays = 512,
            .images = 256,
            .images_in_element = 32,
            .faintest_world = 0.01};
  }
  return {};
}

double link_error_for(double rays) {
  const PassOneQuality normal = pass_one_quality(Quality::normal);
  const double error = normal.link_error * std::sqrt(normal.rays / rays);
  return std::round(1e4 * error) / 1e4;
}

static double target_elements(const PassOneChoice& choice, const PassOneQuality& quality) {
  // The cost of the analytic method grows with the square of the elements.
  constexpr double max_elements = 500.0;
  if (choice.elements)
    return *choice.elements;
  return choice.form_factors == FormFactorMethod::analytic
             ? std::min(quality.target_elements, max_elements)
             : quality.target_elements;
}

static InterpolationSettings interpolation_settings(const PassOneChoice& choice,
                                                    const PassOneSettings& settings) {
  InterpolationSettings interpolation;
  interpolation.method = choice.interpolation.value_or(interpolation.method);
  interpolation.rays = settings.form_factors.rays;
  interpolation.bend = choice.bends.value_or(0.0);
  // Edges are few: what they are off by counts less than what all light is, and the more so
  // the closer that is looked at.
  constexpr double of_edges = 0.02;
  if (settings.cut == MeshCut::hierarchical)
    interpolation.shadow_bend = std::sqrt(of_edges * settings.hierarchical.link_error);
  return interpolation;
}

PassOneSettings pass_one_settings(const PassOneChoice& choice) {
  const PassOneQuality quality = pass_one_quality(choice.quality);
  PassOneSettings settings;
  settings.cut = mesh_cut(choice);
  settings.mesh.element_size = choice.element_size.value_or(0.0);
  settings.mesh.target_elements = target_elements(choice, quality);
  settings.form_factors.method = choice.form_factors;
  settings.form_factors.rays = power_of_two(choice.rays.value_or(quality.rays));
  settings.form_factors.hemicube_resolution =
      choice.hemicube_resolution.value_or(quality.hemicube_resolution);
  settings.form_factors.seed = choice.seed;
  settings.direct.seed = choice.seed;
  settings.direct.penumbra_rays = quality.penumbra_rays;
  settings.direct.images = quality.images;
  settings.direct.images_in_element = quality.images_in_element;
  settings.solver.method = choice.solver;
  settings.solver.tolerance = choice.tolerance.value_or(settings.solver.tolerance);
  settings.solver.max_shots = choice.steps;
  settings.lamps = choice.lamps;
  settings.plan.worlds.min_throughput = quality.faintest_world;
  settings.hierarchical.link_error = choice.link_error.value_or(quality.link_error);
  settings.interpolation = interpolation_settings(choice, settings);
  // Means of elements show nowhere but where they are interpolated; else they light other elements,
  // and many average out.
  if (settings.interpolation.method == Interpolation::gather) {
    settings.direct.points = 4;
    settings.direct.max_points = 64;
  }
  if (choice.mirror_depth) {
    // A cap holds for every kind of path, in closed form and gathered.
    settings.plan.worlds.max_depth = std::min(settings.plan.worlds.max_depth, *choice.mirror_depth);
    settings.form_factors.max_bounces = *choice.mirror_depth;
  }
  return settings;
}

} // namespace meninas
