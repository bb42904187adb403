// The table of what the loader reads from a glTF file: which properties, of which type, pointing where.
#include "scenes/gltf_document.h"

#include <fmt/format.h>

#include <cmath>

namespace meninas::gltf {

namespace {

enum class Kind {
  size,
  index,
  indices,
  attributes,
  number,
  numbers,
  text,
  texts,
  boolean,
  object,
  objects
};
enum class Presence { optional, required };
using enum Kind;
using enum Presence;

struct Rule {
  std::string_view name;
  Kind kind;
  Presence presence = optional;
  std::string_view target = {};      ///< the array that indices point into
  std::size_t length = 0;            ///< of an array of numbers
  std::span<const Rule> fields = {}; ///< of an object, or of each object of an array
};

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

constexpr Rule metallic_roughness[] = {
    {.name = "baseColorFactor", .kind = numbers, .length = 4},
    {.name = "metallicFactor", .kind = number},
    {.name = "roughnessFactor", .kind = number},
    {.name = "baseColorTexture", .kind = object, .fields = texture_use},
    {.name = "metallicRoughnessTexture", .kind = object, .fields = texture_use},
};
constexpr Rule emissive_strength[] = {{.name = "emissiveStrength", .kind = number}};
constexpr Rule ior[] = {{.name = "ior", .kind = number}};
constexpr Rule specular[] = {
    {.name = "specularFactor", .kind = number},
    {.name = "specularColorFactor", .kind = numbers, .length = 3},
};
constexpr Rule transmission[] = {{.name = "transmissionFactor", .kind = number}};
constexpr Rule material_extensions[] = {
    {.name = "KHR_materials_emissive_strength", .kind = object, .fields = emissive_strength},
    {.name = "KHR_materials_ior", .kind = object, .fields = ior},
    {.name = "KHR_materials_specular", .kind = object, .fields = specular},
    {.name = "KHR_materials_transmission", .kind = object, .fields = transmission},
    {.name = "KHR_materials_unlit", .kind = object},
};
constexpr Rule material[] = {
    name_rule,
    {.name = "pbrMetallicRoughness", .kind = object, .fields = metallic_roughness},
    {.name = "emissiveFactor", .kind = numbers, .length = 3},
    {.name = "emissiveTexture", .kind = object, .fields = texture_use},
    {.name = "alphaMode", .kind = text},
    {.name = "alphaCutoff", .kind = number},
    {.name = "doubleSided", .kind = boolean},
    {.name = "extensions", .kind = object, .fields = material_extensions},
};

constexpr Rule buffer[] = {
    {.name = "uri", .kind = text},
    {.name = "byteLength", .kind = size, .presence = required},
};
constexpr Rule buffer_view[] = {
    {.name = "buffer", .kind = index, .presence = required, .target = "buffers"},
    {.name = "byteOffset", .kind = size},
    {.name = "byteLength", .kind = size, .presence = required},
    {.name = "byteStride", .kind = size},
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
constexpr Rule texture[] = {
    name_rule,
    {.name = "sampler", .kind = index, .target = "samplers"},
    {.name = "source", .kind = index, .target = "images"},
};

constexpr Rule primitive[] = {
    {.name = "attributes", .kind = attributes, .presence = required, .target = "accessors"},
    {.name = "indices", .kind = index, .target = "accessors"},
    {.name = "material", .kind = index, .target = "materials"},
    {.name = "mode", .kind = size},
    {.name = "targets", .kind = objects},
    {.name = "extensions", .kind = object},
};
constexpr Rule mesh[] = {
    name_rule,
    {.name = "primitives", .kind = objects, .presence = required, .fields = primitive},
};

constexpr Rule node_light[] = {
    {.name = "light", .kind = index, .presence = required, .target = "lights"}};
constexpr Rule node_extensions[] = {
    {.name = "KHR_lights_punctual", .kind = object, .fields = node_light}};
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
    {.name = "extensions", .kind = object, .fields = node_extensions},
};
constexpr Rule scene[] = {name_rule, {.name = "nodes", .kind = indices, .target = "nodes"}};

constexpr Rule perspective[] = {
    {.name = "yfov", .kind = number, .presence = required},
    {.name = "aspectRatio", .kind = number},
};
constexpr Rule orthographic[] = {
    {.name = "xmag", .kind = number, .presence = required},
    {.name = "ymag", .kind = number, .presence = required},
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
constexpr Rule root_extensions[] = {
    {.name = "KHR_lights_punctual", .kind = object, .fields = lights}};

constexpr Rule named[] = {name_rule};

constexpr Rule root_rules[] = {
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
    {.name = "skins", .kind = objects, .fields = named},
    {.name = "animations", .kind = objects, .fields = named},
    {.name = "nodes", .kind = objects, .fields = node},
    {.name = "scenes", .kind = objects, .fields = scene},
    {.name = "scene", .kind = index, .target = "scenes"},
};

/// Where the check stands: a chain from the value back to the root.
struct Place {
  const Place* parent = nullptr;
  std::string_view key;
  std::optional<std::size_t> element;
  const Json* value = nullptr;
};

std::string path_of(const Place& place) {
  auto path = place.parent ? path_of(*place.parent) : std::string();
  if (!path.empty() && !place.key.empty())
    path += ".";
  path += place.key;
  return place.element ? fmt::format("{}[{}]", path, *place.element) : path;
}

std::string where(const Place& place) {
  // The name that helps is that of the outermost named object: the node, mesh or material.
  std::string name;
  for (const auto* at = &place; at; at = at->parent)
    if (at->value && at->element && !name_of(*at->value).empty())
      name = name_of(*at->value);
  const auto path = path_of(place);
  return name.empty() ? path : fmt::format("{} '{}'", path, name);
}

std::string what_it_is(const Json& value) {
  if (value.is_number())
    return value.dump();
  return std::string(value.is_array() || value.is_object() ? "an "
                     : value.is_null()                     ? ""
                                                           : "a ") +
         value.type_name();
}

bool is_size(const Json& value) {
  if (value.is_number_unsigned())
    return true;
  if (!value.is_number_float())
    return false;
  const auto number = value.get<double>();
  return number >= 0.0 && number <= 9007199254740992.0 && number == std::floor(number);
}

class StructureCheck {
public:
  StructureCheck(const std::string& file, const Json& root) : file_(file), root_(root) {}

  void check_object(const Place& place, std::span<const Rule> rules) const {
    for (const auto& rule : rules) {
      const auto* value = find(*place.value, rule.name);
      if (value)
        check_value(place, rule, *value);
      else if (rule.presence == required)
        fail(place, fmt::format("has no '{}'", rule.name));
    }
  }

private:
  [[noreturn]] void fail(const Place& place, const std::string& what) const {
    throw InputError(file_, where(place), what);
  }

  void require(bool condition, const Place& place, const Rule& rule, const Json& value,
               const std::string& expected) const {
    if (!condition)
      fail(place, fmt::format("'{}' must be {}, it is {}", rule.name, expected, what_it_is(value)));
  }

  void check_index(const Place& place, std::string_view name, std::string_view target,
                   const Json& value) const {
    if (!is_size(value))
      fail(place, fmt::format("'{}' must be an index, it is {}", name, what_it_is(value)));
    const auto count = count_of(root_, target);
    if (size_value(value) >= count)
      fail(place,
           fmt::format("'{}' is index {} of {}, there are {}", name, value.dump(), target, count));
  }

  void check_value(const Place& place, const Rule& rule, const Json& value) const {
    switch (rule.kind) {
    case size:
      return require(is_size(value), place, rule, value, "a whole number of at least 0");
    case index:
      return check_index(place, rule.name, rule.target, value);
    case number:
      return require(value.is_number(), place, rule, value, "a number");
    case text:
      return require(value.is_string(), place, rule, value, "text");
    case boolean:
      return require(value.is_boolean(), place, rule, value, "true or false");
    case object:
      require(value.is_object(), place, rule, value, "an object");
      return check_object({&place, rule.name, std::nullopt, &value}, rule.fields);
    case attributes:
      require(value.is_object(), place, rule, value, "an object");
      for (const auto& [name, accessor_index] : value.items())
        check_index(place, name, rule.target, accessor_index);
      return;
    default:
      return check_array(place, rule, value);
    }
  }

  void check_array(const Place& place, const Rule& rule, const Json& value) const {
    require(value.is_array(), place, rule, value, "an array");
    if (rule.kind == numbers && value.size() != rule.length)
      fail(place, fmt::format("'{}' must have {} numbers, it has {}", rule.name, rule.length,
                              value.size()));
    for (std::size_t k = 0; k < value.size(); ++k) {
      const auto& item = value[k];
      const Rule item_rule{.name = rule.name, .kind = rule.kind};
      if (rule.kind == numbers)
        require(item.is_number(), place, item_rule, item, "an array of numbers");
      if (rule.kind == texts)
        require(item.is_string(), place, item_rule, item, "an array of text");
      if (rule.kind == indices)
        check_index(place, rule.name, rule.target, item);
      if (rule.kind != objects)
        continue;
      require(item.is_object(), place, item_rule, item, "an array of objects");
      check_object({&place, rule.name, k, &item}, rule.fields);
    }
  }

  const std::string& file_;
  const Json& root_;
};

} // namespace

void check_structure(const std::string& file, const Json& root) {
  StructureCheck(file, root).check_object({nullptr, "", std::nullopt, &root}, root_rules);
}

} // namespace meninas::gltf
