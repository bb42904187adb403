// Every kind of bad file ends with one line that names the place.
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

namespace meninas::test {

using testing::HasSubstr;
using testing::StartsWith;

struct BadEdit {
  const char* pointer; ///< where in the JSON of the square
  Json value;
  const char* line; ///< a part of the message
};

// Shown as the pointer and value when a case fails.
void PrintTo(const BadEdit& edit, std::ostream* out) {
  *out << edit.pointer << " = " << edit.value;
}

class GltfBadEdit : public testing::TestWithParam<BadEdit> {};

TEST_P(GltfBadEdit, NamesThePlace) {
  auto file = square();
  file.json[Json::json_pointer(GetParam().pointer)] = GetParam().value;
  EXPECT_THAT(error_of(file), HasSubstr(std::string("scene.gltf: ") + GetParam().line));
}

static const BadEdit structure_edits[] = {
    {"/asset", nullptr, "asset: not a glTF file"},
    {"/asset/version", "1.0", "asset: glTF version '1.0' is not read"},
    {"/asset/minVersion", "2.1", "asset: the file asks for a reader of a newer glTF"},
    {"/nodes", 5, "'nodes' must be an array, it is 5"},
    {"/nodes/0", "x", "'nodes' must be an array of objects, it is a string"},
    {"/nodes/0/mesh", 7, "nodes[0] 'Quad': 'mesh' is index 7 of meshes, there are 1"},
    {"/nodes/0/mesh", -1, "nodes[0] 'Quad': 'mesh' must be an index, it is -1"},
    {"/nodes/0/mesh", 0.5, "nodes[0] 'Quad': 'mesh' must be an index, it is 0.5"},
    {"/nodes/0/mesh", nullptr, "nodes[0] 'Quad': 'mesh' must be an index, it is null"},
    {"/nodes/0/camera", 0, "nodes[0] 'Quad': 'camera' is index 0 of cameras, there are 0"},
    {"/nodes/0/children", {9}, "nodes[0] 'Quad': 'children' is index 9 of nodes"},
    {"/nodes/0/matrix", {1, 2, 3}, "nodes[0] 'Quad': 'matrix' must have 16 numbers, it has 3"},
    {"/nodes/0/scale",
     {1, "2", 3},
     "nodes[0] 'Quad': 'scale' must be an array of numbers, it is a string"},
    {"/nodes/0/rotation", {0, 0, 0, 0}, "nodes[0] 'Quad': 'rotation' is zero"},
    {"/nodes/0/name", 12, "nodes[0]: 'name' must be text, it is 12"},
    {"/nodes/0/extensions/KHR_lights_punctual", Json::object(),
     "nodes[0].extensions.KHR_lights_punctual 'Quad': has no 'light'"},
    {"/scene", 0, "'scene' is index 0 of scenes, there are 0"},
    {"/scenes", {{{"nodes", {3}}}}, "scenes[0]: 'nodes' is index 3 of nodes, there are 1"},
    {"/meshes/0", Json::object(), "meshes[0]: has no 'primitives'"},
    {"/meshes/0/primitives/0/attributes/POSITION", 5,
     "meshes[0].primitives[0]: 'POSITION' is index 5 of accessors, there are 2"},
    {"/meshes/0/primitives/0/attributes/POSITION", 1, "accessors[1]: type must be VEC3"},
    {"/meshes/0/primitives/0/indices", 0, "accessors[0]: type must be SCALAR"},
    {"/meshes/0/primitives/0/indices", 4294967296,
     "meshes[0].primitives[0]: 'indices' is index 4294967296"},
    {"/meshes/0/primitives/0/material", 1,
     "meshes[0].primitives[0]: 'material' is index 1 of materials"},
    {"/meshes/0/primitives/0/mode", 9, "meshes[0], primitive 0: mode 9 does not exist"},
    {"/materials/0/doubleSided", 1, "materials[0] 'grey': 'doubleSided' must be true or false"},
    {"/materials/0/pbrMetallicRoughness/metallicFactor", "1",
     "materials[0].pbrMetallicRoughness 'grey': 'metallicFactor' must be a number"},
    {"/materials/0/emissiveTexture",
     {{"index", 0}},
     "materials[0].emissiveTexture 'grey': 'index' is index 0 of textures"},
    {"/extensionsRequired",
     {"KHR_texture_transform", "EXT_strange"},
     "extensionsRequired: the file needs EXT_strange"},
    {"/extensionsRequired", {3}, "'extensionsRequired' must be an array of text"},
};
INSTANTIATE_TEST_SUITE_P(Structure, GltfBadEdit, testing::ValuesIn(structure_edits));

static const BadEdit accessor_edits[] = {
    {"/accessors/0/count", 5,
     "accessors[0]: 5 elements of 12 bytes from byte 0 do not fit into the 48 bytes of "
     "bufferViews[0]"},
    {"/accessors/0/count", 9223372036854775807, "geometry: needs about"},
    {"/accessors/0/count", -4, "accessors[0]: 'count' must be a whole number"},
    {"/accessors/0/byteOffset", 4, "accessors[0]: 4 elements of 12 bytes from byte 4 do not fit"},
    {"/accessors/0/byteOffset", 18446744073709551612u,
     "accessors[0]: 4 elements of 12 bytes from byte 18446744073709551612"},
    {"/accessors/0/componentType", 5124, "accessors[0]: componentType 5124 does not exist"},
    {"/accessors/0/componentType", 5125, "accessors[0]: componentType 5125 is only for indices"},
    {"/accessors/1/componentType", 5122, "accessors[1]: indices must be unsigned integers"},
    {"/accessors/0/type", "VEC9", "accessors[0]: type must be VEC3 for this use, it is 'VEC9'"},
    {"/accessors/0/bufferView", 2, "accessors[0]: 'bufferView' is index 2 of bufferViews"},
    {"/bufferViews/0/byteLength", 1000,
     "bufferViews[0]: 1000 bytes from byte 0 do not fit into the 60 bytes of buffers[0]"},
    {"/bufferViews/0/byteOffset", 18446744073709551600u,
     "bufferViews[0]: 48 bytes from byte 18446744073709551600"},
    {"/bufferViews/0/byteStride", 4,
     "accessors[0]: bufferViews[0] has byteStride 4, less than the 12 bytes"},
    {"/bufferViews/0/byteStride", 9223372036854775807, "accessors[0]: 4 elements"},
    {"/bufferViews/0/buffer", 1, "bufferViews[0]: 'buffer' is index 1 of buffers"},
    {"/accessors/0/sparse", {{"count", 1}}, "accessors[0].sparse: has no 'indices'"},
    {"/accessors/0/sparse",
     {{"count", 5},
      {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
      {"values", {{"bufferView", 0}}}},
     "accessors[0]: 5 sparse elements in an accessor of 4"},
    {"/accessors/0/sparse",
     {{"count", 1},
      {"indices", {{"bufferView", 0}, {"byteOffset", 14}, {"componentType", 5123}}},
      {"values", {{"bufferView", 0}}}},
     "accessors[0]: sparse index 16256 in an accessor of 4"},
    {"/accessors/0/sparse",
     {{"count", 4},
      {"indices", {{"bufferView", 1}, {"componentType", 5125}}},
      {"values", {{"bufferView", 0}}}},
     "accessors[0]: 4 elements of 4 bytes from byte 0 do not fit into the 12 bytes"},
    {"/meshes/0/primitives/0/attributes/NORMAL", 1,
     "meshes[0], primitive 0: NORMAL has 6 elements, POSITION has 4"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "data:application/octet-stream;base64,AAAA"}}},
     "buffers[0]: truncated: byteLength is 60, its data has 3"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "data:application/octet-stream;base64,%%%%"}}},
     "buffers[0]: the data URI is not valid base64"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "data:text/plain,hello"}}},
     "buffers[0]: the data URI is not base64"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "nowhere.bin"}}},
     "buffers[0]: 'nowhere.bin': no such file"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "/etc/hostname"}}},
     "buffers[0]: '/etc/hostname' is outside the folder"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "a/../../b.bin"}}},
     "buffers[0]: 'a/../../b.bin' is outside the folder"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "%2e%2e/b.bin"}}},
     "buffers[0]: '%2e%2e/b.bin' is outside the folder"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "a%00b"}}},
     "buffers[0]: 'a%00b' is not a file name"},
    {"/buffers",
     {{{"byteLength", 60}, {"uri", "file:///etc/hostname"}}},
     "buffers[0]: 'file:///etc/hostname' is not a file beside"},
    {"/buffers", {{{"byteLength", 60}, {"uri", "."}}}, "buffers[0]: '.': not a file but a folder"},
    {"/buffers", {{{"byteLength", 60}}}, "bufferViews[0]: buffers[0] has no data"},
};
INSTANTIATE_TEST_SUITE_P(Accessors, GltfBadEdit, testing::ValuesIn(accessor_edits));

