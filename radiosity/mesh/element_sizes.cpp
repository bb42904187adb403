#include "radiosity/mesh/element_sizes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meninas {

bool carries_radiosity(const Material& material) {
  if (is_emitter(material) || !(is_mirror(material) || is_glass(material)))
    return true;
  // A surface that is blended by its texture or its vertices is there somewhere.
  if (is_blended(material) && material.transmission == 1.0)
    return true;
  // Where its texture of transmission is black glass is opaque.
  if (material.transmission_texture)
    return true;
  // Where its texture of metalness is black, it is no metal.
  if (material.metallic_roughness_texture && material.transmission < 1.0)
    return true;
  return is_translucent(material) ||
         glm::any(glm::greaterThan(diffuse_reflectance(material), Rgb(0.0)));
}

unsigned meshed_sides(const Scene& scene, const SurfaceModel& surfaces, PatchId patch,
                      const DarkSides& dark) {
  const Material& material = scene.materials[index(surfaces.patches[index(patch)].material)];
  if (!carries_radiosity(material))
    return 0;
  const unsigned sides = material.double_sided ? 2 : 1;
  return dark.empty() ? sides : sides - dark[index(patch)][0] - dark[index(patch)][1];
}

std::vector<double> meshed_areas(const Scene& scene, const SurfaceModel& surfaces,
                                 const DarkSides& dark) {
  std::vector<double> areas(surfaces.surfaces.size(), 0.0);
  for (std::size_t p = 0; p < surfaces.patches.size(); ++p) {
    const Patch& patch = surfaces.patches[p];
    areas[index(patch.surface)] +=
        meshed_sides(scene, surfaces, static_cast<PatchId>(p), dark) * patch.area;
  }
  return areas;
}

ElementSizes share_elements(const std::vector<double>& areas, double elements) {
  constexpr double most = 3.0; // times what all others have
  constexpr double max_finer = 256.0;
  ElementSizes sizes;
  const auto largest = std::max_element(areas.begin(), areas.end());
  if (largest == areas.end())
    return sizes;
  // Summed without the largest: of a ground that is 10^16 rooms, subtraction would leave no room.
  const double others =
      std::accumulate(areas.begin(), largest, 0.0) + std::accumulate(largest + 1, areas.end(), 0.0);
  const double n = std::max(elements, 1.0),
               counted = others > 0.0 ? std::min(*largest, most * others) : *largest;
  sizes.element_size =
      std::max(std::sqrt((others + counted) / n), std::sqrt((others + *largest) / n) / max_finer);
  sizes.of_surface.assign(areas.size(), sizes.element_size);
  if (*largest > counted)
    sizes.of_surface[static_cast<std::size_t>(largest - areas.begin())] =
        std::sqrt((others + counted) / n) * std::sqrt(*largest / counted);
  return sizes;
}

} // namespace meninas
