// Dimmers of `walk`: the page under its lamps is what `render --lamp` shows of the same solution, and it
// answers to whoever moves them.
#include "image/image_file.h"
#include "tests/cli/browser.h"
#include "tests/cli/tiny_room.h"
#include "tests/cli/walk_pages.h"

#include <gmock/gmock.h>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The tiny room with a bulb of another colour.
TinyRoom room_of_two_lamps() {
  TinyRoom room = tiny_room();
  room.root["extensionsUsed"] = json::array({"KHR_lights_punctual"});
  room.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}, {"intensity", 0.3}, {"color", {1.0, 0.6, 0.3}}}});
  room.root["nodes"].push_back({{"name", "desk & \"bulb\""},
                                {"translation", {0.7, 0.3, 0.6}},
                                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size() - 1);
  return room;
}

class WalkDimmers : public WalkPages {
protected:
  void write_page(std::vector<std::string> options) {
    write_room(folder_ / "room.glb", room_of_two_lamps());
    options.insert(options.begin(), {"walk", "room.glb", "-o", "room.html", "--quality", "draft"});
    const Outcome outcome = run(options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
};

struct LampCase {
  const char* name;
  PageCase page; ///< of the gallery
  double max_flip = 0.02;
};

class WalkDimmersTruth : public WalkDimmers, public testing::WithParamInterface<LampCase> {};

// The bound is that of pages without dimmers (walk_test.cpp): halves of each lamp add 2^-11.
TEST_P(WalkDimmersTruth, ThePageShowsWhatTheProgramRenders) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  PageCase page = GetParam().page;
  page.scene = gallery(page.scene);
  const json said = page_beside_picture(page);
  if (said.is_null())
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_LE(said.at("flip").get<double>(), GetParam().max_flip);
}

INSTANTIATE_TEST_SUITE_P(
    Gallery, WalkDimmersTruth,
    testing::Values(
        LampCase{"MeninasWithoutWindows", {"meninas.gltf", "main", "2", {"windows=0"}}},
        LampCase{"MeninasInColours",
                 {"meninas.gltf", "main", "1", {"sun=0.2,0.5,1", "couple-light=3", "windows=2,0.5,0.5"}}},
        LampCase{"HalfRoomByItsReadingLamp",
                 {"half-room.gltf", "main", "3", {"all=0", "reading-lamp=1"}}},
        LampCase{"HalfRoomInColours", {"half-room.gltf", "main", "1", {"lamp=1,0.3,0.1"}}},
        LampCase{"SunbeamWithoutSun", {"sunbeam.gltf", "main", "0.4", {"sun=0"}}},
        // The sky is seen, too.
        LampCase{"SkyWithoutSun",
                 {"solar-row.gltf", "main", "-2", {"all=0", "sky=1,0.5,1"}, {"--sky", "clear", "--sun", "200,40"}}},
        // Lobes by 48 facets, and by what one point sees: as without dimmers.
        LampCase{"RoughBodiesInColours", {"roughness-sweep.gltf", "main", "1", {"lamp=0.4,1,0.6"}}, 0.032}),
    [](const auto& instance) { return instance.param.name; });

// A picture of a sky with a sun in it, each a lamp of its own: the map without its sun is on the page as well.
TEST_F(WalkDimmers, TellTheSunOfASkyFromTheRest) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  Image sky(256, 128);
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x)
      sky.at(x, y) = y < 64 ? glm::vec3(0.5F, 0.8F, 1.2F) : glm::vec3(0.1F);
  sky.at(160, 32) = glm::vec3(5e4F, 4e4F, 3e4F); // 45 degrees up
  write_exr(folder_ / "sky.exr", sky);
  const std::vector<std::string> around{"--environment", (folder_ / "sky.exr").string()};
  for (const std::vector<std::string>& lamps :
       {std::vector<std::string>{"all=0", "sky=2,1,0.5"}, {"all=0", "sun outside=0.5,1,0.5"}, {"sky=0.2", "sun=0"}}) {
    const json said = page_beside_picture({gallery("solar-row.gltf"), "main", "-1", lamps, around});
    if (said.is_null())
      GTEST_SKIP() << "this Chromium draws no WebGL 2";
    EXPECT_LE(said.at("flip").get<double>(), 0.02) << lamps.back();
  }
  const json said = drawn("s.html", "camera=main", R"(
    const data = JSON.parse(document.getElementById('data').textContent), gl = document.createElement('canvas').getContext('webgl2');
    const sky = await makeSky(gl, data.sky), most = texels => Math.max(...texels) * sky.scale;
    return { shown: most(sky.shown), rest: most(sky.rest), sky: data.lamps[data.skyLamp].name, sun: data.lamps[data.sunLamp].name };)");
  ASSERT_FALSE(said.is_null());
  EXPECT_GT(said.at("shown"), 1e4);
  EXPECT_LT(said.at("rest"), 1e2) << "a sun is what is a hundred times the mean (scenes/sky/radiance_map.cpp)";
  EXPECT_EQ(said.at("sky"), "sky");
  EXPECT_EQ(said.at("sun"), "sun outside") << "the scene has a lamp that is called sun";
}

