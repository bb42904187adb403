#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

std::vector<Stage> all_stages() {
  return {cornell(),     cornell_mirror(), mirror_spot(),  periscope(),    facing_mirrors(),
          sunbeam(),     lattice(),        glass_screen(), glass_solids(), roughness_sweep(),
          half_room(),   doubled_room(),   no_mirror(),    furnace(),      globillum_1(),
          globillum_2(), globillum_3(),    solar_row(),       meninas_room()};
}

} // namespace meninas::gallery
