// Pass one for one view: elements that the view does not show are less exact, and take less time.
//
// Light is gathered twice (hierarchical/node_field.h). What elements send on is known after the first time,
// everywhere and as exactly as ever; the second, with more rays and by smaller nodes, is for what is looked at.
// So the field is that of the whole solution where it is seen, and elsewhere that of the first gathering.
// Importance-driven radiosity: Smits, Arvo and Salesin 1992.
#pragma once

#include "radiosity/pass_one.h"

namespace meninas {

/// By ElementId of the mesh, 1: it is seen.
using SeenElements = std::vector<std::uint8_t>;

/// As solve_pass_one(). A cut at the leaves is found everywhere, whatever is seen.
RadiositySolution solve_for_view(const std::shared_ptr<const LightScene>& light,
                                 const PassOneSettings& settings, const SeenElements& seen,
                                 const Progress& progress = {}, const PassOneWatch& watch = {});

} // namespace meninas
