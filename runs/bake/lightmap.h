// The texels of a lightmap.
//
//   irradiance   H, W/m^2: radiance of a diffuse surface is rho H / pi
//   shown        2^exposure L / c in [0, 1], L = (E + rho H) / pi, W/m^2/sr: what an unlit surface whose vertices have
//                the colours c shows, with the scene's textures as fine as the map
//
// Where nothing at all is received, as below what stands on a face, texels beside others take their mean.
// Texels of gutters repeat the nearest of their chart. Beyond the slanted edge of a triangle the next texels go on
// linearly, so that filtering between the four of a square that the edge cuts is linear up to it.
#pragma once

#include "image/image.h"
#include "runs/bake/lightmap_layout.h"

#include <cstddef>

namespace meninas {

struct Lightmap {
  Image irradiance;
  Image shown;           ///< empty where it is not asked for
  double exposure = 0.0; ///< stops
  double brightest = 0.0; ///< of the irradiance, W/m^2
  double factor = 1.0;   ///< W/m^2: what all but a thousandth of the lit texels are at most
};

enum class WithShown { no, yes };

/// `values`: the part of the field that is wanted.
Lightmap fill_lightmap(const IrradianceField& field, const VertexIrradiance& values,
                       const std::vector<Chart>& charts, const LightmapLayout& layout,
                       WithShown with_shown);

/// H = factor times the colour that 8 bits of sRGB decode to; brighter texels are clipped. Rounded up or down so that
/// the mean of light is kept.
std::vector<std::byte> irradiance_png(const Lightmap& map);

/// sRGB, 8 bits.
std::vector<std::byte> shown_png(const Lightmap& map);

} // namespace meninas
