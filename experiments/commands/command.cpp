#include "experiments/commands/command.h"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"

namespace deliso {
namespace {

// Names an unknown command; CLI11 would only say that a command is missing.
void check_first_argument(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2) return;
  const std::string_view name = argv[1];
  if (name.starts_with('-')) {
    if (name == "--version" || name == "--help" || name == "-h") return;
    throw InputError("unknown option '" + std::string(name) + "', expected a command first (deliso --help lists all)");
  }
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw InputError("unknown command '" + std::string(name) + "', the nearest is '" + nearest_name(name, names) +
                   "' (deliso --help lists all)");
}

const CLI::App* find_command(const CLI::App& app, std::string_view name) {
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

// Names a misspelt option; CLI11 would first name the required options that are missing.
void check_option_names(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = argc < 2 ? nullptr : find_command(app, argv[1]);
  if (command == nullptr) return;
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (int i = 2; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::string_view name = argument.substr(0, argument.find('='));
    if (name == "--") return;
    if (!name.starts_with("--") || std::find(names.begin(), names.end(), name) != names.end()) continue;
    const auto longer = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.starts_with(name); });
    throw InputError("unknown option '" + std::string(name) + "' of " + argv[1] + ", the nearest is '" +
                     (longer != names.end() ? *longer : nearest_name(name, names)) + "' (deliso " + argv[1] +
                     " --help lists all)");
  }
}

const CLI::Option* find_option(const CLI::App& command, const std::string& name) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && option->check_name(name)) return option;
  }
  return nullptr;
}

// Names an option without its value; CLI11 would take the next option for the value, and miss that one.
void check_option_values(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = argc < 2 ? nullptr : find_command(app, argv[1]);
  if (command == nullptr) return;
  for (int i = 2; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--") return;
    const CLI::Option* option = name.starts_with('-') ? find_option(*command, name) : nullptr;
    if (option == nullptr || option->get_items_expected_max() == 0) continue;
    const std::string value = i + 1 < argc ? argv[i + 1] : "";
    const bool is_missing = i + 1 == argc || (value.starts_with('-') && find_option(*command, value) != nullptr);
    if (is_missing)
      throw InputError(
          name + ": expected a value" +
          (i + 1 == argc ? std::string(", found the end of the command line") : ", found the option '" + value + "'"));
    ++i;
  }
}

// Names an option that was given more often than it takes values; empty when there is none.
std::string repeated_option(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      const std::size_t count = option->count();
      if (option->get_items_expected_max() != 1 || count < 2) continue;
      const bool is_all_taken = option->get_multi_option_policy() != CLI::MultiOptionPolicy::Throw;
      if (is_all_taken) continue;
      return option->get_name() + " was given " + (count == 2 ? "twice" : std::to_string(count) + " times") +
             ", expected once";
    }
  }
  return "";
}

}  // namespace

CommandOption& CommandOption::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption& CommandOption::check(std::string (*refusal)(const std::string& value)) {
  option_->check(refusal);
  return *this;
}

CommandOption& CommandOption::show_default() {
  option_->capture_default_str();
  return *this;
}

CommandOption& CommandOption::repeatable() {
  option_->take_all()->allow_extra_args(false);
  return *this;
}

CommandOption Command::add_option(const std::string& names, std::string& value, const std::string& help) {
  return CommandOption(*command_->add_option(names, value, help));
}

CommandOption Command::add_option(const std::string& names, std::vector<std::string>& values, const std::string& help) {
  return CommandOption(*command_->add_option(names, values, help));
}

void Command::add_flag(const std::string& names, bool& value, const std::string& help) {
  command_->add_flag(names, value, help);
}

void Command::examples(const std::string& lines, const std::string& remarks) {
  std::string text = remarks + (remarks.empty() ? "Examples:" : "\n\nExamples:");
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) text += "\n  " + line;
  command_->footer(text);
}

void Command::add_help(const std::string& name, const std::string& help, std::function<std::string()> text) {
  command_->add_flag_callback(
      name,
      [text = std::move(text)] {
        std::cout << text();
        throw CLI::Success();
      },
      help);
}

void Command::callback(ExitCode& exit_code, std::function<ExitCode()> action) {
  command_->callback([action = std::move(action), &exit_code] { exit_code = action(); });
}

CommandLine::CommandLine(const std::string& description, const std::string& footer,
                         std::function<std::string()> version)
    : app_(std::make_unique<CLI::App>(description, "deliso")) {
  app_->set_version_flag("--version", std::move(version));
  app_->require_subcommand(1);
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

Command CommandLine::add_command(const std::string& name, const std::string& help) {
  return Command(*app_->add_subcommand(name, help));
}

void CommandLine::parse(int argc, const char* const* argv) {
  check_first_argument(*app_, argc, argv);
  check_option_names(*app_, argc, argv);
  check_option_values(*app_, argc, argv);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help or --version
    app_->exit(request);
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string repeated = repeated_option(*app_);
    throw InputError((repeated.empty() ? error.what() : repeated) + " (deliso --help tells more)");
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + " (deliso --help tells more)");
  }
}

}  // namespace deliso
