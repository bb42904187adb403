// Materials, textures and cameras of a solved scene, as glTF viewers take them.
//
// Lit faces are unlit (KHR_materials_unlit): their light is in COLOR_0, times the texture; alphaMode
// MASK and BLEND are those of the scene. Mirrors are metals of roughness 0, rougher metals that pass
// one takes for mirrors have their own, panes and solids of glass are KHR_materials_transmission,
// _ior and _volume. Dark faces are unlit and black.
#pragma once

#include "radiosity/solution/glb_arrays.h"
#include "radiosity/solution/shown_faces.h"

#include <map>

namespace meninas {

/// The `materials`, `textures`, `samplers` and `images` of a document, each once.
class ViewerMaterials {
public:
  explicit ViewerMaterials(const Scene& scene) : scene_(scene) {}

  /// Its number.
  std::size_t add(const ShownPiece& piece);

  /// Puts the lists into the document, and the images into its binary chunk.
  void write(nlohmann::json& root, GlbArrays& glb) const;

private:
  nlohmann::json texture_info(const TextureUse& use);
  nlohmann::json lit(const Material& material);
  nlohmann::json lobe(const Material& material);

  const Scene& scene_;
  nlohmann::json materials_ = nlohmann::json::array(), textures_ = nlohmann::json::array();
  std::vector<TextureId> used_;
  std::map<std::pair<MaterialId, ShownAs>, std::size_t> known_;
};

/// `cameras` and their nodes, in world space. A panorama becomes a view straight ahead of 90 degrees.
/// Lens and sensor are in `extras`, as the loader reads them (docs/input.md).
struct ViewerCameras {
  nlohmann::json cameras = nlohmann::json::array(), nodes = nlohmann::json::array();
};
ViewerCameras viewer_cameras(const Scene& scene);

} // namespace meninas
