// One picture, and one solve, on many machines: the bits of one, and parts that do not fit are named.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Parts : public testing::Test {
protected:
  Parts() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(std::vector<std::string> arguments) {
    return run_program(folder_.path(), arguments);
  }
  void must(std::vector<std::string> arguments) {
    arguments.push_back("--quiet");
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  std::vector<std::string> render(const std::string& output,
                                  const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "room.glb", "--size", "90x70", "--quality", "draft",
                                       "-o", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  std::string tile(int number, int count) { return std::to_string(number) + "of" + std::to_string(count) + ".exr"; }
  void render_tile(int number, int count, std::vector<std::string> options = {}) {
    options.insert(options.end(), {"--tile", std::to_string(number) + "/" + std::to_string(count)});
    must(render(tile(number, count), options));
  }
  bool same(const std::string& a, const std::string& b) {
    return read_file(folder_ / a) == read_file(folder_ / b);
  }

  /// The picture by one run and by parts: every byte of EXR and PNG is the same.
  void expect_same(int count, const std::vector<std::string>& options,
                   const std::vector<std::string>& merge_options = {}) {
    SCOPED_TRACE(testing::PrintToString(options));
    std::vector<std::string> whole = options;
    whole.insert(whole.end(), {"-o", "one.png"});
    whole.insert(whole.end(), merge_options.begin(), merge_options.end());
    must(render("one.exr", whole));
    std::vector<std::string> merge{"merge", "-o", "merged.exr", "-o", "merged.png"};
    for (int k = count; k >= 1; --k) {
      render_tile(k, count, options);
      merge.push_back(tile(k, count));
    }
    merge.insert(merge.end(), merge_options.begin(), merge_options.end());
    must(merge);
    EXPECT_TRUE(same("one.exr", "merged.exr"));
    EXPECT_TRUE(same("one.png", "merged.png"));
  }

  /// Of merging these, and nothing is written.
  void expect_refused(const std::string& line, std::vector<std::string> tiles, int code = 3) {
    tiles.insert(tiles.begin(), {"merge", "-o", "no.exr"});
    const Outcome outcome = run(tiles);
    EXPECT_EQ(outcome.code, code);
    EXPECT_EQ(outcome.err, "meninas: " + line + "\n");
    EXPECT_FALSE(fs::exists(folder_ / "no.exr"));
  }

  TemporaryFolder folder_;
};

TEST_F(Parts, HaveTheBitsOfTheWhole) {
  expect_same(1, {});
  expect_same(4, {"--diffuse", "direct", "--samples", "8"});
  expect_same(9, {"--exposure", "1.7", "--view-transform", "agx"}, {"--depth", "16"});
  expect_same(3, {"--mode", "radiosity", "--filter", "gaussian"}, {"--float"});
}

TEST_F(Parts, HaveTheBitsOfTheWholeWithLayers) {
  expect_same(4, {"--layers", "light,depth,normal,element"});
  expect_same(2, {"--layers", "lamps"});
}

// Which pixels take more samples depends on the mean of the whole picture, and on neighbours beyond the part.
TEST_F(Parts, HaveTheBitsOfTheWholeWithAdaptiveSamples) {
  expect_same(4, {"--pixel-error", "0.02", "--samples", "64"});
  expect_same(4, {"--pixel-error", "0.02", "--samples", "64", "--layers"});
}

TEST_F(Parts, HaveTheBitsOfTheWholeOfASolution) {
  must({"solve", "room.glb", "-o", "solution.glb", "--quality", "draft"});
  must(render("one.exr", {"--solution", "solution.glb"}));
  for (int k = 1; k <= 2; ++k)
    render_tile(k, 2, {"--solution", "solution.glb"});
  must({"merge", tile(1, 2), tile(2, 2), "-o", "merged.exr"});
  EXPECT_TRUE(same("one.exr", "merged.exr"));
}

TEST_F(Parts, AreWindowsOfThePicture) {
  render_tile(2, 2); // of three columns of tiles the last
  const ImageFile part = read_image(folder_ / tile(2, 2));
  EXPECT_EQ(part.picture.width, 90);
  EXPECT_EQ(part.picture.height, 70);
  EXPECT_THAT(part.remarks, testing::ElementsAre(HasSubstr("26x70 pixels from (64, 0) on are stored of its 90x70")));
}

TEST_F(Parts, ThatDoNotFitAreNamed) {
  for (int k = 1; k <= 3; ++k)
    render_tile(k, 3);
  expect_refused("1of3.exr: its picture is not whole: without part 2/3", {"1of3.exr", "3of3.exr"});
  expect_refused("3of3.exr: its picture is not whole: without parts 1/3, 2/3", {"3of3.exr"});
  fs::copy(folder_ / "2of3.exr", folder_ / "copy.exr");
  expect_refused("copy.exr: is part 2/3 once more, which 2of3.exr is already",
                 {"1of3.exr", "2of3.exr", "3of3.exr", "copy.exr"});
  must(render("other.exr", {"--tile", "2/3", "--samples", "2"}));
  expect_refused("other.exr: part 2/3 does not go with 1of3.exr: another settings (--quality draft --samples 2 and --quality draft)",
                 {"1of3.exr", "other.exr", "3of3.exr"});
  must({"render", "room.glb", "--size", "91x70", "--quality", "draft", "-o", "other.exr", "--tile", "2/3"});
  expect_refused("other.exr: part 2/3 does not go with 1of3.exr: a picture of another size (91x70 and 90x70)",
                 {"1of3.exr", "other.exr", "3of3.exr"});
  render_tile(2, 2);
  expect_refused("2of2.exr: part 2/2 does not go with 1of3.exr: a picture of 2 parts and not of 3",
                 {"1of3.exr", "2of2.exr", "3of3.exr"});
  TinyRoom room = tiny_room();
  room.root["materials"][0]["doubleSided"] = true;
  write_room(folder_ / "room.glb", room);
  must(render("other.exr", {"--tile", "2/3"}));
  const Outcome outcome = run({"merge", "1of3.exr", "other.exr", "3of3.exr", "-o", "no.exr"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("other.exr: part 2/3 does not go with 1of3.exr: another scene ("));
}

TEST_F(Parts, ThatAreNoneAreRefused) {
  must(render("whole.exr", {"-o", "whole.png"}));
  expect_refused("whole.exr: is no part of a picture made by 'meninas render --tile'", {"whole.exr"});
  expect_refused("whole.png: is no part of a picture", {"whole.png"});
  expect_refused("missing.exr: no such file", {"missing.exr"});
  render_tile(1, 2);
  const std::string bytes = read_file(folder_ / "1of2.exr");
  std::ofstream(folder_ / "cut.exr", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_EQ(run({"merge", "cut.exr", "-o", "no.exr"}).code, 3);
  expect_refused("1of2.exr: is an input, which would be overwritten", {"1of2.exr", "-o", "1of2.exr"}, 2);
}

TEST_F(Parts, AreOfWhatIsKnownPixelByPixel) {
  for (const auto& [options, line] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--tile", "1"}, "--tile: '1' is no part such as 1/4"},
           {{"--tile", "3/2"}, "--tile: '3' is not a whole number from 0 to 2"},
           {{"--tile", "1/10"}, "--tile: a picture of 90x70 pixels has no more than 9 parts"},
           {{"--tile", "1/2", "-o", "b.exr"}, "--tile: needs one output, an EXR: `meninas merge` makes the others"},
           {{"--tile", "1/2", "--error-map"}, "--error-map: needs the whole picture: it does not go with --tile"},
           {{"--tile", "1/2", "--float"}, "--float: does not go with --tile: give it to `meninas merge`"},
           {{"--tile", "1/2", "--mode", "reference"},
            "--tile: does not go with --mode reference, which samples the whole picture until its mean is known"}}) {
    const Outcome outcome = run(render("a.exr", options));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(without_progress(outcome.err), "meninas: " + line + "\n");
  }
  EXPECT_THAT(files_in(folder_.path()), testing::ElementsAre("room.glb"));
}

// --- Rows of form factors

class Rows : public Parts {
protected:
  std::vector<std::string> solve(std::vector<std::string> options) {
    options.insert(options.begin(), {"solve", "room.glb", "--quality", "draft"});
    return options;
  }
  void write_rows(int count, const std::vector<std::string>& more = {}) {
    for (int k = 1; k <= count; ++k) {
      std::vector<std::string> options{"--factors", "rows", "--shard",
                                       std::to_string(k) + "/" + std::to_string(count)};
      options.insert(options.end(), more.begin(), more.end());
      must(solve(options));
    }
  }
  void expect_no_join(const std::string& line, const std::vector<std::string>& more = {}) {
    std::vector<std::string> options{"--factors", "rows", "--join", "-o", "no.glb", "--quiet"};
    options.insert(options.end(), more.begin(), more.end());
    const Outcome outcome = run(solve(options));
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err, "meninas: " + line + "\n");
    EXPECT_FALSE(fs::exists(folder_ / "no.glb"));
  }
};

TEST_F(Rows, HaveTheBitsOfOneMachine) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--form-factors", "hemicube"}, {"--solver", "cg"}}) {
    fs::remove_all(folder_ / "rows");
    write_rows(3, options);
    std::vector<std::string> joined{"--factors", "rows", "--join", "-o", "joined.glb"}, plain{"--mesh", "uniform", "-o", "plain.glb"};
    joined.insert(joined.end(), options.begin(), options.end());
    plain.insert(plain.end(), options.begin(), options.end());
    must(solve(joined));
    must(solve(plain));
    EXPECT_TRUE(same("joined.glb", "plain.glb"));
  }
  EXPECT_THAT(files_in(folder_ / "rows"),
              testing::ElementsAre("rows-1-of-3.factors", "rows-2-of-3.factors", "rows-3-of-3.factors"));
}

