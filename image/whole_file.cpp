#include "image/whole_file.h"

#include "scenes/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace meninas {

namespace fs = std::filesystem;

[[noreturn]] static void fail(const fs::path& file, const std::string& what) {
  throw OutputError(file.string(), "", "cannot write: " + what);
}

static std::string reason_of(int error) {
  switch (error) {
  case ENOSPC:
    return "the disk is full";
  case EDQUOT:
    return "the disk quota is used up";
  case EFBIG:
    return "the file is larger than this system or its limits allow";
  case EROFS:
    return "the file system is read-only";
  case EACCES:
  case EPERM:
    return "no permission";
  default:
    return std::generic_category().message(error);
  }
}

static fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// What is wrong with the place, in the order in which a user would look.
static void check_place(const fs::path& file) {
  struct stat status {};
  const auto folder = folder_of(file);
  if (::stat(folder.c_str(), &status) != 0) {
    const int error = errno;
    if (error == ENOENT || error == ENOTDIR)
      fail(file, fmt::format("no such folder '{}'", folder.string()));
    fail(file, reason_of(error));
  }
  if (!S_ISDIR(status.st_mode))
    fail(file, fmt::format("'{}' is not a folder", folder.string()));
  if (!file.has_filename())
    fail(file, "it names a folder");
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT)
      return;
    fail(file, reason_of(errno));
  }
  if (S_ISDIR(status.st_mode))
    fail(file, "it is a folder");
  if (!S_ISREG(status.st_mode))
    fail(file, "it is not an ordinary file");
  if (::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0)
    fail(file, reason_of(errno));
}

namespace {

/// A new file beside its target; removed again unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(fs::path target) : target_(std::move(target)) {
    // The name does not contain the target's, which may be as long as the system allows.
    static std::atomic<unsigned> count{0};
    do {
      path_ = folder_of(target_) / fmt::format(".meninas-{}-{}.tmp", ::getpid(), count++);
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0)
      fail(target_, reason_of(errno));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
    if (!renamed_)
      ::unlink(path_.c_str());
  }

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const auto written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR)
        continue;
      if (written < 0)
        fail(target_, reason_of(errno));
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void rename() {
    // Some file systems report a full disk only now.
    const int descriptor = std::exchange(descriptor_, -1);
    if (::close(descriptor) != 0 && errno != EINTR)
      fail(target_, reason_of(errno));
    if (std::rename(path_.c_str(), target_.c_str()) != 0)
      fail(target_, reason_of(errno));
    renamed_ = true;
  }

private:
  fs::path target_;
  fs::path path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

} // namespace

static fs::path followed(const fs::path& file) {
  std::error_code error;
  const auto target = fs::is_symlink(file, error) ? fs::canonical(file, error) : file;
  return error ? file : target;
}

void write_whole_file(const fs::path& file, std::span<const std::byte> bytes) {
  check_place(file);
  TemporaryFile temporary(followed(file));
  temporary.write(bytes);
  temporary.rename();
}

void check_writable_file(const fs::path& file) {
  check_place(file);
  TemporaryFile temporary(followed(file));
}

} // namespace meninas
