#include "cli/help/completion.h"

#include "cli/help/option_text.h"
#include "cli/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <sstream>

namespace meninas {
namespace {

/// Kinds of values that a shell can complete.
enum class ValueKind { unknown, choice, file, folder, scene, jobs };

ValueKind kind_of(const OptionInfo& option) {
  const std::string& text = is_placed(option) ? option.place : option.value;
  const bool has_names =
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_|") == std::string::npos;
  if (text.find('|') != std::string::npos && has_names)
    return ValueKind::choice;
  if (text == "DIR")
    return ValueKind::folder;
  if (text == "SCENE")
    return ValueKind::scene;
  if (text == "JOBS" || text == "CASES")
    return ValueKind::jobs;
  return text == "FILE" || is_placed(option) ? ValueKind::file : ValueKind::unknown;
}

std::vector<std::string> choices_of(const OptionInfo& option) {
  std::vector<std::string> choices;
  std::istringstream text(option.value);
  for (std::string choice; std::getline(text, choice, '|');)
    choices.push_back(choice);
  return choices;
}

/// Ends of the names of files that are scenes, and that hold jobs or cases.
std::vector<std::string> endings_of(ValueKind kind) {
  switch (kind) {
  case ValueKind::scene:
    return {"gltf", "glb"};
  case ValueKind::jobs:
    return {"json"};
  default:
    return {};
  }
}

/// The options of a command with --help-all, which they do not list; arguments known by their place are apart.
std::vector<OptionInfo> named_options(const Options& command) {
  std::vector<OptionInfo> options = command.list();
  std::erase_if(options, is_placed);
  OptionInfo all;
  all.long_names = {"help-all"};
  all.description = "print help with all options";
  options.push_back(all);
  return options;
}

std::vector<OptionInfo> places_of(const Options& command) {
  std::vector<OptionInfo> options = command.list();
  std::erase_if(options, std::not_fn(is_placed));
  return options;
}

/// Name and purpose of each command, with the two words that are answered as options are.
std::vector<std::pair<std::string, std::string>> command_words(const Options& program) {
  std::vector<std::pair<std::string, std::string>> words;
  for (const Options* command : program.commands())
    words.emplace_back(command->name(), command->description());
  words.emplace_back("help", "Print help on the program or on a command");
  words.emplace_back("version", "Print the version");
  return words;
}

std::string names_of_commands(const Options& program) {
  std::string text;
  for (const Options* command : program.commands())
    text += (text.empty() ? "" : " ") + command->name();
  return text;
}

/// A word of a shell that no character of is special.
std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4)
    text.replace(at, 1, "'\\''");
  return '\'' + text + '\'';
}

constexpr const char* bash_head =
    R"(# bash completion for meninas, made by `meninas help --completion bash`

# _meninas_files WORD [ENDING...]: files with one of the endings, and folders; any file where there is none.
_meninas_files() {
  local word=$1 ending
  shift
  compopt -o filenames -o plusdirs
  for ending in "$@"; do
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X "!*.$ending" -- "$word")
  done
  ((${#COMPREPLY[@]})) || compopt -o default
}

_meninas() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local options='' choices='' endings=()
  # Of --option=value bash makes three words.
  if [[ $word == = ]]; then
    word=
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  COMPREPLY=()
  case $command in *.gltf | *.glb) command=render ;; esac
  ((COMP_CWORD > 1)) || command=
  case $command in
)";

