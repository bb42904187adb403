// The places that a page begins at: the file's cameras, each with the exposure that a PNG from there would have, which
// makes radiance L times 2^EV well exposed (image/display.h).
#pragma once

#include "runs/run_settings.h"
#include "runs/walk/walk_page.h"

#include <optional>
#include <vector>

namespace meninas {

/// The cameras of the file, else a view of all of it and one from inside. `exposure`, in stops, is chosen for each
/// where it is not given, by a picture of 96 x 96 pixels of the field alone.
std::vector<WalkCamera> walk_cameras(const IrradianceField& field, const RunSettings& settings,
                                     const std::optional<double>& exposure);

} // namespace meninas
