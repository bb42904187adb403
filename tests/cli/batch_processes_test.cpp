// `batch` as several processes, killed and stopped ones among them:
// nothing is lost, nothing is done twice, all bits are the same.
#include "image/image_file.h"
#include "tests/cli/batch_folder.h"
#include "tests/support/random.h"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

Json view_job() {
  return {{"scenes", "room.glb"},
          {"cameras", {"*", orbit(6)}},
          {"outputs", {"{camera}{frame}.exr", "{camera}{frame}.png"}}};
}
Json other_job() {
  return {{"scenes", "room.glb"},
          {"cameras", orbit(4)},
          {"settings", {{"rays", 32}}},
          {"outputs", "other{frame}.exr"}};
}
constexpr std::size_t job_files = 8 * 2 + 4, job_pictures = 8 + 4;

/// How many pictures a process says it has made.
std::size_t made_by(const std::string& err) {
  std::size_t count = 0;
  for (auto at = err.find(" s)\n"); at != std::string::npos; at = err.find(" s)\n", at + 1)) {
    ++count;
  }
  return count;
}

TEST_F(BatchTest, TheSameBitsInAnyOrderWithAnyThreadsAndShards) {
  write_jobs({view_job(), other_job()});
  ASSERT_EQ(batch({"-o", "one", "--threads", "1"}).code, 0);
  const auto expected = pictures("one");
  ASSERT_EQ(expected.size(), job_files);
  ASSERT_EQ(batch({"-o", "two", "--threads", "3"}).code, 0);
  EXPECT_EQ(pictures("two"), expected);
  std::size_t made = 0;
  for (const char* shard : {"2/3", "3/3", "1/3"}) {
    const Outcome outcome = batch({"-o", "shards", "--shard", shard});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(made_by(outcome.err), job_pictures / 3);
    made += made_by(outcome.err);
  }
  EXPECT_EQ(made, job_pictures);
  EXPECT_EQ(pictures("shards"), expected);
  EXPECT_EQ(summary("shards")["counts"]["open"], 0) << "the last one knows of all";
  write_jobs({other_job(), view_job()});
  ASSERT_EQ(batch({"-o", "turned"}).code, 0);
  EXPECT_EQ(pictures("turned"), expected);
}

TEST_F(BatchTest, PicturesAreMadeByTheirNumbers) {
  write_jobs({view_job(), other_job()});
  ASSERT_EQ(batch({"-o", "all"}).code, 0);
  const Json listed = summary("all")["pictures"];
  for (std::size_t k = 0; k < listed.size(); ++k)
    EXPECT_EQ(listed[k]["number"], k);
  ASSERT_EQ(batch({"--only", "1,4-6"}).code, 0);
  const Json some = summary()["pictures"];
  for (std::size_t k = 0; k < some.size(); ++k)
    EXPECT_EQ(some[k]["status"] == "made", k == 1 || (k >= 4 && k <= 6)) << k;
  // Parts of the chosen ones, and what is chosen twice is made once.
  const Outcome last = batch({"--resume", "--only", "6-7,7,5-7", "--shard", "3/3"});
  EXPECT_EQ(made_by(last.err), 1) << last.err;
  EXPECT_EQ(summary()["pictures"][7]["status"], "made");
  ASSERT_EQ(batch({"--resume", "--only", "0,2-3,8-11"}).code, 0);
  EXPECT_TRUE(pictures() == pictures("all"));
}

TEST_F(BatchTest, ProcessesOnOneFolderShareTheWork) {
  write_jobs({view_job(), other_job()});
  ASSERT_EQ(batch({"-o", "alone"}).code, 0);
  std::vector<RunningProgram> processes;
  for (int k = 0; k < 3; ++k) {
    processes.push_back(begin_batch({"--threads", "1", "--resume"}));
  }
  std::size_t made = 0;
  for (RunningProgram& process : processes) {
    const Outcome outcome = process.outcome();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    made += made_by(outcome.err);
  }
  EXPECT_EQ(made, job_pictures) << "every picture once";
  EXPECT_EQ(pictures(), pictures("alone"));
  EXPECT_EQ(summary()["counts"]["open"], 0);
}

