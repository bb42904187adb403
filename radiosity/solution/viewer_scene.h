// A solved scene as the part of a glTF 2.0 document that viewers show: nodes by name, cameras,
// materials with their textures, and the triangles of shown_faces.h with their colours.
//
// Positions are metres from the middle of the scene, to which the node "radiosity" takes them. All lit
// pieces share one array for every attribute; each names the range of it that its triangles use.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/solution/glb_arrays.h"

namespace meninas {

struct ViewerScene {
  nlohmann::json document; ///< but for its asset, buffers, bufferViews and accessors
  nlohmann::json field;    ///< by attribute (solution_format.h), the accessor of all values
  double scale = 1.0;      ///< COLOR_0 / B (viewer_colours.h), m^2/W
};
ViewerScene viewer_scene(GlbArrays& glb, const IrradianceField& field);

} // namespace meninas
