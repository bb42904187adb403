// The colours that viewers show lit faces with: the radiosity of pass one, W/m^2, exposed for a display.
//
//   COLOR_0 = s B,   B = E + rho H (+ tau H_behind),   s a power of 2^(1/16), clipped to [0, 1]
//
// linear, by point of the faces (shown_faces.h). The rho of textured faces is without the texture: a viewer
// multiplies. Unlit surfaces have B = pi L. Alpha is that of the file's vertices.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/solution/shown_faces.h"

namespace meninas {

struct ViewerColours {
  std::vector<glm::vec4> colours; ///< of the vertices of the mesh, then of the points of pieces
  double scale = 1.0;             ///< s, m^2/W
};
ViewerColours viewer_colours(const LightScene& light, const ShownFaces& faces,
                             const VertexIrradiance& field);

/// Values at the vertices of the mesh, and after them at the points of pieces.
std::vector<glm::vec3> with_points(const ElementMesh& mesh, const ShownFaces& faces,
                                   std::vector<glm::vec3> values);

} // namespace meninas
