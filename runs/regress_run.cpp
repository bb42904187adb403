#include "runs/regress_run.h"

#include "image/metrics/changes.h"
#include "image/metrics/heat_map.h"
#include "image/whole_file.h"
#include "image/z_test.h"
#include "runs/outputs.h"
#include "runs/json/reference_manifest.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace meninas {
namespace {

namespace fs = std::filesystem;

/// Where pictures are rendered before it is known whether anybody wants them.
class WorkFolder {
public:
  WorkFolder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "meninas-regress-XXXXXX").string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
      throw OutputError(pattern, "", "cannot make a temporary folder");
    }
    path_ = pattern;
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  fs::path picture() const { return path_ / "picture.exr"; }

private:
  fs::path path_;
};

bool same_rendering(const CaseRendering& a, const CaseRendering& b) {
  return a.request.scene == b.request.scene && a.settings == b.settings;
}

void copy_into(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) {
    throw OutputError(to.string(), "", "cannot write: " + error.message());
  }
}

void render_into(const fs::path& file, const CaseRendering& rendering, int threads,
                 const RunEvents& events) {
  RenderRequest request = rendering.request;
  request.pictures = {file};
  request.settings.threads = threads;
  // A case has one line, which says what came of it.
  RunEvents without_notes = events;
  without_notes.note = nullptr;
  render_run(request, without_notes);
}

/// What a comparison needs and finds.
struct Comparison {
  ComparedPicture picture, reference;
  MetricSettings settings;
  PictureDifference difference;
  std::optional<double> z;
  std::string unit; ///< of differences
};

Comparison compare(const RegressCase& regress_case, const fs::path& picture_file) {
  if (!fs::exists(regress_case.reference)) {
    throw InputError(regress_case.reference.string(), "",
                     "no such reference: 'meninas regress --update' makes it");
  }
  Comparison result;
  result.picture = read_compared(picture_file, std::nullopt);
  result.reference = read_compared(regress_case.reference, std::nullopt);
  check_same_size(result.reference.image, regress_case.reference, result.picture.image,
                  "the picture");
  result.unit = unit_of_differences(result.picture, result.reference);
  result.settings = metric_settings(result.reference, std::nullopt);
  result.settings.relmse_epsilon = regress_case.relmse_epsilon;
  result.difference =
      compare_pictures(result.picture.image, result.reference.image, result.settings);
  if (regress_case.max_z) {
    const ComparedPicture variance = read_compared(regress_case.reference, "variance");
    result.z = z_figure(result.picture.image, result.reference.image, variance.image);
  }
  return result;
}

std::vector<std::string> broken_limits_of(const RegressCase& regress_case,
                                          const Comparison& found) {
  auto broken = broken_limits(found.difference, regress_case.limits, found.unit);
  if (found.z && !(*found.z <= *regress_case.max_z)) {
    broken.push_back(fmt::format("z {:.4g} exceeds {:.4g}", *found.z, *regress_case.max_z));
  }
  return broken;
}

/// "relmse 1.2e-07 (limit 1e-06), ..."
std::string figures(const RegressCase& regress_case, const Comparison& found) {
  std::vector<std::string> parts;
  const auto add = [&](const char* name, double value, double limit, const std::string& unit) {
    parts.push_back(fmt::format("{} {:.3g} (limit {:.3g}{})", name, value, limit, unit));
  };
  for (const auto& [metric, limit] : regress_case.limits) {
    add(name_of(metric), value_of(found.difference, metric), limit, unit_behind(metric, found.unit));
  }
  if (found.z) {
    add("z", *found.z, *regress_case.max_z, "");
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Picture, reference and heat map of what failed first;
/// without a map of its own a limit on z or psnr shows relative errors.
void leave_evidence(const RegressCase& regress_case, const Comparison& found,
                    const fs::path& picture_file, const fs::path& folder) {
  make_folder(folder);
  copy_into(picture_file, folder / (regress_case.name + ".exr"));
  copy_into(regress_case.reference, folder / (regress_case.name + ".reference.exr"));
  Metric shown = Metric::relmse;
  for (const MetricLimit& limit : regress_case.limits) {
    if (!holds(found.difference, limit) && limit.metric != Metric::psnr) {
      shown = limit.metric;
      break;
    }
  }
  const Channel errors = error_map(found.difference, shown, found.picture.image,
                                   found.reference.image, found.settings);
  write_png(folder / (regress_case.name + ".heat.png"),
            heat_map(errors, heat_map_settings(found.difference, shown, errors)), 0.0);
}

void remove_evidence(const std::string& name, const fs::path& folder) {
  std::error_code ignored;
  for (const char* ending : {".exr", ".reference.exr", ".heat.png"}) {
    fs::remove(folder / (name + ending), ignored);
  }
}

void compare_case(const RegressCase& regress_case, const fs::path& picture_file,
                  const fs::path& output, CaseResult& result) {
  const Comparison found = compare(regress_case, picture_file);
  const auto broken = broken_limits_of(regress_case, found);
  if (broken.empty()) {
    // What an earlier run has left would be taken for this one's.
    remove_evidence(regress_case.name, output);
    result.status = CaseStatus::passed;
    result.text = figures(regress_case, found);
    return;
  }
  leave_evidence(regress_case, found, picture_file, output);
  result.status = CaseStatus::failed;
  result.text = fmt::format("{}; {}", fmt::join(broken, ", "),
                            describe_change(found.picture.image, found.reference.image,
                                            found.unit));
}

} // namespace

std::vector<CaseResult> regress_run(const RegressRequest& request,
                                    const std::vector<RegressCase>& cases, const RunEvents& events,
                                    const std::function<void(const CaseResult&)>& done) {
  if (request.junit) {
    check_writable_file(*request.junit);
  }
  const WorkFolder work;
  std::vector<CaseResult> results;
  const CaseRendering* rendered = nullptr;
  for (const RegressCase& regress_case : cases) {
    CaseResult result{.name = regress_case.name, .text = {}};
    Stopwatch watch;
    try {
      if (request.task == RegressTask::update) {
        make_folder(regress_case.reference.parent_path());
        render_into(regress_case.reference, regress_case.reference_picture, request.threads,
                    events);
        enter_reference(regress_case, request.cases_file);
        result.status = CaseStatus::updated;
        result.text = regress_case.reference.string();
      } else {
        if (rendered == nullptr || !same_rendering(*rendered, regress_case.picture)) {
          rendered = nullptr;
          render_into(work.picture(), regress_case.picture, request.threads, events);
          rendered = &regress_case.picture;
        }
        compare_case(regress_case, work.picture(), request.output, result);
      }
    } catch (const UserError& error) {
      result.status = CaseStatus::broken;
      result.text = error.what();
      result.exit_code = static_cast<int>(error.code());
    }
    result.seconds = watch.lap();
    done(result);
    results.push_back(std::move(result));
  }
  if (request.junit) {
    const std::string xml = junit_xml(results, request.cases_file.filename().string());
    write_text_file(*request.junit, xml);
  }
  return results;
}

} // namespace meninas
