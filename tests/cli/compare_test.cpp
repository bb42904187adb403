// `compare`: the files it writes, what its figures say, and its page in a real browser.
#include "image/image_file.h"
#include "tests/cli/browser.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Compare : public testing::Test {
protected:
  Compare() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"compare", "room.glb"});
    arguments.insert(arguments.end(), {"--quality", "draft", "--size", "40x30"});
    return run_program(folder_.path(), arguments);
  }

  json figures() { return json::parse(read_file(folder_ / "out/figures.json")); }

  json browse(const std::string& page, const std::string& use) {
    return browse_page(folder_.path(), page, use);
  }

  TemporaryFolder folder_;
};

TEST_F(Compare, WritesPicturesDifferencesFiguresAndAPage) {
  const Outcome outcome = compare({"-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files_in(folder_ / "out"),
              ElementsAre("figures.json", "hybrid.exr", "hybrid.png", "index.html",
                          "radiosity-minus-hybrid.png", "radiosity.exr", "radiosity.png"));
}

TEST_F(Compare, LayersAddUpToTheHybridPicture) {
  compare({"-o", "out"});
  const ImageFile hybrid = read_image(folder_ / "out/hybrid.exr");
  ASSERT_EQ(hybrid.layers.size(), 9U);
  for (std::size_t p = 0; p < hybrid.picture.pixels.size(); ++p) {
    glm::vec3 sum(0.0F);
    for (const Layer& layer : hybrid.layers) {
      sum += layer.image.pixels[p];
    }
    // Nine half floats and their sum, each rounded by 2^-11.
    for (int band = 0; band < 3; ++band) {
      EXPECT_NEAR(sum[band], hybrid.picture.pixels[p][band],
                  2.0 * 0x1p-11 * hybrid.picture.pixels[p][band] + 1e-6);
    }
  }
}

TEST_F(Compare, SharesAddUpToOneAndTheMirrorHasItsPart) {
  compare({"-o", "out"});
  const json said = figures();
  double all = 0.0, mirrored = 0.0, diffuse = 0.0;
  for (const json& layer : said.at("layers")) {
    const std::string name = layer.at("name");
    const double share = layer.at("share");
    all += share;
    diffuse += name.starts_with("diffuse.") ? share : 0.0;
    mirrored += name.starts_with("diffuse.mirrored") ? share : 0.0;
  }
  EXPECT_NEAR(all, 1.0, 1e-9);
  EXPECT_GT(mirrored, 0.0);
  EXPECT_NEAR(said.at("mirrored_of_diffuse"), mirrored / diffuse, 1e-9);
  EXPECT_FALSE(said.contains("reference"));
  ASSERT_EQ(said.at("modes").size(), 2U);
  EXPECT_EQ(said.at("modes").at(0).at("compared_with"), "hybrid");
  EXPECT_GT(said.at("modes").at(0).at("rmse"), 0.0) << "the mirror is black in one of them";
}

TEST_F(Compare, WithAReferenceBothModesAreMeasuredAgainstIt) {
  const Outcome outcome = compare({"-o", "out", "--reference", "--max-error", "0.05"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json said = figures();
  ASSERT_EQ(said.at("modes").size(), 3U);
  EXPECT_EQ(said.at("modes").at(2).at("id"), "reference");
  const double radiosity = said.at("modes").at(0).at("relmse"),
               hybrid = said.at("modes").at(1).at("relmse");
  EXPECT_LT(hybrid, radiosity) << "the hybrid picture is the more accurate one";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/hybrid-minus-reference.png"));
  for (const char* figure : {"mirrored_of_diffuse", "seen_in_mirrors"}) {
    const double truth = said.at("reference").at(figure).at("value"),
                 error = said.at("reference").at(figure).at("standard_error");
    EXPECT_GT(truth, 0.0) << figure;
    EXPECT_GT(error, 0.0) << figure;
    EXPECT_LT(error, 0.1 * truth) << figure;
    // 128 rays a vertex and a mesh of a draft leave about two per cent of a share.
    EXPECT_NEAR(said.at(figure), truth, 4.0 * error + 0.02 * truth) << figure;
  }
  EXPECT_THAT(read_file(folder_ / "out/index.html"),
              HasSubstr("The reference, split path by path, says"));
}

TEST_F(Compare, ThePageWorksInABrowser) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: the page is not opened";
  compare({"-o", "out"});
  const json report = browse((folder_ / "out/index.html").string(), R"(
    const stage = document.getElementById('stage'), share = () => parseFloat(stage.style.getPropertyValue('--split'));
    const slider = document.getElementById('split');
    const report = { title: document.querySelector('h1').textContent,
      loaded: [...document.images].every(image => image.complete && image.naturalWidth > 0), images: document.images.length,
      rows: document.querySelectorAll('#pictures tbody tr').length, shares: document.querySelectorAll('#mechanisms tbody tr').length,
      layers: document.querySelectorAll('#layers figure').length, middle: share() };
    slider.value = 20;
    slider.dispatchEvent(new Event('input'));
    report.slid = share();
    const box = stage.getBoundingClientRect(), at = part => ({ clientX: box.left + part * box.width, clientY: box.top + 5, bubbles: true });
    stage.dispatchEvent(new PointerEvent('pointerdown', at(0.75)));
    report.pressed = share();
    window.dispatchEvent(new PointerEvent('pointermove', at(0.4)));
    report.dragged = share();
    window.dispatchEvent(new PointerEvent('pointerup', at(0.4)));
    window.dispatchEvent(new PointerEvent('pointermove', at(0.9)));
    report.released = share();
    const choice = document.getElementById('left-choice');
    report.before = document.getElementById('left-name').textContent;
    choice.value = 'hybrid';
    choice.dispatchEvent(new Event('change'));
    report.after = document.getElementById('left-name').textContent;
    report.same = document.getElementById('left').src === document.getElementById('right').src;
    report.step = slider.step;
    report.command = document.querySelector('#command code').textContent;
    report.copies = document.querySelectorAll('#command button').length;
    report.links = [...document.querySelectorAll('main a')].map(link => link.getAttribute('href'));
    report.brighter = [...document.querySelectorAll('#layers figcaption')].filter(text => text.textContent.includes('times as bright')).length;
    choice.value = 'layer diffuse.mirrored';
    choice.dispatchEvent(new Event('change'));
    report.layer = document.getElementById('left-name').textContent;
    report.outside = performance.getEntriesByType('resource').filter(entry => !entry.name.startsWith('data:')).length;
    return report;)");
  EXPECT_EQ(report.at("title"), "room.glb");
  EXPECT_TRUE(report.at("loaded"));
  EXPECT_EQ(report.at("rows"), 2);
  EXPECT_EQ(report.at("shares"), 3);
  EXPECT_EQ(report.at("images"), 3 + int(report.at("layers")))
      << "two on the stage and a difference";
  EXPECT_DOUBLE_EQ(report.at("middle"), 50.0);
  EXPECT_DOUBLE_EQ(report.at("slid"), 20.0);
  EXPECT_NEAR(report.at("pressed"), 75.0, 0.1);
  EXPECT_NEAR(report.at("dragged"), 40.0, 0.1);
  EXPECT_NEAR(report.at("released"), 40.0, 0.1) << "a button that is up drags nothing";
  EXPECT_EQ(report.at("before"), "radiosity only");
  EXPECT_EQ(report.at("after"), "hybrid");
  EXPECT_TRUE(report.at("same"));
  EXPECT_EQ(report.at("outside"), 0) << "nothing is fetched from anywhere";
  EXPECT_EQ(report.at("step"), "1") << "an arrow key moves the slider by one per cent";
  EXPECT_EQ(report.at("command"),
            "meninas compare room.glb -o out --size 40x30 --quality draft");
  EXPECT_EQ(report.at("copies"), 1);
  EXPECT_GT(report.at("brighter"), 0) << "faint layers are shown so that they can be seen";
  EXPECT_THAT(report.at("layer").get<std::string>(), testing::StartsWith("diffuse.mirrored"));
  for (const json& link : report.at("links"))
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / link.get<std::string>())) << link;
}

TEST_F(Compare, NamesThatLookLikeMarkupAreText) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: the page is not opened";
  const std::string name = "<!--<script>&'.glb";
  write_room(folder_ / name, tiny_room());
  const Outcome outcome = run_program(
      folder_.path(), {"compare", name, "-o", "out", "--quality", "draft", "--size", "8x8"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json report = browse((folder_ / "out/index.html").string(),
                             "return { title: document.querySelector('h1').textContent };");
  EXPECT_EQ(report.at("title"), name);
}

TEST_F(Compare, AFolderThatCannotBeMadeIsSaid) {
  std::ofstream(folder_ / "taken") << "a file";
  const Outcome outcome = compare({"-o", "taken"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("meninas: taken: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(Compare, LimitsOfAReferenceNeedOne) {
  const Outcome outcome = compare({"-o", "out", "--max-error", "0.1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--max-error: has no effect without --reference"));
}

TEST_F(Compare, OptionsOfPassOneNeedTheirMethod) {
  const Outcome outcome = compare({"-o", "out", "--hemicube-resolution", "32"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--hemicube-resolution: has no effect without"));
}

} // namespace
} // namespace meninas::test
