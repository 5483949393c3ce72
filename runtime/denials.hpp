// `--deny`: which lints count as errors in this run.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"

namespace scenec::runtime {

// The row with this code or name, in small or capital letters, with `_` or `-`; null: there is
// none.
[[nodiscard]] const DiagnosticKindInfo* find_diagnostic(std::string_view code_or_name);

class Denials {
 public:
  // Takes `warnings` or the code or name of a lint; returns what the word would have had to be.
  [[nodiscard]] std::optional<std::string> add(std::string_view word);
  // Whether the lint is denied; never true of an error.
  [[nodiscard]] bool cover(DiagnosticKind kind) const;

 private:
  bool all_warnings_ = false;
  std::vector<DiagnosticKind> kinds_;
};

}  // namespace scenec::runtime
