#include "commands/hidden.hpp"

#include <cstdio>
#include <filesystem>

#include "ballflow/output_file.hpp"
#include "commands/completions.hpp"
#include "commands/man_pages.hpp"

namespace ballflow::cli {

bool is_hidden(const std::string& command) { return command.starts_with("__"); }

int run_hidden(const Program& program, const Common& common, const std::vector<std::string>& words) {
  if (words.front() == "__complete") {
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    std::fputs(completions(command_facts(program), common, rest).c_str(), stdout);
    return 0;
  }
  if (words.front() == "__share" && words.size() == 2) {
    std::map<std::string, std::string> files = {
        {"bash-completion/completions/ballflow", completion_script("bash")},
        {"zsh/site-functions/_ballflow", completion_script("zsh")},
        {"fish/vendor_completions.d/ballflow.fish", completion_script("fish")}};
    for (const auto& [name, text] : man_pages(command_facts(program), program.footer))
      files["man/man1/" + name] = text;
    for (const auto& [name, text] : files) {
      const std::filesystem::path file = std::filesystem::path(words[1]) / name;
      std::filesystem::create_directories(file.parent_path());
      write_atomically(file.string(), text);
    }
    return 0;
  }
  throw Error(ExitCode::usage, "there is no command \"" + words.front() + "\"",
              "\"ballflow --help\" lists them");
}

}  // namespace ballflow::cli
