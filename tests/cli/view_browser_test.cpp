// `view` in a real browser: the first picture, that the camera moves while it solves, pass two's picture and its
// files, the keys, and that the room follows its file.
#include "image/image_file.h"
#include "tests/cli/browser.h"
#include "tests/cli/driven_browser.h"
#include "tests/cli/tiny_room.h"
#include "tests/cli/view_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// until(holds), press(key), text(id), status() for the scripts below.
const std::string helpers = R"(
  const until = async holds => { for (let k = 0; k < 1200 && !holds(); ++k) await new Promise(r => setTimeout(r, 50)); return Boolean(holds()); };
  const press = (key, more = {}) => dispatchEvent(new KeyboardEvent('keydown', { key, ...more }));
  const text = id => (document.getElementById(id) || {}).textContent || '';
  const status = () => JSON.parse(document.body.dataset.status || '{}'), data = document.body.dataset;
)";

class ViewBrowser : public testing::Test {
protected:
  void SetUp() override {
    if (!has_browser())
      GTEST_SKIP() << "no Chromium here: pages are not used";
    write_room(folder_ / "room.glb", tiny_room());
    browser_.emplace(folder_.path());
  }
  /// Opens the page and waits for its first picture; false where this browser draws none.
  bool open(const ViewProgram& view) {
    page_ = browser_->open(view.address());
    const json said = run("await until(() => text('figures') || data.problem); return { figures: text('figures'), problem: data.problem || '' };");
    return said.is_object() && said.at("problem").get<std::string>().find("WebGL 2") == std::string::npos &&
           !said.at("figures").get<std::string>().empty();
  }
  /// 0 to 1, of all that is on the screen.
  double mean_of_picture() {
    browser_->take_picture(page_, folder_ / "screen.png");
    double sum = 0.0;
    const Image picture = read_image(folder_ / "screen.png").picture;
    for (const glm::vec3& pixel : picture.pixels)
      sum += double{pixel.r + pixel.g + pixel.b} / 3.0;
    return sum / double(picture.pixels.size());
  }
  json run(const std::string& use) { return browser_->run(page_, helpers + use); }

  TemporaryFolder folder_;
  std::optional<DrivenBrowser> browser_;
  std::string page_;
};

#define OPEN_OR_SKIP(view) \
  if (!open(view))         \
  GTEST_SKIP() << "this Chromium draws no WebGL 2"

TEST_F(ViewBrowser, TheCameraMovesWhileItSolvesAndEveryShotIsSeen) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  OPEN_OR_SKIP(view);
  const double dark = mean_of_picture();
  ASSERT_TRUE(run("press('n'); return until(() => data.state === '2' && text('figures'));").get<bool>());
  run("await new Promise(r => setTimeout(r, 1000));");
  EXPECT_GT(mean_of_picture(), dark + 0.02) << "the first picture has the light of the lamps, and the ambient term";
  const json said = run(R"(
    const report = { states: [data.state] };
    press('n'); await until(() => status().shots === 1 && data.state === '3'); report.states.push(data.state);
    const before = location.hash;
    press('ArrowLeft'); await new Promise(r => setTimeout(r, 300)); dispatchEvent(new KeyboardEvent('keyup', { key: 'ArrowLeft' }));
    report.moved = await until(() => location.hash !== before && location.hash.startsWith('#at'));
    report.solvedMeanwhile = status().solved;
    report.ambient = document.getElementById('live-ambient').getAttribute('aria-pressed');
    press('t'); report.without = document.getElementById('live-ambient').getAttribute('aria-pressed');
    press('p'); report.solved = await until(() => status().solved && status().state === Number(data.state));
    report.text = text('live-status'); report.problem = data.problem || '';
    return report;)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("problem"), "");
  EXPECT_EQ(said.at("states"), (json{"2", "3"}));
  EXPECT_EQ(said.at("moved"), true);
  EXPECT_EQ(said.at("solvedMeanwhile"), false);
  EXPECT_EQ(said.at("ambient"), "true");
  EXPECT_EQ(said.at("without"), "false");
  EXPECT_EQ(said.at("solved"), true);
  EXPECT_THAT(said.at("text").get<std::string>(), HasSubstr("error below"));
}

