// What pass two shows a view by: the field as it is, or with direct light as fine as the view's pixels.
//
// Which points are seen is asked by one ray through each corner of the pixels, followed through plane mirrors.
// Rays a pixel apart in the picture are apart, t along both, by
//
//   w = max over both neighbours of  abs((o' - o) + t (d' - d))        metres,
//
// t the way from the eye unfolded at the mirrors. What lobes and solids of glass show is as fine as
// what else is seen of it.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "raytrace/render_settings.h"
#include "scenes/camera.h"
#include "scenes/progress.h"

#include <memory>

namespace meninas {

/// How many vertices with direct light there are to a pixel, about: measured 0.1 to 0.6 over the gallery.
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
