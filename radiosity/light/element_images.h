// The emitters' images that all points of an element see alike (mirror/region_images.h), cached for
// elements at which many points are asked for.
#pragma once

#include "mirror/region_images.h"
#include "radiosity/scene/lighting.h"

#include <vector>

namespace meninas {

/// The cached images of the elements asked for last; one cache for each thread, and for one scene.
struct ElementImages {
  struct Slot {
    ElementId element = none<ElementId>;
    std::uint32_t asked = 0;
    RegionImages images; ///< known once it has been asked for often
  };
  std::vector<Slot> slots; ///< by element, as many as there are places
};

/// The emitter images that all points of an element see alike. Computing them costs as much as several
/// points do, so the first fifteen calls for an element return null.
const RegionImages* images_of_element(const Lighting& light, ElementId element,
                                      ElementImages& known);

} // namespace meninas
