#include "scenes/sky/environment.h"

#include "scenes/content_hash.h"
#include "scenes/sky/radiance_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

bool is_dark(const Environment& environment) {
  return !environment.map && !environment.encoded && environment.constant == Rgb(0.0);
}

bool is_grey(const Environment& environment) {
  const auto grey = [](const auto& c) { return c.r == c.g && c.g == c.b; };
  if (environment.map)
    return std::ranges::all_of(environment.map->texels, grey);
  return !environment.encoded && grey(environment.constant);
}

Rgb radiance_from(const Environment& environment, const Vec3& direction) {
  return environment.map ? Rgb(radiance_from(*environment.map, direction, Suns::shown))
                         : environment.constant;
}

std::uint64_t content_hash(const Environment& environment) {
  ContentHash hash;
  if (environment.map)
    hash.add(environment.map->hash);
  hash.add(environment.constant);
  if (environment.encoded) {
    for (const auto& face : environment.encoded->faces)
      hash.add(std::span(face));
    hash.add(environment.encoded->intensity);
    for (const double q : environment.encoded->rotation)
      hash.add(q);
  }
  return hash.value();
}

std::string description(const Environment& environment) {
  if (environment.map) {
    const RadianceMap& map = *environment.map;
    const Rgb mean = mean_radiance(map);
    const std::size_t suns = map.suns.size();
    return fmt::format("{}, {} x {} texels, mean radiance {:.3g}, {:.3g}, {:.3g} W/m^2/sr{}",
                       map.name, map.width, map.height, mean.r, mean.g, mean.b,
                       suns == 0   ? ""
                       : suns == 1 ? ", with a sun"
                                   : fmt::format(", with {} suns", suns));
  }
  if (environment.encoded)
    return environment.encoded->name;
  if (environment.constant == Rgb(0.0))
    return "";
  const Rgb& c = environment.constant;
  return is_grey(environment) ? fmt::format("a background of {:g} W/m^2/sr", c.r)
                              : fmt::format("a background of {:g}, {:g}, {:g} W/m^2/sr", c.r, c.g, c.b);
}

} // namespace meninas
