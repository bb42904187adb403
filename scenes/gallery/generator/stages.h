// The scenes of the gallery, one function each; README.md beside the files says what each is for.
#pragma once

#include "scenes/gallery/generator/stage.h"

namespace meninas::gallery {

Stage cornell();
Stage cornell_mirror();
Stage mirror_spot();
Stage periscope();
Stage facing_mirrors();
Stage sunbeam();
Stage lattice();
Stage glass_screen();
Stage glass_solids();
Stage roughness_sweep();
Stage half_room();
Stage doubled_room();
Stage no_mirror();
Stage furnace();
Stage globillum_1();
Stage globillum_2();
Stage globillum_3();
Stage solar_row();
Stage meninas_room();

std::vector<Stage> all_stages();

} // namespace meninas::gallery
