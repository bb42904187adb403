// Cameras and punctual lights, where their nodes put them.
#include "scenes/gltf/stages.h"
#include "scenes/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::gltf {

/// A direction of any length but zero as a unit vector, without overflow or underflow on the way.
static std::optional<Direction> unit(const Vec3& v) {
  const auto largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0.0 || !std::isfinite(largest))
    return std::nullopt;
  return glm::normalize(v / largest);
}

/// The orthonormal frame that looks along the node's -z with its y upwards;
/// scale and shear do not matter.
static bool orient(Camera& camera, const glm::dmat4& world) {
  const auto forward = unit(-Vec3(world[2]));
  if (!forward)
    return false;
  camera.forward = *forward;
  const auto upwards = unit(Vec3(world[1]));
  const auto right = upwards ? unit(glm::cross(*forward, *upwards)) : std::nullopt;
  camera.right = right ? *right : tangent_frame(*forward).tangent;
  camera.up = glm::cross(camera.right, camera.forward);
  camera.position = Vec3(world[3]);
  return true;
}

static void read_perspective(const Document& document, const std::string& where, const Json& json,
                             Camera& camera, Findings& findings) {
  camera.projection = Projection::perspective;
  camera.vertical_fov = number_or(json, "yfov", 0.0);
  // Nearer to the bounds a picture has no pixels of sensible size left.
  if (camera.vertical_fov < 1e-6 || camera.vertical_fov > std::numbers::pi - 1e-6)
    throw InputError(document.file, where,
                     fmt::format("yfov {} is not between 0 and pi", camera.vertical_fov));
  camera.aspect = number_or(json, "aspectRatio", 0.0);
  if (camera.aspect < 0.0 || (json.contains("aspectRatio") && camera.aspect == 0.0)) {
    findings.about("cameras with an aspectRatio that is not positive: the picture's is used",
                   where);
    camera.aspect = 0.0;
  }
}

static void read_orthographic(const Document& document, const std::string& where, const Json& json,
                              Camera& camera) {
  camera.projection = Projection::orthographic;
  const auto xmag = std::abs(number_or(json, "xmag", 0.0));
  const auto ymag = std::abs(number_or(json, "ymag", 0.0));
  camera.half_height = ymag;
  camera.aspect = ymag > 0.0 ? xmag / ymag : 0.0;
  if (!(camera.aspect > 0.0) || !std::isfinite(camera.aspect))
    throw InputError(document.file, where,
                     fmt::format("xmag {} and ymag {} show no area", xmag, ymag));
}

/// What a camera's extras say, or those of its node, as Blender writes custom properties:
///   fstop, focus_distance (metres)   depth of field: a thin lens of radius f / (2 fstop)
///   focal_length (millimetres)       f; otherwise that of 36 mm across the frame's longer side
///   sensor_fit                       AUTO, HORIZONTAL or VERTICAL (if left out), Blender's names
static double extra_number(const Json& extras, const char* key) {
  const auto* value = find(extras, key);
  return value && value->is_number() ? value->get<double>() : 0.0;
}

static void read_lens(const Json& extras, Camera& camera, const std::string& where,
                      Findings& findings) {
  if (!extras.contains("fstop") && !extras.contains("focus_distance"))
    return;
  constexpr double sensor = 0.036; // metres
  const auto fstop = extra_number(extras, "fstop");
  const auto distance = extra_number(extras, "focus_distance");
  const auto given = 1e-3 * extra_number(extras, "focal_length");
  const auto across = 2.0 * std::tan(0.5 * camera.vertical_fov) * std::max(1.0, camera.aspect);
  const auto radius = 0.5 * (given > 0.0 ? given : sensor / across) / fstop;
  const bool possible = fstop > 0.0 && distance > 0.0 && std::isfinite(distance) &&
                        std::isfinite(radius) && camera.projection == Projection::perspective;
  if (!possible) {
    findings.about("depth of field is left out, which takes a positive fstop and focus_distance and "
                   "is not for orthographic cameras, in cameras",
                   where);
    return;
  }
  camera.lens_radius = radius;
  camera.focus_distance = distance;
}

