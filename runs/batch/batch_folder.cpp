#include "runs/batch/batch_folder.h"

#include "image/whole_file.h"
#include "runs/json/json_place.h"
#include "runs/outputs.h"
#include "runs/report/stats.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fstream>

namespace meninas {
namespace {

namespace fs = std::filesystem;

fs::path state_of(const fs::path& folder) { return folder / ".meninas"; }

std::string id_of(const BatchPicture& picture) {
  ContentHash hash;
  hash.add(picture.name);
  return hex_digits(hash.value());
}

fs::path record_file(const fs::path& state, const BatchPicture& picture) {
  return state / "done" / (id_of(picture) + ".json");
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Json json_of(const PictureRecord& record) {
  Json hashes = Json::array();
  for (const std::uint64_t hash : record.file_hashes) {
    hashes.push_back(hex_digits(hash));
  }
  return {{"name", record.name},           {"key", record.key},
          {"session", record.session},     {"error", record.error},
          {"exit_code", record.exit_code}, {"files", hashes},
          {"width", record.width},         {"height", record.height},
          {"seconds", record.seconds},     {"rays", record.rays},
          {"thumbnail", record.thumbnail}};
}

PictureRecord record_of(const Json& json) {
  PictureRecord record{.name = json.at("name"),
                       .key = json.at("key"),
                       .session = json.at("session"),
                       .error = json.at("error"),
                       .exit_code = json.at("exit_code"),
                       .file_hashes = {},
                       .width = json.at("width"),
                       .height = json.at("height"),
                       .seconds = json.at("seconds"),
                       .rays = json.at("rays"),
                       .thumbnail = json.at("thumbnail")};
  for (const Json& hash : json.at("files")) {
    record.file_hashes.push_back(std::stoull(hash.get<std::string>(), nullptr, 16));
  }
  return record;
}

/// What somebody else has spoilt counts as nothing.
std::optional<PictureRecord> read_record(const fs::path& state, const BatchPicture& picture) {
  try {
    const std::string text = text_of(record_file(state, picture));
    PictureRecord record = record_of(Json::parse(text));
    return record.key == picture.key && record.name == picture.name ? std::optional(record)
                                                                    : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

bool has_its_files(const fs::path& folder, const PictureRecord& record,
                   const BatchPicture& picture) {
  if (!record.error.empty()) {
    return false;
  }
  try {
    return hashes_of(folder, picture.outputs) == record.file_hashes;
  } catch (const InputError&) {
    return false;
  }
}

/// The process that made a temporary file is part of its name (image/whole_file.cpp).
bool is_left_behind(const fs::path& file) {
  const std::string name = file.filename().string();
  int process = 0;
  if (std::sscanf(name.c_str(), ".meninas-%d-", &process) != 1 || !name.ends_with(".tmp")) {
    return false;
  }
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

/// Files that killed processes had not finished. Nobody else is at work when this is called.
void sweep(const fs::path& folder) {
  std::error_code error;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, skip, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_left_behind(entry->path())) {
      std::error_code ignored;
      fs::remove(entry->path(), ignored);
    }
  }
}

/// Whether a process holds one of these locks; those that nobody holds are removed.
bool anybody_at_work(const fs::path& processes) {
  bool somebody = false;
  for (const auto& entry : fs::directory_iterator(processes)) {
    somebody |= !try_lock(entry.path()).has_value();
  }
  return somebody;
}

std::string new_session() {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return fmt::format("{:x}-{:x}", now, ::getpid());
}

/// A process may run several batches, and machines may share the folder.
std::string own_name() {
  static std::atomic<unsigned> count{0};
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{}-{}-{}.lock", host.data(), ::getpid(), count++);
}

} // namespace

BatchFolder::BatchFolder(fs::path folder, fs::path cache, Resume resume)
    : folder_(std::move(folder)), state_(state_of(folder_)), cache_(std::move(cache)),
      resume_(resume) {
  for (const char* part : {"done", "locks", "processes"}) {
    make_folder(state_ / part);
  }
  make_folder(cache_);
  check_writable_file(folder_ / "summary.json");
  const FileLock entrance = wait_for_lock(state_ / "entrance.lock");
  const fs::path session_file = state_ / "session";
  if (anybody_at_work(state_ / "processes")) {
    session_ = text_of(session_file);
  } else {
    sweep(folder_);
    session_ = new_session();
    write_text_file(session_file, session_);
  }
  at_work_.emplace(wait_for_lock(state_ / "processes" / own_name()));
}

std::optional<PictureRecord> BatchFolder::record(const BatchPicture& picture) const {
  return read_record(state_, picture);
}

std::optional<PictureRecord> BatchFolder::done(const BatchPicture& picture) const {
  // Another machine may have written what was missing when this one looked last.
  look_anew(state_ / "done");
  for (const fs::path& output : picture.outputs)
    look_anew((folder_ / output).parent_path());
  auto found = record(picture);
  const bool counts = found && (resume_ == Resume::yes || found->session == session_);
  return counts && has_its_files(folder_, *found, picture) ? found : std::nullopt;
}

void BatchFolder::keep(const BatchPicture& picture, PictureRecord record) const {
  record.name = picture.name;
  record.key = picture.key;
  record.session = session_;
  const auto text = json_of(record).dump(1, ' ', false, Json::error_handler_t::replace);
  write_text_file(record_file(state_, picture), text);
}

std::optional<FileLock> BatchFolder::try_lock_picture(const BatchPicture& picture) const {
  return try_lock(state_ / "locks" / (id_of(picture) + ".lock"));
}

std::optional<FileLock> BatchFolder::try_lock_solution(const std::string& key) const {
  return try_lock(cache_ / (key + ".lock")); // which has looked anew what is in the folder
}

fs::path BatchFolder::solution(const std::string& key) const { return cache_ / (key + ".glb"); }

FileLock BatchFolder::lock_reports() const {
  FileLock lock = wait_for_lock(state_ / "reports.lock");
  look_anew(state_ / "done");
  return lock;
}

bool is_done(const fs::path& folder, const BatchPicture& picture) {
  const auto found = read_record(state_of(folder), picture);
  return found && has_its_files(folder, *found, picture);
}

std::vector<std::uint64_t> hashes_of(const fs::path& folder, const std::vector<fs::path>& files) {
  std::vector<std::uint64_t> hashes;
  for (const fs::path& file : files) {
    hashes.push_back(hash_of_file(folder / file));
  }
  return hashes;
}

} // namespace meninas
