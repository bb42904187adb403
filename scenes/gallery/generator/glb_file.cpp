#include "scenes/gallery/generator/glb_file.h"

#include "scenes/gallery/generator/gltf_document.h"

namespace meninas::gallery {

static void append_word(std::string& file, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8)
    file += static_cast<char>(value >> shift & 255U);
}

static void align(std::string& bytes, char filling) {
  while (bytes.size() % 4 != 0)
    bytes += filling;
}

/// glTF 2.0, 4.4: little-endian words, and chunks of whole words.
static std::string container(std::string json, std::string binary) {
  align(json, ' ');
  align(binary, '\0');
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, 12 + 8 + json.size() + 8 + binary.size());
  append_word(file, json.size());
  file += "JSON" + json;
  append_word(file, binary.size());
  file += std::string("BIN\0", 4) + binary;
  return file;
}

std::string glb_bytes(const Stage& stage) {
  auto document = document_of(stage);
  std::string binary;
  const auto append = [&](const std::vector<std::uint8_t>& bytes) {
    const auto start = binary.size();
    binary.append(bytes.begin(), bytes.end());
    align(binary, '\0');
    return start;
  };

  std::vector<std::size_t> starts;
  for (const auto& bytes : document.buffers)
    starts.push_back(append(bytes));
  for (auto& view : document.views) {
    const auto start = starts[view["buffer"].get<std::size_t>()];
    view["buffer"] = 0;
    view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + start;
  }

  Json images = Json::array();
  for (std::size_t k = 0; k < document.images.size(); ++k) {
    const auto start = append(document.images[k]);
    images.push_back({{"name", document.pictures[k].name},
                      {"bufferView", document.views.size()},
                      {"mimeType", "image/png"}});
    document.views.push_back(
        {{"buffer", 0}, {"byteOffset", start}, {"byteLength", document.images[k].size()}});
  }

  Json roots = Json::array();
  for (std::size_t k = 0; k < document.nodes.size(); ++k)
    roots.push_back(k);
  Json file{{"asset", {{"version", "2.0"}, {"generator", "Meninas gallery"}}},
            {"scene", 0},
            {"scenes", Json::array({Json{{"name", stage.name}, {"nodes", roots}}})}};
  for (const auto& [key, list] : {std::pair("nodes", &document.nodes),
                                  {"cameras", &document.cameras},
                                  {"materials", &document.materials},
                                  {"textures", &document.textures},
                                  {"samplers", &document.samplers},
                                  {"images", &images},
                                  {"meshes", &document.meshes},
                                  {"accessors", &document.accessors},
                                  {"bufferViews", &document.views}})
    if (!list->empty())
      file[key] = *list;
  file["buffers"] = Json::array({Json{{"byteLength", binary.size()}}});
  if (const auto used = extensions_used(document); !used.empty())
    file["extensionsUsed"] = used;
  if (!document.lights.empty())
    file["extensions"] = {{"KHR_lights_punctual", {{"lights", document.lights}}}};
  return container(file.dump(), std::move(binary));
}

} // namespace meninas::gallery
