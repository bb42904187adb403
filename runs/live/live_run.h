// `view`: pass one as it goes on, in a browser, from the first second, and again whenever the file changes.
//
// A server of the page of `walk` (web_server.h) shows the newest state of the room (live_board.h) and pass two's
// pictures of what is looked at (resting_pictures.h). Nothing is written. Below the address, by name and query:
//
//   ""          the page
//   events      server-sent: what is newest
//   room        JSON of the room
//   light       ?base=N                        its light, or the change of it
//   picture     ?VIEW&step=coarse|whole        PNG; 204 where nobody wants it any more, 503 with a sentence where there is none now
//   save.exr, save.png  ?VIEW                  the whole picture as files
//   command     ?VIEW                          the line that makes these files again
//   solution    what `solve` writes
//   factors     ?room=N&element=K              form factors of an element of the page (factor_rows.h); 503 of another room
//   moved, step, pause, go-on, shoot, gather   POST
//
// VIEW: viewer, number, camera or eye, target and angle, size, exposure.
#pragma once

#include "image/view_transform.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace meninas {

struct LiveRequest {
  std::filesystem::path scene;
  RunSettings settings;
  ViewTransform transform = ViewTransform::neutral;
  std::optional<double> exposure; ///< stops; chosen for each camera otherwise
  int port = 0;                   ///< any that is free
  bool paused = false;            ///< begins in the dark and waits for steps
};

/// Shows the scene until the process ends. `opened` gets the address once there is something to open.
/// Throws UserError where the scene cannot be read or solved to begin with, or where the server may not listen.
[[noreturn]] void live_run(const LiveRequest& request, const std::function<void(const std::string&)>& opened,
                           const RunEvents& events = {});

} // namespace meninas
