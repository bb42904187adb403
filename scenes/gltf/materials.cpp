// Materials: factors of the metallic-roughness model and its extensions, made physical.
#include "scenes/gltf/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas::gltf {

// Above this a colour is a mistake,
// and its square leaves the range of floats the pictures are made of.
static constexpr double brightest_emission = 1e30;

static double fraction(double value, const std::string& name, Findings& findings) {
  const auto clamped = std::clamp(value, 0.0, 1.0);
  if (clamped != value)
    findings.about("materials with factors outside [0, 1] were clamped", name);
  return clamped;
}

static Rgb reflectance(const Rgb& value, const std::string& name, Findings& findings) {
  const auto clamped = glm::clamp(value, 0.0, 1.0);
  if (clamped != value)
    findings.about("reflectances were clamped to [0, 1] in materials", name);
  return clamped;
}

static std::string name_of_material(const Document& document, std::size_t index) {
  const auto name = name_of(element(document.root, "materials", index));
  return name.empty() ? fmt::format("material{}", index) : name;
}

static void read_metallic_roughness(const Document& document, const Json& json, Material& material,
                                    Findings& findings) {
  static const Json absent = Json::object();
  const auto* given = find(json, "pbrMetallicRoughness");
  const auto& model = given ? *given : absent;
  const auto& name = material.name;

  material.base_color = reflectance(vec3_or(model, "baseColorFactor", Rgb(1.0)), name, findings);
  material.roughness = fraction(number_or(model, "roughnessFactor", 1.0), name, findings);
  material.base_color_texture =
      read_texture_use(document, model, "baseColorTexture", name, findings);
  material.metallic_roughness_texture =
      read_texture_use(document, model, "metallicRoughnessTexture", name, findings);

  // glTF's default is a rough metal, which nobody means who leaves the whole model out.
  // Exporters that leave out defaults say a metal by its roughness alone.
  const bool says_metallic = model.contains("metallicFactor") ||
                             model.contains("roughnessFactor") ||
                             model.contains("metallicRoughnessTexture");
  if (!says_metallic)
    findings.about("materials without metallicFactor are read as not metallic", name);
  material.metallic =
      says_metallic ? fraction(number_or(model, "metallicFactor", 1.0), name, findings) : 0.0;

  const auto base_color = numbers_at(model, "baseColorFactor");
  material.alpha = base_color.empty() ? 1.0 : std::clamp(base_color[3], 0.0, 1.0);
}

static void read_emission(const Document& document, std::size_t index, const Json& json,
                          Material& material, Findings& findings) {
  auto strength = 1.0;
  if (const auto* extension = find(json, {"extensions", "KHR_materials_emissive_strength"}))
    strength = number_or(*extension, "emissiveStrength", 1.0);
  const auto factor = vec3_or(json, "emissiveFactor", Rgb(0.0));
  if (strength < 0.0 || glm::any(glm::lessThan(factor, Rgb(0.0))))
    findings.about("materials with negative emission are dark there", material.name);
  material.emission = glm::max(factor, Rgb(0.0)) * (std::max(strength, 0.0) / light_unit(document));
  if (!glm::all(glm::lessThanEqual(material.emission, Rgb(brightest_emission))))
    throw InputError(document.file, place(document.root, "materials", index),
                     fmt::format("its emission is over {:g} W/m^2/sr", brightest_emission));
  material.emissive_texture =
      read_texture_use(document, json, "emissiveTexture", material.name, findings);
}

