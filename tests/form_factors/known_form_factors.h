// Form factors with known values, 18 digits evaluated in higher precision and rounded to double.
#pragma once

#include "scenes/types.h"

#include <string>
#include <vector>

namespace meninas::test {

/// Point to polygon: Lambert 1760, (1/2pi) sum Theta_k (n .
/// Gamma_k), after clipping to the horizon.
struct PointCase {
  const char* name;
  Point3 point;
  Direction normal;
  std::vector<Point3> polygon;
  double form_factor;
};
std::vector<PointCase> known_point_form_factors();

/// Polygon a to polygon b, alone in the world.
struct PairCase {
  const char* name;
  const char*
      formula; ///< C-nn: the number in J. R. Howell's catalogue of radiation configuration factors
  std::vector<Point3> a, b;
  double form_factor;
};
std::vector<PairCase> known_pair_form_factors();
/// Sizes and distances from 1e-6 to 1e6: too small or too rare for rays in single precision.
std::vector<PairCase> known_extreme_pair_form_factors();
/// Regular polygons for two discs.
std::vector<PairCase> known_disc_polygon_form_factors();

/// Scenes of several polygons: with blockers, and with mirrors. All reflections count.
enum class Role { diffuse, mirror, blocker };
struct ScenePolygon {
  const char* name;
  Role role;
  std::vector<Point3> corners;
};
struct SceneCase {
  const char* name;
  const char* formula;
  const char* scene;
  const char* from;
  const char* to;
  double mirror_reflectance;
  double form_factor;
  int depth = 1'000'000; ///< images with up to that many reflections
};
std::vector<ScenePolygon> known_scene(const std::string& name);
std::vector<SceneCase> known_scene_form_factors();

/// Facing mirrors to a depth: scenes of known_scene().
std::vector<SceneCase> known_depth_form_factors();
/// Strips without end between perfect mirrors.
std::vector<ScenePolygon> known_strips(const std::string& name);
std::vector<SceneCase> known_strip_form_factors();
/// Faces of closed solids.
std::vector<ScenePolygon> known_solid(const std::string& name);
std::vector<SceneCase> known_solid_form_factors();

} // namespace meninas::test
