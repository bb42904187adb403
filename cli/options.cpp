#include "cli/options.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace meninas {
namespace {

TakesValue takes_value(const CLI::Option& option) {
  if (option.get_expected_max() == 0) {
    return TakesValue::no;
  }
  return option.get_expected_min() == 0 ? TakesValue::if_given : TakesValue::yes;
}

OptionInfo info_of(const CLI::Option& option) {
  return {option.get_positional() ? option.get_name(true) : "",
          option.get_snames(),
          option.get_lnames(),
          takes_value(option),
          option.get_items_expected_max() > 1,
          option.get_type_name(),
          option.get_description(),
          option.get_group()};
}

} // namespace

Option Option::group(const std::string& name) const {
  option_->group(name);
  return *this;
}

Option Option::required() const {
  option_->required();
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::value_if_given(const std::string& standing_in) const {
  option_->expected(0, 1)->default_str(standing_in);
  return *this;
}

Options::Options(const std::string& description, const std::string& name)
    : program_(std::make_unique<CLI::App>(description, name)), app_(program_.get()) {
  app_->require_subcommand(0, 1);
  app_->allow_extras();
}

Options::Options(CLI::App& command) : app_(&command) { app_->allow_extras(); }

Options::~Options() = default;

Options& Options::add_command(const std::string& name, const std::string& description) {
  commands_.emplace_back(new Options(*app_->add_subcommand(name, description)));
  return *commands_.back();
}

void Options::set_help(const std::string& names, const std::string& description) {
  app_->set_help_flag(names, description);
}

Option Options::add(const std::string& names, const std::string& value,
                    const std::string& description, const TakeText& take) {
  return Option(
      *app_->add_option_function<std::string>(names, take, description)->type_name(value));
}

Option Options::add_repeatable(const std::string& names, const std::string& value,
                               const std::string& description, const TakeText& take) {
  const auto take_all = [take](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      take(text);
    }
  };
  return Option(*app_->add_option_function<std::vector<std::string>>(names, take_all, description)
                     ->type_name(value)
                     ->allow_extra_args(!names.starts_with('-')));
}

Option Options::add_flag(const std::string& names, const std::string& description,
                         const std::function<void()>& take) {
  return Option(*app_->add_flag_callback(names, take, description));
}

Parsed Options::parse(std::vector<std::string> arguments) {
  try {
    app_->parse(arguments);
  } catch (const Answered&) {
    return {Parsed::Outcome::answered, ""};
  } catch (const CLI::CallForHelp&) {
    return {Parsed::Outcome::wants_help, ""};
  } catch (const CLI::ParseError& error) {
    return {Parsed::Outcome::wrong, error.what()};
  }
  return {};
}

std::vector<std::string> Options::remaining() const { return app_->remaining(); }

const Options* Options::chosen_command() const {
  const auto parsed = app_->get_subcommands();
  for (const auto& command : commands_) {
    if (!parsed.empty() && parsed.front() == command->app_) {
      return command.get();
    }
  }
  return nullptr;
}

bool Options::given(const std::string& option) const {
  const CLI::Option* known = app_->get_option_no_throw(option);
  return known != nullptr && known->count() > 0;
}

std::string Options::name() const { return app_->get_name(); }

std::string Options::description() const { return app_->get_description(); }

std::vector<OptionInfo> Options::list() const {
  std::vector<OptionInfo> options;
  for (const CLI::Option* option : std::as_const(*app_).get_options()) {
    options.push_back(info_of(*option));
  }
  return options;
}

std::vector<const Options*> Options::commands() const {
  std::vector<const Options*> all;
  for (const auto& command : commands_) {
    all.push_back(command.get());
  }
  return all;
}

} // namespace meninas
