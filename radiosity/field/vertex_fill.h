// Values for vertices that have none of their own:
// those covered by something that stands on their surface. Interpolated towards them the field must
// not darken, so they take the mean of the valued vertices of their elements, ring by ring.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <vector>

namespace meninas {

/// `valid` by ElementVertexId;
/// values of invalid vertices are replaced, up to two rings in. The rest become zero.
void fill_vertices(const ElementMesh& mesh, std::vector<std::uint8_t> valid,
                   std::vector<glm::vec3>& values);

} // namespace meninas
