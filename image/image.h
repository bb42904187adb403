// A picture: linear RGB radiance per pixel, rows from the top. Never scaled on the way to an EXR.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace meninas {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels; ///< width * height, row by row from the top, left to right

  Image() = default;
  Image(int width, int height);

  glm::vec3& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const glm::vec3& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * width + x];
  }
};

/// A named picture inside a multi-layer EXR (`diffuse.direct`, `variance`, ...).
struct Layer {
  std::string name;
  Image image;
};

/// Whether a picture is also wanted as a sum of layers.
enum class WithLayers { no, yes };

} // namespace meninas
