#include "image/image.h"

namespace meninas {

Image::Image(int w, int h)
    : width(w), height(h),
      pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), glm::vec3(0.0F)) {}

} // namespace meninas