static void read_coat(const Document& document, const Json& json, Material& material,
                      Findings& findings) {
  if (const auto* extension = find(json, {"extensions", "KHR_materials_ior"})) {
    material.ior = number_or(*extension, "ior", 1.5);
    // 0 stands for a coat that reflects everything; else nothing is thinner than vacuum.
    if (material.ior != 0.0 && !(material.ior >= 1.0)) {
      findings.about("indices of refraction below 1 were set to 1 in materials", material.name);
      material.ior = 1.0;
    }
  }
  if (const auto* extension = find(json, {"extensions", "KHR_materials_specular"})) {
    material.specular =
        fraction(number_or(*extension, "specularFactor", 1.0), material.name, findings);
    const auto color = vec3_or(*extension, "specularColorFactor", Rgb(1.0));
    material.specular_color = glm::clamp(color, 0.0, brightest_emission);
    if (material.specular_color != color)
      findings.about("specular colours out of range were clamped in materials", material.name);
    if (material.specular > 0.0) {
      material.specular_texture =
          read_texture_use(document, *extension, "specularTexture", material.name, findings);
      material.specular_color_texture =
          read_texture_use(document, *extension, "specularColorTexture", material.name, findings);
    }
  }
}

/// Glass is there from both sides. What a solid is full of matters where it is one.
static void read_glass(const Document& document, const Json& json, Material& material,
                       Findings& findings) {
  if (const auto* extension = find(json, {"extensions", "KHR_materials_transmission"})) {
    material.transmission =
        fraction(number_or(*extension, "transmissionFactor", 0.0), material.name, findings);
    material.transmission_texture =
        read_texture_use(document, *extension, "transmissionTexture", material.name, findings);
  }
  if (!is_glass(material)) {
    material.transmission_texture.reset(); // of nothing
    return;
  }
  material.double_sided = true;
  const auto* extension = find(json, {"extensions", "KHR_materials_volume"});
  if (!extension)
    return;
  const auto thickness = number_or(*extension, "thicknessFactor", 0.0);
  const auto distance = number_or(*extension, "attenuationDistance", material.attenuation_distance);
  const auto color = vec3_or(*extension, "attenuationColor", Rgb(1.0));
  material.thickness = std::max(thickness, 0.0);
  material.attenuation_color = glm::clamp(color, 0.0, 1.0);
  if (distance > 0.0)
    material.attenuation_distance = distance;
  if (thickness < 0.0 || !(distance > 0.0) || material.attenuation_color != color)
    findings.about("volumes with factors out of range were clamped in materials", material.name);
  // Of a pane it is a texture of nothing, and without absorption it says nothing.
  if (is_solid_glass(material) && std::isfinite(material.attenuation_distance))
    material.thickness_texture =
        read_texture_use(document, *extension, "thicknessTexture", material.name, findings);
}

/// Of the model the base colour and alpha remain, to others a matt surface of that colour.
static void read_unlit(Material& material) {
  Material colour;
  colour.name = material.name;
  colour.unlit = true;
  colour.double_sided = material.double_sided;
  colour.base_color = material.base_color;
  colour.base_color_texture = material.base_color_texture;
  colour.alpha = material.alpha;
  colour.alpha_mode = material.alpha_mode;
  colour.alpha_cutoff = material.alpha_cutoff;
  material = std::move(colour);
}

static void read_alpha(const Json& json, Material& material, Findings& findings) {
  const auto mode = text_or(json, "alphaMode", "OPAQUE");
  if (mode == "MASK")
    material.alpha_mode = AlphaMode::mask;
  else if (mode == "BLEND")
    material.alpha_mode = AlphaMode::blend;
  else if (mode != "OPAQUE")
    findings.about("materials with an unknown alphaMode are opaque", material.name);
  // Above 1 nothing is left of the surface.
  material.alpha_cutoff = std::max(number_or(json, "alphaCutoff", 0.5), 0.0);
}

static Material read_material(const Document& document, std::size_t index, Findings& findings) {
  const auto& json = element(document.root, "materials", index);
  Material material;
  material.name = name_of_material(document, index);
  material.double_sided = json.value("doubleSided", false);
  const auto* glossy = find(json, {"extensions", "KHR_materials_pbrSpecularGlossiness"});
  if (glossy && !json.contains("pbrMetallicRoughness"))
    read_specular_glossiness(document, *glossy, material, findings);
  else
    read_metallic_roughness(document, json, material, findings);
  read_emission(document, index, json, material, findings);
  read_coat(document, json, material, findings);
  read_glass(document, json, material, findings);
  read_alpha(json, material, findings);
  read_thin_layers(document, json, material, findings);
  if (const auto* coat = find(json, {"extensions", "KHR_materials_clearcoat"}))
    read_clear_coat(document, *coat, material, findings);
  material.normal_texture =
      read_texture_use(document, json, "normalTexture", material.name, findings);
  if (material.normal_texture)
    material.normal_scale = number_or(*find(json, "normalTexture"), "scale", 1.0);
  if (json.contains("occlusionTexture"))
    findings.about("occlusion textures are left out, occlusion is computed, in materials",
                   material.name);
  if (find(json, {"extensions", "KHR_materials_unlit"}))
    read_unlit(material);
  return material;
}