TEST(GltfBadInput, IndexOutOfRange) {
  auto file = square();
  square_primitive(file)["indices"] = file.add_accessor<std::uint8_t>({0, 1, 4}, "SCALAR");
  EXPECT_THAT(
      error_of(file),
      HasSubstr(
          "meshes[0], primitive 0: index 4 (2 of accessors[2]) is out of range: there are 4"));
}

TEST(GltfBadInput, VerticesThatAreNotFinite) {
  for (const auto bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    auto file = square();
    square_primitive(file)["attributes"]["POSITION"] =
        file.add_accessor<float>({0, 0, 0, 1, 0, 0, 1, bad, 0, 0, 1, 0}, "VEC3");
    EXPECT_THAT(error_of(file),
                HasSubstr("meshes[0], primitive 0: POSITION 2 (of accessors[2]) is not finite"));
  }
}

TEST(GltfBadInput, MatricesThatAreNotFiniteOrNotAffine) {
  auto huge = square();
  huge.json["nodes"][0]["scale"] = {1e300, 1, 1};
  huge.add_node({{"name", "Top"}, {"children", {0}}, {"scale", {1e300, 1, 1}}});
  EXPECT_THAT(error_of(huge), HasSubstr("nodes[0] 'Quad': its transform is not finite"));

  auto far = square();
  far.json["nodes"][0]["translation"] = {1e200, 0, 0};
  EXPECT_THAT(error_of(far),
              HasSubstr("meshes[0], primitive 0: vertex 0 is over 1e+60 m away in node Quad"));

  auto projective = square();
  projective.json["nodes"][0]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_THAT(error_of(projective), HasSubstr("nodes[0] 'Quad': 'matrix' is not affine"));

  const TemporaryFolder folder;
  auto text = as_text(square());
  text.insert(text.find("\"mesh\""), "\"scale\":[1e999,1,1],");
  EXPECT_THAT(error_of(folder.write("scene.gltf", text)), HasSubstr("JSON: a number is too large"));
}

