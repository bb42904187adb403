#include "tests/house/include_graph.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace meninas {
namespace {

constexpr std::size_t max_pairs = 20;

/// The chapters of radiosity/, each of which may include those of a lower number and itself.
const std::map<std::string, int, std::less<>> chapters = {
    {"radiosity/mesh", 0},         {"radiosity/scene", 1}, {"radiosity/transport", 2},
    {"radiosity/solvers", 3},      {"radiosity/light", 3}, {"radiosity/field", 4},
    {"radiosity/hierarchical", 5}, {"radiosity", 6},
    {"radiosity/queries", 8},      {"radiosity/solution", 8}};

bool is_tested_code(const SourceFile& file) {
  const std::filesystem::path path(file.path);
  const bool onlooker = file.path.starts_with("tests/") || file.path.starts_with("bench/");
  return !onlooker && (path.extension() == ".h" || path.extension() == ".cpp");
}

std::string pair_of(const std::string& path) {
  return std::filesystem::path(path).replace_extension().generic_string();
}
std::string folder_of_pair(const std::string& pair) {
  return std::filesystem::path(pair).parent_path().generic_string();
}

/// By pair, the pairs of the house that it includes.
using Graph = std::map<std::string, std::set<std::string>>;
Graph graph_of(const std::vector<SourceFile>& tree) {
  Graph graph;
  for (const SourceFile& file : tree)
    if (is_tested_code(file))
      graph[pair_of(file.path)];
  for (const SourceFile& file : tree) {
    if (!is_tested_code(file))
      continue;
    for (const std::string& line : file.lines) {
      const std::string included = included_path(line);
      const std::string pair = pair_of(included);
      if (!included.empty() && pair != pair_of(file.path) && graph.contains(pair))
        graph[pair_of(file.path)].insert(pair);
    }
  }
  return graph;
}

/// Strongly connected components (Tarjan 1972).
class Components {
public:
  explicit Components(const Graph& graph) : graph_(graph) {
    for (const auto& [pair, included] : graph)
      if (!number_.contains(pair))
        visit(pair);
  }
  const std::vector<std::vector<std::string>>& all() const { return components_; }

private:
  void visit(const std::string& pair) {
    const std::size_t own = number_.size();
    number_[pair] = lowest_[pair] = own;
    open_.push_back(pair);
    for (const std::string& next : graph_.at(pair)) {
      if (!number_.contains(next)) {
        visit(next);
        lowest_[pair] = std::min(lowest_[pair], lowest_[next]);
      } else if (std::ranges::find(open_, next) != open_.end()) {
        lowest_[pair] = std::min(lowest_[pair], number_[next]);
      }
    }
    if (lowest_[pair] != own)
      return;
    const auto first = std::ranges::find(open_, pair);
    components_.emplace_back(first, open_.end());
    open_.erase(first, open_.end());
  }

  const Graph& graph_;
  std::map<std::string, std::size_t> number_, lowest_;
  std::vector<std::string> open_;
  std::vector<std::vector<std::string>> components_;
};

/// The folder, or where that is a part of a chapter (radiosity/field/curves) the chapter.
std::string chapter_of_pair(const std::string& pair) {
  std::string folder = folder_of_pair(pair);
  while (!chapters.contains(folder) && std::ranges::count(folder, '/') > 1)
    folder.resize(folder.rfind('/'));
  return folder;
}

} // namespace

std::vector<std::string> chapter_breaches(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  for (const auto& [pair, included] : graph_of(tree)) {
    const std::string folder = chapter_of_pair(pair);
    if (folder.starts_with("radiosity") && !chapters.contains(folder))
      breaches.push_back(fmt::format("{}: its folder has no place among the chapters", pair));
    for (const std::string& other : included) {
      const auto from = chapters.find(folder), to = chapters.find(chapter_of_pair(other));
      if (from != chapters.end() && to != chapters.end() && from->second <= to->second &&
          from->first != to->first)
        breaches.push_back(fmt::format("{} may not include {}", pair, other));
    }
  }
  return breaches;
}

std::vector<std::string> knots(const std::vector<SourceFile>& tree) {
  std::vector<std::string> found;
  const Graph graph = graph_of(tree);
  const Components components(graph);
  for (std::vector<std::string> component : components.all())
    if (component.size() > 1) {
      std::ranges::sort(component);
      found.push_back(fmt::format("{} include one another", fmt::join(component, ", ")));
    }
  return found;
}

std::vector<std::string> crowded_folders(const std::vector<SourceFile>& tree) {
  std::map<std::string, std::size_t> pairs;
  for (const auto& [pair, included] : graph_of(tree))
    ++pairs[folder_of_pair(pair)];
  std::vector<std::string> crowded;
  for (const auto& [folder, count] : pairs)
    if (count > max_pairs)
      crowded.push_back(fmt::format("{} has {} pairs, more than {}", folder, count, max_pairs));
  return crowded;
}

} // namespace meninas
