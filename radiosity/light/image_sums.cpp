#include "radiosity/light/image_sums.h"

#include "radiosity/light/portal_light.h"

#include <algorithm>

namespace meninas {

double brought_by(const ImageSum& image, double form_factor) {
  return form_factor * largest(image.source);
}

double variance_of(const Lighting& light, const ImageSum& image) {
  if (!(image.all > 0.0))
    return 0.0;
  const double visible = image.seen / image.all;
  if (!is_uneven(light.scene, light.emitters[image.emitter]))
    return visible * (1.0 - visible);
  const double mean = largest(image.left) / image.all;
  return std::max(0.0, image.squares / image.all - mean * mean);
}

bool shows_differences(const Lighting& light, const ImageSum& image) {
  constexpr double alike = 1e-4;
  return (image.seen > 0.0 && image.seen < image.all) ||
         (is_uneven(light.scene, light.emitters[image.emitter]) && variance_of(light, image) > alike);
}

bool cache_occluders(std::vector<ImageSum>& images) {
  constexpr std::size_t max_known = 8;
  bool any = false;
  for (ImageSum& image : images) {
    if (!image.blockers || image.blockers->met.empty())
      continue;
    auto& [known, met, learned, rims] = *image.blockers;
    learned += met.size();
    rims = 0;
    any = true;
    known.insert(known.begin(), met.begin(), met.end());
    known.resize(image.blockers->too_many() ? 0 : std::min(known.size(), max_known));
    met.clear();
  }
  return any;
}

} // namespace meninas
