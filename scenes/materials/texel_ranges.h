// Between which values the texels are that a triangle shows of an image.
//
// A point with texture coordinates (u, v) shows, interpolated bilinearly, texels (i, j) with
// |u w - (i + 1/2)| < 1 and |v h - (j + 1/2)| < 1, wrapped as the sampler says. The texels of a
// triangle are found in a pyramid of ranges: its lowest level has one for each 8 x 8 texels,
// every further one for 2 x 2 of the level below. So a triangle in a part of the image that is
// constant costs as much as its outline crosses, and any other ends at the first two texels
// that differ too much. Triangles across the border of a clamped image, or of no area
// on it, count with the rectangle around them.
#pragma once

#include "scenes/materials/texture_lookup.h"

#include <functional>
#include <limits>

namespace meninas {

struct TexelRange {
  glm::vec4 low{std::numeric_limits<float>::infinity()};
  glm::vec4 high{-std::numeric_limits<float>::infinity()};
  glm::dvec4 sum{0.0}; ///< over texels, by how many triangles show them
  double count = 0.0;
};

/// Whether values between these may be among the texels.
using AllowedRange = std::function<bool(const glm::vec4& low, const glm::vec4& high)>;

class TexelRanges {
public:
  /// Refers to the pixels.
  TexelRanges(const TexturePixels& pixels, const Texture& texture);

  /// Adds the texels that a triangle with these texture coordinates shows to the range.
  /// False as soon as it is no longer allowed; then the range says no more.
  /// `work` counts down what was looked at; below zero the answer is false.
  bool add(const std::array<Vec2, 3>& uv, const AllowedRange& allowed, TexelRange& range,
           std::int64_t& work) const;

private:
  struct Block {
    glm::vec4 low, high, mean;
    float count;
  };
  struct Level {
    int width, height;
    std::vector<Block> blocks;
  };
  struct Shape;
  struct Search;

  bool descend(std::size_t level, int x, int y, Search& search) const;
  bool add_texels(int x, int y, Search& search) const;

  const TexturePixels& pixels_;
  Wrap wrap_u_, wrap_v_;
  std::vector<Level> levels_; ///< the last has one block
};

} // namespace meninas
