#include "tests/house/functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace meninas {
namespace {

constexpr std::size_t max_lines = 60, max_parameters = 6;

/// The text without comments, literals and preprocessor lines, which become blanks: lines stay.
std::string code_of(const SourceFile& file) {
  std::string code;
  bool in_comment = false, continues = false;
  for (const std::string& line : file.lines) {
    const std::size_t first = line.find_first_not_of(" \t");
    const bool directive = continues || (first != std::string::npos && line[first] == '#');
    continues = directive && line.ends_with('\\');
    char quote = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::string_view two = std::string_view(line).substr(k, 2);
      const bool digit_before = k > 0 && std::isalnum(static_cast<unsigned char>(line[k - 1])) != 0;
      char shown = directive ? ' ' : line[k];
      if (in_comment) {
        shown = ' ';
        if (two == "*/") {
          in_comment = false;
          ++k;
        }
      } else if (quote != 0) {
        shown = ' ';
        if (line[k] == '\\')
          ++k;
        else if (line[k] == quote)
          quote = 0;
      } else if (two == "//") {
        break;
      } else if (two == "/*") {
        in_comment = true;
        shown = ' ';
      } else if (line[k] == '"' || (line[k] == '\'' && !digit_before)) {
        quote = line[k];
        shown = directive ? ' ' : '0';
      }
      code += shown;
    }
    code += '\n';
  }
  return code;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && blank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// Past the bracket that closes the one at `open`.
std::size_t past_match(std::string_view code, std::size_t open) {
  int depth = 0;
  for (std::size_t k = open; k < code.size(); ++k) {
    depth += code[k] == '{' || code[k] == '(' || code[k] == '[' ? 1 : 0;
    depth -= code[k] == '}' || code[k] == ')' || code[k] == ']' ? 1 : 0;
    if (depth == 0)
      return k + 1;
  }
  return code.size();
}

/// Past `template <...>`, if the head begins so.
std::string_view without_template(std::string_view head) {
  head = trimmed(head);
  while (head.starts_with("template")) {
    int depth = 0;
    std::size_t k = std::min(head.find('<'), head.size());
    if (k == head.size())
      return {};
    for (; k < head.size(); ++k) {
      depth += head[k] == '<' ? 1 : head[k] == '>' ? -1 : 0;
      if (depth == 0)
        break;
    }
    head = trimmed(head.substr(std::min(k + 1, head.size())));
  }
  return head;
}

bool begins_with_word(std::string_view head, std::string_view word) {
  return head.starts_with(word) && (head.size() == word.size() || !is_word(head[word.size()]));
}

/// Where the parameters begin: the first parenthesis outside angle brackets; npos without any,
/// or after an assignment or a brace.
std::size_t parameters_of(std::string_view head) {
  int angles = 0;
  for (std::size_t k = 0; k < head.size(); ++k) {
    const std::string_view before = trimmed(head.substr(0, k));
    const bool is_operator = before.ends_with("operator");
    if (head[k] == '{' || (head[k] == '=' && !is_operator && !before.ends_with("operator=")))
      return std::string_view::npos;
    if (is_operator && head.substr(k, 2) == "()") {
      ++k;
      continue;
    }
    angles += head[k] == '<' && !is_operator ? 1 : head[k] == '>' && angles > 0 ? -1 : 0;
    if (head[k] == '(' && angles == 0)
      return k;
  }
  return std::string_view::npos;
}

std::size_t count_parameters(std::string_view head, std::size_t open) {
  const std::string_view inside = head.substr(open + 1, past_match(head, open) - open - 2);
  if (trimmed(inside).empty())
    return 0;
  std::size_t count = 1;
  int depth = 0;
  for (const char c : inside) {
    depth += c == '<' || c == '(' || c == '{' || c == '[' ? 1 : 0;
    depth -= c == '>' || c == ')' || c == '}' || c == ']' ? 1 : 0;
    count += c == ',' && depth == 0 ? 1 : 0;
  }
  return count;
}

/// Reads the heads of functions between braces of namespaces and types.
class Reader {
public:
  explicit Reader(const SourceFile& file) : code_(code_of(file)) { read_scope(0, false); }
  std::vector<Function> functions;

private:
  std::size_t line_at(std::size_t place) const {
    return static_cast<std::size_t>(std::count(
               code_.begin(), code_.begin() + static_cast<std::ptrdiff_t>(place), '\n')) +
           1;
  }

