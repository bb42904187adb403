// The two kinds of work a batch consists of: getting a scene's light, and making one picture of it.
//
// Both may find that another process is at it (`held`): then there is something else to do first.
#pragma once

#include "runs/batch/batch_folder.h"
#include "runs/view.h"

#include <shared_mutex>

namespace meninas {

/// Pass one of a scene, shared by all pictures with its solution key.
struct SceneLight {
  LitScene lit;
  RunFigures figures;
  bool solved = false; ///< here and now, not read
};

/// From the cache, or solved and kept there. Nothing while another process solves it.
/// A damaged entry is warned about and solved again.
/// Throws a UserError, also when the scene is not what it was when the batch was planned.
std::optional<SceneLight> find_light(const BatchFolder& folder, const BatchPicture& picture,
                                     const RunEvents& events);

enum class PictureStatus {
  open,  ///< not begun, or given up when the batch was stopped
  held,  ///< another process is at it
  found, ///< done already, by an earlier run or another process
  made,
  failed
};

/// The outcome of a picture, `record` with its reason if it failed.
struct PictureResult {
  PictureStatus status = PictureStatus::open;
  PictureRecord record;
};

/// Makes the picture unless it is done or held. `light` is null for a reference.
/// Files are written while `writing` is shared,
/// so that whoever holds it alone knows that no file is under way. Throws a UserError.
PictureResult make_picture(const BatchFolder& folder, const BatchPicture& picture,
                           const LitScene* light, std::shared_timed_mutex& writing,
                           const RunEvents& events);

} // namespace meninas
