// Faces that are there twice: which of them rays meet.
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// By triangle, whether it has exactly the corners of another that hides it from wherever it could
/// be seen: rays meet that one alone, the same for every ray. An emitter hides a face that is none,
/// otherwise the double-sided one hides, otherwise the first in the file. Cut-out or
/// transparent faces hide nothing, and two single-sided faces back to back are a sheet.
std::vector<bool> hidden_copies(const Scene& scene);

} // namespace meninas
