// The lamps of a page, whose dimmers add up the light of each (page/lamps.js):
//
//   H = sum over lamps l of s_l H_l,     W/m^2 at vertices, s_l a factor by channel
//
// H_l is kept as halves times a scale of the lamp, so that a dim lamp is as exact as a bright one: the
// error is 2^-11 of each channel. A row of its table has the bits of green, and those of red and of blue
// less green's, which hardly change along light of one colour.
#pragma once

#include "runs/walk/packed_numbers.h"
#include "scenes/types.h"

#include <span>
#include <string>
#include <vector>

namespace meninas {

struct WalkLamp {
  std::string name;
  Rgb factor{1.0}; ///< s_l that the page begins with
};

/// More are refused: nobody finds theirs among so many, and a browser has to add them up.
inline constexpr std::size_t max_walk_lamps = 64;
/// Lamps times vertices: 96 MB of halves in the browser.
inline constexpr std::size_t max_lamp_vertices = 16'000'000;

/// Throws InputError, naming the file, where a page would have more. `vertices` may not be known yet: 0.
void check_walk_lamps(const std::string& file, std::size_t lamps, std::size_t vertices);

/// The brightest of the values becomes a large half by it, W/m^2; 1 where all is dark.
float scale_of_halves(std::span<const glm::vec3> irradiance);

/// Light at every vertex in units of `scale`, by rows: the bits of green, and those of red and of blue less green's.
std::vector<std::uint32_t> halves_by_green(std::span<const glm::vec3> irradiance, float scale);

/// The irradiance of each vertex under the factors of the lamps, W/m^2.
std::vector<glm::vec3> under_factors(std::span<const std::vector<glm::vec3>> irradiance_by_lamp,
                                     std::span<const WalkLamp> lamps);

} // namespace meninas
