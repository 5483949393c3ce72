#include "runtime/help.hpp"

#include <fmt/format.h>

#include "runtime/options.hpp"

namespace scenec::runtime {

namespace {

std::string options_of(Verb verb) {
  std::string text;
  for (const OptionRow& row : all_options()) {
    if (!row.verbs.contains(verb)) continue;
    std::string left(row.names);
    if (const std::size_t comma = left.find(','); comma != std::string::npos) {
      left.replace(comma, 1, ", ");
    }
    if (row.need == ValueNeed::required) left += fmt::format(" {}", row.value);
    if (row.need == ValueNeed::optional) left += fmt::format("[={}]", row.value);
    text += fmt::format("  {:<26} {}\n", left, row.help);
  }
  return text.empty() ? text : "Options:\n" + text;
}

}  // namespace

std::vector<std::string_view> names_of(const OptionRow& row) {
  const std::size_t comma = row.names.find(',');
  if (comma == std::string_view::npos) return {row.names};
  return {row.names.substr(0, comma), row.names.substr(comma + 1)};
}

// The complaint about a wrong value lists the words in back quotes; there is no second list that
// could differ from it.
std::vector<std::string> choices_of(const OptionRow& row) {
  if (row.need == ValueNeed::none) return {};
  Options ignored;
  const std::string complaint = row.store(ignored, "?").value_or("");
  std::vector<std::string> choices;
  if (!complaint.starts_with("one of ")) return choices;
  for (std::size_t at = complaint.find('`'); at != std::string::npos;) {
    const std::size_t end = complaint.find('`', at + 1);
    choices.push_back(complaint.substr(at + 1, end - at - 1));
    at = complaint.find('`', end + 1);
  }
  return choices;
}

std::string general_help() {
  std::string text =
      "scenec compiles a scene description and renders it.\n\n"
      "Usage: scenec [VERB] FILE [OPTIONS]\n"
      "       scenec scene.sdl -o picture.png\n\n"
      "Verbs (`scenec VERB --help` lists the options of one):\n";
  for (const VerbInfo& verb : all_verbs()) {
    text += fmt::format("  {:<10} {:<8} {}\n", verb.name, verb.operands, verb.summary);
  }
  return text + "\n" + options_of(Verb::render) +
         "  -h, --help                 this text\n"
         "  --version                  the version\n\n"
         "Exit codes: 0 done, 1 error in the scene, 2 usage, 3 scene file or output, 4 limit,\n"
         "            5 internal error, 130 and 143 after SIGINT and SIGTERM.\n";
}

std::string help_of(Verb verb) {
  const VerbInfo& info = info_of(verb);
  const std::string options = options_of(verb);
  return fmt::format("Usage: scenec {}{}{}{}\n{}\n{}", info.name, info.operands.empty() ? "" : " ",
                     info.operands, options.empty() ? "" : " [OPTIONS]", info.summary,
                     options.empty() ? "" : "\n" + options);
}

}  // namespace scenec::runtime
