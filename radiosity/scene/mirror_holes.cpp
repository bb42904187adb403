#include "radiosity/scene/mirror_holes.h"

#include "radiosity/scene/cut_out_mirrors.h"
#include "scenes/rays/careful_rays.h"

#include <algorithm>

namespace meninas {

bool is_solid_at(const LightScene& light, MirrorId mirror, const Point3& x) {
  const FrameGeometry& geometry = light.rays.geometry();
  const std::uint32_t plane = index(light.mirrors.mirrors[index(mirror)].plane_class);
  const Point3 at = to_frame(geometry.frame, x);
  // The triangles of a plane are off it by no more than the noise.
  const Contacts contacts = contacts_of(light.rays, glm::vec3(at), plane, geometry.noise);
  return std::ranges::any_of(contacts.own, [&](const ContactTriangle& there) {
    return std::ranges::count(mirrors_of(light.surfaces, light.mirrors, there.triangle), mirror) !=
               0 &&
           !is_hole(geometry, index(there.triangle), nearest_barycentric(there.corners, at));
  });
}

bool meets_hole(const LightScene& light, WorldId world, std::span<const Leg> legs) {
  if (light.cut_out_mirrors.empty())
    return false;
  const auto& chain = chain_of(light.worlds, world);
  for (std::size_t step = 0; step < chain.size(); ++step)
    if (light.cut_out_mirrors[index(chain[step])] != 0 &&
        !is_solid_at(light, chain[step], legs[step].to))
      return true;
  return false;
}

} // namespace meninas
