#include "cli/common_options.h"

#include "cli/light/sky_options.h"
#include "cli/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace meninas {
namespace {

constexpr const char* pass_one_group = "Accuracy of pass one";
constexpr int max_steps = 1'000'000'000;

const Choices<Quality> qualities{
    {"draft", Quality::draft}, {"normal", Quality::normal}, {"fine", Quality::fine}};
const Choices<LightUnits> units{{"radiometric", LightUnits::radiometric},
                                {"photometric", LightUnits::photometric}};
const Choices<FormFactorMethod> form_factor_methods{{"rays", FormFactorMethod::rays},
                                                    {"hemicube", FormFactorMethod::hemicube},
                                                    {"analytic", FormFactorMethod::analytic}};
template <typename Value, std::size_t n>
Choices<Value> by_name(const std::array<Value, n>& values) {
  Choices<Value> choices;
  for (const Value value : values) {
    choices.emplace_back(name_of(value), value);
  }
  return choices;
}
const Choices<SolverMethod> solvers = by_name(solver_methods);
const Choices<MeshCut> cuts = by_name(mesh_cuts);
/// As `--mesh hierarchical` was asked for when it was one of the solvers.
constexpr const char* hierarchical_solver = "hierarchical";
const Choices<DiffuseTerm> diffuse_terms{{"interpolated", DiffuseTerm::interpolated},
                                         {"direct", DiffuseTerm::direct},
                                         {"gather", DiffuseTerm::gather}};
const Choices<Interpolation> interpolations{{"average", Interpolation::average},
                                            {"gather", Interpolation::gather}};

/// Options that choose one of several names; the default is the one a default run has.
template <typename Value, typename Take>
Option add_choice(Options& command, const std::string& option, const Choices<Value>& choices,
                  Value standard, const std::string& description, Take take) {
  return command.add(option, fmt::format("{}", fmt::join(names_of(choices), "|")),
                     fmt::format("{} [{}]", description, name_of(standard, choices)),
                     [=](const std::string& text) { take(parse_choice(option, text, choices)); });
}

/// "draft 1, normal 2, fine 3"
template <typename Owner, typename Field>
std::string by_preset(Field Owner::*field) {
  std::vector<std::string> parts;
  for (const auto& [name, quality] : qualities) {
    parts.push_back(fmt::format("{} {}", name, preset_of(quality).*field));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Older names of `--mesh`.
void add_adaptive(Options& command, CommonOptions& options) {
  const Option adaptive =
      command
          .add("--adaptive", "[X]", "older name of --mesh hierarchical --link-error X",
               [&](const std::string& text) {
                 options.settings.mesh = MeshCut::hierarchical;
                 options.notes.emplace_back("--adaptive is --mesh hierarchical --link-error now");
                 if (text != preset_value) {
                   options.settings.link_error = parse_number("--adaptive", text, Sign::positive);
                 }
               })
          .value_if_given(preset_value)
          .group(study_group);
  command
      .add_flag("--no-adaptive", "older name of --mesh uniform",
                [&] {
                  options.settings.mesh = MeshCut::uniform;
                  options.notes.emplace_back("--no-adaptive is --mesh uniform now");
                })
      .excludes(adaptive)
      .group(study_group);
}

void add_bends(Options& command, RunSettings& settings) {
  command
      .add("--bends", "X",
           "refine where indirect light curves, as at contact edges, by more than X of the scene's "
           "mean between vertices [off]",
           [&](const std::string& text) {
             settings.bends = parse_number("--bends", text, Sign::positive);
           })
      .group(study_group);
}

} // namespace

DiffuseTerm parse_diffuse(const std::string& text) {
  return parse_choice("--diffuse", text, diffuse_terms);
}

void add_scene(Options& command, CommonOptions& options) {
  command
      .add("SCENE", "", "glTF 2.0 scene, .gltf or .glb",
           [&](const std::string& text) { options.scene = text; })
      .required();
  GltfSettings& gltf = options.settings.gltf;
  add_allow_external(command, gltf);
  command
      .add("--memory-limit", "SIZE",
           fmt::format("refuse a run that would need more memory, such as 800M [{}G to read the scene, "
                       "all the machine has for the rest]",
                       gltf.memory_limit >> 30),
           [&](const std::string& text) {
             gltf.memory_limit = parse_bytes("--memory-limit", text);
             options.settings.memory_limit = gltf.memory_limit;
           })
      .group(run_group);
}

void add_allow_external(Options& command, GltfSettings& settings) {
  command
      .add_flag("--allow-external", "read buffers and textures outside the scene's folder [refused]",
                [&] { settings.external_files = ExternalFiles::anywhere; })
      .group(file_group);
}

void add_state_options(Options& command, CommonOptions& options) {
  SceneState& state = options.settings.gltf.state;
  command
      .add("--variant", "NAME", "variant of the scene's materials [each primitive's own]",
           [&](const std::string& text) { state.variant = text; })
      .group(file_group);
  command
      .add("--at", "SECONDS", "show the scene's animations at that time [the rest pose]",
           [&](const std::string& text) { state.at = parse_number("--at", text, Sign::any); })
      .group(file_group);
}

void add_quality(Options& command, CommonOptions& options) {
  add_choice(command, "--quality", qualities, RunSettings{}.quality,
             "preset of all options of accuracy; each can be given by itself",
             [&](Quality quality) { options.settings.quality = quality; });
}

void add_mesh_options(Options& command, CommonOptions& options) {
  RunSettings& settings = options.settings;
  command
      .add("--element-size", "METRES", "edge length of the mesh elements [as --elements says]",
           [&](const std::string& text) {
             settings.element_size = parse_number("--element-size", text, Sign::positive);
           })
      .group(pass_one_group);
  command
      .add("--elements", "N",
           fmt::format("number of mesh elements, about [{}]",
                       by_preset(&QualityPreset::target_elements)),
           [&](const std::string& text) {
             settings.elements = static_cast<int>(
                 parse_integer("--elements", text, 1, std::int64_t{MeshSettings{}.max_elements}));
           })
      .group(pass_one_group);
  command
      .add("--mirror-depth", "N", "follow light over at most N mirrors [as many as matter]",
           [&](const std::string& text) {
             settings.mirror_depth =
                 static_cast<int>(parse_integer("--mirror-depth", text, 0, 1'000'000));
           })
      .group(pass_one_group);
}

/// Which unknowns the radiosity system has, and how it is solved.
static void add_solver_options(Options& command, CommonOptions& options) {
  RunSettings& settings = options.settings;
  const PassOneSettings standard = two_pass_settings({}).pass_one;
  command
      .add("--solver", fmt::format("{}", fmt::join(names_of(solvers), "|")),
           fmt::format("how the radiosity system is solved [{}]", name_of(standard.solver.method)),
           [&](const std::string& text) {
             if (text == hierarchical_solver) {
               settings.mesh = MeshCut::hierarchical;
               options.notes.emplace_back("--solver hierarchical is --mesh hierarchical now");
             } else {
               settings.solver = parse_choice("--solver", text, solvers);
             }
           })
      .group(study_group);
  add_choice(command, "--mesh", cuts, standard.cut,
             "what the unknowns are: elements of one size, or parts of surfaces as large as accuracy "
             "allows",
             [&](MeshCut cut) { settings.mesh = cut; })
      .group(study_group);
  command
      .add("--tolerance", "X",
           fmt::format("relative error at which the solver stops [{}]", standard.solver.tolerance),
           [&](const std::string& text) {
             settings.tolerance = parse_number("--tolerance", text, Sign::positive);
           })
      .group(study_group);
  command
      .add("--steps", "N", "stop --solver progressive after N shots [at --tolerance]",
           [&](const std::string& text) {
             settings.steps = static_cast<int>(parse_integer("--steps", text, 0, max_steps));
           })
      .group(study_group);
}

void add_pass_one_options(Options& command, CommonOptions& options) {
  RunSettings& settings = options.settings;
  const PassOneSettings standard = two_pass_settings({}).pass_one;
  add_choice(command, "--form-factors", form_factor_methods, standard.form_factors.method,
             "how form factors are computed",
             [&](FormFactorMethod method) { settings.form_factors = method; })
      .group(study_group);
  command
      .add("--rays", "N",
           fmt::format("rays per element for form factors, a power of two [{}]",
                       by_preset(&QualityPreset::rays)),
           [&](const std::string& text) {
             settings.rays = static_cast<int>(parse_integer("--rays", text, 1, 1 << 20));
           })
      .group(pass_one_group);
  command
      .add("--hemicube-resolution", "N",
           fmt::format("cells along an edge of a hemicube's top face, an even number [{}]",
                       by_preset(&QualityPreset::hemicube_resolution)),
           [&](const std::string& text) {
             settings.hemicube_resolution = parse_resolution("--hemicube-resolution", text);
           })
      .group(study_group);
  add_solver_options(command, options);
  command
      .add("--link-error", "X",
           fmt::format("--mesh hierarchical: interpolation error allowed, relative to the light "
                       "there [{}]",
                       by_preset(&QualityPreset::link_error)),
           [&](const std::string& text) {
             settings.link_error = parse_number("--link-error", text, Sign::positive);
           })
      .group(study_group);
  add_adaptive(command, options);
  add_bends(command, settings);
  add_choice(command, "--interpolation", interpolations, standard.interpolation.method,
             "irradiance at vertices: averaged over the elements around, or gathered there",
             [&](Interpolation method) { settings.interpolation = method; })
      .group(study_group);
}

void add_light_options(Options& command, CommonOptions& options) {
  SceneState& state = options.settings.gltf.state;
  add_sky_options(command, options.settings);
  command
      .add("--light-scale", "X",
           "multiply the intensity of point, spot, directional and area lights, and of luminaires [1]",
           [&](const std::string& text) {
             state.light_scale = parse_number("--light-scale", text, Sign::positive);
           })
      .group(light_group);
  add_choice(command, "--units", units, LightUnits::radiometric,
             "what the file's light is in: W/m^2/sr, W/sr and W/m^2, or cd/m^2, cd and lx",
             [&](LightUnits chosen) { state.units = chosen; })
      .group(light_group);
  command
      .add("--luminous-efficacy", "K",
           fmt::format("lm/W between photometric and radiometric numbers [{}]",
                       state.luminous_efficacy),
           [&](const std::string& text) {
             state.luminous_efficacy = parse_number("--luminous-efficacy", text, Sign::positive);
           })
      .group(light_group);
  command
      .add_repeatable("--ies", "LIGHT=FILE",
                      "put the luminaire of an IES file in place of a point or spot light; may be "
                      "given several times",
                      [&](const std::string& text) {
                        const auto split = text.find('=');
                        if (split == 0 || split == std::string::npos || split + 1 == text.size())
                          throw UsageError("--ies", "takes LIGHT=FILE, not '" + text + "'");
                        state.luminaires[text.substr(0, split)] = text.substr(split + 1);
                      })
      .group(light_group);
}

void add_run_options(Options& command, CommonOptions& options) {
  command
      .add("--threads", "N", "number of threads [all cores]",
           [&](const std::string& text) {
             options.settings.threads = static_cast<int>(parse_integer("--threads", text, 1, 1024));
           })
      .group(run_group);
  command
      .add("--seed", "N", fmt::format("seed of all sampling [{}]", RunSettings{}.seed),
           [&](const std::string& text) {
             options.settings.seed =
                 static_cast<std::uint32_t>(parse_integer("--seed", text, 0, 0xffffffffLL));
           })
      .group(run_group);
  command
      .add_flag("--quiet", "print warnings and errors only",
                [&] { options.verbosity = Verbosity::quiet; })
      .group(run_group);
}

Option add_file(Options& command, const std::string& option,
                std::optional<std::filesystem::path>& file, const std::string& description) {
  return command.add(option, "FILE", description, [&](const std::string& text) { file = text; });
}

void check_pass_one_options(const Options& command, const RunSettings& settings) {
  if (settings.elements && settings.element_size) {
    throw UsageError("--elements",
                     "does not go with --element-size, which says how many there are");
  }
  const bool by_cubes = settings.form_factors == FormFactorMethod::hemicube;
  if (by_cubes && command.given("--rays")) {
    throw UsageError("--rays", "has no effect with --form-factors hemicube: choose "
                               "--hemicube-resolution");
  }
  if (!by_cubes && command.given("--hemicube-resolution")) {
    throw UsageError("--hemicube-resolution", "has no effect without --form-factors hemicube");
  }
  if (settings.steps == 0) { // `view` alone takes that
    throw UsageError("--steps", fmt::format("'0' is not a whole number from 1 to {}", max_steps));
  }
  if (settings.steps && settings.solver != SolverMethod::progressive) {
    throw UsageError("--steps", "has no effect without --solver progressive");
  }
  if (settings.link_error && mesh_cut(settings) == MeshCut::uniform) {
    throw UsageError("--link-error", "has no effect without --mesh hierarchical");
  }
  if (mesh_cut(settings) == MeshCut::hierarchical &&
      settings.form_factors != FormFactorMethod::rays) {
    throw UsageError("--form-factors", "only 'rays' goes with --mesh hierarchical");
  }
  if (settings.steps && mesh_cut(settings) == MeshCut::hierarchical) {
    throw UsageError("--steps", "has no effect with --mesh hierarchical: its few nodes are solved at once");
  }
  if (settings.bends && settings.interpolation == Interpolation::average) {
    throw UsageError("--bends", "looks at what is gathered: it does not go with "
                                "--interpolation average");
  }
}

void refuse_pass_one_options(const Options& command, const std::string& reason) {
  constexpr std::array options{
      "--element-size", "--elements",    "--form-factors", "--rays",       "--hemicube-resolution",
      "--solver",       "--tolerance",   "--steps",        "--link-error", "--interpolation",
      "--adaptive",     "--no-adaptive", "--bends",        "--mesh"};
  for (const char* option : options) {
    if (command.given(option)) {
      throw UsageError(option, reason);
    }
  }
}

void add_solve_options(Options& command, CommonOptions& options) {
  add_quality(command, options);
  add_state_options(command, options);
  add_light_options(command, options);
  add_mesh_options(command, options);
  add_pass_one_options(command, options);
  add_run_options(command, options);
}

} // namespace meninas
