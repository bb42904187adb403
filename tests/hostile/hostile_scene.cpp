#include "tests/hostile/hostile_scene.h"

#include "scenes/sampling.h"
#include "tests/hostile/hostile_lights.h"
#include "tests/hostile/hostile_materials.h"
#include "tests/hostile/hostile_shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace meninas::test {

namespace {

Json turned(Random& random) {
  if (happens(random, 0.5))
    return Json::array({0.0, 0.0, 0.0, 1.0});
  const Direction axis = random.direction();
  const double half = happens(random, 0.3) ? 0.25 * std::numbers::pi * choose(random, 4)
                                           : random.between(0.0, std::numbers::pi);
  const Vec3 v = std::sin(half) * axis;
  return Json::array({v.x, v.y, v.z, std::cos(half)});
}

/// The file in the making, in metres before all is scaled and moved.
struct Maker {
  explicit Maker(std::uint32_t seed) : random(seed) {}

  Random random;
  GltfFile file;
  std::vector<std::size_t> materials;
  Json children = Json::array();
  std::vector<Point3> corners; ///< of bodies, where cameras and lights may stand

  /// Lamps go by names of nodes, or by one that several share, which may be that of all.
  void name_lamp(Json& node) {
    static constexpr std::array names{"a lamp", "sky", "all", "", "a=b;c", "\xc3\xa4"};
    if (happens(random, 0.15))
      node["extras"]["lamp"] = names[choose(random, names.size())];
  }

  /// Copies in places, sizes and turns of any kind, some of no size.
  Json instances() {
    const auto count = 1 + choose(random, 6);
    std::vector<float> places, turns, sizes;
    const auto add = [](std::vector<float>& values, const Vec3& v) {
      for (int d = 0; d < 3; ++d)
        values.push_back(static_cast<float>(v[d]));
    };
    for (std::uint32_t k = 0; k < count; ++k) {
      add(places, happens(random, 0.2) ? Vec3(0.0) : random.in_box(Vec3(-1.5), Vec3(1.5)));
      add(turns, random.direction());
      turns.push_back(static_cast<float>(random.between(-1.0, 1.0)));
      Vec3 size(happens(random, 0.7) ? 1.0 : power_of_ten(random, -7.0, 2.0));
      if (happens(random, 0.1))
        size[static_cast<int>(choose(random, 3))] *= happens(random, 0.5) ? 0.0 : -1.0;
      add(sizes, size);
    }
    Json attributes = Json::object();
    if (happens(random, 0.9))
      attributes["TRANSLATION"] = file.add_accessor(places, "VEC3");
    if (happens(random, 0.5))
      attributes["ROTATION"] = file.add_accessor(turns, "VEC4");
    if (attributes.empty() || happens(random, 0.5))
      attributes["SCALE"] = file.add_accessor(sizes, "VEC3");
    return attributes;
  }

  /// Positions are floats, and often quantised before.
  void add_body(const Shape& shape, const Json& placing) {
    std::vector<float> positions, colours;
    const double grain = happens(random, 0.1) ? std::ldexp(1.0, -14) : 0.0;
    for (const Point3& point : shape.points)
      for (int d = 0; d < 3; ++d)
        positions.push_back(static_cast<float>(grain > 0.0 ? grain * std::round(point[d] / grain)
                                                           : point[d]));
    Json attributes{{"POSITION", file.add_accessor(positions, "VEC3")}};
    if (happens(random, 0.1)) {
      for (std::size_t k = 0; k < shape.points.size() * 3; ++k)
        colours.push_back(static_cast<float>(hostile_factor(random)));
      attributes["COLOR_0"] = file.add_accessor(colours, "VEC3");
    }
    const auto mesh = file.add_mesh(
        Json::array({{{"attributes", attributes},
                      {"indices", file.add_accessor(shape.corners, "SCALAR")},
                      {"material", materials[choose(random, std::uint32_t(materials.size()))]}}}));
    Json node = placing;
    node["mesh"] = mesh;
    node["name"] = "body" + std::to_string(children.size());
    if (happens(random, 0.1))
      node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = instances();
    name_lamp(node);
    children.push_back(file.add_node(node));
  }

  /// One of many as it stands or turned, stretched, turned inside out.
  void add_bodies() {
    const auto count = happens(random, 0.3) ? 1 : 1 + choose(random, 8);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Shape shape = hostile_shape(random);
      const Vec3 at = happens(random, 0.2) ? Vec3(0.0) : random.in_box(Vec3(-1.5), Vec3(1.5));
      Vec3 stretch(happens(random, 0.8) ? 1.0 : power_of_ten(random, -5.0, 2.0));
      if (happens(random, 0.15))
        stretch[static_cast<int>(choose(random, 3))] *= power_of_ten(random, -6.0, 1.0);
      if (happens(random, 0.1))
        stretch.x = -stretch.x;
      add_body(shape, {{"translation", as_json(at)},
                       {"rotation", turned(random)},
                       {"scale", as_json(stretch)}});
      corners.push_back(at);
    }
  }

  /// A room around all, whose walls are a body each, some of them missing.
  void add_room() {
    const Shape walls = box(Point3(-2.0), Point3(2.0, 1.5, 2.5), true);
    for (std::uint32_t wall = 0; wall < 6; ++wall) {
      if (happens(random, 0.1))
        continue;
      Shape part;
      part.add_fan({walls.points.begin() + 4 * wall, walls.points.begin() + 4 * wall + 4});
      add_body(part, Json::object());
    }
    corners.insert(corners.end(), {Point3(-2.0), Point3(2.0, 1.5, 2.5)});
  }

