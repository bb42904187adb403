// Pictures of test scenes and how they differ.
#pragma once

#include "raytrace/two_pass.h"

namespace meninas::test {

struct Taken {
  std::shared_ptr<const PreparedScene> prepared;
  RadiositySolution solution;
};

/// Pass one, to be looked at from anywhere.
Taken lit_up(const Scene& scene, const PassOneSettings& settings);

Image picture(const Taken& scene, const Camera& camera, const RenderSettings& settings);

/// Of two pictures of one size, relative to the brightest channel of the first's pixel.
struct PictureChange {
  std::size_t pixels = 0;
  std::size_t beyond_a_hundredth = 0; ///< pixels that differ by more than 1 %
  double rms = 0.0, worst = 0.0;
};
/// Without the pixels marked in `left_out`.
PictureChange change_inside(const Image& before, const Image& after,
                            const std::vector<bool>& left_out);

/// Marks the pixels whose samples do not all land on one surface in one mirror world,
/// and their neighbours: there a rounding or a filter decides.
/// Found by rendering the scene with a flat colour of its own for each surface.
std::vector<bool> edges(const Scene& scene, const Camera& camera, const RenderSettings& settings);

} // namespace meninas::test
