// Locks: one holder at a time, and none is left by a process that ends.
#include "runs/batch/file_lock.h"
#include "scenes/errors.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

namespace meninas {
namespace {

class FileLocks : public testing::Test {
protected:
  FileLocks() {
    std::string pattern = (std::filesystem::temp_directory_path() / "meninas-lock-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    file_ = folder_ / "a.lock";
  }
  ~FileLocks() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_, file_;
};

TEST_F(FileLocks, OneHolderAtATimeWhoCleansUp) {
  {
    const auto held = try_lock(file_);
    ASSERT_TRUE(held);
    EXPECT_FALSE(try_lock(file_));
    EXPECT_TRUE(std::filesystem::exists(file_));
  }
  EXPECT_FALSE(std::filesystem::exists(file_));
  EXPECT_TRUE(try_lock(file_));
}

TEST_F(FileLocks, AFileLeftBehindIsNoLock) {
  std::ofstream(file_) << "elsewhere 4711\n";
  EXPECT_TRUE(try_lock(file_));
}

TEST_F(FileLocks, AKilledProcessHoldsNothing) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto held = try_lock(file_);
    const char said = held ? 'y' : 'n';
    [[maybe_unused]] const auto written = ::write(ready[1], &said, 1);
    ::pause();
    ::_exit(0);
  }
  char said = 0;
  ASSERT_EQ(::read(ready[0], &said, 1), 1);
  EXPECT_EQ(said, 'y');
  EXPECT_FALSE(try_lock(file_));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(file_)) << "nobody could clean up";
  EXPECT_TRUE(try_lock(file_));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(FileLocks, ManyThreadsTakeTurns) {
  std::atomic<int> inside{0}, turns{0}, most{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int k = 0; k < 25; ++k) {
        const auto lock = try_lock(file_);
        if (lock) {
          most = std::max(most.load(), ++inside);
          ++turns;
          std::this_thread::yield();
          --inside;
        }
      }
    });
  }
  for (auto& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(most, 1);
  EXPECT_GT(turns, 0);
}

TEST_F(FileLocks, WhereNothingCanBeWrittenItIsSaid) {
  EXPECT_THROW(try_lock(folder_ / "missing" / "a.lock"), OutputError);
}

} // namespace
} // namespace meninas
