// Pictures for those who debug a scene or plan its light: what the middle of each pixel comes to,
// followed through ideal mirrors, as a number and as a colour.
//
//   elements      the elements, in colours that tell them apart; the number is their index counted from 1
//   irradiance    H of the field of pass one, luminance, W/m^2
//   illuminance   the same in lux (scenes/photometry.h)
//   luminance     of the picture that both passes make, cd/m^2
//   closure       abs(1 - (landed + escaped + black + cut)), what the element's row of form factors lacks
//   mirror-depth  how many mirrors the eye looks by way of
//
// Numbers other than those of elements are shown in magma from 0 to a top
// that goes with the picture; those in lux and cd/m^2 with a scale and lines (image/colour_scale.h).
// Pixels without a number are black, and 0.
#pragma once

#include "image/channel.h"
#include "raytrace/render.h"

#include <span>

namespace meninas {

enum class DebugView { elements, irradiance, illuminance, luminance, closure, mirror_depth };
inline constexpr std::array debug_views{DebugView::elements,    DebugView::irradiance,
                                        DebugView::illuminance, DebugView::luminance,
                                        DebugView::closure,     DebugView::mirror_depth};
/// "mirror-depth"
std::string_view name_of(DebugView view);

struct PaintedView {
  Image colours; ///< linear, to be shown without exposure
  Channel values;
  Channel known;    ///< 0 where there is no number, else 1
  double top = 0.0; ///< the value of the brightest colour
};

/// `rows` by the elements of `light`, for `closure` alone. Not of `luminance`, which takes a picture;
/// `illuminance` is painted as irradiance, in W/m^2.
PaintedView paint_view(DebugView view, const IrradianceField& field,
                       std::span<const RowClosure> rows, const Camera& camera,
                       const RenderSettings& settings);

} // namespace meninas