TEST(GltfBadInput, NodesThatAreNoTree) {
  auto own_child = square();
  own_child.json["nodes"][0]["children"] = {0};
  EXPECT_THAT(error_of(own_child), HasSubstr("nodes[0] 'Quad': node cycle: it is its own child"));

  auto cycle = square();
  cycle.add_node({{"name", "A"}, {"children", {2}}});
  cycle.add_node({{"name", "B"}, {"children", {1}}});
  EXPECT_THAT(error_of(cycle), HasSubstr("nodes[1] 'A': node cycle: it is its own ancestor"));

  auto two_parents = square();
  two_parents.add_node({{"children", {0}}});
  two_parents.add_node({{"children", {0}}});
  EXPECT_THAT(error_of(two_parents),
              HasSubstr("nodes[0] 'Quad': has two parents, nodes[1] and nodes[2]"));
}

TEST(GltfBadInput, NothingToRender) {
  auto empty = square();
  empty.json["scenes"] = Json::array({Json::object()});
  EXPECT_EQ(error_of(empty), "scene.gltf: nothing to render: no triangles in the scene");
  auto flat = square();
  flat.json["nodes"][0]["scale"] = {0, 0, 0};
  EXPECT_EQ(error_of(flat), "scene.gltf: nothing to render: all 2 triangles are without area");
}

