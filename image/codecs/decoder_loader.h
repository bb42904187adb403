// Opens the module of decoder_seam.h, once, when the first picture that is read needs it.
#pragma once

#include "image/codecs/decoder_seam.h"

namespace meninas::decoder {

/// Starts opening the module on a thread of its own and returns at once.
void preload();

/// The module's functions, waiting until it is open; they use as many threads as oneTBB may.
/// Throws InputError when it is missing, does not load or comes from another build.
const Table& module_table();

} // namespace meninas::decoder
