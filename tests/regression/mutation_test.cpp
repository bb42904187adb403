// The suite can fail: small changes of a scene are caught by the limits of its committed case,
// and the scene as it is passes.
#include "tests/cli/program.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path suite = std::filesystem::path(source_dir()) / "reference/images";

class Mutations : public testing::Test {
protected:
  /// The committed case of that name, with paths that hold in any folder.
  void take_case(const std::string& name) {
    const json cases = json::parse(read_file(suite / "cases.json"))["cases"];
    for (const json& candidate : cases) {
      if (candidate["name"] == name) {
        case_ = candidate;
      }
    }
    ASSERT_TRUE(case_.is_object()) << name;
    scene_ = json::parse(read_file(suite / case_["scene"].get<std::string>()));
    case_["reference"] = (suite / case_["reference"].get<std::string>()).string();
    case_["scene"] = "scene.gltf";
  }

  json& material(const std::string& name) {
    for (json& candidate : scene_["materials"]) {
      if (candidate.value("name", "") == name) {
        return candidate;
      }
    }
    ADD_FAILURE() << "no material " << name;
    return scene_["materials"][0];
  }

  /// The node that shows a mesh; a camera may have the same name.
  json& surface(const std::string& name) {
    for (json& candidate : scene_["nodes"]) {
      if (candidate.value("name", "") == name && candidate.contains("mesh")) {
        return candidate;
      }
    }
    ADD_FAILURE() << "no surface " << name;
    return scene_["nodes"][0];
  }

  Outcome run(const std::vector<std::string>& options = {}) {
    std::ofstream(folder_ / "scene.gltf") << scene_.dump();
    std::ofstream(folder_ / "cases.json") << json{{"cases", {case_}}}.dump();
    std::vector<std::string> arguments{"regress", "cases.json", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(folder_.path(), arguments);
  }

  void expect_caught(const std::string& metric) {
    const Outcome outcome = run();
    EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(metric));
    EXPECT_THAT(outcome.out, HasSubstr("exceeds"));
  }

  json case_, scene_;
  TemporaryFolder folder_;
};

TEST_F(Mutations, NoneIsFoundWhereNoneIs) {
  take_case("cornell-mirror.hybrid");
  const Outcome one = run({"--threads", "1"});
  EXPECT_EQ(one.code, 0) << one.out << one.err;
  const Outcome two = run({"--threads", "2"});
  EXPECT_EQ(two.code, 0) << two.out << two.err;
  const auto figures = [](const Outcome& outcome) {
    return outcome.out.substr(0, outcome.out.rfind(" ("));
  };
  EXPECT_EQ(figures(one), figures(two));
}

TEST_F(Mutations, LightScaledByOnePerCent) {
  take_case("cornell-mirror.hybrid");
  json& strength =
      material("lamp")["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
  strength = 1.01 * strength.get<double>();
  expect_caught("relmse");
}

TEST_F(Mutations, AMirrorBounceDropped) {
  // The chain of both mirrors is what brings light through the periscope.
  take_case("periscope.hybrid");
  case_["settings"]["mirror-depth"] = 1;
  expect_caught("relmse");
}

TEST_F(Mutations, AMirrorShiftedByAMillimetre) {
  take_case("cornell-mirror.hybrid");
  json& mirror = surface("mirror");
  ASSERT_FALSE(mirror.contains("translation"));
  mirror["translation"] = {0.001, 0.0, 0.0};
  expect_caught("relmse");
}

TEST_F(Mutations, TwoChannelsSwapped) {
  take_case("cornell-mirror.hybrid");
  json& colour = material("lamp")["emissiveFactor"];
  std::swap(colour[0], colour[1]);
  expect_caught("relmse");
}

} // namespace
} // namespace meninas::test
