// `trade`: its files, that they agree, and that nothing is half there.
#include "tests/cli/browser.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class Trade : public testing::Test {
protected:
  Trade() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome trade(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"trade", "room.glb", "-o", "out"});
    return run_program(folder_.path(), arguments);
  }
  json figures() { return json::parse(read_file(folder_ / "out/trade.json")); }

  TemporaryFolder folder_;
};

TEST_F(Trade, WritesFiguresATableAndAPageThatAgree) {
  const Outcome outcome = trade({"--size", "24x16", "--budget", "1.5", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files_in(folder_ / "out"), ElementsAre("index.html", "trade.csv", "trade.json"));

  const json said = figures();
  EXPECT_EQ(said.at("reference").at("kind"), "path tracer");
  EXPECT_GT(said.at("reference").at("noise"), 0.0);
  // Who reads the file knows these names: a key keeps its own (docs/versioning.md).
  for (const char* key : {"points", "front", "knobs", "conclusion", "version"})
    EXPECT_TRUE(said.contains(key)) << key;
  for (const json& knob : said.at("knobs"))
    EXPECT_TRUE(knob.contains("knob"));
  const json& points = said.at("points");
  ASSERT_GE(points.size(), 2U);
  for (const json& point : points) {
    EXPECT_GT(point.at("seconds"), 0.0);
    EXPECT_GE(point.at("error"), 0.0);
    const bool on_front =
        std::ranges::find(said.at("front"), point.at("id")) != said.at("front").end();
    EXPECT_EQ(point.at("front"), on_front);
    EXPECT_THAT(point.at("command").get<std::string>(),
                StartsWith("meninas render room.glb -o out.exr --size 24x16 "));
    // Nothing beats a point of the front in both.
    for (const json& other : points) {
      const bool beaten =
          other.at("seconds") < point.at("seconds") && other.at("error") < point.at("error");
      EXPECT_FALSE(on_front && beaten);
    }
  }

  // The page carries the very figures of the JSON, and a picture of each point.
  const std::string page = read_file(folder_ / "out/index.html");
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto from = page.find(begin) + begin.size();
  const json shown = json::parse(page.substr(from, page.find("</script>", from) - from));
  EXPECT_EQ(shown.at("trade"), said);
  ASSERT_EQ(shown.at("thumbnails").size(), points.size());
  for (const json& picture : shown.at("thumbnails"))
    EXPECT_THAT(picture.get<std::string>(), StartsWith("data:image/png;base64,"));

  // The table has a line for each, with the same numbers.
  const std::string table = read_file(folder_ / "out/trade.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), static_cast<std::ptrdiff_t>(points.size() + 1));
  EXPECT_THAT(table, HasSubstr("\n1," + points.at(1).at("front").dump() + ',' +
                               points.at(1).at("seconds").dump() + ','));
}

TEST_F(Trade, ItsPageIsUsedByKeyboardAndInANarrowWindow) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: the page is not used";
  ASSERT_EQ(trade({"--size", "24x16", "--budget", "0.5", "--quiet"}).code, 0);
  const json report = browse_page(folder_.path(), (folder_ / "out/index.html").string(), R"(
    const dots = [...document.querySelectorAll('circle[data-id]')], last = dots.at(-1);
    const report = { reached: [...document.querySelectorAll('[data-id]')].every(node => node.getAttribute('tabindex') === '0'),
      buttons: dots.every(dot => dot.getAttribute('role') === 'button' && dot.getAttribute('aria-label')) };
    last.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
    report.chosen = document.getElementById('what').textContent.startsWith(`Setting ${last.dataset.id}:`);
    report.pressed = last.getAttribute('aria-pressed');
    report.copies = document.querySelectorAll('#command button').length;
    report.chart = document.getElementById('chart').getBoundingClientRect().width;
    report.wider = document.documentElement.scrollWidth > window.innerWidth;
    return report;)",
                                  400);
  EXPECT_TRUE(report.at("reached"));
  EXPECT_TRUE(report.at("buttons"));
  EXPECT_TRUE(report.at("chosen"));
  EXPECT_EQ(report.at("pressed"), "true");
  EXPECT_EQ(report.at("copies"), 1);
  EXPECT_GE(report.at("chart"), 640) << "its text can be read";
  EXPECT_FALSE(report.at("wider")) << "the page itself does not scroll sideways";
}

TEST_F(Trade, CommandsMakeThePicturesTheyStandFor) {
  ASSERT_EQ(trade({"--size", "24x16", "--budget", "0.1", "--quiet", "--seed", "5"}).code, 0);
  std::vector<std::string> arguments{"render", "room.glb", "-o",      "again.exr", "--size",
                                     "24x16",  "--quiet",  "--stats", "again.json"};
  const json point = figures().at("points").at(0);
  for (const json& option : point.at("options"))
    arguments.push_back(option);
  const Outcome outcome = run_program(folder_.path(), arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json again = json::parse(read_file(folder_ / "again.json"));
  EXPECT_EQ(again.at("mesh").at("elements"), point.at("elements"));
  EXPECT_DOUBLE_EQ(again.at("error_estimate").at("total").get<double>(),
                   point.at("estimate").get<double>())
      << "the same picture, to the last bit";
}

TEST_F(Trade, MeasuresAgainstAFile) {
  ASSERT_EQ(
      run_program(folder_.path(), {"render", "room.glb", "-o", "truth.exr", "--size", "20x16",
                                   "--mode", "reference", "--samples", "64", "--float", "--quiet"})
          .code,
      0);
  ASSERT_EQ(trade({"--reference", "truth.exr", "--budget", "0.1", "--quiet"}).code, 0);
  const json said = figures();
  EXPECT_EQ(said.at("width"), 20);
  EXPECT_EQ(said.at("reference").at("kind"), "file");
  EXPECT_EQ(said.at("reference").at("name"), "truth.exr");
  EXPECT_GT(said.at("reference").at("noise"), 0.0) << "its variance came with it";
}

TEST_F(Trade, ErrorsAreNamedAndLeaveNothing) {
  EXPECT_EQ(trade({"--budget", "0"}).code, 2);
  EXPECT_EQ(trade({"--reference", "missing.exr"}).code, 3);
  EXPECT_EQ(run_program(folder_.path(), {"trade", "missing.glb", "-o", "out"}).code, 3);
  EXPECT_EQ(run_program(folder_.path(), {"trade", "room.glb"}).code, 2) << "no folder";
  ASSERT_EQ(run_program(folder_.path(), {"render", "room.glb", "-o", "shown.png", "--size", "8x8",
                                         "--quality", "draft", "--quiet"})
                .code,
            0);
  EXPECT_EQ(trade({"--reference", "shown.png"}).code, 3) << "displayed colours are no radiances";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/index.html"));
}

} // namespace
} // namespace meninas::test
