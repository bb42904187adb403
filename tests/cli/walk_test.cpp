// `walk`: its page shows what the program renders, works in a browser, and is whole and of the scene's own solution.
#include "tests/cli/browser.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"
#include "tests/cli/walk_pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using Walk = WalkPages;

/// Presses Enter once there is a picture.
constexpr const char* met_in_the_middle =
    "const text = id => document.getElementById(id).textContent;"
    "for (let k = 0; k < 300 && !text('figures') && !document.body.dataset.problem; ++k)"
    "  await new Promise(r => setTimeout(r, 50));"
    "dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter' }));"
    "return { met: text('met'), problem: document.body.dataset.problem || '' };";

void add_node(TinyRoom& room, const json& node) {
  room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size());
  room.root["nodes"].push_back(node);
}

struct TruthCase {
  const char* scene;
  const char* camera;
  const char* exposure; ///< about that of its PNG, stops
  std::size_t min_worlds; ///< the room and its images
  double max_flip = 0.02;
  std::size_t draws_beside = 0; ///< beside one to a world: what panes and rough mirrors ask for
};

class WalkTruth : public Walk, public testing::WithParamInterface<TruthCase> {};

// Both show the same field. What is left of FLIP is the field between vertices, linear in triangles
// beside bilinear in quads, and the edges of lamps.
TEST_P(WalkTruth, ThePageShowsWhatTheProgramRenders) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  const auto& [scene, camera, exposure, min_worlds, max_flip, draws_beside] = GetParam();
  const json said = page_beside_picture({gallery(scene), camera, exposure});
  if (said.is_null())
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_LE(said.at("flip").get<double>(), max_flip);
  const std::size_t worlds = said.at("figures").at("worlds");
  EXPECT_GE(worlds, min_worlds);
  EXPECT_LE(said.at("figures").at("draws").get<std::size_t>(), worlds + draws_beside);
  EXPECT_EQ(said.at("figures").at("cut"), 0);
}

INSTANTIATE_TEST_SUITE_P(Gallery, WalkTruth,
                         testing::Values(TruthCase{"meninas.gltf", "main", "1", 4},
                                         TruthCase{"facing-mirrors.gltf", "main", "1", 11},
                                         // Twelve sets of panes in eight worlds, six of them green: two draws.
                                         TruthCase{"glass-screen.gltf", "main", "1", 14, 0.02, 18},
                                         TruthCase{"lattice.gltf", "main", "-2", 2},
                                         TruthCase{"half-room.gltf", "main", "1", 2},
                                         TruthCase{"periscope.gltf", "eyepiece", "1", 3},
                                         TruthCase{"sunbeam.gltf", "main", "-1", 3},
                                         TruthCase{"cornell-mirror.gltf", "main", "1", 2},
                                         TruthCase{"blender-room.glb", "Camera", "1", 2},
                                         TruthCase{"cornell.gltf", "main", "1.5", 1},
                                         TruthCase{"no-mirror.gltf", "main", "-1", 1},
                                         TruthCase{"doubled-room.gltf", "main", "0.5", 1},
                                         TruthCase{"mirror-spot.gltf", "main", "4", 1},
                                         TruthCase{"furnace.gltf", "main", "-1.5", 1},
                                         TruthCase{"globillum-1.gltf", "main", "3.5", 1},
                                         // 0.0058; 0.0083 where worlds are drawn beside their windows.
                                         TruthCase{"globillum-2.gltf", "main", "5", 1, 0.007},
                                         TruthCase{"globillum-3.gltf", "main", "3.5", 1},
                                         TruthCase{"solar-row.gltf", "main", "-6.5", 1},
                                         // A draw to each rough mirror. 0.0198.
                                         TruthCase{"roughness-sweep.gltf", "main", "1", 12, 0.02, 5}),
                         [](const auto& instance) { return test_name(instance.param.scene); });

struct MirrorWalls {
  const char* name;
  std::vector<std::size_t> walls; ///< of the tiny room, which stand for mirrors
  std::size_t min_worlds;
};

