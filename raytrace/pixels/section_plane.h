// The plane at which a camera cuts the scene open: glTF's `znear`, as a section through a building.
//
// Camera rays start in the plane dot(x - eye, forward) = znear, so what is nearer is not seen by
// them; light, mirrors and shadows know nothing of it. Where nothing is nearer in the picture, rays
// start at the eye, and so do those of panoramas, which have no such plane.
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// The camera with `section` set, in metres, if a picture as wide as that (width / height) would
/// show something nearer than its `znear`: not the backs that cameras look through, nor what is
/// in the plane to 2e-5 of the scene's radius, which is cut away only with something else.
Camera with_section(const Scene& scene, Camera camera, double picture_aspect);

} // namespace meninas
