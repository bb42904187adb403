#include "tests/cli/tiny_room.h"

#include "scenes/glb_file.h"

#include <array>
#include <fstream>
#include <span>

namespace meninas::test {
namespace {

using nlohmann::json;
using Quad = std::array<std::array<float, 3>, 4>;

enum Finish { grey = 0, glowing = 1, mirroring = 2 };

/// A node, a mesh and its vertices; the indices of two triangles are the first thing in the buffer.
void add_quad(TinyRoom& room, const std::string& name, const Quad& corners, Finish finish) {
  json& root = room.root;
  const auto bytes = std::as_bytes(std::span(corners));
  root["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", room.binary.size()}, {"byteLength", bytes.size()}});
  room.binary.insert(room.binary.end(), bytes.begin(), bytes.end());

  const std::size_t mesh = root["meshes"].size();
  root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                               {"componentType", 5126},
                               {"count", 4},
                               {"type", "VEC3"}});
  const json primitive{{"attributes", {{"POSITION", root["accessors"].size() - 1}}},
                       {"indices", 0},
                       {"material", static_cast<int>(finish)}};
  root["meshes"].push_back({{"primitives", json::array({primitive})}});
  root["scenes"][0]["nodes"].push_back(root["nodes"].size());
  root["nodes"].push_back({{"name", name}, {"mesh", mesh}});
}

json material(const std::string& name, double colour, double metallic, double roughness) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {colour, colour, colour, 1.0}},
            {"metallicFactor", metallic},
            {"roughnessFactor", roughness}}}};
}

void add_camera(TinyRoom& room) {
  json& root = room.root;
  root["cameras"] =
      json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.01}}}}});
  root["scenes"][0]["nodes"].push_back(root["nodes"].size());
  root["nodes"].push_back({{"name", "camera"}, {"camera", 0}, {"translation", {0.5, 0.5, 2.5}}});
}

} // namespace

TinyRoom tiny_room() {
  TinyRoom room;
  room.root = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", json::array({json::object()})},
               {"nodes", json::array()},
               {"meshes", json::array()}};
  room.root["materials"] =
      json::array({material("wall", 0.5, 0.0, 1.0), material("glow", 0.0, 0.0, 1.0),
                   material("silver", 0.9, 1.0, 0.0)});
  room.root["materials"][1]["emissiveFactor"] = {1.0, 1.0, 1.0};

  constexpr std::array<std::uint32_t, 6> two_triangles{0, 1, 2, 0, 2, 3};
  const auto indices = std::as_bytes(std::span(two_triangles));
  room.binary.assign(indices.begin(), indices.end());
  room.root["bufferViews"] =
      json::array({{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", indices.size()}}});
  room.root["accessors"] =
      json::array({{{"bufferView", 0}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}});

  add_quad(room, "floor", {{{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}}, grey);
  add_quad(room, "ceiling", {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}}, grey);
  add_quad(room, "back", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, grey);
  add_quad(room, "left", {{{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}}}, grey);
  add_quad(room, "right", {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}}, grey);
  add_quad(room, "lamp",
           {{{0.4F, 0.9F, 0.4F}, {0.6F, 0.9F, 0.4F}, {0.6F, 0.9F, 0.6F}, {0.4F, 0.9F, 0.6F}}},
           glowing);
  add_quad(room, "mirror",
           {{{0.1F, 0.2F, 0.8F}, {0.1F, 0.2F, 0.2F}, {0.1F, 0.8F, 0.2F}, {0.1F, 0.8F, 0.8F}}},
           mirroring);
  add_camera(room);
  return room;
}

std::size_t add_floats(TinyRoom& room, const std::vector<float>& values, const std::string& type,
                       std::size_t width) {
  const auto bytes = std::as_bytes(std::span(values));
  room.root["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", room.binary.size()}, {"byteLength", bytes.size()}});
  room.binary.insert(room.binary.end(), bytes.begin(), bytes.end());
  room.root["accessors"].push_back({{"bufferView", room.root["bufferViews"].size() - 1},
                                    {"componentType", 5126},
                                    {"count", values.size() / width},
                                    {"type", type}});
  return room.root["accessors"].size() - 1;
}

void write_room(const std::filesystem::path& file, const TinyRoom& room) {
  json root = room.root;
  root["buffers"] = json::array({{{"byteLength", room.binary.size()}}});
  const std::vector<std::byte> bytes = glb_bytes(root, room.binary, file);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

} // namespace meninas::test