/// What a page says of its dimmers while a script moves them.
constexpr const char* move_dimmers = R"(
    const text = id => document.getElementById(id).textContent, canvas = document.getElementById('view');
    const until = async holds => { for (let k = 0; k < 300 && !holds(); ++k) await new Promise(r => setTimeout(r, 50)); };
    await until(() => text('figures') || document.body.dataset.problem);
    const inputs = kind => [...document.querySelectorAll(`#dimmers input[type=${kind}]`)];
    const move = (input, value) => { input.value = value; input.dispatchEvent(new Event('input', { bubbles: true })); };
    const report = { problem: document.body.dataset.problem || '', names: [...document.querySelectorAll('#dimmers label')].map(l => l.textContent) };
    dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter' }));
    report.met = text('met');
    const picture = async () => { const drawn = canvas.toDataURL(); await until(() => canvas.toDataURL() !== drawn); return canvas.toDataURL(); };
    const first = canvas.toDataURL();
    move(inputs('range')[0], 0);
    [report.says, report.valueText, report.metLess] = [document.querySelector('#dimmers output').textContent, inputs('range')[0].getAttribute('aria-valuetext'), text('met')];
    report.changes = await picture() !== first;
    move(inputs('color')[1], '#ff8000');
    await until(() => location.hash.includes('bulb'));
    [report.link, report.command] = [location.hash, text('command')];
    inputs('range')[0].dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }));
    report.focus = document.activeElement.id;
    dispatchEvent(new KeyboardEvent('keydown', { key: 'l' }));
    await until(() => document.getElementById('lamps-button').getAttribute('aria-pressed') === String(!document.getElementById('lamps').hidden));
    report.toggled = document.getElementById('lamps').hidden;
    const { hash } = location;
    document.getElementById('reset').click();
    await until(() => !location.hash.includes('lamp'));
    [report.resetLink, report.metAgain] = [location.hash, text('met')];
    location.hash = hash;
    await until(() => text('command') === report.command);
    report.followed = text('command');
    return report;)";

TEST_F(WalkDimmers, ChangeThePictureTheNumbersAndTheLink) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_page({"--by-lamp"});
  const json said = drawn("room.html", "camera=camera", move_dimmers);
  ASSERT_FALSE(said.is_null());
  if (said.at("problem").get<std::string>().find("WebGL 2") != std::string::npos)
    GTEST_SKIP() << "this Chromium draws no WebGL 2: " << said.at("problem");
  ASSERT_EQ(said.at("problem"), "");
  EXPECT_THAT(said.at("names").get<std::vector<std::string>>(), ElementsAre("lamp", "desk & \"bulb\""));
  EXPECT_EQ(said.at("says"), "off");
  EXPECT_EQ(said.at("valueText"), "off") << "for those who hear the page";
  EXPECT_NE(said.at("met"), said.at("metLess")) << "numbers of a click follow";
  EXPECT_EQ(said.at("changes"), true);
  const std::string link = said.at("link");
  EXPECT_THAT(link, HasSubstr("&lamp=lamp=0&lamp=desk%20%26%20%22bulb%22=1,0.2159,0"));
  EXPECT_EQ(said.at("command"), "--lamp 'lamp=0' --lamp 'desk & \"bulb\"=1,0.2159,0'");
  EXPECT_EQ(said.at("focus"), "view") << "Escape leads back to the room";
  EXPECT_THAT(said.at("resetLink").get<std::string>(), Not(HasSubstr("lamp=")));
  EXPECT_EQ(said.at("met"), said.at("metAgain"));
  EXPECT_EQ(said.at("followed"), said.at("command")) << "a link brings a colleague to the same light";
}

