// The elements as triangles, without cracks:
// those beside smaller ones are cut at the vertices that hang on their edges.
#pragma once

#include "radiosity/element_mesh.h"

namespace meninas {

/// Three indices of vertices each, counter-clockwise seen from the side's own light.
std::vector<std::uint32_t> element_triangles(const ElementMesh& mesh);

} // namespace meninas
