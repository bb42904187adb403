// Locks that processes share by way of a folder.
//
// A lock is a file whose descriptor is locked with flock(2), and the file says who holds it.
// The kernel lets go of it when its process ends, however that happens, so a lock file that
// is left behind by a killed process is known to be stale and is taken over at once.
// On network file systems this holds where they carry flock to the server (NFS since Linux 2.6.12,
// Lustre and BeeGFS when mounted so).
#pragma once

#include <filesystem>
#include <optional>

namespace meninas {

class FileLock {
public:
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  /// Removes the file and lets go of the lock.
  ~FileLock();

private:
  friend std::optional<FileLock> try_lock(const std::filesystem::path& file);
  FileLock(std::filesystem::path file, int descriptor);

  std::filesystem::path file_;
  int descriptor_;
};

/// Nothing while anybody else, in this process or another, holds it.
/// Throws OutputError where the folder is not writable or knows no locks.
std::optional<FileLock> try_lock(const std::filesystem::path& file);

/// Has the names in a folder be those that are there now. A client of NFS answers from memory for up to a minute which
/// names there are, and asks the server when the folder is opened (close-to-open consistency). Elsewhere it does
/// nothing.
void look_anew(const std::filesystem::path& folder);

/// Waits for the others.
FileLock wait_for_lock(const std::filesystem::path& file);

} // namespace meninas
