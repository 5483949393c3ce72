// The manual page, from the tables of verbs, options and exit codes.
#include <fmt/format.h>

#include "runtime/cli.hpp"
#include "runtime/help.hpp"

namespace scenec::runtime {

namespace {

// Text as roff takes it: `-` and `\` are written out, a line does not begin with a control
// character, and words in back quotes are set in bold.
std::string roff(std::string_view text) {
  std::string out;
  bool bold = false;
  for (const char c : text) {
    if (c == '`') {
      bold = !bold;
      out += bold ? "\\fB" : "\\fR";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\\') {
      out += "\\e";
    } else {
      if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
      out += c;
    }
  }
  return out;
}

std::string synopsis_of(const VerbInfo& verb) {
  std::string text = fmt::format("\\fBscenec {}\\fR", roff(verb.name));
  if (!verb.operands.empty()) text += fmt::format(" \\fI{}\\fR", roff(verb.operands));
  return text;
}

std::string verbs_taking(const OptionRow& row) {
  std::string text;
  for (const VerbInfo& verb : all_verbs()) {
    if (row.verbs.contains(verb.verb))
      text += fmt::format("{}{}", text.empty() ? "" : ", ", verb.name);
  }
  return text;
}

std::string entry_of(const OptionRow& row) {
  std::string head;
  for (const std::string_view name : names_of(row)) {
    head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", roff(name));
  }
  if (row.need == ValueNeed::required) head += fmt::format(" \\fI{}\\fR", roff(row.value));
  if (row.need == ValueNeed::optional) head += fmt::format("[=\\fI{}\\fR]", roff(row.value));
  return fmt::format(".TP\n{}\n{} ({})\n", head, roff(row.help), roff(verbs_taking(row)));
}

}  // namespace

std::string manual_page() {
  std::string text = fmt::format(
      ".\\\" made by `scenec manual`\n"
      ".TH SCENEC 1 \"\" \"{}\" \"User Commands\"\n"
      ".SH NAME\nscenec \\- compile a scene description and render it\n"
      ".SH SYNOPSIS\n.B scenec\n[\\fIVERB\\fR] \\fIFILE\\fR [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n"
      "scenec compiles scenes of its own language (.sdl) and of the course dialect (.txt), tells\n"
      "exactly what is wrong with them, and renders them.\n"
      ".SH VERBS\n",
      roff(version_text));
  for (const VerbInfo& verb : all_verbs()) {
    text += fmt::format(".TP\n{}\n{}\n", synopsis_of(verb), roff(verb.summary));
  }
  text += ".SH OPTIONS\nThe verbs that take an option stand behind it.\n";
  for (const OptionRow& row : all_options()) text += entry_of(row);
  text +=
      ".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nwhat scenec or one of its verbs takes\n"
      ".TP\n\\fB\\-\\-version\\fR\nthe version\n"
      ".SH EXIT STATUS\n";
  for (const ExitCodeInfo& code : all_exit_codes()) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", static_cast<int>(code.code), roff(code.meaning));
  }
  return text +
         ".SH ENVIRONMENT\n"
         "\\fBNO_COLOR\\fR, \\fBFORCE_COLOR\\fR and \\fBCLICOLOR_FORCE\\fR decide on colours when "
         "\\fB\\-\\-color\\fR does not.\n"
         ".SH EXAMPLES\n"
         ".nf\nscenec scene.sdl \\-o picture.png\n"
         "scenec scene.sdl \\-\\-size 64x48 \\-\\-samples 4 \\-D radius=20cm\n"
         "scenec scene.sdl \\-\\-frames 0..143 \\-o film/####.png\n.fi\n";
}

}  // namespace scenec::runtime
