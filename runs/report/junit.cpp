#include "runs/regress_run.h"

#include <fmt/format.h>

namespace meninas {

/// Text as an attribute's value; control characters, which XML 1.0 cannot hold, become blanks.
static std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

std::string junit_xml(const std::vector<CaseResult>& results, const std::string& suite) {
  std::size_t failures = 0, errors = 0;
  double seconds = 0.0;
  std::string cases;
  for (const CaseResult& result : results) {
    seconds += result.seconds;
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                         escaped(suite), escaped(result.name), result.seconds);
    const bool failed = result.status == CaseStatus::failed;
    if (!failed && result.status != CaseStatus::broken) {
      cases += "/>\n";
      continue;
    }
    ++(failed ? failures : errors);
    cases += fmt::format(">\n      <{} message=\"{}\"/>\n    </testcase>\n",
                         failed ? "failure" : "error", escaped(result.text));
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
                     "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
                     "time=\"{:.3f}\">\n{}  </testsuite>\n</testsuites>\n",
                     escaped(suite), results.size(), failures, errors, seconds, cases);
}

} // namespace meninas