static void read_extras(const Json& owner, Camera& camera, const std::string& where,
                        Findings& findings) {
  const auto* extras = find(owner, "extras");
  if (!extras || !extras->is_object())
    return;
  read_lens(*extras, camera, where, findings);
  const auto* fit = find(*extras, "sensor_fit");
  if (!fit)
    return;
  if (*fit == "HORIZONTAL")
    camera.sensor_fit = SensorFit::horizontal;
  else if (*fit == "AUTO")
    camera.sensor_fit = SensorFit::longer;
  else if (*fit == "VERTICAL")
    camera.sensor_fit = SensorFit::vertical;
  else
    findings.about("sensor_fit that is not AUTO, HORIZONTAL or VERTICAL is left out in cameras",
                   where);
}

/// What is no distance cuts nothing.
static double znear_of(const Json& projection) {
  const auto znear = number_or(projection, "znear", 0.0);
  return znear > 0.0 && std::isfinite(znear) ? znear : 0.0;
}

static Camera read_camera(const Document& document, std::size_t index, Findings& findings) {
  const auto where = place(document.root, "cameras", index);
  const auto& json = element(document.root, "cameras", index);
  const auto type = text_or(json, "type", "");
  const auto* projection =
      type == "perspective" || type == "orthographic" ? find(json, type) : nullptr;
  if (!projection)
    throw InputError(document.file, where,
                     fmt::format("no projection of its type '{}'", one_line(type)));
  Camera camera;
  if (type == "perspective")
    read_perspective(document, where, *projection, camera, findings);
  else
    read_orthographic(document, where, *projection, camera);
  camera.znear = znear_of(*projection);
  read_extras(json, camera, where, findings);
  return camera;
}

namespace {

/// From farther away, in scenes, or in a view as wide, nothing is seen of the scene,
/// and the light that comes from there comes from one direction;
/// but rays would leave the range of Embree's floats.
constexpr double farthest = 1e12;

struct Reach {
  Point3 centre;
  double distance;
};

} // namespace

static Reach reach_of(const Scene& scene) {
  const auto bounds = bounds_of(scene);
  const auto size = bounds.high - bounds.low;
  return {0.5 * bounds.low + 0.5 * bounds.high, farthest * std::max({size.x, size.y, size.z})};
}

/// Brings a position within reach. How many times as far away it was before.
static double bring_near(const Reach& reach, Point3& position) {
  const auto away = position - reach.centre;
  const auto distance = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
  if (distance <= reach.distance)
    return 1.0;
  position = reach.centre + away / distance * reach.distance;
  return distance / reach.distance;
}

static void bring_near(const Reach& reach, Camera& camera, Findings& findings) {
  const bool moved = bring_near(reach, camera.position) != 1.0;
  if (!moved && camera.half_height <= reach.distance)
    return;
  if (moved)
    camera.znear = 0.0; // it was measured from elsewhere
  findings.about("cameras were moved nearer or narrowed: they were too far away or too wide to see the scene",
                 camera.name);
  camera.half_height = std::min(camera.half_height, reach.distance);
}

std::string first_name(const Document& document, std::size_t node, std::string_view array,
                       std::size_t index, std::string_view kind) {
  const auto of_node = name_of(element(document.root, "nodes", node));
  if (!of_node.empty())
    return of_node;
  const auto own = name_of(element(document.root, array, index));
  return own.empty() ? fmt::format("{}{}", kind, index) : own;
}

void read_cameras(const Document& document, std::span<const PlacedNode> nodes, Scene& scene,
                  Findings& findings) {
  std::vector<std::string> names;
  for (const auto& node : nodes) {
    const auto index = index_at(element(document.root, "nodes", node.index), "camera");
    if (!index)
      continue;
    auto camera = read_camera(document, *index, findings);
    const auto name = first_name(document, node.index, "cameras", *index, "camera");
    read_extras(element(document.root, "nodes", node.index), camera, name, findings);
    if (!orient(camera, node.world)) {
      findings.about("cameras scaled to nothing are left out", name);
      continue;
    }
    scene.cameras.push_back(camera);
    names.push_back(name);
  }
  const auto unique = unique_names(names);
  const auto reach = reach_of(scene);
  for (std::size_t k = 0; k < unique.size(); ++k) {
    scene.cameras[k].name = unique[k];
    bring_near(reach, scene.cameras[k], findings);
  }
}

static void read_cone(const Json& json, const std::string& name, PunctualLight& light,
                      Findings& findings) {
  if (const auto* spot = find(json, "spot")) {
    light.inner_cone = number_or(*spot, "innerConeAngle", light.inner_cone);
    light.outer_cone = number_or(*spot, "outerConeAngle", light.outer_cone);
  }
  const auto outer = std::clamp(light.outer_cone, 1e-6, std::numbers::pi / 2.0);
  const auto inner = std::clamp(light.inner_cone, 0.0, outer);
  if (outer != light.outer_cone || inner != light.inner_cone)
    findings.about(
        "spot lights with cone angles out of order were clamped to 0 <= inner <= outer <= pi/2",
        name);
  light.outer_cone = outer;
  light.inner_cone = inner;
}

