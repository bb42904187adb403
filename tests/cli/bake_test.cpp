// `bake`: the scene's own file back, with a lightmap that shows what the program renders.
#include "tests/cli/gltf_validator.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"
#include "tests/support/source_dir.h"

#include "image/image_file.h"
#include "scenes/glb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Bake : public testing::Test {
protected:
  static std::string gallery(const std::string& name) { return source_dir() + "/scenes/gallery/" + name; }
  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }
  /// What `bake` makes of the room.
  GlbContent bake(const TinyRoom& room, std::vector<std::string> more = {}) {
    write_room(folder_ / "room.glb", room);
    std::vector<std::string> arguments{"bake", "room.glb", "-o", "baked.glb", "--quality", "draft"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    said_ = outcome.err;
    return read_glb(folder_ / "baked.glb");
  }
  /// The variant of a baked scene, as a picture, and the scene, beside one another.
  double flip_of_variant(const std::string& scene, const std::string& camera) {
    EXPECT_EQ(run({"solve", scene, "-o", "s.glb"}).code, 0);
    const Outcome baked = run({"bake", scene, "--solution", "s.glb", "-o", "b.glb"});
    EXPECT_EQ(baked.code, 0) << baked.err;
    const double exposure = lightmap_image(read_glb(folder_ / "b.glb").root).at("extras").at("baked_exposure");
    const std::vector<std::string> shared{"--size",   "128x128",    "--samples", "16", "--camera", camera,
                                          "--view-transform", "srgb"};
    std::vector<std::string> of_scene{"render",    scene,          "--solution", "s.glb",
                                      "-o",        "scene.png",    "--diffuse",  "interpolated",
                                      "--exposure", std::to_string(exposure)};
    std::vector<std::string> of_baked{"render", "b.glb", "--variant", "baked", "-o", "baked.png", "--quality",
                                      "draft",  "--exposure", "0"};
    for (auto* arguments : {&of_scene, &of_baked}) {
      arguments->insert(arguments->end(), shared.begin(), shared.end());
      const Outcome outcome = run(*arguments);
      EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    return json::parse(run({"diff", "scene.png", "baked.png", "--json"}).out).at("flip");
  }
  static const json& lightmap_image(const json& root) {
    return *std::ranges::find_if(root.at("images"), [](const json& image) { return image.value("name", "") == "lightmap"; });
  }
  TemporaryFolder folder_;
  std::string said_;
};

struct TruthCase {
  const char* scene;
  const char* camera;
};
class BakeTruth : public Bake, public testing::WithParamInterface<TruthCase> {};

// Both are the same field, the variant in eight bits of sRGB and between texels, which on large walls are
// the vertices of the mesh. Mirrors are the scene's own in both.
TEST_P(BakeTruth, TheVariantShowsWhatTheProgramRenders) {
  EXPECT_LE(flip_of_variant(gallery(GetParam().scene), GetParam().camera), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Gallery, BakeTruth,
                         testing::Values(TruthCase{"meninas.gltf", "main"}, TruthCase{"cornell-mirror.gltf", "main"},
                                         TruthCase{"half-room.gltf", "main"}, TruthCase{"facing-mirrors.gltf", "main"},
                                         TruthCase{"sunbeam.gltf", "main"}, TruthCase{"blender-room.glb", "Camera"}),
                         [](const auto& instance) { return test_name(instance.param.scene); });

TEST_F(Bake, TheKhronosValidatorFindsNothing) {
  if (!has_gltf_validator(folder_.path()))
    GTEST_SKIP() << "no gltf-validator here (npm install --global gltf-validator): baked scenes are not validated";
  std::vector<std::string> files, own;
  for (const std::string& name : files_in(source_dir() + "/scenes/gallery"))
    if (name.ends_with(".gltf") || name.ends_with(".glb")) {
      const std::string baked = name.substr(0, name.rfind('.')) + ".baked.glb";
      const Outcome outcome = run({"bake", gallery(name), "-o", baked, "--quality", "draft", "--elements", "1000"});
      EXPECT_EQ(outcome.code, 0) << outcome.err;
      files.push_back(baked);
      std::filesystem::copy(gallery(name), folder_ / name);
      own.push_back(name);
    }
  // No error, and no warning that the scene's own file has not (volumes with two sides).
  const json found = validator_findings(folder_.path(), files), found_of_own = validator_findings(folder_.path(), own);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].at(1), 0) << found[k];
    EXPECT_EQ(found[k].at(2), found_of_own[k].at(2)) << found[k];
  }
}

