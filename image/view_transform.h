// View transforms: from exposed scene light to what a display of limited brightness shows.
//
// Both arguments and results are linear, with Rec.709 primaries; results are in [0, 1].
//
//   srgb      what is beyond white is clipped, channel by channel: hues shift in bright lamps
//   neutral   the PBR Neutral Tone Mapper of Khronos (2024): colours up to 0.8 are shown as they
//             are, but for the 4 % that a dielectric reflects from everywhere; above, the brightest
//             channel p is compressed to 1 - d^2 / (p + d - 0.76), d = 0.24, and the colour pales
//             towards it
//   agx       AgX (Sobotka 2022) with Rec.2020 primaries as Blender has it, its sigmoid by a
//             polynomial of the sixth degree (Wrensch 2023; mean square error 4e-6), as Filament
//             and three.js show it
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <string_view>

namespace meninas {

enum class ViewTransform { neutral, agx, srgb };
inline constexpr std::array view_transforms{ViewTransform::neutral, ViewTransform::agx,
                                            ViewTransform::srgb};

/// As users call it, and as the file says it.
std::string_view name_of(ViewTransform transform);
std::string_view title_of(ViewTransform transform);

/// No component may be NaN; negative ones count as 0.
glm::dvec3 displayed(ViewTransform transform, const glm::dvec3& exposed);

} // namespace meninas
