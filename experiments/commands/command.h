// The command line: the part of CLI11 that the program needs, without CLI11's headers, which take seconds to compile.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiments/system/exit_code.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the name is CLI11's
class App;
class Option;
}  // namespace CLI

namespace deliso {

// An option that takes a value. Every function returns the option, so that calls can be chained.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option& option) : option_(&option) {}

  // The name of the value in the help; empty: no name.
  CommandOption& type_name(const std::string& name);
  CommandOption& required();
  // `refusal` returns an error text for a value as typed, or nothing.
  CommandOption& check(std::string (*refusal)(const std::string& value));
  // The help shows the present value of the variable as the default.
  CommandOption& show_default();
  // It may be given several times, each time with one value.
  CommandOption& repeatable();

 private:
  CLI::Option* option_;
};

// Variables that options set must live until the command line is parsed.
class Command {
 public:
  explicit Command(CLI::App& command) : command_(&command) {}

  // A name without dashes is that of an argument by position.
  CommandOption add_option(const std::string& names, std::string& value, const std::string& help);
  CommandOption add_option(const std::string& names, std::vector<std::string>& values, const std::string& help);
  void add_flag(const std::string& names, bool& value, const std::string& help);
  // The last paragraphs of the help: `remarks`, if any, and under the word "Examples" the command lines of `lines`.
  void examples(const std::string& lines, const std::string& remarks = "");
  // A flag that prints a text instead of running the command.
  void add_help(const std::string& name, const std::string& help, std::function<std::string()> text);
  // Sets what the command does, which runs while the command line is parsed; `exit_code` receives the result.
  void callback(ExitCode& exit_code, std::function<ExitCode()> action);

 private:
  CLI::App* command_;
};

// All commands.
class CommandLine {
 public:
  // `description` and `footer` are the first and last text of `deliso --help`, `version` is that of `deliso --version`.
  CommandLine(const std::string& description, const std::string& footer, std::function<std::string()> version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // A command without options yet.
  Command add_command(const std::string& name, const std::string& help);
  // Runs the command that the arguments name, or prints help or version. Throws InputError, naming the nearest known
  // name for an unknown one, and whatever the command throws.
  void parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace deliso