TEST_F(Rows, ThatDoNotFitAreNamed) {
  expect_no_join("rows: holds no rows written by 'meninas solve --factors DIR --shard K/N'");
  write_rows(3);
  fs::rename(folder_ / "rows" / "rows-2-of-3.factors", folder_ / "kept");
  expect_no_join("rows: rows are missing: 'rows-2-of-3.factors'");
  fs::copy(folder_ / "rows" / "rows-1-of-3.factors", folder_ / "rows" / "rows-2-of-3.factors");
  expect_no_join("rows/rows-2-of-3.factors: is not what its name says, but part 1/3");
  must(solve({"--factors", "rows", "--shard", "2/3", "--seed", "7"}));
  expect_no_join("rows/rows-2-of-3.factors: cannot be reused: the settings of the form factors have changed since it was written");
  const std::string whole = read_file(folder_ / "kept");
  std::ofstream(folder_ / "rows" / "rows-2-of-3.factors", std::ios::binary) << whole.substr(0, whole.size() - 9);
  expect_no_join("rows/rows-2-of-3.factors: damaged: its data do not have the hash it announces");
  fs::rename(folder_ / "kept", folder_ / "rows" / "rows-2-of-3.factors");
  must(solve({"--factors", "rows", "--shard", "1/2"}));
  expect_no_join("rows/rows-1-of-3.factors: is of another division than rows/rows-1-of-2.factors: one of them has to go");
  fs::remove(folder_ / "rows" / "rows-1-of-2.factors");
  must(solve({"--factors", "rows", "--join", "-o", "joined.glb"}));
}

