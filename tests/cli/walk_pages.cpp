#include "tests/cli/walk_pages.h"

#include "tests/cli/browser.h"
#include "tests/cli/tiny_room.h"
#include "tests/support/source_dir.h"

#include <fstream>

namespace meninas::test {

using nlohmann::json;

constexpr const char* wait_for_picture =
    "while (!document.body.dataset.shot && !document.body.dataset.problem)"
    "  await new Promise(resolve => setTimeout(resolve, 50));"
    "const { shot = '', figures = '{}', problem = '' } = document.body.dataset;"
    "return { shot, figures: JSON.parse(figures), problem };";

std::string WalkPages::gallery(const std::string& name) {
  return source_dir() + "/scenes/gallery/" + name;
}

Outcome WalkPages::run(std::vector<std::string> arguments) {
  return run_program(folder_.path(), arguments);
}

void WalkPages::write_tiny_page() {
  write_room(folder_ / "room.glb", tiny_room());
  const Outcome outcome = run({"walk", "room.glb", "-o", "room.html", "--quality", "draft"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

json WalkPages::drawn(const std::string& page, const std::string& fragment, const std::string& use) {
  return browse_drawn_page(folder_.path(), (folder_ / page).string(), fragment, use);
}

json WalkPages::page_beside_picture(const PageCase& page) {
  std::vector<std::string> solve{"solve", page.scene, "-o", "s.glb", "--quality", "draft"};
  if (!page.lamps.empty())
    solve.push_back("--by-lamp");
  std::vector<std::string> show{"walk", page.scene, "--solution", "s.glb", "-o", "s.html"};
  std::string link = "camera=" + page.camera + "&size=128x128&shot&exposure=" + page.exposure;
  std::vector<std::string> render{"render", page.scene, "--solution", "s.glb", "-o", "s.png",
                                  "--mode", "hybrid", "--diffuse", "interpolated", "--samples", "64",
                                  "--size", "128x128", "--camera", page.camera, "--exposure",
                                  page.exposure};
  for (auto* command : {&solve, &show, &render})
    command->insert(command->end(), page.options.begin(), page.options.end());
  EXPECT_EQ(run(solve).code, 0);
  const Outcome walk = run(show);
  EXPECT_EQ(walk.code, 0) << walk.err;
  for (const std::string& lamp : page.lamps) {
    link += "&lamp=" + lamp;
    render.insert(render.end(), {"--lamp", lamp});
  }
  const Outcome picture = run(render);
  EXPECT_EQ(picture.code, 0) << picture.err;
  const json said = drawn("s.html", link, wait_for_picture);
  if (said.is_null() || said.at("problem").get<std::string>().find("WebGL 2") != std::string::npos)
    return nullptr;
  EXPECT_EQ(said.at("problem"), "");
  const std::string address = said.at("shot");
  const std::vector<std::byte> png = from_base64(address.substr(address.find(',') + 1));
  std::ofstream(folder_ / "w.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  json difference = json::parse(run({"diff", "w.png", "s.png", "--json"}).out);
  difference["figures"] = said.at("figures");
  return difference;
}

} // namespace meninas::test
