// Images of the living room, by functions: wood, carpet, cloth, books, a painting.
// sRGB, sides that are powers of two; all but the painting, the carpet and the books repeat.
#pragma once

#include "scenes/gallery/generator/stage.h"

namespace meninas::gallery {

Picture planks();     ///< 8 boards side by side, each 1/8 wide, along v
Picture wood_grain(); ///< along u
Picture weave();      ///< threads, light on light
Picture carpet();     ///< the whole of it, its length along u
Picture painting();   ///< hills at evening

/// Backs of `book_designs` bindings side by side, from the head down.
Picture book_backs();
inline constexpr int book_designs = 32;

} // namespace meninas::gallery
