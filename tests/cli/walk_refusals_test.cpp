// What `walk` refuses, and says so before it works.
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

using testing::HasSubstr;

class WalkRefusals : public testing::Test {
protected:
  static std::string gallery(const std::string& name) {
    return source_dir() + "/scenes/gallery/" + name;
  }
  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }
  TemporaryFolder folder_;
};

TEST_F(WalkRefusals, ASolutionOfAnotherSceneIsRefused) {
  write_room(folder_ / "room.glb", tiny_room());
  ASSERT_EQ(run({"solve", "room.glb", "-o", "s.glb", "--quality", "draft"}).code, 0);
  const Outcome outcome =
      run({"walk", gallery("furnace.gltf"), "--solution", "s.glb", "-o", "f.html"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("is not a solution of"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.html"));
}

TEST_F(WalkRefusals, OptionsOfPassOneHaveNoEffectOnASolution) {
  write_room(folder_ / "room.glb", tiny_room());
  const Outcome outcome = run(
      {"walk", "room.glb", "--solution", "s.glb", "-o", "r.html", "--solver", "jacobi"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("has no effect with --solution"));
}

TEST_F(WalkRefusals, APageThatCannotBeWrittenIsSaidBeforeTheWork) {
  write_room(folder_ / "room.glb", tiny_room());
  const Outcome named = run({"walk", "room.glb", "-o", "room.bin"});
  EXPECT_EQ(named.code, 4);
  EXPECT_EQ(named.err, "meninas: room.bin: cannot write: a page is an .html file\n");
  const Outcome outcome = run({"walk", "room.glb", "-o", "nowhere/r.html"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

} // namespace
} // namespace meninas::test
