// What the commands write: pictures, solutions, figures; the same bits however they are asked for.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

class Outputs : public testing::Test {
protected:
  Outputs() { write_room(folder_ / "room.glb", tiny_room()); }

  /// Runs a small draft and expects it to succeed.
  Outcome run(const std::string& command, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {command, "room.glb"});
    if (command != "plan") {
      arguments.insert(arguments.end(), {"--quality", "draft"});
    }
    Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }

  Outcome render(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--size", "40x30"});
    return run("render", std::move(arguments));
  }

  std::string contents(const std::string& name) { return read_file(folder_ / name); }
  json json_of(const std::string& name) { return json::parse(contents(name)); }

  TemporaryFolder folder_;
};

std::set<std::string> keys_of(const json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) {
    keys.insert(key);
  }
  return keys;
}

TEST_F(Outputs, SeveralPicturesOfOneRun) {
  const Outcome outcome = render({"-o", "a.exr", "-o", "a.png", "-o", "b.exr"});
  EXPECT_THAT(files_in(folder_.path()), ElementsAre("a.exr", "a.png", "b.exr", "room.glb"));
  EXPECT_EQ(contents("a.exr"), contents("b.exr"));
  EXPECT_THAT(without_progress(outcome.err),
              testing::MatchesRegex("meninas: exposure [+-][0-9.]+ EV \\(automatic\\)\n"));
  EXPECT_THAT(outcome.out, IsEmpty());
  const Image picture = read_image(folder_ / "a.exr").picture;
  EXPECT_EQ(picture.width, 40);
  EXPECT_EQ(picture.height, 30);
}

TEST_F(Outputs, QuietSaysNothing) {
  EXPECT_THAT(render({"-o", "a.png", "--quiet"}).err, IsEmpty());
  EXPECT_THAT(render({"-o", "a.png", "-o", "a.exr"}).err,
              testing::ContainsRegex("meninas: a.png, a.exr: [0-9]+x[0-9]+ in [0-9.]+ s, about .* off.*\n$"));
}

TEST_F(Outputs, RoundedNumbersAreSaid) {
  EXPECT_THAT(without_progress(render({"-o", "a.exr", "--rays", "100"}).err),
              "meninas: --rays 100 is rounded up to 128\n");
}

// Rows by hemicubes close as those by rays do, and light the same room:
// exposure and energy hold to what both methods leave.
TEST_F(Outputs, HemicubesLightTheSameRoom) {
  render({"-o", "rays.exr", "--stats", "rays.json"});
  render({"-o", "cubes.exr", "--stats", "cubes.json", "--form-factors", "hemicube",
          "--hemicube-resolution", "16"});
  const json cubes = json_of("cubes.json");
  EXPECT_LT(cubes["closure"]["mean_error"].get<double>(), 1e-6);
  EXPECT_LT(std::abs(cubes["energy"]["imbalance"].get<double>()), 0.02);
  const Image by_rays = read_image(folder_ / "rays.exr").picture,
              by_cubes = read_image(folder_ / "cubes.exr").picture;
  double difference = 0.0, sum = 0.0;
  for (std::size_t k = 0; k < by_rays.pixels.size(); ++k) {
    difference += std::abs(double{by_rays.pixels[k].g} - double{by_cubes.pixels[k].g});
    sum += double{by_rays.pixels[k].g};
  }
  EXPECT_GT(sum, 0.0);
  EXPECT_GT(difference, 0.0);
  EXPECT_LT(difference, 0.01 * sum); // 128 rays leave about 0.5 %
}

TEST_F(Outputs, ThePictureIsTheSameForAnyThreadCountAndRun) {
  render({"-o", "one.exr", "--threads", "1"});
  render({"-o", "two.exr", "--threads", "2"});
  render({"-o", "again.exr", "--threads", "2"});
  EXPECT_EQ(contents("one.exr"), contents("two.exr"));
  EXPECT_EQ(contents("two.exr"), contents("again.exr"));
  render({"-o", "seeded.exr", "--seed", "1"});
  EXPECT_NE(read_image(folder_ / "one.exr").picture.pixels,
            read_image(folder_ / "seeded.exr").picture.pixels);
}

TEST_F(Outputs, PngsShowPartsOfPixelsAtTheLampsEdge) {
  render({"-o", "edges.exr", "-o", "edges.png", "--float", "--samples", "16", "--exposure", "4",
          "--view-transform", "srgb"});
  const Image light = read_image(folder_ / "edges.exr").picture,
              shown = read_image(folder_ / "edges.png").picture;
  int in_part = 0;
  for (std::size_t p = 0; p < light.pixels.size(); ++p) {
    const float clipped = std::min(16.0F * light.pixels[p].g, 1.0F);
    // Half a code value of 8 bits; no pixel shows more than its mean.
    EXPECT_LT(shown.pixels[p].g, clipped + 0.005F);
    in_part += shown.pixels[p].g < clipped - 0.05F ? 1 : 0;
  }
  EXPECT_GT(in_part, 0);
}

