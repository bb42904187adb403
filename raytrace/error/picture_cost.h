// The cost of a picture in pass two, before it: seconds and bytes.
//
//   seconds = pixels x (samples x one camera ray with its diffuse term
//                       + vertices of the view's field x one hit with direct light)
//   bytes = pixels x (planes of floats while it is rendered and while it is encoded
//                     + the cells of the view's field and the points that are seen)
//
// A few thousandths of the rays are traced to see how long one takes here, in this scene.
#pragma once

#include "raytrace/render.h"

namespace meninas {

/// Seconds elapsed, by all threads together; the size is that of the settings.
double expected_render_seconds(const std::shared_ptr<const LightScene>& light, const Camera& camera,
                               RenderSettings settings);

/// Bytes of so many pixels with so many RGB planes; with the view's field where direct light is found by pixels.
double expected_picture_bytes(double pixels, double planes, DiffuseTerm term);

} // namespace meninas
