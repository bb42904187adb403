// Lacquer over a material (KHR_materials_clearcoat), as far as there is one layer to show it with.
//
// A dielectric has a coat of its own (material.h), and lacquer has the same index of refraction,
// 1.5. Over matt paint the lacquer's reflection is the one that is seen: it takes the place of the
// paint's own, factor by factor, and is round. Metals under lacquer have two reflections; they keep their own.
#pragma once

#include "scenes/material.h"

#include <string>

namespace meninas {

/// Puts Material::clear_coat in the place of the material's own coat where that is duller, and
/// forgets it. The textures of the coat and of metal and roughness are to be factors by then.
/// Returns what the user is to be told about such materials; nothing where there is no lacquer.
std::string settle_clear_coat(Material& material);

} // namespace meninas
