// Point and spot lights that shine into nothing but a closed opaque body.
//
// A light that an exporter has put into an opaque bulb or lampshade lights nothing that is seen.
// It is inside of a body (closed_bodies.h) that winds around it once, if no camera is in there too
// and the body is no room: a room shows its fronts inside, or is as large as half the scene.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <string>
#include <utility>
#include <vector>

namespace meninas {

/// The light and the node of the body's first face, in the order of lights.
using EnclosedLight = std::pair<std::string, std::string>;

std::vector<EnclosedLight> enclosed_lights(const Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