class WalkBetweenMirrors : public Walk, public testing::WithParamInterface<MirrorWalls> {};

// A draw to a world, however many: also where the windows of several meet in an edge, and one mirror hides a part of others.
TEST_P(WalkBetweenMirrors, AWorldIsOneDraw) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  TinyRoom room = tiny_room();
  for (const std::size_t wall : GetParam().walls)
    room.root["meshes"][wall]["primitives"][0]["material"] = 2;
  room.root["materials"][2]["pbrMetallicRoughness"]["baseColorFactor"] = {0.4, 0.4, 0.4, 1.0}; // eight deep
  write_room(folder_ / "room.glb", room);
  const json said = page_beside_picture({(folder_ / "room.glb").string(), "camera", "1"});
  if (said.is_null())
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  const json& figures = said.at("figures");
  EXPECT_GE(figures.at("worlds").get<std::size_t>(), GetParam().min_worlds);
  EXPECT_EQ(figures.at("draws"), figures.at("worlds"));
  EXPECT_EQ(figures.at("cut"), 0);
  EXPECT_LE(said.at("flip").get<double>(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Rooms, WalkBetweenMirrors,
                         testing::Values(MirrorWalls{"hall", {3, 4}, 4},
                                         MirrorWalls{"three_walls", {2, 3, 4}, 11},
                                         MirrorWalls{"corner", {2, 3}, 4}),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Textures by eights: more than that many ask for a second draw, and both textures of a face are in one.
TEST_F(Walk, TexturesAreDrawnByEights) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_tiny_page();
  const json said = drawn("room.html", "", R"(
    const batches = Array.from({ length: 20 }, (_, k) => [0, k, k % 3 ? -1 : 40 + k, -1, -1, k, 1]);
    const groups = groupSheets(batches);
    return { groups: groups.map(group => group.units.length), without: groupSheets([[0, -1, -1, -1, -1, 0, 1]]).length,
      kept: batches.every(batch => [batch[1], batch[2]].every(texture => texture < 0 || batch.group.units.includes(texture))) };)");
  ASSERT_FALSE(said.is_null());
  EXPECT_EQ(said.at("without"), 1);
  EXPECT_EQ(said.at("groups"), json({8, 8, 8, 3})) << "27 textures";
  EXPECT_TRUE(said.at("kept"));
}

TEST_F(Walk, ThePageIsOneFileThatNeedsNothingElse) {
  write_tiny_page();
  const std::string html = read_file(folder_ / "room.html");
  for (const char* other : {"http://", "https://", " src=", "<link", "import ", "@import", "fetch("})
    EXPECT_THAT(html, Not(HasSubstr(other)));
  EXPECT_THAT(html, HasSubstr("</html>"));
}

TEST_F(Walk, KeysCamerasAndClicksWork) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_tiny_page();
  const json said = drawn("room.html", "camera=camera", R"(
    const text = id => document.getElementById(id).textContent;
    const until = async holds => { for (let k = 0; k < 300 && !holds(); ++k) await new Promise(r => setTimeout(r, 50)); };
    await until(() => text('figures') || document.body.dataset.problem);
    const press = key => dispatchEvent(new KeyboardEvent('keydown', { key }));
    const report = { problem: document.body.dataset.problem || '', first: text('figures'), cameras: document.getElementById('cameras').options.length,
      exposure: text('exposure') };
    press('m'); await until(() => text('figures').startsWith('0'));
    report.without = text('figures');
    press('+'); await until(() => text('exposure') !== report.exposure);
    report.brighter = text('exposure');
    press('f'); await until(() => !document.getElementById('legend').hidden);
    report.legend = !document.getElementById('legend').hidden;
    press('Enter');
    report.met = text('met');
    press('Escape');
    report.closed = document.getElementById('met').hidden;
    press('?');
    report.help = !document.getElementById('help').hidden;
    press('ArrowLeft');
    await new Promise(r => setTimeout(r, 500));
    dispatchEvent(new KeyboardEvent('keyup', { key: 'ArrowLeft' }));
    await until(() => location.hash.startsWith('#at'));
    report.link = location.hash;
    location.hash = '#camera=camera';
    await until(() => document.getElementById('legend').hidden);
    report.followed = document.getElementById('legend').hidden;
    report.outside = performance.getEntriesByType('resource').filter(entry => !/^(data|blob):/.test(entry.name)).length;
    return report;)");
  ASSERT_FALSE(said.is_null());
  if (said.at("problem").get<std::string>().find("WebGL 2") != std::string::npos)
    GTEST_SKIP() << "this Chromium draws no WebGL 2: " << said.at("problem");
  ASSERT_EQ(said.at("problem"), "");
  EXPECT_EQ(said.at("cameras"), 1);
  EXPECT_THAT(said.at("first").get<std::string>(), testing::StartsWith("1 mirror worlds, 1 deep"));
  EXPECT_THAT(said.at("without").get<std::string>(),
              testing::StartsWith("0 mirror worlds, 0 deep"));
  EXPECT_NE(said.at("exposure"), said.at("brighter"));
  EXPECT_TRUE(said.at("legend"));
  EXPECT_THAT(said.at("met").get<std::string>(), HasSubstr("irradiance H"));
  EXPECT_TRUE(said.at("closed"));
  EXPECT_TRUE(said.at("help"));
  const std::string link = said.at("link");
  EXPECT_THAT(link, testing::StartsWith("#at="));
  for (const char* state : {"&exposure=", "&mirrors=off", "&irradiance"})
    EXPECT_THAT(link, HasSubstr(state)) << "a colleague sees the same";
  EXPECT_TRUE(said.at("followed")) << "a link without false colours shows none";
  EXPECT_EQ(said.at("outside"), 0) << "nothing is fetched from anywhere";
}

