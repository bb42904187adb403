// Pass two: the picture. Camera rays meet the diffuse field or a mirror;
// mirrors are followed in chains until the path lands on the field,
// escapes, or its throughput falls below the visible threshold.
//
//   L(pixel) = mean over samples of  prod_k rho_s(k) (L_e + rho_d H / pi)   at the landing point
//
// Samples are stratified in the pixel, or where its filter is (pixel_filter.h),
// and seeded by hash(pixel, seed); tiles run in parallel and each writes its own pixels.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "raytrace/render_settings.h"
#include "scenes/progress.h"

namespace meninas {

Rendering render(const IrradianceField& field, const Camera& camera,
                 const RenderSettings& settings, const Progress& progress = {});

/// The same picture as the sum of nine layers, each traced for itself: `emission`, `diffuse.direct`
/// and `diffuse.mirrored` (light whose last leg to the surface was straight, or by way of mirrors),
/// seen straight, in one mirror (`.mirror`) and by way of several (`.mirrors`).
/// To the eye a mirror is also what reflects by a lobe, gloss, coats and glass;
/// to a surface ideal metals and glass alone, whose worlds pass one knows, while it spreads what
/// gloss and coats reflect. The four transport mechanisms: diffuse to diffuse is `diffuse.direct`,
/// specular to diffuse `diffuse.mirrored`, diffuse to specular what `.mirror` shows,
/// specular to specular what `.mirrors` shows. The field must know its mirrored part.
Rendering render_layers(const IrradianceField& field, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress = {});

} // namespace meninas
