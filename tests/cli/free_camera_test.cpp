// `render --eye --target --angle`: the file's own camera from the same place sees the same, and what does not go together is refused.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meninas::test {
namespace {

using testing::HasSubstr;

class FreeCameraOptions : public testing::Test {
protected:
  void SetUp() override { write_room(folder_ / "room.glb", tiny_room()); }
  Outcome render(std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "room.glb", "--quality", "draft", "--samples", "1", "--size", "32x32"});
    return run_program(folder_.path(), options);
  }
  TemporaryFolder folder_;
};

// The angle in degrees is 0.7 radians to the last figure but one: rays differ by 1e-15, pixels at edges by no more than rounding.
TEST_F(FreeCameraOptions, SeeWhatACameraOfTheFileSeesFromThere) {
  ASSERT_EQ(render({"-o", "file.exr", "--camera", "camera"}).code, 0);
  const Outcome free = render({"-o", "free.exr", "--eye", "0.5,0.5,2.5", "--target", "0.5,0.5,1", "--angle", "40.10704565915762"});
  ASSERT_EQ(free.code, 0) << free.err;
  const auto difference = nlohmann::json::parse(run_program(folder_.path(), {"diff", "free.exr", "file.exr", "--json"}).out);
  EXPECT_LT(difference.at("rmse").get<double>(), 1e-6);
  ASSERT_EQ(render({"-o", "other.exr", "--eye=-0.2,0.5,2.5", "--target", "0.5,0.5,1"}).code, 0);
  const auto other = nlohmann::json::parse(run_program(folder_.path(), {"diff", "other.exr", "file.exr", "--json"}).out);
  EXPECT_GT(other.at("rmse").get<double>(), 1e-3);
}

TEST_F(FreeCameraOptions, WhatDoesNotGoTogetherIsRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{"--eye", "1,2,3"}, "--target: is needed"},
      {{"--angle", "40"}, "--eye: is needed"},
      {{"--eye", "1,2,3", "--target", "1,2,3"}, "--target: is where --eye is"},
      {{"--eye", "1,2", "--target", "0,0,0"}, "no point such as"},
      {{"--eye", "1,2,3,4", "--target", "0,0,0"}, "no point such as"},
      {{"--eye", "1,2,nan", "--target", "0,0,0"}, "no point such as"},
      {{"--eye", "1,2,3", "--target", "0,0,0", "--angle", "180"}, "--angle: is not from 0.01 to 179.9"},
      {{"--eye", "1,2,3", "--target", "0,0,0", "--angle", "0.001"}, "--angle: is not from 0.01 to 179.9"},
      {{"--eye", "1e30,0,0", "--target", "0,0,0"}, "--eye: has a coordinate beyond"},
      {{"--eye", "0,0,0", "--target=0,-1e7,0"}, "--target: has a coordinate beyond"},
      {{"--eye", "1,0,0", "--target", "1,1e-12,0"}, "--target: is where --eye is"},
      {{"--eye", "1,2,3", "--target", "0,0,0", "--camera", "camera"}, "--camera: does not go with --eye"}};
  for (const auto& [options, said] : wrong) {
    const Outcome outcome = render(options);
    EXPECT_EQ(outcome.code, 2) << said;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  }
  EXPECT_EQ(files_in(folder_.path()), std::vector<std::string>{"room.glb"});
}

} // namespace
} // namespace meninas::test
