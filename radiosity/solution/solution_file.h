// A solution as a file: a GLB that any viewer shows (viewer_scene.h: names, cameras, textures,
// materials, COLOR_0) and that keeps the exact irradiance (_IRRADIANCE) with the settings of its mesh
// and the hash of its scene, so that one solve serves any number of views.
//
// The field, W/m^2, is one array of VEC3 floats for each part that is known (_IRRADIANCE,
// _IRRADIANCE_MIRRORED, _IRRADIANCE_INDIRECT, _IRRADIANCE_INDIRECT_MIRRORED, see IrradianceField), by
// vertex of the mesh, after them the points that viewers alone need; the lit primitives take ranges of
// it. `extras` of the asset holds {"meninas": {version, scene_hash, data_hash, mesh settings, counts,
// field: the accessors of the arrays, display_scale: COLOR_0 / B, figures of the solve}}, and where the
// field has a mesh of its own, `division`, the number of the view of bytes that say which cells of the
// forest are divided.
// A solution by lamp keeps the light of each (lamp_codes.h): `lamps` has the grouping and for each
// lamp {name, top, view}.
#pragma once

#include "radiosity/pass_one.h"

#include <filesystem>

namespace meninas {

/// `solved` is the mesh that was solved, `scene_hash` content_hash() of the scene as it was loaded.
void write_solution(const std::filesystem::path& file, std::uint64_t scene_hash,
                    const ElementMesh& solved, const RadiositySolution& solution,
                    const MeshSettings& settings);
/// The bytes of that file.
std::vector<std::byte> solution_bytes(std::uint64_t scene_hash, const ElementMesh& solved,
                                      const RadiositySolution& solution,
                                      const MeshSettings& settings, const std::string& name);

/// The settings that a solution was made with, and the figures of its solve.
struct StoredSolution {
  MeshSettings mesh;
  std::size_t elements = 0;
  std::vector<std::uint8_t> division; ///< of the mesh made with these settings; empty: none
  VertexIrradiance field;
  LampGrouping grouping = LampGrouping::node; ///< of its lamps
  std::vector<std::string> lamps;             ///< their names; empty: light is not told apart
  SolverResult solver; ///< without its radiosity
  std::optional<LinkFigures> links; ///< of a hierarchical mesh
  EnergyBalance energy;
  ClosureError closure;
};

/// Throws InputError when the file is damaged,
/// or belongs to another scene than `scene` as it was loaded, or another version of the program.
StoredSolution read_solution(const std::filesystem::path& file, const Scene& scene);

/// The field with its scene: `light`, which was made with the solution's settings of the mesh,
/// or the same on a mesh divided from that. Throws InputError when the solution speaks of another
/// mesh, or has not one value for every vertex of it.
IrradianceField field_of(const std::filesystem::path& file, StoredSolution solution,
                         std::shared_ptr<const LightScene> light);

/// Throws InputError unless the solution has a value for every vertex of the mesh of its field.
void check_belongs(const std::filesystem::path& file, const StoredSolution& solution,
                   const ElementMesh& mesh);

} // namespace meninas
