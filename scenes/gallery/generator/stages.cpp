#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

std::vector<Stage> all_stages() {
  return {cornell(),   cornell_mirror(), mirror_spot(),  periscope(),    facing_mirrors(),
          sunbeam(),   lattice(),        glass_screen(), glass_solids(), roughness_sweep(),
          half_room(), doubled_room(),   no_mirror(),    furnace(),      meninas_room()};
}

} // namespace meninas::gallery
