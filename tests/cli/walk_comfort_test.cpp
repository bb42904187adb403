// `walk`: its files are small enough to be sent, and its page keeps what someone has asked of all pages.
#include "tests/cli/browser.h"
#include "tests/cli/driven_browser.h"
#include "tests/cli/walk_pages.h"

#include "scenes/gallery/generator/glb_file.h"
#include "scenes/gallery/living_room/living_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <optional>
#include <string>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using WalkComfort = WalkPages;

TEST_F(WalkComfort, TheLargestRoomOfTheGalleryIsSmall) {
  const Outcome outcome = run({"walk", gallery("meninas.gltf"), "-o", "m.html", "--quality", "normal"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(std::filesystem::file_size(folder_ / "m.html"), 2'000'000U);
}

// Half a minute of processor time. Elements of one size with one ray each: the light is poor, the mesh is whole, and its
// light is so uneven that it packs no better than that of a good solution.
TEST_F(WalkComfort, AFurnishedRoomFitsAMail) {
  std::ofstream(folder_ / "living-room.glb", std::ios::binary) << gallery::glb_bytes(gallery::living_room());
  const Outcome outcome = run({"walk", "living-room.glb", "-o", "l.html", "--quality", "draft", "--mesh", "uniform", "--elements", "1000",
                               "--rays", "1", "--interpolation", "average"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string html = read_file(folder_ / "l.html"), begin = R"(<script id="data" type="application/json">)";
  const auto from = html.find(begin) + begin.size();
  const json data = json::parse(html.substr(from, html.find("</script>", from) - from));
  std::size_t triangles = 0;
  for (const json& table : data.at("tables"))
    if (table.at("name") == "triangles")
      triangles = table.at("rows");
  EXPECT_GE(triangles, 300'000U);
  EXPECT_LE(html.size(), 15'000'000U);
}

/// Opens the tiny room's page for someone with such preferences, waits for its picture, and does that.
class WalkPreferences : public WalkPages {
protected:
  json done(const std::vector<std::pair<std::string, std::string>>& features, const std::string& use) {
    const std::string page = browser_->open("file://" + (folder_ / "room.html").string());
    browser_->prefer(page, features);
    json said = browser_->run(page, R"(
      const { body } = document, until = async holds => { for (let k = 0; k < 600 && !holds(); ++k) await new Promise(r => setTimeout(r, 50)); };
      const press = key => { for (const kind of ['keydown', 'keyup']) dispatchEvent(new KeyboardEvent(kind, { key })); };
      await until(() => body.classList.contains('shown') || body.dataset.problem);
      if (body.dataset.problem) return { problem: body.dataset.problem };)" + use);
    browser_->close(page);
    return said;
  }
  void SetUp() override {
    if (!has_browser())
      GTEST_SKIP() << "no Chromium here: pages are not used";
    write_tiny_page();
    browser_.emplace(folder_.path());
  }
  std::optional<DrivenBrowser> browser_;
};

/// The least contrast of text to what is behind it, (L1 + 0.05) / (L2 + 0.05) of WCAG 2.2, and how bright that is.
constexpr const char* legibility = R"(
  const linear = x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
  const luminance = text => { const [r, g, b] = text.match(/[\d.]+/g).map(x => linear(Number(x) / 255)); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const card = luminance(getComputedStyle(document.getElementById('bar')).backgroundColor), contrasts = {};
  press('?');
  for (const one of ['title', 'figures', 'mirrors', 'cameras', 'exposure']) {
    const text = luminance(getComputedStyle(document.getElementById(one)).color);
    contrasts[one] = (Math.max(text, card) + 0.05) / (Math.min(text, card) + 0.05);
  }
  return { card, contrasts };)";

TEST_F(WalkPreferences, DarkAndLightPanelsAreThoseAskedForAndLegible) {
  for (const std::string scheme : {"dark", "light"}) {
    const json said = done({{"prefers-color-scheme", scheme}}, legibility);
    if (said.contains("problem"))
      GTEST_SKIP() << "this Chromium draws no WebGL 2: " << said.at("problem");
    if (scheme == "dark")
      EXPECT_LT(said.at("card"), 0.05);
    else
      EXPECT_GT(said.at("card"), 0.8);
    for (const auto& [name, contrast] : said.at("contrasts").items())
      EXPECT_GE(contrast.get<double>(), 4.5) << scheme << ", " << name << ": level AA of WCAG 2.2";
  }
}

/// Frames while nobody does anything, and frames and animations after each key of what could fly: a camera, orbiting, panels.
constexpr const char* stillness = R"(
  const rest = () => new Promise(r => setTimeout(r, 1500)), ask = requestAnimationFrame.bind(window);
  const animations = [], moved = {};
  await rest();
  let asked = 0;
  window.requestAnimationFrame = draw => { ++asked; return ask(draw); };
  await new Promise(r => setTimeout(r, 1000));
  const idle = asked;
  for (const key of ['ArrowLeft', 'c', 'o', 'm', 'f', '?', 'Enter']) {
    asked = 0;
    press(key);
    for (let k = 0; k < 3; ++k) await new Promise(ask); // what it starts is there after its frame
    animations.push(document.getAnimations().length);
    await rest();
    moved[key] = asked;
  }
  return { reduced: matchMedia('(prefers-reduced-motion: reduce)').matches, idle, moved, animations };)";

// A key draws one picture of what it asks for and one at rest, which may be followed by finer ones of the same view: nothing
// flies, glides or fades, whoever asks.
TEST_F(WalkPreferences, NothingMovesByItself) {
  for (const bool reduced : {true, false}) {
    const json said = done({{"prefers-reduced-motion", reduced ? "reduce" : "no-preference"}}, stillness);
    if (said.contains("problem"))
      GTEST_SKIP() << "this Chromium draws no WebGL 2: " << said.at("problem");
    EXPECT_EQ(said.at("reduced"), reduced);
    EXPECT_EQ(said.at("idle"), 0) << "frames while nobody does anything";
    for (const auto& [key, frames] : said.at("moved").items())
      EXPECT_LE(frames.get<int>(), 4) << key;
    EXPECT_THAT(said.at("animations").get<std::vector<int>>(), testing::Each(0));
  }
}

} // namespace
} // namespace meninas::test
