// The only translation unit that knows CLI11. It is used to cut the command line into options and
// operands; checking values, naming the nearest option and exit codes are ours (CLI11 2.1 turns
// `--seed -1` into 2^64-1 and a mistyped verb into "a subcommand is required").
#include "runtime/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <deque>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>

#include "base/text.hpp"
#include "runtime/dependencies.hpp"
#include "runtime/help.hpp"

namespace scenec::runtime {

namespace {

struct VerbChoice {
  Verb verb = Verb::render;
  bool named = false;
};

// The first word is a verb, or what looks like a mistyped one: a bare word that names no file.
std::variant<VerbChoice, UsageError> choose_verb(const std::vector<std::string>& words) {
  if (words.empty() || words.front().starts_with('-')) return VerbChoice{};
  const std::string& word = words.front();
  std::vector<std::string_view> names;
  for (const VerbInfo& info : all_verbs()) {
    if (info.name == word) return VerbChoice{info.verb, true};
    names.push_back(info.name);
  }
  std::error_code ignored;
  const bool is_bare = word.find_first_of("./") == std::string::npos;
  if (!is_bare || std::filesystem::exists(word, ignored)) return VerbChoice{};
  const std::optional<std::string_view> nearest = nearest_name(word, names);
  return UsageError{
      nearest ? fmt::format("unknown verb `{}`; did you mean `{}`?", printable(word), *nearest)
              : fmt::format("`{}` is neither a file nor a verb; the verbs are {}", printable(word),
                            quoted_list(names))};
}

// CLI11 takes names of one letter, or of several behind two dashes: `-MF x` is `--MF x` to it.
constexpr std::array<std::string_view, 4> make_options{"-MD", "-MF", "-MT", "-MP"};

bool is_make_option(std::string_view name) {
  return std::find(make_options.begin(), make_options.end(), name) != make_options.end();
}

// `-MFfile`, as compilers take it, becomes `--MF=file`.
void rewrite_make_options(std::vector<std::string>& words) {
  for (std::string& word : words) {
    if (word == "--") return;
    const std::string name = word.substr(0, 3);
    if (!is_make_option(name)) continue;
    const bool is_joined = word.size() > 3 && (name == "-MF" || name == "-MT");
    if (is_joined && word[3] != '=') word.insert(3, "=");
    if (word.size() == 3 || is_joined) word.insert(0, "-");
  }
}

// A word as it was before.
std::string_view as_typed(std::string_view word) {
  const bool was_rewritten = word.starts_with("--M") && is_make_option(word.substr(1, 3)) &&
                             (word.size() == 4 || word[4] == '=');
  return was_rewritten ? word.substr(1) : word;
}

// The name as typed without its `=value`.
std::string_view name_part(std::string_view word) {
  return word.substr(0, word.find('='));
}

UsageError unknown_option(std::string_view word, Verb verb) {
  const std::string_view name = name_part(word);
  std::vector<std::string_view> known;
  for (const OptionRow& row : all_options()) {
    for (const std::string_view candidate : names_of(row)) {
      if (row.verbs.contains(verb)) {
        known.push_back(candidate);
      } else if (candidate == name) {
        return {fmt::format("`{}` is not an option of `{}`", name, info_of(verb).name)};
      }
    }
  }
  const std::optional<std::string_view> nearest = nearest_name(name, known);
  return {nearest
              ? fmt::format("unknown option `{}`; did you mean `{}`?", printable(name), *nearest)
              : fmt::format("unknown option `{}`", printable(name))};
}

// Operands in order; an unknown option is an error.
std::variant<std::vector<std::string>, UsageError> operands_of(
    const std::vector<std::string>& remaining, Verb verb) {
  std::vector<std::string> operands;
  bool options_ended = false;
  for (const std::string& word : remaining) {
    if (!options_ended && word == "--") {
      options_ended = true;
    } else if (!options_ended && word.size() > 1 && word.starts_with('-')) {
      return unknown_option(as_typed(word), verb);
    } else {
      operands.push_back(word);
    }
  }
  return operands;
}

std::optional<UsageError> find_operand_problem(const Options& options) {
  const VerbInfo& verb = info_of(options.verb);
  const bool takes_none = verb.operands.empty();
  const bool takes_scenes = verb.operands.starts_with("SCENE");
  if (takes_none && !options.operands.empty()) {
    return UsageError{fmt::format("`{}` takes no `{}`", verb.name, printable(options.operands[0]))};
  }
  const bool needs_one = !takes_none && !verb.operands.starts_with('[') && !options.list;
  const bool takes_many = verb.operands.ends_with("...");
  const bool explains_effects = options.verb == Verb::explain && !options.operands.empty() &&
                                options.operands[0] == "effects";
  if (explains_effects && options.operands.size() != 2) {
    return UsageError{options.operands.size() < 2
                          ? "`explain effects` needs the name of a scene file"
                          : "`explain effects` takes one scene at a time"};
  }
  const bool takes_two = verb.operands == "A B";
  if (takes_two && options.operands.size() != 2) {
    return UsageError{fmt::format("`{}` needs the names of two files", verb.name)};
  }
  const bool takes_file_and_scene = verb.operands == "FILE [SCENE]";
  if (takes_file_and_scene && (options.operands.empty() || options.operands.size() > 2))
    return UsageError{fmt::format("`{}` needs a picture and its scene", verb.name)};
  const bool takes_more = takes_many || takes_two || takes_file_and_scene || explains_effects;
  if (options.operands.size() > 1 && !takes_more) {
    return UsageError{fmt::format("`{}` takes one {} at a time; `{}` is a second one", verb.name,
                                  takes_scenes ? "scene" : "name",
                                  printable(options.operands[1]))};
  }
  if (needs_one && options.operands.empty()) {
    return UsageError{fmt::format("`{}` needs {}", verb.name,
                                  takes_scenes               ? "the name of a scene file"
                                  : takes_many               ? "the name of a file, or `-`"
                                  : verb.operands == "SHELL" ? "`bash`, `zsh` or `fish`"
                                                             : "the code or name of a diagnostic")};
  }
  if (takes_scenes && std::find(options.operands.begin(), options.operands.end(), "-") !=
                          options.operands.end()) {
    return UsageError{"a scene is read from a file, not from standard input"};
  }
  return std::nullopt;
}

// What CLI11 gathers for one row.
struct Gathered {
  const OptionRow* row;
  std::vector<std::string> values;
  std::string flag;
  CLI::Option* option = nullptr;
};

std::optional<UsageError> store(Options& options, Gathered& gathered) {
  const OptionRow& row = *gathered.row;
  if (gathered.option->count() == 0) return std::nullopt;
  const std::string_view name = names_of(row).back();
  if (row.need != ValueNeed::required) {
    gathered.values = {gathered.flag == "true" ? "" : gathered.flag};
    if (gathered.option->count() > 1) return UsageError{fmt::format("`{}` is given twice", name)};
    if (row.need == ValueNeed::none && !gathered.values[0].empty()) {
      return UsageError{fmt::format("`{}` takes no value", name)};
    }
  }
  if (gathered.values.size() > 1 && row.repeat == Repeat::once) {
    return UsageError{fmt::format("`{}` is given twice", name)};
  }
  for (const std::string& value : gathered.values) {
    if (value.starts_with("--")) {
      return UsageError{
          fmt::format("`{}` needs a value before `{}`", name, printable(as_typed(value)))};
    }
    if (const std::optional<std::string> expected = row.store(options, value)) {
      return UsageError{fmt::format("`{}` is `{}`; needs {}", name, printable(value), *expected)};
    }
  }
  return std::nullopt;
}

CommandLine parse_words(Verb verb, std::vector<std::string> words) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::deque<Gathered> all_gathered;  // CLI11 keeps references
  for (const OptionRow& row : all_options()) {
    if (!row.verbs.contains(verb)) continue;
    Gathered& gathered = all_gathered.emplace_back(Gathered{&row, {}, {}});
    const std::string names = (is_make_option(row.names) ? "-" : "") + std::string(row.names);
    if (row.need == ValueNeed::required) {
      gathered.option = app.add_option(names, gathered.values)->allow_extra_args(false);
    } else {
      gathered.option =
          app.add_flag(names, gathered.flag)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    }
  }
  const std::string last_word = words.empty() ? "" : words.back();
  rewrite_make_options(words);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    app.parse(words);
  } catch (const CLI::ArgumentMismatch&) {
    return UsageError{fmt::format("`{}` needs a value", printable(last_word))};
  } catch (const CLI::ParseError& error) {
    return UsageError{printable(error.what(), 200)};
  }
  Options options;
  options.verb = verb;
  auto operands = operands_of(app.remaining(), verb);
  if (auto* problem = std::get_if<UsageError>(&operands)) return *problem;
  options.operands = std::get<0>(std::move(operands));
  for (Gathered& gathered : all_gathered) {
    if (auto problem = store(options, gathered)) return *problem;
  }
  if (auto problem = find_operand_problem(options)) return *problem;
  if (auto problem = find_dependency_problem(options)) return UsageError{*std::move(problem)};
  if (auto problem = find_frame_problem(options)) return UsageError{*std::move(problem)};
  return options;
}