TEST_F(BatchTest, ShardsAtTheSameTimeDoEveryPictureOnce) {
  write_jobs({view_job(), other_job()});
  std::vector<RunningProgram> processes;
  for (const char* shard : {"0/3", "1/3", "2/3"}) {
    processes.push_back(begin_batch({"--threads", "1", "--shard", shard}));
  }
  std::size_t made = 0;
  for (RunningProgram& process : processes) {
    const Outcome outcome = process.outcome();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    made += made_by(outcome.err);
  }
  EXPECT_EQ(made, job_pictures);
  EXPECT_EQ(summary()["counts"]["made"].get<int>() + summary()["counts"]["found"].get<int>(),
            job_pictures);
}

/// Everything that has a name people look for is whole.
void expect_whole_files(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path file = entry->path();
    if (file.extension() == ".exr" || file.extension() == ".png") {
      EXPECT_NO_THROW(read_image(file)) << file;
    } else if (file.extension() == ".json") {
      EXPECT_TRUE(Json::accept(read_file(file))) << file;
    } else if (file.extension() == ".html") {
      EXPECT_THAT(read_file(file), testing::EndsWith("</html>\n"));
    }
  }
}

TEST_F(BatchTest, KilledAtThirtyMomentsAndResumedItEndsTheSame) {
  // Pictures take far longer than a process needs to begin,
  // so that most of the moments are amid the work.
  std::vector<Json> jobs{view_job(), other_job()};
  for (Json& job : jobs)
    job["settings"]["samples"] = 1024;
  write_jobs(jobs);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(batch({"-o", "undisturbed"}).code, 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  Random random(4);
  int killed = 0;
  for (int k = 0; k < 30; ++k) {
    if (k % 10 == 0) {
      fs::remove_all(folder_ / "out"); // begins, middles and ends three times over
    }
    RunningProgram process = begin_batch({"--resume"});
    // Ten such parts are more than the whole: the last ones find little left, or nothing.
    std::this_thread::sleep_for(random.between(0.0, 0.5) * whole);
    process.send(SIGKILL);
    killed += process.outcome().code == 128 + SIGKILL ? 1 : 0;
    expect_whole_files(folder_ / "out");
  }
  EXPECT_GE(killed, 10) << "most of them were still at it";
  const Outcome resumed = batch({"--resume"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(pictures(), pictures("undisturbed"));
  for (const fs::path& folder : {folder_ / "out", folder_ / "out" / ".meninas" / "solutions"}) {
    for (const std::string& name : files_in(folder)) {
      EXPECT_THAT(name, testing::Not(testing::EndsWith(".tmp")))
          << "left behind by a killed process";
    }
  }
  const auto before = fs::last_write_time(folder_ / "out" / "camera0000.exr");
  EXPECT_EQ(made_by(batch({"--resume"}).err), 0);
  EXPECT_EQ(fs::last_write_time(folder_ / "out" / "camera0000.exr"), before);
}

TEST_F(BatchTest, CtrlCStopsItAndSaysHowToGoOn) {
  Json job = view_job();
  job["settings"] = {{"size", "256x256"}, {"samples", 1024}};
  write_jobs({job});
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove_all(folder_ / "out");
    RunningProgram process = begin_batch({"--threads", "1"});
    wait_for_a_picture();
    const auto asked = std::chrono::steady_clock::now();
    process.send(signal);
    const Outcome outcome = process.outcome();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - asked;
    EXPECT_EQ(outcome.code, 128 + signal) << outcome.err;
    EXPECT_LT(taken.count(), 3.0) << "two seconds, and one for a machine with other work";
    EXPECT_THAT(outcome.err,
                testing::ContainsRegex(
                    "meninas: jobs.json: stopped by [^:]+: [0-9] of 8 pictures are done; "
                    "the same command with --resume goes on from here\n"));
    expect_whole_files(folder_ / "out");
    EXPECT_GT(summary()["counts"]["open"], 0);
  }
}

TEST_F(BatchTest, AScriptStopsItsBackgroundJobAndNohupHolds) {
  Json job = view_job();
  job["settings"] = {{"size", "256x256"}, {"samples", 1024}};
  write_jobs({job});
  const Outcome outcome = run_other_program(
      "/bin/sh", folder_.path(),
      {"-c", "trap '' HUP; " MENINAS_PROGRAM " batch jobs.json -o out --threads 1 & job=$!; "
             "until ls out/.meninas/locks/*.lock >/dev/null 2>&1; do sleep 0.05; done; "
             "kill -HUP $job; sleep 0.2; kill -INT $job; wait $job"});
  EXPECT_EQ(outcome.code, 128 + SIGINT) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("stopped by Ctrl-C"));
}

} // namespace
} // namespace meninas::test
