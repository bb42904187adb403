#include "radiosity/field/view/view_receivers.h"

#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/field/vertex_places.h"

#include <algorithm>
#include <cmath>

namespace meninas {

static const MeshSide& side_with(const ElementMesh& mesh, ElementId element) {
  return mesh.sides[index(mesh.side_of_element[index(element)])];
}

Receiver receiver_of(const LightScene& light, const SeenPoint& point) {
  const ElementId element{point.element};
  const MeshSide& side = side_with(light.mesh, element);
  const Point3 at = point_at(light.surfaces.patches[index(side.patch)],
                             patch_uv_of(light.mesh, cell_of(light.mesh, element), Vec2(point.st)));
  return received_on_curve(light, side, at,
                           {at, side.normal, side.plane_class, side.tangent, side.coat});
}

Point3 place_of(const LightScene& light, const LatticeCells& cells, const LatticeVertex& vertex) {
  const MeshSide& side = side_with(light.mesh, vertex.element);
  return point_at(light.surfaces.patches[index(side.patch)], cells.place_in_patch(vertex));
}

Receiver receiver_of(const LightScene& light, const LatticeCells& cells,
                     const LatticeVertex& vertex) {
  constexpr double inset = 0.02;
  const ElementMesh& mesh = light.mesh;
  const MeshSide& side = side_with(mesh, vertex.element);
  const Point3 at = place_of(light, cells, vertex);
  Receiver receiver{nearest_in(mesh, vertex.element, at), side.normal, side.plane_class,
                    side.tangent, side.coat};
  if (cells.is_at_border(vertex)) {
    // Even in small cells it keeps a distance from the border by which places are told apart.
    const Point3 centre = centre_of(mesh, vertex.element);
    const double way = glm::distance(receiver.position, centre),
                 least = 4.0 * light.surfaces.tolerance;
    const int levels = vertex.level - cell_of(mesh, vertex.element).level;
    const double share = way > 0.0 ? std::max(std::ldexp(inset, -levels), least / way) : 0.0;
    receiver.position = glm::mix(receiver.position, centre, std::min(share, 0.5));
  }
  return received_on_curve(light, side, at, receiver);
}

} // namespace meninas
