#include "scenes/materials/texel_ranges.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

constexpr int block_size = 8;

/// An interval of texel coordinates moved to where its texels are:
/// x -> offset + sign x, cut to the image.
struct TilePlace {
  double offset = 0.0, sign = 1.0;
  bool exact = true; ///< false: anything between low and high
  double low = 0.0, high = 0.0;
};

/// The tiles of a wrapped image that an interval reaches.
std::vector<TilePlace> tiles_of(double low, double high, int size, Wrap wrap) {
  const double length = size;
  // Texels half a texel beyond the interval are interpolated with.
  const double first = std::floor((low - 0.5) / length), last = std::floor((high + 0.5) / length);
  if (wrap == Wrap::clamp) {
    if (first == 0.0 && last == 0.0)
      return {{0.0, 1.0, true, low, high}};
    return {{0.0, 1.0, false, std::clamp(low, 0.0, length), std::clamp(high, 0.0, length)}};
  }
  if (!(last - first <= 2.0)) // not finite, too
    return {{0.0, 1.0, false, 0.0, length}};
  std::vector<TilePlace> tiles;
  for (double tile = first; tile <= last; tile += 1.0) {
    const bool turned = wrap == Wrap::mirrored && std::fmod(std::abs(tile), 2.0) == 1.0;
    TilePlace place;
    place.sign = turned ? -1.0 : 1.0;
    place.offset = turned ? (tile + 1.0) * length : -tile * length;
    place.low = place.offset + place.sign * (turned ? high : low);
    place.high = place.offset + place.sign * (turned ? low : high);
    tiles.push_back(place);
  }
  return tiles;
}

} // namespace

/// A triangle, or the rectangle around it, in texels of the image.
struct TexelRanges::Shape {
  Vec2 low{0.0}, high{0.0};
  std::array<Vec2, 3> corners;
  bool exact = false;

  /// Whether a point of it is between the two corners.
  bool reaches(Vec2 from, Vec2 to) const {
    if (high.x < from.x || low.x > to.x || high.y < from.y || low.y > to.y)
      return false;
    if (!exact)
      return true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = corners[k], edge = corners[(k + 1) % 3] - a;
      Vec2 inward(-edge.y, edge.x);
      if (glm::dot(inward, corners[(k + 2) % 3] - a) < 0.0)
        inward = -inward;
      const Vec2 farthest(inward.x > 0.0 ? to.x : from.x, inward.y > 0.0 ? to.y : from.y);
      if (glm::dot(inward, farthest - a) < 0.0)
        return false;
    }
    return true;
  }
};

struct TexelRanges::Search {
  Shape shape;
  const AllowedRange& allowed;
  TexelRange& range;
  std::int64_t& work;
};

TexelRanges::TexelRanges(const TexturePixels& pixels, const Texture& texture)
    : pixels_(pixels), wrap_u_(texture.wrap_u), wrap_v_(texture.wrap_v) {
  const auto blocks = [](int size, int of) { return (size + of - 1) / of; };
  Level lowest{blocks(pixels.width, block_size), blocks(pixels.height, block_size), {}};
  for (int y = 0; y < lowest.height; ++y)
    for (int x = 0; x < lowest.width; ++x) {
      Block block{glm::vec4(std::numeric_limits<float>::infinity()),
                  glm::vec4(-std::numeric_limits<float>::infinity()), glm::vec4(0.0F), 0.0F};
      const int end_x = std::min((x + 1) * block_size, pixels.width);
      const int end_y = std::min((y + 1) * block_size, pixels.height);
      for (int j = y * block_size; j < end_y; ++j)
        for (int i = x * block_size; i < end_x; ++i) {
          const glm::vec4& texel = pixels.texels[static_cast<std::size_t>(j) * pixels.width + i];
          block.low = glm::min(block.low, texel);
          block.high = glm::max(block.high, texel);
          block.mean += texel;
          block.count += 1.0F;
        }
      block.mean /= block.count;
      lowest.blocks.push_back(block);
    }
  levels_.push_back(std::move(lowest));
  while (levels_.back().blocks.size() > 1) {
    const Level& below = levels_.back();
    Level level{blocks(below.width, 2), blocks(below.height, 2), {}};
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x) {
        Block block{glm::vec4(std::numeric_limits<float>::infinity()),
                    glm::vec4(-std::numeric_limits<float>::infinity()), glm::vec4(0.0F), 0.0F};
        for (int j = 2 * y; j < std::min(2 * y + 2, below.height); ++j)
          for (int i = 2 * x; i < std::min(2 * x + 2, below.width); ++i) {
            const Block& part = below.blocks[static_cast<std::size_t>(j) * below.width + i];
            block.low = glm::min(block.low, part.low);
            block.high = glm::max(block.high, part.high);
            block.mean += part.count * part.mean;
            block.count += part.count;
          }
        block.mean /= block.count;
        level.blocks.push_back(block);
      }
    levels_.push_back(std::move(level));
  }
}