  /// Of the head that begins at `begin`, if it is a function's; `end` is past it.
  void add(std::size_t begin, std::size_t stop, std::size_t end, bool is_member) {
    while (begin < stop && std::isspace(static_cast<unsigned char>(code_[begin])) != 0)
      ++begin;
    const std::string_view head =
        without_template(std::string_view(code_).substr(begin, stop - begin));
    constexpr std::array others{"using", "typedef", "static_assert", "friend", "return", "extern"};
    const std::size_t open = parameters_of(head);
    if (open == std::string_view::npos ||
        std::ranges::any_of(others, [&](const char* word) { return begins_with_word(head, word); }))
      return;
    const std::string_view before = trimmed(head.substr(0, open));
    std::size_t name = before.size();
    while (name > 0 &&
           (is_word(before[name - 1]) || before[name - 1] == ':' || before[name - 1] == '~'))
      --name;
    functions.push_back({std::string(before.substr(name)),
                         std::string(trimmed(before.substr(0, name))), line_at(begin),
                         line_at(end - 1) - line_at(begin) + 1, count_parameters(head, open),
                         is_member});
  }

  /// Returns past the scope's closing brace.
  std::size_t read_scope(std::size_t place, bool is_type) {
    std::size_t begin = place;
    for (std::size_t k = place; k < code_.size(); ++k) {
      if (code_[k] == '}')
        return k + 1;
      if (code_[k] != '(' && code_[k] != ';' && code_[k] != ':' && code_[k] != '{')
        continue;
      const std::string_view head =
          without_template(std::string_view(code_).substr(begin, k - begin));
      if (code_[k] == '(') {
        k = past_match(code_, k) - 1;
      } else if (code_[k] == ';') {
        add(begin, k, k + 1, is_type);
        begin = k + 1;
      } else if (code_[k] == ':' && is_type && (head == "public" || head == "private")) {
        begin = k + 1;
      } else if (code_[k] == '{') {
        const std::size_t open = parameters_of(head);
        const bool is_namespace = begins_with_word(head, "namespace") || head.empty();
        const bool type = (begins_with_word(head, "struct") || begins_with_word(head, "class")) &&
                          (open == std::string_view::npos || head.find("alignas(") != std::string_view::npos);
        const std::string_view after =
            open == std::string_view::npos ? head : head.substr(past_match(head, open));
        const bool initializes =
            trimmed(after).starts_with(":") && !after.empty() && is_word(trimmed(after).back());
        if (is_namespace || type) {
          k = read_scope(k + 1, type) - 1;
          begin = is_namespace ? k + 1 : begin;
          if (type) // to its semicolon
            begin = std::min(code_.find(';', k), code_.size() - 1) + 1, k = begin - 1;
        } else if (open == std::string_view::npos || initializes) {
          k = past_match(code_, k) - 1; // of a variable, an enumeration or a member
        } else {
          const std::size_t end = past_match(code_, k);
          add(begin, k, end, is_type);
          k = end - 1;
          begin = end;
        }
      }
    }
    return code_.size();
  }

  std::string code_;
};

} // namespace

std::vector<Function> functions_of(const SourceFile& file) { return Reader(file).functions; }

std::vector<std::string> function_breaches(const std::vector<SourceFile>& tree) {
  std::vector<std::string> breaches;
  for (const SourceFile& file : tree) {
    const bool onlooker = file.path.starts_with("tests/") || file.path.starts_with("bench/");
    if (onlooker || !(file.path.ends_with(".h") || file.path.ends_with(".cpp")))
      continue;
    for (const Function& function : functions_of(file)) {
      if (function.lines > max_lines)
        breaches.push_back(fmt::format("{}:{}: {} takes {} lines, more than {}", file.path,
                                       function.line, function.name, function.lines, max_lines));
      if (function.parameters > max_parameters)
        breaches.push_back(fmt::format("{}:{}: {} has {} parameters, more than {}", file.path,
                                       function.line, function.name, function.parameters,
                                       max_parameters));
    }
  }
  return breaches;
}

} // namespace meninas
