// Layers that show the scene instead of its light, for compositing and denoising.
// All but alpha are samples at the middle of each pixel,
// of the first surface the eye meets there, a mirror among them; 0 where there is none.
// Alpha is the share of the pixel in which there is one, by 16 points.
#pragma once

#include "raytrace/render_settings.h"

namespace meninas {

/// In all channels of the layer: of depth along the view axis, or of distance from the eye in panoramas, metres;
/// R, G, B = x, y, z of the unit normal towards the eye, in the world;
/// diffuse reflectance with textures, 0 on mirrors; index of the element counted from 1 (exact
/// up to 2^24), 0 where there is none; irradiance of the field of pass one, W/m^2.
std::vector<Layer> render_features(const IrradianceField& field,
                                   const Camera& camera, const RenderSettings& settings);

} // namespace meninas
