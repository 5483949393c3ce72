#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>

#include "base/assert.hpp"

namespace scenec {

namespace {

// The text of an identifier with '-' for '_', made while compiling.
template <std::size_t N>
struct DashedName {
  std::array<char, N> characters{};
  consteval explicit DashedName(const char (&identifier)[N]) {
    for (std::size_t i = 0; i < N; ++i) characters[i] = identifier[i] == '_' ? '-' : identifier[i];
  }
  [[nodiscard]] constexpr std::string_view view() const { return {characters.data(), N - 1}; }
};

namespace dashed {
#define SCENEC_DIAGNOSTIC(name, code, severity, title, explanation) \
  constexpr DashedName name{#name};
#include "base/diagnostic_kinds.def"
#undef SCENEC_DIAGNOSTIC
}  // namespace dashed

constexpr auto kinds = std::to_array<DiagnosticKindInfo>({
#define SCENEC_DIAGNOSTIC(name, code, severity, title, explanation) \
  {DiagnosticKind::name, dashed::name.view(), code, Severity::severity, title, explanation},
#include "base/diagnostic_kinds.def"
#undef SCENEC_DIAGNOSTIC
});

auto place_of(const Diagnostic& diagnostic) {
  return std::tuple(diagnostic.span.file, diagnostic.span.begin, info_of(diagnostic.kind).code,
                    diagnostic.span.end);
}

}  // namespace

std::span<const DiagnosticKindInfo> all_diagnostic_kinds() {
  return kinds;
}

const DiagnosticKindInfo& info_of(DiagnosticKind kind) {
  const auto index = static_cast<std::size_t>(kind);
  SCENEC_ASSERT(index < kinds.size());
  return kinds[index];
}

void DiagnosticSink::report(Diagnostic diagnostic) {
  const std::lock_guard lock(mutex_);
  if (!seen_.emplace(diagnostic.kind, diagnostic.span).second) {
    // Without a place, what is said decides whether it is the same mistake.
    const auto same = [&](const Diagnostic& other) {
      return other.kind == diagnostic.kind && other.span == diagnostic.span &&
             other.message == diagnostic.message;
    };
    if (diagnostic.span.valid() || std::any_of(diagnostics_.begin(), diagnostics_.end(), same))
      return;
  }
  if (info_of(diagnostic.kind).severity == Severity::error) ++errors_;
  diagnostics_.push_back(std::move(diagnostic));
}

std::size_t DiagnosticSink::error_count() const {
  const std::lock_guard lock(mutex_);
  return errors_;
}

std::size_t DiagnosticSink::warning_count() const {
  const std::lock_guard lock(mutex_);
  return diagnostics_.size() - errors_;
}

bool DiagnosticSink::only_limits() const {
  const std::lock_guard lock(mutex_);
  return errors_ > 0 &&
         std::all_of(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& d) {
           const DiagnosticKindInfo& info = info_of(d.kind);
           return info.severity != Severity::error || info.is_limit();
         });
}

std::vector<Diagnostic> DiagnosticSink::sorted() const {
  std::vector<Diagnostic> result;
  {
    const std::lock_guard lock(mutex_);
    result = diagnostics_;
  }
  std::sort(result.begin(), result.end(), [](const Diagnostic& a, const Diagnostic& b) {
    const auto place_a = place_of(a);
    const auto place_b = place_of(b);
    return place_a != place_b ? place_a < place_b : a.message < b.message;
  });
  return result;
}

}  // namespace scenec