TEST_F(Walk, WalkersStayInTheRoomAtEyeHeight) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  ASSERT_EQ(run({"walk", gallery("no-mirror.gltf"), "-o", "n.html", "--quality", "draft"}).code, 0);
  const json said = drawn("n.html", "", R"(
    const data = JSON.parse(document.getElementById('data').textContent), tables = await readTables(data);
    const room = readRoom(data, tables), motion = makeMotion(room, makeRays(room)), ends = [];
    for (let turn = 0; turn < 12; ++turn) {
      motion.goTo(data.cameras[0]);
      motion.turn(turn * Math.PI / 6, 0);
      for (let k = 0; k < 80; ++k) motion.go(0.2, 0);
      ends.push(motion.state.eye);
    }
    return { low: room.low, high: room.high, ends };)");
  ASSERT_FALSE(said.is_null());
  for (const json& end : said.at("ends")) {
    for (const std::size_t axis : {0U, 2U}) {
      EXPECT_GT(end.at(axis), said.at("low").at(axis));
      EXPECT_LT(end.at(axis), said.at("high").at(axis));
    }
    EXPECT_GE(end.at(1).get<double>() - said.at("low").at(1).get<double>(), 1.5);
  }
}

TEST_F(Walk, ABrowserWithoutWebGl2IsTold) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_tiny_page();
  std::string html = read_file(folder_ / "room.html");
  html.insert(html.find("<head>"),
              "<script>HTMLCanvasElement.prototype.getContext = () => null;</script>");
  std::ofstream(folder_ / "without.html") << html;
  const json said = browse_page(folder_.path(), (folder_ / "without.html").string(),
                                "return { problem: document.body.dataset.problem || '' };");
  EXPECT_THAT(said.at("problem").get<std::string>(), HasSubstr("WebGL 2"));
}

TEST_F(Walk, WhatFailsWhileDrawingIsTold) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_tiny_page();
  std::string html = read_file(folder_ / "room.html");
  html.insert(html.find("<head>"), "<script>WebGL2RenderingContext.prototype.checkFramebufferStatus = "
                                   "() => 0;</script>");
  std::ofstream(folder_ / "broken.html") << html;
  const json said = drawn("broken.html", "", R"(
    for (let k = 0; k < 300 && !document.body.dataset.problem; ++k) await new Promise(r => setTimeout(r, 50));
    return { problem: document.body.dataset.problem || '' };)");
  ASSERT_FALSE(said.is_null());
  const std::string problem = said.at("problem");
  if (problem.find("draw") != std::string::npos || problem.find("needs WebGL 2") != std::string::npos)
    GTEST_SKIP() << "this Chromium draws no WebGL 2: " << problem;
  EXPECT_THAT(problem, HasSubstr("needs a stencil beside 16-bit floats"));
}

