// glTF 2.0 in: .gltf with files or data URIs, and .glb, into a Scene.
//
// Read: the default scene (or the one asked for), its node hierarchy with any matrix or TRS,
// triangles, strips and fans, indexed or not; strided and sparse accessors, Draco and meshopt;
// metallic-roughness materials with the extensions KHR_materials_emissive_strength,
// _ior, _specular, _transmission, _volume, KHR_texture_transform, KHR_lights_punctual,
// perspective and orthographic cameras; the state of settings.h, see state/. Negative determinants keep the front in
// front. Features that are left out are named in Scene::warnings or Scene::ignored.
// Throws InputError (FILE: WHERE: WHAT) for anything that is not a well-formed
// file with finite geometry, OutputError for scenes over the limit of memory.
#pragma once

#include "scenes/gltf/settings.h"
#include "scenes/scene.h"

#include <filesystem>
#include <optional>

namespace meninas {

Scene load_gltf(const std::filesystem::path& file, const GltfSettings& settings = {});

/// The same of bytes in memory, as if they stood in that file:
/// what they name is looked for beside it.
Scene read_gltf(std::vector<unsigned char> bytes, const std::filesystem::path& file,
                const GltfSettings& settings = {});

} // namespace meninas
