#include "bench/truth.h"

#include "image/image_file.h"
#include "scenes/errors.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace meninas::bench {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Truth read_truth(const std::filesystem::path& folder, const std::filesystem::path& scene) {
  const auto file = folder / (scene.stem().string() + ".reference.exr");
  ImageFile picture = read_image(file);
  const auto variance = std::ranges::find(picture.layers, "variance", &Layer::name);
  if (variance == picture.layers.end())
    throw InputError(file.string(), "", "has no layer of variances");
  return {std::move(picture.picture), std::move(variance->image)};
}

double error_of(const Image& picture, const Truth& truth) {
  glm::dvec3 mean(0.0);
  for (const glm::vec3& pixel : truth.mean.pixels)
    mean += glm::dvec3(pixel) / double(truth.mean.pixels.size());
  double sum = 0.0;
  for (std::size_t p = 0; p < picture.pixels.size(); ++p)
    for (int band = 0; band < 3; ++band) {
      const double r = double{truth.mean.pixels[p][band]},
                   off = double{picture.pixels[p][band]} - r;
      sum += (off * off - double{truth.variance.pixels[p][band]}) / std::pow(r + mean[band], 2.0);
    }
  return std::sqrt(std::max(sum, 0.0) / (3.0 * double(picture.pixels.size())));
}

} // namespace meninas::bench
