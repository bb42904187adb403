// Names of outputs: parts are filled in, nothing leaves the folder, mistakes are named.
#include "runs/batch/output_name.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

const NameParts parts{"room", "main", "hybrid", "7", 12};

TEST(OutputName, PartsAreFilledIn) {
  EXPECT_EQ(output_name("{scene}-{camera}-{mode}-{frame}.exr", parts), "room-main-hybrid-0012.exr");
  EXPECT_EQ(output_name("{job}/{scene}{scene}.PNG", parts), "7/roomroom.PNG");
  EXPECT_EQ(output_name("./a/../plain.png", parts), "plain.png");
}

TEST(OutputName, NamesFromScenesBecomeFileNames) {
  const NameParts odd{"my room", "../../etc/a:b\n", "hybrid", "0", 12'345};
  EXPECT_EQ(output_name("{scene}-{camera}.exr", odd), "my_room-.._.._etc_a_b_.exr");
  EXPECT_EQ(output_name("{frame}.exr", odd), "12345.exr");
  EXPECT_EQ(output_name("{camera}/x.exr", {"s", "..", "m", "j", 0}), "__/x.exr");
  EXPECT_EQ(output_name("{camera}.exr", {"s", "Küche", "m", "j", 0}), "Küche.exr");
}

TEST(OutputName, MistakesAreNamed) {
  EXPECT_EQ(template_problem("{scene}.exr"), std::nullopt);
  EXPECT_EQ(template_problem("{scen}.exr"), "no part '{scen}', did you mean 'scene'?");
  for (const char* braces : {"{scene.exr", "scene}.exr", "{{scene}}.exr", "{scene}}.exr", "{"}) {
    EXPECT_EQ(template_problem(braces), "its braces do not match") << braces;
  }
  EXPECT_TRUE(template_problem("{}.exr"));
  for (const char* outside : {"/tmp/{scene}.exr", "../{scene}.exr", "a/../../x.exr"}) {
    EXPECT_EQ(template_problem(outside), "leaves the output folder") << outside;
  }
  EXPECT_EQ(template_problem("{scene}.jpg"), "has to end in .exr, .png or .hdr");
  EXPECT_EQ(template_problem("{scene}"), "has to end in .exr, .png or .hdr");
}

} // namespace
} // namespace meninas
