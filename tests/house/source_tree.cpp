#include "tests/house/source_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string_view>

namespace meninas {
namespace {

constexpr std::size_t longest_file = 400;

/// Which folders a folder may include, besides itself:
///   scenes, image <- mirror <- form_factors <- radiosity <- raytrace <- runs <- cli <- library
/// and
///   scenes, image <- reference <- runs
/// The image folder stands beside scenes;
/// all it takes from there are the vocabulary and the errors.
const std::map<std::string, std::set<std::string>, std::less<>> allowed_folders = {
    {"scenes", {}},
    {"image", {}},
    {"mirror", {"scenes", "image"}},
    {"form_factors", {"scenes", "image", "mirror"}},
    {"radiosity", {"scenes", "image", "mirror", "form_factors"}},
    {"raytrace", {"scenes", "image", "mirror", "form_factors", "radiosity"}},
    {"reference", {"scenes", "image"}},
    {"runs", {"scenes", "image", "mirror", "form_factors", "radiosity", "raytrace", "reference"}},
    {"cli",
     {"scenes", "image", "mirror", "form_factors", "radiosity", "raytrace", "reference", "runs"}},
    {"library",
     {"scenes", "image", "mirror", "form_factors", "radiosity", "raytrace", "reference", "runs", "cli"}},
};
const std::set<std::string, std::less<>> vocabulary = {"scenes/errors.h", "scenes/types.h"};

/// Tests and benchmarks look at everything and nothing looks at them.
const std::set<std::string, std::less<>> onlooking_folders = {"tests", "bench"};

/// A library that only one .cpp of one folder may include, so that it can be replaced there;
/// of `files`, all whose paths begin so.
struct WrappedLibrary {
  std::string_view name;
  std::string_view header_prefix;
  std::string_view folder;
  std::string_view files = "";
};
constexpr std::array wrapped_libraries = {
    WrappedLibrary{"Embree", "embree", "scenes", "scenes/rays/"},
    WrappedLibrary{"tinygltf", "tiny_gltf", "scenes"},
    WrappedLibrary{"Draco", "draco/", "scenes"},
    WrappedLibrary{"meshoptimizer", "meshoptimizer.h", "scenes"},
    WrappedLibrary{"OpenImageIO", "OpenImageIO/", "image"},
    WrappedLibrary{"OpenEXR", "OpenEXR/", "image"},
    WrappedLibrary{"libpng", "png.h", "image", "image/codecs/png_"},
    WrappedLibrary{"CLI11", "CLI/", "cli"},
    WrappedLibrary{"xxHash", "xxhash.h", "scenes"},
    WrappedLibrary{"cpp-httplib", "httplib.h", "runs"},
    WrappedLibrary{"stb_rect_pack", "stb/", "runs"},
};

/// What things were called before they had the field's names.
constexpr std::array retired = {
    "FoundField",       "found_field",   "bent_field",        "BrightClusters",
    "bright_clusters",  "KnownBlocker",  "known_blockers",    "KeptRays",
    "kept_rays",        "StandsOut",     "DirectionNet",      "RayLanding",
    "CoveredCells",     "covered_cells", "ReceiverNodes",     "VertexShares",
    "NodeCross",        "DiffuseField",  "RefinedScene",      "field_scene",
    "ClusterStandIn",   "SourceSeen",    "divide_bent",       "divide_at_shadows",
    "follow_penumbrae", "chosen_lights", "shared_irradiance", "throws_as_mirror",
    "let_out_by_coat",  "sure_paths",    "shadow_lines.h",    "standing_walls",
    "from_source",      "Cover::",       "VertexState::lit",  "Visibility::alike",
    "light_fresh",      "left_on_leg",   "meet_blocker",      "has_learned",
    "cut_at_shadows",   "shadow_lines",  "world_tail",        "LandingTable",
    "cells_at_foot",    "KnobTurn",      "TurnedSettings",    "facets_with_edges",
    "reflected_light.h", "lobe_grid",    "shadow_paths.h",    "element_hierarchy.h"};

/// Limits are max_x and min_x: what begins with one of these, in C++ or in JavaScript, is named otherwise.
/// Of Python's own names one is among them.
bool has_other_limit_name(const std::string& line) {
  static const std::regex limit(R"(\b(most|least|few|fewest)(_(?!common\()[a-z]|[A-Z][a-z]))");
  return std::regex_search(line, limit);
}

std::string folder_of(std::string_view path) {
  return std::string(path.substr(0, std::min(path.find('/'), path.size())));
}

bool is_onlooker(const SourceFile& file) {
  return onlooking_folders.contains(folder_of(file.path));
}

bool may_include(const std::string& folder, const std::string& included) {
  const std::string other = folder_of(included);
  if (other == folder || onlooking_folders.contains(folder)) {
    return allowed_folders.contains(other) || other == folder || onlooking_folders.contains(other);
  }
  if (folder == "image" && vocabulary.contains(included)) {
    return true;
  }
  return allowed_folders.at(folder).contains(other);
}

std::vector<std::string> read_lines(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

bool is_source(const std::filesystem::path& file) {
  static const std::set<std::string> extensions = {".h",     ".hpp", ".cpp", ".cc",
                                                   ".cmake", ".sh",  ".py", ".js"};
  return extensions.contains(file.extension().string());
}

bool is_code(const SourceFile& file) {
  const std::string extension = std::filesystem::path(file.path).extension().string();
  return extension != ".cmake" && extension != ".sh" && extension != ".py" && extension != ".js";
}

/// Calls visit(file, line number, included path, in quotes) for every include of the tree.
template <typename Visit>
void for_each_include(const std::vector<SourceFile>& tree, Visit visit) {
  for (const SourceFile& file : tree) {
    for (std::size_t i = 0; is_code(file) && i < file.lines.size(); ++i) {
      if (const std::string included = included_path(file.lines[i]); !included.empty()) {
        visit(file, i + 1, included, file.lines[i].find('"') != std::string::npos);
      }
    }
  }
}

/// The file named first after "Start with": beside the page, or written from a folder around it.
bool has_entry(const std::filesystem::path& root, std::filesystem::path folder, const std::string& page) {
  static const std::regex start("Start with [^`.]*`([^`]+)`");
  std::smatch entry;
  if (!std::regex_search(page, entry, start))
    return false;
  const std::string name = entry[1].str();
  for (; !folder.empty(); folder = folder.parent_path())
    if (std::filesystem::exists(root / folder / name))
      return true;
  return std::filesystem::exists(root / name);
}

} // namespace

std::vector<std::string> folder_page_breaches(const std::filesystem::path& root, const std::vector<SourceFile>& tree) {
  std::set<std::string> folders;
  for (const SourceFile& file : tree)
    if (folder_of(file.path) != "cmake")
      folders.insert(file.path.starts_with("tests/") ? "tests" : std::filesystem::path(file.path).parent_path().generic_string());
  std::vector<std::string> breaches;
  for (const std::string& folder : folders) {
    std::string page;
    for (const std::string& line : read_lines(root / folder / "README.md"))
      page += line + '\n';
    if (!page.starts_with("# "))
      breaches.push_back(fmt::format("{}/README.md is missing, or has no title", folder));
    if (!has_entry(root, folder, page))
      breaches.push_back(fmt::format("{}/README.md: 'Start with' names no file that is there", folder));
    if (page.find("May include: ") == std::string::npos)
      breaches.push_back(fmt::format("{}/README.md: no 'May include: '", folder));
  }
  return breaches;
}

std::vector<SourceFile> read_source_tree(const std::filesystem::path& root) {
  std::vector<SourceFile> tree;
  for (const auto& top : std::filesystem::directory_iterator(root)) {
    const std::string name = top.path().filename().string();
    // A folder of ours has a CMakeLists.txt; what users keep beside them is none of our business.
    if (name != "cmake" && !std::filesystem::exists(top.path() / "CMakeLists.txt")) {
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(top)) {
      if (entry.is_regular_file() && is_source(entry.path())) {
        tree.push_back(
            {entry.path().lexically_relative(root).generic_string(), read_lines(entry.path())});
      }
    }
  }
  std::ranges::sort(tree, {}, &SourceFile::path);
  return tree;
}

std::string included_path(const std::string& line) {
  std::string_view rest = line;
  const auto skip = [&rest](std::string_view expected) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    const bool found = rest.starts_with(expected);
    rest.remove_prefix(found ? expected.size() : 0);
    return found;
  };
  if (!skip("#") || !skip("include") || !(skip("\"") || skip("<"))) {
    return "";
  }
  return std::string(rest.substr(0, rest.find_first_of("\">")));
}

std::vector<std::string> include_direction_breaches(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  for (const SourceFile& file : tree) {
    if (is_code(file) && !is_onlooker(file) && !allowed_folders.contains(folder_of(file.path))) {
      breaches.push_back(
          fmt::format("{}:1: its folder has no place in the include directions", file.path));
    }
  }
  for_each_include(tree, [&](const SourceFile& file, std::size_t line, const std::string& included,
                             bool quoted) {
    const std::string folder = folder_of(file.path);
    const std::string other = folder_of(included);
    const bool ours = allowed_folders.contains(other) || onlooking_folders.contains(other);
    if (!allowed_folders.contains(folder) && !onlooking_folders.contains(folder)) {
      return;
    }
    if (quoted && !ours) {
      breaches.push_back(fmt::format("{}:{}: \"{}\" is not written from the project's root",
                                     file.path, line, included));
    } else if (ours && !may_include(folder, included)) {
      breaches.push_back(
          fmt::format("{}:{}: {} may not include {}", file.path, line, folder, included));
    }
  });
  return breaches;
}

std::vector<std::string> stray_tests(const std::vector<SourceFile>& tree) {
  namespace fs = std::filesystem;
  std::multimap<std::pair<std::string, std::string>, std::string> folders; // by library and name
  for (const SourceFile& file : tree)
    if (const fs::path path(file.path); path.extension() == ".h")
      folders.emplace(std::pair(folder_of(file.path), path.stem().string()), path.parent_path().generic_string());
  std::vector<std::string> strays;
  for (const SourceFile& file : tree) {
    constexpr std::string_view root = "tests/", ending = "_test.cpp";
    if (!file.path.starts_with(root) || !file.path.ends_with(ending))
      continue;
    const std::string inside = file.path.substr(root.size());
    const std::string name = fs::path(inside).filename().string();
    const auto [begin, end] =
        folders.equal_range({folder_of(inside), name.substr(0, name.size() - ending.size())});
    const std::string folder = fs::path(inside).parent_path().generic_string();
    if (begin != end && std::none_of(begin, end, [&](const auto& at) { return at.second == folder; }))
      strays.push_back(fmt::format("{}: what it tests is in {}", file.path, begin->second));
  }
  return strays;
}

std::vector<std::string> retired_words(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  for (const SourceFile& file : tree) {
    if (file.path.starts_with("tests/house/")) {
      continue;
    }
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      for (const std::string_view word : retired) {
        if (file.lines[i].find(word) != std::string::npos) {
          breaches.push_back(fmt::format("{}:{}: {} has another name in docs/glossary.md",
                                         file.path, i + 1, word));
        }
      }
      if (has_other_limit_name(file.lines[i])) {
        breaches.push_back(fmt::format("{}:{}: a limit is max_ or min_", file.path, i + 1));
      }
    }
  }
  return breaches;
}

