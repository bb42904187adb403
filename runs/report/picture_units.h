// The units of a picture and of its layers, as its EXR states them: `meninas:units` for R, G, B, and
// `meninas:units.NAME` for a layer NAME that differs.
// Radiance W/m^2/sr is the rule. Colours that stand for numbers are parts of white; the numbers are a layer.
#pragma once

#include "image/image_file.h"

#include <span>
#include <string>
#include <string_view>

namespace meninas {

inline constexpr const char* unit_of_radiance = "W/m^2/sr";
inline constexpr const char* unit_of_colours = "of white";

/// The unit of a layer that the program writes, by its name.
std::string unit_of_layer(std::string_view name);

/// The attributes, and the units of the picture, `picture`, and of those layers that differ.
Attributes with_units(Attributes attributes, std::string_view picture, std::span<const Layer> layers);

/// The unit of the picture of a file, or of one layer of it; empty where the file does not state one.
/// Code values are parts of white.
std::string stated_unit(const ImageFile& file, const std::string& layer = "");

} // namespace meninas
