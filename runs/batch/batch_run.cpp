#include "runs/batch/batch_run.h"

#include "image/image_file.h"
#include "runs/batch/interruption.h"
#include "runs/steering/memory.h"
#include "runs/resources.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <set>

namespace meninas {
namespace {

namespace fs = std::filesystem;

/// How long running tasks may go on after a signal, and files that are being written after that.
constexpr auto grace = std::chrono::milliseconds(1000),
               last_moment = std::chrono::milliseconds(700);

fs::path cache_of(const BatchRequest& request) {
  return request.cache.value_or(request.folder / ".meninas" / "solutions");
}

/// This process' share.
std::vector<BatchPicture> own_pictures(const BatchRequest& request,
                                       const std::vector<BatchPicture>& all) {
  return pictures_of(pictures_of(all, request.only), request.shard);
}

/// A batch under way, with everything its end needs.
struct Batch {
  Batch(const BatchRequest& asked, std::vector<BatchPicture> pictures, int thread_count,
        const BatchEvents& told)
      : request(asked), events(told), all(std::move(pictures)), own(own_pictures(asked, all)),
        folder(asked.folder, cache_of(asked), asked.resume), threads(thread_count),
        work(folder, own, thread_count, asked.memory_limit.value_or(available_memory_bytes()),
             {.run = told.run, .finished = told.finished, .progress = [this](const auto& progress) {
                if (events.progress) {
                  events.progress(progress, seconds());
                }
              }}) {}
  double seconds() const { return Stopwatch(since_begin).lap(); }

  const BatchRequest& request;
  const BatchEvents& events;
  std::vector<BatchPicture> all, own;
  BatchFolder folder;
  Stopwatch since_begin;
  int threads;
  BatchWork work;
  std::atomic<int> signal = 0;
};

/// Own results, and for the pictures of other shards what their processes have left behind.
BatchReport report_of(Batch& batch) {
  BatchReport report{.jobs_file = batch.request.jobs_file,
                     .folder = batch.request.folder,
                     .pictures = batch.all,
                     .results = {},
                     .solves = batch.work.solves(),
                     .seconds = batch.seconds(),
                     .rays = batch.work.rays(),
                     .peak_memory_bytes = peak_memory_bytes(),
                     .threads = batch.threads};
  std::map<std::string, PictureResult> own;
  const auto results = batch.work.results();
  for (std::size_t k = 0; k < results.size(); ++k) {
    own.emplace(batch.own[k].name, results[k]);
  }
  for (const BatchPicture& picture : batch.all) {
    PictureResult result;
    if (const auto mine = own.find(picture.name); mine != own.end()) {
      result = mine->second;
    } else if (auto record = batch.folder.record(picture)) {
      const bool failed = !record->error.empty();
      result = {failed ? PictureStatus::failed : PictureStatus::found, std::move(*record)};
    }
    report.results.push_back(std::move(result));
  }
  return report;
}

BatchReport write_reports(Batch& batch) {
  const FileLock lock = batch.folder.lock_reports();
  BatchReport report = report_of(batch);
  write_text_file(batch.folder.path() / "summary.json", summary_json(report));
  write_text_file(batch.folder.path() / "index.html", contact_sheet(report));
  if (batch.request.junit) {
    write_text_file(*batch.request.junit, batch_junit(report));
  }
  return report;
}

std::string stop_line(const Batch& batch) {
  const BatchCounts counts = count(batch.work.results());
  return fmt::format(
      "{}: stopped by {}: {} of {} pictures are done; the same command with --resume "
      "goes on from here",
      batch.request.jobs_file.string(),
      batch.signal == SIGINT ? "Ctrl-C" : ::strsignal(batch.signal), counts.made + counts.found,
      batch.own.size());
}

/// Every file that is there is whole at any time, so what is still being computed may just be left.
void stop(Batch& batch, int signal) {
  const bool impatient = batch.signal.exchange(signal) != 0;
  batch.work.stop();
  if (!impatient && batch.work.wait_for_end(grace)) {
    return;
  }
  const auto lock = batch.work.stop_writing(last_moment);
  try {
    write_reports(batch);
  } catch (const UserError&) {
    // The reason why nothing can be written has been said of a picture.
  }
  if (batch.events.last_words) {
    batch.events.last_words(stop_line(batch));
  }
  ::_exit(128 + signal);
}

/// The error a batch ends with, if it does.
void conclude(const Batch& batch) {
  if (batch.signal != 0) {
    const auto code = static_cast<ExitCode>(128 + batch.signal);
    throw UserError(code, "", "", stop_line(batch));
  }
  std::vector<std::string> failed;
  int code = 0;
  const auto own = batch.work.results();
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (own[k].status == PictureStatus::failed) {
      failed.push_back(batch.own[k].name);
      code = code == 0 ? own[k].record.exit_code : code;
    }
  }
  if (!failed.empty()) {
    const std::size_t shown = 5, more = failed.size() > shown ? failed.size() - shown : 0;
    const std::string names =
        fmt::format("{}", fmt::join(std::span(failed).first(failed.size() - more), ", "));
    throw UserError(static_cast<ExitCode>(code), batch.request.jobs_file.string(), "",
                    fmt::format("{} of {} pictures failed: {}{}", failed.size(), own.size(), names,
                                more > 0 ? fmt::format(" and {} more", more) : ""));
  }
}

/// What is loaded with the first texture counts among what was there before the work.
void load_picture_reader() {
  decode_image(encode_png(Image(1, 1), 0.0), Encoding::srgb, "one pixel");
}

} // namespace

BatchReport batch_run(const BatchRequest& request, std::vector<BatchPicture> pictures,
                      const BatchEvents& events) {
  const ThreadLimit limit(request.threads);
  const bool textured = std::ranges::any_of(pictures, [](const BatchPicture& picture) {
    return picture.facts && picture.facts->sizes.texture_bytes > 0;
  });
  if (textured) {
    load_picture_reader();
  }
  Batch batch(request, std::move(pictures), limit.threads(), events);
  {
    const Interruption interruption([&](int signal) { stop(batch, signal); });
    batch.work.run();
  }
  BatchReport report;
  try {
    report = write_reports(batch);
  } catch (const UserError& error) {
    // What has failed before says more.
    warn(events.run, error.what());
    conclude(batch);
    throw;
  }
  conclude(batch);
  return report;
}

std::string batch_outlook(const BatchRequest& request, const std::vector<BatchPicture>& pictures) {
  std::string text;
  std::size_t done = 0, failed = 0, rendered = 0;
  std::set<std::string> known, to_solve;
  const auto own = own_pictures(request, pictures);
  for (const BatchPicture& picture : own) {
    if (picture.problem) {
      ++failed;
      text += fmt::format("cannot  {} {}: {}\n", picture.number, picture.name, picture.problem->what);
      continue;
    }
    if (is_done(request.folder, picture)) {
      ++done;
      text += fmt::format("done    {} {}\n", picture.number, picture.name);
      continue;
    }
    const std::string& key = picture.solution_key;
    if (!key.empty() && known.insert(key).second &&
        !fs::exists(cache_of(request) / (key + ".glb"))) {
      to_solve.insert(key);
      text += fmt::format("solve   {}\n", picture.scene.string());
    }
    ++rendered;
    text += fmt::format("render  {} {}\n", picture.number, picture.name);
  }
  return text + fmt::format("{} pictures: {} to render, {} done already, {} that cannot be; {} to "
                            "solve\n",
                            own.size(), rendered, done, failed, to_solve.size());
}

} // namespace meninas
