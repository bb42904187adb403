#include "runs/run_stages.h"

namespace meninas {

namespace {

const RunStage reading{"scene", 5.0};
const RunStage writing{"writing", 2.0};

double share_of_render(const RunSettings& settings) {
  switch (diffuse_term(settings)) {
  case DiffuseTerm::direct:
    return 80.0;
  case DiffuseTerm::gather:
    return 200.0;
  case DiffuseTerm::interpolated:
    break;
  }
  return 30.0;
}

} // namespace

std::vector<RunStage> joined(std::vector<RunStage> stages, const std::vector<RunStage>& more) {
  stages.insert(stages.end(), more.begin(), more.end());
  return stages;
}

std::vector<RunStage> pass_one_stages(const RunSettings& settings) {
  if (mesh_cut(settings) == MeshCut::hierarchical)
    return {reading, {"direct light", 10.0}, {"form factors", 10.0}, {"refinement", 40.0}};
  if (settings.solver == SolverMethod::progressive)
    return {reading, {"hemispheres", 10.0}, {"direct light", 10.0}, {"form factors", 20.0},
            {"shots", 20.0}, {"interpolation", 30.0}};
  return {reading, {"form factors", 30.0}, {"direct light", 10.0}, {"interpolation", 40.0}};
}

std::vector<RunStage> picture_stages(const RunSettings& settings, WithPassOne pass_one) {
  if (settings.mode == PictureMode::reference)
    return {reading, {"paths", 100.0}, writing};
  if (pass_one == WithPassOne::no)
    return {reading, {"render", 40.0}, writing};
  return joined(pass_one_stages(settings),
                {{"render", share_of_render(settings)}, {"error estimate", 5.0}, writing});
}

} // namespace meninas
