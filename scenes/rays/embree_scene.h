// The triangles of a scene in Embree (Wald et al. 2014), ready for rays.
//
// Embree computes in floats: the frame is centred and scaled to the scene (frame_geometry.h).
// Rays are asked by the functions of ray_scene.h.
#pragma once

#include "scenes/rays/rays.h"
#include "scenes/scene.h"
#include "scenes/surfaces/surfaces.h"

#include <memory>

namespace meninas {

struct FrameGeometry;
struct EmbreeHandles; ///< embree_handles.h, for this folder alone

class RayScene {
public:
  /// Without `holes` all is opaque.
  RayScene(const Scene& scene, const SurfaceModel& surfaces, Holes holes = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  const RayFrame& frame() const;
  const FrameGeometry& geometry() const; ///< the triangles in the frame, scenes/rays/frame_geometry.h

  const EmbreeHandles& impl() const { return *impl_; }

private:
  std::unique_ptr<EmbreeHandles> impl_;
};

inline RayScene make_ray_scene(const Scene& scene, const SurfaceModel& surfaces, Holes holes = {}) {
  return {scene, surfaces, std::move(holes)};
}

} // namespace meninas
