// The roles of a picture file's channels (the picture, a layer, or neither), told by their names, because a
// file says no more.
//
// A colour is three channels of one part with the same prefix whose last names are R, G and B,
// in either case, or Red, Green and Blue: `R`, `ViewLayer.Combined.R`, `albedo.r`.
// In files of several parts, the prefix begins with the part's name. The picture is
//   1. plain R, G and B, those of the first part that has them;
//   2. what Blender calls Composite.Combined, else the first layer with `Combined` in its name;
//   3. the first layer that is called as renderers call it: beauty, rgba, rgb, color, ...;
//   4. the only colour there is; without any, the only luminance Y.
// Layers are all other colours.
#pragma once

#include "image/codecs/decoder_seam.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// Where a colour's components are among the channels of a part; grey has one thrice.
using Components = std::array<int, 3>;

struct ColourChannels {
  std::string name; ///< the prefix; empty for plain channels of the only or the first part
  std::size_t part = 0;
  Components components{};
  std::optional<int> alpha; ///< of the same prefix
};

struct PictureChannels {
  std::optional<ColourChannels> picture;
  std::string problem;                ///< why there is none, for the user to read
  std::vector<ColourChannels> layers; ///< sorted by name
  std::vector<std::string> others;    ///< alpha among them, by the names they have in the file
};

PictureChannels picture_channels(const decoder::Decoded& decoded);

} // namespace meninas
