// `batch`: what it makes, from how many solves, and what it leaves alone.
#include "tests/cli/batch_folder.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>

#include <fstream>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

Json all_kinds() {
  return {{"scenes", "room.glb"},
          {"cameras", {"*", orbit(2)}},
          {"modes", {"radiosity", "hybrid"}},
          {"outputs", {"{camera}-{mode}-{frame}.exr", "png/{scene} {camera} {mode}{frame}.png"}}};
}

TEST_F(BatchTest, PicturesAreThoseOfRender) {
  write_jobs({all_kinds(),
              {{"scenes", "room.glb"},
               {"modes", "reference"},
               {"settings", {{"element-size", nullptr}, {"rays", nullptr}, {"samples", 32}}}}});
  const Outcome outcome = batch();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(pictures().size(), 17);
  for (const std::string camera : {"camera", "side"}) {
    for (const std::string mode : {"radiosity", "hybrid"}) {
      run_program(folder_.path(), {"render", "room.glb", "-o", "a.exr", "-o", "a.png", "--camera",
                                   camera, "--mode", mode, "--element-size", "0.25", "--rays", "16",
                                   "--size", "24x16", "--samples", "1", "--quiet"});
      EXPECT_EQ(pictures()[camera + "-" + mode + "-0000.exr"], read_file(folder_ / "a.exr"));
      EXPECT_EQ(pictures()["png/room " + camera + " " + mode + "0000.png"],
                read_file(folder_ / "a.png"));
    }
  }
  run_program(folder_.path(), {"render", "room.glb", "-o", "a.exr", "--mode", "reference",
                               "--samples", "32", "--size", "24x16", "--quiet"});
  EXPECT_EQ(pictures()["room-camera-reference-0000.exr"], read_file(folder_ / "a.exr"));
  EXPECT_NE(pictures()["orbit-hybrid-0000.exr"], pictures()["orbit-hybrid-0001.exr"]);
}

TEST_F(BatchTest, EveryOptionOfRenderIsASetting) {
  write_jobs({{{"scenes", "room.glb"},
               {"settings", {{"diffuse", "direct"}, {"layers", true}}},
               {"outputs", "layers.exr"}},
              {{"scenes", "room.glb"},
               {"settings", {{"adaptive", 0.03}, {"element-size", nullptr}}},
               {"outputs", "adaptive.exr"}}});
  ASSERT_EQ(batch().code, 0);
  const auto made = pictures();
  const auto render = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command{"render",    "room.glb", "-o",     "a.exr", "--rays", "16",
                                     "--samples", "1",        "--size", "24x16", "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    EXPECT_EQ(run_program(folder_.path(), command).code, 0);
    return read_file(folder_ / "a.exr");
  };
  EXPECT_EQ(made.at("layers.exr"),
            render({"--diffuse", "direct", "--layers", "--element-size", "0.25"}));
  EXPECT_EQ(made.at("adaptive.exr"), render({"--adaptive", "0.03"}));
}

