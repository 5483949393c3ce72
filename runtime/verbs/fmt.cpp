// `scenec fmt`: rewrites source files in the canonical layout. A file is replaced whole and only
// when it changes; one with a syntax error is shown and left alone.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "frontend/format/formatter.hpp"
#include "frontend/format/unified_diff.hpp"
#include "grammar/parse.hpp"
#include "runtime/output.hpp"
#include "runtime/session.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

constexpr std::string_view standard_input = "-";
constexpr std::string_view name_of_standard_input = "<stdin>";

// Standard input, read no further than a file may be long: the parser reports the excess.
std::string text_of(std::istream* input, std::uint64_t limit) {
  std::string text;
  constexpr std::size_t block = std::size_t{64} << 10;
  while (input != nullptr && *input && text.size() <= limit) {
    const std::size_t size = text.size();
    text.resize(size + block);
    input->read(text.data() + size, block);
    text.resize(size + static_cast<std::size_t>(input->gcount()));
  }
  return text;
}

class Formatting {
 public:
  Formatting(const Options& options, const Environment& environment)
      : options_(options),
        environment_(environment),
        session_(options),
        from_standard_input_(options.operands[0] == standard_input),
        name_(from_standard_input_ ? name_of_standard_input : session_.scene_path()) {}

  ExitCode run() {
    const std::optional<FileId> file = read();
    if (!file) {
      static_cast<void>(session_.finish(environment_));
      return ExitCode::file_error;
    }
    const std::string_view before = session_.sources().text(*file);
    const auto parse =
        dialect_of(before) == grammar::Dialect::sdl ? grammar::parse_sdl : grammar::parse_course;
    const grammar::SyntaxTree tree = parse(*file, before, session_.sink(), {});
    if (session_.sink().has_errors()) return session_.finish(environment_);
    return deliver(before, frontend::format(tree));
  }

 private:
  grammar::Dialect dialect_of(std::string_view text) const {
    return options_.dialect.value_or(grammar::dialect_of(name_, text));
  }

  std::optional<FileId> read() {
    const std::uint64_t limit = grammar::ParseLimits{}.file;
    if (from_standard_input_) {
      return session_.sources().add(name_, text_of(environment_.in, limit));
    }
    auto content = session_.files().read(name_, limit);
    if (content) {
      return session_.sources().add(name_, content.value().bytes, content.value().owner);
    }
    session_.sink().report(Diagnostic(
        DiagnosticKind::file_unreadable, {},
        fmt::format("cannot read {}: {}", quoted_string(name_), text_of_error(content.error()))));
    return std::nullopt;
  }
  static std::string_view text_of_error(FileError error) { return scenec::text_of(error); }

  ExitCode deliver(std::string_view before, const std::string& after) {
    ExitCode code = session_.finish(environment_);  // warnings
    if (options_.check_layout && before != after) {
      code = ExitCode::scene_error;
      if (!options_.diff) environment_.out << printable(name_, name_.size()) << '\n';
    }
    if (options_.diff) {
      environment_.out << frontend::unified_diff(before, after, name_, name_);
    } else if (!options_.check_layout && from_standard_input_) {
      environment_.out << after;
    } else if (!options_.check_layout && before != after) {
      if (!write_output(name_, after, session_.sink())) {
        static_cast<void>(session_.finish(environment_));
        return ExitCode::file_error;
      }
    }
    return code;
  }

  const Options& options_;
  const Environment& environment_;
  Session session_;
  bool from_standard_input_;
  std::string name_;
};

}  // namespace

ExitCode verbs::fmt(const Options& options, const Environment& environment) {
  ExitCode worst = ExitCode::ok;
  for (const std::string& operand : options.operands) {
    Options one = options;
    one.operands = {operand};
    worst = std::max(worst, Formatting(one, environment).run());
  }
  return worst;
}

}  // namespace scenec::runtime
