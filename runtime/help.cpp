#include "runtime/help.hpp"

#include <fmt/format.h>

#include "runtime/options.hpp"

namespace scenec::runtime {

namespace {

std::string options_of(Verb verb) {
  std::string text = "Options:\n";
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
  return text;
}

}  // namespace

std::string general_help() {
  std::string text =
      "scenec compiles a scene description and renders it.\n\n"
      "Usage: scenec [VERB] FILE [OPTIONS]\n"
      "       scenec scene.sdl -o picture.png\n\n"
      "Verbs (`scenec VERB --help` lists the options of one):\n";
  for (const VerbInfo& verb : all_verbs()) {
    text += fmt::format("  {:<8} {:<8} {}\n", verb.name, verb.operands, verb.summary);
  }
  return text + "\n" + options_of(Verb::render) +
         "  -h, --help                 this text\n"
         "  --version                  the version\n\n"
         "Exit codes: 0 done, 1 error in the scene, 2 usage, 3 scene file or output, 4 limit,\n"
         "            5 internal error, 130 and 143 after SIGINT and SIGTERM.\n";
}

std::string help_of(Verb verb) {
  const VerbInfo& info = info_of(verb);
  return fmt::format("Usage: scenec {} {} [OPTIONS]\n{}\n\n{}", info.name, info.operands,
                     info.summary, options_of(verb));
}

}  // namespace scenec::runtime
