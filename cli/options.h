// The options of the program and of its commands: how they are declared, and which of them were
// given. One source alone reads them with CLI11, which takes seconds to compile.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace meninas {

/// Groups of options that many commands have, in the help after those of their own; the last serve comparison with the
/// literature.
inline constexpr const char *light_group = "Light", *sky_group = "Sky", *file_group = "File", *run_group = "Run",
                            *study_group = "For study";

/// Thrown by an option that was a question, such as --version, once it is answered.
struct Answered {};

enum class TakesValue { no, yes, if_given };

/// An option as a help page shows it; names are without dashes.
struct OptionInfo {
  std::string place; ///< the name of an argument that is known by its place, else empty
  std::vector<std::string> short_names, long_names;
  TakesValue takes_value = TakesValue::no;
  bool repeatable = false; ///< may be given several times
  std::string value; ///< what stands for the value: N, FILE, ...
  std::string description, group;
};

/// An option of a command that is being declared.
class Option {
public:
  Option group(const std::string& name) const;
  Option required() const;
  Option excludes(const Option& other) const;
  /// The value may be left out: then it is `standing_in`.
  Option value_if_given(const std::string& standing_in) const;

private:
  friend class Options;
  explicit Option(CLI::Option& option) : option_(&option) {}
  CLI::Option* option_; ///< belongs to the options of its command
};

using TakeText = std::function<void(const std::string&)>;

struct Parsed {
  enum class Outcome { complete, wants_help, answered, wrong };
  Outcome outcome = Outcome::complete;
  std::string problem; ///< why they are wrong
};

class Options {
public:
  Options(const std::string& description, const std::string& name);
  ~Options();
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  /// A command of this program, which lives as long as the program. Its help option is the program's.
  Options& add_command(const std::string& name, const std::string& description);
  void set_help(const std::string& names, const std::string& description);

  /// An option whose text `take` parses; `value` stands for it in the help.
  /// Without dashes it is an argument that is known by its place.
  Option add(const std::string& names, const std::string& value, const std::string& description,
             const TakeText& take);
  /// The same for an option that may be given several times.
  Option add_repeatable(const std::string& names, const std::string& value,
                        const std::string& description, const TakeText& take);
  Option add_flag(const std::string& names, const std::string& description,
                  const std::function<void()>& take);

  /// Takes arguments, the last one first. Exceptions of the takers of values are passed on.
  Parsed parse(std::vector<std::string> arguments);
  /// The arguments that nothing took.
  std::vector<std::string> remaining() const;
  /// The command that was parsed, if any.
  const Options* chosen_command() const;
  /// Whether the option was given; one that the command does not have was not.
  bool given(const std::string& option) const;

  std::string name() const;
  std::string description() const;
  std::vector<OptionInfo> list() const;
  std::vector<const Options*> commands() const;

private:
  explicit Options(CLI::App& command);
  std::unique_ptr<CLI::App> program_; ///< empty for a command
  CLI::App* app_;
  std::vector<std::unique_ptr<Options>> commands_;
};

} // namespace meninas
