#include "scenes/materials/texture_pyramid.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

namespace {

/// What a texel of the next level covers of a row:
/// texels from `first` on, by their shares, which add up to one.
struct Cover {
  int first = 0;
  std::vector<float> shares;
};

std::vector<Cover> covers(int size, int half) {
  std::vector<Cover> list;
  const double width = double(size) / half;
  for (int k = 0; k < half; ++k) {
    const double low = k * width, high = std::min((k + 1) * width, double(size));
    Cover cover{static_cast<int>(low), {}};
    for (int texel = cover.first; texel < high && texel < size; ++texel)
      cover.shares.push_back(
          static_cast<float>((std::min(high, texel + 1.0) - std::max(low, double(texel))) / width));
    list.push_back(std::move(cover));
  }
  return list;
}

TexturePixels halved(const TexturePixels& image) {
  TexturePixels half{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
  const auto across = covers(image.width, half.width), down = covers(image.height, half.height);
  for (const Cover& rows : down)
    for (const Cover& columns : across) {
      glm::vec4 sum(0.0F);
      for (std::size_t j = 0; j < rows.shares.size(); ++j)
        for (std::size_t i = 0; i < columns.shares.size(); ++i)
          sum += rows.shares[j] * columns.shares[i] *
                 image.texels[(static_cast<std::size_t>(rows.first) + j) * image.width +
                              static_cast<std::size_t>(columns.first) + i];
      half.texels.push_back(sum);
    }
  return half;
}

} // namespace

std::vector<TexturePixels> coarser_levels(const TexturePixels& image) {
  std::vector<TexturePixels> levels;
  if (image.texels.empty())
    return levels;
  for (const TexturePixels* last = &image; last->width > 1 || last->height > 1;
       last = &levels.back())
    levels.push_back(halved(*last));
  return levels;
}

std::vector<TexturePixels> coarser_levels(int width, int height,
                                          const std::function<glm::vec4(int x, int y)>& at) {
  TexturePixels image{width, height, {}};
  image.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      image.texels[static_cast<std::size_t>(y) * width + x] = at(x, y);
  });
  return coarser_levels(image);
}

} // namespace meninas
