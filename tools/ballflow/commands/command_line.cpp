#include "commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <sstream>
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
  // What is said of the program may stand behind the command, too: ballflow run graph.json --plugin x.so
  return Command(app_->add_subcommand(name, description)->fallthrough());
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

namespace {

void declare(const Program& program, CLI::App& app) {
  app.require_subcommand(1);
  app.footer(program.footer);
  program.declare(Command(&app));
}

/// CLI11 keeps what a value may be in a text behind a colon: "TEXT:{text,csv}", "UINT:INT in [0 - 4096]".
void read_type(const std::string& text, OptionFacts& facts) {
  const std::size_t colon = text.find(':');
  facts.value = text.substr(0, colon);
  if (colon == std::string::npos) return;
  facts.limits = text.substr(colon + 1);
  if (facts.limits.size() < 2 || facts.limits.front() != '{' || facts.limits.back() != '}') return;
  std::istringstream list(facts.limits.substr(1, facts.limits.size() - 2));
  for (std::string choice; std::getline(list, choice, ',');) facts.choices.push_back(choice);
  facts.limits.clear();
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  facts.positional = option.get_positional();
  if (facts.positional) facts.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  facts.required = option.get_required();
  facts.takes_value = option.get_items_expected_max() != 0;
  facts.takes_many = option.get_items_expected_max() > 1 && option.get_allow_extra_args();
  if (facts.takes_value) read_type(option.get_type_name(), facts);
  facts.doc = option.get_description();
  return facts;
}

CommandFacts facts_of(const CLI::App& app, const std::string& program_footer) {
  CommandFacts facts;
  facts.name = app.get_name();
  facts.doc = app.get_description();
  if (app.get_footer() != program_footer) facts.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) facts.options.push_back(facts_of(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    facts.commands.push_back(facts_of(*command, program_footer));
  return facts;
}

}  // namespace

Parsed parse_command_line(int argc, char** argv, const Program& program) {
  CLI::App app{program.description, "ballflow"};
  declare(program, app);
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::ParseError& error) {
    return {true, app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage)};
  }
}

CommandFacts command_facts(const Program& program) {
  CLI::App app{program.description, "ballflow"};
  declare(program, app);
  return facts_of(app, program.footer);
}

}  // namespace ballflow::cli
