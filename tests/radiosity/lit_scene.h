// A scene with everything pass one looks light up in, kept together.
#pragma once

#include "radiosity/pass_one.h"

#include <memory>
#include <optional>
#include <string>

namespace meninas::test {

struct LitScene {
  Scene scene;
  SurfaceModel surfaces;
  TransportPlan plan;
  std::optional<RayScene> rays;
  ElementMesh mesh;
  std::shared_ptr<const LightScene> light; ///< refers to the members above
};
std::unique_ptr<LitScene> lit(Scene scene, const MeshSettings& mesh, const PlanSettings& plan = {});

/// Area mean over the elements of node `from` of the sums
/// of their rows over the elements of node `to`.
double form_factor(const LitScene& lit, const Transport& transport, const std::string& from,
                   const std::string& to);

/// Elements of a node.
std::vector<std::size_t> elements_of(const LitScene& lit, const std::string& node);

/// Area mean of a value over the elements of a node.
Rgb mean_over(const LitScene& lit, const std::vector<Rgb>& values, const std::string& node);

} // namespace meninas::test
