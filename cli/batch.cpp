#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/settings.h"
#include "cli/values.h"
#include "runs/batch/batch_file.h"
#include "runs/batch/batch_run.h"
#include "runs/report/progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <set>

namespace meninas {
namespace {

enum class BatchTask { run, outlook };

struct BatchOptions {
  BatchRequest request;
  BatchTask task = BatchTask::run;
  Verbosity verbosity = Verbosity::normal;
};

void print(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
}

/// 3; 10-19; 1,4-6
std::vector<NumberRange> parse_numbers(const std::string& option, const std::string& text) {
  constexpr std::int64_t most = 1'000'000'000;
  std::vector<NumberRange> ranges;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t dash = part.find('-', 1);
    const auto first = parse_integer(option, part.substr(0, dash), 0, most);
    const auto last = dash == std::string::npos
                          ? first
                          : parse_integer(option, part.substr(dash + 1), first, most);
    ranges.push_back({static_cast<std::size_t>(first), static_cast<std::size_t>(last)});
    begin = end + 1;
  }
  return ranges;
}

std::string status_line(const BatchProgress& progress, double seconds) {
  std::string line =
      fmt::format("{} of {} done, {} running", progress.done, progress.pictures, progress.running);
  if (progress.solving > 0) {
    line += fmt::format(", {} solving", progress.solving);
  }
  if (progress.failed > 0) {
    line += fmt::format(", {} failed", progress.failed);
  }
  if (progress.seconds_left) {
    line += fmt::format(", {} left", readable_duration(*progress.seconds_left));
  }
  return line + fmt::format(", {:.1f} million rays/s", 1e-6 * double(progress.rays) / seconds);
}

void say_result(const RunEvents& events, const BatchPicture& picture, const PictureResult& result) {
  if (result.status == PictureStatus::failed) {
    warn(events, fmt::format("{} failed: {}", picture.name, result.record.error));
  } else if (result.status == PictureStatus::made) {
    note(events, fmt::format("{} ({:.2f} s)", picture.name, result.record.seconds));
  }
}

BatchEvents events_of(Console& console) {
  BatchEvents events;
  events.run = console.events();
  events.finished = [told = events.run](const BatchPicture& picture, const PictureResult& result) {
    say_result(told, picture, result);
  };
  events.progress = [&console](const BatchProgress& progress, double seconds) {
    console.show_status(status_line(progress, seconds));
  };
  events.last_words = [&console](const std::string& line) { console.say_error(line); };
  return events;
}

void say_rounding(const RunEvents& events, const std::vector<BatchJob>& jobs) {
  std::set<std::string> said;
  for (const BatchJob& job : jobs) {
    for (const JobMode& mode : job.modes) {
      for (const std::string& text : rounding_notes(mode.request.settings)) {
        if (said.insert(text).second) {
          note(events, text);
        }
      }
    }
  }
}

void run(BatchOptions& options) {
  const BatchRequest& request = options.request;
  const auto jobs = read_batch(request.jobs_file, parse_render_settings);
  Console console(options.verbosity);
  auto pictures = plan_batch(request.jobs_file, jobs, request.gltf);
  if (options.task == BatchTask::outlook) {
    print(batch_outlook(request, pictures));
    return;
  }
  const BatchEvents events = events_of(console);
  say_rounding(events.run, jobs);
  const BatchReport report = batch_run(request, std::move(pictures), events);
  const BatchCounts counts = count(report.results);
  note(events.run,
       fmt::format("{} made, {} found done, in {}; see {}", counts.made, counts.found,
                   readable_duration(report.seconds), (request.folder / "index.html").string()));
}

void add_options(Options& command, BatchOptions& options) {
  BatchRequest& request = options.request;
  command
      .add("-o,--output", "DIR", "folder of the pictures, made if it is not there",
           [&](const std::string& text) { request.folder = text; })
      .required();
  command.add_flag("--resume",
                   "keep pictures that an earlier run made from the same scene and settings",
                   [&] { request.resume = Resume::yes; });
  command.add_flag("--dry-run", "list what would be solved and rendered, and end",
                   [&] { options.task = BatchTask::outlook; });
  command.add("--only", "NUMBERS",
              "make only these pictures, by the numbers of --dry-run and the page, such as "
              "10-19 or 1,4-6 [all]",
              [&](const std::string& text) { request.only = parse_numbers("--only", text); });
  command.add("--shard", "K/N", "make only part K of N, such as 1/4",
              [&](const std::string& text) {
                const PicturePart part = parse_part("--shard", text);
                request.shard = {part.number, part.count};
              });
  command
      .add("--memory-limit", "SIZE",
           "memory that the process may need, such as 4G; fewer pictures run at a time to stay below "
           "[all the machine has]",
           [&](const std::string& text) { request.memory_limit = parse_bytes("--memory-limit", text); })
      .group(run_group);
  add_allow_external(command, request.gltf);
  command.add("--cache", "DIR", "folder for solutions [.meninas/solutions in the output folder]",
              [&](const std::string& text) { request.cache = text; });
  add_file(command, "--junit", request.junit, "write JUnit XML");
  command.add_flag("--schema", "print the JSON Schema of jobs files, and end", [] {
    print(batch_schema(render_settings_help()));
    throw Answered{};
  });
  command
      .add("--threads", "N", "number of threads [all cores]",
           [&](const std::string& text) {
             request.threads = static_cast<int>(parse_integer("--threads", text, 1, 1024));
           })
      .group(run_group);
  command
      .add_flag("--quiet", "print warnings and errors only",
                [&] { options.verbosity = Verbosity::quiet; })
      .group(run_group);
}

} // namespace

Command add_batch_command(Options& program) {
  Options& command = program.add_command(
      "batch", "Render many scenes, cameras and settings, resumable");
  const auto options = std::make_shared<BatchOptions>();
  command
      .add("JOBS", "", "JSON: scenes, cameras, settings, outputs",
           [=](const std::string& text) { options->request.jobs_file = text; })
      .required();
  add_options(command, *options);
  return {&command, [=] { run(*options); }};
}

} // namespace meninas
