// The schema decides, and says where and why.
#include "runs/batch/batch_file.h"
#include "runs/json/json_schema.h"
#include "scenes/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas {
namespace {

const std::filesystem::path file = "jobs.json";

/// "" where the schema of batches holds.
std::string complaint(const std::string& text) {
  const Json json = Json::parse(text);
  try {
    check_schema({json, file, ""}, Json::parse(batch_schema()));
    return "";
  } catch (const InputError& error) {
    return std::string(error.what()).substr(file.string().size() + 2);
  }
}

std::string of_job(const std::string& members) {
  return complaint("{\"jobs\": [{" + members + "}]}");
}

std::string of_camera(const std::string& camera) { return of_job("\"cameras\": [" + camera + "]"); }

TEST(JsonSchema, WhatABatchMayBePasses) {
  EXPECT_EQ(of_job(""), "");
  EXPECT_EQ(of_job(R"("scenes": "a.glb", "cameras": "*", "modes": "hybrid", "outputs": "x.exr")"),
            "");
  EXPECT_EQ(
      of_job(R"("scenes": ["a.glb"], "modes": ["hybrid", "reference"], "settings": {"size": "4x4",
                      "samples": 4, "float": true, "rays": null})"),
      "");
  EXPECT_EQ(of_camera(R"("main", {"orbit": {"radius": 2}, "frames": 3, "fov": 40})"), "");
  EXPECT_EQ(of_camera(R"({"poses": [{"position": [0, 1, 2.5], "target": [0, 0, 0], "at": 2}]})"),
            "");
}

TEST(JsonSchema, WhatItMayNotBeIsNamedByItsPlace) {
  EXPECT_EQ(complaint("[]"), "/: is not an object");
  EXPECT_EQ(complaint("{}"), "/: 'jobs' is missing");
  EXPECT_EQ(complaint(R"({"jobs": []})"), "/jobs: is empty");
  EXPECT_EQ(complaint(R"({"default": {}, "jobs": []})"),
            "/default: unknown key, did you mean 'defaults'?");
  EXPECT_EQ(of_job(R"("scene": "a.glb")"), "/jobs/0/scene: unknown key, did you mean 'scenes'?");
  EXPECT_EQ(of_job(R"("scenes": 4)"), "/jobs/0/scenes: is of a type that is not taken here");
  EXPECT_EQ(of_job(R"("scenes": ["a.glb", ""])"), "/jobs/0/scenes/1: is empty");
  EXPECT_EQ(of_job(R"("scenes": [])"), "/jobs/0/scenes: is empty");
  EXPECT_EQ(of_job(R"("modes": ["hybird"])"),
            "/jobs/0/modes/0: no value 'hybird', did you mean 'hybrid'?");
  EXPECT_EQ(of_job(R"("settings": {"size": [4, 4]})"),
            "/jobs/0/settings/size/0: is not a text");
  EXPECT_EQ(of_job(R"("settings": {"ies": ["spot=a.ies", "bulb=b.ies"]})"), "");
}

TEST(JsonSchema, OfAlternativesTheOneThatIsMeantComplains) {
  EXPECT_EQ(of_camera(R"({"orbit": {"radius": 0}, "frames": 3})"),
            "/jobs/0/cameras/0/orbit/radius: is not more than 0");
  EXPECT_EQ(of_camera(R"({"orbit": {"radius": 1}})"), "/jobs/0/cameras/0: 'frames' is missing");
  EXPECT_EQ(of_camera(R"({"poses": [{"position": [0, 1], "target": [0, 0, 0]}]})"),
            "/jobs/0/cameras/0/poses/0/position: has 2 values, not 3");
  EXPECT_EQ(of_camera(R"({"poses": [{"position": [0, 1, 2], "target": [0, 0, "0"]}]})"),
            "/jobs/0/cameras/0/poses/0/target/2: is not a number");
  EXPECT_EQ(of_camera(R"({"orbit": {"radius": 1}, "frames": 2.5})"),
            "/jobs/0/cameras/0/frames: is not an integer");
  EXPECT_EQ(of_camera(R"({"orbit": {"radius": 1}, "frames": 2, "fov": 180})"),
            "/jobs/0/cameras/0/fov: is not less than 180");
}

TEST(JsonSchema, AKeywordThatIsNotCheckedBreaksAPrecondition) {
  const Json json = "x", schema = {{"type", "string"}, {"pattern", "y"}};
  EXPECT_THROW(check_schema({json, file, ""}, schema), std::logic_error);
}

} // namespace
} // namespace meninas
