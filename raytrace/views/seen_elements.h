// Which elements a view shows: what pass one has to find for that view alone.
//
// Paths are followed from the eye, one through each of so many points of the picture, by ideal mirrors, through
// glass and by one direction of every lobe (lobe_grid.h), while their throughput is at least `min_throughput`.
// Of what a sight (sight.h) ends at, direct light is found for each pixel where the diffuse term says so (diffuse_term.h);
// of what lobes, the reflections of panes and refraction show it is that of the field.
// The elements in which they end are seen, and those that share a vertex with them: pixels in between see these.
// Direct light of the field weighs as much as the largest throughput of these paths.
// Radiosity with as much care as the view needs: importance (Smits, Arvo and Salesin 1992).
#pragma once

#include "radiosity/pass_one.h"
#include "raytrace/render_settings.h"
#include "scenes/camera.h"

namespace meninas {

/// Of the scene's mesh. Limits: at most 2^19 paths; light that a lobe shows in single directions between them,
/// or by less than `min_throughput`, comes from elements that count as not seen.
SeenElements seen_elements(const LightScene& light, const Camera& camera,
                           const RenderSettings& settings);

} // namespace meninas