std::vector<std::string> wrapped_library_breaches(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  std::map<std::string_view, std::string> user_of;
  for_each_include(
      tree, [&](const SourceFile& file, std::size_t line, const std::string& included, bool) {
        for (const WrappedLibrary& library : wrapped_libraries) {
          // A test or a benchmark may compare with the bare library.
          const bool among_users = !library.files.empty() && file.path.starts_with(library.files);
          if (!included.starts_with(library.header_prefix) || is_onlooker(file) || among_users) {
            continue;
          }
          const std::string& user = user_of.emplace(library.name, file.path).first->second;
          if (folder_of(file.path) != library.folder || !file.path.ends_with(".cpp")) {
            breaches.push_back(fmt::format("{}:{}: {} belongs in one .cpp of {}", file.path, line,
                                           library.name, library.folder));
          } else if (user != file.path) {
            breaches.push_back(fmt::format("{}:{}: {} already has its one user, {}", file.path,
                                           line, library.name, user));
          }
        }
      });
  return breaches;
}

std::vector<std::string> file_shape_breaches(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  for (const SourceFile& file : tree) {
    if (file.lines.size() > longest_file) {
      breaches.push_back(
          fmt::format("{}:{}: longer than {} lines", file.path, file.lines.size(), longest_file));
    }
    if (!file.path.ends_with(".h")) {
      continue;
    }
    if (file.lines.empty() || !file.lines.front().starts_with("//")) {
      breaches.push_back(
          fmt::format("{}:1: a header opens with a comment that says what it is for", file.path));
    }
    if (std::ranges::count(file.lines, "#pragma once") != 1) {
      breaches.push_back(fmt::format("{}:1: a header has one #pragma once", file.path));
    }
  }
  return breaches;
}

} // namespace meninas
