#include "radiosity/mesh/small_surfaces.h"

#include <algorithm>

namespace meninas {

bool is_finely_tessellated(const ElementMesh& mesh) {
  constexpr double several = 4.0, many = 4096.0;
  double area = 0.0;
  for (const double own : mesh.area)
    area += own;
  const auto small = std::ranges::count_if(
      mesh.sides, [&](const MeshSide& side) { return is_small(mesh, side); });
  const auto count = static_cast<double>(small);
  return count > many && count * mesh.element_size * mesh.element_size > several * area;
}

} // namespace meninas
