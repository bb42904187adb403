#include "tests/house/include_graph.h"

#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

SourceFile file(const std::string& path, const std::vector<std::string>& included = {}) {
  SourceFile result{path, {}};
  for (const std::string& name : included)
    result.lines.push_back("#include \"" + name + '"');
  return result;
}

TEST(IncludeGraph, ChaptersOfRadiosityPointOneWay) {
  EXPECT_THAT(chapter_breaches(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(IncludeGraph, NoPairLeadsBackToItself) {
  EXPECT_THAT(knots(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(IncludeGraph, NoFolderIsADrawer) {
  EXPECT_THAT(crowded_folders(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(IncludeGraph, ArrowsUpAreCaught) {
  EXPECT_THAT(chapter_breaches({file("radiosity/mesh/a.cpp", {"radiosity/light/b.h"}),
                                file("radiosity/light/b.h", {"radiosity/mesh/c.h"}),
                                file("radiosity/mesh/c.h")}),
              ElementsAre("radiosity/mesh/a may not include radiosity/light/b"));
  EXPECT_THAT(chapter_breaches({file("radiosity/light/a.h", {"radiosity/solvers/b.h"}),
                                file("radiosity/solvers/b.h")}),
              SizeIs(1));
  EXPECT_THAT(chapter_breaches({file("radiosity/drawer/a.h")}), SizeIs(1));
}

TEST(IncludeGraph, CirclesAreCaughtThroughHeaderAndSource) {
  EXPECT_THAT(knots({file("mirror/a.h"), file("mirror/a.cpp", {"mirror/a.h", "mirror/b.h"}),
                     file("mirror/b.h", {"mirror/c.h"}), file("mirror/c.h", {"mirror/a.h"}),
                     file("mirror/d.h", {"mirror/a.h"})}),
              ElementsAre("mirror/a, mirror/b, mirror/c include one another"));
  EXPECT_THAT(knots({file("mirror/a.h"), file("mirror/a.cpp", {"mirror/a.h"})}), IsEmpty());
  EXPECT_THAT(knots({file("tests/a.h", {"tests/b.h"}), file("tests/b.h", {"tests/a.h"})}),
              IsEmpty());
}

TEST(IncludeGraph, TheTwentyFirstPairIsCaught) {
  std::vector<SourceFile> tree;
  for (int k = 0; k < 20; ++k) {
    tree.push_back(file("mirror/a" + std::to_string(k) + ".h"));
    tree.push_back(file("mirror/a" + std::to_string(k) + ".cpp"));
  }
  EXPECT_THAT(crowded_folders(tree), IsEmpty());
  tree.push_back(file("mirror/b.cpp"));
  EXPECT_THAT(crowded_folders(tree), ElementsAre(HasSubstr("mirror has 21 pairs")));
}

} // namespace
} // namespace meninas
