// `batch` when things go wrong: each has its documented outcome, and what can be made is made.
#include "tests/cli/batch_folder.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Key;

TEST_F(BatchTest, AFailureIsReportedAndTheOthersFinish) {
  std::ofstream(folder_ / "broken.glb") << "not a scene";
  write_jobs({{{"scenes", {"missing.glb", "broken.glb", "no*.glb", "room.glb"}}},
              {{"scenes", "room.glb"}, {"cameras", {"sid", "side"}}, {"outputs", "{camera}.exr"}}});
  const Outcome outcome = batch({"--junit", "results.xml"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("/jobs/0 missing.glb failed: missing.glb: no such file\n"));
  EXPECT_THAT(outcome.err, HasSubstr("/jobs/0 broken.glb failed: broken.glb: "));
  EXPECT_THAT(outcome.err, HasSubstr("/jobs/0 no*.glb failed: no*.glb: no file matches\n"));
  EXPECT_THAT(outcome.err, HasSubstr("room.glb: no camera 'sid', did you mean 'side'?\n"));
  EXPECT_THAT(outcome.err,
              HasSubstr("meninas: jobs.json: 4 of 6 pictures failed: /jobs/0 missing.glb, "));
  EXPECT_THAT(pictures(), ElementsAre(Key("room-camera-hybrid-0000.exr"), Key("side.exr")));
  EXPECT_EQ(summary()["counts"]["failed"], 4);
  EXPECT_EQ(summary()["pictures"][0]["error"], "missing.glb: no such file");
  EXPECT_THAT(read_file(folder_ / "results.xml"),
              HasSubstr("tests=\"6\" failures=\"4\" errors=\"0\""));
  EXPECT_THAT(read_file(folder_ / "results.xml"),
              HasSubstr("<failure message=\"missing.glb: no such file\"/>"));

  // With the scene there, only what failed is made.
  fs::copy(folder_ / "room.glb", folder_ / "missing.glb");
  EXPECT_EQ(batch({"--resume"}).code, 3);
  EXPECT_EQ(summary()["counts"]["made"], 1);
  EXPECT_EQ(summary()["counts"]["found"], 2);
}

TEST_F(BatchTest, WhatCannotBeWrittenFailsAlone) {
  fs::create_directories(folder_ / "out" / "b.exr");
  std::ofstream(folder_ / "out" / "taken") << "a file";
  write_jobs({{{"scenes", "room.glb"}, {"outputs", "a.exr"}},
              {{"scenes", "room.glb"}, {"outputs", "b.exr"}},
              {{"scenes", "room.glb"}, {"outputs", "taken/c.exr"}}});
  const Outcome outcome = batch();
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("b.exr failed: out/b.exr: cannot write: it is a folder\n"));
  EXPECT_THAT(outcome.err, HasSubstr("taken/c.exr failed: out/taken: cannot be made a folder"));
  EXPECT_EQ(summary()["counts"]["made"], 1);
}

