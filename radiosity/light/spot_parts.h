// The parts of elements that spots shine on.
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
// of the elements.
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
  RegionElement lit;  ///< the part; without triangles where it is all of the element

  bool is_whole() const { return lit.triangles.empty(); }
};

/// The narrow spots and their images that shine on an element, light by light in every world.
std::vector<SpotPart> narrow_spots(const ElementMesh& mesh, const WorldTree& worlds,
                                   std::span<const PunctualLight> lights, ElementId element);

/// Elements divided until four of them lie across any spot that shines on them, at most six times.
/// A division that would make more than twice the elements there were, and 2,000 more, or more than
/// `max_elements`, is left out.
ElementMesh divide_under_spots(ElementMesh mesh, const Scene& scene, const SurfaceModel& surfaces,
                               const WorldTree& worlds, std::size_t max_elements);

} // namespace meninas
