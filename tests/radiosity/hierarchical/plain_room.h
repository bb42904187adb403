// A closed room without furniture, one wall of which glows: the light changes towards its edges.
#pragma once

#include "tests/support/scene_builder.h"

namespace meninas::test {

inline Scene plain_room() {
  Scene scene;
  const Material wall = diffuse(0.7);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, diffuse(0.5, 1.0), wall, wall});
  return scene;
}

} // namespace meninas::test
