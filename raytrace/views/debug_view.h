// Pictures for those who debug a scene: what the middle of each pixel comes to,
// followed through ideal mirrors, as a number and as a colour.
//
//   elements      the elements, in colours that tell them apart; the number is their index counted from 1
//   irradiance    H of the field of pass one, luminance, W/m^2
//   closure       abs(1 - (landed + escaped + black + cut)), what the element's row of form factors lacks
//   mirror-depth  how many mirrors the eye looks by way of
//
// Numbers other than those of elements are shown in magma from 0 to a top
// that goes with the picture. What has no number is black, and 0.
#pragma once

#include "image/channel.h"
#include "raytrace/render.h"

#include <span>

namespace meninas {

enum class DebugView { elements, irradiance, closure, mirror_depth };
inline constexpr std::array debug_views{DebugView::elements, DebugView::irradiance,
                                        DebugView::closure, DebugView::mirror_depth};
/// "mirror-depth"
std::string_view name_of(DebugView view);

struct PaintedView {
  Image colours; ///< linear, to be shown without exposure
  Channel values;
  double top = 0.0; ///< the value of the brightest colour
};

/// `rows` by the elements of `light`, for `closure` alone.
PaintedView paint_view(DebugView view, const IrradianceField& field,
                       std::span<const RowClosure> rows, const Camera& camera,
                       const RenderSettings& settings);

} // namespace meninas
