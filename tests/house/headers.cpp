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

/// By an equation, or the year of a source.
bool states_how(const std::string& comments) {
  static const std::regex equation(R"([\w)|]\s+(=|~|<=|>=|<|>)\s+[-\w(|])"),
      year(R"(\b(1[789]\d\d|20[0-2]\d)\b)");
  return std::regex_search(comments, equation) || std::regex_search(comments, year);
}

bool states_unit(const std::string& comments) {
  static const std::regex unit(
      R"(W/m|\bW\b|m\^2|metre|radian|steradian|dimensionless|unit length|[Rr]elative|share|factor|fraction|0 to 1|\[0, 1|pixels|seconds|bytes|degrees|frame)");
  return std::regex_search(comments, unit);
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
    const std::string comments = comments_of(file);
    const bool how = states_how(comments), unit = states_unit(comments);
    for (const Function& function : functions_of(file))
      if (returns_quantity(function) && !(how && unit))
        breaches.push_back(fmt::format("{}:{}: {} returns a quantity, and no comment has {}", file.path,
                                       function.line, function.name,
                                       how ? "a unit" : "an equation or a source"));
  }
  return breaches;
}

} // namespace meninas
