// KHR_materials_variants: named sets of materials of one model, as of a sofa in three fabrics.
//
// Each primitive says by which material it has in which variants; in others, and without
// a choice, it has its own.
#pragma once

#include "scenes/gltf/document.h"

namespace meninas::gltf {

std::vector<std::string> variant_names(const Json& root);

/// Gives the primitives their materials of that variant.
/// Throws UsageError, with the nearest known name as a hint, when there is none of this name.
void choose_variant(Document& document, const std::string& name);

} // namespace meninas::gltf
