// A stage: one sample scene before it is written as glTF. Named parts with a paint, and views.
//
// Metres, +Y up, right-handed;
// triangles are counter-clockwise seen from the front, and walls face into the room.
#pragma once

#include "scenes/types.h"

#include <array>
#include <string>
#include <vector>

namespace meninas::gallery {

enum class Finish {
  diffuse,
  metal,  ///< a mirror when its roughness is 0
  coated, ///< diffuse under a coat of varnish
  glass,  ///< a thin pane
  solid   ///< glass through and through
};

/// A small image of a few colours, rows from the top.
struct Picture {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> palette; ///< sRGB and alpha
  std::vector<std::uint8_t> texels;                 ///< entries of the palette
  bool mirrored = false;                            ///< beyond its edges, instead of repeated
  bool operator==(const Picture&) const = default;
};

/// A material by name:
/// `color` is the diffuse reflectance, the specular one of a metal, or the tint of glass.
struct Paint {
  std::string name;
  Rgb color{0.0};
  Finish finish = Finish::diffuse;
  Rgb radiance{0.0}; ///< emitted, W/m^2/sr
  double roughness = 1.0;
  Picture picture =
      {}; ///< a factor of `color`, if it has texels; cut out and seen from both sides if one of its colours is transparent
  double thickness = 0.0;    ///< of a solid, about, metres
  double transmission = 0.0; ///< share of a cloth's light that it passes evenly to its other side
};

inline Paint diffuse(std::string name, Rgb reflectance) { return {std::move(name), reflectance}; }

inline Paint metal(std::string name, Rgb reflectance, double roughness) {
  return {std::move(name), reflectance, Finish::metal, Rgb(0.0), roughness};
}
inline Paint mirror(std::string name, Rgb reflectance) {
  return metal(std::move(name), reflectance, 0.0);
}
inline Paint coated(std::string name, Rgb reflectance, double roughness) {
  return {std::move(name), reflectance, Finish::coated, Rgb(0.0), roughness};
}
inline Paint glass(std::string name, Rgb tint) {
  return {std::move(name), tint, Finish::glass, Rgb(0.0), 0.0};
}

/// Of light, `left` is what remains after its thickness.
inline Paint solid_glass(std::string name, Rgb left, double thickness) {
  return {std::move(name), left, Finish::solid, Rgb(0.0), 0.0, {}, thickness};
}

/// Reflects nothing, so that all its light is its own.
inline Paint light(std::string name, Rgb radiance) {
  return {std::move(name), Rgb(0.0), Finish::diffuse, radiance};
}

struct Mesh {
  std::vector<Point3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec2> texcoords = {}; ///< by position, or none
  std::vector<Rgb> colors = {};     ///< likewise: linear factors of the paint's
  std::vector<Vec3> normals = {};   ///< likewise: of the curved surface that the faces stand for
};

/// Becomes one glTF node, which is what a user asks for by name.
struct Part {
  std::string name;
  Paint paint;
  Mesh mesh;
};

struct View {
  std::string name;
  Point3 eye;
  Point3 target;
  double vertical_fov = 45.0; ///< degrees
  double aspect = 1.0;        ///< width / height
};

/// A lamp without extent, as of KHR_lights_punctual;
/// of a sun only the direction from `eye` to `target` counts.
struct Lamp {
  std::string name;
  std::string type;   ///< "point", "spot" or "directional"
  Rgb intensity{0.0}; ///< W/sr, or the sun's irradiance in W/m^2
  Point3 eye;
  Point3 target;
  double inner_cone = 0.0, outer_cone = 45.0; ///< of a spot, in degrees from its axis
};

struct Stage {
  std::string name;
  std::vector<Part> parts;
  std::vector<View> views;
  std::vector<Lamp> lamps = {};

  void add(std::string part, const Paint& paint, Mesh mesh) {
    parts.push_back({std::move(part), paint, std::move(mesh)});
  }
};

} // namespace meninas::gallery
