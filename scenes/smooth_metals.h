// Metals that are nearly mirrors: what they throw on other surfaces has a shape.
//
// Pass one reflects evenly or ideally. Of the two, the ideal mirror comes nearer to a lobe of width alpha = roughness^2 while this is narrow
// beside what is lit. That is so for flat surfaces, whose mirror worlds are few; what curved ones throw would be found by rays alone, by chance,
// and stays even. Pass two shows the lobe in any case.
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// Beyond this roughness metals throw light evenly.
inline constexpr double smooth_metal_roughness = 0.3;
/// And where the faces of the material lie in more planes than these.
inline constexpr std::size_t most_smooth_planes = 8;

/// Sets Material::throws_as_mirror for every material: true of metals rougher than ideal mirrors, but smooth, of one reflectance and flat.
void mark_smooth_metals(Scene& scene);

} // namespace meninas
