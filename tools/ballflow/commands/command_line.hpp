// Options, flags and subcommands, as the commands declare them. CLI11 does the work behind it, in one
// translation unit: its header costs every file that includes it four seconds.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ballflow::cli {

/// An option of a command; a view, to be copied freely.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required(bool on = true);
  Option& description(const std::string& text);
  /// What stands for the value in the help.
  Option& type_name(const std::string& name);
  /// An option of a list takes one value each time it is written, so that positional arguments may follow it.
  Option& one_at_a_time();
  Option& delimiter(char separator);
  Option& excludes(const Option& other);
  /// The value that the variable has now is shown in the help.
  Option& shows_default();
  Option& between(int least, int most);
  Option& between(double least, double most);
  Option& one_of(std::initializer_list<const char*> values);

 private:
  CLI::Option* option_;
};

/// A command or a group of commands; a view, to be copied freely.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}
  Command subcommand(const std::string& name, const std::string& description) const;
  /// One of the subcommands has to be named.
  void requires_subcommand() const;
  /// `names`: "--out", "-o,--output", or "graph" for a positional argument. The variable keeps its value when
  /// the option is not given.
  Option option(const std::string& names, std::string& value, const std::string& description) const;
  Option option(const std::string& names, std::vector<std::string>& values,
                const std::string& description) const;
  Option option(const std::string& names, unsigned& value, const std::string& description) const;
  Option option(const std::string& names, int& value, const std::string& description) const;
  Option option(const std::string& names, std::uint64_t& value, const std::string& description) const;
  Option option(const std::string& names, double& value, const std::string& description) const;
  Option flag(const std::string& names, bool& value, const std::string& description) const;
  /// An option that was declared before.
  Option find(const std::string& name) const;
  void footer(const std::string& text) const;
  /// What to do when this command was named and everything was understood.
  void callback(std::function<void()> function) const;

 private:
  CLI::App* app_;
};

/// The program: what its help begins and ends with, and what adds its commands.
struct Program {
  std::string description, footer;
  std::function<void(const Command&)> declare;
};

/// Parses the arguments. Empty when a command was found; otherwise the exit code: of --help, or of wrong
/// usage, which was printed.
struct Parsed {
  bool done = false;  // nothing is left to be done
  int exit_code = 0;
};
Parsed parse_command_line(int argc, char** argv, const Program& program);

/// What is known of an option, for completion and man pages.
struct OptionFacts {
  std::vector<std::string> names;  // "-o", "--output"; of a positional argument its name
  bool positional = false, required = false;
  bool takes_value = false;  // is no flag
  bool takes_many = false;   // all words up to the next option
  std::string value;         // what stands for the value: "DIR", "TEXT"
  std::string limits;        // "INT in [0 - 4096]"; empty where choices say it
  std::vector<std::string> choices;
  std::string doc;
};
struct CommandFacts {
  std::string name, doc;
  std::string footer;  // its own; empty where it is that of the program
  std::vector<OptionFacts> options;
  std::vector<CommandFacts> commands;
};
CommandFacts command_facts(const Program& program);

}  // namespace ballflow::cli
