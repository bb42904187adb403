#include "scenes/gallery/generator/gltf_text.h"

#include "scenes/gallery/generator/gltf_document.h"

#include <algorithm>
#include <string_view>

namespace meninas::gallery {

static std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto given = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < given ? bytes[k + i] : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= given ? digits[group >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

static std::string list_text(const char* key, const Json& list) {
  auto text = std::string("  \"") + key + "\": [";
  for (std::size_t k = 0; k < list.size(); ++k)
    text += (k == 0 ? "\n    " : ",\n    ") + list[k].dump();
  return text + "\n  ]";
}

std::string gltf_text(const Stage& stage) {
  const auto document = document_of(stage);
  Json roots = Json::array();
  for (std::size_t k = 0; k < document.nodes.size(); ++k)
    roots.push_back(k);
  const Json asset{{"version", "2.0"}, {"generator", "Meninas gallery"}};
  const Json scene{{"name", stage.name}, {"nodes", roots}};

  Json images = Json::array();
  for (std::size_t k = 0; k < document.images.size(); ++k)
    images.push_back({{"name", document.pictures[k].name},
                      {"uri", "data:image/png;base64," + base64(document.images[k])}});
  Json buffers = Json::array();
  for (const auto& bytes : document.buffers)
    buffers.push_back({{"byteLength", bytes.size()},
                       {"uri", "data:application/octet-stream;base64," + base64(bytes)}});

  auto text = "{\n  \"asset\": " + asset.dump() + ",\n";
  const auto used = extensions_used(document);
  if (!used.empty())
    text += "  \"extensionsUsed\": " + Json(used).dump() + ",\n";
  if (!document.lights.empty())
    text += "  \"extensions\": {\"KHR_lights_punctual\": {" +
            list_text("lights", document.lights).substr(2) + "}},\n";
  text += "  \"scene\": 0,\n" + list_text("scenes", Json::array({scene}));
  text += ",\n" + list_text("nodes", document.nodes);
  text += ",\n" + list_text("cameras", document.cameras);
  text += ",\n" + list_text("materials", document.materials);
  if (!document.textures.empty())
    text += ",\n" + list_text("textures", document.textures) + ",\n" +
            list_text("samplers", document.samplers) + ",\n" + list_text("images", images);
  text += ",\n" + list_text("meshes", document.meshes);
  text += ",\n" + list_text("accessors", document.accessors);
  text += ",\n" + list_text("bufferViews", document.views);
  text += ",\n" + list_text("buffers", buffers);
  return text + "\n}\n";
}

} // namespace meninas::gallery
