// A part of a picture as a file: an EXR of floats whose data window is the part's, with its layers, and
// attributes with its scene, settings and version. The values that PNGs show at the edges of bright things
// (raytrace/pixels/bright_edges.h) are kept as layers, one for each exposure (stops) that the whole may have.
//
//   tile           K/N, from 1
//   tileVersion    of the program
//   tileCamera     a hash of its place and lens
//   tileSettings   options of `render` that differ from the defaults
//   tileExposure   stops, where they are given
//   tileTransform  of PNGs
//   tileEdges      exposures of the layers `edges.0`, `edges.1`, ...
//
// Shown values are linear in [0, 1]; a pixel that is no edge has -1.
#pragma once

#include "runs/outputs.h"
#include "runs/view.h"

namespace meninas {

/// The origin of a part, beside the picture's own attributes.
struct TileOrigin {
  const Camera& camera;
  const RunSettings& settings; ///< that have a part
  const std::optional<std::filesystem::path>& solution;
  const PictureSettings& shown;
};

/// Throws OutputError where it cannot be written.
void write_tile(const std::filesystem::path& file, const ViewPicture& picture,
                const TileOrigin& origin);

struct TileFile {
  PicturePart part;
  DataWindow window;
  Image pixels;
  std::vector<Layer> layers;      ///< of the picture, sorted by name
  std::vector<ShownPixels> edges; ///< pixels are those of the window, row by row
  bool knows_edges = false;
  std::optional<double> exposure; ///< stops, where they are given
  ViewTransform transform = ViewTransform::neutral;
  Attributes attributes; ///< all of them
};

/// Throws InputError for a file that is no such part.
TileFile read_tile(const std::filesystem::path& file);

/// The attributes of the whole picture.
Attributes without_tile(Attributes attributes);

} // namespace meninas