static PunctualLight read_light(const Document& document, std::size_t index,
                                const std::string& name, Findings& findings) {
  const auto where = place(document.root, "lights", index);
  const auto& json = element(document.root, "lights", index);
  const auto type = text_or(json, "type", "");
  PunctualLight light;
  if (type == "point")
    light.kind = PunctualKind::point;
  else if (type == "spot")
    light.kind = PunctualKind::spot;
  else if (type == "directional")
    light.kind = PunctualKind::directional;
  else
    throw InputError(document.file, where, fmt::format("type '{}' does not exist", one_line(type)));

  light.intensity = vec3_or(json, "color", Rgb(1.0)) * number_or(json, "intensity", 1.0) *
                    (document.settings.state.light_scale / light_unit(document));
  if (glm::any(glm::lessThan(light.intensity, Rgb(0.0)))) {
    findings.about("lights of negative intensity are dark", name);
    light.intensity = glm::max(light.intensity, Rgb(0.0));
  }
  if (!glm::all(glm::lessThan(light.intensity, Rgb(1e30))))
    throw InputError(document.file, where, "intensity is too large");
  if (light.kind == PunctualKind::spot)
    read_cone(json, name, light, findings);
  if (json.contains("range"))
    findings.about("the range of lights is left out: they follow the inverse square law", name);
  return light;
}

/// Without a node's place.
struct NodeLight {
  PunctualLight light;
  std::string name;
  Rgb colour{1.0}; ///< without its intensity
};

/// A profile says more than the light that stands beside it for those who read none.
static std::optional<NodeLight> light_of(const Document& document, std::size_t node,
                                         Findings& findings) {
  const Json& json = element(document.root, "nodes", node);
  const auto* profile = find(json, {"extensions", "EXT_lights_ies"});
  const auto* punctual = find(json, {"extensions", "KHR_lights_punctual"});
  if (profile) {
    const auto name = first_name(document, node, "iesLights", *index_at(*profile, "light"), "light");
    if (punctual)
      findings.about("lights that have an IES profile besides are those of the profile", name);
    return NodeLight{read_luminaire(document, *profile, name, findings), name,
                     glm::clamp(vec3_or(*profile, "color", Rgb(1.0)), 0.0, 1.0)};
  }
  if (!punctual)
    return std::nullopt;
  const auto index = *index_at(*punctual, "light");
  const auto name = first_name(document, node, "lights", index, "light");
  return NodeLight{
      read_light(document, index, name, findings), name,
      glm::max(vec3_or(element(document.root, "lights", index), "color", Rgb(1.0)), Rgb(0.0))};
}

void read_lights(const Document& document, std::span<const PlacedNode> nodes, Scene& scene,
                 Findings& findings) {
  std::vector<std::string> names;
  std::vector<LightPlace> places;
  for (const auto& node : nodes) {
    auto read = light_of(document, node.index, findings);
    if (!read)
      continue;
    auto& [light, name, colour] = *read;
    light.position = Vec3(node.world[3]);
    const auto direction = unit(-Vec3(node.world[2]));
    const auto frame = unit_frame(node.world);
    if ((!direction && light.kind != PunctualKind::point) || (!frame && light.distribution)) {
      findings.about("lights scaled to nothing are left out", name);
      continue;
    }
    light.direction = direction.value_or(light.direction);
    light.frame = frame.value_or(light.frame);
    light.lamp = lamp_of_node(document, node.index);
    scene.lights.push_back(std::move(light));
    names.push_back(name);
    places.push_back({colour, frame.has_value()});
  }
  const auto unique = unique_names(names);
  for (std::size_t k = 0; k < unique.size(); ++k)
    scene.lights[k].name = unique[k];
  put_luminaires(document, places, scene, findings);
  const auto reach = reach_of(scene);
  for (auto& light : scene.lights) {
    if (light.kind == PunctualKind::directional)
      continue;
    const auto nearer = bring_near(reach, light.position);
    light.intensity = light.intensity / nearer / nearer; // by the inverse square law as bright
  }
}

} // namespace meninas::gltf
