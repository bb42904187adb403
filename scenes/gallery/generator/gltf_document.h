// The lists of a glTF 2.0 file, made of a stage; gltf_text.h and glb_file.h write them down.
#pragma once

#include "scenes/gallery/generator/stage.h"

#include <nlohmann/json.hpp>

namespace meninas::gallery {

using Json = nlohmann::ordered_json;

/// Objects as they stand in the file, but for buffers and images, which are bytes.
struct Document {
  Json nodes = Json::array();
  Json meshes = Json::array();
  Json cameras = Json::array();
  Json lights = Json::array();
  Json materials = Json::array();
  Json accessors = Json::array();
  Json views = Json::array();
  Json samplers = Json::array();
  Json textures = Json::array();
  std::vector<std::vector<std::uint8_t>> buffers; ///< one a part and one an attribute
  std::vector<std::vector<std::uint8_t>> images;  ///< PNG files
  std::vector<Picture> pictures;                  ///< of which each image was made
  bool has_strength = false, has_glass = false, has_solids = false, has_cloth = false;
};

/// Positions are rounded to floats; what parts have in common is there once.
Document document_of(const Stage& stage);

std::vector<std::string> extensions_used(const Document& document);

} // namespace meninas::gallery
