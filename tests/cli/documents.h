// The documents as tests read them: pages of Markdown with their blocks, links and headings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace meninas::test {

/// What is between two fences of ```.
struct Block {
  std::size_t line = 0; ///< of its first fence, from 1
  std::string language;
  std::string text;
  std::string saved_as; ///< of "Save this as `NAME`" in the text before, else empty
  std::string not_run;  ///< of `<!-- not run: REASON -->` on the line before the fence, else empty
};

struct Page {
  std::filesystem::path file;
  std::vector<Block> blocks;
  std::vector<std::string> prose; ///< by line; lines of blocks are empty
};

Page read_page(const std::filesystem::path& file);

/// Every page of the checkout but what is built.
std::vector<std::filesystem::path> pages_of(const std::filesystem::path& root);

/// `meninas ...` and `./meninas ...`, one a line, without what is before the program's name.
std::vector<std::string> commands_of(const Block& block);

/// Targets of links and pictures, without those into the network; code in backticks has none.
std::vector<std::string> links_of(const Page& page);

/// What headings are called in addresses, as GitHub and mkdocs have it:
/// small letters, no signs, hyphens for blanks.
std::vector<std::string> anchors_of(const Page& page);

/// Paths of sources in backticks, such as `mirror/worlds.cpp`: those with a folder.
std::vector<std::string> sources_of(const Page& page);

} // namespace meninas::test
