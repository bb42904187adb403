#include "scenes/gltf.h"

#include "scenes/gltf_stages.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

using namespace gltf;

static constexpr std::string_view extensions_read[] = {
    "KHR_lights_punctual",    "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_specular", "KHR_materials_transmission",      "KHR_materials_unlit",
    "KHR_mesh_quantization",  "KHR_texture_transform",
};

static bool is_read(const std::string& extension) {
  return std::ranges::find(extensions_read, extension) != std::end(extensions_read);
}

/// Extensions in use anywhere below, declared or not. The nesting was bounded when the text was parsed.
static void collect_extensions(const Json& json, std::set<std::string>& names) {
  if (!json.is_structured())
    return;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object() && key == "extras")
      continue;
    if (json.is_object() && key == "extensions" && value.is_object())
      for (const auto& extension : value.items())
        names.insert(extension.key());
    collect_extensions(value, names);
  }
}

static void check_extensions(const Document& document, Scene& scene, Findings& findings) {
  std::set<std::string> names;
  if (const auto* needed = find(document.root, "extensionsRequired")) {
    for (const auto& name : *needed)
      if (!is_read(name.get<std::string>()))
        throw InputError(
            document.file, "extensionsRequired",
            fmt::format("the file needs {}, which is not read", one_line(name.get<std::string>())));
  }
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

static void report_animations(const Document& document, Scene& scene, Findings& findings) {
  const auto count = count_of(document.root, "animations");
  for (std::size_t k = 0; k < count; ++k) {
    const auto name = name_of(element(document.root, "animations", k));
    findings.about("animations are left out, the rest pose is shown",
                   name.empty() ? fmt::format("animation{}", k) : name);
  }
  if (count > 0)
    scene.ignored.push_back("animations");
  if (count_of(document.root, "skins") > 0)
    scene.ignored.push_back("skins");
}

Scene load_gltf(const std::filesystem::path& file, const GltfSettings& settings) {
  const auto document = read_document(file, settings);
  Scene scene;
  scene.file = document.file;
  Findings findings;
  check_extensions(document, scene, findings);

  const auto nodes = place_nodes(document, findings);
  read_geometry(document, nodes, scene, findings);
  if (scene.triangles.empty())
    throw InputError(document.file, "",
                     scene.degenerate_triangles == 0
                         ? "nothing to render: no triangles in the scene"
                         : fmt::format("nothing to render: all {} triangles are without area",
                                       scene.degenerate_triangles));
  read_materials(document, scene, findings);
  read_cameras(document, nodes, scene, findings);
  read_lights(document, nodes, scene, findings);

  report_animations(document, scene, findings);
  if (scene.degenerate_triangles > 0)
    findings.say(fmt::format("triangles without area that are left out: {}",
                             scene.degenerate_triangles));
  scene.warnings = findings.lines();
  return scene;
}

} // namespace meninas
