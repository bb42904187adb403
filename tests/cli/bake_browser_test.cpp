// What `bake` writes, drawn by a browser as viewers draw it (baked_page.html), beside what the program renders.
#include "tests/cli/browser.h"
#include "tests/cli/driven_browser.h"
#include "tests/cli/program.h"
#include "tests/support/source_dir.h"

#include "scenes/glb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;

std::string to_base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8U | (k + i < bytes.size() ? static_cast<std::uint8_t>(bytes[k + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += k + i > bytes.size() ? '=' : digits[group >> (18 - 6 * i) & 63U];
  }
  return text;
}

struct DrawnCase {
  const char* scene;
  const char* camera;
};
class BakeBrowser : public testing::TestWithParam<DrawnCase> {
protected:
  Outcome run(std::vector<std::string> arguments) {
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  /// The baked file as the page draws it, in both ways; false where this browser does not draw.
  bool draw(const std::string& camera, double exposure) {
    std::string page = read_file(source_dir() + "/tests/cli/baked_page.html");
    page.replace(page.find("GLB</script>"), 3, to_base64(read_file(folder_ / "b.glb")));
    std::ofstream(folder_ / "baked.html") << page;
    DrivenBrowser browser(folder_.path());
    const json said = browser.run(
        browser.open("file://" + (folder_ / "baked.html").string()),
        "const shared = {size: 128, samples: 8, camera: '" + camera + "', exposure: " + std::to_string(exposure) +
            "}; return [await picture({...shared, way: 'baked'}), await picture({...shared, way: 'lightmap'})];");
    if (!said.is_array() || said.at(0).is_null())
      return false;
    for (const auto& [place, file] : {std::pair{0, "variant.png"}, {1, "lightmap.png"}}) {
      const auto bytes = from_base64(said.at(static_cast<std::size_t>(place)).get<std::string>());
      std::ofstream(folder_ / file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    }
    return true;
  }
  double flip(const std::string& a, const std::string& b) {
    return json::parse(run({"diff", a, b, "--json"}).out).at("flip");
  }
  TemporaryFolder folder_;
};

// Both show pass one's field, by texels that are its vertices on large walls, in eight bits. Mirrors and glass are black
// in a lightmap's viewer, as in --mode radiosity. 8 x 8 places in each pixel against the samples of the renderer.
TEST_P(BakeBrowser, ShowsWhatTheProgramRenders) {
  if (!has_browser())
    GTEST_SKIP() << "no Chromium here: baked scenes are not drawn";
  const std::string scene = source_dir() + "/scenes/gallery/" + GetParam().scene;
  run({"solve", scene, "-o", "s.glb"});
  run({"bake", scene, "--solution", "s.glb", "-o", "b.glb"});
  const json root = read_glb(folder_ / "b.glb").root;
  const json& image = *std::ranges::find_if(root.at("images"), [](const json& one) { return one.value("name", "") == "lightmap"; });
  const double exposure = image.at("extras").at("baked_exposure");
  if (!draw(GetParam().camera, exposure))
    GTEST_SKIP() << "this Chromium draws no WebGL 2";
  run({"render", scene, "--solution", "s.glb", "-o", "room.png", "--mode", "radiosity", "--size", "128x128",
       "--samples", "64", "--camera", GetParam().camera, "--view-transform", "srgb", "--exposure", std::to_string(exposure)});
  EXPECT_LE(flip("room.png", "lightmap.png"), 0.02) << "MOZ_lightmap";
  EXPECT_LE(flip("room.png", "variant.png"), 0.02) << "the unlit variant";
}

INSTANTIATE_TEST_SUITE_P(Gallery, BakeBrowser,
                         testing::Values(DrawnCase{"cornell.gltf", "main"}, DrawnCase{"no-mirror.gltf", "main"},
                                         DrawnCase{"half-room.gltf", "main"}, DrawnCase{"meninas.gltf", "main"},
                                         DrawnCase{"sunbeam.gltf", "main"}, DrawnCase{"blender-room.glb", "Camera"}),
                         [](const auto& instance) { return test_name(instance.param.scene); });

} // namespace
} // namespace meninas::test
