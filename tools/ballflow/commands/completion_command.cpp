// Completion for shells. The scripts ask the program itself, so that they know every command, graph and node
// of the version that is called: "ballflow __complete WORD..." (completions.hpp).
#include <cstdio>

#include "commands/commands.hpp"
#include "commands/completions.hpp"

namespace ballflow::cli {
namespace {

constexpr const char* bash =
    R"script(# Completion of ballflow for bash: source it, or put it into a folder of completions.
_ballflow() {
  local words=() word rest=${COMP_LINE:0:COMP_POINT} trimmed i
  # Bash splits words at "=" and ":" too: what no blank separates is one word.
  for ((i = 0; i <= COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    trimmed=${rest#"${rest%%[![:space:]]*}"}
    ((${#word} > ${#trimmed})) && word=$trimmed
    if ((i == 0)) || [[ $trimmed != "$rest" ]]; then
      words+=("$word")
    else
      words[${#words[@]} - 1]+=$word
    fi
    rest=${trimmed#"$word"}
  done
  local current=${words[${#words[@]} - 1]} known='' path line
  # What bash takes for an earlier word must not be in the reply.
  case $COMP_WORDBREAKS in
    *=*:* | *:*=*) known=${current%"${current##*[=:]}"} ;;
    *=*) known=${current%"${current##*=}"} ;;
    *:*) known=${current%"${current##*:}"} ;;
  esac
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
      :files | :folders)
        path=${current#*=}
        [[ $line == :files ]] && i=-f || i=-d
        compopt -o filenames
        while IFS= read -r word; do
          COMPREPLY+=("${word#"${path%"${current#"$known"}"}"}")
        done < <(compgen "$i" -- "$path")
        ;;
      :) ;;
      *)
        word=${line%%$'\t'*}
        [[ $word == *= ]] && compopt -o nospace
        COMPREPLY+=("${word#"$known"}")
        ;;
    esac
  done < <("${words[0]/#\~/$HOME}" __complete "${words[@]:1}" 2>/dev/null)
}
complete -F _ballflow ballflow
)script";

constexpr const char* zsh = R"script(#compdef ballflow
# Completion of ballflow for zsh: a file _ballflow in a folder of $fpath, or sourced after compinit.
_ballflow() {
  local line word doc paths='' program=${~words[1]}
  local -a plain plain_docs open open_docs
  while IFS= read -r line; do
    if [[ $line == :* ]]; then
      paths=${line#:}
      continue
    fi
    word=${line%%$'\t'*} doc=${line#*$'\t'}
    if [[ $word == *= ]]; then
      open+=("$word") open_docs+=("$word  $doc")
    else
      plain+=("$word") plain_docs+=("$word  $doc")
    fi
  done < <($program __complete "${(@Q)words[2,CURRENT-1]}" "$PREFIX" 2>/dev/null)
  (($#open)) && compadd -l -S '' -d open_docs -a open
  (($#plain)) && compadd -l -d plain_docs -a plain
  [[ -n $paths ]] && compset -P '*='
  [[ $paths == files ]] && _files
  [[ $paths == folders ]] && _files -/
  return 0
}
if [[ $funcstack[1] == _ballflow ]]; then
  _ballflow "$@"
else
  compdef _ballflow ballflow
fi
)script";

constexpr const char* fish =
    R"script(# Completion of ballflow for fish: a file ballflow.fish in a folder of completions, or sourced.
function __ballflow_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l before (string match -r '^[^=]*=' -- $current)
    set -l value (string replace -r '^[^=]*=' '' -- $current)
    for line in ($words[1] __complete $words[2..-1] "$current" 2>/dev/null)
        switch $line
            case ':'
            case ':files'
                for path in (__fish_complete_path "$value")
                    echo -- "$before$path"
                end
            case ':folders'
                for path in (__fish_complete_directories "$value" '')
                    echo -- "$before$path"
                end
            case '*'
                echo -- $line
        end
    end
end
complete -c ballflow -f -a '(__ballflow_complete)'
)script";

int print_script(const std::string& shell) {
  std::fputs(completion_script(shell).c_str(), stdout);
  return 0;
}

}  // namespace

std::string completion_script(const std::string& shell) {
  return shell == "bash" ? bash : shell == "zsh" ? zsh : fish;
}

void add_completion(const Command& app, Common&, Action& action) {
  const Command command =
      app.subcommand("completion", "print the script with which a shell completes command lines of ballflow");
  const auto shell = std::make_shared<std::string>();
  command.option("shell", *shell, "the shell").required().type_name("SHELL").one_of({"bash", "zsh", "fish"});
  command.footer(
      "  source <(ballflow completion bash)             # in ~/.bashrc\n"
      "  source <(ballflow completion zsh)              # in ~/.zshrc, after compinit\n"
      "  ballflow completion fish | source              # in ~/.config/fish/config.fish\n"
      "A Debian package brings them along.");
  command.callback([&action, shell] { action = [shell] { return print_script(*shell); }; });
}

}  // namespace ballflow::cli