// An unlit sheet, a quarter of which is there, before the room.
TEST_F(Walk, UnlitSheetsCoverTheirShare) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  TinyRoom room = tiny_room();
  room.root["materials"].push_back({{"name", "sheet"},
                                    {"alphaMode", "BLEND"},
                                    {"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.8, 0.8, 0.25}}}},
                                    {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}});
  room.root["extensionsUsed"] = {"KHR_materials_unlit"};
  room.root["meshes"].push_back(room.root["meshes"][2]);
  room.root["meshes"].back()["primitives"][0]["material"] = 3;
  add_node(room, {{"name", "sheet"}, {"mesh", room.root["meshes"].size() - 1}, {"translation", {0.0, 0.0, 1.5}}});
  write_room(folder_ / "room.glb", room);
  const json page = page_beside_picture({(folder_ / "room.glb").string(), "camera", "1"});
  if (page.is_null())
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_LE(page.at("flip").get<double>(), 0.02);
}

// Straight down on a coat that is a little rough: cosines of one, and no NaN (which are black).
TEST_F(Walk, RoughCoatsAreShownFromAbove) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  TinyRoom room = tiny_room();
  room.root["materials"].push_back(room.root["materials"][0]);
  room.root["materials"].back()["pbrMetallicRoughness"]["roughnessFactor"] = 0.15;
  room.root["meshes"][0]["primitives"][0]["material"] = 3;
  room.root["nodes"].back()["translation"] = {0.5, 2.5, 0.5};
  room.root["nodes"].back()["rotation"] = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
  write_room(folder_ / "room.glb", room);
  const json page = page_beside_picture({(folder_ / "room.glb").string(), "camera", "1"});
  if (page.is_null())
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_LE(page.at("flip").get<double>(), 0.02);
}

// Halves end at 65,504 and 6e-8; the sky's own scale stands for what is beyond.
TEST_F(Walk, SkiesOfAnyBrightnessAreKept) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_room(folder_ / "room.glb", tiny_room());
  ASSERT_EQ(run({"render", "room.glb", "-o", "sky.exr", "--size", "32x16", "--quality", "draft"}).code, 0);
  std::vector<double> brightest;
  for (const std::string strength : {"1e9", "1e-9"}) {
    const Outcome page = run({"walk", "room.glb", "-o", "room.html", "--quality", "draft",
                              "--environment", "sky.exr", "--environment-strength", strength});
    ASSERT_EQ(page.code, 0) << page.err;
    const json said = drawn("room.html", "", R"(
      const { sky } = JSON.parse(document.getElementById('data').textContent);
      const halves = new Uint16Array((await inflated(bytesOf(sky.texels))).buffer);
      return { most: sky.scale * Math.max(...halvesToNumbers(halves)) };)");
    ASSERT_FALSE(said.is_null());
    brightest.push_back(said.at("most").get<double>() / std::stod(strength));
  }
  EXPECT_GT(brightest[0], 0.0);
  for (const double most : brightest)
    EXPECT_NEAR(most, brightest[0], 1e-3 * brightest[0]) << "halves have eleven bits";
}

// What the section plane cuts away is neither seen nor met.
TEST_F(Walk, ClicksGoThroughWhatASectionCutsAway) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  TinyRoom room = tiny_room();
  add_node(room, {{"name", "screen"}, {"mesh", 2}, {"translation", {0.0, 0.0, 1.5}}});
  room.root["cameras"][0]["perspective"]["znear"] = 1.2;
  write_room(folder_ / "room.glb", room);
  ASSERT_EQ(run({"walk", "room.glb", "-o", "room.html", "--quality", "draft"}).code, 0);
  const json said = drawn("room.html", "camera=camera", met_in_the_middle);
  ASSERT_FALSE(said.is_null());
  if (!said.at("problem").get<std::string>().empty())
    GTEST_SKIP() << "this Chromium draws no WebGL 2: " << said.at("problem");
  EXPECT_THAT(said.at("met").get<std::string>(), HasSubstr("surfaceback"));
}