TEST_F(BatchTest, TheSummarySaysWhatWasDone) {
  write_jobs({all_kinds()});
  ASSERT_EQ(batch({"--junit", "results.xml", "--threads", "2"}).code, 0);
  const Json said = summary();
  EXPECT_EQ(said["counts"],
            Json({{"pictures", 8}, {"made", 8}, {"found", 0}, {"failed", 0}, {"open", 0}}));
  EXPECT_EQ(said["threads"], 2);
  EXPECT_GT(said["rays_per_second"], 0);
  ASSERT_EQ(said["solves"].size(), 1);
  EXPECT_EQ(said["solves"][0]["solved"], true);
  EXPECT_LT(said["solves"][0]["error_bound"], 1e-4);
  const Json& last = said["pictures"][7];
  EXPECT_EQ(last["name"], "orbit-hybrid-0001.exr");
  EXPECT_EQ(last["files"], Json({"orbit-hybrid-0001.exr", "png/room orbit hybrid0001.png"}));
  EXPECT_EQ(last["frame"], 1);
  EXPECT_EQ(last["width"], 24);
  EXPECT_GE(last["rays"], 24 * 16);
  const std::string page = read_file(folder_ / "out" / "index.html");
  EXPECT_THAT(page, HasSubstr("meninas batch jobs.json -o out --resume"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(read_file(folder_ / "results.xml"),
              HasSubstr("tests=\"8\" failures=\"0\" errors=\"0\""));
}

/// How many scenes the last run has solved.
int solved(const Json& summary) {
  int count = 0;
  for (const Json& solve : summary["solves"]) {
    count += solve["solved"] == true ? 1 : 0;
  }
  return count;
}

TEST_F(BatchTest, OneSolveServesAllViewsUntilItsSceneOrSettingsChange) {
  Json job{
      {"scenes", "room.glb"}, {"cameras", {"*", orbit(3)}}, {"modes", {"radiosity", "hybrid"}}};
  write_jobs({job});
  ASSERT_EQ(batch().code, 0);
  EXPECT_EQ(solved(summary()), 1);
  const auto first = pictures();

  ASSERT_EQ(batch().code, 0);
  EXPECT_EQ(summary()["counts"]["made"], 10) << "without --resume all is rendered anew";
  EXPECT_EQ(solved(summary()), 0) << "but what pass one has found stays true";
  EXPECT_EQ(pictures(), first);

  job["settings"] = {{"samples", 2}, {"size", "16x16"}, {"exposure", 1}};
  write_jobs({job});
  ASSERT_EQ(batch({"--resume"}).code, 0);
  EXPECT_EQ(summary()["counts"]["made"], 10) << "other pictures";
  EXPECT_EQ(solved(summary()), 0) << "of the same light";

  job["settings"] = {{"rays", 32}};
  write_jobs({job});
  ASSERT_EQ(batch({"--resume"}).code, 0);
  EXPECT_EQ(solved(summary()), 1);

  brighten_lamp();
  ASSERT_EQ(batch({"--resume"}).code, 0);
  EXPECT_EQ(summary()["counts"]["made"], 10);
  EXPECT_EQ(solved(summary()), 1);
}

TEST_F(BatchTest, ADamagedSolutionIsNoticedAndMadeAgain) {
  write_jobs({{{"scenes", "room.glb"}}});
  ASSERT_EQ(batch({"--cache", "kept"}).code, 0);
  const auto first = pictures();
  ASSERT_EQ(files_in(folder_ / "kept").size(), 1);
  const std::string name = "kept/" + files_in(folder_ / "kept").front();
  const std::string whole = read_file(folder_ / name);
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), std::string(), flipped}) {
    std::ofstream(folder_ / name, std::ios::binary) << damaged;
    const Outcome outcome = batch({"--cache", "kept"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("warning: room.glb: " + name));
    EXPECT_THAT(outcome.err, HasSubstr("solving again"));
    EXPECT_EQ(read_file(folder_ / name), whole);
    EXPECT_EQ(pictures(), first);
  }
}

TEST_F(BatchTest, ResumingMakesWhatIsMissingOrSpoiltAndNothingElse) {
  write_jobs({{{"scenes", "room.glb"}, {"cameras", orbit(6)}, {"outputs", "{frame}.exr"}}});
  ASSERT_EQ(batch().code, 0);
  const auto first = pictures();
  fs::remove(folder_ / "out" / "0001.exr");
  std::ofstream(folder_ / "out" / "0003.exr", std::ios::app) << 'x';
  const auto before = fs::last_write_time(folder_ / "out" / "0000.exr");
  const std::string outlook = batch({"--dry-run"}).out;
  EXPECT_THAT(
      outlook,
      HasSubstr("done    0 0000.exr\nrender  1 0001.exr\ndone    2 0002.exr\nrender  3 0003.exr\n"));
  EXPECT_THAT(outlook,
              HasSubstr("6 pictures: 2 to render, 4 done already, 0 that cannot be; 0 to solve"));
  ASSERT_EQ(batch({"--resume"}).code, 0);
  EXPECT_EQ(summary()["counts"]["made"], 2);
  EXPECT_EQ(summary()["counts"]["found"], 4);
  EXPECT_EQ(pictures(), first);
  EXPECT_EQ(fs::last_write_time(folder_ / "out" / "0000.exr"), before);
}

