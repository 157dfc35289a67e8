#include "commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "ballflow/error.hpp"

namespace ballflow::cli {

Option& Option::required(bool on) {
  option_->required(on);
  return *this;
}

Option& Option::description(const std::string& text) {
  option_->description(text);
  return *this;
}

Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::one_at_a_time() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::delimiter(char separator) {
  option_->delimiter(separator);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::shows_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::between(int least, int most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::between(double least, double most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::one_of(std::initializer_list<const char*> values) {
  option_->check(CLI::IsMember(std::vector<std::string>(values.begin(), values.end())));
  return *this;
}

Command Command::subcommand(const std::string& name, const std::string& description) const {
  return Command(app_->add_subcommand(name, description));
}

void Command::requires_subcommand() const { app_->require_subcommand(1); }

Option Command::option(const std::string& names, std::string& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}

Option Command::option(const std::string& names, std::vector<std::string>& values,
                       const std::string& description) const {
  return Option(app_->add_option(names, values, description));
}

Option Command::option(const std::string& names, unsigned& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}

Option Command::option(const std::string& names, int& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}

Option Command::option(const std::string& names, std::uint64_t& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}

Option Command::option(const std::string& names, double& value, const std::string& description) const {
  return Option(app_->add_option(names, value, description));
}

Option Command::flag(const std::string& names, bool& value, const std::string& description) const {
  return Option(app_->add_flag(names, value, description));
}

Option Command::find(const std::string& name) const { return Option(app_->get_option(name)); }

void Command::footer(const std::string& text) const { app_->footer(text); }

void Command::callback(std::function<void()> function) const { app_->callback(std::move(function)); }

Parsed parse_command_line(int argc, char** argv, const std::string& description, const std::string& footer,
                          const std::function<void(const Command&)>& declare) {
  CLI::App app{description, "ballflow"};
  app.require_subcommand(1);
  app.footer(footer);
  declare(Command(&app));
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::ParseError& error) {
    return {true, app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage)};
  }
}

}  // namespace ballflow::cli