// Files above a size the shell sets cannot be written, as on a full disk:
// the large picture fails, the small one is there.
TEST_F(BatchTest, AFullDiskLosesOnlyWhatDoesNotFit) {
  write_jobs({{{"scenes", "room.glb"},
               {"outputs", "large.exr"},
               {"settings", {{"size", "1280x960"}, {"float", true}}}},
              {{"scenes", "room.glb"}, {"outputs", "small.exr"}}});
  const Outcome outcome = run_other_program(
      "/bin/sh", folder_.path(),
      {"-c", "trap '' XFSZ; ulimit -f 2000; exec " MENINAS_PROGRAM " batch jobs.json -o out"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("large.exr failed: out/large.exr: cannot write: the file is larger"));
  EXPECT_THAT(pictures(), ElementsAre(Key("small.exr")));
  ASSERT_EQ(batch({"--resume"}).code, 0);
  EXPECT_EQ(summary()["counts"]["made"], 1);
  EXPECT_THAT(pictures(), ElementsAre(Key("large.exr"), Key("small.exr")));
}

/// Mounts file systems in a name space of its own, which only root may do.
class BatchOnOtherFileSystems : public BatchTest {
protected:
  void SetUp() override {
    if (run_other_program("/usr/bin/unshare", folder_.path(), {"-m", "true"}).code != 0) {
      GTEST_SKIP() << "mounting is not allowed here";
    }
    fs::create_directory(folder_ / "out");
    write_jobs({{{"scenes", "room.glb"},
                 {"cameras", orbit(8)},
                 {"settings", {{"size", "256x256"}, {"float", true}}}}});
  }
  Outcome batch_after(const std::string& mounting) {
    return run_other_program("/usr/bin/unshare", folder_.path(),
                             {"-m", "/bin/sh", "-c",
                              mounting + " && " MENINAS_PROGRAM
                                         " batch jobs.json -o out --cache kept; "
                                         "code=$?; cp -r out left; exit $code"});
  }
};

TEST_F(BatchOnOtherFileSystems, AFullDiskLosesOnlyWhatDoesNotFit) {
  const Outcome outcome = batch_after("mount -t tmpfs -o size=400k tmpfs out");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(".exr failed: out/room-orbit"));
  EXPECT_THAT(outcome.err, HasSubstr("cannot write: the disk is full\n"));
  EXPECT_THAT(outcome.err,
              HasSubstr("meninas: warning: out/summary.json: cannot write: the disk is full\n"
                        "meninas: jobs.json: "))
      << "the reason is what comes last";
  const auto left = pictures("left");
  EXPECT_GT(left.size(), 0U);
  EXPECT_LT(left.size(), 8U);
  // What is there is whole: what a disk with room for everything gets.
  ASSERT_EQ(batch().code, 0);
  const auto whole = pictures();
  for (const auto& [name, bytes] : left) {
    EXPECT_EQ(bytes, whole.at(name)) << name;
  }
}

TEST_F(BatchOnOtherFileSystems, AReadOnlyFolderEndsItAtOnce) {
  const Outcome outcome = batch_after("mount --bind out out && mount -o remount,bind,ro out");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(outcome.err,
            "meninas: out/.meninas/done: cannot be made a folder: Read-only file system\n");
  EXPECT_THAT(files_in(folder_ / "out"), IsEmpty());
}

TEST_F(BatchTest, AFolderThatCannotBeWrittenEndsItAtOnce) {
  write_jobs({{{"scenes", "room.glb"}}});
  std::ofstream(folder_ / "file") << "x";
  const Outcome file = batch({"-o", "file"});
  EXPECT_EQ(file.code, 4);
  EXPECT_THAT(file.err,
              testing::StartsWith("meninas: file/.meninas/done: cannot be made a folder"));
  // /proc is read-only for everybody, also for root.
  EXPECT_EQ(batch({"-o", "/proc/out"}).code, 4);
  if (::geteuid() != 0) {
    fs::create_directory(folder_ / "closed");
    fs::permissions(folder_ / "closed", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(batch({"-o", "closed"}).code, 4);
  }
}

TEST_F(BatchTest, ASceneThatVanishesOrChangesMeanwhileFailsAlone) {
  for (const char* name : {"vanishing.glb", "changing.glb"}) {
    fs::copy(folder_ / "room.glb", folder_ / name);
  }
  // Only one picture at a time is under way, and the first takes a while.
  write_jobs({{{"scenes", "room.glb"}, {"settings", {{"size", "256x256"}, {"samples", 128}}}},
              {{"scenes", {"vanishing.glb", "changing.glb"}}, {"settings", {{"rays", 32}}}}});
  RunningProgram process = begin_batch({"--threads", "1"});
  wait_for_a_picture();
  fs::remove(folder_ / "vanishing.glb");
  brighten_lamp();
  fs::copy(folder_ / "room.glb", folder_ / "changing.glb", fs::copy_options::overwrite_existing);
  const Outcome outcome = process.outcome();
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err,
              HasSubstr("vanishing-camera-hybrid-0000.exr failed: vanishing.glb: no such file\n"));
  EXPECT_THAT(
      outcome.err,
      HasSubstr("changing-camera-hybrid-0000.exr failed: changing.glb: has changed since the "
                "batch began: run it again with --resume\n"));
  EXPECT_EQ(summary()["counts"]["made"], 1);
  // One is still missing, the other is made as it is now.
  EXPECT_EQ(batch({"--resume"}).code, 3);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "changing-camera-hybrid-0000.exr"));
}

