// The report of a comparison of modes: figures, pictures of differences, and a page that shows all of it.
//
// Every mode is measured (image/metrics/metrics.h) against the most accurate one there is:
// the reference, else the hybrid picture. The share of a layer is its mean
// luminance over that of the hybrid picture; the nine shares add up to one.
#pragma once

#include "image/image.h"
#include "image/view_transform.h"
#include "reference/light_layers.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace meninas {

/// One way to render the view.
struct ComparedMode {
  std::string id;   ///< of its files: ID.exr, ID.png
  std::string name; ///< for people
  std::string note; ///< beside the name, in the table
  Image image;
  double seconds = 0.0; ///< that this picture takes from the prepared scene, pass one included
};

struct Comparison {
  std::string scene, camera;
  std::string command;                               ///< that makes it again
  double exposure = 0.0;                             ///< stops, the same for all
  ViewTransform transform = ViewTransform::neutral;  ///< likewise
  std::vector<ComparedMode> modes;                   ///< the less accurate first
  std::vector<Layer> layers;                         ///< of the hybrid picture
  std::vector<reference::LayerLuminances> reference; ///< batches of its own split, if there is one
  std::vector<std::pair<std::string, std::string>> settings;
};

/// {"scene", "camera", "width", "height", "exposure", "modes":
/// [{"id", "seconds", "compared_with", "rmse", ...}], "layers":
/// [{"name", "share"}], "mirrored_of_diffuse", "seen_in_mirrors", "settings", "version"};
/// no figure that does not exist. With a reference there is what its own split says:
/// "reference": {"mirrored_of_diffuse": {"value", "standard_error"}, "seen_in_mirrors": {...}}.
std::string compare_json(const Comparison& comparison);

/// index.html: self-contained.
std::string compare_page_of(const Comparison& comparison);

/// The signed differences between each mode and the next:
/// ID-minus-ID.png, blue where the first is darker.
struct DifferencePicture {
  std::string name;
  std::string caption;
  Image image; ///< for exposure 0
};
std::vector<DifferencePicture> difference_pictures(const Comparison& comparison);

} // namespace meninas
