// A solution as a file: a GLB any viewer shows (COLOR_0) that keeps the exact irradiance (_IRRADIANCE) with the settings
// of its mesh and the hash of its scene, so that one solve serves any number of views.
//
// One primitive per patch side is not needed: one mesh holds all element vertices (POSITION, COLOR_0, _IRRADIANCE as VEC3 float)
// and the elements' triangles. `extras` of the asset holds {"meninas": {version, scene_hash, mesh settings, figures}}.
// load_solution rebuilds nothing: it checks that hash, settings and vertex count belong to the given scene and throws InputError if not.
#pragma once

#include "radiosity/pass_one.h"

#include <filesystem>

namespace meninas {

void write_solution(const std::filesystem::path& file, const Scene& scene, const ElementMesh& mesh,
                    const RadiositySolution& solution, const MeshSettings& settings);

/// The mesh settings a solution was made with, after checking that it is this scene's.
struct StoredSolution {
  MeshSettings mesh;
  DiffuseField field;
};
StoredSolution read_solution(const std::filesystem::path& file, const Scene& scene);

} // namespace meninas
