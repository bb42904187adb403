#include "radiosity/light/element_images.h"

#include <array>

namespace meninas {

static void find_images(const Lighting& light, ElementId element, RegionImages& images) {
  const ElementMesh& mesh = light.scene.mesh;
  const MeshSide& side = mesh.sides[index(mesh.side_of_element[index(element)])];
  std::array<Point3, 4> corners;
  for (std::size_t c = 0; c < corners.size(); ++c)
    corners[c] = mesh.vertices[index(mesh.corners[index(element)][c])];
  images_of_region(
      light.worlds, light.emitters,
      {std::span(corners).first(side.triangle ? 3 : 4), side.normal, light.scene.surfaces.tolerance},
      images);
}

const RegionImages* images_of_element(const Lighting& light, ElementId element,
                                      ElementImages& known) {
  constexpr std::size_t places = 1024;
  constexpr std::uint32_t often = 16;
  known.slots.resize(places);
  ElementImages::Slot& slot = known.slots[index(element) % places];
  if (slot.element != element) {
    slot.element = element;
    slot.asked = 0;
  }
  if (slot.asked >= often)
    return &slot.images;
  if (++slot.asked < often)
    return nullptr;
  find_images(light, element, slot.images);
  return &slot.images;
}

} // namespace meninas