// Of a texture the page knows the picture, but not at the click: its factor is the most.
TEST_F(Walk, RadiosityOfWhatIsTexturedIsTheMost) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  ASSERT_EQ(run({"walk", gallery("lattice.gltf"), "-o", "l.html", "--quality", "draft"}).code, 0);
  const json said = drawn("l.html", "", R"(
    const data = JSON.parse(document.getElementById('data').textContent), tables = await readTables(data);
    const room = readRoom(data, tables), rays = makeRays(room), panel = makePanel(data, {});
    const eye = data.cameras[0].position, texts = {};
    for (const [name, direction] of [['floor', [0.01, -1, 0.01]], ['ceiling', [0.01, 1, 0.01]]]) {
      panel.met(lightMet(room, rays, eye, direction));
      texts[name] = document.getElementById('met').textContent;
    }
    return texts;)");
  ASSERT_FALSE(said.is_null());
  EXPECT_THAT(said.at("floor").get<std::string>(), HasSubstr("radiosity B, at most"));
  EXPECT_THAT(said.at("floor").get<std::string>(), HasSubstr("times its texture"));
  EXPECT_THAT(said.at("ceiling").get<std::string>(), Not(HasSubstr("at most")));
}

// Four pixels to one along each side would be 16,384: more than browsers can draw.
TEST_F(Walk, PicturesOfTheLargestSizeAreBounded) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_tiny_page();
  std::string html = read_file(folder_ / "room.html");
  html.insert(html.find("<head>"), R"(<script>
    const storage = WebGL2RenderingContext.prototype.renderbufferStorageMultisample;
    WebGL2RenderingContext.prototype.renderbufferStorageMultisample = function(target, samples, format, width, height) {
      if (width < 100) return storage.call(this, target, samples, format, width, height); // the first draw's
      document.body.dataset.asked = [width, height];
      throw new Error('enough is known');
    };</script>)");
  std::ofstream(folder_ / "large.html") << html;
  const json said = drawn("large.html", "size=4096x4096&shot", R"(
    for (let k = 0; k < 300 && !document.body.dataset.problem; ++k) await new Promise(r => setTimeout(r, 50));
    return { asked: document.body.dataset.asked || '' };)");
  ASSERT_FALSE(said.is_null());
  if (said.at("asked") == "")
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_EQ(said.at("asked"), "4096,4096");
}

// Each page compiles what its room has: curved or rough bodies, rough mirrors, panes.
TEST_F(Walk, EveryShaderIsTaken) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  write_tiny_page();
  const json said = drawn("room.html", "", R"(
    const gl = document.createElement('canvas').getContext('webgl2'), refused = [];
    const none = { colours: [], emissions: [], holes: [] }, sheets = { colours: [0, 3], emissions: [7], holes: [3] };
    const needs = Array.from({ length: 8 }, (_, k) => ({ bodies: k & 1, rough: (k & 2) / 2, panes: (k & 4) / 4, colours: (k & 2) / 2, sky: false, sheets: none }));
    needs.push({ ...needs[0], sky: true, sheets }, { ...needs[7], sky: true, colours: true, sheets });
    for (let k = 0; gl && k < needs.length; ++k)
      try { makePrograms(gl, programsFor(needs[k], Object.keys(viewTransforms)[k % 3])); }
      catch (problem) { refused.push(`${k}: ${problem.message}`); }
    return { gl: Boolean(gl), refused };)");
  ASSERT_FALSE(said.is_null());
  if (said.at("gl") == false)
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_EQ(said.at("refused"), json::array());
}

} // namespace
} // namespace meninas::test
