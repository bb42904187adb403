#include "tests/cli/browser.h"

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

namespace meninas::test {

std::vector<std::byte> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::byte> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const auto digit = digits.find(c);
    if (digit == std::string::npos)
      break;
    group = group << 6U | static_cast<std::uint32_t>(digit);
    if (bits += 6; bits >= 8)
      bytes.push_back(static_cast<std::byte>(group >> (bits -= 8) & 0xffU));
  }
  return bytes;
}

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

bool has_browser() { return std::filesystem::exists(MENINAS_BROWSER); }

nlohmann::json browse_drawn_page(const std::filesystem::path& folder, const std::string& page,
                                 const std::string& fragment, const std::string& use) {
  std::string html = read_file(page);
  // Frames by the clock, which virtual time moves: those of the screen may wait for ever.
  html.insert(html.find("<head>"), "<script>window.requestAnimationFrame = draw => "
                                   "setTimeout(() => draw(performance.now()), 16);</script>");
  html.insert(html.rfind("</body>"), "<script>(async () => {" + use +
                                         "})().then(said => { document.body.dataset.report = "
                                         "btoa(unescape(encodeURIComponent(JSON.stringify(said)))); });</script>");
  std::ofstream(folder / "drawn.html") << html;
  const Outcome outcome =
      run_other_program(MENINAS_BROWSER, folder,
                        {"--headless", "--no-sandbox", "--disable-dev-shm-usage",
                         "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                         "--window-size=640,480", "--virtual-time-budget=60000", "--dump-dom",
                         "--user-data-dir=" + (folder / "profile").string(),
                         "file://" + (folder / "drawn.html").string() + "#" + fragment});
  const std::string mark = "data-report=\"";
  const auto first = outcome.out.find(mark);
  if (first == std::string::npos)
    return nullptr;
  const auto begin = first + mark.size();
  const std::vector<std::byte> said =
      from_base64(outcome.out.substr(begin, outcome.out.find('"', begin) - begin));
  return nlohmann::json::parse(reinterpret_cast<const char*>(said.data()),
                               reinterpret_cast<const char*>(said.data() + said.size()));
}

} // namespace meninas::test