constexpr const char* bash_tail = R"(  esac
  if [[ -n $choices ]] && { [[ $word != -* ]] || [[ -z $options ]]; }; then
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
    ((${#COMPREPLY[@]} || COMP_CWORD > 1)) || _meninas_files "$word" gltf glb
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    _meninas_files "$word" "${endings[@]}"
  fi
}
complete -F _meninas meninas
)";

std::string all_names(const std::vector<OptionInfo>& options) {
  std::vector<std::string> names;
  for (const OptionInfo& option : options)
    for (const std::string& name : names_with_dashes(option))
      names.push_back(name);
  return fmt::format("{}", fmt::join(names, " "));
}

/// What is done about an option's value.
std::string bash_action(const OptionInfo& option) {
  switch (kind_of(option)) {
  case ValueKind::choice:
    return fmt::format("options='' choices='{}'", fmt::join(choices_of(option), " "));
  case ValueKind::folder:
    return "compopt -o dirnames && return";
  case ValueKind::unknown:
    return "return";
  default:
    return "_meninas_files \"$word\" && return";
  }
}

/// What follows the options that take a value, as arms of a `case`.
std::string bash_values(const std::vector<OptionInfo>& options) {
  std::vector<std::pair<std::string, std::vector<std::string>>> arms;
  for (const OptionInfo& option : options) {
    if (option.takes_value != TakesValue::yes)
      continue;
    const std::string action = bash_action(option);
    auto arm = std::ranges::find(arms, action, [](const auto& one) { return one.first; });
    if (arm == arms.end())
      arm = arms.insert(arms.end(), {action, {}});
    std::ranges::copy(names_with_dashes(option), std::back_inserter(arm->second));
  }
  std::string text;
  for (const auto& [action, names] : arms)
    text += fmt::format("        {}) {} ;;\n", fmt::join(names, " | "), action);
  return text;
}

std::string bash_script(const Options& program) {
  const std::string commands = names_of_commands(program);
  std::string text = bash_head;
  text += fmt::format("    '') choices='{} help version' options='{}' ;;\n    help) choices='{}' "
                      ";;\n    version) return ;;\n",
                      commands, all_names(named_options(program)), commands);
  for (const Options* command : program.commands()) {
    const std::vector<OptionInfo> options = named_options(*command), places = places_of(*command);
    text += fmt::format("    {})\n      options='{}'\n", command->name(), all_names(options));
    if (!places.empty())
      text +=
          fmt::format("      endings=({})\n", fmt::join(endings_of(kind_of(places.front())), " "));
    text += "      case $before in\n";
    text += bash_values(options) + "      esac ;;\n";
  }
  return text + bash_tail;
}

/// The text with a backslash before each of these signs.
std::string escaped(std::string text, const char* signs) {
  for (std::size_t at = 0; (at = text.find_first_of(signs, at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

/// "_files -g ..." and the like, as zsh completes a value.
std::string zsh_action(const OptionInfo& option) {
  switch (const ValueKind kind = kind_of(option)) {
  case ValueKind::choice:
    return fmt::format("({})", fmt::join(choices_of(option), " "));
  case ValueKind::folder:
    return "_directories";
  case ValueKind::file:
    return "_files";
  case ValueKind::unknown:
    return " ";
  default:
    return fmt::format("_files -g \"*.{}\"", fmt::join(endings_of(kind), " *."));
  }
}

/// An option as _arguments wants it: one line for each of its names, which exclude one another unless it may be repeated.
std::string zsh_option(const OptionInfo& option) {
  std::string text;
  const std::vector<std::string> names = names_with_dashes(option);
  for (const std::string& name : names) {
    std::string line = option.repeatable ? "*" : fmt::format("({})", fmt::join(names, " "));
    line += name;
    if (option.takes_value != TakesValue::no)
      line += option.takes_value == TakesValue::if_given ? "=-"
              : name.starts_with("--")                   ? "="
                                                         : "+";
    line += '[' + escaped(option.description, "[]\\") + ']';
    if (option.takes_value != TakesValue::no)
      line += fmt::format("{}{}:{}", option.takes_value == TakesValue::if_given ? "::" : ":",
                          escaped(option.value, ":\\"), zsh_action(option));
    text += "        " + quoted(line) + " \\\n";
  }
  return text;
}

std::string zsh_arguments(const Options& command) {
  std::string text = "      _arguments -S \\\n";
  for (const OptionInfo& option : named_options(command))
    text += zsh_option(option);
  int place = 0;
  for (const OptionInfo& option : places_of(command))
    text += fmt::format("        {} \\\n",
                        quoted(fmt::format("{}:{}:{}", ++place, option.place, zsh_action(option))));
  text.resize(text.size() - 3);
  return text + " ;;\n";
}

std::string zsh_script(const Options& program) {
  std::string text =
      "#compdef meninas\n# zsh completion for meninas, made by `meninas help --completion zsh`\n\n"
      "_meninas() {\n  local -a commands=(\n";
  for (const auto& [word, purpose] : command_words(program))
    text += "    " + quoted(word + ':' + escaped(purpose, ":\\")) + '\n';
  text += "  )\n  if ((CURRENT == 2)); then\n"
          "    if [[ $words[2] == -* ]]; then\n";
  text += "      compadd -- " + all_names(named_options(program)) + '\n';
  text += "    else\n      _describe -t commands command commands\n      _files -g "
          "'*.gltf *.glb'\n    fi\n    return\n  fi\n"
          "  local command=$words[2]\n"
          "  case $command in\n    *.gltf|*.glb) command=render ;;\n"
          "    *) shift words; ((CURRENT--)) ;;\n  esac\n  case $command in\n"
          "    help) _describe -t commands command commands ;;\n";
  for (const Options* command : program.commands())
    text += fmt::format("    {})\n{}", command->name(), zsh_arguments(*command));
  return text + "  esac\n}\n\nif [[ $funcstack[1] == _meninas ]]; then\n  _meninas \"$@\"\nelse\n  "
                "compdef _meninas meninas\nfi\n";
}

/// An option of a command, one line.
std::string fish_option(const OptionInfo& option, const std::string& condition) {
  std::string line = "complete -c meninas -n " + quoted(condition);
  for (const std::string& name : option.short_names)
    line += " -s " + name;
  for (const std::string& name : option.long_names)
    line += " -l " + name;
  if (option.takes_value == TakesValue::yes) {
    switch (kind_of(option)) {
    case ValueKind::choice:
      line += fmt::format(" -x -a '{}'", fmt::join(choices_of(option), " "));
      break;
    case ValueKind::folder:
      line += " -x -a '(__fish_complete_directories)'";
      break;
    case ValueKind::unknown:
      line += " -x";
      break;
    default:
      line += " -r -F";
    }
  }
  return line + " -d " + quoted(option.description) + '\n';
}

constexpr const char* fish_head =
    R"(# fish completion for meninas, made by `meninas help --completion fish`

# Whether the command is this one, or '' where it is still to come; a scene without a command is rendered.
function __meninas_is
    set -l words (commandline -opc)
    set -l command $words[2]
    string match -qr '[.](gltf|glb)$' -- "$command"; and set command render
    test "$command" = "$argv[1]"
end

complete -c meninas -f
)";

/// Files with these endings, as fish lists them, and folders.
std::string fish_files(ValueKind kind) {
  std::vector<std::string> lists;
  for (const std::string& ending : endings_of(kind))
    lists.push_back(fmt::format("(__fish_complete_suffix .{})", ending));
  return lists.empty() ? "-F" : fmt::format("-k -a '{}'", fmt::join(lists, " "));
}

std::string fish_script(const Options& program) {
  std::string text = fish_head;
  const std::string line = "complete -c meninas -n ", first = "__meninas_is ''";
  for (const auto& [word, purpose] : command_words(program))
    text += fmt::format("{}{} -a {} -d {}\n", line, quoted(first), word, quoted(purpose));
  text += fmt::format("{}{} {}\n", line, quoted(first), fish_files(ValueKind::scene));
  for (const OptionInfo& option : named_options(program))
    text += fish_option(option, first);
  text += fmt::format("{}'__meninas_is help' -a '{}'\n", line, names_of_commands(program));
  for (const Options* command : program.commands()) {
    const std::string condition = "__meninas_is " + command->name();
    text += '\n';
    for (const OptionInfo& option : named_options(*command))
      text += fish_option(option, condition);
    if (const auto places = places_of(*command); !places.empty())
      text +=
          fmt::format("{}{} {}\n", line, quoted(condition), fish_files(kind_of(places.front())));
  }
  return text;
}

} // namespace

std::string completion_script(const Options& program, const std::string& shell) {
  const Choices<std::string (*)(const Options&)> shells{
      {"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}};
  return parse_choice("--completion", shell, shells)(program);
}

} // namespace meninas