/// Two nodes show the back wall's mesh, whose second texture coordinates its material uses.
TinyRoom shared_mesh_room() {
  TinyRoom room = tiny_room();
  json& root = room.root;
  json& primitive = root["meshes"][2]["primitives"][0];
  const std::size_t coordinates = add_floats(room, {0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2);
  primitive["attributes"]["TEXCOORD_0"] = coordinates;
  primitive["attributes"]["TEXCOORD_1"] = add_floats(room, {0, 0, 2, 0, 2, 2, 0, 2}, "VEC2", 2);
  primitive["targets"] = json::array({{{"POSITION", add_floats(room, std::vector<float>(12, 0.25F), "VEC3", 3)}}});
  root["nodes"].push_back({{"name", "again"}, {"mesh", 2}, {"translation", {0.0, 0.0, -1.0}}, {"extras", {{"kept", 7}}}});
  root["scenes"][0]["nodes"].push_back(root["nodes"].size() - 1);
  root["asset"]["extras"] = {{"author", "somebody"}};
  return room;
}

std::vector<float> floats_of(const GlbContent& file, std::size_t accessor, std::size_t width) {
  const json& array = file.root.at("accessors").at(accessor);
  const json& view = file.root.at("bufferViews").at(array.at("bufferView").get<std::size_t>());
  const std::size_t count = array.at("count"), stride = view.value("byteStride", 4 * width),
                    first = view.at("byteOffset").get<std::size_t>() + array.value("byteOffset", std::size_t{0});
  std::vector<float> values(count * width);
  for (std::size_t k = 0; k < count; ++k)
    std::memcpy(&values[k * width], file.binary.data() + first + k * stride, 4 * width);
  return values;
}

TEST_F(Bake, TheFileIsTheUsersOwnWithLight) {
  const TinyRoom room = shared_mesh_room();
  const GlbContent baked = bake(room);
  const json& root = baked.root;
  EXPECT_EQ(root.at("asset").at("extras"), room.root.at("asset").at("extras"));
  EXPECT_EQ(root.at("cameras"), room.root.at("cameras"));
  // Nodes are as they were, but for the mesh of the second that shows one.
  ASSERT_EQ(root.at("nodes").size(), room.root.at("nodes").size());
  json nodes = root.at("nodes");
  EXPECT_NE(nodes.back().at("mesh"), 2) << "each has light of its own";
  nodes.back()["mesh"] = 2;
  EXPECT_EQ(nodes, room.root.at("nodes"));
  // Materials are as they were, but for the lightmap.
  for (std::size_t k = 0; k < 3; ++k) {
    json material = root.at("materials").at(k);
    if (k < 2) {
      EXPECT_EQ(material.at("extensions").at("MOZ_lightmap").at("texCoord"), 2) << "1 is taken";
    }
    material.erase("extensions");
    EXPECT_EQ(material, room.root.at("materials").at(k));
  }
  EXPECT_FALSE(root.at("materials").at(2).contains("extensions")) << "a mirror takes no light";
}

TEST_F(Bake, VerticesKeepTheirAttributes) {
  const GlbContent baked = bake(shared_mesh_room());
  const json& root = baked.root;
  const auto attributes = [&](std::size_t mesh) -> const json& {
    return root.at("meshes").at(mesh).at("primitives").at(0).at("attributes");
  };
  const json& again = attributes(root.at("nodes").back().at("mesh"));
  for (const json* own : {&attributes(2), &again}) {
    EXPECT_EQ(floats_of(baked, own->at("TEXCOORD_1"), 2), (std::vector<float>{0, 0, 2, 0, 2, 2, 0, 2}));
    EXPECT_EQ(floats_of(baked, own->at("POSITION"), 3), (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  }
  EXPECT_NE(floats_of(baked, attributes(2).at("TEXCOORD_2"), 2), floats_of(baked, again.at("TEXCOORD_2"), 2));
  // A wall without coordinates has those of the map in every set up to it.
  EXPECT_EQ(attributes(0).at("TEXCOORD_0"), attributes(0).at("TEXCOORD_2"));
}

/// H at a corner of a node's mesh as three.js has it: intensity times the texel, linear.
double irradiance_at(const GlbContent& baked, const Bitmap& map, const std::string& node, std::size_t vertex) {
  const json& root = baked.root;
  const auto& found = *std::ranges::find_if(root.at("nodes"), [&](const json& n) { return n.value("name", "") == node; });
  const json& primitive = root.at("meshes").at(found.at("mesh").get<std::size_t>()).at("primitives").at(0);
  const auto uv = floats_of(baked, primitive.at("attributes").at("TEXCOORD_1"), 2);
  const auto texel = [](float x, int n) { return std::clamp(int(x * float(n)), 0, n - 1); };
  const json& light = root.at("materials").at(primitive.at("material").get<std::size_t>()).at("extensions").at("MOZ_lightmap");
  return light.at("intensity").get<double>() *
         double(map.pixels[std::size_t(texel(uv[2 * vertex + 1], map.height) * map.width + texel(uv[2 * vertex], map.width))].r);
}

// The back wall seen from its own lamp alone, in a black room: E = pi L F, F of a differential element to the
// rectangle of the lamp by `solve --points`, at the wall's lower corner.
TEST_F(Bake, IntensityTimesTexelIsIrradiance) {
  TinyRoom room = tiny_room();
  room.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.0, 0.0, 0.0, 1.0};
  room.root["materials"][2]["pbrMetallicRoughness"]["baseColorFactor"] = {0.0, 0.0, 0.0, 1.0};
  const GlbContent baked = bake(room, {"--elements", "4000"});
  const auto png = read_file(folder_ / "baked.lightmap.png");
  const Bitmap map = decode_image(std::as_bytes(std::span(png)), Encoding::srgb, "lightmap");
  // Lambert 1760, over the lamp's four edges, from the corner (0, 0, 1) of the floor, which looks up.
  const auto lambert = [] {
    const std::array<std::array<double, 3>, 4> lamp{{{0.4, 0.9, -0.6}, {0.6, 0.9, -0.6}, {0.6, 0.9, -0.4}, {0.4, 0.9, -0.4}}};
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& a = lamp[k];
      const auto& b = lamp[(k + 1) % 4];
      const double cross_y = a[2] * b[0] - a[0] * b[2], dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      const double cross = std::sqrt(std::pow(a[1] * b[2] - a[2] * b[1], 2) + cross_y * cross_y + std::pow(a[0] * b[1] - a[1] * b[0], 2));
      sum += std::atan2(cross, dot) * cross_y / cross;
    }
    return std::abs(sum) / 2.0; // pi F, times L = 1
  };
  const json& extras = lightmap_image(baked.root).at("extras");
  const double factor = extras.at("factor");
  // Eight bits of sRGB, rounded by less than one of 255, which is at most 2.28 / 255 of the light (at white); shadow rays.
  const double rounded = 2.3 / 255.0 * factor;
  EXPECT_NEAR(irradiance_at(baked, map, "floor", 0), lambert(), rounded + 0.02 * lambert());
  EXPECT_EQ(extras.at("unit"), "W/m^2");
  // The EXR has the same without rounding.
  const Image exr = read_image(folder_ / "baked.lightmap.exr").picture;
  ASSERT_EQ(exr.pixels.size(), map.pixels.size());
  for (std::size_t k = 0; k < exr.pixels.size(); ++k)
    EXPECT_NEAR(std::min(double(exr.pixels[k].r), factor), factor * double(map.pixels[k].r), rounded);
}

TEST_F(Bake, WithoutDirectLightWhatIsReflectedIsLeft) {
  bake(tiny_room());
  const Image whole = read_image(folder_ / "baked.lightmap.exr").picture;
  const GlbContent baked = bake(tiny_room(), {"--direct", "off"});
  const Image indirect = read_image(folder_ / "baked.lightmap.exr").picture;
  ASSERT_EQ(whole.pixels.size(), indirect.pixels.size());
  float max_whole = 0.0F, max_indirect = 0.0F;
  for (std::size_t k = 0; k < whole.pixels.size(); ++k) {
    EXPECT_LE(indirect.pixels[k].r, 1.0001F * whole.pixels[k].r + 1e-6F);
    max_whole = std::max(max_whole, whole.pixels[k].r);
    max_indirect = std::max(max_indirect, indirect.pixels[k].r);
  }
  EXPECT_GT(max_indirect, 0.0F);
  EXPECT_LT(max_indirect, 0.7F * max_whole);
  EXPECT_FALSE(baked.root.contains("extensions")) << "a variant without direct light would be no picture";
}

TEST_F(Bake, WhatItCannotDoIsOneLine) {
  write_room(folder_ / "room.glb", tiny_room());
  const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& what) {
    arguments.insert(arguments.begin(), "bake");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << what;
    const std::string err = without_progress(outcome.err);
    EXPECT_THAT(err, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.glb"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.lightmap.exr"));
  };
  refused({"room.glb", "-o", "b.gltf"}, 4, "a baked scene is a .glb file");
  refused({"room.glb", "-o", "b.glb", "--lightmap-size", "7"}, 2, "'7' is no whole number from 16 to 16384");
  refused({"room.glb", "-o", "b.glb", "--direct", "maybe"}, 2, "'maybe' is neither on nor off");
  refused({gallery("meninas.gltf"), "-o", "b.glb", "--lightmap-size", "16", "--quality", "draft"}, 2,
          "16 is too small for ");
  ASSERT_EQ(run({"solve", "room.glb", "-o", "s.glb", "--quality", "draft"}).code, 0);
  refused({gallery("furnace.gltf"), "--solution", "s.glb", "-o", "b.glb"}, 3, "is not a solution of");
  refused({"room.glb", "--solution", "s.glb", "-o", "b.glb", "--solver", "jacobi"}, 2, "has no effect with --solution");
}

TEST_F(Bake, ASmallMapIsCoarserAndSaysSo) {
  const GlbContent baked = bake(tiny_room(), {"--lightmap-size", "24"});
  EXPECT_THAT(said_, HasSubstr("--lightmap-size 24: the finest texels are "));
  const auto png = read_file(folder_ / "baked.lightmap.png");
  const Bitmap map = decode_image(std::as_bytes(std::span(png)), Encoding::linear, "lightmap");
  EXPECT_LE(map.width, 24);
  EXPECT_LE(map.height, 24);
}

} // namespace
} // namespace meninas::test
