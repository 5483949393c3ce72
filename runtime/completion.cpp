#include "runtime/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "runtime/help.hpp"

namespace scenec::runtime {

namespace {

// What an operand of a verb is completed to.
enum class Operand : std::uint8_t { source_file, shell, nothing };

Operand operand_of(const VerbInfo& verb) {
  if (verb.operands == "SCENE" || verb.operands == "FILE...") return Operand::source_file;
  return verb.operands == "SHELL" ? Operand::shell : Operand::nothing;
}

bool takes_file(const OptionRow& row) {
  return row.need == ValueNeed::required && row.value == "FILE";
}

bool takes_directory(const OptionRow& row) {
  return row.need == ValueNeed::required && row.value == "DIR";
}

template <class Words>
std::string joined(const Words& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

std::vector<std::string_view> names_of_verbs(bool (*wanted)(const VerbInfo&)) {
  std::vector<std::string_view> names;
  for (const VerbInfo& verb : all_verbs()) {
    if (wanted(verb)) names.push_back(verb.name);
  }
  return names;
}

bool is_any(const VerbInfo& /*verb*/) {
  return true;
}

std::vector<std::string_view> verbs_taking(const OptionRow& row) {
  std::vector<std::string_view> names;
  for (const VerbInfo& verb : all_verbs()) {
    if (row.verbs.contains(verb.verb)) names.push_back(verb.name);
  }
  return names;
}

// With a backslash before each of `special`.
std::string escaped(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

// Inside single quotes of bash and zsh.
std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

// ---- bash

// The branches `names) reply ;;` for the options that take a value.
std::string bash_values() {
  std::string text;
  for (const OptionRow& row : all_options()) {
    if (row.need != ValueNeed::required) continue;
    const std::vector<std::string> choices = choices_of(row);
    const std::string reply =
        !choices.empty()       ? fmt::format("_scenec_words '{}'", joined(choices, " "))
        : takes_file(row)      ? "mapfile -t COMPREPLY < <(compgen -f -- \"$current\")"
        : takes_directory(row) ? "mapfile -t COMPREPLY < <(compgen -d -- \"$current\")"
                               : ":";
    text += fmt::format("    {}) {}; return ;;\n", joined(names_of(row), "|"), reply);
  }
  return text;
}

std::string bash_options() {
  std::string text;
  for (const VerbInfo& verb : all_verbs()) {
    std::vector<std::string_view> names{"--help"};
    for (const OptionRow& row : all_options()) {
      if (!row.verbs.contains(verb.verb)) continue;
      for (const std::string_view name : names_of(row)) names.push_back(name);
    }
    text += fmt::format("      {}) _scenec_words '{}' ;;\n", verb.name, joined(names, " "));
  }
  return text;
}

std::string bash_operands() {
  std::string text;
  for (const VerbInfo& verb : all_verbs()) {
    const Operand operand = operand_of(verb);
    if (operand == Operand::source_file) continue;
    const std::string reply =
        operand == Operand::shell ? fmt::format("_scenec_words '{}'", joined(shells, " ")) : ":";
    text += fmt::format("    {}) {} ;;\n", verb.name, reply);
  }
  return text;
}

// ---- zsh

std::string zsh_option(const OptionRow& row) {
  const std::vector<std::string_view> names = names_of(row);
  const std::string help = fmt::format("[{}]", escaped(row.help, "[]:\\"));
  std::string value;
  if (row.need != ValueNeed::none) {
    const std::vector<std::string> choices = choices_of(row);
    const std::string action = !choices.empty()       ? fmt::format("({})", joined(choices, " "))
                               : takes_file(row)      ? "_files"
                               : takes_directory(row) ? "_files -/"
                                                      : " ";
    value = fmt::format("{}{}:{}", row.need == ValueNeed::optional ? "::" : ":",
                        escaped(row.value, ":\\"), action);
  }
  const std::string_view glue = row.need == ValueNeed::optional  ? "=-"
                                : row.need == ValueNeed::none    ? ""
                                : names.back().starts_with("--") ? "="
                                                                 : "";
  if (names.size() == 1) {
    const std::string_view star = row.repeat == Repeat::many ? "*" : "";
    return in_quotes(fmt::format("{}{}{}{}{}", star, names[0], glue, help, value));
  }
  return fmt::format("'({0} {1})'{0}{2} '({0} {1})'{1}{3}", names[0], names[1],
                     in_quotes(help + value), in_quotes(fmt::format("{}{}{}", glue, help, value)));
}

std::string zsh_arguments(const VerbInfo& verb) {
  std::string text = "      _arguments '--help[what scenec takes]'";
  for (const OptionRow& row : all_options()) {
    if (row.verbs.contains(verb.verb)) text += " \\\n        " + zsh_option(row);
  }
  switch (operand_of(verb)) {
    case Operand::source_file:
      text += " \\\n        '*:file:_files -g \"*.(sdl|txt)\"'";
      break;
    case Operand::shell:
      text += fmt::format(" \\\n        '1:shell:({})'", joined(shells, " "));
      break;
    case Operand::nothing:
      break;
  }
  return text + "\n";
}

// ---- fish

std::string fish_option(const OptionRow& row) {
  std::string text =
      fmt::format("complete -c scenec -n '__scenec_takes {}'", joined(verbs_taking(row), " "));
  for (const std::string_view name : names_of(row)) {
    const bool is_long = name.starts_with("--");
    const std::string_view kind = is_long ? "-l" : name.size() == 2 ? "-s" : "-o";
    text += fmt::format(" {} {}", kind, name.substr(is_long ? 2 : 1));
  }
  const std::vector<std::string> choices = choices_of(row);
  if (!choices.empty()) {
    text += fmt::format(" -x -a '{}'", joined(choices, " "));
  } else if (row.need == ValueNeed::required) {
    text += takes_file(row)        ? " -r -F"
            : takes_directory(row) ? " -x -a '(__fish_complete_directories)'"
                                   : " -x";
  }
  return fmt::format("{} -d '{}'\n", text, escaped(row.help, "'\\"));
}

}  // namespace

std::string bash_completion() {
  return fmt::format(
      R"(# Completion of scenec for bash; made by `scenec completion bash`.
_scenec_words() {{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}}
_scenec() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} verb=render
  case ${{COMP_WORDS[1]}} in
    {}) ((COMP_CWORD > 1)) && verb=${{COMP_WORDS[1]}} ;;
  esac
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = ]]; then
    previous=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  COMPREPLY=()
  case $previous in
{}  esac
  if [[ $current == -* ]]; then
    case $verb in
{}    esac
    return
  fi
  case $verb in
{}    *)
      mapfile -t COMPREPLY < <(
        compgen -f -X '!*.sdl' -- "$current"
        compgen -f -X '!*.txt' -- "$current"
        compgen -d -- "$current"
        ((COMP_CWORD == 1)) && compgen -W '{}' -- "$current"
      )
      ;;
  esac
}}
complete -o filenames -F _scenec scenec
)",
      joined(names_of_verbs(is_any), "|"), bash_values(), bash_options(), bash_operands(),
      joined(names_of_verbs(is_any), " "));
}

