#include "raytrace/views/features.h"

#include "raytrace/views/sight.h"

#include <tbb/parallel_for.h>

namespace meninas {

std::string_view name_of(Feature feature) {
  switch (feature) {
  case Feature::depth:
    return "depth";
  case Feature::normal:
    return "normal";
  case Feature::albedo:
    return "albedo";
  case Feature::element:
    return "element";
  case Feature::alpha:
    return "alpha";
  case Feature::irradiance:
    break;
  }
  return "irradiance";
}

static glm::vec3 value_of(Feature feature, const IrradianceField& field,
                          const Camera& camera, const Sight& sight) {
  const LightScene& light = *field.scene;
  const bool on_field = sight.side != FaceRecord::nothing;
  switch (feature) {
  case Feature::depth:
    return glm::vec3(static_cast<float>(
        is_panorama(camera.projection)
            ? glm::distance(sight.position, camera.position)
            : glm::dot(sight.position - camera.position, camera.forward)));
  case Feature::normal:
    return sight.normal;
  case Feature::albedo:
    return albedo_at(light, sight);
  case Feature::element:
    return glm::vec3(on_field ? static_cast<float>(sight.place.element) + 1.0F : 0.0F);
  case Feature::alpha:
  case Feature::irradiance:
    break;
  }
  return on_field ? field_irradiance(light.mesh.corners, field.irradiance, sight.place.element,
                                     sight.place.place)
                  : glm::vec3(0.0F);
}

/// By sixteen points, each in a square of its own.
static float coverage(const LightScene& light, const Camera& camera, const RenderSettings& settings,
                      int x, int y) {
  constexpr int side = 4;
  const double aspect = double(settings.width) / settings.height;
  int met = 0;
  for (int k = 0; k < side * side; ++k) {
    const Vec2 at((x + (k % side + 0.5) / side) / settings.width,
                  (y + (k / side + 0.5) / side) / settings.height);
    met += look(light, camera, aspect, at, 0).triangle != none<TriangleId> ? 1 : 0;
  }
  return static_cast<float>(met) / (side * side);
}

std::vector<Layer> render_features(const IrradianceField& field,
                                   const Camera& camera, const RenderSettings& settings) {
  std::vector<Layer> layers;
  for (const Feature feature : settings.features)
    layers.push_back({std::string(name_of(feature)), Image(settings.width, settings.height)});
  const double aspect = double(settings.width) / settings.height;
  tbb::parallel_for(0, settings.features.empty() ? 0 : settings.height, [&](int y) {
    for (int x = 0; x < settings.width; ++x) {
      for (std::size_t k = 0; k < layers.size(); ++k)
        if (settings.features[k] == Feature::alpha)
          layers[k].image.at(x, y) = glm::vec3(coverage(*field.scene, camera, settings, x, y));
      const Vec2 middle((x + 0.5) / settings.width, (y + 0.5) / settings.height);
      const Sight sight = look(*field.scene, camera, aspect, middle, 0);
      if (sight.triangle == none<TriangleId>)
        continue;
      for (std::size_t k = 0; k < layers.size(); ++k)
        if (settings.features[k] != Feature::alpha)
          layers[k].image.at(x, y) = value_of(settings.features[k], field, camera, sight);
    }
  });
  return layers;
}

} // namespace meninas
