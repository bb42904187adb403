// A file appears whole or not at all, and what is wrong with its place is said in one line.
#include "image/image_file.h"
#include "image/whole_file.h"
#include "scenes/errors.h"
#include "tests/image/picture_files.h"

#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;

/// Acts as an ordinary user for a while: nothing is forbidden to root.
class OrdinaryUser {
public:
  OrdinaryUser() : was_root_(::geteuid() == 0) {
    constexpr uid_t nobody = 65534;
    if (was_root_ && ::seteuid(nobody) != 0)
      throw std::runtime_error("cannot become an ordinary user");
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;
  ~OrdinaryUser() {
    if (was_root_ && ::seteuid(0) != 0)
      std::abort();
  }

private:
  bool was_root_;
};

/// No file may grow beyond some bytes: a write fails in its middle, as on a full disk.
class SmallFiles {
public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;
  ~SmallFiles() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

private:
  void (*handler_)(int);
  rlimit before_{};
};

class WholeFile : public PictureFiles {
protected:
  static std::string write_error(const fs::path& file) {
    const auto line = error_line<OutputError>([&] { write_exr(file, Image(1, 1)); });
    EXPECT_EQ(error_line<OutputError>([&] { check_writable_image(file); }), line)
        << "the check says what writing would";
    return line;
  }
};

const std::vector<std::byte> old_content(10, std::byte{'o'});
const std::vector<std::byte> new_content(100000, std::byte{'n'});

TEST_F(WholeFile, ReplacesWhatWasThere) {
  write_bytes(folder / "a", old_content);
  write_whole_file(folder / "a", new_content);
  EXPECT_EQ(bytes_of(folder / "a"), new_content);
  EXPECT_EQ(entries(), 1U);
}

TEST_F(WholeFile, HasThePermissionsOfANewFile) {
  const auto mask = ::umask(0027);
  write_exr(folder / "a.exr", Image(1, 1));
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.exr").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST_F(WholeFile, FollowsALink) {
  fs::create_directory(folder / "elsewhere");
  write_bytes(folder / "elsewhere" / "a", old_content);
  fs::create_symlink("elsewhere/a", folder / "link");
  write_whole_file(folder / "link", new_content);
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(bytes_of(folder / "elsewhere" / "a"), new_content);
}

TEST_F(WholeFile, WritesIntoTheCurrentFolder) {
  const auto before = fs::current_path();
  fs::current_path(folder);
  write_whole_file("a", new_content);
  fs::current_path(before);
  EXPECT_EQ(bytes_of(folder / "a"), new_content);
}

TEST_F(WholeFile, AFailedWriteLeavesTheOldFileAlone) {
  write_bytes(folder / "a", old_content);
  std::string line;
  {
    const SmallFiles limited(4096);
    line = error_line<OutputError>([&] { write_whole_file(folder / "a", new_content); });
  }
  EXPECT_THAT(line,
              EndsWith("a: cannot write: the file is larger than this system or its limits allow"));
  EXPECT_EQ(bytes_of(folder / "a"), old_content);
  EXPECT_EQ(entries(), 1U) << "neither a part nor a temporary file is left";
}

TEST_F(WholeFile, AFailedPictureLeavesNothing) {
  const auto picture = random_picture(100, 100);
  write_png(folder / "a.png", picture, 0.0);
  fs::remove(folder / "a.png");
  {
    const SmallFiles limited(4096);
    error_line<OutputError>([&] { write_exr(folder / "a.exr", picture); });
    error_line<OutputError>([&] { write_png(folder / "a.png", picture, 0.0); });
  }
  EXPECT_EQ(entries(), 0U);
}

TEST_F(WholeFile, CheckingLeavesNothing) {
  check_writable_image(folder / "a.exr");
  EXPECT_EQ(entries(), 0U);
  write_bytes(folder / "a.png", old_content);
  check_writable_image(folder / "a.png");
  EXPECT_EQ(bytes_of(folder / "a.png"), old_content);
  EXPECT_EQ(entries(), 1U);
}

TEST_F(WholeFile, NoSuchFolder) {
  const auto file = folder / "none" / "a.exr";
  EXPECT_EQ(write_error(file),
            file.string() + ": cannot write: no such folder '" + (folder / "none").string() + "'");
  write_bytes(folder / "file", old_content);
  EXPECT_THAT(write_error(folder / "file" / "a.exr"), EndsWith("file' is not a folder"));
}

TEST_F(WholeFile, NotAFile) {
  fs::create_directory(folder / "a.exr");
  EXPECT_THAT(write_error(folder / "a.exr"), EndsWith("a.exr: cannot write: it is a folder"));
  ASSERT_EQ(::mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
  EXPECT_THAT(write_error(folder / "pipe.exr"),
              EndsWith("cannot write: it is not an ordinary file"));
  EXPECT_THAT(write_error(folder / (std::string(300, 'n') + ".exr")),
              EndsWith("File name too long"));
}

TEST_F(WholeFile, NoPermission) {
  write_bytes(folder / "a.exr", old_content);
  ASSERT_EQ(::chmod((folder / "a.exr").c_str(), 0444), 0);
  fs::create_directory(folder / "closed");
  ASSERT_EQ(::chmod((folder / "closed").c_str(), 0555), 0);
  ASSERT_EQ(::chmod(folder.c_str(), 0777), 0);
  std::string protected_file, closed_folder;
  write_exr(folder / "b.exr", Image(1, 1));
  {
    const OrdinaryUser user;
    protected_file = write_error(folder / "a.exr");
    closed_folder = write_error(folder / "closed" / "a.exr");
  }
  EXPECT_EQ(protected_file, (folder / "a.exr").string() + ": cannot write: no permission");
  EXPECT_EQ(closed_folder,
            (folder / "closed" / "a.exr").string() + ": cannot write: no permission");
  EXPECT_EQ(bytes_of(folder / "a.exr"), old_content);
  EXPECT_TRUE(fs::is_empty(folder / "closed"));
}

TEST_F(WholeFile, UnknownExtension) {
  const auto line = [&](const char* name) {
    return error_line<OutputError>([&] { check_writable_image(folder / name); });
  };
  EXPECT_EQ(line("a.gif"),
            (folder / "a.gif").string() + ": cannot write pictures as '.gif', only .exr, .png and .hdr");
  EXPECT_THAT(line("a"), EndsWith("a picture's name must end in .exr, .png or .hdr"));
  EXPECT_THAT(line(".exr"), EndsWith("a picture's name must end in .exr, .png or .hdr"));
  EXPECT_THAT(error_line<OutputError>([&] { write_exr(folder / "a.png", Image(1, 1)); }),
              EndsWith("an EXR's name must end in .exr"));
  EXPECT_THAT(error_line<OutputError>([&] { write_png(folder / "a.exr", Image(1, 1), 0.0); }),
              EndsWith("a PNG's name must end in .png"));
  EXPECT_EQ(picture_format("a.PnG"), PictureFormat::png);
  EXPECT_EQ(picture_format("a.b.EXR"), PictureFormat::exr);
  EXPECT_EQ(entries(), 0U);
}

/// In a process of its own, whose disk of 16 KiB nobody else sees.
/// Exit code: 0 as expected, 1 not, 2 no such disk here.
[[noreturn]] void fill_small_disk(const fs::path& folder) {
  if (::unshare(CLONE_NEWNS) != 0 ||
      ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("none", folder.c_str(), "tmpfs", 0, "size=16k") != 0)
    ::_exit(2);
  std::string line;
  try {
    write_whole_file(folder / "a", new_content);
  } catch (const OutputError& error) {
    line = error.what();
  }
  ::_exit(line == (folder / "a").string() + ": cannot write: the disk is full" &&
                  fs::is_empty(folder)
              ? 0
              : 1);
}

TEST_F(WholeFile, DiskFull) {
  const auto child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    fill_small_disk(folder);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 2)
    GTEST_SKIP() << "needs the right to mount a small disk";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

} // namespace
} // namespace meninas::test