/// A jobs file is refused with this line, and nothing is made.
class BatchFile : public BatchTest {
protected:
  void expect_refused(const Json& job, const std::string& line) {
    write_jobs({{{"scenes", "room.glb"}}, job});
    const Outcome outcome = batch();
    EXPECT_EQ(outcome.err, "meninas: jobs.json: " + line + '\n');
    EXPECT_EQ(outcome.code, 3) << line;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
};

TEST_F(BatchFile, MistakesAreNamedByTheirPlace) {
  expect_refused({{"scenes", "room.glb"}, {"settings", {{"smaples", 4}}}},
                 "/jobs/1/settings/smaples: unknown setting, did you mean 'samples'?");
  expect_refused({{"scenes", "room.glb"}, {"settings", {{"samples", 1.5}}}},
                 "/jobs/1/settings/samples: '1.5' is not a whole number from 1 to 16777216");
  expect_refused(
      {{"scenes", "room.glb"}, {"modes", "reference"}},
      "/defaults/settings/element-size: has no effect with --mode reference: there is no pass one");
  expect_refused({{"scenes", "room.glb"}, {"settings", {{"camera", "side"}}}},
                 "/jobs/1/settings/camera: is no setting here but the job's 'cameras'");
  expect_refused({{"cameras", "*"}}, "/jobs/1: 'scenes' is missing, here and in the defaults");
  expect_refused({{"scenes", "room.glb"}, {"outputs", {"a.exr", "{scen}.exr"}}},
                 "/jobs/1/outputs/1: no part '{scen}', did you mean 'scene'?");
  expect_refused({{"scenes", "room.glb"},
                  {"cameras", {{"poses", {{{"position", {0, 0, 1}}, {"target", {0, 0, 1}}}}}}}},
                 "/jobs/1/cameras/poses/0: looks at its own position");
  expect_refused({{"scenes", "room.glb"},
                  {"cameras",
                   {{"poses",
                     {{{"position", {0, 0, 1}}, {"target", {0, 0, 0}}, {"at", 1}},
                      {{"position", {0, 0, 2}}, {"target", {0, 0, 0}}, {"at", 1}}}}}}},
                 "/jobs/1/cameras/poses/1: its time 1 is not after that of the pose before, 1");
}

TEST_F(BatchFile, NoFileIsTwoPictures) {
  write_jobs({{{"scenes", "room.glb"}, {"cameras", orbit(2)}, {"outputs", "{camera}.exr"}}});
  const Outcome frames = batch();
  EXPECT_EQ(frames.code, 3);
  EXPECT_THAT(frames.err, testing::StartsWith(
                              "meninas: jobs.json: /jobs/0: 'orbit.exr' would be two pictures"));
  write_jobs({{{"scenes", "room.glb"}}, {{"scenes", "room.glb"}}});
  EXPECT_THAT(batch().err,
              HasSubstr("/jobs/1: 'room-camera-hybrid-0000.exr' would be two pictures"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(BatchTest, WrongUsageIsRefused) {
  write_jobs({{{"scenes", "room.glb"}}});
  for (const auto& [shard, line] : std::vector<std::pair<std::string, std::string>>{
           {"1", "'1' is no part such as 1/4"},
           {"5/4", "'5' is not a whole number from 0 to 4"},
           {"1/0", "'0' is not a whole number from 1 to 1000000"},
           {"-1/4", "'-1' is not a whole number from 0 to 4"}}) {
    const Outcome outcome = batch({"--shard", shard});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "meninas: --shard: " + line + "\n");
  }
  for (const auto& [only, line] : std::vector<std::pair<std::string, std::string>>{
           {"", "'' is not a whole number from 0 to 1000000000"},
           {"1,", "'' is not a whole number from 0 to 1000000000"},
           {"3-1", "'1' is not a whole number from 3 to 1000000000"},
           {"0-1", "no picture 1: the batch has 1, from 0 on"}}) {
    const Outcome outcome = batch({"--only", only});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "meninas: --only: " + line + "\n");
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(run_program(folder_.path(), {"batch", "jobs.json"}).code, 2);
  const Outcome missing = run_program(folder_.path(), {"batch", "no.json", "-o", "out"});
  EXPECT_EQ(missing.code, 3);
  EXPECT_EQ(missing.err, "meninas: no.json: no such file\n");
}

} // namespace
} // namespace meninas::test
