// Reads a source tree and says where it breaks the rules of the house (ARCHITECTURE.md):
// include directions, the one user of each wrapped library, file length, and how a header begins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace meninas {

struct SourceFile {
  std::string path; ///< from the root, with forward slashes
  std::vector<std::string> lines;
};

/// Sources of cmake/ and of the folders with a CMakeLists.txt, in the order of their paths.
std::vector<SourceFile> read_source_tree(const std::filesystem::path& root);

/// What an `#include` line names, without quotes or brackets; empty for any other line.
std::string included_path(const std::string& line);

/// One line for each breach, `PATH:LINE: WHAT`.
std::vector<std::string> include_direction_breaches(const std::vector<SourceFile>& tree);
std::vector<std::string> wrapped_library_breaches(const std::vector<SourceFile>& tree);
std::vector<std::string> file_shape_breaches(const std::vector<SourceFile>& tree);

/// Folders whose README.md is not there, has no title, or does not say where to start, with a file that is there, and what the
/// sources may include. Of tests/ that is one page; cmake/ has none.
std::vector<std::string> folder_page_breaches(const std::filesystem::path& root, const std::vector<SourceFile>& tree);

/// Tests that are named after a header of the library that they test, and are in another folder of tests/ than that one's.
std::vector<std::string> stray_tests(const std::vector<SourceFile>& tree);

/// Names that the published ones of docs/glossary.md have replaced.
std::vector<std::string> retired_words(const std::vector<SourceFile>& tree);

} // namespace meninas