// What the page has at last is what `walk` has of the same solution, in halves of the same scale.
TEST_F(ViewBrowser, ThePageEndsWithTheLightOfTheSolution) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  OPEN_OR_SKIP(view);
  const json said = run(R"(
    await until(() => status().solved && Number(data.state) === status().state);
    const { data: room, ambient } = await (await fetch(location.pathname + 'room')).json(), tables = await readTables(room);
    const light = await readLight(await (await fetch(location.pathname + 'light')).arrayBuffer());
    return { same: tables.irradiance.every((x, k) => x === light.bits[k]), scale: light.scale === room.light, ambient,
      bits: tables.triangles.reduce((sum, v) => [0, 1, 2].reduce((s, k) => (31 * s + tables.irradiance[3 * v + k]) % 1000003, sum), 7),
      corners: tables.triangles.length };)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("same"), true);
  EXPECT_EQ(said.at("scale"), true);
  EXPECT_EQ(said.at("ambient"), (json{0.0, 0.0, 0.0}));
  ASSERT_EQ(run_program(folder_.path(), {"walk", "room.glb", "--quality", "draft", "-o", "room.html"}).code, 0);
  page_ = browser_->open("file://" + (folder_ / "room.html").string());
  const json walked = run(R"(
    const tables = await readTables(JSON.parse(document.getElementById('data').textContent));
    return { bits: tables.triangles.reduce((sum, v) => [0, 1, 2].reduce((s, k) => (31 * s + tables.irradiance[3 * v + k]) % 1000003, sum), 7),
      corners: tables.triangles.length };)");
  ASSERT_TRUE(walked.is_object());
  EXPECT_EQ(said.at("bits"), walked.at("bits"));
  EXPECT_EQ(said.at("corners"), walked.at("corners"));
}

TEST_F(ViewBrowser, PassTwoShowsWhatRestsAndIsSaved) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  OPEN_OR_SKIP(view);
  const std::filesystem::path saved = folder_ / "saved";
  std::filesystem::create_directory(saved);
  browser_->save_into(saved);
  const json said = run(R"(
    const report = { whole: await until(() => data.resting === 'whole') };
    press('ArrowRight'); await new Promise(r => setTimeout(r, 100)); report.gone = data.resting === undefined;
    dispatchEvent(new KeyboardEvent('keyup', { key: 'ArrowRight' }));
    report.again = await until(() => data.resting === 'whole');
    report.shown = Math.max(...[...document.querySelectorAll('.resting.shown')].map(layer => layer.naturalWidth));
    report.wide = document.getElementById('view').clientWidth;
    press('s', { ctrlKey: true }); await until(() => text('said').includes('meninas render'));
    report.command = document.querySelector('#said code').textContent; report.problem = data.problem || '';
    return report;)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("problem"), "");
  for (const char* what : {"whole", "gone", "again"})
    EXPECT_EQ(said.at(what), true) << what;
  EXPECT_EQ(said.at("shown"), said.at("wide"));
  const std::string command = said.at("command");
  ASSERT_THAT(command, HasSubstr("meninas render room.glb"));
  ASSERT_THAT(command, HasSubstr("--eye="));
  for (int k = 0; k < 200 && !(std::filesystem::exists(saved / "room.png") && std::filesystem::exists(saved / "room.exr")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::vector<std::string> words;
  std::istringstream in(command.substr(command.find(' ') + 1));
  for (std::string word; in >> word;)
    words.push_back(word);
  const Outcome outcome = run_program(folder_.path(), words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"room.exr", "room.png"})
    EXPECT_TRUE(read_file(saved / name) == read_file(folder_ / name)) << name << " of " << command;
}

TEST_F(ViewBrowser, TheRoomFollowsItsFile) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  OPEN_OR_SKIP(view);
  ASSERT_EQ(run("return until(() => status().solved && Number(data.state) === status().state);"), true);
  std::ofstream(folder_ / "room.glb") << "nonsense";
  const json broken = run("await until(() => status().problem); return { line: document.querySelector('#live .wrong').textContent, "
                          "hidden: document.querySelector('#live .wrong').hidden, rows: text('figures') };");
  ASSERT_TRUE(broken.is_object());
  EXPECT_THAT(broken.at("line").get<std::string>(), HasSubstr("room.glb"));
  EXPECT_EQ(broken.at("hidden"), false);
  TinyRoom other = tiny_room();
  other.root["cameras"][0]["perspective"]["yfov"] = 0.5;
  for (auto& node : other.root["nodes"])
    if (node.contains("camera"))
      node["name"] = "another";
  write_room(folder_ / "room.glb", other);
  const json said = run(R"(
    const report = { camera: await until(() => document.getElementById('cameras').options[0].text.startsWith('another')) };
    report.solved = await until(() => status().solved && Number(data.state) === status().state);
    report.hidden = document.querySelector('#live .wrong').hidden; report.problem = data.problem || '';
    return report;)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("problem"), "");
  EXPECT_EQ(said.at("camera"), true);
  EXPECT_EQ(said.at("solved"), true);
  EXPECT_EQ(said.at("hidden"), true);
}

