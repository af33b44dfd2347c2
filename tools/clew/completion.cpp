// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "clew/command_tables.hpp"

namespace clew::tools {
namespace {

// Completes the words of the tables of commands. _clew_words prints, for the commands typed so far,
// the words that may follow; _clew_list which list a value is chosen from.
constexpr char kBashFunction[] = R"sh(_clew() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} commands= i list
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] && break
    [[ -n $(_clew_words "${commands:+$commands }${COMP_WORDS[i]}") ]] || break
    commands="${commands:+$commands }${COMP_WORDS[i]}"
  done
  list=$(_clew_list "$commands $before")
  if [[ -z $list && $word != -* && $before != -* ]]; then list=$(_clew_list "$commands"); fi
  if [[ -n $list ]]; then
    COMPREPLY=($(compgen -W \
      "$("${COMP_WORDS[0]}" list "$list" 2>/dev/null | cut -d' ' -f1)" -- "$word"))
  elif [[ $word == -* || -z $commands || $commands == train || $commands == world ]]; then
    COMPREPLY=($(compgen -W "$(_clew_words "$commands")" -- "$word"))
  fi
}
complete -o default -F _clew clew
)sh";

constexpr char kZshFunction[] = R"sh(_clew() {
  local commands= i list before=${words[CURRENT-1]}
  for ((i = 2; i < CURRENT; ++i)); do
    [[ ${words[i]} == -* ]] && break
    [[ -n $(_clew_words "${commands:+$commands }${words[i]}") ]] || break
    commands="${commands:+$commands }${words[i]}"
  done
  list=$(_clew_list "$commands $before")
  if [[ -z $list && $PREFIX != -* && $before != -* ]]; then list=$(_clew_list "$commands"); fi
  if [[ -n $list ]]; then
    compadd -- ${(f)"$(${words[1]} list $list 2>/dev/null | cut -d' ' -f1)"}
  elif [[ $PREFIX == -* || -z $commands || $commands == train || $commands == world ]]; then
    compadd -- ${=$(_clew_words "$commands")}
  else
    _files
  fi
}
_clew "$@"
)sh";

std::string typed_after_program(const CLI::App& app) {
  if (app.get_parent() == nullptr) return {};
  const std::string before = typed_after_program(*app.get_parent());
  return before.empty() ? app.get_name() : before + ' ' + app.get_name();
}

/// A line of a shell's `case` for each command: its commands and options.
std::string word_cases(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command : shown_commands(app)) words += ' ' + command->get_name();
  for (const CLI::Option* option : shown_options(app)) {
    for (const std::string& name : names_of(*option)) words += ' ' + name;
  }
  std::string cases =
      "    \"" + typed_after_program(app) + "\") echo '" + words.substr(1) + "' ;;\n";
  for (const CLI::App* command : shown_commands(app)) cases += word_cases(*command);
  return cases;
}

/// Which list a value is chosen from: `run`, for its first argument, or `run --world`.
std::string list_cases(const CLI::App& app) {
  std::string cases;
  const std::string typed = typed_after_program(app);
  for (const CLI::Option* argument : arguments_of(app)) {
    const std::string list = list_for(app, *argument);
    if (!list.empty()) cases += "    \"" + typed + "\") echo " + list + " ;;\n";
  }
  for (const CLI::Option* option : shown_options(app)) {
    const std::string list = list_for(app, *option);
    if (list.empty()) continue;
    for (const std::string& name : names_of(*option)) {
      cases += "    \"" + typed + ' ' + name + "\") echo " + list + " ;;\n";
    }
  }
  for (const CLI::App* command : shown_commands(app)) cases += list_cases(*command);
  return cases;
}

std::string tables(const CLI::App& program) {
  return "_clew_words() {\n  case \"$1\" in\n" + word_cases(program) + "  esac\n}\n" +
         "_clew_list() {\n  case \"$1\" in\n" + list_cases(program) + "  esac\n}\n";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  return "# bash completion of clew, made by 'clew completion bash'.\n" + tables(program) +
         kBashFunction;
}

std::string zsh_completion(const CLI::App& program) {
  return "#compdef clew\n# zsh completion of clew, made by 'clew completion zsh'.\n" +
         tables(program) + kZshFunction;
}

}  // namespace clew::tools
