#include "scenes/gltf/state/variants.h"

#include "scenes/names.h"

#include <algorithm>

namespace meninas::gltf {

std::vector<std::string> variant_names(const Json& root) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count_of(root, "variants"); ++k)
    names.push_back(name_of(element(root, "variants", k)));
  return names;
}

static void choose_material(Json& primitive, std::size_t variant) {
  const auto* mappings = find(primitive, {"extensions", "KHR_materials_variants", "mappings"});
  if (!mappings)
    return;
  std::optional<std::size_t> material;
  for (const auto& mapping : *mappings)
    for (const auto& value : mapping["variants"])
      if (!material && size_value(value) == variant)
        material = index_at(mapping, "material");
  if (material)
    primitive["material"] = *material;
}

void choose_variant(Document& document, const std::string& name) {
  const auto names = variant_names(document.root);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw UsageError(document.file, unknown_name("variant", name, names));
  const auto variant = static_cast<std::size_t>(found - names.begin());
  for (std::size_t mesh = 0; mesh < count_of(document.root, "meshes"); ++mesh)
    for (auto& primitive : document.root["meshes"][mesh]["primitives"])
      choose_material(primitive, variant);
}

} // namespace meninas::gltf
