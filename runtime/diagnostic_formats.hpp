// Diagnostics for programs: JSON, one object a line, and SARIF 2.1.0. Both are ASCII, say the same
// in the same order on every run and give places in the files the author wrote: lines and columns
// from 1, columns in code points, the end just behind the last one.
#pragma once

#include <span>
#include <string>

#include "base/diagnostic.hpp"
#include "base/source_map.hpp"

namespace scenec::runtime {

// A diagnostic with the severity it has in this run.
struct Finding {
  Diagnostic diagnostic;
  Severity severity;
};

// Version 1. Keys `version code name severity message`; the place as `file line column end_line
// end_column begin end` (the last two are byte offsets), all absent when it is about the whole run;
// `labels` and `notes` (each a `text` with its place, a note may have none), `hints` (texts) and
// `fixits` (each a `replacement` with its place). Keys may be added without a new version.
[[nodiscard]] std::string json_line(const Finding& finding, const SourceMap& sources);

// One log with one run; notes without a place and hints stand in the text of the message.
[[nodiscard]] std::string sarif_log(std::span<const Finding> findings, const SourceMap& sources);

}  // namespace scenec::runtime