  Point3 place() {
    const Point3 corner = corners[choose(random, std::uint32_t(corners.size()))];
    switch (choose(random, 4)) {
    case 0:
      return corner;
    case 1:
      return random.in_box(Vec3(-1.4), Vec3(1.4));
    case 2:
      return corner + offset_of_any_size(random, -7.0, 0.0);
    default:
      return offset_of_any_size(random, 0.0, 5.0);
    }
  }

  void add_lights(double scale) {
    static constexpr std::array kinds{"point", "spot", "directional"};
    Json lights = Json::array();
    for (std::uint32_t k = 0, count = choose(random, 3); k < count; ++k) {
      Json light{{"type", kinds[choose(random, 3)]},
                 {"intensity", power_of_ten(random, -2.0, 3.0) * scale * scale}};
      if (light["type"] == "directional")
        light["intensity"] = power_of_ten(random, -2.0, 2.0);
      if (light["type"] == "spot")
        light["spot"] = {{"innerConeAngle", 0.0}, {"outerConeAngle", power_of_ten(random, -3, 0.15)}};
      lights.push_back(light);
      children.push_back(
          file.add_node({{"translation", as_json(place())},
                         {"rotation", turned(random)},
                         {"extensions", {{"KHR_lights_punctual", {{"light", k}}}}}}));
    }
    if (!lights.empty())
      file.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    if (happens(random, 0.2))
      add_luminaire(scale);
  }

  /// EXT_lights_area: of any size and width, some in the plane of a wall, in a corner or behind the room.
  void add_area_lights() {
    Json lights = Json::array();
    for (std::uint32_t k = 0, count = 1 + choose(random, 3); k < count; ++k) {
      const double size = happens(random, 0.5) ? 0.5 : power_of_ten(random, -7.0, 2.0);
      const double aspect = happens(random, 0.5) ? 1.0 : power_of_ten(random, -5.0, 2.0);
      Json light{{"type", happens(random, 0.5) ? "rect" : "disk"},
                 {"size", size},
                 {"color", as_json(hostile_colour(random))},
                 {"intensity", power_of_ten(random, -2.0, 3.0)}};
      if (light["type"] == "rect")
        light["rect"]["aspect"] = aspect;
      else
        light["extras"]["aspect"] = aspect;
      lights.push_back(light);
      Json node{{"translation", as_json(place())}, {"rotation", turned(random)}};
      if (happens(random, 0.1))
        node["scale"] = as_json(Vec3(1.0, -power_of_ten(random, -6.0, 1.0), 1.0));
      node["extensions"]["EXT_lights_area"]["light"] = k;
      name_lamp(node);
      children.push_back(file.add_node(node));
    }
    file.json["extensions"]["EXT_lights_area"]["lights"] = lights;
  }

  void add_luminaire(double scale) {
    const std::string text = hostile_luminaire(random);
    file.json["extensions"]["EXT_lights_ies"]["lights"] =
        Json::array({{{"uri", data_uri({text.begin(), text.end()})}}});
    Json node{{"translation", as_json(place())}, {"rotation", turned(random)}};
    node["extensions"]["EXT_lights_ies"] = {{"light", 0},
                                            {"multiplier", power_of_ten(random, -2.0, 3.0) * scale * scale},
                                            {"color", as_json(hostile_colour(random))}};
    name_lamp(node);
    children.push_back(file.add_node(node));
  }

  void add_camera() {
    if (happens(random, 0.2))
      return; // the program finds one
    Json camera{{"type", "perspective"}, {"perspective", {{"znear", 0.01}}}};
    camera["perspective"]["yfov"] = happens(random, 0.8) ? 0.8 : power_of_ten(random, -4.0, 0.45);
    if (happens(random, 0.2))
      camera = {{"type", "orthographic"},
                {"orthographic",
                 {{"xmag", 2.0}, {"ymag", power_of_ten(random, -3, 1)}, {"znear", 0}, {"zfar", 9}}}};
    file.json["cameras"] = Json::array({camera});
    children.push_back(file.add_node(
        {{"translation", as_json(place())}, {"rotation", turned(random)}, {"camera", 0}}));
  }

  /// A node above all that brings the scene to its scale and its place.
  GltfFile finished(double scale) {
    const Vec3 offset = happens(random, 0.8)
                            ? Vec3(0.0)
                            : scale * offset_of_any_size(random, 0.0, 4.0);
    const auto root = file.add_node({{"scale", as_json(Vec3(scale))},
                                     {"translation", as_json(offset)},
                                     {"children", children}});
    file.json["scenes"] = Json::array({{{"nodes", {root}}}});
    file.json["scene"] = 0;
    return std::move(file);
  }
};

} // namespace

GltfFile hostile_scene(std::uint32_t seed) {
  Maker maker(seed);
  Random& random = maker.random;
  for (std::uint32_t k = 0, count = 1 + choose(random, 4); k < count; ++k)
    maker.materials.push_back(maker.file.add_material(hostile_material(random)));
  const double scale = happens(random, 0.6) ? 1.0 : power_of_ten(random, -4.0, 6.0);
  maker.add_bodies();
  if (happens(random, 0.4))
    maker.add_room();
  maker.add_lights(scale);
  maker.add_camera();
  // Drawn apart: seeds that found something make what they made.
  const Random as_before = std::exchange(maker.random, Random(hash(seed, 0xa7ea)));
  if (happens(random, 0.3))
    maker.add_area_lights();
  maker.random = as_before;
  return maker.finished(scale);
}

} // namespace meninas::test
