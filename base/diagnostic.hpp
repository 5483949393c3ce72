// Diagnostics: what was found, what was expected, where, and what to do. Every kind is a row of
// diagnostic_kinds.def; every phase reports through a DiagnosticSink and carries on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/span.hpp"

namespace scenec {

enum class Severity : std::uint8_t { error, warning };

enum class DiagnosticKind : std::uint16_t {
#define SCENEC_DIAGNOSTIC(name, code, severity, title, explanation) name,
#include "base/diagnostic_kinds.def"
#undef SCENEC_DIAGNOSTIC
};

struct DiagnosticKindInfo {
  DiagnosticKind kind;
  std::string_view
      name;  // identifier of the row, with '-' for '_': names the golden case and `@allow`
  std::string_view code;  // "E0123", "L0456": stable for ever
  Severity severity;
  std::string_view title;        // one line
  std::string_view explanation;  // what `scenec explain CODE` prints below the title
  // Limits (codes E07xx) are the only errors that lead to exit code 4.
  [[nodiscard]] bool is_limit() const { return code.substr(0, 3) == "E07"; }
};
[[nodiscard]] std::span<const DiagnosticKindInfo> all_diagnostic_kinds();
[[nodiscard]] const DiagnosticKindInfo& info_of(DiagnosticKind kind);

struct Label {
  Span span;
  std::string text;
};
// A note hangs on its parent; with a span it shows a second place.
struct Note {
  std::string text;
  Span span;
};
struct FixIt {
  Span span;
  std::string replacement;
};

// Text conventions: lower case, no full stop, back quotes round source words, numbers with units;
// first what is wrong, then what is expected.
struct Diagnostic {
  DiagnosticKind kind;
  Span span;  // invalid: about the whole run
  std::string message;
  std::vector<Label> labels;
  std::vector<Note> notes;
  std::vector<std::string> hints;
  std::vector<FixIt> fixits;

  Diagnostic(DiagnosticKind diagnostic_kind, Span where, std::string text)
      : kind(diagnostic_kind), span(where), message(std::move(text)) {}
  Diagnostic&& label(Span where, std::string text) && {
    labels.push_back({where, std::move(text)});
    return std::move(*this);
  }
  Diagnostic&& note(std::string text, Span where = {}) && {
    notes.push_back({std::move(text), where});
    return std::move(*this);
  }
  Diagnostic&& hint(std::string text) && {
    hints.push_back(std::move(text));
    return std::move(*this);
  }
  Diagnostic&& fix(Span where, std::string replacement) && {
    fixits.push_back({where, std::move(replacement)});
    return std::move(*this);
  }
};

// Collects the diagnostics of one run. Thread-safe. One diagnostic a (kind, span): a second one is
// dropped, so a mistake in a loop body is reported once.
class DiagnosticSink {
 public:
  void report(Diagnostic diagnostic);
  [[nodiscard]] std::size_t error_count() const;
  [[nodiscard]] std::size_t warning_count() const;
  [[nodiscard]] bool has_errors() const { return error_count() > 0; }
  // True when there are errors and every one of them is a limit.
  [[nodiscard]] bool only_limits() const;
  // Sorted by (file, offset, code); the order does not depend on threads.
  [[nodiscard]] std::vector<Diagnostic> sorted() const;

 private:
  mutable std::mutex mutex_;
  std::vector<Diagnostic> diagnostics_;
  std::set<std::pair<DiagnosticKind, Span>> seen_;
  std::size_t errors_ = 0;
};

}  // namespace scenec
