// Lamps of many faces: neon tubes and bulbs of hundreds to thousands of triangles.
//
// Of N emitters' images a point computes K, chosen so that the sum is right on average
// (mirror/light_choice.h). Of a lamp whose faces are small and alike an eighth of K tells nearly as much:
// the estimates that faces are chosen by are nearly right, its shadow rays go to many of them, and
// the points of an element choose others each. Such faces as receive light themselves have it from
// few images at few points: they receive little beside what they emit, and errors of many cancel.
// Limit: hundreds of lamps that stand apart have the same eighth, with three times the noise.
#pragma once

#include "radiosity/scene/lighting.h"

namespace meninas {

inline bool has_lamp_of_many_faces(const Lighting& light) {
  constexpr std::size_t many = 256;
  return light.emitters.size() > many;
}

/// K, where so many images are asked for.
inline std::size_t images_to_choose(const Lighting& light, std::size_t asked) {
  constexpr std::size_t fewest = 4;
  return has_lamp_of_many_faces(light) ? std::max(asked / 8, std::min(asked, fewest)) : asked;
}

/// Whether an element is a lamp's and far smaller than elements are asked to be.
inline bool is_face_of_lamp(const Lighting& light, ElementId element) {
  constexpr double far_smaller = 1.0 / 16.0;
  const ElementMesh& mesh = light.scene.mesh;
  const double size = mesh.sides[index(mesh.side_of_element[index(element)])].element_size;
  return has_lamp_of_many_faces(light) && mesh.emission[index(element)] != Rgb(0.0) &&
         mesh.area[index(element)] < far_smaller * size * size;
}

} // namespace meninas
