// The context that all tiles of a picture share: scene, settings, camera and its samples.
#pragma once

#include "raytrace/beams/frustum.h"
#include "raytrace/diffuse_term.h"
#include "raytrace/pixels/camera_rays.h"
#include "raytrace/render_settings.h"

#include <vector>

namespace meninas {

/// 1 for pixels that are meant, row by row.
using PixelMask = std::vector<std::uint8_t>;

/// Samples by their number: any first 2^k of a pixel are stratified, and so are the 2^k after 2^k.
struct SampleRange {
  int first = 0, count = 1;
};

/// Everything the tiles share.
struct RenderContext {
  const LightScene& light;
  const VisibleLight& visible;
  const PointGathering* gathering; ///< of the diffuse term `gather`, else null
  const RenderSettings& settings;
  CameraFrame camera;
  std::vector<std::uint32_t> net_x, net_y; ///< stratified points of the pixel, as integers
  const PixelMask* chosen = nullptr;       ///< pixels of the picture to be traced; null: all
  const FilterPlaces* filter = nullptr;    ///< null: the box, whose points are where they are
  double footprint_samples = 1.0;          ///< that share a pixel: these and those before
  std::uint32_t first_sample = 0;          ///< number of the first of these points
  std::vector<Bsdf>
      bsdfs; ///< by MaterialId, of those with lobes and without textures; empty where none has lobes
  DiffuseSettings behind_lobes; ///< where many rays of a pixel land by way of one
  std::vector<std::uint8_t>
      blurred; ///< by WorldId: 1 where one of its mirrors has a lobe of its own, which rays follow
  std::vector<FrustumFace> frustum_faces; ///< for coherent_beams.h; empty: all rays are traced
  std::vector<std::uint32_t> net_u, net_v; ///< likewise of the lens; empty where there is none
};

inline bool is_chosen(const RenderContext& context, int x, int y) {
  return !context.chosen || (*context.chosen)[static_cast<std::size_t>(y) *
                                                  static_cast<std::size_t>(context.settings.width) +
                                              static_cast<std::size_t>(x)] != 0;
}

} // namespace meninas
