#include "cli/camera_options.h"

#include "cli/pixel_options.h"
#include "cli/values.h"

namespace meninas {

void add_free_camera(Options& command, std::optional<FreeCamera>& place) {
  constexpr const char* group = "Picture";
  const auto at = [&place]() -> FreeCamera& { return place ? *place : place.emplace(); };
  command.add("--eye", "X,Y,Z", "look from there, upright, in metres, instead of a camera of the file; needs --target",
              [=](const std::string& text) { at().eye = parse_point("--eye", text); })
      .group(group);
  command.add("--target", "X,Y,Z", "--eye: the point that is looked at",
              [=](const std::string& text) { at().target = parse_point("--target", text); })
      .group(group);
  command.add("--angle", "DEGREES", "--eye: angle of view from bottom to top [45.8]",
              [=](const std::string& text) { at().angle = parse_number("--angle", text, Sign::positive); })
      .group(group);
}

void check_free_camera(const Options& command, const std::optional<FreeCamera>& place,
                       const RunSettings& settings) {
  if (!place)
    return;
  for (const char* const needed : {"--eye", "--target"})
    if (!command.given(needed))
      throw UsageError(needed, "is needed with --eye, --target and --angle, which go together");
  refuse(command, {"--camera"}, "does not go with --eye, which is no camera of the file");
  static_cast<void>(camera_at(*place, settings)); // before anything is solved
}

} // namespace meninas
