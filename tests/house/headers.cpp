#include "tests/house/headers.h"

#include "tests/house/functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>

namespace meninas {
namespace {

constexpr std::ptrdiff_t min_words = 12;

bool is_of_the_method(const SourceFile& file) {
  constexpr std::array folders{"mirror/", "form_factors/", "radiosity/", "raytrace/"};
  return file.path.ends_with(".h") && std::ranges::any_of(folders, [&](const char* folder) {
           return file.path.starts_with(folder);
         });
}

std::string opening_of(const SourceFile& file) {
  std::string text;
  for (const std::string& line : file.lines) {
    if (!line.starts_with("//"))
      break;
    text += line.substr(2) + ' ';
  }
  return text;
}

std::string comments_of(const SourceFile& file) {
  std::string text;
  for (const std::string& line : file.lines)
    if (const std::size_t begin = line.find("//"); begin != std::string::npos)
      text += line.substr(begin) + '\n';
  return text;
}

std::ptrdiff_t words_in(const std::string& text) {
  static const std::regex word("[A-Za-z]{2,}");
  return std::distance(std::sregex_iterator(text.begin(), text.end(), word),
                       std::sregex_iterator());
}

/// An equation, a year, or a unit.
bool states_something(const std::string& comments) {
  static const std::regex equation(R"(\S\s*(=|~|<=|->|\|\|)\s*\S)"),
      year(R"(\b(17|18|19|20)\d\d\b)"),
      unit(R"(W/m|m\^2|metre|radian|steradian|dimensionless| relative|pixels|seconds|bytes)");
  return std::regex_search(comments, equation) || std::regex_search(comments, year) ||
         std::regex_search(comments, unit);
}

bool returns_quantity(const Function& function) {
  static const std::regex quantity(
      R"((^|[\s<,])(double|float|Rgb|glm::vec3|glm::dvec3|Point3|Direction|Vec3|ArrivingLight)\b)");
  return !function.is_member && std::regex_search(function.returned, quantity);
}

} // namespace

std::vector<std::string> header_breaches(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  for (const SourceFile& file : tree) {
    if (!is_of_the_method(file))
      continue;
    if (const auto words = words_in(opening_of(file)); words < min_words)
      breaches.push_back(
          fmt::format("{}:1: {} words do not say what it computes", file.path, words));
    if (states_something(comments_of(file)))
      continue;
    for (const Function& function : functions_of(file))
      if (returns_quantity(function))
        breaches.push_back(
            fmt::format("{}:{}: {} returns a quantity, and no comment has an equation, a source or "
                        "a unit",
                        file.path, function.line, function.name));
  }
  return breaches;
}

} // namespace meninas
