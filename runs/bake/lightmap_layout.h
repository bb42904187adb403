// The layout of a lightmap: the number of texels of each chart, and their places.
//
// A chart of n_a x n_b intervals has (n_a + 1) x (n_b + 1) texels whose centres are at (i / n_a, j / n_b):
// the first and the last on its edges, so that what bilinear filtering shows between them is
// interpolated between values of the chart alone. Around them is a gutter of one texel. With
//
//   n = ceil(roots 2^min(level, D))       (D < 0: ceil(roots / 2^-D))
//
// texels are where the vertices of the mesh are, and filtering is the interpolation of the field, as long as
// D is not less than the level of any cell. Charts that share an edge of a surface have the same
// intervals along it. D is the largest for which all charts fit.
//
// Faces shorter than half a texel, which is as long as an element's root divided by 2^D, have one texel
// without a gutter, their mean: their corners are all at its centre. They have it only where D < 0.
#pragma once

#include "runs/bake/charts.h"

#include <string>
#include <vector>

namespace meninas {

struct ChartTexels {
  glm::ivec2 first{0};     ///< the texel of (0, 0)
  glm::ivec2 intervals{0}; ///< 0: one texel
};

struct LightmapLayout {
  int width = 0, height = 0;
  glm::ivec2 dark{0}; ///< a texel for what receives no light
  std::vector<ChartTexels> charts;
  int detail = 0;      ///< D
  int full_detail = 0; ///< at which the map is as fine as the mesh
  std::size_t single = 0; ///< charts of one texel
};

inline constexpr int lightmap_gutter = 1;

/// In a map of at most `size` texels a side, the smallest power of two that takes all detail, if there is one.
/// `root_size`: of the mesh, metres. Throws UsageError where not even a texel for each face fits.
LightmapLayout lay_out(const std::vector<Chart>& charts, double root_size, int size);

/// Texture coordinates of a point of a chart.
glm::vec2 texcoord_of(const LightmapLayout& layout, const ChartPoint& point);

} // namespace meninas