TEST_F(Outputs, ASolutionRendersTheSamePicture) {
  run("solve", {"-o", "solution.glb"});
  run("solve", {"-o", "again.glb", "--threads", "1"});
  EXPECT_EQ(contents("solution.glb"), contents("again.glb"));
  render({"-o", "whole.exr", "-o", "whole.png", "--float"});
  render({"-o", "stored.exr", "-o", "stored.png", "--float", "--solution", "solution.glb"});
  EXPECT_EQ(contents("whole.exr"), contents("stored.exr"));
  EXPECT_EQ(contents("whole.png"), contents("stored.png"));
}

TEST_F(Outputs, EverySolverSaysHowItWent) {
  for (const std::string solver : {"direct", "jacobi", "gauss-seidel", "cg"}) {
    run("solve", {"-o", "solution.glb", "--element-size", "0.2", "--solver", solver, "--stats",
                  "solve.json"});
    const json solve = json_of("solve.json").at("solve");
    EXPECT_EQ(solve.at("solver"), solver);
    EXPECT_TRUE(solve.at("converged"));
    EXPECT_LE(solve.at("error_bound"), 1e-4);
    EXPECT_EQ(solve.at("bands"), 1); // the room is grey
    EXPECT_EQ(solve.at("channel_error_bounds").size(), solve.at("residuals").size());
  }
  const Outcome misspelt =
      run_program(folder_.path(), {"solve", "room.glb", "-o", "no.glb", "--solver", "gaus-seidel"});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("did you mean 'gauss-seidel'?"));
}

TEST_F(Outputs, ARoomThatAbsorbsNothingHasNoSolution) {
  std::ifstream furnace(source_dir() + "/scenes/gallery/furnace.gltf");
  json root = json::parse(furnace);
  for (json& material : root.at("materials")) {
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, 1.0};
  }
  std::ofstream(folder_ / "white.gltf") << root;
  const Outcome outcome =
      run_program(folder_.path(), {"solve", "white.gltf", "-o", "white.glb", "--element-size",
                                   "0.25", "--rays", "64", "--stats", "white.json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("pass one has no solution"));
  const json solve = json_of("white.json").at("solve");
  EXPECT_FALSE(solve.at("converged"));
  EXPECT_TRUE(solve.at("error_bound").is_null());
  EXPECT_EQ(solve.at("iterations"), 0);
}

TEST_F(Outputs, KeptFormFactorsGiveTheSameSolution) {
  run("solve", {"-o", "first.glb", "--factors", "room.factors"});
  run("solve", {"-o", "again.glb", "--reuse", "room.factors", "--stats", "again.json"});
  run("solve", {"-o", "plain.glb", "--mesh", "uniform"});
  EXPECT_EQ(contents("first.glb"), contents("plain.glb"));
  EXPECT_EQ(contents("again.glb"), contents("plain.glb"));

  const auto refused = [&](const std::string& reuse, const std::string& rays) {
    return run_program(folder_.path(), {"solve", "room.glb", "-o", "no.glb", "--quality", "draft",
                                        "--rays", rays, "--reuse", reuse});
  };
  EXPECT_EQ(refused("room.factors", "64").code, 3);
  EXPECT_THAT(refused("room.factors", "64").err,
              HasSubstr("room.factors: cannot be reused: the settings of the form factors"));
  EXPECT_EQ(refused("plain.glb", "128").code, 3);
  EXPECT_EQ(refused("missing", "128").code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "no.glb"));
}

TEST_F(Outputs, DamagedSolutionsAreRefused) {
  run("solve", {"-o", "solution.glb"});
  const std::string whole = contents("solution.glb");
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  const std::map<std::string, std::string> damaged{{"cut.glb", whole.substr(0, whole.size() - 8)},
                                                   {"flipped.glb", flipped}};
  for (const auto& [name, bytes] : damaged) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    const Outcome outcome =
        run_program(folder_.path(), {"render", "room.glb", "-o", "a.exr", "--solution", name});
    EXPECT_EQ(outcome.code, 3) << name;
    EXPECT_THAT(outcome.err, testing::StartsWith("meninas: " + name + ": "));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.exr"));
}

