#include "runs/batch/file_lock.h"

#include "scenes/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace meninas {

namespace fs = std::filesystem;

[[noreturn]] static void fail(const fs::path& file) {
  throw OutputError(file.string(), "", "cannot lock: " + std::generic_category().message(errno));
}

/// For people who wonder: locking does not depend on it, so a full disk does not matter here.
static void say_owner(int descriptor) {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  const std::string owner = fmt::format("{} {}\n", host.data(), ::getpid());
  // Not emptied first:
  // file systems that guard against lost contents (ext4) would wait for the disk when it is closed.
  const auto written = ::pwrite(descriptor, owner.data(), owner.size(), 0);
  [[maybe_unused]] const int cut = written > 0 ? ::ftruncate(descriptor, written) : 0;
}

/// Whoever had it before may have removed the file between our opening and locking it.
static bool is_still_there(const fs::path& file, int descriptor) {
  look_anew(file.parent_path());
  struct stat named {
  }, held{};
  return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 &&
         named.st_ino == held.st_ino && named.st_dev == held.st_dev;
}

FileLock::FileLock(fs::path file, int descriptor)
    : file_(std::move(file)), descriptor_(descriptor) {}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) {
    ::unlink(file_.c_str());
    ::close(descriptor_);
  }
}

std::optional<FileLock> try_lock(const fs::path& file) {
  while (true) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      fail(file);
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      ::close(descriptor);
      if (reason == EWOULDBLOCK) {
        return std::nullopt;
      }
      errno = reason;
      fail(file);
    }
    if (is_still_there(file, descriptor)) {
      say_owner(descriptor);
      return FileLock(file, descriptor);
    }
    ::close(descriptor);
  }
}

void look_anew(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0)
    ::close(descriptor);
}

FileLock wait_for_lock(const fs::path& file) {
  while (true) {
    if (auto lock = try_lock(file)) {
      return std::move(*lock);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

} // namespace meninas
