#include "tests/house/source_tree.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace meninas {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SourceFile file(const std::string& path, std::vector<std::string> lines) {
  return {path, std::move(lines)};
}

std::string include_of(const std::string& what) { return "#include " + what; }

std::vector<std::string> direction_breaches_of(const std::string& path,
                                               const std::string& included) {
  return include_direction_breaches({file(path, {include_of(included)})});
}

TEST(SourceTree, IncludesPointOneWay) {
  EXPECT_THAT(include_direction_breaches(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(SourceTree, WrappedLibrariesHaveOneUserEach) {
  EXPECT_THAT(wrapped_library_breaches(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(SourceTree, FilesAreShortAndHeadersSayWhatTheyAre) {
  EXPECT_THAT(file_shape_breaches(read_source_tree(test::source_dir())), IsEmpty());
}

TEST(SourceTree, FoldersHaveAPageThatSaysWhereToStart) {
  EXPECT_THAT(folder_page_breaches(test::source_dir(), read_source_tree(test::source_dir())), IsEmpty());
}

TEST(SourceTree, FoldersWithoutAPageAreCaught) {
  const std::filesystem::path root =
      std::filesystem::temp_directory_path() / ("meninas-pages-" + std::to_string(getpid()));
  const auto breaches_with = [&](const std::string& page) {
    std::filesystem::create_directories(root / "mirror/tree");
    std::ofstream(root / "mirror/a.h") << "// Mirrors.\n";
    std::ofstream(root / "mirror/tree/README.md") << page;
    return folder_page_breaches(root, {file("mirror/tree/b.h", {}), file("cmake/c.cmake", {})});
  };
  EXPECT_THAT(breaches_with("# Trees\n\nStart with `mirror/a.h`. May include: `mirror/`.\n"), IsEmpty());
  EXPECT_THAT(breaches_with("Start with the header `a.h`. May include: `mirror/`.\n"), ElementsAre(HasSubstr("no title")));
  EXPECT_THAT(breaches_with("# Trees\n\nStart with `old.h`. May include: `mirror/`.\n"),
              ElementsAre(HasSubstr("mirror/tree/README.md: 'Start with'")));
  EXPECT_THAT(breaches_with("# Trees\n\nStart with `a.h`.\n"), ElementsAre(HasSubstr("no 'May include: '")));
  EXPECT_THAT(folder_page_breaches(root, {file("mirror/b.h", {})}), testing::SizeIs(3)) << "which has no page";
  std::filesystem::remove_all(root);
}

// The program is tested from outside, in one folder: cli/ is left out.
TEST(SourceTree, TestsFollowTheTree) {
  std::vector<SourceFile> libraries = read_source_tree(test::source_dir());
  std::erase_if(libraries, [](const SourceFile& source) { return source.path.starts_with("cli/"); });
  EXPECT_THAT(stray_tests(libraries), IsEmpty());
  EXPECT_THAT(stray_tests({file("mirror/deep/a.h", {}), file("tests/mirror/a_test.cpp", {}), file("tests/mirror/deep/a_test.cpp", {}),
                           file("tests/physics/a_test.cpp", {}), file("tests/mirror/b_test.cpp", {})}),
              ElementsAre("tests/mirror/a_test.cpp: what it tests is in mirror/deep"));
}

TEST(SourceTree, NamesAreThoseOfTheGlossary) {
  EXPECT_THAT(retired_words(read_source_tree(test::source_dir())), IsEmpty());
  EXPECT_THAT(retired_words({file("mirror/a.h", {"// one", "struct KeptRays;"})}),
              ElementsAre(HasSubstr("mirror/a.h:2: KeptRays")));
  EXPECT_THAT(retired_words({file("mirror/a.h", {"// one", "int most_points = 4, at_most = 1;"}),
                             file("runs/a.js", {"const fewRays = 2;", "words.most_common()"})}),
              ElementsAre(HasSubstr("mirror/a.h:2: a limit"), HasSubstr("runs/a.js:1: a limit")));
}

TEST(SourceTree, TheArchitectureHasTwoPassesAndTheNotesTheRest) {
  constexpr std::uintmax_t most = 15 * 1024; // what is read before the code, in one sitting
  EXPECT_LE(std::filesystem::file_size(std::filesystem::path(test::source_dir()) / "ARCHITECTURE.md"), most)
      << "rows of equations that are not those of the two passes belong to docs/notes/equations.md";
}

TEST(SourceTree, TheScannerReadsThisTree) {
  std::vector<std::string> paths;
  for (const SourceFile& source : read_source_tree(test::source_dir())) {
    paths.push_back(source.path);
  }
  EXPECT_THAT(paths, testing::IsSupersetOf(
                         {"scenes/scene.h", "image/image.cpp", "tests/house/source_tree.cpp"}));
}

TEST(SourceTree, IncludeLinesAreRecognised) {
  EXPECT_EQ(included_path("#include \"scenes/scene.h\""), "scenes/scene.h");
  EXPECT_EQ(included_path("  #  include <embree3/rtcore.h> // rays"), "embree3/rtcore.h");
  EXPECT_EQ(included_path("// #include \"scenes/scene.h\""), "");
}

TEST(SourceTree, EveryAllowedDirectionPasses) {
  const std::vector<std::string> chain = {"scenes",    "mirror",   "form_factors",
                                          "radiosity", "raytrace", "runs",
                                          "cli"};
  for (std::size_t user = 0; user < chain.size(); ++user) {
    for (std::size_t used = 0; used <= user; ++used) {
      EXPECT_THAT(direction_breaches_of(chain[user] + "/a.cpp", '"' + chain[used] + "/b.h\""),
                  IsEmpty());
    }
  }
  for (const std::string used : {"scenes", "image", "reference"}) {
    EXPECT_THAT(direction_breaches_of("reference/a.cpp", '"' + used + "/b.h\""), IsEmpty());
    EXPECT_THAT(direction_breaches_of("runs/a.cpp", '"' + used + "/b.h\""), IsEmpty());
  }
  EXPECT_THAT(direction_breaches_of("image/a.cpp", "\"scenes/errors.h\""), IsEmpty());
  EXPECT_THAT(direction_breaches_of("tests/mirror/a.cpp", "\"tests/support/scene_builder.h\""),
              IsEmpty());
  EXPECT_THAT(direction_breaches_of("bench/a.cpp", "\"raytrace/b.h\""), IsEmpty());
}

TEST(SourceTree, EveryOppositeDirectionIsCaught) {
  const std::vector<std::string> chain = {"scenes", "mirror", "form_factors", "radiosity",
                                          "raytrace", "runs", "cli", "tests"};
  for (std::size_t user = 0; user < chain.size(); ++user) {
    for (std::size_t used = user + 1; used < chain.size(); ++used) {
      EXPECT_THAT(
          direction_breaches_of(chain[user] + "/a.cpp", '"' + chain[used] + "/b.h\""),
          ElementsAre(HasSubstr("a.cpp:1: " + chain[user] + " may not include " + chain[used])));
    }
  }
  for (const std::string used : {"mirror", "form_factors", "radiosity", "raytrace", "runs", "cli"}) {
    EXPECT_THAT(direction_breaches_of("reference/a.h", '"' + used + "/b.h\""), testing::SizeIs(1));
    EXPECT_THAT(direction_breaches_of("image/a.h", '<' + used + "/b.h>"), testing::SizeIs(1));
  }
  for (const std::string user : {"scenes", "mirror", "radiosity", "raytrace"}) {
    EXPECT_THAT(direction_breaches_of(user + "/a.cpp", "\"reference/b.h\""), testing::SizeIs(1));
  }
  EXPECT_THAT(direction_breaches_of("scenes/a.cpp", "\"image/image.h\""), testing::SizeIs(1));
  EXPECT_THAT(direction_breaches_of("image/a.cpp", "\"scenes/scene.h\""), testing::SizeIs(1));
}

TEST(SourceTree, StrangeFoldersAndRelativeIncludesAreCaught) {
  EXPECT_THAT(direction_breaches_of("utils/a.h", "<vector>"),
              ElementsAre(HasSubstr("utils/a.h:1: its folder")));
  EXPECT_THAT(direction_breaches_of("mirror/a.cpp", "\"b.h\""),
              ElementsAre(HasSubstr("the project's root")));
  EXPECT_THAT(direction_breaches_of("mirror/a.cpp", "\"../scenes/b.h\""), testing::SizeIs(1));
}

TEST(SourceTree, SecondUsersOfWrappedLibrariesAreCaught) {
  const std::string embree = include_of("<embree3/rtcore.h>");
  const auto breaches = [&](const std::string& path, const std::string& line) {
    return wrapped_library_breaches({file("scenes/first.cpp", {embree}), file(path, {line})});
  };
  EXPECT_THAT(breaches("scenes/first.cpp", embree), IsEmpty());
  EXPECT_THAT(breaches("bench/rays.cpp", embree), IsEmpty());
  EXPECT_THAT(breaches("scenes/second.cpp", embree),
              ElementsAre(HasSubstr("already has its one user, scenes/first.cpp")));
  EXPECT_THAT(breaches("scenes/rays/a.h", embree), IsEmpty());
  EXPECT_THAT(breaches("scenes/a.h", embree), ElementsAre(HasSubstr("one .cpp of scenes")));
  EXPECT_THAT(breaches("raytrace/a.cpp", embree), testing::SizeIs(1));
  EXPECT_THAT(breaches("image/a.cpp", include_of("<tiny_gltf.h>")), testing::SizeIs(1));
  EXPECT_THAT(breaches("scenes/a.cpp", include_of("<OpenImageIO/imageio.h>")), testing::SizeIs(1));
}

TEST(SourceTree, LongFilesAndBareHeadersAreCaught) {
  EXPECT_THAT(file_shape_breaches({file("mirror/a.cpp", std::vector<std::string>(400))}),
              IsEmpty());
  EXPECT_THAT(file_shape_breaches({file("mirror/a.cpp", std::vector<std::string>(401))}),
              ElementsAre(HasSubstr("longer than 400")));
  EXPECT_THAT(file_shape_breaches({file("mirror/a.h", {"// Mirrors.", "#pragma once"})}),
              IsEmpty());
  EXPECT_THAT(file_shape_breaches({file("mirror/a.h", {"#pragma once"})}),
              ElementsAre(HasSubstr("opens with")));
  EXPECT_THAT(file_shape_breaches({file("mirror/a.h", {"// Mirrors."})}),
              ElementsAre(HasSubstr("#pragma once")));
  EXPECT_THAT(file_shape_breaches({file("mirror/a.h", {})}), testing::SizeIs(2));
}

TEST(SourceTree, ABadTreeOnDiskIsCaught) {
  const std::filesystem::path root =
      std::filesystem::temp_directory_path() / ("meninas-house-" + std::to_string(getpid()));
  for (const std::string folder : {"scenes/gallery", "cli", "someones/notes"}) {
    std::filesystem::create_directories(root / folder);
    if (folder != "someones/notes") {
      std::ofstream(root / folder.substr(0, folder.find('/')) / "CMakeLists.txt") << '\n';
    }
    std::ofstream(root / folder / "bad.h") << include_of("\"cli/bad.h\"") << '\n';
  }
  const std::vector<SourceFile> tree = read_source_tree(root);
  std::filesystem::remove_all(root);
  EXPECT_THAT(include_direction_breaches(tree),
              ElementsAre("scenes/gallery/bad.h:1: scenes may not include cli/bad.h"));
  EXPECT_THAT(file_shape_breaches(tree), testing::SizeIs(4));
}

} // namespace
} // namespace meninas
