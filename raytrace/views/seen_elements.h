// The elements that a view shows, which pass one solves more exactly for that view.
//
// Paths are followed from the eye, one through each of so many points of the picture, by ideal mirrors, through
// glass and by one direction of every lobe (glossy_frustum.h), while their throughput is at least `min_throughput`.
// Where a path through ideal mirrors ends (sight.h), direct light is computed per pixel if the diffuse term
// asks for it (diffuse_term.h). Surfaces seen by lobes, pane reflections or refraction show the field's direct light.
// The elements in which they end are seen, and those that share a vertex with them: pixels in between see these.
// Direct light of the field weighs as much as the largest throughput of these paths.
// Radiosity with as much care as the view needs: importance (Smits, Arvo and Salesin 1992).
#pragma once

#include "radiosity/pass_one.h"
#include "raytrace/render_settings.h"
#include "scenes/camera.h"

namespace meninas {

/// The seen elements of the scene's mesh. Limits: at most 2^19 paths; elements seen only by directions of a lobe
/// between these paths, or by less than `min_throughput`, count as not seen.
SeenElements seen_elements(const LightScene& light, const Camera& camera,
                           const RenderSettings& settings);

} // namespace meninas
