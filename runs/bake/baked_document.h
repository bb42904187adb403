// The scene's file with a lightmap: the glTF document edited, not written anew.
//
// Nodes, materials, animations, names and extras stay. New are
//   TEXCOORD_n of the primitives that are shown, n the first number that none of them has, at least 1: the place in
//     the map. Primitives with fewer sets get those between filled with the same coordinates. Vertices whose
//     triangles are in several charts are there as often, with all their attributes and targets.
//   MOZ_lightmap {index, texCoord, intensity} of their materials: irradiance = intensity * texel, decoded from sRGB as the extension asks, so that
//     outgoing radiance = albedo / pi * irradiance, as three.js has it.
//   where asked for, a variant of KHR_materials_variants: one unlit material with the colours of the room.
// A mesh that several nodes or copies show is there once for each; copies of EXT_mesh_gpu_instancing become
// nodes. Buffers become one, images are taken in, Draco and meshopt are decoded; accessors and views keep
// what others use.
#pragma once

#include "runs/bake/lightmap.h"
#include "scenes/gltf/document.h"

#include <cstddef>
#include <string>
#include <vector>

namespace meninas {

struct BakedScene {
  const gltf::Document& file; ///< as it is at rest
  const std::vector<gltf::PlacedPrimitive>& primitives;
  const FileCharts& charts;
  const LightmapLayout& layout;
  const IrradianceField& field;
};

struct BakedImages {
  std::vector<std::byte> irradiance; ///< PNG
  double intensity = 1.0;            ///< of MOZ_lightmap, in the units of the file
  std::vector<std::byte> shown;      ///< PNG; empty: no variant
  nlohmann::json extras;             ///< of the image, for readers
};

struct BakedDocument {
  nlohmann::json root;
  std::vector<std::byte> binary;
  int texcoord = 1;      ///< n
  std::string variant;   ///< its name; empty: none
  std::vector<std::string> warnings;
};
BakedDocument baked_document(const BakedScene& scene, const BakedImages& images);

} // namespace meninas
