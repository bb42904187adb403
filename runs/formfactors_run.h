// `formfactors`: form factors between nodes, as text for people,
// as JSON, or all of them as a CSV matrix with row sums.
#pragma once

#include "radiosity/queries/gltf_node_factors.h"
#include "runs/run_events.h"
#include "scenes/gltf/gltf.h"

#include <filesystem>
#include <string>

namespace meninas {

enum class FormFactorsFormat { text, json, matrix };

struct FormFactorsRequest {
  std::filesystem::path scene;
  std::string from, to; ///< nodes or groups of them; a matrix has all nodes
  FormFactorsFormat format = FormFactorsFormat::text;
  NodeFactorSettings factors;
  GltfSettings gltf; ///< how the scene's file is read
  int threads = 0;   ///< 0: all the machine has
};

std::string formfactors_run(const FormFactorsRequest& request, const RunEvents& events = {});

} // namespace meninas
