// A furnished living room of some 400,000 triangles, for what small rooms do not show: curved and
// textured things by the hundred, two mirrors, the sun through a window. Too large to be committed.
#pragma once

#include "scenes/gallery/generator/stage.h"

namespace meninas::gallery {

/// 5.6 m x 2.8 m x 5.6 m; the window is open to the sky, which the file does not have.
Stage living_room();

} // namespace meninas::gallery
