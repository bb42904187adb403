#include "runs/trade/trade_parameters.h"

#include "runs/steering/setting_options.h"

#include <fmt/format.h>

namespace meninas {

namespace {

RunSettings preset(const RunSettings& base, Quality quality) {
  RunSettings settings = base;
  settings.quality = quality;
  return spelled_out(settings);
}

/// Collects turns of one setting.
struct Turner {
  const RunSettings& from;
  std::vector<ChangedSettings> all = {};

  template <typename Change>
  void turn(const char* parameter, std::string was, std::string is, bool finer, Change&& change) {
    ChangedSettings next{from, {parameter, std::move(was), std::move(is), 0}, finer};
    change(next.settings);
    all.push_back(std::move(next));
  }
  /// One step up and one down, within limits.
  template <typename Number>
  void steps(const char* parameter, Number value, Number factor, Number least, Number most,
             std::optional<Number> RunSettings::*field) {
    const auto to = [&](Number next, bool finer) {
      if (next >= least && next <= most)
        turn(parameter, fmt::format("{}", value), fmt::format("{}", next), finer,
             [&](RunSettings& s) { s.*field = next; });
    };
    to(static_cast<Number>(value * factor), true);
    to(static_cast<Number>(value / factor), false);
  }
};

/// The cut through the mesh, and how fine a hierarchical one is.
void turn_cut(Turner& turner) {
  const RunSettings& s = turner.from;
  if (mesh_cut(s) == MeshCut::hierarchical) {
    turner.steps<double>("link-error", *s.link_error, 0.5, 0.001, 0.1, &RunSettings::link_error);
    turner.turn("mesh", "hierarchical", "uniform", false, [](RunSettings& r) {
      r.mesh = MeshCut::uniform;
      r.link_error.reset();
    });
  }
}

void turn_mesh(Turner& turner) {
  const RunSettings& s = turner.from;
  turner.steps<int>("elements", *s.elements, 2, 100, 200'000, &RunSettings::elements);
  turn_cut(turner);
  if (s.interpolation.value_or(Interpolation::gather) != Interpolation::gather)
    return;
  if (s.bends)
    turner.turn("bends", fmt::format("{}", *s.bends), "no", false,
                [](RunSettings& r) { r.bends.reset(); });
  else
    turner.turn("bends", "no", "0.1", true, [](RunSettings& r) { r.bends = 0.1; });
}

void turn_transport(Turner& turner, const TradeScene& scene) {
  const RunSettings& s = turner.from;
  if (s.form_factors == FormFactorMethod::rays) {
    turner.steps<int>("rays", *s.rays, 2, 16, 8192, &RunSettings::rays);
    turner.turn("form-factors", "rays", "hemicube", false, [](RunSettings& r) {
      r.form_factors = FormFactorMethod::hemicube;
      r.link_error.reset();
      r.rays.reset();
      r.hemicube_resolution = 24;
    });
  } else {
    turner.steps<int>("hemicube-resolution", *s.hemicube_resolution, 2, 12, 192,
                      &RunSettings::hemicube_resolution);
  }
  if (s.solver == SolverMethod::bicgstab) {
    for (const SolverMethod solver : {SolverMethod::gauss_seidel, SolverMethod::progressive})
      turner.turn("solver", name_of(s.solver), name_of(solver), false,
                  [&](RunSettings& r) {
                    r.solver = solver;
                    if (mesh_cut(r) == MeshCut::uniform)
                      r.link_error.reset();
                  });
    const double tolerance = s.tolerance.value_or(SolverSettings{}.tolerance);
    if (tolerance < 1e-2)
      turner.turn("tolerance", fmt::format("{}", tolerance), fmt::format("{}", tolerance * 10.0),
                  false, [&](RunSettings& r) { r.tolerance = tolerance * 10.0; });
  }
  if (scene.mirrors) {
    if (!s.mirror_depth)
      turner.turn("mirror-depth", "all", "2", false, [](RunSettings& r) { r.mirror_depth = 2; });
    else if (*s.mirror_depth > 1)
      turner.turn("mirror-depth", "2", "1", false, [](RunSettings& r) { r.mirror_depth = 1; });
  }
}

/// Adaptive sampling saves most of many samples; of few there is nothing to save.
void turn_pixel_error(Turner& turner) {
  constexpr double first = 0.05;
  constexpr int many = 16;
  const RunSettings& s = turner.from;
  if (s.pixel_error)
    turner.steps<double>("pixel-error", *s.pixel_error, 0.5, 0.005, 0.2, &RunSettings::pixel_error);
  else if (*s.samples >= many)
    turner.turn("pixel-error", "no", fmt::format("{}", first), false,
                [&](RunSettings& r) { r.pixel_error = first; });
}

void turn_picture(Turner& turner) {
  const RunSettings& s = turner.from;
  turner.steps<int>("samples", *s.samples, 4, 1, 1024, &RunSettings::samples);
  turn_pixel_error(turner);
  const auto term = [&](DiffuseTerm to, bool finer) {
    turner.turn("diffuse", name_of(*s.diffuse), name_of(to), finer,
                [&](RunSettings& r) { r.diffuse = to; });
  };
  if (s.diffuse == DiffuseTerm::interpolated && tells_light_apart(s))
    term(DiffuseTerm::direct, true);
  else if (s.diffuse == DiffuseTerm::direct) {
    term(DiffuseTerm::interpolated, false);
    term(DiffuseTerm::gather, true);
  }
  if (s.interpolation.value_or(Interpolation::gather) == Interpolation::gather)
    turner.turn("interpolation", "gather", "average", false, [](RunSettings& r) {
      r.interpolation = Interpolation::average;
      r.link_error.reset();
      r.bends.reset();
    });
}

} // namespace

RunSettings spelled_out(const RunSettings& settings) {
  RunSettings result = settings;
  const QualityPreset preset = preset_of(settings.quality);
  if (!result.elements)
    result.elements = static_cast<int>(preset.target_elements);
  if (!result.rays)
    result.rays = preset.rays;
  if (!result.link_error && mesh_cut(result) == MeshCut::hierarchical)
    result.link_error = preset.link_error;
  if (!result.samples) {
    result.samples = preset.samples;
    if (preset.pixel_error > 0.0 && !result.pixel_error)
      result.pixel_error = preset.pixel_error;
  }
  result.diffuse = diffuse_term(result);
  return result;
}

std::vector<RunSettings> first_settings(const RunSettings& base) {
  RunSettings look = base;
  look.quality = Quality::draft;
  look.elements = 600;
  look.rays = 64;
  look.samples = 4;
  return {spelled_out(look), preset(base, Quality::draft), preset(base, Quality::normal)};
}

std::vector<ChangedSettings> turned(const RunSettings& settings, const TradeScene& scene) {
  Turner turner{settings};
  turn_mesh(turner);
  turn_transport(turner, scene);
  turn_picture(turner);
  return std::move(turner.all);
}

} // namespace meninas
