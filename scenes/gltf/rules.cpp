// The table of what the loader reads from a glTF file:
// which properties, of which type, pointing where.
#include "scenes/gltf/rules.h"

namespace meninas::gltf {

namespace rule_table { // short names, for the table alone

using enum Kind;
using enum Presence;

constexpr Rule name_rule{.name = "name", .kind = text};

constexpr Rule texture_transform[] = {
    {.name = "offset", .kind = numbers, .length = 2},
    {.name = "rotation", .kind = number},
    {.name = "scale", .kind = numbers, .length = 2},
    {.name = "texCoord", .kind = size},
};
constexpr Rule texture_extensions[] = {
    {.name = "KHR_texture_transform", .kind = object, .fields = texture_transform}};
constexpr Rule texture_use[] = {
    {.name = "index", .kind = index, .presence = required, .target = "textures"},
    {.name = "texCoord", .kind = size},
    {.name = "extensions", .kind = object, .fields = texture_extensions},
};

constexpr Rule normal_texture[] = {
    {.name = "index", .kind = index, .presence = required, .target = "textures"},
    {.name = "texCoord", .kind = size},
    {.name = "scale", .kind = number},
    {.name = "extensions", .kind = object, .fields = texture_extensions},
};

constexpr Rule metallic_roughness[] = {
    {.name = "baseColorFactor", .kind = numbers, .length = 4},
    {.name = "metallicFactor", .kind = number},
    {.name = "roughnessFactor", .kind = number},
    {.name = "baseColorTexture", .kind = object, .fields = texture_use},
    {.name = "metallicRoughnessTexture", .kind = object, .fields = texture_use},
};
constexpr Rule clear_coat[] = {
    {.name = "clearcoatFactor", .kind = number},
    {.name = "clearcoatTexture", .kind = object, .fields = texture_use},
    {.name = "clearcoatRoughnessFactor", .kind = number},
    {.name = "clearcoatRoughnessTexture", .kind = object, .fields = texture_use},
};
constexpr Rule sheen[] = {
    {.name = "sheenColorFactor", .kind = numbers, .length = 3},
    {.name = "sheenColorTexture", .kind = object, .fields = texture_use},
    {.name = "sheenRoughnessFactor", .kind = number},
    {.name = "sheenRoughnessTexture", .kind = object, .fields = texture_use},
};
constexpr Rule diffuse_transmission[] = {
    {.name = "diffuseTransmissionFactor", .kind = number},
    {.name = "diffuseTransmissionTexture", .kind = object, .fields = texture_use},
    {.name = "diffuseTransmissionColorFactor", .kind = numbers, .length = 3},
    {.name = "diffuseTransmissionColorTexture", .kind = object, .fields = texture_use},
};
constexpr Rule iridescence[] = {
    {.name = "iridescenceFactor", .kind = number},
    {.name = "iridescenceIor", .kind = number},
    {.name = "iridescenceThicknessMinimum", .kind = number},
    {.name = "iridescenceThicknessMaximum", .kind = number},
    {.name = "iridescenceTexture", .kind = object, .fields = texture_use},
    {.name = "iridescenceThicknessTexture", .kind = object, .fields = texture_use},
};
constexpr Rule anisotropy[] = {
    {.name = "anisotropyStrength", .kind = number},
    {.name = "anisotropyRotation", .kind = number},
    {.name = "anisotropyTexture", .kind = object, .fields = texture_use},
};
constexpr Rule dispersion[] = {{.name = "dispersion", .kind = number}};
constexpr Rule emissive_strength[] = {{.name = "emissiveStrength", .kind = number}};
constexpr Rule ior[] = {{.name = "ior", .kind = number}};
constexpr Rule specular[] = {
    {.name = "specularFactor", .kind = number},
    {.name = "specularTexture", .kind = object, .fields = texture_use},
    {.name = "specularColorFactor", .kind = numbers, .length = 3},
    {.name = "specularColorTexture", .kind = object, .fields = texture_use},
};
constexpr Rule transmission[] = {
    {.name = "transmissionFactor", .kind = number},
    {.name = "transmissionTexture", .kind = object, .fields = texture_use},
};
constexpr Rule volume[] = {
    {.name = "thicknessFactor", .kind = number},
    {.name = "thicknessTexture", .kind = object, .fields = texture_use},
    {.name = "attenuationDistance", .kind = number},
    {.name = "attenuationColor", .kind = numbers, .length = 3},
};
constexpr Rule specular_glossiness[] = {
    {.name = "diffuseFactor", .kind = numbers, .length = 4},
    {.name = "specularFactor", .kind = numbers, .length = 3},
    {.name = "glossinessFactor", .kind = number},
    {.name = "diffuseTexture", .kind = object, .fields = texture_use},
};
constexpr Rule material_extensions[] = {
    {.name = "KHR_materials_clearcoat", .kind = object, .fields = clear_coat},
    {.name = "KHR_materials_pbrSpecularGlossiness", .kind = object, .fields = specular_glossiness},
    {.name = "KHR_materials_anisotropy", .kind = object, .fields = anisotropy},
    {.name = "KHR_materials_diffuse_transmission", .kind = object, .fields = diffuse_transmission},
    {.name = "KHR_materials_dispersion", .kind = object, .fields = dispersion},
    {.name = "KHR_materials_emissive_strength", .kind = object, .fields = emissive_strength},
    {.name = "KHR_materials_iridescence", .kind = object, .fields = iridescence},
    {.name = "KHR_materials_sheen", .kind = object, .fields = sheen},
    {.name = "KHR_materials_ior", .kind = object, .fields = ior},
    {.name = "KHR_materials_specular", .kind = object, .fields = specular},
    {.name = "KHR_materials_transmission", .kind = object, .fields = transmission},
    {.name = "KHR_materials_unlit", .kind = object},
    {.name = "KHR_materials_volume", .kind = object, .fields = volume},
};
constexpr Rule material[] = {
    name_rule,
    {.name = "pbrMetallicRoughness", .kind = object, .fields = metallic_roughness},
    {.name = "emissiveFactor", .kind = numbers, .length = 3},
    {.name = "emissiveTexture", .kind = object, .fields = texture_use},
    {.name = "normalTexture", .kind = object, .fields = normal_texture},
    {.name = "alphaMode", .kind = text},
    {.name = "alphaCutoff", .kind = number},
    {.name = "doubleSided", .kind = boolean},
    {.name = "extensions", .kind = object, .fields = material_extensions},
};

constexpr Rule fallback[] = {{.name = "fallback", .kind = boolean}};
constexpr Rule buffer_extensions[] = {
    {.name = "EXT_meshopt_compression", .kind = object, .fields = fallback},
    {.name = "KHR_meshopt_compression", .kind = object, .fields = fallback},
};
constexpr Rule buffer[] = {
    {.name = "uri", .kind = text},
    {.name = "byteLength", .kind = size, .presence = required},
    {.name = "extensions", .kind = object, .fields = buffer_extensions},
};
constexpr Rule meshopt[] = {
    {.name = "buffer", .kind = index, .presence = required, .target = "buffers"},
    {.name = "byteOffset", .kind = size},
    {.name = "byteLength", .kind = size, .presence = required},
    {.name = "byteStride", .kind = size, .presence = required},
    {.name = "count", .kind = size, .presence = required},
    {.name = "mode", .kind = text, .presence = required},
    {.name = "filter", .kind = text},
};
constexpr Rule view_extensions[] = {
    {.name = "EXT_meshopt_compression", .kind = object, .fields = meshopt},
    {.name = "KHR_meshopt_compression", .kind = object, .fields = meshopt},
};
constexpr Rule buffer_view[] = {
    {.name = "buffer", .kind = index, .presence = required, .target = "buffers"},
    {.name = "byteOffset", .kind = size},
    {.name = "byteLength", .kind = size, .presence = required},
    {.name = "byteStride", .kind = size},
    {.name = "extensions", .kind = object, .fields = view_extensions},
};
constexpr Rule sparse_indices[] = {
    {.name = "bufferView", .kind = index, .presence = required, .target = "bufferViews"},
    {.name = "byteOffset", .kind = size},
    {.name = "componentType", .kind = size, .presence = required},
};
constexpr Rule sparse_values[] = {
    {.name = "bufferView", .kind = index, .presence = required, .target = "bufferViews"},
    {.name = "byteOffset", .kind = size},
};
constexpr Rule sparse[] = {
    {.name = "count", .kind = size, .presence = required},
    {.name = "indices", .kind = object, .presence = required, .fields = sparse_indices},
    {.name = "values", .kind = object, .presence = required, .fields = sparse_values},
};
constexpr Rule accessor[] = {
    {.name = "bufferView", .kind = index, .target = "bufferViews"},
    {.name = "byteOffset", .kind = size},
    {.name = "componentType", .kind = size, .presence = required},
    {.name = "normalized", .kind = boolean},
    {.name = "count", .kind = size, .presence = required},
    {.name = "type", .kind = text, .presence = required},
    {.name = "sparse", .kind = object, .fields = sparse},
};

constexpr Rule image[] = {
    name_rule,
    {.name = "uri", .kind = text},
    {.name = "bufferView", .kind = index, .target = "bufferViews"},
};
constexpr Rule sampler[] = {{.name = "wrapS", .kind = size}, {.name = "wrapT", .kind = size}};
constexpr Rule texture_source[] = {{.name = "source", .kind = index, .target = "images"}};
constexpr Rule texture_formats[] = {
    {.name = "EXT_texture_webp", .kind = object, .fields = texture_source}};
constexpr Rule texture[] = {
    name_rule,
    {.name = "sampler", .kind = index, .target = "samplers"},
    {.name = "source", .kind = index, .target = "images"},
    {.name = "extensions", .kind = object, .fields = texture_formats},
};

constexpr Rule draco[] = {
    {.name = "bufferView", .kind = index, .presence = required, .target = "bufferViews"},
    {.name = "attributes", .kind = sizes, .presence = required}, // Draco's own numbers
};
constexpr Rule variant_mapping[] = {
    {.name = "material", .kind = index, .presence = required, .target = "materials"},
    {.name = "variants", .kind = indices, .presence = required, .target = "variants"},
};
constexpr Rule variant_mappings[] = {
    {.name = "mappings", .kind = objects, .presence = required, .fields = variant_mapping}};
constexpr Rule primitive_extensions[] = {
    {.name = "KHR_draco_mesh_compression", .kind = object, .fields = draco},
    {.name = "KHR_materials_variants", .kind = object, .fields = variant_mappings}};
constexpr Rule primitive[] = {
    {.name = "attributes", .kind = attributes, .presence = required, .target = "accessors"},
    {.name = "indices", .kind = index, .target = "accessors"},
    {.name = "material", .kind = index, .target = "materials"},
    {.name = "mode", .kind = size},
    {.name = "targets", .kind = attribute_sets, .target = "accessors"},
    {.name = "extensions", .kind = object, .fields = primitive_extensions},
};
constexpr Rule mesh[] = {
    name_rule,
    {.name = "primitives", .kind = objects, .presence = required, .fields = primitive},
    {.name = "weights", .kind = numbers},
};
constexpr Rule skin[] = {
    name_rule,
    {.name = "joints", .kind = indices, .presence = required, .target = "nodes"},
    {.name = "inverseBindMatrices", .kind = index, .target = "accessors"},
};

constexpr Rule node_light[] = {
    {.name = "light", .kind = index, .presence = required, .target = "lights"}};
constexpr Rule node_luminaire[] = {
    {.name = "light", .kind = index, .presence = required, .target = "iesLights"},
    {.name = "multiplier", .kind = number},
    {.name = "color", .kind = numbers, .length = 3},
};
constexpr Rule node_area_light[] = {
    {.name = "light", .kind = index, .presence = required, .target = "areaLights"}};
constexpr Rule instancing[] = {
    {.name = "attributes", .kind = attributes, .presence = required, .target = "accessors"}};
constexpr Rule visibility[] = {{.name = "visible", .kind = boolean}};
constexpr Rule levels_of_detail[] = {{.name = "ids", .kind = indices, .target = "nodes"}};
constexpr Rule node_extensions[] = {
    {.name = "EXT_lights_area", .kind = object, .fields = node_area_light},
    {.name = "EXT_lights_ies", .kind = object, .fields = node_luminaire},
    {.name = "KHR_lights_punctual", .kind = object, .fields = node_light},
    {.name = "EXT_mesh_gpu_instancing", .kind = object, .fields = instancing},
    {.name = "KHR_node_visibility", .kind = object, .fields = visibility},
    {.name = "MSFT_lod", .kind = object, .fields = levels_of_detail},
};
constexpr Rule node[] = {
    name_rule,
    {.name = "children", .kind = indices, .target = "nodes"},
    {.name = "mesh", .kind = index, .target = "meshes"},
    {.name = "camera", .kind = index, .target = "cameras"},
    {.name = "skin", .kind = index, .target = "skins"},
    {.name = "matrix", .kind = numbers, .length = 16},
    {.name = "translation", .kind = numbers, .length = 3},
    {.name = "rotation", .kind = numbers, .length = 4},
    {.name = "scale", .kind = numbers, .length = 3},
    {.name = "weights", .kind = numbers},
    {.name = "extensions", .kind = object, .fields = node_extensions},
};
constexpr Rule scene_sky[] = {
    {.name = "light", .kind = index, .presence = required, .target = "imageBasedLights"}};
constexpr Rule scene_extensions[] = {
    {.name = "EXT_lights_image_based", .kind = object, .fields = scene_sky}};
constexpr Rule scene[] = {
    name_rule,
    {.name = "nodes", .kind = indices, .target = "nodes"},
    {.name = "extensions", .kind = object, .fields = scene_extensions},
};

constexpr Rule perspective[] = {
    {.name = "yfov", .kind = number, .presence = required},
    {.name = "aspectRatio", .kind = number},
    {.name = "znear", .kind = number},
};
constexpr Rule orthographic[] = {
    {.name = "xmag", .kind = number, .presence = required},
    {.name = "ymag", .kind = number, .presence = required},
    {.name = "znear", .kind = number},
};
constexpr Rule camera[] = {
    name_rule,
    {.name = "type", .kind = text, .presence = required},
    {.name = "perspective", .kind = object, .fields = perspective},
    {.name = "orthographic", .kind = object, .fields = orthographic},
};

constexpr Rule spot[] = {{.name = "innerConeAngle", .kind = number},
                         {.name = "outerConeAngle", .kind = number}};
constexpr Rule light[] = {
    name_rule,
    {.name = "type", .kind = text, .presence = required},
    {.name = "color", .kind = numbers, .length = 3},
    {.name = "intensity", .kind = number},
    {.name = "range", .kind = number},
    {.name = "spot", .kind = object, .fields = spot},
};
constexpr Rule lights[] = {
    {.name = "lights", .kind = objects, .presence = required, .fields = light}};
constexpr Rule rectangle[] = {{.name = "aspect", .kind = number}};
constexpr Rule area_light[] = {
    name_rule,
    {.name = "type", .kind = text},
    {.name = "color", .kind = numbers, .length = 3},
    {.name = "intensity", .kind = number},
    {.name = "size", .kind = number},
    {.name = "rect", .kind = object, .fields = rectangle},
};
constexpr Rule area_lights[] = {
    {.name = "lights", .kind = objects, .presence = required, .fields = area_light}};
constexpr Rule variant[] = {{.name = "name", .kind = text, .presence = required}};
constexpr Rule variants[] = {
    {.name = "variants", .kind = objects, .presence = required, .fields = variant}};
constexpr Rule image_based_light[] = {
    name_rule,
    {.name = "intensity", .kind = number},
    {.name = "rotation", .kind = numbers, .length = 4},
};
constexpr Rule image_based_lights[] = {
    {.name = "lights", .kind = objects, .presence = required, .fields = image_based_light}};
constexpr Rule ies_light[] = {
    name_rule,
    {.name = "uri", .kind = text},
    {.name = "bufferView", .kind = index, .target = "bufferViews"},
};
constexpr Rule ies_lights[] = {
    {.name = "lights", .kind = objects, .presence = required, .fields = ies_light}};
constexpr Rule root_extensions[] = {
    {.name = "EXT_lights_area", .kind = object, .fields = area_lights},
    {.name = "EXT_lights_ies", .kind = object, .fields = ies_lights},
    {.name = "EXT_lights_image_based", .kind = object, .fields = image_based_lights},
    {.name = "KHR_lights_punctual", .kind = object, .fields = lights},
    {.name = "KHR_materials_variants", .kind = object, .fields = variants},
};

// Samplers belong to their animation: state/animation.cpp checks their indices, and what is absent.
constexpr Rule channel_target[] = {
    {.name = "node", .kind = index, .target = "nodes"},
    {.name = "path", .kind = text},
};
constexpr Rule channel[] = {
    {.name = "sampler", .kind = size},
    {.name = "target", .kind = object, .fields = channel_target},
};
constexpr Rule key_sampler[] = {
    {.name = "input", .kind = index, .target = "accessors"},
    {.name = "output", .kind = index, .target = "accessors"},
    {.name = "interpolation", .kind = text},
};
constexpr Rule animation[] = {
    name_rule,
    {.name = "channels", .kind = objects, .fields = channel},
    {.name = "samplers", .kind = objects, .fields = key_sampler},
};

constexpr Rule root[] = {
    {.name = "extensionsUsed", .kind = texts},
    {.name = "extensionsRequired", .kind = texts},
    {.name = "extensions", .kind = object, .fields = root_extensions},
    {.name = "buffers", .kind = objects, .fields = buffer},
    {.name = "bufferViews", .kind = objects, .fields = buffer_view},
    {.name = "accessors", .kind = objects, .fields = accessor},
    {.name = "images", .kind = objects, .fields = image},
    {.name = "samplers", .kind = objects, .fields = sampler},
    {.name = "textures", .kind = objects, .fields = texture},
    {.name = "materials", .kind = objects, .fields = material},
    {.name = "meshes", .kind = objects, .fields = mesh},
    {.name = "cameras", .kind = objects, .fields = camera},
    {.name = "skins", .kind = objects, .fields = skin},
    {.name = "animations", .kind = objects, .fields = animation},
    {.name = "nodes", .kind = objects, .fields = node},
    {.name = "scenes", .kind = objects, .fields = scene},
    {.name = "scene", .kind = index, .target = "scenes"},
};

} // namespace rule_table

std::span<const Rule> root_rules() { return rule_table::root; }

} // namespace meninas::gltf
