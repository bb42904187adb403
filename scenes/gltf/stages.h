// The stages of the loader after the document is read:
// nodes, geometry, materials, cameras and lights.
#pragma once

#include "scenes/gltf/document.h"

#include <glm/mat4x4.hpp>

namespace meninas::gltf {

/// A node of the chosen scene with the product of the matrices down to it.
struct PlacedNode {
  std::size_t index = 0; ///< into the file's nodes
  glm::dmat4 world{1.0};
};

/// The nodes of the chosen scene, parents before children, in the order of the file.
std::vector<PlacedNode> place_nodes(const Document& document, Findings& findings);

/// The lamp that a node says it is part of, `extras.lamp`; empty where it says none.
std::string lamp_of_node(const Document& document, std::size_t node);

/// Makes names unique: the first keeps its name, others get the first free suffix .1, .2, ...
std::vector<std::string> unique_names(const std::vector<std::string>& names);

/// Fills vertices, triangles, nodes and their error bound.
/// Materials of triangles are still indices into the file, none for a primitive without.
/// Returns, by vertex, half the step of positions that the file rounds, to integers or by Draco,
/// in metres; 0 of others.
std::vector<float> read_geometry(const Document& document, std::span<const PlacedNode> nodes,
                                 Scene& scene, Findings& findings);

/// Replaces the file's material indices by the materials that triangles use,
/// and adds these and their textures.
void read_materials(const Document& document, Scene& scene, Findings& findings);

/// Base colour, metallic, roughness and alpha from KHR_materials_pbrSpecularGlossiness.
void read_specular_glossiness(const Document& document, const Json& model, Material& material,
                              Findings& findings);

/// The coat of KHR_materials_clearcoat (clear_coat.h), which textures may leave undecided.
void read_clear_coat(const Document& document, const Json& extension, Material& material,
                     Findings& findings);

/// Sheen, iridescence, anisotropy, dispersion: what is read of them, and what is done instead.
void read_thin_layers(const Document& document, const Json& json, Material& material,
                      Findings& findings);
/// Once it is known what is blended.
void settle_thin_layers(Material& material, Findings& findings);

/// `use.texture` is the file's texture;
/// null when there is no image to be had, which is then in the findings.
std::optional<TextureUse> read_texture_use(const Document& document, const Json& owner,
                                           std::string_view key, const std::string& material,
                                           Findings& findings);

/// The sets of texture coordinates that the textures of a material ask for.
std::set<std::uint64_t> texcoord_sets(const Json& material);

/// Replaces the file's texture indices in the materials by textures of the scene,
/// one per image and wrapping.
void read_textures(const Document& document, Scene& scene, Findings& findings);

/// The bytes of one of the file's images.
Resource image_bytes(const Document& document, std::size_t index);

/// EXT_lights_image_based of the chosen scene, still encoded.
void read_image_based_light(const Document& document, Scene& scene, Findings& findings);

void read_cameras(const Document& document, std::span<const PlacedNode> nodes, Scene& scene,
                  Findings& findings);
void read_lights(const Document& document, std::span<const PlacedNode> nodes, Scene& scene,
                 Findings& findings);

/// The name of a node, or of what it shows, or `kind` and that one's index.
std::string first_name(const Document& document, std::size_t node, std::string_view array,
                       std::size_t index, std::string_view kind);

/// Reads the lights of EXT_lights_area.
void read_area_lights(const Document& document, std::span<const PlacedNode> nodes, Scene& scene,
                      Findings& findings);

/// The settings' units; else what the file's asset.extras.light_units says, which is told; else radiometric.
LightUnits light_units_of(const Document& document, Findings& findings);

/// The divisor of the file's light: K lm/W for photometric numbers, 1 for radiometric ones.
inline double light_unit(const Document& document) {
  const SceneState& state = document.settings.state;
  return state.units == LightUnits::photometric ? state.luminous_efficacy : 1.0;
}

/// The axes of a node in the world, of unit length and at right angles; none of one scaled to nothing.
std::optional<glm::dmat3> unit_frame(const glm::dmat4& world);

/// The light of a node's EXT_lights_ies, without place. Throws InputError that names the line.
PunctualLight read_luminaire(const Document& document, const Json& use, const std::string& name,
                             Findings& findings);

/// IES files in place of the lights that have them, in the lights' colours. Throws UsageError where
/// there is no light of that name, InputError that names the line.
struct LightPlace {
  Rgb colour{1.0};    ///< without its intensity
  bool aims = true;   ///< its node is not scaled to nothing
};
void put_luminaires(const Document& document, std::span<const LightPlace> places, Scene& scene,
                    Findings& findings);

} // namespace meninas::gltf