TEST_F(BatchTest, ADryRunTouchesNothing) {
  fs::create_directories(folder_ / "rooms");
  fs::copy(folder_ / "room.glb", folder_ / "rooms" / "b.glb");
  fs::copy(folder_ / "room.glb", folder_ / "rooms" / "a.glb");
  write_jobs({{{"scenes", {"rooms/{b,a}.glb", "rooms/*"}}, {"cameras", "s*"}}});
  const Outcome outcome = batch({"--dry-run"});
  EXPECT_EQ(outcome.code, 0);
  // The same room is the same solution, whatever its file is called.
  EXPECT_EQ(outcome.out, "solve   rooms/a.glb\nrender  0 a-side-hybrid-0000.exr\n"
                         "render  1 b-side-hybrid-0000.exr\n"
                         "2 pictures: 2 to render, 0 done already, 0 that cannot be; 1 to solve\n");
  EXPECT_THAT(files_in(folder_.path()), ElementsAre("jobs.json", "room.glb", "rooms"));
}

TEST_F(BatchTest, TheExampleOfTheManualWorks) {
  const Outcome outcome =
      run_program(folder_.path(), {"batch", source_dir() + "/docs/batch.example.json", "-o",
                                   "out", "--dry-run"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex("render  [0-9]+ walk/0023.png\n"));
  EXPECT_THAT(outcome.out, HasSubstr(" 0 done already, 0 that cannot be;"));
}

TEST_F(BatchTest, TheSchemaKnowsEverySetting) {
  const Outcome outcome = run_program(folder_.path(), {"batch", "--schema"});
  EXPECT_EQ(outcome.code, 0);
  Json schema = Json::parse(outcome.out);
  const Json settings = schema["$defs"]["settings"]["properties"];
  EXPECT_EQ(settings["quality"]["enum"], Json({"draft", "normal", "fine", nullptr}));
  EXPECT_EQ(settings["float"]["type"], Json({"boolean", "null"}));
  EXPECT_TRUE(settings.contains("samples"));
  EXPECT_FALSE(settings.contains("camera"));
  // But for them it is the file that ships.
  schema["$defs"]["settings"]["properties"] = Json::object();
  EXPECT_EQ(schema, Json::parse(read_file(source_dir() + "/docs/batch.schema.json")));
}

TEST_F(BatchTest, MemoryIsAskedForBeforeItIsTaken) {
  write_jobs(
      {{{"scenes", "room.glb"}, {"outputs", "small.exr"}},
       {{"scenes", "room.glb"}, {"settings", {{"size", "8000x8000"}}}, {"outputs", "large.exr"}}});
  const Outcome outcome = batch({"--memory-limit", "1G"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err,
              testing::ContainsRegex("large.exr failed: room.glb: needs about [0-9.]+ GiB, "
                                     "more than the memory limit of 1 GiB\n"));
  EXPECT_THAT(pictures(), ElementsAre(Pair("small.exr", testing::Ne(""))));
  EXPECT_LT(summary()["peak_memory_bytes"], 1 << 30);
  for (const char* size : {"0", "-1G", "much", "1X", "1GX", "G"}) {
    const Outcome refused = batch({"--memory-limit", size});
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.err, std::string("meninas: --memory-limit: '") + size +
                               "' is no size such as 800M or 1.5G\n");
  }
}

} // namespace
} // namespace meninas::test
