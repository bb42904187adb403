// `solve -o SOLUTION.glb` as others see it: the Khronos validator, and our own reader.
#include "tests/cli/gltf_validator.h"
#include "tests/cli/program.h"
#include "tests/support/source_dir.h"

#include "scenes/glb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using nlohmann::json;

std::vector<std::string> gallery() {
  std::vector<std::string> names;
  for (const std::string& name : files_in(source_dir() + "/scenes/gallery"))
    if (name.ends_with(".gltf") || name.ends_with(".glb"))
      names.push_back(name);
  return names;
}

std::string solution_of(const std::string& name) {
  return name.substr(0, name.rfind('.')) + ".glb";
}

class SolutionViewers : public testing::Test {
protected:
  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }
  void solve(const std::string& name, const std::vector<std::string>& besides = {}) {
    std::vector<std::string> arguments{"solve", source_dir() + "/scenes/gallery/" + name, "-o",
                                       solution_of(name), "--quality", "draft"};
    arguments.insert(arguments.end(), besides.begin(), besides.end());
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  TemporaryFolder folder_;
};

TEST_F(SolutionViewers, TheKhronosValidatorFindsNothing) {
  if (!has_gltf_validator(folder_.path()))
    GTEST_SKIP() << "no gltf-validator here (npm install --global gltf-validator): solutions are "
                    "not validated";
  std::vector<std::string> solutions;
  for (const std::string& name : gallery()) {
    solve(name, {"--elements", "1000"});
    solutions.push_back(solution_of(name));
  }
  for (const json& file : validator_findings(folder_.path(), solutions)) {
    EXPECT_EQ(file.at(1), 0) << file;
    EXPECT_EQ(file.at(2), 0) << file;
  }
}

struct ReadBackCase {
  const char* scene;
  const char* camera;
};

class ReadBack : public SolutionViewers, public testing::WithParamInterface<ReadBackCase> {};

// The same view of the scene by its solution, and of the solution as a scene of its own, by its own
// camera, materials and live mirrors: COLOR_0 = s B, and L = B / pi. What is left of FLIP is the field
// between vertices (linear in triangles beside bilinear in quads) and what is brighter than white,
// which COLOR_0 clips.
TEST_P(ReadBack, ASolutionShowsWhatItsSceneShows) {
  const auto& [scene, camera] = GetParam();
  solve(scene);
  const std::string solution = solution_of(scene);
  const double scale = read_glb(folder_ / solution)
                           .root.at("asset").at("extras").at("meninas").at("display_scale");
  const std::vector<std::string> shared{"--mode", "hybrid", "--size", "128x128", "--samples", "16",
                                        "--camera", camera};
  std::vector<std::string> of_scene{"render", source_dir() + "/scenes/gallery/" + scene,
                                    "--solution", solution, "-o", "scene.png", "--diffuse",
                                    "interpolated", "--exposure",
                                    std::to_string(std::log2(std::numbers::pi * scale))};
  std::vector<std::string> of_solution{"render", solution, "-o", "solution.png", "--quality",
                                       "draft", "--exposure", "0"};
  for (auto* arguments : {&of_scene, &of_solution}) {
    arguments->insert(arguments->end(), shared.begin(), shared.end());
    const Outcome outcome = run(*arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  const Outcome difference =
      run({"diff", "scene.png", "solution.png", "--json", "--max-flip", "0.03"});
  EXPECT_EQ(difference.code, 0) << difference.out;
}

INSTANTIATE_TEST_SUITE_P(Gallery, ReadBack,
                         testing::Values(ReadBackCase{"cornell-mirror.gltf", "main"},
                                         ReadBackCase{"blender-room.glb", "Camera"},
                                         ReadBackCase{"facing-mirrors.gltf", "main"},
                                         ReadBackCase{"half-room.gltf", "main"},
                                         ReadBackCase{"glass-solids.gltf", "main"},
                                         ReadBackCase{"lattice.gltf", "main"}),
                         [](const auto& instance) { return test_name(instance.param.scene); });

} // namespace
} // namespace meninas::test