TEST(GltfBadInput, MemoryIsCountedBeforeItIsTaken) {
  auto file = square();
  file.json["accessors"][0].erase("bufferView");
  file.json["accessors"][0]["count"] = 1'000'000'000;
  EXPECT_THAT(error_of(file), HasSubstr("geometry: needs about"));

  // 20,000 instances of 2 triangles need about 10 MB.
  auto instances = square();
  for (int k = 1; k < 20'000; ++k)
    instances.add_node({{"mesh", 0}});
  EXPECT_THAT(error_of(instances, {.memory_limit = 4 << 20}),
              HasSubstr("the memory limit is 4 MiB"));
  EXPECT_EQ(load(instances).triangles.size(), 40'000u);
  EXPECT_THAT(error_of(square(), {.memory_limit = 100}), HasSubstr("over the memory limit"));
}

TEST(GltfBadInput, TextThatNeedsTooMuchMemoryIsNotParsed) {
  // Two bytes of text each, some seventy once they are parsed.
  auto file = square();
  file.json["extras"] = Json(20'000, Json::array());
  EXPECT_THAT(error_of(file, {.memory_limit = 1 << 20}),
              HasSubstr("JSON: needs about 2 MiB, the memory limit is 1 MiB"));
  // Of a buffer in the text the text is all there is.
  auto data = square();
  data.data.resize(500'000);
  EXPECT_EQ(error_of(data, {.memory_limit = 2 << 20}), "no error");
}

TEST(GltfBadInput, PrimitivesWithoutNumberAreNotLookedAt) {
  // Nothing is seen of any of them, so they take no memory: only a lifetime.
  auto file = square();
  file.add_mesh(Json(10'000, {{"attributes", {{"POSITION", 0}}}, {"mode", 0}}));
  for (int k = 0; k < 10'000; ++k)
    file.add_node({{"mesh", 1}});
  EXPECT_THAT(error_of(file), HasSubstr("have over 50000000 primitives and attributes"));
}

TEST(GltfBadInput, LongNamesAreCutInMessages) {
  auto file = square();
  std::string name;
  for (int k = 0; k < 1000; ++k)
    name += "\xc3\xa4"; // one character of two bytes, between which is no cut
  file.json["materials"][0] = {{"name", "x" + name}};
  file.json["nodes"][0]["name"] = name;
  const Scene scene = load(file);
  EXPECT_EQ(scene.nodes[0].name, name);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_LT(scene.warnings[0].size(), 200U);
  EXPECT_THAT(scene.warnings[0], HasSubstr("\xa4...'"));
  file.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
  EXPECT_LT(error_of(file).size(), 200U);
}

TEST(GltfBadInput, FilesOutsideAreReadOnlyWhenAllowed) {
  const TemporaryFolder folder;
  auto file = square();
  file.json["buffers"] = Json::array({{{"byteLength", file.data.size()}, {"uri", "../data.bin"}}});
  folder.write("data.bin", file.data);
  const auto path = folder.write("room/scene.gltf", as_text(file));
  EXPECT_THAT(error_of(path),
              HasSubstr("buffers[0]: '../data.bin' is outside the folder of the glTF file"));
  EXPECT_EQ(load_gltf(path, {.external_files = ExternalFiles::anywhere}).triangles.size(), 2u);

  // A link inside the folder is no way out either.
  std::filesystem::create_symlink("../data.bin", folder.path() / "room/link.bin");
  file.json["buffers"][0]["uri"] = "link.bin";
  EXPECT_THAT(error_of(folder.write("room/scene.gltf", as_text(file))),
              HasSubstr("'link.bin' is outside the folder"));
}

TEST(GltfBadInput, PointersOfGitLfsAreNamed) {
  const TemporaryFolder folder;
  std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:";
  pointer.append(64, 'a');
  pointer += "\nsize 123456\n";
  EXPECT_EQ(error_of(folder.write("room.glb", pointer)),
            "room.glb: is a Git LFS pointer, not the data: run git lfs pull");
  auto file = square();
  file.json["buffers"] = Json::array({{{"byteLength", file.data.size()}, {"uri", "data.bin"}}});
  folder.write("data.bin", pointer);
  EXPECT_THAT(error_of(folder.write("room.gltf", as_text(file))),
              HasSubstr("buffers[0]: 'data.bin': is a Git LFS pointer, not the data"));
}

TEST(GltfBadInput, FilesThatAreNoGltf) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of(folder.path() / "nowhere.gltf"), "nowhere.gltf: no such file");
  EXPECT_EQ(error_of(folder.write("empty.gltf", "")), "empty.gltf: not a glTF file: it is empty");
  EXPECT_EQ(error_of(folder.write("blank.gltf", " \n ")),
            "blank.gltf: not a glTF file: it begins with neither '{' nor 'glTF'");
  EXPECT_EQ(error_of(folder.write("note.gltf", "Dear reader")),
            "note.gltf: not a glTF file: it begins with neither '{' nor 'glTF'");
  EXPECT_EQ(error_of(folder.write("wide.gltf", std::string("\xff\xfe{\0", 4))),
            "wide.gltf: not a glTF file: it is text in UTF-16; save it as UTF-8");
  EXPECT_EQ(error_of(folder.write("a.png", "\x89PNG\r\n\x1a\n")),
            "a.png: not a glTF file: it is a PNG image");
  EXPECT_EQ(error_of(folder.write("a.json", "{\"a\": 1}")),
            "a.json: asset: not a glTF file: it is JSON without an asset.version");
  EXPECT_EQ(error_of(folder.write("a.gltf", "{\"asset\":\n {\"version\": 2.0.0}}")),
            "a.gltf: line 2, column 17: the JSON text is not valid here");
  EXPECT_EQ(error_of(folder.write("cut.gltf", "{\"asset\":")),
            "cut.gltf: line 1, column 10: the JSON text is not valid here");
  EXPECT_EQ(error_of(folder.write("deep.gltf", std::string("{\"a\":").append(1'000'000, '['))),
            "deep.gltf: JSON: is nested more than 200 levels deep");
  std::filesystem::create_directory(folder.path() / "folder.gltf");
  EXPECT_EQ(error_of(folder.path() / "folder.gltf"), "folder.gltf: not a file but a folder");
  ASSERT_EQ(mkfifo((folder.path() / "pipe.gltf").c_str(), 0600), 0);
  EXPECT_EQ(error_of(folder.path() / "pipe.gltf"), "pipe.gltf: not a regular file");
}

TEST(GltfBadInput, BrokenGlb) {
  const TemporaryFolder folder;
  const auto error = [&](Bytes glb) { return error_of(folder.write("scene.glb", glb)); };
  const auto whole = as_glb(square());
  const auto json_size = whole[12] | whole[13] << 8;
  EXPECT_EQ(error(whole), "no error");

  EXPECT_EQ(error({whole.begin(), whole.begin() + 7}),
            "scene.glb: GLB header: truncated: 7 of 12 bytes");
  EXPECT_THAT(error({whole.begin(), whole.end() - 5}),
              StartsWith("scene.glb: GLB header: truncated: it announces"));
  auto longer = whole;
  longer.push_back(0);
  EXPECT_THAT(error(longer), StartsWith("scene.glb: GLB header: it announces"));
  auto edited = [&](std::size_t at, unsigned char value) {
    auto glb = whole;
    glb[at] = value;
    return error(glb);
  };
  EXPECT_THAT(edited(0, 'G'), HasSubstr("not a glTF file"));
  EXPECT_EQ(edited(4, 1), "scene.glb: GLB header: version 1 is not read, only 2");
  EXPECT_THAT(edited(15, 0x7f), HasSubstr("GLB chunk 0: truncated: it announces"));
  EXPECT_EQ(edited(16, 'X'), "scene.glb: GLB chunk 0: the first chunk is not JSON");
  EXPECT_THAT(edited(20 + json_size + 3, 0x7f), HasSubstr("GLB chunk 1: truncated: it announces"));
  EXPECT_THAT(edited(20 + json_size + 4, 'X'), HasSubstr("bufferViews[0]: buffers[0] has no data"));

  Bytes only_header(whole.begin(), whole.begin() + 12);
  only_header[8] = 12;
  only_header[9] = 0;
  EXPECT_EQ(error(only_header), "scene.glb: GLB: has no JSON chunk");
}

} // namespace meninas::test
