#include "reference/light_table.h"

#include "scenes/area_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::reference {

namespace {

double mean(const Rgb& c) { return (c.r + c.g + c.b) / 3.0; }

/// By MaterialId: mean emission, textures included.
std::vector<double> mean_emissions(const Scene& scene, const DecodedTextures& textures) {
  std::vector<double> emissions;
  for (const Material& material : scene.materials) {
    Rgb emission = material.emission;
    if (const auto& use = material.emissive_texture) {
      const auto& texels = textures.colours[index(use->texture)].texels;
      Rgb sum(0.0);
      for (const glm::vec4& texel : texels)
        sum += Rgb(texel) / double(texels.size());
      emission *= sum;
    }
    emissions.push_back(mean(emission));
  }
  return emissions;
}

} // namespace

LightTable make_light_table(const Scene& scene, const DecodedTextures& textures) {
  const std::vector<double> emissions = mean_emissions(scene, textures);
  LightTable table;
  table.area_density.assign(scene.triangles.size(), 0.0);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const TriangleId triangle{static_cast<std::uint32_t>(t)};
    const Material& material = material_of(scene, triangle);
    const double area = glm::length(area_vector(corners(scene, triangle)));
    const double sides = material.double_sided ? 2.0 : 1.0;
    const double power =
        std::numbers::pi * area * sides * emissions[index(scene.triangles[t].material)];
    if (power > 0.0)
      table.lights.push_back({triangle, 0, power});
  }
  table.area_light_density.assign(scene.area_lights.size(), 0.0);
  for (std::uint32_t k = 0; k < scene.area_lights.size(); ++k) {
    const double power =
        std::numbers::pi * area_of(scene.area_lights[k]) * mean(scene.area_lights[k].radiance);
    if (power > 0.0)
      table.lights.push_back({none<TriangleId>, k, power});
  }

  // Relative to the largest, so that no sum overflows.
  double largest = 0.0, sum = 0.0;
  for (const Light& light : table.lights)
    largest = std::max(largest, light.power);
  for (Light& light : table.lights)
    sum += light.power /= largest;
  double below = 0.0;
  for (Light& light : table.lights) {
    light.power /= sum;
    table.cumulative.push_back(below += light.power);
    if (light.triangle == none<TriangleId>)
      table.area_light_density[light.area_light] =
          light.power / area_of(scene.area_lights[light.area_light]);
    else
      table.area_density[index(light.triangle)] =
          light.power / glm::length(area_vector(corners(scene, light.triangle)));
  }
  return table;
}

const Light& choose_light(const LightTable& table, double u) {
  const auto found = std::ranges::upper_bound(table.cumulative, u * table.cumulative.back());
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(found - table.cumulative.begin()),
                                       table.lights.size() - 1);
  return table.lights[k];
}

Vec2 even_barycentric(double u, double v) {
  const double root = std::sqrt(u);
  return {root * (1.0 - v), root * v};
}

} // namespace meninas::reference
