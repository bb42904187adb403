// Skies for tests, and rooms that they light.
#pragma once

#include "scenes/sky/radiance_map.h"
#include "tests/support/scene_builder.h"

#include <functional>

namespace meninas::test {

/// A map whose texels have the radiance of their middles.
RadianceMap map_of(const std::function<Rgb(const Direction&)>& radiance, int width = 256,
                   const MapPlacement& placement = {});

Environment sky_of(const std::function<Rgb(const Direction&)>& radiance, int width = 256,
                   const MapPlacement& placement = {});

/// A closed room of 4 x 3 x 5 metres, lit by a window in its wall x = 4: an opening of 1.4 x 1.2 metres
/// from (4, 1, 1.5) to (4, 2.2, 2.9). `pane`: a material for what fills it, or nothing does.
Scene room_with_window(const Material& walls, const Material* pane = nullptr);

} // namespace meninas::test
