// The files of a batch beside its pictures, in DIR/.meninas: the pictures done, the processes at work, and
// the solutions of pass one.
//
//   done/ID.json        one record for each picture that was tried (ID: a hash of its name)
//   locks/ID.lock       held while a picture is being made
//   solutions/KEY.glb   pass one, as `meninas solve` writes it; KEY.lock while it is being solved
//   processes/*.lock    held by every process at work here
//   session             which run of the batch this is
//
// A run that does not resume begins a session,
// and only records of its own session count as done for it, unless others are at work here:
// then it joins theirs. A run that resumes takes every record
// whose key is the picture's and whose files are what was written.
#pragma once

#include "runs/batch/batch_plan.h"
#include "runs/batch/file_lock.h"

#include <string>

namespace meninas {

/// The outcome of a picture.
struct PictureRecord {
  std::string name, key, session;
  std::string error; ///< empty when it was made
  int exit_code = 0;
  std::vector<std::uint64_t> file_hashes; ///< of its outputs
  int width = 0, height = 0;
  double seconds = 0.0;
  std::uint64_t rays = 0;
  std::string thumbnail; ///< a data: address
};

enum class Resume { no, yes };

class BatchFolder {
public:
  /// Throws OutputError where nothing can be written.
  BatchFolder(std::filesystem::path folder, std::filesystem::path cache, Resume resume);

  /// The record of a picture that is done, whoever has done it.
  std::optional<PictureRecord> done(const BatchPicture& picture) const;
  /// The last record with the picture's key, of any session, also of a failure;
  /// its files may have gone since.
  std::optional<PictureRecord> record(const BatchPicture& picture) const;
  void keep(const BatchPicture& picture, PictureRecord record) const;

  std::optional<FileLock> try_lock_picture(const BatchPicture& picture) const;
  std::optional<FileLock> try_lock_solution(const std::string& key) const;
  std::filesystem::path solution(const std::string& key) const;
  /// For what several processes read and write, such as the summary.
  FileLock lock_reports() const;

  const std::filesystem::path& path() const { return folder_; }

private:
  std::filesystem::path folder_, state_, cache_;
  Resume resume_;
  std::string session_;
  std::optional<FileLock> at_work_;
};

/// Whether a folder says that the picture is done already, without touching it:
/// --dry-run shows such pictures, and --resume would leave them as they are.
bool is_done(const std::filesystem::path& folder, const BatchPicture& picture);

/// The hashes of the files as they are now. Throws InputError where one cannot be read.
std::vector<std::uint64_t> hashes_of(const std::filesystem::path& folder,
                                     const std::vector<std::filesystem::path>& files);

} // namespace meninas
