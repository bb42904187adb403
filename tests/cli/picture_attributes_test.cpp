// What a picture's file says about how it was made.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

/// The attribute of the EXR that `render` writes with these options, "none" where it has none.
std::string attribute(const std::string& name, std::vector<std::string> options) {
  const TemporaryFolder folder;
  write_room(folder / "room.glb", tiny_room());
  options.insert(options.begin(), {"render", "room.glb", "-o", "out.exr", "--size", "16x12",
                                   "--quality", "draft", "--quiet"});
  const Outcome outcome = run_program(folder.path(), options);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Attributes all = read_image(folder / "out.exr").attributes;
  const auto found = std::ranges::find(all, name, &Attributes::value_type::first);
  return found == all.end() ? "none" : found->second;
}

TEST(PictureAttributes, KeepTheBackground) {
  // Who compares a picture with a reference has to light both by the same sky.
  EXPECT_EQ(attribute("background", {}), "none");
  EXPECT_EQ(attribute("background", {"--background", "0.25,0.5,1"}), "0.25,0.5,1");
  EXPECT_EQ(attribute("background",
                      {"--background", "0.25,0.5,1", "--mode", "reference", "--samples", "4"}),
            "0.25,0.5,1");
}

TEST(PictureAttributes, KeepTheSeed) {
  EXPECT_EQ(attribute("seed", {"--seed", "7"}), "7");
}

} // namespace
} // namespace meninas::test
