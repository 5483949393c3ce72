#include "runtime/denials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace scenec::runtime {

namespace {

constexpr std::string_view every_warning = "warnings";

bool same_letters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) {
    return lower(x) == lower(y) || (lower(x) == '_' && y == '-');
  });
}

std::optional<std::string_view> nearest_lint(std::string_view word) {
  std::vector<std::string_view> known{every_warning};
  for (const DiagnosticKindInfo& kind : all_diagnostic_kinds()) {
    if (kind.severity != Severity::warning) continue;
    known.push_back(kind.name);
    known.push_back(kind.code);
  }
  return nearest_name(word, known);
}

}  // namespace

const DiagnosticKindInfo* find_diagnostic(std::string_view code_or_name) {
  const auto kinds = all_diagnostic_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const DiagnosticKindInfo& kind) {
    return same_letters(code_or_name, kind.code) || same_letters(code_or_name, kind.name);
  });
  return found == kinds.end() ? nullptr : &*found;
}

std::optional<std::string> Denials::add(std::string_view word) {
  if (word == every_warning) {
    all_warnings_ = true;
    return std::nullopt;
  }
  const std::string expected = "`warnings` or the code or name of a lint";
  const DiagnosticKindInfo* const kind = find_diagnostic(word);
  if (kind == nullptr) {
    const std::optional<std::string_view> nearest = nearest_lint(word);
    return nearest ? fmt::format("{}; did you mean `{}`?", expected, *nearest)
                   : expected + "; `scenec explain --list` names them all";
  }
  if (kind->severity != Severity::warning) return expected + "; this one is an error already";
  kinds_.push_back(kind->kind);
  return std::nullopt;
}

bool Denials::cover(DiagnosticKind kind) const {
  if (info_of(kind).severity != Severity::warning) return false;
  return all_warnings_ || std::find(kinds_.begin(), kinds_.end(), kind) != kinds_.end();
}

}  // namespace scenec::runtime
