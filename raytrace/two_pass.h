// The two passes, from scene to picture: the page to read first is two_pass.cpp.
#pragma once

#include "radiosity/pass_one.h"
#include "raytrace/render.h"
#include "raytrace/two_pass_settings.h"

#include <memory>
#include <optional>

namespace meninas {

struct PreparationSeconds {
  double plan = 0.0; ///< surfaces and plan
  double mesh = 0.0; ///< elements, and what rays need to meet them
};

/// Everything about a scene that does not depend on the view, prepared once and kept together.
/// Fields that are found on it keep it (IrradianceField::scene): they outlive whoever prepared it.
struct PreparedScene : std::enable_shared_from_this<PreparedScene> {
  Scene scene;
  SurfaceModel surfaces;
  TransportPlan plan;
  DecodedTextures textures;
  ElementMesh mesh;
  std::optional<RayScene> rays;
  std::optional<LightScene> lit; ///< refers to the members above
  PreparationSeconds seconds;

  PreparedScene() = default;
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  /// Together with the scene that it refers to.
  std::shared_ptr<const LightScene> light() const { return {shared_from_this(), &*lit}; }
};
/// Textures that cannot be decoded are left out, with a warning of the plan.
std::shared_ptr<const PreparedScene> prepare_scene(Scene scene, const PassOneSettings& settings);

/// Whether pass one for a picture is less exact where that shows nothing: rooms of few patches are found whole in
/// little time, and have the picture of their stored solution to the bit.
bool solves_for_view(const PreparedScene& prepared, const TwoPassSettings& settings);

/// Pass one for one picture: above 8,192 patches exact where that shows it (views/seen_elements.h).
/// Its field tells apart what came by way of mirrors where the picture has layers, and nowhere else.
RadiositySolution solve_for_picture(const PreparedScene& prepared, const Camera& camera,
                                    const TwoPassSettings& settings, const Progress& progress = {},
                                    const PassOneWatch& watch = {});

struct TwoPassResult {
  RadiositySolution solution;
  Rendering rendering;
};
TwoPassResult two_pass(const PreparedScene& prepared, const Camera& camera,
                       const TwoPassSettings& settings, const Progress& progress = {},
                       const PassOneWatch& watch = {});

} // namespace meninas