std::string zsh_completion() {
  std::string verbs;
  std::string branches;
  for (const VerbInfo& verb : all_verbs()) {
    verbs += fmt::format("    {}\n",
                         in_quotes(fmt::format("{}:{}", verb.name, escaped(verb.summary, ":\\"))));
    branches += fmt::format("    ({})\n{}      ;;\n", verb.name, zsh_arguments(verb));
  }
  return fmt::format(R"(#compdef scenec
# Completion of scenec for zsh; made by `scenec completion zsh`.
_scenec() {{
  local verb=render
  local -a verbs
  verbs=(
{}  )
  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
    _describe -t verbs verb verbs
    _files -g '*.(sdl|txt)'
    return
  fi
  case $words[2] in
    ({}) verb=$words[2]; shift words; (( CURRENT-- )) ;;
  esac
  case $verb in
{}  esac
}}
if [[ $funcstack[1] == _scenec ]]; then
  _scenec "$@"
else
  compdef _scenec scenec
fi
)",
                     verbs, joined(names_of_verbs(is_any), "|"), branches);
}

std::string fish_completion() {
  const auto bare =
      names_of_verbs([](const VerbInfo& verb) { return operand_of(verb) != Operand::source_file; });
  const auto of_shells =
      names_of_verbs([](const VerbInfo& verb) { return operand_of(verb) == Operand::shell; });
  std::string text = fmt::format(
      R"(# Completion of scenec for fish; made by `scenec completion fish`.
function __scenec_takes
    set -l words (commandline -opc)
    set -l verb render
    if test (count $words) -gt 1; and contains -- $words[2] {}
        set verb $words[2]
    end
    contains -- $verb $argv
end
function __scenec_at_verb
    test (count (commandline -opc)) -eq 1
end
complete -c scenec -n '__scenec_takes {}' -f
complete -c scenec -n '__scenec_takes {}' -a '{}'
)",
      joined(names_of_verbs(is_any), " "), joined(bare, " "), joined(of_shells, " "),
      joined(shells, " "));
  for (const VerbInfo& verb : all_verbs()) {
    text += fmt::format("complete -c scenec -n __scenec_at_verb -a {} -d '{}'\n", verb.name,
                        escaped(verb.summary, "'\\"));
  }
  for (const OptionRow& row : all_options()) text += fish_option(row);
  return text;
}

}  // namespace scenec::runtime
