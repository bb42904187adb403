#include "cli/help/manual.h"

#include "cli/help/help.h"
#include "cli/help/option_text.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdint>

namespace meninas {
namespace {

/// One character beyond ASCII, of UTF-8, as \[u00B2]; `at` is moved behind it.
std::string special_character(std::string_view text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at++]);
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
  std::uint32_t code = first & (0x3fU >> static_cast<unsigned>(more));
  for (int k = 0; k < more && at < text.size(); ++k)
    code = code << 6U | (static_cast<unsigned char>(text[at++]) & 0x3fU);
  constexpr std::uint32_t superscript_two = 0xb2; // no sign of terminals that have ASCII alone
  return code == superscript_two ? "\\(ha2" : fmt::format("\\[u{:04X}]", code);
}

/// Text as it is read: what roff would take for its own, or set as another sign, is escaped.
std::string roff(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) >= 0x80) {
      result += special_character(text, at);
      continue;
    }
    switch (c) {
    case '\\':
      result += "\\e";
      break;
    case '-':
      result += "\\-";
      break;
    case '\'':
      result += "\\(aq";
      break;
    case '`':
      result += "\\(ga";
      break;
    case '^':
      result += "\\(ha";
      break;
    case '~':
      result += "\\(ti";
      break;
    default:
      result += c;
    }
    ++at;
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

/// The little Markdown of the paragraphs: `code` in bold, [a link](to.md) as "a link (to.md)".
std::string roff_of_markdown(std::string_view text) {
  std::string result;
  bool bold = false;
  while (!text.empty()) {
    const auto sign = text.find_first_of("`[");
    result += roff(text.substr(0, sign));
    if (sign == std::string_view::npos)
      break;
    text.remove_prefix(sign);
    const auto middle = text.find("]("), end = text.find(')');
    if (text.front() == '`') {
      result += (bold = !bold) ? "\\fB" : "\\fR";
      text.remove_prefix(1);
    } else if (middle != std::string_view::npos && end != std::string_view::npos && middle < end) {
      result += fmt::format("{}, {}", roff(text.substr(1, middle - 1)),
                            roff(text.substr(middle + 2, end - middle - 2)));
      text.remove_prefix(end + 1);
    } else {
      result += '[';
      text.remove_prefix(1);
    }
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

/// The text with a capital, unless its first word is a name with a spelling of its own.
std::string sentence(std::string_view text) {
  std::string result(text);
  const std::size_t first = text.starts_with('[') ? 1 : 0; // a link
  const std::string_view word = text.substr(first, text.find(' ', first) - first);
  if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz,:;") == std::string_view::npos)
    result[first] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[first])));
  return result.ends_with('.') ? result : result + '.';
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }

/// The names bold, what stands for the value slanted.
std::string tag_of(const OptionInfo& option) {
  if (is_placed(option))
    return "\\fI" + roff(option.place) + "\\fR";
  std::vector<std::string> names;
  for (const std::string& name : names_with_dashes(option))
    names.push_back(bold(name));
  std::string tag = fmt::format("{}", fmt::join(names, ", "));
  if (option.takes_value != TakesValue::no)
    tag += " \\fI" + roff(option.value) + "\\fR";
  return tag;
}

std::string option_entries(const Options& command) {
  std::string text;
  for (const auto& [group, options] : groups_of(command)) {
    text += fmt::format(".SS {}\n", roff(group));
    for (const OptionInfo& option : options) {
      text += fmt::format(".TP\n{}\n{}\n", tag_of(option),
                          roff_of_markdown(sentence(option.description)));
      const std::string_view details =
          option.long_names.empty() ? "" : details_of("--" + option.long_names.front());
      if (!details.empty())
        text += ".IP\n" + roff_of_markdown(sentence(details)) + '\n';
    }
  }
  return text;
}

std::string example_entries(const std::string& command) {
  std::string text;
  for (const Example& example : examples_of(command))
    text += fmt::format(".TP\n{}\n{}\n", bold(example.command),
                        roff_of_markdown(sentence(example.does)));
  return text.empty() ? "" : ".SH EXAMPLES\n" + text;
}

std::string command_entries(const Options& program) {
  std::string text;
  for (const Options* command : program.commands())
    text += fmt::format(".TP\n.BR meninas\\-{} (1)\n{}.\n", command->name(),
                        roff(command->description()));
  text += ".TP\n\\fBhelp\\fR [\\fICOMMAND\\fR]\nPrint help on the program or on a command.\n";
  return ".SH COMMANDS\n" + text;
}

std::string exit_entries() {
  std::string text = ".SH EXIT STATUS\n.TP\n.B 0\nSuccess.\n";
  for (const auto& [code, meaning] : exit_code_meanings)
    text += fmt::format(".TP\n.B {}\n{}\n", code, roff(sentence(meaning)));
  return text + ".PP\nEvery error is one line on standard error:\n"
                "\\fBmeninas: \\fIFILE\\fB: \\fIWHERE\\fB: \\fIWHAT\\fR.\n";
}

std::string references(const Options& program, const Options& command) {
  std::vector<std::string> pages;
  if (&command != &program)
    pages.emplace_back(".BR meninas (1)");
  for (const Options* other : program.commands())
    if (other != &command)
      pages.push_back(fmt::format(".BR meninas\\-{} (1)", other->name()));
  return fmt::format(".SH SEE ALSO\n{}\n.PP\nPages that end in .md are those of the folder docs, "
                     "which is\n.I share/doc/meninas/docs\nunder the prefix of the installation, "
                     "such as /usr.\n",
                     fmt::join(pages, ",\n"));
}

/// "render a scene into pictures"
std::string purpose(const Options& command) {
  std::string text = command.description();
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

} // namespace

std::string manual_page(const Options& program, const std::string& name) {
  const Options& command = command_named(program, name);
  const bool is_program = name.empty();
  const std::string page = is_program ? "meninas" : "meninas-" + name;
  std::string title = page;
  for (char& letter : title)
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  const std::string words = is_program ? "meninas" : "meninas " + name;
  const std::string uses = usage(command, words).substr(words.size());
  std::string text = fmt::format(
      ".\\\" Made by `meninas help --man{}`.\n.TH {} 1 \"\" \"Meninas {}\" \"Meninas\"\n",
      is_program ? "" : ' ' + name, roff(title), program_version());
  text +=
      fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}{}\n", roff(page),
                  roff(is_program ? "render rooms with mirrors without noise" : purpose(command)),
                  bold(words), roff(uses));
  if (is_program)
    text += ".PP\n\\fBmeninas\\fR \\fISCENE\\fR [options]\n";
  text += fmt::format(".SH DESCRIPTION\n{}.\n", roff(command.description()));
  if (is_program)
    text += command_entries(program);
  text += example_entries(name);
  text += ".SH OPTIONS\n" + option_entries(command);
  return text + exit_entries() + references(program, command);
}

} // namespace meninas
