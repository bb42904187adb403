#include "runs/report/picture_units.h"

#include <algorithm>
#include <array>

namespace meninas {

static constexpr std::string_view key = "units";

std::string unit_of_layer(std::string_view name) {
  struct Unit {
    std::string_view layer, unit;
  };
  static constexpr std::array others{Unit{"depth", "m"},      Unit{"normal", "1"},
                                     Unit{"albedo", "1"},     Unit{"element", "1"},
                                     Unit{"alpha", "1"},
                                     Unit{"elements", "1"},   Unit{"closure", "1"},
                                     Unit{"mirror-depth", "1"}, Unit{"irradiance", "W/m^2"},
                                     Unit{"illuminance", "lx"}, Unit{"luminance", "cd/m^2"},
                                     Unit{"variance", "(W/m^2/sr)^2"}};
  const auto* const other = std::ranges::find(others, name, &Unit::layer);
  return std::string(other == others.end() ? unit_of_radiance : other->unit);
}

Attributes with_units(Attributes attributes, std::string_view picture, std::span<const Layer> layers) {
  attributes.emplace_back(key, picture);
  for (const Layer& layer : layers)
    if (std::string unit = unit_of_layer(layer.name); unit != picture)
      attributes.emplace_back(std::string(key) + '.' + layer.name, std::move(unit));
  return attributes;
}

std::string stated_unit(const ImageFile& file, const std::string& layer) {
  if (file.encoding == Encoding::srgb)
    return unit_of_colours;
  const auto stated = [&](const std::string& name) -> std::string {
    const auto found = std::ranges::find(file.attributes, name, &Attributes::value_type::first);
    return found == file.attributes.end() ? "" : found->second;
  };
  const std::string own = layer.empty() ? "" : stated(std::string(key) + '.' + layer);
  return own.empty() ? stated(std::string(key)) : own;
}

} // namespace meninas