TEST_F(WalkDimmers, LeaveThePictureAsItIsUntilSomebodyMovesThem) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  const char* shot = "while (!document.body.dataset.shot && !document.body.dataset.problem) await new "
                     "Promise(r => setTimeout(r, 50)); return { shot: document.body.dataset.shot || '' };";
  write_page({});
  const json without = drawn("room.html", "size=96x96&shot", shot);
  write_page({"--by-lamp"});
  const json with = drawn("room.html", "size=96x96&shot", shot);
  ASSERT_FALSE(with.is_null());
  if (without.at("shot") == "")
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  EXPECT_EQ(with, without);
}

// `--lamp` is where the page begins, and what `reset` and a plain link lead to.
TEST_F(WalkDimmers, BeginAsTheCommandLineSays) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_page({"--by-lamp", "--lamp", "all=0;lamp=1,0.5,0.25"});
  const json said = drawn("room.html", "camera=camera&lamp=lamp=2&lamp=nobody=3&lamp=lamp=no", R"(
    const data = JSON.parse(document.getElementById('data').textContent), { top } = data;
    const lamps = makeLamps(data, await readTables(data)), first = lamps.lamps.map(l => l.factor);
    const dark = lamps.lamps[1].halves.some(x => x > 0), whole = Math.max(...lamps.irradiance());
    lamps.take(readAddress().lamps);
    const linked = lamps.lamps.map(l => l.factor), twice = Math.max(...lamps.irradiance());
    for (let k = 0; k < 50; ++k) { lamps.set(lamps.lamps[0], [k / 7, k / 11, k / 13]); lamps.irradiance(); }
    lamps.reset();
    return { first, linked, dark, top, grows: twice / whole, drift: Math.max(...lamps.irradiance()) - whole };)");
  ASSERT_FALSE(said.is_null());
  EXPECT_EQ(said.at("first"), json({{1.0, 0.5, 0.25}, {0.0, 0.0, 0.0}}));
  EXPECT_EQ(said.at("linked"), json({{2.0, 2.0, 2.0}, {0.0, 0.0, 0.0}})) << "what is no lamp or no number is left out";
  EXPECT_EQ(said.at("dark"), true) << "its light is there for whoever wants it";
  EXPECT_GT(said.at("top"), 0.0);
  EXPECT_GT(said.at("grows"), 1.9);
  EXPECT_EQ(said.at("drift"), 0.0) << "sums are made anew";
}

// What is kept of the sums is forgotten once all lamps are as the file has them.
TEST_F(WalkDimmers, AddUpAfterAReset) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not used";
  write_page({"--by-lamp"});
  const json said = drawn("room.html", "camera=camera&lamp=lamp=&lamp=lamp=0x10&lamp=lamp=1,,1", R"(
    const data = JSON.parse(document.getElementById('data').textContent);
    const lamps = makeLamps(data, await readTables(data)), [a, b] = lamps.lamps;
    const begins = lamps.lamps.map(l => l.factor);
    lamps.take(readAddress().lamps);
    const linked = lamps.lamps.map(l => l.factor);
    const fresh = makeLamps(data, await readTables(data));
    const without = (some, lamp) => { some.set(lamp, [0, 0, 0]); return Math.max(...some.irradiance()); };
    const truth = without(fresh, fresh.lamps[1]);
    without(lamps, a); const dark = without(lamps, b);
    lamps.reset(); lamps.irradiance();
    const alone = without(lamps, b);
    return { begins, linked, dark, truth, alone };)");
  ASSERT_FALSE(said.is_null());
  EXPECT_EQ(said.at("linked"), said.at("begins")) << "what --lamp would refuse";
  EXPECT_EQ(said.at("dark"), 0.0);
  EXPECT_GT(said.at("truth"), 0.0);
  EXPECT_EQ(said.at("alone"), said.at("truth")) << "the first lamp burns";
}

