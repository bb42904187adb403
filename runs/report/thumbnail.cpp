#include "runs/report/thumbnail.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meninas {
namespace {

/// The pixels of a line that a smaller line's pixel covers.
struct Cover {
  int first = 0;
  std::vector<float> weights; ///< they add up to one
};

std::vector<Cover> covers(int from, int to) {
  const double step = double(from) / to;
  std::vector<Cover> result(static_cast<std::size_t>(to));
  for (int k = 0; k < to; ++k) {
    const double begin = k * step, end = std::min((k + 1) * step, double(from));
    Cover& cover = result[static_cast<std::size_t>(k)];
    cover.first = static_cast<int>(begin);
    for (int pixel = cover.first; pixel < end; ++pixel) {
      const double part = std::min(end, pixel + 1.0) - std::max(begin, double(pixel));
      cover.weights.push_back(static_cast<float>(part / (end - begin)));
    }
  }
  return result;
}

} // namespace

Image thumbnail(const Image& picture, int longest_side) {
  const int longest = std::max(picture.width, picture.height);
  if (longest <= longest_side) {
    return picture;
  }
  const auto shrunk = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(double(side) * longest_side / longest)));
  };
  Image result(shrunk(picture.width), shrunk(picture.height));
  const auto columns = covers(picture.width, result.width),
             rows = covers(picture.height, result.height);
  for (int y = 0; y < result.height; ++y) {
    const Cover& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < result.width; ++x) {
      const Cover& column = columns[static_cast<std::size_t>(x)];
      for (std::size_t j = 0; j < row.weights.size(); ++j) {
        for (std::size_t i = 0; i < column.weights.size(); ++i) {
          result.at(x, y) +=
              row.weights[j] * column.weights[i] *
              picture.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j));
        }
      }
    }
  }
  return result;
}

} // namespace meninas