/// By MaterialId, whether vertices of its triangles are not wholly there.
static std::vector<std::uint8_t> with_clear_vertices(const Scene& scene) {
  std::vector<std::uint8_t> clear(scene.materials.size(), 0);
  for (const auto& triangle : scene.triangles)
    for (const auto vertex : triangle.vertices)
      if (attributes_of(scene, vertex).color.a < 1.0F)
        clear[index(triangle.material)] = 1;
  return clear;
}

/// Coverage becomes what a pane passes (material.h). Whether a texture leaves anything open is
/// told when it is decoded (constant_textures.h).
static void settle_blending(Material& material, bool clear_vertices, Findings& findings) {
  if (material.alpha_mode != AlphaMode::blend)
    return;
  const bool varies = material.base_color_texture || clear_vertices;
  material.alpha_mode = AlphaMode::opaque; // until it is known to be no glass
  if (is_glass(material) && (material.alpha < 1.0 || varies))
    findings.about("alpha of glass is left out in materials", material.name);
  if (is_glass(material) || (material.alpha == 1.0 && !varies))
    return;
  material.alpha_mode = AlphaMode::blend;
  material.transmission = varies ? 1.0 : 1.0 - material.alpha;
  material.emission *= material.alpha;
  // Like glass, what is not there is not there from both sides.
  if (!material.base_color_texture || clear_vertices)
    material.double_sided = true;
}

/// Surfaces of alpha 0 are not there.
static void leave_out_invisible(Scene& scene, Findings& findings) {
  const auto is_invisible = [&](const Triangle& triangle) {
    const Material& material = scene.materials[index(triangle.material)];
    return material.alpha_mode == AlphaMode::blend && material.alpha == 0.0;
  };
  for (const Triangle& triangle : scene.triangles)
    if (is_invisible(triangle))
      findings.about("surfaces of alpha 0 are left out in nodes",
                     scene.nodes[index(triangle.node)].name);
  std::erase_if(scene.triangles, is_invisible);
}

void read_materials(const Document& document, Scene& scene, Findings& findings) {
  std::map<MaterialId, MaterialId> ids; // ordered, and none comes last
  for (const auto& triangle : scene.triangles)
    ids.emplace(triangle.material, none<MaterialId>);

  for (auto& [in_file, id] : ids) {
    id = static_cast<MaterialId>(scene.materials.size());
    if (in_file != none<MaterialId>) {
      scene.materials.push_back(read_material(document, index(in_file), findings));
      continue;
    }
    Material grey;
    grey.name = "default";
    scene.materials.push_back(grey);
    for (const auto& triangle : scene.triangles)
      if (triangle.material == in_file)
        findings.about("nodes without a material are diffuse grey 0.8",
                       scene.nodes[index(triangle.node)].name);
  }
  auto last = ids.end();
  for (auto& triangle : scene.triangles) {
    // Triangles of one material come in runs.
    if (last == ids.end() || last->first != triangle.material)
      last = ids.find(triangle.material);
    triangle.material = last->second;
  }
  leave_out_invisible(scene, findings);
  read_textures(document, scene, findings);
  const std::vector<std::uint8_t> clear = with_clear_vertices(scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    settle_blending(scene.materials[m], clear[m] != 0, findings);
  for (auto& material : scene.materials)
    settle_thin_layers(material, findings);
}

} // namespace meninas::gltf
