// Six faces of a cube as a map of radiance, for EXT_lights_image_based.
//
//   L = intensity rgb / a     W/m^2/sr, of texels packed as RGBD; a is 1 in pictures without alpha
//
// Each face is seen from inside, as the extension has them flipped about their vertical axis: right and
// down are +Z, -Y of +X; -Z, -Y of -X; -X, +Z of +Y; -X, -Z of -Y; -X, -Y of +Z; +X, -Y of -Z. The map
// has four texels along the equator for each of a face's, taken from the nearest ones, bilinear.
#pragma once

#include "scenes/materials/texture_pixels.h"
#include "scenes/sky/environment.h"
#include "scenes/sky/radiance_map.h"

#include <functional>
#include <span>

namespace meninas {

/// Linear values of an encoded picture, with alpha as it is; `name` is for messages.
using DecodeFace =
    std::function<TexturePixels(std::span<const std::byte>, const std::string& name)>;

/// Throws what `decode` throws, and InputError where faces are no squares of one size.
RadianceMap map_of_cube(const ImageBasedLight& light, const DecodeFace& decode,
                        std::vector<std::string>& warnings);

/// Decodes what the file's environment is, if it is not yet; what cannot be decoded lights nothing, and a
/// warning says so.
void settle_environment(Environment& environment, const DecodeFace& decode,
                        std::vector<std::string>& warnings);

} // namespace meninas
