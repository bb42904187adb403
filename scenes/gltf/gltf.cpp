#include "scenes/gltf/gltf.h"

#include "scenes/repair/glass_plates.h"
#include "scenes/gltf/stages.h"
#include "scenes/gltf/state/animation.h"
#include "scenes/gltf/state/variants.h"
#include "scenes/gltf/state/visibility.h"
#include "scenes/repair/hairline_gaps.h"
#include "scenes/repair/nearly_flat.h"
#include "scenes/materials/smooth_surfaces.h"
#include "scenes/repair/touching.h"
#include "scenes/report/light_units.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

using namespace gltf;

static constexpr std::string_view extensions_read[] = {
    "EXT_lights_area",
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "MSFT_lod",
};

static bool is_read(const std::string& extension) {
  return std::ranges::find(extensions_read, extension) != std::end(extensions_read);
}

/// What a file loses without it: the look of its materials, no more.
/// Then a picture is better than none, though the file calls it required.
static bool is_of_looks_only(const std::string& extension) {
  constexpr std::string_view prefixes[] = {"KHR_materials_", "EXT_materials_", "MSFT_materials_",
                                           "KHR_texture_",   "EXT_texture_",   "MSFT_texture_",
                                           "KHR_xmp",        "KHR_animation_", "KHR_techniques_"};
  return std::ranges::any_of(
      prefixes, [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

static void check_required(const Document& document, Findings& findings) {
  const auto* needed = find(document.root, "extensionsRequired");
  if (!needed)
    return;
  for (const auto& json : *needed) {
    const auto name = one_line(json.get<std::string>());
    if (is_read(name))
      continue;
    if (is_of_looks_only(name)) {
      findings.about("extensions that the file calls required are left out", name);
      continue;
    }
    throw InputError(document.file, "extensionsRequired",
                     fmt::format("the file needs {}, which is not read", name));
  }
}

static void check_extensions(const Document& document, Scene& scene, Findings& findings) {
  std::set<std::string> names;
  check_required(document, findings);
  if (const auto* used = find(document.root, "extensionsUsed"))
    for (const auto& name : *used)
      names.insert(name.get<std::string>());
  collect_extensions(document.root, names);
  for (const auto& name : names) {
    if (is_read(name))
      continue;
    scene.ignored.push_back(one_line(name));
    findings.about("extensions are left out", scene.ignored.back());
  }
}

/// The document as it is where and when it is asked for.
static void put_in_state(Document& document, Scene& scene, Findings& findings) {
  const SceneState& state = document.settings.state;
  scene.variants = variant_names(document.root);
  if (state.variant)
    choose_variant(document, *state.variant);
  if (state.at)
    pose_at(document, *state.at, findings);
  hide_nodes(document.root, findings);
}

static void report_animations(const Document& document, Scene& scene, Findings& findings) {
  if (document.settings.state.at)
    return;
  const auto count = count_of(document.root, "animations");
  for (std::size_t k = 0; k < count; ++k) {
    const auto name = name_of(element(document.root, "animations", k));
    findings.about("animations are left out, the rest pose is shown",
                   name.empty() ? fmt::format("animation{}", k) : name);
  }
  if (count > 0)
    scene.ignored.push_back("animations");
}

static void make_flat(Scene& scene, std::span<const float> half_steps, Findings& findings) {
  constexpr double a_float = 1e-6; // of the scene's size: what nobody is told of
  const Flattening made = flatten_nearly_flat(scene, half_steps);
  const Bounds bounds = bounds_of(scene);
  if (made.farthest > a_float * glm::distance(bounds.low, bounds.high))
    findings.say(fmt::format("surfaces that are flat but for rounding are made flat: {} (vertices "
                             "moved by at most {:.2g} m)",
                             made.surfaces, made.farthest));
}

static void put_apart(Scene& scene, Findings& findings) {
  for (const NodeId node : plates_to_panes(scene))
    findings.about("plates of glass that lie on a face count as panes in nodes",
                   scene.nodes[index(node)].name);
  for (const NodeId node : separate_touching(scene))
    findings.about(
        "glass or lamps that lie in the plane of a face are put a hair before it in nodes",
        scene.nodes[index(node)].name);
}

Scene load_gltf(const std::filesystem::path& file, const GltfSettings& settings) {
  auto content = read_whole_file(file, settings.memory_limit);
  if (!content.problem.empty())
    throw UserError(content.kind, file.string(), "", content.problem);
  return read_gltf(std::move(content.bytes), file, settings);
}

Scene read_gltf(std::vector<unsigned char> bytes, const std::filesystem::path& file,
                const GltfSettings& settings) {
  auto document = read_document(std::move(bytes), file, settings);
  Scene scene;
  scene.file = document.file;
  Findings findings;
  check_extensions(document, scene, findings);
  document.settings.state.units = light_units_of(document, findings);
  put_in_state(document, scene, findings);

  const auto nodes = place_nodes(document, findings);
  const std::vector<float> half_steps = read_geometry(document, nodes, scene, findings);
  if (scene.triangles.empty())
    throw InputError(document.file, "",
                     scene.degenerate_triangles == 0
                         ? "nothing to render: no triangles in the scene"
                         : fmt::format("nothing to render: all {} triangles are without area",
                                       scene.degenerate_triangles));
  read_materials(document, scene, findings);
  if (scene.triangles.empty())
    throw InputError(document.file, "", "nothing to render: all surfaces have alpha 0");
  make_flat(scene, half_steps, findings);
  if (const auto joints = close_hairline_gaps(scene); !joints.empty())
    findings.say(describe_joints(scene, joints));
  put_apart(scene, findings);
  mark_smooth_surfaces(scene);
  read_cameras(document, nodes, scene, findings);
  read_lights(document, nodes, scene, findings);
  read_area_lights(document, nodes, scene, findings);
  read_image_based_light(document, scene, findings);
  for (const std::string& light : settle_lights(scene))
    findings.about("lights in the plane of a face are put before it", light);
  if (const auto mixture = describe_mixed_units(scene))
    findings.say(*mixture);

  report_animations(document, scene, findings);
  if (scene.degenerate_triangles > 0)
    findings.say(
        fmt::format("triangles without area that are left out: {}", scene.degenerate_triangles));
  scene.warnings = findings.lines();
  return scene;
}

} // namespace meninas
