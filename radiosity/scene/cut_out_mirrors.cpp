#include "radiosity/scene/cut_out_mirrors.h"

#include "scenes/rays/frame_geometry.h"

namespace meninas {

std::array<MirrorId, 2> mirrors_of(const SurfaceModel& surfaces, const MirrorSet& mirrors,
                                          TriangleId triangle) {
  const PatchId patch = surfaces.patch_of_triangle[index(triangle)];
  if (patch == none<PatchId>)
    return {none<MirrorId>, none<MirrorId>};
  return mirrors.mirror_of_surface[index(surfaces.patches[index(patch)].surface)];
}

std::vector<std::uint8_t> cut_out_mirrors(const SurfaceModel& surfaces, const RayScene& rays,
                                          const MirrorSet& mirrors) {
  std::vector<std::uint8_t> cut_out;
  const auto& facts = rays.geometry().facts;
  for (std::uint32_t t = 0; t < facts.size(); ++t) {
    if (!facts[t].cut_out)
      continue;
    for (const MirrorId mirror : mirrors_of(surfaces, mirrors, TriangleId{t}))
      if (mirror != none<MirrorId>) {
        cut_out.resize(mirrors.mirrors.size(), 0);
        cut_out[index(mirror)] = 1;
      }
  }
  return cut_out;
}

} // namespace meninas
