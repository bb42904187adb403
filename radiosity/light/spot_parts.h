// The parts of elements on which single lights throw a spot: narrow cones, and lights close by.
//
// A spot at y along d sends nothing beyond its outer cone, cos(x - y, d) <= cos theta_o, and
// neither does its image at T_w y along T_w d in a mirror world w. A mean over an element that the
// cone meets in part R,
//
//   D = 1/A integral over R of tau_w I f(theta) cos / |x - y|^2 V dA,
//
// is taken at points of R: points of the whole element would miss a spot much smaller than it.
// R is cut out by the regular pyramid of eight sides around the cone, which is 5 % larger.
// A spot is narrow if its cone is less than sixteen elements wide. Wider spots are sampled at the points
// of the elements, unless the light is within the element's diameter of its middle: then
// most of the light falls about the foot of the light, I / h^2 at the height h, whatever the element's size.
//
// R is divided into triangles T no wider than half of their distance from y, and
//
//   integral over R = sum_k h(x_k) A_T / p_T / n,   h = I f cos / |x - y|^2 V,   p_T = omega_T / omega_R
//
// with the solid angles omega as seen from y (Van Oosterom and Strackee 1983) and x_k even over T: of a point light
// without shadows each sample is about I omega_R, which is right for any height.
// Limits: windows of mirrors do not cut R, so a spot by way of a mirror much smaller than an element
// may still be missed.
#pragma once

#include "mirror/worlds.h"
#include "radiosity/mesh/element_mesh.h"

namespace meninas {

/// The part of an element that one spot, or one image of it, can shine on, shadows aside.
struct SpotPart {
  std::uint32_t light = 0; ///< index into Scene::lights
  WorldId world = real_world;
  double width = 0.0; ///< of the cone at the element, m
  std::vector<std::array<Point3, 3>> triangles; ///< the part; none where it may be sampled as the element
  std::vector<double> solid_angle_up_to; ///< by triangle, sr: its own and of all before

  bool is_whole() const { return triangles.empty(); }
};

/// A point of a part, and the area that it stands for in the mean, m^2.
struct SpotSample {
  Point3 at;
  double area;
};
SpotSample sample_spot(const SpotPart& part, Vec2 st);

/// The narrow spots and their images that shine on an element, and the lights close by,
/// light by light in every world.
std::vector<SpotPart> spots_on(const ElementMesh& mesh, const WorldTree& worlds,
                                   std::span<const PunctualLight> lights, ElementId element);

/// Elements divided until four of them lie across any spot that shines on them, at most six times.
/// A division that would make more than twice the elements there were, and 2,000 more, or more than
/// `max_elements`, is left out.
ElementMesh divide_under_spots(ElementMesh mesh, const Scene& scene, const SurfaceModel& surfaces,
                               const WorldTree& worlds, std::size_t max_elements);

} // namespace meninas