// Rows hold what windows and rays have seen of the sky.
TEST_F(Rows, OfAnotherSkyAreNamed) {
  const std::vector<std::string> morning{"--sky", "clear", "--sun", "90,20"}, noon{"--sky", "clear", "--sun", "180,60"};
  const auto with_sky = [&](std::vector<std::string> options, const std::vector<std::string>& sky) {
    options.insert(options.end(), sky.begin(), sky.end());
    return solve(options);
  };
  must(with_sky({"--factors", "rows", "--shard", "1/2"}, morning));
  must(with_sky({"--factors", "rows", "--shard", "2/2"}, noon));
  const Outcome mixed = run(with_sky({"--factors", "rows", "--join", "-o", "no.glb", "--quiet"}, morning));
  EXPECT_EQ(mixed.code, 3);
  EXPECT_EQ(mixed.err, "meninas: rows/rows-2-of-2.factors: cannot be reused: the sky has changed since it was written\n");
  must(with_sky({"--factors", "rows", "--shard", "2/2"}, morning));
  must(with_sky({"--factors", "rows", "--join", "-o", "joined.glb"}, morning));
}

TEST_F(Rows, AreNotWrittenOver) {
  write_rows(2);
  const Outcome outcome = run(solve({"--factors", "rows", "--join", "-o", "no.glb", "--stats", "rows/rows-1-of-2.factors"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("rows/rows-1-of-2.factors: is an input, which would be overwritten"));
}

TEST_F(Rows, OfStrangeNumbersAreNone) {
  fs::create_directory(folder_ / "rows");
  std::ofstream(folder_ / "rows" / "rows-1-of-18446744073709551615.factors") << "none";
  expect_no_join("rows: holds no rows written by 'meninas solve --factors DIR --shard K/N'");
  const Outcome many = run(solve({"--factors", "rows", "--shard", "1/900000"}));
  EXPECT_EQ(many.code, 2);
  EXPECT_THAT(many.err, HasSubstr("--shard: 900000 parts are more than the "));
  std::vector<std::string> missing = solve({"--factors", "new/rows", "--shard", "1/2"});
  std::ranges::replace(missing, std::string("room.glb"), std::string("missing.glb"));
  EXPECT_EQ(run(missing).code, 3);
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(Rows, AreRefusedWithWhatTheyDoNotGoWith) {
  for (const auto& [options, line] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--shard", "1/2"}, "--shard: needs the folder of the rows: --factors DIR"},
           {{"--join", "-o", "a.glb"}, "--join: needs the folder of the rows: --factors DIR"},
           {{"--join", "--factors", "rows"}, "solve: --output is required"},
           {{"--shard", "1/2", "--factors", "rows", "-o", "a.glb"},
            "--output: does not go with --shard, which writes rows alone"},
           {{"--shard", "1/2", "--factors", "rows", "--mesh", "hierarchical"},
            "--mesh hierarchical: has no form factors of elements to keep or reuse"}}) {
    const Outcome outcome = run(solve(options));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(without_progress(outcome.err), "meninas: " + line + "\n");
  }
}

} // namespace
} // namespace meninas::test
