#include "scenes/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace meninas {
namespace {

/// Names are compared by their beginnings, so that absurdly long ones cost no time.
constexpr std::size_t compared_length = 64;

std::string folded(std::string_view name) {
  std::string result(name.substr(0, compared_length));
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  return result;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string
/// alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    last[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

} // namespace

std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> known) {
  const std::string wanted = folded(name);
  const std::string* nearest = nullptr;
  std::size_t least = 0;
  for (const std::string& candidate : known) {
    const std::string other = folded(candidate);
    const std::size_t distance = edit_distance(wanted, other);
    // More than every third letter wrong is another name, not a mistyped one.
    const std::size_t allowed = std::max<std::size_t>(1, std::max(wanted.size(), other.size()) / 3);
    if (distance <= allowed && (nearest == nullptr || distance < least)) {
      nearest = &candidate;
      least = distance;
    }
  }
  return nearest == nullptr ? std::nullopt : std::optional<std::string>(*nearest);
}

std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string> known) {
  std::string message = fmt::format("no {} '{}'", kind, name);
  if (const auto nearest = nearest_name(name, known))
    return message + fmt::format(", did you mean '{}'?", *nearest);
  if (known.empty())
    return message + fmt::format(", the scene has no {}s", kind);
  return message + (known.size() == 1 ? fmt::format(", there is only '{}'", known.front())
                                      : fmt::format(" among {} {}s such as '{}'", known.size(), kind,
                                                    known.front()));
}

std::string quoted_names(std::span<const std::string> names) {
  constexpr std::size_t most = 6;
  std::vector<std::string> first;
  for (const std::string& name : names) {
    if (first.size() < most && std::ranges::find(first, '\'' + name + '\'') == first.end()) {
      first.push_back('\'' + name + '\'');
    }
  }
  const std::size_t distinct = std::set<std::string>(names.begin(), names.end()).size();
  const std::string rest =
      distinct > first.size() ? fmt::format(" and {} more", distinct - first.size()) : "";
  return fmt::format("{}{}", fmt::join(first, ", "), rest);
}

} // namespace meninas
