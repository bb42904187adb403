// Opens the module of image_io.h, once, when the first picture needs it.
#pragma once

#include "image/image_io.h"

namespace meninas::image_io {

/// Starts opening the module on a thread of its own and returns at once.
void preload();

/// The module's functions, waiting until it is open; they use as many threads as oneTBB may.
/// Throws InputError when it is missing, does not load or comes from another build.
const Table& module_table();

} // namespace meninas::image_io
