// The field by which pass two shows a view: as it is, or with direct light as fine as the view's pixels.
//
// The seen points are found by one ray through each corner of the pixels, followed through plane mirrors.
// Rays a pixel apart in the picture are apart, t along both, by
//
//   w = max over both neighbours of  abs((o' - o) + t (d' - d))        metres,
//
// t the way from the eye unfolded at the mirrors. Where a surface is seen at a grazing angle, elements lie between two
// such points of one patch: places on the way, one an element, are seen as well. The field is refined by these points
// only: surfaces seen by lobes or through solids of glass are as fine as their other views make them.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "raytrace/render_settings.h"
#include "scenes/camera.h"
#include "scenes/progress.h"

#include <memory>

namespace meninas {

/// The approximate number of vertices with direct light per pixel: measured 0.1 to 0.6 over the gallery.
inline constexpr double vertices_of_a_pixel = 0.3;

struct ViewLight {
  std::shared_ptr<const IrradianceField>
      field;               ///< finer than the one that was asked for; null: that one
  RenderSettings settings; ///< by which it is shown
  std::uint64_t shadow_rays = 0;
};

/// Finer where the settings ask for direct light, which then is in the field. `progress` is that of view_field().
ViewLight light_for_view(const IrradianceField& field, const Camera& camera,
                         const RenderSettings& settings, const Progress& progress = {});

} // namespace meninas
