#include "bench/truth.h"

#include "image/image_file.h"
#include "scenes/gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace meninas::bench {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// "r,g,b" as pictures keep it; black where they do not.
static Rgb background_of(const Attributes& attributes) {
  const auto found = std::ranges::find(attributes, "background", &Attributes::value_type::first);
  Rgb background(0.0);
  if (found != attributes.end())
    std::sscanf(found->second.c_str(), "%lf,%lf,%lf", &background.r, &background.g, &background.b);
  return background;
}

Truth read_truth(const std::filesystem::path& folder, const std::filesystem::path& scene) {
  ImageFile file = read_image(folder / (scene.stem().string() + ".reference.exr"));
  Truth truth{std::move(file.picture), {}, load_gltf(scene)};
  const auto variance = std::ranges::find(file.layers, "variance", &Layer::name);
  if (variance != file.layers.end())
    truth.variance = std::move(variance->image);
  truth.scene.background = background_of(file.attributes);
  return truth;
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
      sum += (off * off - (truth.variance ? double{truth.variance->pixels[p][band]} : 0.0)) /
             std::pow(r + mean[band], 2.0);
    }
  return std::sqrt(std::max(sum, 0.0) / (3.0 * double(picture.pixels.size())));
}

} // namespace meninas::bench