bool TexelRanges::add_texels(int x, int y, Search& search) const {
  TexelRange& range = search.range;
  const int end_x = std::min((x + 1) * block_size, pixels_.width);
  const int end_y = std::min((y + 1) * block_size, pixels_.height);
  for (int j = y * block_size; j < end_y; ++j)
    for (int i = x * block_size; i < end_x; ++i) {
      if (!search.shape.reaches(Vec2(i, j) - 0.5, Vec2(i, j) + 1.5))
        continue;
      const glm::vec4& texel = pixels_.texels[static_cast<std::size_t>(j) * pixels_.width + i];
      range.low = glm::min(range.low, texel);
      range.high = glm::max(range.high, texel);
      range.sum += glm::dvec4(texel);
      range.count += 1.0;
    }
  search.work -= block_size;
  return range.count == 0.0 || search.allowed(range.low, range.high);
}

bool TexelRanges::descend(std::size_t level, int x, int y, Search& search) const {
  if (--search.work < 0)
    return false;
  const double size = std::ldexp(double{block_size}, static_cast<int>(level));
  const Vec2 corner = size * Vec2(x, y);
  if (!search.shape.reaches(corner - 0.5, corner + size + 0.5))
    return true;
  const Block& block = levels_[level].blocks[static_cast<std::size_t>(y) * levels_[level].width + x];
  const glm::vec4 low = glm::min(search.range.low, block.low),
                  high = glm::max(search.range.high, block.high);
  if (search.allowed(low, high)) {
    search.range.low = low;
    search.range.high = high;
    search.range.sum += double{block.count} * glm::dvec4(block.mean);
    search.range.count += block.count;
    return true;
  }
  if (level == 0)
    return add_texels(x, y, search);
  const Level& below = levels_[level - 1];
  for (int j = 2 * y; j < std::min(2 * y + 2, below.height); ++j)
    for (int i = 2 * x; i < std::min(2 * x + 2, below.width); ++i)
      if (!descend(level - 1, i, j, search))
        return false;
  return true;
}

bool TexelRanges::add(const std::array<Vec2, 3>& uv, const AllowedRange& allowed, TexelRange& range,
                      std::int64_t& work) const {
  const Vec2 size(pixels_.width, pixels_.height);
  const std::array<Vec2, 3> at{size * uv[0], size * uv[1], size * uv[2]};
  const Vec2 low = glm::min(at[0], glm::min(at[1], at[2])),
             high = glm::max(at[0], glm::max(at[1], at[2]));
  const Vec2 a = at[1] - at[0], b = at[2] - at[0];
  const bool has_area = std::abs(a.x * b.y - a.y * b.x) > 0.0;
  for (const TilePlace& across : tiles_of(low.x, high.x, pixels_.width, wrap_u_))
    for (const TilePlace& down : tiles_of(low.y, high.y, pixels_.height, wrap_v_)) {
      Shape shape;
      shape.low = {across.low, down.low};
      shape.high = {across.high, down.high};
      shape.exact = has_area && across.exact && down.exact;
      for (std::size_t k = 0; k < 3; ++k)
        shape.corners[k] = {across.offset + across.sign * at[k].x,
                            down.offset + down.sign * at[k].y};
      Search search{shape, allowed, range, work};
      if (!descend(levels_.size() - 1, 0, 0, search))
        return false;
    }
  return true;
}

} // namespace meninas
