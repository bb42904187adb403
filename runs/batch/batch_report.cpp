#include "runs/batch/batch_report.h"

#include "runs/json/json_place.h"
#include "runs/report/page.h"
#include "runs/pages/batch_page.h"
#include "runs/regress_run.h"
#include "runs/steering/setting_options.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace meninas {
namespace {

const char* name_of(PictureStatus status) {
  switch (status) {
  case PictureStatus::made:
    return "made";
  case PictureStatus::found:
    return "found";
  case PictureStatus::failed:
    return "failed";
  case PictureStatus::open:
  case PictureStatus::held:
    break;
  }
  return "open";
}

Json picture_json(const BatchPicture& picture, const PictureResult& result) {
  Json files = Json::array();
  for (const auto& output : picture.outputs) {
    files.push_back(output.generic_string());
  }
  const PictureRecord& record = result.record;
  Json json{{"number", picture.number},
            {"name", picture.name},
            {"status", name_of(result.status)},
            {"job", picture.job},
            {"scene", picture.scene.generic_string()},
            {"camera", picture.camera.name},
            {"mode", picture.mode},
            {"frame", picture.frame},
            {"width", picture.size.width},
            {"height", picture.size.height},
            {"files", files},
            {"seconds", record.seconds},
            {"rays", record.rays}};
  if (const auto& at = picture.request.settings.gltf.state.at) {
    json["at"] = *at;
  }
  if (result.status == PictureStatus::failed) {
    json["error"] = record.error;
    json["exit_code"] = record.exit_code;
  }
  return json;
}

Json solve_json(const SolveResult& solve) {
  Json json{{"scene", solve.scene},
            {"key", solve.key},
            {"solved", solve.solved},
            {"seconds", solve.seconds},
            {"elements", solve.figures.elements},
            {"error_bound", nullptr},
            {"converged", solve.figures.solver.converged}};
  if (std::isfinite(solve.figures.solver.error_bound)) {
    json["error_bound"] = solve.figures.solver.error_bound;
  }
  return json;
}

/// What summary and page have in common.
Json report_json(const BatchReport& report) {
  const BatchCounts counts = count(report.results);
  const Json units{{"seconds", "s"}, {"at", "s"}, {"rays_per_second", "1/s"}, {"peak_memory_bytes", "B"}, {"error_bound", "1"}};
  Json json{{"units", units},
            {"jobs_file", report.jobs_file.generic_string()},
            {"version", program_version()},
            {"counts",
             {{"pictures", report.results.size()},
              {"made", counts.made},
              {"found", counts.found},
              {"failed", counts.failed},
              {"open", counts.open}}},
            {"seconds", report.seconds},
            {"rays", report.rays},
            {"rays_per_second", report.seconds > 0.0 ? double(report.rays) / report.seconds : 0.0},
            {"peak_memory_bytes", report.peak_memory_bytes},
            {"threads", report.threads}};
  json["solves"] = Json::array();
  for (const SolveResult& solve : report.solves) {
    json["solves"].push_back(solve_json(solve));
  }
  json["pictures"] = Json::array();
  for (std::size_t k = 0; k < report.pictures.size(); ++k) {
    json["pictures"].push_back(picture_json(report.pictures[k], report.results[k]));
  }
  return json;
}

} // namespace

BatchCounts count(std::span<const PictureResult> results) {
  BatchCounts counts;
  for (const PictureResult& result : results) {
    switch (result.status) {
    case PictureStatus::made:
      ++counts.made;
      break;
    case PictureStatus::found:
      ++counts.found;
      break;
    case PictureStatus::failed:
      ++counts.failed;
      break;
    case PictureStatus::open:
    case PictureStatus::held:
      ++counts.open;
      break;
    }
  }
  return counts;
}

std::string summary_json(const BatchReport& report) {
  return text_of(report_json(report), 2) + '\n';
}

std::string contact_sheet(const BatchReport& report) {
  Json json = report_json(report);
  json["command"] = "meninas batch " + shell_quoted(report.jobs_file.string()) + " -o " +
                    shell_quoted(report.folder.string()) + " --resume";
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    Json& picture = json["pictures"][k];
    picture["thumbnail"] = report.results[k].record.thumbnail;
    picture["settings"] =
        fmt::format("{}", fmt::join(options_of(report.pictures[k].request.settings), " "));
  }
  return fill_page(batch_page, text_of(json, -1));
}

std::string batch_junit(const BatchReport& report) {
  std::vector<CaseResult> cases;
  for (std::size_t k = 0; k < report.pictures.size(); ++k) {
    const PictureResult& result = report.results[k];
    CaseResult entry{.name = report.pictures[k].name,
                     .text = result.record.error,
                     .seconds = result.record.seconds};
    if (result.status == PictureStatus::failed) {
      entry.status = CaseStatus::failed;
    } else if (result.status != PictureStatus::made && result.status != PictureStatus::found) {
      entry.status = CaseStatus::broken;
      entry.text = "not done";
    }
    cases.push_back(std::move(entry));
  }
  return junit_xml(cases, report.jobs_file.filename().string());
}

} // namespace meninas
