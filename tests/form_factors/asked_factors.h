// Form factors as the command gives them, for scenes written down in tests.
#pragma once

#include "radiosity/queries/gltf_node_factors.h"
#include "tests/form_factors/known_form_factors.h"

namespace meninas::test {

struct Asked {
  ExtendedFactor factor;
  double area = 0.0;
  bool converged = true;
  MirrorSet mirrors;
  std::vector<std::string> not_counted;
};

/// In scenes made by hand several nodes may have one name.
NodeSet nodes_named(const Scene& scene, const std::string& name);

Asked ask(const Scene& scene, const std::string& from, const std::string& to,
          const NodeFactorSettings& settings = {});

Scene scene_of(const std::vector<ScenePolygon>& polygons, double mirror_reflectance);
Scene pair_of(const PairCase& pair);

} // namespace meninas::test