// Bodies and rough mirrors show pictures of the room, which are painted anew under other lamps.
TEST_F(WalkDimmers, ReachWhatBodiesShow) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: pages are not drawn";
  ASSERT_EQ(run({"walk", gallery("roughness-sweep.gltf"), "--by-lamp", "-o", "r.html", "--quality", "draft"}).code, 0);
  const json said = drawn("r.html", "shot&size=8x8", R"(
    const make = async () => {
      const data = JSON.parse(document.getElementById('data').textContent), tables = await readTables(data), room = readRoom(data, tables);
      const canvas = document.createElement('canvas'), gl = openGpu(canvas);
      [canvas.width, canvas.height] = [64, 64];
      const painter = makePainter(gl, data, room, [], 16), camera = makeMotion(room, makeRays(room));
      camera.goTo(data.cameras[0]);
      const picture = () => {
        painter.paint(camera.view(1), { mirrors: true, falseColours: false, lines: false, width: 64, height: 64, block: 1, most: 16, facets: 12, exposure: 1 });
        const texels = new Uint8Array(4 * 64 * 64);
        gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, texels);
        return [...texels];
      };
      const fill = () => { let k = 0; while (painter.fillNextProbe()) ++k; return k; };
      return { lamp: room.lamps.lamps[0], lamps: room.lamps, picture, fill };
    };
    const factor = [0.2, 1, 0.5], difference = (a, b) => a.reduce((sum, x, k) => sum + Math.abs(x - b[k]), 0) / a.length;
    const early = await make(), late = await make();
    early.lamps.set(early.lamp, factor); early.fill();
    const filled = late.fill(), white = late.picture();
    late.lamps.set(late.lamp, factor);
    const atOnce = late.picture(), again = late.fill(), truth = early.picture();
    return { filled, again, atOnce: difference(atOnce, truth), white: difference(white, truth), later: difference(late.picture(), truth) };)");
  ASSERT_FALSE(said.is_null());
  EXPECT_GE(said.at("filled"), 1);
  EXPECT_EQ(said.at("filled"), said.at("again"));
  EXPECT_EQ(said.at("later"), 0.0) << "the bits of a page that began so";
  // One lamp is all light here: its ratio is nearly that of the room's mean. Levels of 255.
  EXPECT_LE(said.at("atOnce"), 1.0);
  EXPECT_GE(said.at("white"), 10.0);
}

TEST_F(WalkDimmers, AreRefusedWhereThereIsNothingToDim) {
  write_room(folder_ / "room.glb", room_of_two_lamps());
  ASSERT_EQ(run({"solve", "room.glb", "-o", "s.glb", "--quality", "draft"}).code, 0);
  const Outcome both = run({"walk", "room.glb", "--solution", "s.glb", "--by-lamp", "-o", "r.html"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("--by-lamp: has no effect with --solution"));
  const Outcome together = run({"walk", "room.glb", "--solution", "s.glb", "--lamp", "lamp=0", "-o", "r.html"});
  EXPECT_EQ(together.code, 3);
  EXPECT_THAT(together.err, HasSubstr("does not know its lamps apart"));
  const Outcome unknown = run({"walk", "room.glb", "--by-lamp", "--lamp", "dsk=0", "-o", "r.html", "--quality", "draft"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("there is no lamp 'dsk'"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.html"));
}

TEST_F(WalkDimmers, HaveABoundThatIsSaidBeforeTheWork) {
  TinyRoom room = room_of_two_lamps();
  for (int k = 0; k < 70; ++k) {
    room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size());
    room.root["nodes"].push_back(room.root["nodes"][room.root["nodes"].size() - 1]);
    room.root["nodes"].back()["name"] = "bulb " + std::to_string(k);
  }
  write_room(folder_ / "room.glb", room);
  const Outcome many = run({"walk", "room.glb", "--by-lamp", "-o", "r.html", "--quality", "draft"});
  EXPECT_EQ(many.code, 3);
  EXPECT_EQ(many.err, "meninas: room.glb: has 72 lamps, and a page has dimmers for 64 at the most: give several "
                      "the same `extras.lamp`, or go by --by-lamp material\n");

  // A solution that knows them is shown all the same, unless somebody asks for them.
  ASSERT_EQ(run({"solve", "room.glb", "--by-lamp", "-o", "s.glb", "--quality", "draft"}).code, 0);
  const Outcome shown = run({"walk", "room.glb", "--solution", "s.glb", "-o", "r.html"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.err, HasSubstr("the page has no dimmers: the solution has 72 lamps at "));
  EXPECT_EQ(run({"walk", "room.glb", "--solution", "s.glb", "-o", "r.html", "--lamp", "all=0.5"}).code, 3);
}

} // namespace
} // namespace meninas::test
