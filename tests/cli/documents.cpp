#include "tests/cli/documents.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <string_view>

namespace meninas::test {

namespace fs = std::filesystem;

static std::string first_match(const std::string& text, const std::regex& pattern) {
  std::smatch match;
  return std::regex_search(text, match, pattern) ? match[1].str() : "";
}

Page read_page(const fs::path& file) {
  static const std::regex marked("^<!-- not run: (.+) -->$"), saved("Save this as `([^`]+)`"),
      fence("^ *```(.*)$");
  Page page{file, {}, {}};
  std::ifstream lines(file);
  std::string saved_as, before;
  bool inside = false;
  for (std::string line; std::getline(lines, line); before = line) {
    const bool is_fence = std::regex_match(line, fence);
    if (is_fence && !inside) {
      page.blocks.push_back({.line = page.prose.size() + 1,
                             .language = first_match(line, fence),
                             .text = "",
                             .saved_as = std::exchange(saved_as, ""),
                             .not_run = first_match(before, marked)});
    } else if (inside && !is_fence) {
      page.blocks.back().text += line + '\n';
    } else if (const std::string name = first_match(line, saved); !name.empty()) {
      saved_as = name;
    }
    page.prose.push_back(is_fence || inside ? "" : line);
    inside ^= is_fence;
  }
  return page;
}

std::vector<fs::path> pages_of(const fs::path& root) {
  std::vector<fs::path> pages;
  for (auto at = fs::recursive_directory_iterator(root); at != fs::recursive_directory_iterator(); ++at) {
    const std::string name = at->path().filename().string();
    if (at->is_directory() && (name.starts_with('.') || name == "build"))
      at.disable_recursion_pending();
    else if (at->path().extension() == ".md")
      pages.push_back(at->path());
  }
  std::ranges::sort(pages);
  return pages;
}

std::vector<std::string> commands_of(const Block& block) {
  static const std::regex command("(^|\n) *(?:\\./)?meninas ([^\n]+)");
  std::vector<std::string> commands;
  if (block.language.empty() || block.language == "sh")
    for (std::sregex_iterator at(block.text.begin(), block.text.end(), command), end; at != end; ++at)
      commands.push_back((*at)[2]);
  return commands;
}

/// All that a pattern finds in the prose, code in backticks left out or not.
static std::vector<std::string> found_in(const Page& page, const std::regex& pattern, bool code) {
  static const std::regex backticks("`[^`]*`");
  std::vector<std::string> found;
  for (const std::string& line : page.prose) {
    const std::string text = code ? line : std::regex_replace(line, backticks, "");
    for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
      found.push_back((*at)[1]);
  }
  return found;
}

std::vector<std::string> links_of(const Page& page) {
  static const std::regex link("\\]\\(([^)\\s]+)\\)");
  auto links = found_in(page, link, false);
  std::erase_if(links, [](const std::string& to) { return to.starts_with("http"); });
  return links;
}

std::vector<std::string> anchors_of(const Page& page) {
  std::vector<std::string> anchors;
  for (const std::string& line : page.prose) {
    if (!line.starts_with('#'))
      continue;
    std::string anchor;
    for (const char c : line.substr(std::min(line.size(), line.find_first_not_of("# "))))
      if (static_cast<unsigned char>(c) >= 0x80 || std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      else if (c == ' ')
        anchor += '-';
    anchors.push_back(anchor);
  }
  return anchors;
}

std::vector<std::string> sources_of(const Page& page) {
  static const std::regex source("`([A-Za-z0-9_]+/[A-Za-z0-9_/]+\\.(?:cpp|h|js|sh))`");
  return found_in(page, source, true);
}

} // namespace meninas::test
