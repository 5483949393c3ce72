// Turns diagnostics into text for a terminal: `path:line:col: error[E0123]: text`, then the source
// line with carets, labels, notes, hints and fix-its.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "base/source_map.hpp"

namespace scenec {

struct RenderOptions {
  bool color = false;
  std::size_t max_source_width = 200;               // longer source lines are cut round the caret
  std::optional<Severity> severity = std::nullopt;  // instead of the kind's own
};

[[nodiscard]] std::string render_terminal(const Diagnostic& diagnostic, const SourceMap& sources,
                                          const RenderOptions& options);

}  // namespace scenec
