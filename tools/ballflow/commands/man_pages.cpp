#include "commands/man_pages.hpp"

#include <sstream>

namespace ballflow::cli {
namespace {

/// Text that groff prints as it is: man(7) takes a backslash, a dot or quote at the start of a line, and
/// hyphens for something else.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool starts = result.empty() || result.back() == '\n';
    if (starts && (c == '.' || c == '\'')) result += "\\&";
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
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

/// Paragraphs; indented lines are examples and stay as they are.
std::string prose(const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  bool example = false;
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.starts_with("  ");
    if (indented != example) result += indented ? ".PP\n.nf\n" : ".fi\n.PP\n";
    example = indented;
    if (line.empty()) {
      if (!example) result += ".PP\n";
    } else {
      result += escaped(line) + "\n";
    }
  }
  return result + (example ? ".fi\n" : "");
}

std::string name_of(const OptionFacts& option) {
  return option.value.empty() || option.value == "TEXT" ? option.names.front() : option.value;
}

std::string synopsis(const std::string& called, const CommandFacts& command) {
  std::string text = ".PP\n" + bold(called) + " [" + italic("options") + "]";
  if (!command.commands.empty()) text += " " + italic("command");
  for (const OptionFacts& option : command.options) {
    if (!option.positional) continue;
    const std::string name = italic(name_of(option)) + (option.takes_many ? " ..." : "");
    text += " " + (option.required ? name : "[" + name + "]");
  }
  return text + "\n";
}

std::string options(const CommandFacts& command) {
  std::string text;
  for (const bool positional : {true, false}) {
    for (const OptionFacts& option : command.options) {
      if (option.positional != positional) continue;
      text += ".TP\n";
      if (positional) {
        text += italic(name_of(option));
      } else {
        for (std::size_t i = 0; i < option.names.size(); ++i)
          text += (i == 0 ? "" : ", ") + bold(option.names[i]);
        if (option.takes_value) text += " " + italic(option.value);
      }
      text += "\n" + escaped(option.doc) + "\n";
      std::string choices;
      for (const std::string& choice : option.choices) choices += (choices.empty() ? "" : ", ") + choice;
      if (!choices.empty()) text += "(one of " + escaped(choices) + ")\n";
      if (!option.limits.empty()) text += "(" + escaped(option.limits) + ")\n";
    }
  }
  return text;
}

std::string page(const std::string& called, const CommandFacts& command, const std::string& brief,
                 const std::string& notes, const std::string& see_also) {
  std::string file = called, title;
  for (char& c : file) c = c == ' ' ? '-' : c;
  for (const char c : file) title += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  std::string text =
      ".TH " + escaped(title) + " 1 \"\" \"ballflow " BALLFLOW_VERSION "\" \"User Commands\"\n";
  text += ".SH NAME\n" + file + " \\- " + escaped(brief) + "\n";
  text += ".SH SYNOPSIS\n" + synopsis(called, command);
  text += ".SH DESCRIPTION\n" + prose(command.doc) +
          (command.footer.empty() ? "" : ".PP\n" + prose(command.footer));
  text += ".SH OPTIONS\n" + options(command);
  if (!command.commands.empty()) text += ".SH COMMANDS\n";
  for (const CommandFacts& inner : command.commands) {
    if (inner.commands.empty() && called != "ballflow") {
      text += ".SS " + escaped(inner.name) + "\n" + prose(inner.doc) +
              synopsis(called + " " + inner.name, inner) + options(inner);
    } else {
      text += ".TP\n" + bold(inner.name) + "\n" + escaped(inner.doc) + "\n";
    }
  }
  text += ".SH NOTES\n" + prose(notes);
  return text + ".SH SEE ALSO\n" + see_also + "\n";
}

}  // namespace

std::map<std::string, std::string> man_pages(const CommandFacts& program, const std::string& notes) {
  std::map<std::string, std::string> pages;
  std::string all;
  for (const CommandFacts& command : program.commands) {
    const std::string called = program.name + " " + command.name;
    all += (all.empty() ? "" : ",\n") + (".BR " + escaped(program.name + "-" + command.name) + " (1)");
    pages[program.name + "-" + command.name + ".1"] =
        page(called, command, command.doc.substr(0, command.doc.find('\n')), notes, ".BR ballflow (1)");
  }
  pages[program.name + ".1"] = page(program.name, program, "pipelines for unions of balls", notes, all);
  return pages;
}

}  // namespace ballflow::cli