// Neither while another room is solved, nor over false colours; and none is made meanwhile.
TEST_F(ViewBrowser, PassTwosPictureGoesWithItsRoom) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  OPEN_OR_SKIP(view);
  ASSERT_EQ(run("return until(() => data.resting === 'whole' && Number(data.state) === status().state);"), true);
  EXPECT_EQ(run("press('f'); return data.resting === undefined && !document.querySelector('.resting.shown');"), true);
  ASSERT_EQ(run("await new Promise(r => setTimeout(r, 1000)); const none = data.resting === undefined; press('f'); return none && until(() => data.resting === 'whole');"), true);
  run(R"(
    window.wrong = 0; window.unsolved = 0;
    new MutationObserver(() => { if (!status().solved) { ++unsolved; if (data.resting !== undefined) setTimeout(() => { if (!status().solved && data.resting !== undefined) ++wrong; }); } })
      .observe(document.body, { attributes: true }); return 0;)");
  TinyRoom other = tiny_room();
  other.root["nodes"][0]["name"] = "another";
  write_room(folder_ / "room.glb", other);
  const json said = run(R"(
    const report = { begun: await until(() => window.unsolved) };
    press('s', { ctrlKey: true });
    report.resting = await until(() => status().solved && data.resting === 'whole' && Number(data.state) === status().state);
    report.wrong = window.wrong; report.problem = data.problem || '';
    return report;)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("problem"), "");
  EXPECT_EQ(said.at("begun"), true);
  EXPECT_EQ(said.at("resting"), true);
  EXPECT_EQ(said.at("wrong"), 0);
}

// G: all factors of what is under the cursor, those by mirrors, none; the page's sums are the server's, and its numbers add up to them.
TEST_F(ViewBrowser, FormFactorsAreShownInPlaceOfTheLight) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  OPEN_OR_SKIP(view);
  ASSERT_EQ(run("return until(() => data.resting === 'whole' && Number(data.state) === status().state);"), true);
  const double lit = mean_of_picture();
  const json said = run(R"(
    const report = { title: text('legend') }, canvas = document.getElementById('view');
    canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: 0.7 * canvas.clientWidth, clientY: 0.4 * canvas.clientHeight, pointerId: 1 }));
    press('g'); report.shown = await until(() => data.factors); report.all = JSON.parse(data.factors || '{}');
    report.legend = await until(() => !document.getElementById('legend').hidden); report.other = text('legend') !== report.title; report.resting = data.resting || '';
    const answer = await askFor(`factors?room=${status().room}&element=${report.all.element}`), row = await readFactors(await answer.arrayBuffer());
    report.sum = row.direct.reduce((a, b) => a + b) + row.mirrored.reduce((a, b) => a + b); report.said = row.sums[0] + row.sums[1];
    await new Promise(r => setTimeout(r, 1200)); report.text = text('said');
    return report;)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("shown"), true);
  ASSERT_EQ(said.at("all").value("part", ""), "all");
  for (const char* what : {"legend", "other"})
    EXPECT_EQ(said.at(what), true) << what;
  EXPECT_EQ(said.at("resting"), "") << "pass two's picture does not hide them";
  EXPECT_NEAR(said.at("sum").get<double>(), said.at("said").get<double>(), 1e-3); // halves
  EXPECT_GT(said.at("all").at("mirrored").get<double>(), 0.0);
  EXPECT_THAT(said.at("text").get<std::string>(), HasSubstr("by way of mirrors"));
  const double coloured = mean_of_picture();
  EXPECT_GT(std::abs(coloured - lit), 0.02) << "another picture is shown";
  const json after = run(R"(
    const report = {};
    press('g'); await until(() => data.factors.includes('mirrored"')); report.part = JSON.parse(data.factors).part; await new Promise(r => setTimeout(r, 500));
    press('g'); report.gone = await until(() => data.factors === undefined); report.again = await until(() => data.resting === 'whole'); report.hidden = document.getElementById('legend').hidden;
    press('g'); await until(() => data.factors); press('Escape'); report.escaped = data.factors === undefined; report.problem = data.problem || '';
    return report;)");
  ASSERT_TRUE(after.is_object());
  EXPECT_EQ(after.at("problem"), "");
  EXPECT_EQ(after.at("part"), "mirrored");
  for (const char* what : {"gone", "again", "hidden", "escaped"})
    EXPECT_EQ(after.at(what), true) << what;
}

