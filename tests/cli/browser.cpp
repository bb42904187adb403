#include "tests/cli/browser.h"

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

namespace meninas::test {

nlohmann::json browse_page(const std::filesystem::path& folder, const std::string& page,
                           const std::string& use, int width) {
  std::string html = read_file(page);
  const auto end = html.rfind("</body>");
  EXPECT_NE(end, std::string::npos);
  html.insert(end, "<script>addEventListener('load', () => document.body.dataset.report = "
                   "JSON.stringify((() => {" +
                       use + "})()));</script>");
  std::ofstream(folder / "used.html") << html;
  const Outcome outcome =
      run_other_program(MENINAS_BROWSER, folder,
                        {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--window-size=" + std::to_string(width) + ",900",
                         "--virtual-time-budget=10000", "--dump-dom",
                         "--user-data-dir=" + (folder / "profile").string(),
                         "file://" + (folder / "used.html").string()});
  std::smatch report;
  if (!std::regex_search(outcome.out, report, std::regex("data-report=\"([^\"]*)\""))) {
    ADD_FAILURE() << outcome.err;
    return {};
  }
  std::string text = report[1].str();
  for (const auto& [code, sign] :
       {std::pair{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    text = std::regex_replace(text, std::regex(code), sign);
  return nlohmann::json::parse(text);
}

} // namespace meninas::test
