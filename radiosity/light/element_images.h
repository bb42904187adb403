// What elements see of the emitters' images (mirror/region_images.h),
// kept for those that many points are asked of.
#pragma once

#include "mirror/region_images.h"
#include "radiosity/scene/lighting.h"

#include <vector>

namespace meninas {

/// Of the elements asked for last; one for each thread, and for one scene.
struct ElementImages {
  struct Slot {
    ElementId element = none<ElementId>;
    std::uint32_t asked = 0;
    RegionImages images; ///< known once it has been asked for often
  };
  std::vector<Slot> slots; ///< by element, as many as there are places
};

/// What all points of an element see alike.
/// Finding it takes as long as the images of some points do: null until so many have asked.
const RegionImages* images_of_element(const Lighting& light, ElementId element,
                                      ElementImages& known);

} // namespace meninas