TEST_F(Outputs, TheMirrorIsBlackInRadiosityMode) {
  render({"-o", "hybrid.exr"});
  render({"-o", "radiosity.exr", "--mode", "radiosity"});
  const Image hybrid = read_image(folder_ / "hybrid.exr").picture;
  const Image radiosity = read_image(folder_ / "radiosity.exr").picture;
  std::size_t blackened = 0;
  for (std::size_t k = 0; k < hybrid.pixels.size(); ++k) {
    const bool is_black = radiosity.pixels[k] == glm::vec3(0.0F);
    blackened += is_black && hybrid.pixels[k] != glm::vec3(0.0F) ? 1 : 0;
    // Away from the mirror both show the same field.
    EXPECT_TRUE(glm::all(glm::lessThanEqual(radiosity.pixels[k], hybrid.pixels[k])));
  }
  EXPECT_GT(blackened, 10U);
}

/// The report on the mirror worlds of the tiny room: its one mirror can see no other.
const json one_world{{"considered", 1},        {"kept", 1},         {"pruned_unseen", 0},
                     {"pruned_throughput", 0}, {"pruned_limit", 0}, {"tail_bound", 0.0}};

TEST_F(Outputs, StatsHaveTheDocumentedKeys) {
  std::map<std::string, std::set<std::string>> documented{
      {"plan", {"mirrors", "mirror_worlds", "worlds", "emitters", "bands"}},
      {"mesh",
       {"surfaces", "patches", "elements", "vertices", "solved_elements", "cut"}},
      {"solve",
       {"solver", "iterations", "residual", "error_bound", "converged", "residuals", "bands",
        "channel_residuals", "channel_error_bounds", "receivers", "links", "link_bytes"}},
      {"energy", {"emitted", "absorbed", "escaped", "mirror_absorbed", "imbalance"}},
      {"closure", {"mean_error", "max_error", "cut"}},
      {"rays", {"form_factor", "shadow", "camera", "specular"}},
      {"seconds",
       {"load", "plan", "mesh", "form_factors", "solve", "interpolate", "render", "write",
        "total"}}};
  run("solve", {"-o", "solution.glb", "--stats", "solve.json"});
  render({"-o", "a.exr", "--stats", "render.json", "--threads", "2"});
  render({"-o", "b.exr", "--stats", "stored.json", "--solution", "solution.glb"});
  for (const std::string name : {"solve.json", "render.json", "stored.json"}) {
    const json stats = json_of(name);
    if (name != "solve.json") // a picture has an error
      documented["error_estimate"] = {"total",       "mesh",   "mesh_direct", "form_factors",
                                      "mirror_tail", "pixels", "solver",      "mean_radiance",
                                      "rays",        "seconds"};
    std::set<std::string> keys{"peak_memory_bytes", "threads", "units"};
    for (const auto& [key, inner] : documented) {
      keys.insert(key);
      EXPECT_EQ(keys_of(stats.at(key)), inner) << name << ' ' << key;
    }
    EXPECT_EQ(keys_of(stats), keys) << name;
    json plan = stats["plan"];
    EXPECT_EQ(plan["worlds"], one_world);
    plan.erase("worlds");
    EXPECT_EQ(plan, (json{{"mirrors", 1}, {"mirror_worlds", 1}, {"emitters", 1}, {"bands", 1}}));
    EXPECT_EQ(stats["solve"]["converged"], true);
  }
  EXPECT_EQ(json_of("render.json")["threads"], 2);
  EXPECT_EQ(json_of("render.json")["solve"], json_of("stored.json")["solve"]);
  // Sixteen camera rays per pixel of a draft of 40 x 30 pixels.
  EXPECT_EQ(json_of("render.json")["rays"]["camera"], 16 * 40 * 30);
  EXPECT_GT(json_of("render.json")["peak_memory_bytes"], 1 << 20);
}

TEST_F(Outputs, AReferenceHasItsVarianceAndItsFigures) {
  const Outcome outcome = render({"--mode", "reference", "--samples", "50", "-o", "a.exr", "-o",
                                  "a.png", "--stats", "stats.json"});
  EXPECT_THAT(outcome.err, HasSubstr("meninas: --samples 50 is rounded up to 64\n"));
  EXPECT_THAT(outcome.err, HasSubstr("meninas: 64 samples per pixel, standard error "));
  const ImageFile file = read_image(folder_ / "a.exr");
  ASSERT_EQ(file.layers.size(), 1U);
  EXPECT_EQ(file.layers[0].name, "variance");
  const json stats = json_of("stats.json");
  EXPECT_EQ(keys_of(stats), (std::set<std::string>{"units", "reference", "rays", "seconds",
                                                   "peak_memory_bytes", "threads"}));
  EXPECT_EQ(stats["reference"]["samples"], 64);
  EXPECT_EQ(stats["reference"]["stopped_by"], "samples");
  EXPECT_EQ(stats["rays"]["camera"], 64 * 40 * 30);

  // The same room as the two passes see it:
  // the means of the pictures differ by the draft's mesh and the noise, each a few per cent.
  render({"-o", "b.exr"});
  const Image hybrid = read_image(folder_ / "b.exr").picture;
  glm::dvec3 traced(0.0), solved(0.0);
  for (std::size_t k = 0; k < hybrid.pixels.size(); ++k) {
    traced += glm::dvec3(file.picture.pixels[k]);
    solved += glm::dvec3(hybrid.pixels[k]);
  }
  EXPECT_NEAR(traced.g, solved.g, 0.05 * solved.g);
}

