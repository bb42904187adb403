// EXT_lights_area, as its draft is written: rectangles and discs that shine along the -Z of their node.
//
//   width = s size aspect, height = s size      s the largest of the node's scales
//
// `extras.aspect` of a disc makes an ellipse of it; the draft has none.
#include "scenes/gltf/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::gltf {

namespace {

constexpr int disc_corners = 32;

/// About the origin, clockwise about +Z: the light shines the other way.
std::vector<Vec2> outline(bool disc, double width, double height) {
  if (!disc)
    return {{-0.5 * width, -0.5 * height},
            {-0.5 * width, 0.5 * height},
            {0.5 * width, 0.5 * height},
            {0.5 * width, -0.5 * height}};
  // A polygon of the ellipse's own area.
  constexpr double turn = 2.0 * std::numbers::pi / disc_corners;
  const double grow = std::sqrt(turn / std::sin(turn));
  std::vector<Vec2> corners;
  for (int k = 0; k < disc_corners; ++k)
    corners.push_back(0.5 * grow * Vec2(width * std::cos(-k * turn), height * std::sin(-k * turn)));
  return corners;
}

/// The width over the height.
double aspect_of(const Json& json, bool disc) {
  if (const auto* rect = disc ? nullptr : find(json, "rect"))
    return number_or(*rect, "aspect", 1.0);
  const auto* extra = disc ? find(json, {"extras", "aspect"}) : nullptr;
  return extra && extra->is_number() ? extra->get<double>() : 1.0;
}

Rgb radiance_of(const Document& document, const Json& json, const std::string& where,
                const std::string& name, Findings& findings) {
  Rgb radiance = vec3_or(json, "color", Rgb(1.0)) * number_or(json, "intensity", 1000.0) *
                 (document.settings.state.light_scale / light_unit(document));
  if (glm::any(glm::lessThan(radiance, Rgb(0.0)))) {
    findings.about("lights of negative intensity are dark", name);
    radiance = glm::max(radiance, Rgb(0.0));
  }
  if (!glm::all(glm::lessThan(radiance, Rgb(1e30))))
    throw InputError(document.file, where, "intensity is too large");
  return radiance;
}

/// None where it has no extent in the world.
std::optional<AreaLight> placed_light(const Json& json, const std::string& type, const glm::dmat4& world) {
  const auto frame = unit_frame(world);
  if (!frame)
    return std::nullopt;
  const double scale = std::max({glm::length(Vec3(world[0])), glm::length(Vec3(world[1])),
                                 glm::length(Vec3(world[2]))});
  const bool disc = type == "disk";
  const double height = scale * number_or(json, "size", 1.0),
               width = height * aspect_of(json, disc);
  const Vec3 x = (*frame)[0], z = (*frame)[2], y = glm::cross(z, x);
  AreaLight light;
  light.axis = -z;
  for (const Vec2& corner : outline(disc, width, height))
    light.corners.push_back(Point3(world[3]) + corner.x * x + corner.y * y);
  const double area = width * height;
  return width > 0.0 && height > 0.0 && area > 0.0 && std::isfinite(area) ? std::optional(light)
                                                                           : std::nullopt;
}

} // namespace

void read_area_lights(const Document& document, std::span<const PlacedNode> nodes, Scene& scene,
                      Findings& findings) {
  std::vector<std::string> names;
  for (const auto& node : nodes) {
    const auto* use =
        find(element(document.root, "nodes", node.index), {"extensions", "EXT_lights_area"});
    if (!use)
      continue;
    const auto index = *index_at(*use, "light");
    const auto name = first_name(document, node.index, "areaLights", index, "light");
    const auto where = fmt::format("EXT_lights_area.lights[{}]", index);
    const Json& json = element(document.root, "areaLights", index);
    const auto type = text_or(json, "type", "rect");
    if (type != "rect" && type != "disk")
      throw InputError(document.file, where, fmt::format("type '{}' does not exist", one_line(type)));
    const Rgb radiance = radiance_of(document, json, where, name, findings);
    if (!(number_or(json, "size", 1.0) < 1e15)) // beyond that areas overflow in single precision
      throw InputError(document.file, where, "size is too large");
    auto light = placed_light(json, type, node.world);
    if (!light) {
      findings.about("area lights without area are left out", name);
      continue;
    }
    light->radiance = radiance;
    light->lamp = lamp_of_node(document, node.index);
    scene.area_lights.push_back(*std::move(light));
    names.push_back(name);
  }
  const auto unique = unique_names(names);
  for (std::size_t k = 0; k < unique.size(); ++k)
    scene.area_lights[k].name = unique[k];
}

} // namespace meninas::gltf
