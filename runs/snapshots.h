// Pictures along the way:
// what the shots of progressive radiosity have brought so far, alone and with the ambient term.
//
// FOLDER/shots-NNNNNN.png and shots-NNNNNN-ambient.png (or .exr, the formats of the run's
// picture) after every so many shots and after the last, each whole or not there.
// Irradiance is averaged over elements, so that the pictures show what has been shot and no more.
// All PNGs have one exposure, that of the first picture with ambient light,
// which comes nearest to the last, unless one is given.
#pragma once

#include "raytrace/two_pass.h"
#include "runs/outputs.h"

#include <filesystem>
#include <vector>

namespace meninas {

struct SnapshotRequest {
  std::filesystem::path folder;
  int every = 25; ///< shots
};

/// Makes the folder; throws OutputError when nothing can be written there.
void prepare_snapshots(const SnapshotRequest& request);

/// The watch that writes snapshots; refers to all but the settings. `like`: files whose formats they have.
PassOneWatch snapshot_watch(const SnapshotRequest& request, const PreparedScene& prepared,
                            const Camera& camera, const RenderSettings& render,
                            const std::vector<std::filesystem::path>& like,
                            const PictureSettings& settings);

} // namespace meninas