TEST_F(Outputs, AReferenceStopsAtTheErrorThatIsAskedFor) {
  render({"--mode", "reference", "--max-error", "0.2", "-o", "a.exr", "--stats", "stats.json"});
  const json figures = json_of("stats.json")["reference"];
  EXPECT_EQ(figures["stopped_by"], "error");
  EXPECT_LE(figures["standard_error"], 0.2);
}

TEST_F(Outputs, PerNodeFiguresNameEveryNode) {
  run("solve", {"-o", "solution.glb", "--per-node", "nodes.json"});
  const json nodes = json_of("nodes.json");
  EXPECT_EQ(keys_of(nodes), (std::set<std::string>{"units", "nodes"}));
  std::vector<std::string> names;
  for (const json& node : nodes["nodes"]) {
    EXPECT_EQ(keys_of(node),
              (std::set<std::string>{"name", "area", "emitted", "radiosity", "irradiance", "illuminance"}));
    names.push_back(node["name"]);
    if (node["name"] == "lamp") {
      // E = pi L with L = 1; the lamp's area is 0.04 m^2; floats in the file leave seven digits.
      EXPECT_NEAR(node["emitted"][0].get<double>(), 3.14159265, 1e-6);
      EXPECT_NEAR(node["area"].get<double>(), 0.04, 1e-7);
    }
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"floor", "ceiling", "back", "left", "right", "lamp"}));
}

TEST_F(Outputs, ThePlanAsJson) {
  const Outcome outcome = run("plan", {"--json"});
  const json plan = json::parse(outcome.out);
  EXPECT_EQ(keys_of(plan), (std::set<std::string>{
                               "units", "mirrors", "mirror_worlds", "worlds", "emitters", "punctual_lights", "area_lights",
                               "glossy", "transmissive", "textured", "variants", "bands", "closed", "patches",
                               "elements", "expected", "stages", "ignored", "warnings", "odd"}));
  ASSERT_EQ(plan["mirrors"].size(), 1U);
  EXPECT_EQ(plan["mirrors"][0]["name"], "mirror");
  EXPECT_NEAR(plan["mirrors"][0]["area"].get<double>(), 0.36, 1e-6); // floats in the file
  EXPECT_EQ(plan["mirrors"][0]["reflectance"].size(), 3U);
  EXPECT_EQ(plan["worlds"], one_world);
  EXPECT_EQ(plan["closed"], false);
  EXPECT_EQ(plan["patches"], 7);
  EXPECT_GT(plan["elements"], 0);
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Outputs, WithoutACameraThereIsAViewAndAWarning) {
  TinyRoom room = tiny_room();
  room.root.erase("cameras");
  room.root["nodes"][7].erase("camera");
  write_room(folder_ / "room.glb", room);
  const Outcome outcome = render({"-o", "a.exr", "--quiet"});
  EXPECT_EQ(outcome.err,
            "meninas: warning: no camera: a default view of the whole scene is used\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.exr"));
}

TEST_F(Outputs, TheCameraDecidesTheShapeOfThePicture) {
  TinyRoom room = tiny_room();
  room.root["cameras"][0]["perspective"]["aspectRatio"] = 0.25;
  write_room(folder_ / "room.glb", room);
  run("render", {"-o", "a.exr"});
  const Image picture = read_image(folder_ / "a.exr").picture;
  EXPECT_EQ(picture.width, 128);
  EXPECT_EQ(picture.height, 512);
}

TEST_F(Outputs, ASceneAloneIsRenderedBesideItsName) {
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"render", "room.glb"}, std::vector<std::string>{"room.glb"}}) {
    std::vector<std::string> arguments = asked;
    arguments.insert(arguments.end(), {"--quality", "draft", "--size", "40x30"});
    const Outcome outcome = run_program(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(files_in(folder_.path()), ElementsAre("room.glb", "room.png"));
    std::filesystem::remove(folder_ / "room.png");
  }
}

} // namespace
} // namespace meninas::test