TEST_F(ViewBrowser, GatheringAndConstantElementsByKey) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  OPEN_OR_SKIP(view);
  const json said = run(R"(
    const report = {};
    press('v'); report.gathers = await until(() => status().gathers && status().stage === 'dark' && Number(data.state) === status().state);
    press('n'); await until(() => status().stage === 'sweeps'); press('n');
    report.sweeps = await until(() => status().shots === 1 && Number(data.state) === status().state); report.text = text('live-status'); report.button = text('live-solver');
    press('i'); report.constant = await until(() => document.getElementById('live-constant').getAttribute('aria-pressed') === 'true' && data.apart && Number(data.state) === status().state);
    press('i'); press('v'); report.shoots = await until(() => !status().gathers && status().stage === 'dark');
    press('p'); report.solved = await until(() => status().solved && Number(data.state) === status().state); report.problem = data.problem || '';
    return report;)");
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said.at("problem"), "");
  for (const char* what : {"gathers", "sweeps", "constant", "shoots", "solved"})
    EXPECT_EQ(said.at(what), true) << what;
  EXPECT_THAT(said.at("text").get<std::string>(), HasSubstr("1 sweeps"));
  EXPECT_THAT(said.at("button").get<std::string>(), HasSubstr("gathering"));
}

// The mean of its corners everywhere on an element, and the light as it was again; elements have the vertices of no other.
TEST_F(ViewBrowser, ElementsApartShowTheSameLight) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft"});
  OPEN_OR_SKIP(view);
  const json said = run(R"(
    await until(() => status().solved && Number(data.state) === status().state);
    const { data: room } = await (await fetch(location.pathname + 'room')).json(), whole = await readTables(room), tables = await readTables(room);
    splitElements(tables);
    const report = { same: tables.triangles.every((v, k) => tables.from[v] === whole.triangles[k]), once: true, constant: true, mean: 0 }, seen = new Map();
    tables.triangles.forEach((v, k) => { const e = elementOfTriangle(tables, Math.floor(k / 3)); if (seen.has(v) && seen.get(v) !== e) report.once = false; seen.set(v, e); });
    report.bits = atOwnVertices(tables, whole.irradiance, 3).every((x, k) => x === tables.irradiance[k]);
    const values = Float32Array.from(tables.irradiance), means = meansOfElements(tables, values), first = new Map();
    tables.elementOf.forEach((e, v) => { if (!first.has(e)) first.set(e, v); if (means[3 * v] !== means[3 * first.get(e)]) report.constant = false; });
    report.mean = Math.abs(means.reduce((a, b) => a + b, 0) / values.reduce((a, b) => a + b, 0) - 1);
    return report;)");
  ASSERT_TRUE(said.is_object());
  for (const char* what : {"same", "once", "constant", "bits"})
    EXPECT_EQ(said.at(what), true) << what;
  EXPECT_LT(said.at("mean").get<double>(), 1e-5) << "single precision";
}

TEST_F(ViewBrowser, ThreeBrowsersSeeTheSame) {
  const ViewProgram view(folder_.path(), {"room.glb", "--quality", "draft", "--paused"});
  OPEN_OR_SKIP(view);
  const std::string first = page_;
  page_ = browser_->open(view.address());
  const std::string second = page_;
  ASSERT_EQ(run("return until(() => data.state === '1');"), true);
  browser_->close(browser_->open(view.address()));
  ASSERT_EQ(view.post("step").status, 204);
  for (const std::string& page : {first, second}) {
    page_ = page;
    EXPECT_EQ(run("return until(() => data.state === '2');"), true);
  }
  ASSERT_EQ(view.post("go-on").status, 204);
  EXPECT_TRUE(view.status_when_solved().is_object());
}

} // namespace
} // namespace meninas::test