// Whether one of the words before `--` asks for it.
bool asks_for(const std::vector<std::string>& words, std::string_view option) {
  const auto end = std::find(words.begin(), words.end(), "--");
  return std::find(words.begin(), end, option) != end;
}

ExitCode print_usage_error(const UsageError& error, const Environment& environment) {
  environment.err << "scenec: " << error.message << "\ntry `scenec --help`\n";
  return ExitCode::usage;
}

}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& words) {
  if (words.empty()) return UsageError{"needs the name of a scene file"};
  if (asks_for(words, "--version")) return Answer{std::string(version_text) + "\n"};
  const auto choice = choose_verb(words);
  if (const auto* problem = std::get_if<UsageError>(&choice)) return *problem;
  const VerbChoice verb = std::get<VerbChoice>(choice);
  if (asks_for(words, "--help") || asks_for(words, "-h")) {
    return Answer{verb.named ? help_of(verb.verb) : general_help()};
  }
  return parse_words(verb.verb, {words.begin() + (verb.named ? 1 : 0), words.end()});
}

ExitCode run(const std::vector<std::string>& words, const Environment& environment) {
  ExitCode code = ExitCode::internal;
  try {
    const CommandLine command = parse_command_line(words);
    if (const auto* problem = std::get_if<UsageError>(&command)) {
      return print_usage_error(*problem, environment);
    }
    if (const auto* answer = std::get_if<Answer>(&command)) {
      environment.out << answer->text;
      code = ExitCode::ok;
    } else {
      code = run_verb(std::get<Options>(command), environment);
    }
  } catch (const std::bad_alloc&) {
    environment.err << "scenec: out of memory\n";
    return ExitCode::limit;
  } catch (const std::exception& error) {
    environment.err << "scenec: internal error: " << printable(error.what(), 200)
                    << "\nthis is a mistake in scenec; please report it with the scene\n";
    return ExitCode::internal;
  }
  environment.out.flush();
  if (!environment.out) {
    environment.err << "scenec: standard output cannot be written\n";
    return ExitCode::file_error;
  }
  return code;
}

}  // namespace scenec::runtime
